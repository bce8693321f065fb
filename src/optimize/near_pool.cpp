#include "optimize/near_pool.hpp"

#include <algorithm>
#include <cmath>

namespace formotion {

void NearPool::offer(Member member) {
  if (members_.size() == capacity_ && member.violation >= members_.back().violation) return;
  const auto near = [&](const Member& other) {
    for (std::size_t i = 0; i < member.unit.size(); ++i) {
      if (std::abs(member.unit[i] - other.unit[i]) >= radius_) return false;
    }
    return true;
  };
  for (const Member& other : members_) {
    if (other.violation <= member.violation && near(other)) return;
  }
  std::erase_if(members_, near);  // all of them worse
  const auto at = std::upper_bound(members_.begin(), members_.end(), member.violation,
                                   [](double violation, const Member& other) { return violation < other.violation; });
  members_.insert(at, std::move(member));
  if (members_.size() > capacity_) members_.pop_back();
}

}  // namespace formotion
