#include "io/json_document.hpp"

#include <filesystem>
#include <fstream>
#include <set>

namespace formotion {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t kDeepest = 64;
constexpr std::uintmax_t kLargestFile = 50u << 20;

std::string escaped(const std::string& key) {
  std::string out;
  for (const char c : key) { out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c); }
  return out;
}

// Builds the document and notes duplicate keys.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& key) override {
    key_ = key;
    if (!levels_.back().keys.insert(key).second) {
      issues.push_back({file_, pointer() + "/" + escaped(key), false, "the key '" + key + "' again", "each key once"});
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) override {
    std::size_t line = 1, column = 1;
    for (std::size_t i = 0; i + 1 < position && i < text_.size(); ++i) {
      ++column;
      if (text_[i] == '\n') {
        ++line;
        column = 1;
      }
    }
    const bool range = dynamic_cast<const nlohmann::detail::out_of_range*>(&error) != nullptr;
    const std::string near = token.size() > 40 ? token.substr(0, 40) + "..." : token;
    const std::string found = position > text_.size() ? "the end of the text"
                              : near.empty()          ? "text that is not JSON"
                                                      : "'" + near + "'";
    issues.push_back({file_, std::to_string(line) + ":" + std::to_string(column), true, found,
                      range ? "a number within the range of doubles" : "valid JSON"});
    return false;
  }

  Json document;
  std::vector<InputIssue> issues;

 private:
  struct Level {
    Json* value;
    std::string name;
    std::set<std::string> keys;
  };

  template <class Value>
  Json* place(Value&& value) {
    if (levels_.empty()) {
      document = std::forward<Value>(value);
      return &document;
    }
    Json& parent = *levels_.back().value;
    if (parent.is_array()) {
      parent.push_back(std::forward<Value>(value));
      return &parent.back();
    }
    parent[key_] = std::forward<Value>(value);
    return &parent[key_];
  }
  template <class Value>
  bool put(Value&& value) {
    place(std::forward<Value>(value));
    return true;
  }
  bool open(Json value) {
    if (levels_.size() >= kDeepest) {
      issues.push_back(
          {file_, pointer(), false, "more than " + std::to_string(kDeepest) + " levels of nesting", "fewer"});
      return false;
    }
    std::string name;
    if (!levels_.empty()) {
      const Json& parent = *levels_.back().value;
      name = parent.is_array() ? std::to_string(parent.size()) : escaped(key_);
    }
    levels_.push_back({place(std::move(value)), name, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }
  std::string pointer() const {
    std::string path;
    for (std::size_t i = 1; i < levels_.size(); ++i) path += "/" + levels_[i].name;
    return path;
  }

  const std::string& text_;
  std::string file_, key_;
  std::vector<Level> levels_;
};

}  // namespace

nlohmann::ordered_json parse_json(const std::string& text, const std::string& file) {
  Builder builder(text, file);
  const bool parsed = Json::sax_parse(text, &builder);
  if (!builder.issues.empty()) throw InputError(std::move(builder.issues));
  if (!parsed) throw InputError({{file, "", false, "text that is not JSON", "valid JSON"}});
  return std::move(builder.document);
}

std::string read_text_file(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError({{path, "", false, "no such file", "a file"}});
  if (!std::filesystem::is_regular_file(status)) throw InputError({{path, "", false, "not a regular file", "a file"}});
  if (std::filesystem::file_size(path, error) > kLargestFile)
    throw InputError({{path, "", false, "a file of more than 50 MB", "a smaller one"}});
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw InputError({{path, "", false, "a file that cannot be read", "a readable file"}});
  return text;
}

}  // namespace formotion
