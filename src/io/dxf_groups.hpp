// The text of a DXF file as what it is: pairs of a group code and a value, one line each.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/input_error.hpp"

namespace formotion {

struct DxfGroup {
  int code = 0;
  std::string_view value;  // without blanks around it
  int line = 0;            // of the value, from 1
  bool starts(std::string_view what) const { return code == 0 && value == what; }
};

// Reads groups one after the other; throws InputError (line and column) where the text is none.
class DxfGroups {
 public:
  // Keeps text by reference. Refuses what is no DXF text: nothing, binary DXF, DWG.
  DxfGroups(const std::string& text, const std::string& file);
  // Nothing behind the group 0 EOF, which every whole file has: a text that ends before it throws.
  std::optional<DxfGroup> next();
  const std::string& file() const { return file_; }

 private:
  std::optional<std::string_view> line();
  [[noreturn]] void fail(int line, const std::string& found, const std::string& expected) const;

  const std::string& text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 0;
  bool ended_ = false;
};

// A finite number that is the whole text, in the C locale; nothing otherwise.
std::optional<double> dxf_number(std::string_view text);
// Text of a file, fit for a message: short, and plain ASCII, since DXF files come in every encoding.
std::string dxf_word(std::string_view text);

}  // namespace formotion
