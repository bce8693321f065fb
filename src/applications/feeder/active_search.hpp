// Which piece decides: the answers of the exact analysis, traced back to corners and edges as written.
#pragma once

#include "analysis/constraints/planar_support.hpp"
#include "applications/feeder/active_pieces.hpp"
#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"
#include "applications/feeder/world.hpp"

namespace formotion::feeder {

struct ActiveAnswer {
  std::optional<double> mm;    // as the exact analysis says; none where nothing of the part is on the track
  std::optional<Piece> piece;  // none where what decides is no written corner or edge (an arc, a cutter's rounding)
};

// Written features of one aspect and one design, found by where they are. The shapes must outlive it.
class ActiveSearch {
 public:
  ActiveSearch(const TracedShapes<double>& shapes, double track_width_mm)
      : shapes_(shapes), track_width_mm_(track_width_mm) {}

  // The clearance at q among the world's obstacles.
  ActiveAnswer clearance(const World& world, const Configuration& q) const;
  // The margin at q on the track.
  ActiveAnswer support(const AspectShape& shape, const Track& track, const Environment& environment,
                       const Configuration& q) const;
  // The least margin of a pose's travel past voids that were grown (or, less than 0, shrunk) by grow_mm. voids: their
  // loops, void on the left.
  std::optional<Piece> travel(const PoseModel& pose, const AspectShape& shape, const Environment& environment,
                              const std::vector<Loop>& voids, double grow_mm, const LeastMargin& least) const;

 private:
  std::optional<GapRef> gap_of(const World& world, const ContactPair& pair) const;
  std::optional<CornerRef> corner_at(Body body, const Point& p, const Configuration& q) const;
  std::optional<LineRef> edge_at(Body body, const Point& p, const Configuration& q) const;
  std::optional<LineRef> grown_edge(const Point& from, const Point& to, double grow_mm) const;
  std::optional<PointRef> generator_at(const Point& p, const Configuration& q, const std::vector<Loop>& voids,
                                       double grow_mm) const;
  std::optional<GapRef> event_at(const Configuration& q, const std::vector<Loop>& voids, double grow_mm) const;
  const std::vector<TracedLoop<double>>& loops(Body body) const;
  // The k-th corner of a loop, in the world.
  Point world_corner(Body body, const TracedLoop<double>& loop, std::size_t k, const Configuration& q) const;

  const TracedShapes<double>& shapes_;
  double track_width_mm_;
};

}  // namespace formotion::feeder
