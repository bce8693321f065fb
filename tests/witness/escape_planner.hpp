// Looks for low ways out of a nest by samples, as motion planners do: a slow judge of escape heights that shares no
// code with them. What it finds is proved, what it does not find proves nothing.
//
// Roadmaps (Kavraki et al. 1996) of free configurations below a level. Samples are drawn everywhere, about what is
// known, about hints and about the highest place of the best way so far, at many scales; most are then lowered to a
// contact or, in their own orientation, to where they lie on two. As soon as a way out is known the level sinks to
// its highest place, and all goes on below it.
#pragma once

#include <cstdint>
#include <vector>

#include "analysis/contact/shapes.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::witness {

// A part among fixed shapes by the distances of their edges. Gravity is along -y.
class PlannedNest {
 public:
  // Discs and grown shapes are round, exactly. Frame of the part: its centre of mass.
  PlannedNest(const Polygon& part, const std::vector<ObstacleShape>& fixed, double grow_mm);

  // The distance; 0 where they overlap or touch.
  double clearance_mm(const Configuration& q) const;
  // No point of the part moves farther than this between the two, by the straight motion and the shorter turn.
  double way_mm(const Configuration& a, const Configuration& b) const;
  // The straight motion, the shorter turn: proved from clearances where piece_mm is twice margin_mm or less; else
  // pieces of up to piece_mm are taken as free if their ends are, by the margin. False where most looks do not decide.
  bool is_motion_free(const Configuration& a, const Configuration& b, double margin_mm, double piece_mm,
                      long most_looks) const;
  double reach_mm() const { return reach_mm_; }
  long looks() const { return looks_; }

 private:
  struct Body {
    std::vector<Point> from, to;  // of its edges
    Polygon area;                 // none for discs
    double radius_mm = 0;
    Box box;
  };
  std::vector<Point> corners_;                              // of the part
  std::vector<std::pair<std::size_t, std::size_t>> edges_;  // places in corners_
  Polygon part_;
  std::vector<Body> bodies_;
  double reach_mm_ = 0;
  mutable long looks_ = 0;
};

struct WayQuestion {
  Configuration start;
  double from_mm = 0, to_mm = 0;    // out: the centre of mass is beyond these
  double below_mm = 0;              // heights are less than this
  std::vector<Configuration> hint;  // the way of somebody else: samples are drawn about it
  long free_samples = 20000;
  std::uint64_t seed = 1;
};

struct FoundWay {
  bool got_out = false;
  double highest_mm = 0;            // of the path
  std::vector<Configuration> path;  // from the start, every motion proved free
  long free_samples = 0;
};

FoundWay look_for_way(const PlannedNest& nest, const WayQuestion& question);

// Sinks by random free moves until none of many lowers it.
Configuration sunk(const PlannedNest& nest, const Configuration& start, Random& random);

}  // namespace formotion::witness
