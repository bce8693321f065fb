// Poses past groups of voids, each pair by itself: what is known of it is found once, however many tracks hold it.
#pragma once

#include <map>
#include <memory>

#include "applications/feeder/edge_error.hpp"
#include "applications/feeder/track_layout.hpp"
#include "applications/feeder/void_rule.hpp"

namespace formotion::feeder {

// All poses past one group; positions have x from the group's origin.
class GroupPassages {
 public:
  // held: of every pose, from the group's origin.
  GroupPassages(const PartModel& part, std::vector<Loop> loops, std::vector<std::vector<Interval>> held);
  GroupPassages(const GroupPassages&) = delete;

  const VoidOutline& outline() const { return outline_; }
  // Of the whole travel, or the plain track's where that is less.
  const LeastMargin& least(int pose, std::int64_t& sweeps);
  // in_detail: not only the first stretch without support; of one pose always asked for alike.
  const SupportLoss& loss(int pose, bool in_detail);
  // By the void rule, after that loss.
  double shortfall(int pose, double track_width_mm);
  // Of a pose that is kept past these voids, or shall be lost by them.
  EdgeError& error(int pose, bool kept, std::int64_t& sweeps);

 private:
  struct Known {
    std::optional<LeastMargin> least;
    std::optional<SupportLoss> loss;
    std::optional<double> shortfall;
    std::optional<EdgeError> kept, lost;
  };
  const PartModel& part_;
  VoidGroup group_;
  VoidOutline outline_;
  std::vector<std::vector<Interval>> held_;
  std::optional<VoidPieces> pieces_;
  std::vector<Known> known_;  // of every pose
};

// The memory of a feeder with one part: the passages of the groups that it has met.
class Passages final : public Memory {
 public:
  explicit Passages(const PartModel& part) : part_(part) {}
  std::shared_ptr<GroupPassages> past(const VoidGroup& group, const std::vector<std::vector<Interval>>& held);
  std::int64_t sweeps = 0;  // done so far

 private:
  const PartModel& part_;
  std::map<std::vector<double>, std::shared_ptr<GroupPassages>> known_;
};

}  // namespace formotion::feeder
