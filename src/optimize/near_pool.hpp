// Infeasible candidates worth repairing: the nearest ones to feasibility, from different places.
#pragma once

#include <cstdint>
#include <vector>

namespace formotion {

// Keeps at most `capacity` members, the least violations first; of those nearer to each other than `radius` (largest
// difference of unit coordinates) only the best. A pure function of the sequence of offers.
class NearPool {
 public:
  struct Member {
    std::int64_t number = 0;  // of the evaluation
    std::vector<double> unit;
    double violation = 0;
  };

  NearPool(std::size_t capacity, double radius) : capacity_(capacity), radius_(radius) {}

  void offer(Member member);
  const std::vector<Member>& members() const { return members_; }  // ascending violations

 private:
  std::size_t capacity_;
  double radius_;
  std::vector<Member> members_;
};

}  // namespace formotion
