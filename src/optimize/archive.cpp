#include "optimize/archive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace formotion {

bool dominates(std::span<const double> a, std::span<const double> b) {
  bool better = false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k] > b[k]) return false;
    better = better || a[k] < b[k];
  }
  return better;
}

// Whether a's box is nowhere worse than b's: then b adds nothing that the resolution lets a user see.
bool Archive::in_dominating_box(const Member& a, const Member& b) const {
  for (std::size_t k = 0; k < a.losses.size(); ++k) {
    const double r = resolutions_[k];
    const double box_a = r > 0 ? std::floor(a.losses[k] / r) : a.losses[k];
    const double box_b = r > 0 ? std::floor(b.losses[k] / r) : b.losses[k];
    if (box_a > box_b) return false;
  }
  return true;
}

// The best in some objective; of equal ones the one that is best in the others, in order.
bool Archive::is_extreme(const Member& member) const {
  for (std::size_t k = 0; k < member.losses.size(); ++k) {
    const bool best = std::all_of(members_.begin(), members_.end(), [&](const Member& other) {
      return other.losses[k] > member.losses[k] ||
             (other.losses[k] == member.losses[k] && !(other.losses < member.losses));
    });
    if (best) return true;
  }
  return false;
}

bool Archive::offer(std::int64_t number, std::span<const double> losses) {
  Member offered{number, {losses.begin(), losses.end()}};
  for (const Member& member : members_) {
    if (member.losses == offered.losses || dominates(member.losses, offered.losses)) return false;
  }
  std::erase_if(members_, [&](const Member& member) { return dominates(offered.losses, member.losses); });
  members_.push_back(offered);
  // Boxes: newcomers give way to older members, except at the extremes.
  std::vector<Member> kept;
  for (const Member& member : members_) {
    const bool covered =
        std::any_of(kept.begin(), kept.end(), [&](const Member& other) { return in_dominating_box(other, member); });
    if (!covered || is_extreme(member)) kept.push_back(member);
  }
  // A kept newcomer may cover older ones in turn.
  std::vector<Member> last;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const bool covered = i + 1 < kept.size() && kept.back().number == number &&
                         in_dominating_box(kept.back(), kept[i]) && !in_dominating_box(kept[i], kept.back());
    if (!covered || is_extreme(kept[i])) last.push_back(kept[i]);
  }
  members_.swap(last);
  thin();
  return !members_.empty() && members_.back().number == number;
}

void Archive::thin() {
  while (members_.size() > capacity_) {
    // Crowding distance: the sum over objectives of the gap between the two neighbours, in units of the range.
    std::vector<double> room(members_.size(), 0);
    std::vector<std::size_t> order(members_.size());
    for (std::size_t k = 0; k < resolutions_.size(); ++k) {
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return members_[a].losses[k] < members_[b].losses[k]; });
      const double range = members_[order.back()].losses[k] - members_[order.front()].losses[k];
      for (std::size_t i = 1; range > 0 && i + 1 < order.size(); ++i) {
        room[order[i]] += (members_[order[i + 1]].losses[k] - members_[order[i - 1]].losses[k]) / range;
      }
    }
    std::size_t victim = members_.size();
    for (std::size_t i = 0; i < members_.size(); ++i) {
      if (is_extreme(members_[i])) continue;
      if (victim == members_.size() || room[i] <= room[victim]) victim = i;
    }
    if (victim == members_.size()) return;
    members_.erase(members_.begin() + static_cast<std::ptrdiff_t>(victim));
  }
}

}  // namespace formotion
