// The entities of a DXF drawing as paths in mm: arcs as chords, hidden and foreign things left out.
#pragma once

#include <string>
#include <vector>

#include "analysis/geometry/polygon.hpp"
#include "io/dxf_import.hpp"

namespace formotion {

struct DxfPath {
  std::string layer;  // as DxfContour::layer
  bool closed = false;
  Loop points_mm;
};

struct DxfUnit {
  double mm = 1;
  std::string name = "mm";
};

struct DxfDrawing {
  DxfUnit unit;
  std::vector<DxfPath> paths;  // in file order
  int hidden = 0;              // entities on layers that are off or frozen, and invisible ones
};

// "(25.4, 0) mm", and for other units ", in the drawing (1, 0) inches".
std::string dxf_place(const Point& p_mm, const DxfUnit& unit);

// Throws InputError with everything that is no path: unsupported entities (one issue for each type and layer), numbers
// that are none, what lies out of the plane z = 0. Mirrored entities (extrusion along -z) are mirrored as they are
// seen.
DxfDrawing read_dxf_drawing(const std::string& text, const std::string& file, const DxfOptions& options);

// Issues that gather up to a number that a person reads; the rest is counted.
class DxfIssues {
 public:
  explicit DxfIssues(std::string file) : file_(std::move(file)) {}
  void add(const std::string& found, const std::string& expected, int line = 0);
  bool full() const { return issues_.size() >= kMost; }
  void throw_if_any() const;

 private:
  static constexpr std::size_t kMost = 50;
  std::string file_;
  std::vector<InputIssue> issues_;
  int more_ = 0;
};

}  // namespace formotion
