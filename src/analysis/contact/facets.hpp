// The contact facets: where one feature of the part touches one fixed feature, as patches of surface in (x, y, theta).
//
// With theta fixed a contact leaves one freedom, its place `along` the touched edge or round corner: a facet is the
// image of a rectangle (theta, along), for a corner on a round corner of a parallelogram. Facets know only their own
// two features and the neighbours of these: parts of them may be buried in obstacles (free_slice.hpp trims them).
// At most 2 n m of them for n and m corners, since only convex corners touch.
#pragma once

#include <array>
#include <vector>

#include "analysis/contact/contact_pair.hpp"

namespace formotion {

// The four boundary curves of a facet, by what ends there.
//   CornerOnEdge, EdgeOnCorner: the edge ends (corner meets corner), or another edge at the touching corner becomes
//   parallel to the touched one (edge on edge, one theta).
//   CornerOnCorner: the round corner ends (along), or the touching corner's next edge becomes tangent (theta).
enum class FacetSide { AlongStart, AlongEnd, ThetaStart, ThetaEnd };

struct FacetNeighbour {
  int facet = 0;                // place in the list of facets
  FacetSide side{};             // of the neighbour, which lies along this boundary
  DirectionRange orientations;  // where it does: of theta; width 0 on an edge-on-edge line
};

struct FacetBoundary {
  bool exists = true;                         // full pins have no ends
  bool horizontal = false;                    // a straight line at one theta; else theta runs
  Configuration from, to;                     // its ends; theta rises, or else along does. Not wrapped
  double along_from_mm = 0, along_to_mm = 0;  // at these ends; theta and along run evenly between
  std::vector<FacetNeighbour> neighbours;     // up to three facets meet this one in a stretch (not in a point alone)
};

struct ContactFacet {
  ContactPair pair;
  DirectionRange orientations;            // of theta: closed range
  double extent_mm = 0;                   // along runs from 0 to this
  std::array<FacetBoundary, 4> boundary;  // by FacetSide
};

// All facets, in the order of contact_pairs().
std::vector<ContactFacet> contact_facets(const MovingShape& part, const Obstacles& obstacles);

// A stretch of contact places at one theta.
struct AlongRange {
  double from_mm = 0, to_mm = 0;
};

// Where along the contact can be at theta: nothing, all of the touched edge, or up to two stretches of a round corner
// (on a full pin they may run on beyond one turn).
std::vector<AlongRange> along_ranges(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                                     double theta_rad);

// Where the part is when the pair touches at this theta and place (closed form; ranges are not asked).
Configuration configuration_on(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                               double theta_rad, double along_mm);

// count (at least 2) configurations from one end of the boundary to the other; empty where it does not exist.
std::vector<Configuration> boundary_points(const MovingShape& part, const Obstacles& obstacles,
                                           const ContactFacet& facet, FacetSide side, int count);

// The facet's unit normal in (x, y, gyration * theta), into the free side.
Eigen::Vector3d scaled_normal(const ContactState& state, double gyration_mm);

}  // namespace formotion
