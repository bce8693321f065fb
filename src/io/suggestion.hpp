// "Did you mean": the known word nearest to a misspelt one.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace formotion {

// The nearest word by restricted Damerau-Levenshtein distance, if it is near (a third of its length, at least one);
// a word that only lacks its unit ("width" for "width_mm") is nearest of all.
std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& known);

// ", did you mean 'width_mm'?" or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace formotion
