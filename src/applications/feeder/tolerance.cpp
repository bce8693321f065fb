#include "applications/feeder/tolerance.hpp"

#include <algorithm>
#include <numeric>

namespace formotion::feeder {
namespace {

class Search {
 public:
  Search(const PartModel& part, const Layout& layout, const std::vector<PoseDemand>& demands, Passages& passages)
      : part_(part), layout_(layout), demands_(demands), passages_(passages) {}

  // best if every demand bears it, else the largest that all bear; voids nearer to each other than reach_mm together.
  double run(double best, double reach_mm) {
    groups_.clear();
    for (const VoidGroup& group : grouped_in_own_frames(layout_, reach_mm))
      groups_.push_back(passages_.past(group, held_from(group.origin_mm, part_, layout_)));
    // The poses that look weakest first: the others then need one test each.
    std::vector<int> order(part_.poses.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return demands_[a].nominal_mm < demands_[b].nominal_mm; });
    for (const int pose : order) {
      if (best <= 0) break;
      if (!demands_[pose].counts) continue;
      best = demands_[pose].kept ? kept(pose, best) : lost(pose, best);
    }
    return std::max(best, 0.0);
  }

 private:
  double kept(int pose, double best) {
    for (const auto& group : groups_) {
      EdgeError& error = group->error(pose, true, passages_.sweeps);
      if (!error.bears(best, passages_.sweeps)) best = error.largest(passages_.sweeps);
    }
    return best;
  }

  // One group, one blade or the plain track is enough to lose it.
  double lost(int pose, double best) {
    const PoseModel& model = part_.poses[pose];
    double largest = std::max(-model.travelling.plain_margin_mm, -blade_clearance(model, layout_));
    if (largest >= best) return best;
    for (const auto& group : groups_) {
      if (group->error(pose, false, passages_.sweeps).bears(best, passages_.sweeps)) return best;
    }
    for (const auto& group : groups_)
      largest = std::max(largest, group->error(pose, false, passages_.sweeps).largest(passages_.sweeps));
    return largest;
  }

  const PartModel& part_;
  const Layout& layout_;
  const std::vector<PoseDemand>& demands_;
  Passages& passages_;
  std::vector<std::shared_ptr<GroupPassages>> groups_;
};

}  // namespace

std::vector<Interval> held_intervals(const PoseModel& pose, const Layout& layout) {
  std::vector<Interval> held;
  for (const LaidFeature& feature : layout.features) {
    if (!feature.holds_down || pose.height_mm > *feature.blade_mm) continue;
    if (*feature.blade_mm >= 2 * pose.height_mm) continue;
    const Interval under{feature.start_mm - pose.x_min, feature.end_mm - pose.x_max};
    if (under.from < under.to) held.push_back(under);
  }
  return held;
}

std::vector<std::vector<Interval>> held_from(double origin_mm, const PartModel& part, const Layout& layout) {
  std::vector<std::vector<Interval>> held;
  for (const PoseModel& pose : part.poses) {
    held.push_back(held_intervals(pose, layout));
    for (Interval& stretch : held.back()) stretch = {stretch.from - origin_mm, stretch.to - origin_mm};
  }
  return held;
}

double blade_clearance(const PoseModel& pose, const Layout& layout) {
  double clearance = std::numeric_limits<double>::infinity();
  for (const LaidFeature& feature : layout.features) {
    if (feature.blade_mm) clearance = std::min(clearance, *feature.blade_mm - pose.height_mm);
  }
  return clearance;
}

double tolerance(const PartModel& part, const Layout& layout, const std::vector<PoseDemand>& demands,
                 Passages& passages, double at_most_mm) {
  Search search(part, layout, demands, passages);
  double best = at_most_mm;
  for (const PoseDemand& demand : demands) {
    if (demand.counts) best = std::min(best, demand.nominal_mm);
  }
  best = search.run(best, part.longest_mm);
  // Growing brings voids nearer to each other: those that could then act together are looked at together.
  const double reach = part.longest_mm + 2.2 * best;
  if (best > 0 && grouped(layout, reach).size() != grouped(layout, part.longest_mm).size())
    best = search.run(best, reach);
  return best;
}

}  // namespace formotion::feeder
