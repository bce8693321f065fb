#include "fuzz/input_law.hpp"

#include <algorithm>
#include <exception>

#include "io/dxf_import.hpp"
#include "io/problem_file.hpp"

namespace fuzz {
namespace {

void read(Reader reader, const std::string& text) {
  if (reader == Reader::Problem) {
    // The folder does not exist: files that a mutated problem names are not found.
    formotion::parse_problem(text, "/nonexistent/fuzzed.json");
    return;
  }
  formotion::DxfOptions options;
  options.layers = {"VOID", "WALL"};
  for (const formotion::DxfContour& contour : formotion::parse_dxf(text, "fuzzed.dxf", options)) {
    if (contour.points_mm.size() < 3 || !(formotion::signed_area(contour.points_mm) > 0)) {
      throw std::logic_error("a contour without area");
    }
  }
  const formotion::Polygon part = formotion::parse_dxf_part(text, "fuzzed.dxf");
  // Quadratic: for what the fuzzer makes of small drawings only.
  constexpr std::size_t kSmall = 2000;
  std::size_t corners = part.outer.size();
  for (const formotion::Loop& hole : part.holes) corners += hole.size();
  if (corners > kSmall) return;
  if (const auto found = formotion::defect(part)) throw std::logic_error("a part with a defect: " + *found);
}

}  // namespace

std::string breach(Reader reader, const std::string& text, bool* accepted) {
  if (accepted) *accepted = false;
  try {
    read(reader, text);
    if (accepted) *accepted = true;
  } catch (const formotion::InputError& error) {
    if (error.issues.empty()) return "an InputError without issues";
    const std::string lines = error.what();
    const auto breaks = static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n'));
    if (breaks + 1 != error.issues.size()) return "not one line for each issue: " + lines;
    for (const formotion::InputIssue& issue : error.issues) {
      if (issue.found.empty()) return "an issue that says nothing: " + formotion::to_line(issue);
    }
  } catch (const std::exception& error) { return std::string("another exception: ") + error.what(); }
  return {};
}

}  // namespace fuzz
