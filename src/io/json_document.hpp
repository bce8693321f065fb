// Strict JSON: duplicate keys, numbers out of range and bottomless nesting are errors.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "io/input_error.hpp"

namespace formotion {

// Throws InputError: with line and column where the text does not parse, with pointers for duplicate keys.
nlohmann::ordered_json parse_json(const std::string& text, const std::string& file);

// The whole of a regular file of at most 50 MB; InputError if it cannot be read.
std::string read_text_file(const std::string& path);

}  // namespace formotion
