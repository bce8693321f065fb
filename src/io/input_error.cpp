#include "io/input_error.hpp"

namespace formotion {
namespace {

std::string all_lines(const std::vector<InputIssue>& issues) {
  std::string text;
  for (const InputIssue& issue : issues) text += (text.empty() ? "" : "\n") + to_line(issue);
  return text;
}

}  // namespace

std::string to_line(const InputIssue& issue) {
  std::string line = "error: " + issue.file + ":";
  if (issue.is_position) {
    line += issue.where + ":";
  } else if (!issue.where.empty()) {
    line += " " + issue.where + ":";
  }
  line += " " + issue.found;
  if (!issue.expected.empty()) line += ", expected " + issue.expected;
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < ' ') c = '?';  // one line per error, whatever a file holds
  }
  return line;
}

InputError::InputError(std::vector<InputIssue> all) : std::runtime_error(all_lines(all)), issues(std::move(all)) {}

}  // namespace formotion
