#include "io/dxf_groups.hpp"

#include <charconv>
#include <cmath>

namespace formotion {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kBlanks);
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

}  // namespace

DxfGroups::DxfGroups(const std::string& text, const std::string& file) : text_(text), file_(file) {
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw InputError({{file_, "", false, found, expected}});
  };
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) at_ = 3;
  if (text.find_first_not_of(" \t\r\n", at_) == std::string::npos)
    refuse("an empty file", "a DXF drawing (text, not binary)");
  if (text.rfind("AutoCAD Binary DXF", 0) == 0) refuse("a binary DXF drawing", "one saved as ASCII (text) DXF");
  if (text.rfind("AC10", 0) == 0 || text.rfind("AC1.", 0) == 0)
    refuse("a DWG drawing", "one saved as ASCII (text) DXF");
  if (text.find('\0') != std::string::npos) refuse("binary data", "a DXF drawing saved as ASCII (text)");
}

void DxfGroups::fail(int line, const std::string& found, const std::string& expected) const {
  throw InputError({{file_, std::to_string(line) + ":1", true, found, expected}});
}

std::optional<std::string_view> DxfGroups::line() {
  if (at_ >= text_.size()) return std::nullopt;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  const std::string_view whole(text_.data() + at_, end - at_);
  at_ = end + 1;
  ++line_;
  return trimmed(whole);
}

std::optional<DxfGroup> DxfGroups::next() {
  if (ended_) return std::nullopt;
  const auto code_text = line();
  const auto value = code_text ? line() : std::nullopt;
  if (!value) fail(std::max(line_, 1), "the end of the text", "the drawing to go on up to EOF: it is truncated");
  DxfGroup group{0, *value, line_};
  const auto [end, error] = std::from_chars(code_text->data(), code_text->data() + code_text->size(), group.code);
  if (error != std::errc() || end != code_text->data() + code_text->size()) {
    fail(line_ - 1, "'" + dxf_word(*code_text) + "'", "a DXF group code (an integer)");
  }
  ended_ = group.starts("EOF");
  return group;
}

std::optional<double> dxf_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string dxf_word(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  std::string word;
  for (const char c : text.substr(0, kLongest)) word += c >= ' ' && c <= '~' ? c : '?';
  return text.size() > kLongest ? word + "..." : word;
}

}  // namespace formotion
