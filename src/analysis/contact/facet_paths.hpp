// The facets at one theta, as paths of the centre of mass, and where they cross each other.
#pragma once

#include <vector>

#include "analysis/contact/contact_pair.hpp"

namespace formotion {

// A segment, or an arc (counter-clockwise); places on it run from 0 to length_mm. Its free side is on the right.
struct FacetPath {
  ContactPair pair;
  Point from, to;
  Point along = Point::Zero();  // unit; of a segment
  double length_mm = 0;
  double along_from_mm = 0;  // the contact's place at place 0; the two run together
  Point centre = Point::Zero();
  double radius_mm = 0;  // 0: a segment
  double from_rad = 0;
  Box box;

  bool is_arc() const { return radius_mm > 0; }
  Point at(double place_mm) const;
  double nearest_place(const Point& p) const;
};

// The paths of all facets that exist at c = cos theta, s = sin theta.
std::vector<FacetPath> facet_paths(const MovingShape& part, const Obstacles& obstacles, double c, double s);

// A place where a path meets others.
struct PathNode {
  double place_mm = 0;
  int meets = 0;  // how many others; a parallel one counts twice. Two and more can leave the place free alone
};

// The nodes of paths[i], its own ends among them, ascending; nearer than 1e-8 mm are one.
std::vector<PathNode> path_nodes(const std::vector<FacetPath>& paths, int i);

}  // namespace formotion
