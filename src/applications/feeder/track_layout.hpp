// Features placed along the track: what is cut away where, before clipping to the strip.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "analysis/constraints/support_travel.hpp"
#include "analysis/contact/shapes.hpp"
#include "applications/feeder/evaluation.hpp"
#include "applications/feeder/spec.hpp"

namespace formotion::feeder {

struct LaidFeature {
  std::string type;
  double start_mm = 0, end_mm = 0;
  std::vector<Loop> voids;               // counter-clockwise; features that are open to the free edge go on beyond it
  std::vector<Loop> own_voids;           // the same, x from start_mm
  double x_min = 0, x_max = 0;           // of the voids
  std::vector<ObstacleShape> obstacles;  // what stands on the track or in place of the wall
  std::vector<Interval> wall_cuts;       // where the wall is taken away: a profile lies below it
  Loop wall_face_mm;                     // of a wall profile: the face, from its first corner to its last
  std::optional<double> blade_mm;        // wiper, hold-down: height over the track
  bool holds_down = false;
};

struct Layout {
  std::vector<LaidFeature> features;
  std::vector<Violation> invalid;  // shapes that the variables made impossible; the others are laid all the same
  double length_mm = 0;
};

// Where profiles take the wall away, ascending: elsewhere nothing of a part comes behind the wall's face.
std::vector<Interval> recesses(const Layout& layout);

// Voids that can act on the part at the same time: all of a track's that lie nearer to each other than reach_mm.
struct VoidGroup {
  std::vector<int> features;  // indices, by position
  std::vector<Loop> loops;    // disjoint, the void to the left
  double origin_mm = 0;       // loops have x from here
};

// Why a polyline is no face of a wall, in words; none if it is one.
std::optional<std::string> profile_defect(const Loop& face);

Layout lay_out(const DesignSpec& design, const Environment& environment, const Manufacture& manufacture,
               double part_diameter_mm, std::span<const double> values);
std::vector<VoidGroup> grouped(const Layout& layout, double reach_mm);
// The same groups; a feature that is one by itself has its own start for the origin, so that the same feature is the
// same loops, bit for bit, wherever it stands.
std::vector<VoidGroup> grouped_in_own_frames(const Layout& layout, double reach_mm);

// Everything that a part can touch, in the world's frame: component 0 is the wall, from x = -far_mm to far_mm and
// without what profiles take away; then come the features' obstacles, in the design's order.
std::vector<ObstacleShape> obstacle_shapes(const Layout& layout, double far_mm);
int feature_of(const Layout& layout, int component);             // the feature's number; -1 for the wall
std::string obstacle_name(const Layout& layout, int component);  // "the wall", "feature 0 (fence)"

}  // namespace formotion::feeder
