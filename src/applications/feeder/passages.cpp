#include "applications/feeder/passages.hpp"

#include <algorithm>
#include <limits>

namespace formotion::feeder {
namespace {

constexpr std::size_t kMostGroups = 256;  // more are forgotten: a local search soon asks for other ones

std::vector<double> key_of(const VoidGroup& group, const std::vector<std::vector<Interval>>& held) {
  std::vector<double> key;
  for (const Loop& loop : group.loops) {
    key.push_back(static_cast<double>(loop.size()));
    for (const Point& p : loop) {
      key.push_back(p.x());
      key.push_back(p.y());
    }
  }
  for (std::size_t pose = 0; pose < held.size(); ++pose) {
    for (const Interval& stretch : held[pose]) {
      key.push_back(static_cast<double>(pose));
      key.push_back(stretch.from);
      key.push_back(stretch.to);
    }
  }
  return key;
}

}  // namespace

GroupPassages::GroupPassages(const PartModel& part, std::vector<Loop> loops, std::vector<std::vector<Interval>> held)
    : part_(part),
      group_{{}, std::move(loops)},
      outline_(VoidOutline::of(group_.loops)),
      held_(std::move(held)),
      known_(part.poses.size()) {}

const LeastMargin& GroupPassages::least(int pose, std::int64_t& sweeps) {
  Known& known = known_[pose];
  if (!known.least) {
    ++sweeps;
    const TravellingPart& travelling = part_.poses[pose].travelling;
    // Below the plain margin something is lost before the voids come; then they can only make it worse.
    known.least = least_margin({travelling, outline_, held_[pose]}, -std::numeric_limits<double>::infinity(),
                               travelling.plain_margin_mm);
  }
  return *known.least;
}

const SupportLoss& GroupPassages::loss(int pose, bool in_detail) {
  Known& known = known_[pose];
  if (!known.loss) known.loss = support_loss({part_.poses[pose].travelling, outline_, held_[pose]}, !in_detail);
  return *known.loss;
}

double GroupPassages::shortfall(int pose, double track_width_mm) {
  Known& known = known_[pose];
  if (!pieces_) pieces_ = void_pieces(group_, track_width_mm);
  if (!known.shortfall) known.shortfall = fall_shortfall(part_.poses[pose], *known.loss, *pieces_, track_width_mm);
  return *known.shortfall;
}

EdgeError& GroupPassages::error(int pose, bool kept, std::int64_t& sweeps) {
  std::optional<EdgeError>& error = kept ? known_[pose].kept : known_[pose].lost;
  if (!error) {
    const double margin = least(pose, sweeps).margin_mm;
    error.emplace(GroupTravel{part_.poses[pose], group_.loops, held_[pose]}, kept,
                  kept ? margin : std::min(-margin, part_.diameter_mm));
  }
  return *error;
}

std::shared_ptr<GroupPassages> Passages::past(const VoidGroup& group, const std::vector<std::vector<Interval>>& held) {
  std::vector<double> key = key_of(group, held);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  if (known_.size() >= kMostGroups) known_.clear();
  auto passages = std::make_shared<GroupPassages>(part_, group.loops, held);
  known_.emplace(std::move(key), passages);
  return passages;
}

}  // namespace formotion::feeder
