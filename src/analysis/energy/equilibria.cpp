#include "analysis/energy/equilibria.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "analysis/energy/held_pieces.hpp"

namespace formotion {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSame_mm = 1e-7;
constexpr std::size_t kMostCompared = 400;  // samples of a set, for its size

// No point of the part is farther apart in the two.
double apart(const Configuration& a, const Configuration& b, double reach_mm) {
  return (a.position() - b.position()).norm() + 2 * reach_mm * std::abs(std::sin(0.5 * (a.theta_rad - b.theta_rad)));
}

struct Groups {
  std::vector<std::size_t> parent;
  explicit Groups(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), std::size_t{0}); }
  std::size_t of(std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    i = of(i);
    j = of(j);
    parent[std::max(i, j)] = std::min(i, j);
  }
};

class Sets {
 public:
  Sets(const ContactSpace& space, std::vector<HeldPiece> pieces, double join_mm)
      : part_(space.part), pieces_(without_doubles(std::move(pieces), space.part)), groups_(pieces_.size()) {
    struct End {
      Configuration at;
      std::size_t piece = 0;
    };
    std::vector<End> ends;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      ends.push_back({pieces_[i].samples.front(), i});
      if (pieces_[i].samples.size() > 1) ends.push_back({pieces_[i].samples.back(), i});
    }
    std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.at.x_mm < b.at.x_mm; });
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size() && ends[j].at.x_mm - ends[i].at.x_mm <= join_mm; ++j) {
        if (apart(ends[i].at, ends[j].at, part_.reach_mm) <= join_mm) groups_.join(ends[i].piece, ends[j].piece);
      }
    }
  }

  std::vector<EquilibriumSet> all() {
    std::vector<std::vector<std::size_t>> members(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) members[groups_.of(i)].push_back(i);
    std::vector<EquilibriumSet> sets;
    for (std::vector<std::size_t>& group : members) {
      if (!group.empty()) sets.push_back(set_of(group));
    }
    return sets;
  }

 private:
  // Where more than two features touch along a curve it was found for every two of them.
  static std::vector<HeldPiece> without_doubles(std::vector<HeldPiece> pieces, const MovingShape& part) {
    const auto same = [&](const Configuration& a, const Configuration& b) {
      return std::abs(a.x_mm - b.x_mm) < kSame_mm && apart(a, b, part.reach_mm) < kSame_mm;
    };
    std::vector<HeldPiece> kept;
    for (HeldPiece& piece : pieces) {
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const HeldPiece& other) {
        if (piece.verdict > other.verdict) return false;
        const Configuration &from = other.samples.front(), &to = other.samples.back();
        if (piece.samples.size() == 1) return same(piece.middle, from) || same(piece.middle, to);
        return other.samples.size() > 1 && same(piece.middle, other.middle) &&
               ((same(piece.samples.front(), from) && same(piece.samples.back(), to)) ||
                (same(piece.samples.front(), to) && same(piece.samples.back(), from)));
      });
      if (!known) kept.push_back(std::move(piece));
    }
    return kept;
  }

  EquilibriumSet set_of(std::vector<std::size_t>& group) {
    EquilibriumSet set;
    double longest = -1;
    set.verdict = Verdict::Impossible;
    for (const std::size_t i : group) {
      const HeldPiece& piece = pieces_[i];
      const double length = apart(piece.samples.front(), piece.samples.back(), part_.reach_mm);
      if (piece.verdict < set.verdict || (piece.verdict == set.verdict && length <= longest)) continue;
      set.verdict = piece.verdict;
      set.certain = piece.middle;
      set.certain.theta_rad -= kTurn * std::floor(set.certain.theta_rad / kTurn);
      longest = length;
    }
    chain(group, set.samples);
    set.size_mm = size_of(set.samples);
    return set;
  }

  // One piece after the other, the nearest end next; points that others run through are left out.
  void chain(std::vector<std::size_t>& left, std::vector<Configuration>& samples) const {
    bool turned = false;
    std::size_t next = first_of(left, turned);
    while (true) {
      std::vector<Configuration> piece = pieces_[left[next]].samples;
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(next));
      if (turned) std::reverse(piece.begin(), piece.end());
      const double off = samples.empty()
                             ? -kTurn * std::floor(piece.front().theta_rad / kTurn)
                             : kTurn * std::round((samples.back().theta_rad - piece.front().theta_rad) / kTurn);
      for (Configuration q : piece) {
        q.theta_rad += off;
        if (samples.empty() || apart(samples.back(), q, part_.reach_mm) > 1e-9) samples.push_back(q);
      }
      if (left.empty()) return;
      double nearest = -1;
      for (std::size_t i = 0; i < left.size(); ++i) {
        const std::vector<Configuration>& other = pieces_[left[i]].samples;
        for (const bool backwards : {false, true}) {
          const double d = apart(samples.back(), backwards ? other.back() : other.front(), part_.reach_mm);
          if (nearest >= 0 && d >= nearest) continue;
          nearest = d;
          next = i;
          turned = backwards;
        }
      }
    }
  }

  // A piece with an end that is as far as can be from all others' ends: an end of the chain.
  std::size_t first_of(const std::vector<std::size_t>& group, bool& turned) const {
    std::size_t first = 0;
    double farthest = -1;
    for (std::size_t i = 0; i < group.size(); ++i) {
      const std::vector<Configuration>& samples = pieces_[group[i]].samples;
      if (samples.size() < 2) continue;
      for (const bool backwards : {false, true}) {
        const Configuration& end = backwards ? samples.back() : samples.front();
        double nearest = 1e300;
        for (const std::size_t other : group) {
          if (other == group[i]) continue;
          for (const Configuration& q : {pieces_[other].samples.front(), pieces_[other].samples.back()})
            nearest = std::min(nearest, apart(end, q, part_.reach_mm));
        }
        if (nearest <= farthest) continue;
        farthest = nearest;
        first = i;
        turned = backwards;
      }
    }
    return first;
  }

  double size_of(const std::vector<Configuration>& samples) const {
    // The displacement between two placements is convex over the part: greatest at a convex corner.
    const std::size_t stride = (samples.size() + kMostCompared - 1) / kMostCompared;
    std::vector<std::vector<Point>> corners;
    for (std::size_t i = 0; i < samples.size(); i += stride) {
      corners.emplace_back();
      for (const MovingCorner& corner : part_.corners)
        corners.back().push_back(samples[i].position() + rotated(corner.at, samples[i].theta_rad));
    }
    double size = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t j = i + 1; j < corners.size(); ++j) {
        for (std::size_t k = 0; k < corners[i].size(); ++k)
          size = std::max(size, (corners[i][k] - corners[j][k]).squaredNorm());
      }
    }
    return std::sqrt(size);
  }

  const MovingShape& part_;
  std::vector<HeldPiece> pieces_;
  Groups groups_;
};

}  // namespace

std::vector<EquilibriumSet> equilibria(const ContactSpace& space, const PushSet& push,
                                       const EquilibriaOptions& options) {
  return Sets(space, held_pieces(space, push, options.grid_rad), options.join_mm).all();
}

}  // namespace formotion
