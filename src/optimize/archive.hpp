// The Pareto archive: which of the evaluated designs nobody need look past.
#pragma once

#include <span>
#include <vector>

#include "optimize/evaluated.hpp"

namespace formotion {

// Whether losses a are nowhere worse than b and somewhere better.
bool dominates(std::span<const double> a, std::span<const double> b);

// Non-dominated designs by given losses (all to be minimised), thinned to a resolution: of designs in one box of the
// objectives' resolutions, and of boxes that dominate each other, one is kept (Laumanns, Thiele, Deb, Zitzler 2002);
// the best design of every objective is kept exactly. Beyond `capacity` the most crowded ones go (Deb 2002).
// A pure function of the sequence of offers.
class Archive {
 public:
  struct Member {
    std::int64_t number = 0;  // of the evaluation
    std::vector<double> losses;
  };

  Archive(std::vector<double> resolutions, std::size_t capacity)
      : resolutions_(std::move(resolutions)), capacity_(capacity) {}

  // Offers in ascending numbers. Returns whether it was taken in.
  bool offer(std::int64_t number, std::span<const double> losses);
  // Ascending numbers; nobody dominates anybody.
  const std::vector<Member>& members() const { return members_; }

 private:
  bool in_dominating_box(const Member& a, const Member& b) const;
  bool is_extreme(const Member& member) const;
  void thin();

  std::vector<double> resolutions_;
  std::size_t capacity_;
  std::vector<Member> members_;
};

}  // namespace formotion
