// The largest scaled box of one outcome in a region of start errors (success_region.hpp).
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/insertion/success_region.hpp"

namespace formotion {
namespace {

constexpr int kPointsASide = 17;
constexpr int kMostRounds = 200;
constexpr double kLeastStep = 1e-3;  // between starts looked at on a side, as a share of half of it

struct Place {
  double u = 0, v = 0;
};

// Places as multiples of the box's half sides from its middle; a side that is a single value counts for nothing.
struct Scale {
  Place middle, half;
  explicit Scale(const ErrorBox& box)
      : middle{box.u_min + (box.u_max - box.u_min) / 2, box.v_min + (box.v_max - box.v_min) / 2},
        half{(box.u_max - box.u_min) / 2, (box.v_max - box.v_min) / 2} {}
  double across(double v) const { return half.v > 0 ? (v - middle.v) / half.v : 0; }
  // Of the interval's nearest point.
  double along(double from, double to) const {
    return half.u > 0 ? (std::clamp(middle.u, from, to) - middle.u) / half.u : 0;
  }
};

double size_of(const Place& scaled) { return std::max(std::abs(scaled.u), std::abs(scaled.v)); }

// The place nearest to the middle at which the located rows have another outcome.
Place nearest_on_rows(const OutcomeRegion& region, int outcome, const Scale& scale) {
  Place nearest{2, 2};
  for (const RegionRow& row : region.rows) {
    for (const RegionInterval& interval : row.intervals) {
      if (interval.outcome == outcome) continue;
      const Place place{scale.along(interval.from, interval.to), scale.across(row.v)};
      if (size_of(place) < size_of(nearest)) nearest = place;
    }
  }
  return nearest;
}

// The same between rows of one sequence, by interpolation.
Place nearest_between_rows(const OutcomeRegion& region, int outcome, const Scale& scale) {
  Place nearest{2, 2};
  for (std::size_t i = 0; i + 1 < region.rows.size(); ++i) {
    const RegionRow &a = region.rows[i], &b = region.rows[i + 1];
    if (a.intervals.size() != b.intervals.size()) continue;
    for (std::size_t k = 0; k < a.intervals.size(); ++k) {
      const RegionInterval &low = a.intervals[k], &high = b.intervals[k];
      if (low.outcome == outcome || low.outcome != high.outcome) continue;
      const auto at = [&](double t) {
        return Place{scale.along(low.from + t * (high.from - low.from), low.to + t * (high.to - low.to)),
                     scale.across(a.v + t * (b.v - a.v))};
      };
      double from = 0, to = 1;  // the size is convex in t
      for (int step = 0; step < 60; ++step) {
        const double first = from + (to - from) / 3, second = to - (to - from) / 3;
        if (size_of(at(first)) <= size_of(at(second))) {
          to = second;
        } else {
          from = first;
        }
      }
      if (size_of(at(from)) < size_of(nearest)) nearest = at(from);
    }
  }
  return nearest;
}

class BoxPolisher {
 public:
  BoxPolisher(const OutcomeRegion& region, int outcome, const std::function<StartOutcome(double u, double v)>& at,
              const RegionOptions& options)
      : region_(region), outcome_(outcome), at_(at), options_(options), scale_(region.box) {}

  double largest() const {
    if (!holds({0, 0})) return 0;
    const Place on_rows = nearest_on_rows(region_, outcome_, scale_);
    double k = std::min(1.0, size_of(on_rows));
    const Place guess = nearest_between_rows(region_, outcome_, scale_);
    if (size_of(guess) < k) k = just_inside(guess, k);
    Place last = guess;
    for (int round = 0; round < kMostRounds && k > options_.boundary; ++round) {
      const Place bad = another_outcome_at(k, last);
      if (size_of(bad) > 1) return k;
      k = std::min(k - options_.boundary, change_on_ray(bad));
      last = bad;
    }
    return k <= options_.boundary ? 0 : k;
  }

 private:
  bool holds(const Place& scaled) const {
    return at_(scale_.middle.u + scaled.u * scale_.half.u, scale_.middle.v + scaled.v * scale_.half.v).outcome ==
           outcome_;
  }
  // The size at which the way from the middle out to a bad place leaves the outcome.
  double change_on_ray(const Place& bad) const {
    double good = 0, wrong = 1;
    while ((wrong - good) * size_of(bad) > options_.boundary) {
      const double t = good + (wrong - good) / 2;
      (holds({t * bad.u, t * bad.v}) ? good : wrong) = t;
    }
    return good * size_of(bad);
  }
  // Near an interpolated place: the change on its ray, or most if there is none up to that size.
  double just_inside(const Place& guess, double most) const {
    const double size = size_of(guess);
    if (size == 0) return most;
    for (double share = 2 * options_.row_error; size * (1 + share) < most; share *= 2) {
      const Place place{guess.u * (1 + share), guess.v * (1 + share)};
      if (!holds(place)) return change_on_ray(place);
    }
    return most;
  }
  // A place of another outcome on the sides of the box scaled by a little less than k; beyond 1 if there is none. Near
  // the last one found starts are closer together: a bump that the first ray met aside of its top is followed to it.
  Place another_outcome_at(double k, const Place& last) const {
    const double side = k >= 1 ? 1 : std::max(0.0, k - options_.boundary);
    for (int i = 0; i < kPointsASide; ++i) {
      const double along = side * (2.0 * i / (kPointsASide - 1) - 1);
      for (const double across : {-side, side}) {
        if (!holds({across, along})) return {across, along};
        if (!holds({along, across})) return {along, across};
      }
    }
    if (size_of(last) > 1) return {2, 2};
    const bool on_u = std::abs(last.u) >= std::abs(last.v);
    const double across = std::copysign(side, on_u ? last.u : last.v), middle = on_u ? last.v : last.u;
    for (double step = side / kPointsASide; step > kLeastStep * side; step /= 2) {
      for (const double along : {middle - step, middle + step}) {
        const double kept = std::clamp(along, -side, side);
        const Place place = on_u ? Place{across, kept} : Place{kept, across};
        if (!holds(place)) return place;
      }
    }
    return {2, 2};
  }

  const OutcomeRegion& region_;
  int outcome_;
  const std::function<StartOutcome(double u, double v)>& at_;
  const RegionOptions& options_;
  Scale scale_;
};

}  // namespace

double largest_scaled_box(const OutcomeRegion& region, int outcome,
                          const std::function<StartOutcome(double u, double v)>& at, const RegionOptions& options) {
  return BoxPolisher(region, outcome, at, options).largest();
}

}  // namespace formotion
