// Bad input, as the contract reports it: where, what was found, what was expected.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace formotion {

struct InputIssue {
  std::string file;
  std::string where;         // JSON pointer ("/part/outline_mm/3"), or "line:column"
  bool is_position = false;  // where is line:column
  std::string found, expected;
};

// `error: FILE: /json/pointer: found, expected ...` (`error: FILE:line:column: ...` for positions).
std::string to_line(const InputIssue& issue);

// All issues of one input at once. Thrown by io, caught in main (exit code 2).
struct InputError : std::runtime_error {
  explicit InputError(std::vector<InputIssue> all);
  std::vector<InputIssue> issues;
};

}  // namespace formotion
