// Two contacts at once are curves in (x, y, theta), three are points.
//
// An edge contact holds the centre of mass on a line N . p = h whose N and h are trigonometric in theta; a corner on a
// round corner holds it on a circle. Two lines meet in one point, a closed form in theta with poles where they are
// parallel; three lines where a determinant of degree one or two in (cos, sin) vanishes (derived; checked against
// scans over theta).
#pragma once

#include <array>
#include <vector>

#include "analysis/contact/contact_pair.hpp"

namespace formotion {

// The positions at one theta at which a pair touches (its extent is not asked): a line, or a circle.
struct ContactLocus {
  Point normal = Point::Zero();  // unit; into the free side. Line: normal . p = offset
  double offset_mm = 0;
  Point centre = Point::Zero();  // circle
  double radius_mm = 0;          // 0: a line
};
ContactLocus contact_locus(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair, double c,
                           double s);

// The positions at which both touch at c = cos theta, s = sin theta: one for two edge contacts, up to two with a
// corner on a round corner (one where they are tangent); none at poles (sine of the angle between the lines below
// 1e-14) or where circles miss.
struct TwoContactPositions {
  int count = 0;
  std::array<Point, 2> position;
};
TwoContactPositions two_contact_positions(const MovingShape& part, const Obstacles& obstacles, const ContactPair& first,
                                          const ContactPair& second, double c, double s);

// For two edge contacts of one kind whose normals are parallel at every theta: the orientations (at most two, in
// [0, 2 pi)) at which their lines coincide. The curve is then a horizontal line there, and nowhere else. Contacts of
// different kinds are parallel at the one theta where their edges are (a boundary of their facets); empty for these.
std::vector<double> horizontal_orientations(const MovingShape& part, const Obstacles& obstacles,
                                            const ContactPair& first, const ContactPair& second);

// The direction of the curve of two contacts in (x, y, gyration * theta): unit, along gradient x gradient; zero where
// the facets are tangent.
Eigen::Vector3d curve_tangent(const ContactState& first, const ContactState& second, double gyration_mm);

struct ThreeContactOptions {
  double tolerance_mm = 1e-9;   // beyond the ends of edges
  double tolerance_rad = 1e-9;  // beyond the ends of orientations
  bool within_facets = true;    // false: contacts of the unbounded lines as well
};

// All configurations (theta in [0, 2 pi)) at which the three pairs touch within their facets; other obstacles are not
// asked. Edge contacts: all roots in closed form (unit circle, companion matrix), polished on the three gaps. With a
// corner on a round corner: roots of the third gap along the curve of the other two, numerically, between 1440 samples:
// two that lie closer than a quarter of a degree can be missed. Triples that touch along a whole curve (three contacts
// of one corner with another) have no isolated root and give nothing.
std::vector<Configuration> three_contacts(const MovingShape& part, const Obstacles& obstacles,
                                          const std::array<ContactPair, 3>& pairs,
                                          const ThreeContactOptions& options = {});

}  // namespace formotion
