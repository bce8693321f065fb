#include "io/json_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "io/expression.hpp"
#include "io/suggestion.hpp"

namespace formotion {
namespace {

// The shortest text that reads back as the number: 60, not 60.0.
std::string number_text(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string range_text(const Range& range) {
  const bool low = range.min > -kLargestNumber, high = range.max < kLargestNumber;
  if (low && high)
    return "a number from " + number_text(range.min) + " to " + number_text(range.max) +
           (range.open ? ", ends excluded" : "");
  if (low) return (range.open ? "a number above " : "a number of at least ") + number_text(range.min);
  if (high) return (range.open ? "a number below " : "a number of at most ") + number_text(range.max);
  return "a number";
}

}  // namespace

std::string described(const nlohmann::ordered_json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  const std::string text = value.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  return text.size() > 60 ? text.substr(0, 57) + "..." : text;
}

std::optional<double> read_number(const nlohmann::ordered_json& value, const std::string& pointer, const Range& range,
                                  IssueList& issues) {
  if (!value.is_number()) {
    issues.add(pointer, described(value), range_text(range));
    return std::nullopt;
  }
  const double number = value.get<double>();
  const bool above = range.open ? number > range.min : number >= range.min;
  const bool below = range.open ? number < range.max : number <= range.max;
  if (!std::isfinite(number) || !above || !below) {
    const std::string expected = std::abs(number) > kLargestNumber ? "a number of at most 1e9" : range_text(range);
    issues.add(pointer, described(value), expected);
    return std::nullopt;
  }
  return number;
}

std::optional<Affine> read_expression(const nlohmann::ordered_json& value, const std::string& pointer,
                                      const std::vector<std::string>& names, IssueList& issues) {
  if (value.is_number()) {
    const auto number = read_number(value, pointer, kAny, issues);
    return number ? std::optional<Affine>(Affine{*number, {}}) : std::nullopt;
  }
  if (!value.is_string()) {
    issues.add(pointer, described(value), "a number or an expression in the variables");
    return std::nullopt;
  }
  const auto parsed = parse_expression(value.get<std::string>(), names);
  if (const auto* reason = std::get_if<std::string>(&parsed)) {
    issues.add(pointer, *reason, "an expression that is affine in the variables");
    return std::nullopt;
  }
  return std::get<Affine>(parsed);
}

std::optional<std::string> read_string(const nlohmann::ordered_json& value, const std::string& pointer,
                                       IssueList& issues) {
  if (value.is_string()) return value.get<std::string>();
  issues.add(pointer, described(value), "a string");
  return std::nullopt;
}

ObjectReader::ObjectReader(const Json& value, std::string pointer, IssueList& issues)
    : pointer_(std::move(pointer)), issues_(issues) {
  if (value.is_object()) {
    object_ = &value;
  } else {
    issues_.add(pointer_, described(value), "an object");
  }
}

const nlohmann::ordered_json* ObjectReader::find(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  if (!object_) return nullptr;
  const auto found = object_->find(key);
  return found == object_->end() ? nullptr : &*found;
}

const nlohmann::ordered_json* ObjectReader::require(const std::string& key, const std::string& expected) {
  const Json* value = find(key);
  if (!value && object_) issues_.add(at(key), "nothing", expected);
  return value;
}

std::optional<double> ObjectReader::number(const std::string& key, const Range& range) {
  const Json* value = find(key);
  return value ? read_number(*value, at(key), range, issues_) : std::nullopt;
}

double ObjectReader::required_number(const std::string& key, const Range& range, const std::string& expected) {
  const Json* value = require(key, expected);
  return value ? read_number(*value, at(key), range, issues_).value_or(0) : 0;
}

Affine ObjectReader::expression(const std::string& key, const std::vector<std::string>& names) {
  const Json* value = require(key, "a number or an expression in the variables");
  return value ? read_expression(*value, at(key), names, issues_).value_or(Affine{}) : Affine{};
}

std::optional<std::string> ObjectReader::string(const std::string& key) {
  const Json* value = find(key);
  return value ? read_string(*value, at(key), issues_) : std::nullopt;
}

bool ObjectReader::boolean_or(const std::string& key, bool otherwise) {
  const Json* value = find(key);
  if (!value) return otherwise;
  if (value->is_boolean()) return value->get<bool>();
  issues_.add(at(key), described(*value), "true or false");
  return otherwise;
}

void ObjectReader::ignore(const std::vector<std::string>& keys) {
  known_.insert(known_.end(), keys.begin(), keys.end());
}

void ObjectReader::finish() {
  if (!object_) return;
  for (const auto& [key, value] : object_->items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    std::string expected = "one of";
    for (const std::string& word : known_) expected += (expected == "one of" ? " " : ", ") + word;
    const auto near = nearest_word(key, known_);
    issues_.add(at(key), "the unknown key '" + key + "'" + did_you_mean(key, known_), near ? "a known key" : expected);
  }
}

}  // namespace formotion
