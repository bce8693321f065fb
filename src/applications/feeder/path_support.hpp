// Support of a part that turns on its way: is it held up all along its path, and where is that first lost?
//
// Translations are decided exactly (support_travel.hpp, in a frame with x along the motion). Turning pieces are decided
// by halving: metal that is still there when every void and rim is grown by d supports a part whose points move by less
// than d, if the margin on it is at least 2 d; a configuration that is not supported is a loss. Pieces over which the
// part moves by less than kLeastPiece_mm and that are neither are decided by their ends: marginal.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "analysis/constraints/planar_support.hpp"
#include "analysis/motion/projection.hpp"
#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"

namespace formotion::feeder {

inline constexpr double kLeastPiece_mm = 0.002;

// A track's floor, prepared for paths.
struct Floor {
  std::vector<VoidGroup> groups;
  std::vector<Box> boxes;  // of the groups
  double width_mm = 0;
  std::vector<Interval> recesses;  // of the wall: elsewhere nothing of a part can come behind its face
  // By how far everything is grown: the floor that is left. Made when asked for.
  const Track& eroded(double by_mm) const;

  static Floor of(std::vector<VoidGroup> groups, double width_mm, std::vector<Interval> recesses);

 private:
  mutable std::map<double, Track> eroded_;
};

struct PathLoss {
  Configuration at;
  SupportLoss loss;  // positions relative to the supported point; x_mm as of the centre of mass
  int group = -1;    // index into Floor::groups; -1: beyond the free edge or behind the wall's face
  double depth_mm = 0;
};

// Sees the stretches of one part's path (as a PathWatch) and ends it where support is lost.
class PathSupport {
 public:
  PathSupport(const AspectShape& shape, const Floor& floor, const Environment& environment);

  // A fraction of the stretch where support is lost first.
  std::optional<double> operator()(const PathStretch& stretch);

  double least_margin_mm() const { return least_; }  // so far, where decided; infinite before the first stretch
  const std::vector<PathLoss>& losses() const { return losses_; }
  bool marginal() const { return marginal_; }

 private:
  std::optional<double> translate(const Configuration& from, const Configuration& to);
  std::optional<double> turn(const PathStretch& stretch, double from, double to, const Configuration& a,
                             const Configuration& b);
  double margin_on(const Track& track, const Configuration& q) const;
  double plain_margin(double theta_rad) const;
  double farthest_move(const Configuration& a, const Configuration& b) const;
  bool stands_clear(const Configuration& a, const Configuration& b) const;
  int group_under(const Configuration& q) const;
  void lose(const Configuration& q, SupportLoss loss, double depth);

  const AspectShape& shape_;
  const Floor& floor_;
  Environment environment_;
  double shift_ = 0, reach_ = 0, plain_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
  bool marginal_ = false;
  std::vector<PathLoss> losses_;
};

}  // namespace formotion::feeder
