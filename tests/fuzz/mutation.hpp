// Texts that are nearly right: the seeded mutations of the fuzz tests.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace fuzz {

// One to a few changes: bytes, lines, numbers made extreme, cuts, and pieces of another text.
std::string mutated(const std::string& text, const std::string& other, std::mt19937& random);
// The same on the structure of JSON: values replaced, keys dropped, renamed, moved. text must be JSON.
std::string mutated_json(const std::string& text, std::mt19937& random);

// The files of a folder with this ending, by name; throws if there is none.
std::vector<std::string> corpus(const std::string& folder, const std::string& ending);

}  // namespace fuzz
