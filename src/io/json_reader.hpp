// Reading a JSON document by keys: every issue is noted with its pointer, and reading goes on.
#pragma once

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/input_error.hpp"
#include "problem/affine.hpp"

namespace formotion {

// Where issues gather.
struct IssueList {
  std::string file;
  std::vector<InputIssue> issues;
  void add(const std::string& pointer, const std::string& found, const std::string& expected) {
    issues.push_back({file, pointer, false, found, expected});
  }
  void throw_if_any() const {
    if (!issues.empty()) throw InputError(issues);
  }
};

// What a value is, for messages: "\"abc\"", "-3", "an array".
std::string described(const nlohmann::ordered_json& value);

struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open = false;  // the ends themselves are not allowed
};
inline constexpr double kLargestNumber = 1e9;  // lengths beyond a thousand kilometres are slips
inline constexpr Range kAny{-kLargestNumber, kLargestNumber, false};
inline constexpr Range kPositive{0, kLargestNumber, true};
inline constexpr Range kNotNegative{0, kLargestNumber, false};

// A number within the range, or nothing and an issue.
std::optional<double> read_number(const nlohmann::ordered_json& value, const std::string& pointer, const Range& range,
                                  IssueList& issues);
// A number or an expression in the variables.
std::optional<Affine> read_expression(const nlohmann::ordered_json& value, const std::string& pointer,
                                      const std::vector<std::string>& names, IssueList& issues);
std::optional<std::string> read_string(const nlohmann::ordered_json& value, const std::string& pointer,
                                       IssueList& issues);

// One object: keys are asked for by name; at the end the unknown ones are issues.
class ObjectReader {
 public:
  using Json = nlohmann::ordered_json;
  // An issue if value is no object; then every key is missing, silently.
  ObjectReader(const Json& value, std::string pointer, IssueList& issues);
  ObjectReader(const ObjectReader&) = delete;
  ~ObjectReader() = default;

  const Json* find(const std::string& key);  // null where missing
  const Json* require(const std::string& key, const std::string& expected);
  std::string at(const std::string& key) const { return pointer_ + "/" + key; }
  const std::string& pointer() const { return pointer_; }
  bool valid() const { return object_ != nullptr; }

  std::optional<double> number(const std::string& key, const Range& range);
  double number_or(const std::string& key, const Range& range, double otherwise) {
    return number(key, range).value_or(otherwise);
  }
  double required_number(const std::string& key, const Range& range, const std::string& expected = "a number");
  Affine expression(const std::string& key, const std::vector<std::string>& names);  // required
  std::optional<std::string> string(const std::string& key);
  bool boolean_or(const std::string& key, bool otherwise);

  // Call once, after all keys were asked for.
  void finish();
  void ignore(const std::vector<std::string>& keys);

 private:
  const Json* object_ = nullptr;
  std::string pointer_;
  IssueList& issues_;
  std::vector<std::string> known_;
};

}  // namespace formotion
