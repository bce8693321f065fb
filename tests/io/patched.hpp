// Problem files with one value changed, and what is said of them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/problem_file.hpp"

namespace formotion {

inline std::vector<InputIssue> issues_of(const std::string& text) {
  try {
    parse_problem(text, "p.json");
  } catch (const InputError& error) { return error.issues; }
  return {};
}

// The document with the value at a pointer replaced ("~" takes it out).
inline std::string patched(const std::string& text, const std::string& pointer, const std::string& value) {
  nlohmann::ordered_json document = nlohmann::ordered_json::parse(text);
  const nlohmann::ordered_json::json_pointer at(pointer);
  if (value == "~") {
    document[at.parent_pointer()].erase(at.back());
  } else {
    document[at] = nlohmann::ordered_json::parse(value);
  }
  return document.dump();
}

struct Bad {
  std::string pointer, value;  // the patch
  std::string where, words;    // the issue's pointer, and what its line must say
};

}  // namespace formotion
