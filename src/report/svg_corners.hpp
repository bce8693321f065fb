// Numbers at the corners of contours on a sheet.
#pragma once

#include <string>
#include <vector>

#include "report/svg_canvas.hpp"
#include "report/track_outline.hpp"

namespace formotion {

// Where the outside of a counter-clockwise contour is at its k-th corner: a direction on paper (y downwards).
Point outwards_on_paper(const std::vector<Corner>& corners, std::size_t k);

// A mark at p (on paper), a corner, and its label in a free place beside it, outwards first; with a leader where that
// is far away.
void number_corner(SvgCanvas& canvas, const std::string& label, const Point& p, const Point& outwards);

}  // namespace formotion
