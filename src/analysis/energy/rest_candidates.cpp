#include "analysis/energy/rest_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analysis/contact/contact_curves.hpp"

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSameAngle_rad = 1e-11;
constexpr double kStraight = 1e-12;      // sine: a level edge
constexpr double kSolved_mm = 1e-10;     // a gap that touches zero
constexpr double kPole = 1e-9;           // sine between two normals
constexpr double kNearFactor = 2;        // gaps looked at, over what turning by one slice can close
constexpr std::size_t kMostNear = 12;    // pairs near one lowest position
constexpr double kStep_rad = kPi / 180;  // samples of slopes

double wrapped(double theta) {
  theta = std::fmod(theta, 2 * kPi);
  if (theta < 0) theta += 2 * kPi;
  return theta >= 2 * kPi ? 0 : theta;
}
double angle(const Point& d) { return std::atan2(d.y(), d.x()); }

ContactState state_at(const ContactSpace& space, int pair, const Configuration& q) {
  return contact_state(space.part, space.obstacles, space.pairs[pair], q.position(), std::cos(q.theta_rad),
                       std::sin(q.theta_rad));
}

bool is_round(const ContactSpace& space, int pair) { return space.pairs[pair].kind == ContactKind::CornerOnCorner; }

// How fast the height rises with theta on the curve of two contacts; none where they are parallel.
std::optional<double> slope(const ContactState& a, const ContactState& b, const Gravity& gravity) {
  const double sine = cross(a.normal, b.normal);
  if (std::abs(sine) < kPole) return std::nullopt;
  // a.normal . v = -moment of a, b.normal . v = -moment of b, solved by Cramer's rule.
  const double ma = -cross(a.lever, a.normal), mb = -cross(b.lever, b.normal);
  const Point v((ma * b.normal.y() - mb * a.normal.y()) / sine, (mb * a.normal.x() - ma * b.normal.x()) / sine);
  return gravity.height_mm(v);
}

}  // namespace

RestSlices rest_slices(const ContactSpace& space, const Gravity& gravity, double grid_rad) {
  struct Slice {
    double theta;
    bool special;
  };
  std::vector<Slice> all;
  const int count = std::max(4, static_cast<int>(std::ceil(2 * kPi / std::max(grid_rad, 1e-4) - 1e-9)));
  for (int i = 0; i < count; ++i) all.push_back({2 * kPi * i / count, false});
  bool has_shelf = false;
  for (const MovingEdge& moving : space.part.edges) {
    const double own = angle(moving.normal);
    for (const FixedEdge& fixed : space.obstacles.edges) {
      all.push_back({wrapped(angle(fixed.normal) + kPi - own), true});  // flat
    }
    all.push_back({wrapped(angle(gravity.down) - own), true});
    all.push_back({wrapped(angle(gravity.down) + kPi - own), true});
  }
  for (const FixedEdge& fixed : space.obstacles.edges) {
    has_shelf = has_shelf || fixed.normal.dot(gravity.down) < -1 + kStraight;
  }
  for (const MovingCorner& corner : space.part.corners) {
    if (!has_shelf || corner.at.norm() <= 0) continue;
    all.push_back({wrapped(angle(gravity.down) + kPi - angle(corner.at)), true});
  }
  std::sort(all.begin(), all.end(), [](const Slice& a, const Slice& b) { return a.theta < b.theta; });
  RestSlices slices;
  for (const Slice& slice : all) {
    if (!slices.theta_rad.empty() && slice.theta - slices.theta_rad.back() <= kSameAngle_rad) {
      if (slice.special && !slices.is_special.back()) {
        slices.theta_rad.back() = slice.theta;
        slices.is_special.back() = true;
      }
      continue;
    }
    slices.theta_rad.push_back(slice.theta);
    slices.is_special.push_back(slice.special);
  }
  if (slices.theta_rad.size() > 1 && slices.theta_rad.back() >= 2 * kPi - kSameAngle_rad) {
    if (slices.is_special.back()) slices.is_special.front() = true;
    slices.theta_rad.pop_back();
    slices.is_special.pop_back();
  }
  return slices;
}

RestCandidates::RestCandidates(const ContactSpace& space, const Gravity& gravity, double within_rad)
    : space_(space),
      gravity_(gravity),
      within_rad_(std::clamp(within_rad, 1e-4, kPi / 2)),
      bins_(static_cast<int>(std::ceil(2 * kPi / within_rad_))) {}

void RestCandidates::add(const Point& p, double theta_rad) {
  struct Near {
    int pair;
    ContactState state;
  };
  std::vector<Near> near;
  const double reach = space_.part.reach_mm, within_mm = kNearFactor * reach * within_rad_;
  const double c = std::cos(theta_rad), s = std::sin(theta_rad);
  const Point around = Point::Constant(reach + within_mm);
  for (std::size_t i = 0; i < space_.pairs.size(); ++i) {
    const ContactPair& pair = space_.pairs[i];
    const Box& box =
        pair.kind == ContactKind::CornerOnEdge ? space_.edge_boxes[pair.fixed] : space_.corner_boxes[pair.fixed];
    if (((box.min - p - around).array() > 0).any() || ((p - around - box.max).array() > 0).any()) continue;
    if (!space_.orientations[i].contains(theta_rad, kNearFactor * within_rad_)) continue;
    const ContactState state = contact_state(space_.part, space_.obstacles, pair, p, c, s);
    if (state.gap_mm < -within_mm || state.gap_mm > within_mm) continue;
    if (state.along_mm < -within_mm || state.along_mm > state.extent_mm + within_mm) continue;
    near.push_back({static_cast<int>(i), state});
  }
  if (near.size() > kMostNear) {
    std::stable_sort(near.begin(), near.end(),
                     [](const Near& a, const Near& b) { return std::abs(a.state.gap_mm) < std::abs(b.state.gap_mm); });
    near.resize(kMostNear);
    std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.pair < b.pair; });
  }
  const int bin = std::min(bins_ - 1, static_cast<int>(theta_rad / (2 * kPi) * bins_));
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      twos_.push_back({near[i].pair, near[j].pair});
      for (std::size_t k = j + 1; k < near.size(); ++k) {
        const std::array<int, 3> pairs{near[i].pair, near[j].pair, near[k].pair};
        if (is_round(space_, pairs[0]) || is_round(space_, pairs[1]) || is_round(space_, pairs[2])) {
          for (const int aside : {bins_ - 1, 0, 1}) {
            round_threes_.push_back({pairs[0], pairs[1], pairs[2], (bin + aside) % bins_});
          }
        } else {
          threes_.push_back(pairs);
        }
      }
    }
  }
}

// Roots of the third gap along the curve of the other two. Each is the third in turn: a gap that only touches zero
// along one curve changes its sign along another. Two roots between samples are looked for where the gap is least.
void RestCandidates::meet_round(const std::array<int, 4>& three, std::vector<Configuration>& out) const {
  const double from = 2 * kPi * three[3] / bins_, width = 2 * kPi / bins_;
  const int samples = std::max(2, static_cast<int>(std::ceil(width / kStep_rad)));
  const double step = width / samples, slack = space_.part.reach_mm * step;
  for (int third = 0; third < 3; ++third) {
    const int first = three[(third + 1) % 3], second = three[(third + 2) % 3];
    const int branches = is_round(space_, first) || is_round(space_, second) ? 2 : 1;
    for (int branch = 0; branch < branches; ++branch) {
      const auto place = [&](double theta) -> std::optional<Configuration> {
        const auto at = two_contact_positions(space_.part, space_.obstacles, space_.pairs[first], space_.pairs[second],
                                              std::cos(theta), std::sin(theta));
        if (branch >= at.count) return std::nullopt;
        return Configuration{at.position[branch].x(), at.position[branch].y(), theta};
      };
      const auto gap = [&](double theta) -> std::optional<double> {
        const auto q = place(theta);
        if (!q) return std::nullopt;
        return state_at(space_, three[third], *q).gap_mm;
      };
      const auto bisect = [&](double low, double high, bool negative_low) {
        for (int i = 0; i < 60; ++i) {
          const double middle = 0.5 * (low + high);
          const auto value = gap(middle);
          (value && (*value < 0) == negative_low ? low : high) = middle;
        }
        if (const auto q = place(high)) out.push_back(*q);
      };
      std::array<std::optional<double>, 3> last;  // samples i - 2, i - 1, i
      for (int i = -1; i <= samples + 1; ++i) {
        last = {last[1], last[2], gap(from + i * step)};
        if (!last[1] || !last[2]) continue;
        if ((*last[1] < 0) != (*last[2] < 0)) {
          bisect(from + (i - 1) * step, from + i * step, *last[1] < 0);
          continue;
        }
        const double sign = *last[1] < 0 ? -1 : 1;
        if (!last[0] || (*last[0] < 0) != (*last[1] < 0) || sign * *last[1] > slack) continue;
        if (sign * *last[1] > sign * *last[0] || sign * *last[1] > sign * *last[2]) continue;
        double low = from + (i - 2) * step, high = from + i * step;
        const double begin = low, end = high;
        for (int k = 0; k < 40; ++k) {
          const double a = low + (high - low) / 3, b = high - (high - low) / 3;
          const double at_a = sign * gap(a).value_or(1e300), at_b = sign * gap(b).value_or(1e300);
          (at_a < at_b ? high : low) = at_a < at_b ? b : a;
        }
        const double middle = 0.5 * (low + high);
        if (const auto value = gap(middle); value && sign * *value < 0) {
          bisect(begin, middle, sign < 0);
          bisect(middle, end, sign > 0);
        } else if (value && sign * *value < kSolved_mm) {
          out.push_back(*place(middle));
        }
      }
    }
  }
}

void RestCandidates::least_along(int first, int second, std::vector<Configuration>& out) const {
  const ContactPair &a = space_.pairs[first], &b = space_.pairs[second];
  const auto positions = [&](double theta) {
    return two_contact_positions(space_.part, space_.obstacles, a, b, std::cos(theta), std::sin(theta));
  };
  const auto slope_at = [&](double theta, int branch) -> std::optional<double> {
    const TwoContactPositions at = positions(theta);
    if (branch >= at.count) return std::nullopt;
    const Configuration q{at.position[branch].x(), at.position[branch].y(), theta};
    return slope(state_at(space_, first, q), state_at(space_, second, q), gravity_);
  };
  const DirectionRange& own = space_.orientations[first];
  const double end = own.from_rad + own.width_rad;
  const int branches = is_round(space_, first) || is_round(space_, second) ? 2 : 1;
  const int steps = std::max(4, static_cast<int>(std::ceil(own.width_rad / kStep_rad)));
  for (int branch = 0; branch < branches; ++branch) {
    std::optional<double> before;
    double from = own.from_rad;
    for (int i = 0; i <= steps; ++i) {
      const double theta = i == steps ? end : own.from_rad + own.width_rad * i / steps;
      const std::optional<double> here =
          space_.orientations[second].contains(theta, kStep_rad) ? slope_at(theta, branch) : std::nullopt;
      if (before && here && *before < 0 && *here >= 0) {
        double low = from, high = theta;
        for (int k = 0; k < 60; ++k) {
          const double middle = 0.5 * (low + high);
          const auto value = slope_at(middle, branch);
          (value && *value < 0 ? low : high) = middle;
        }
        const TwoContactPositions at = positions(high);
        if (branch < at.count) out.push_back({at.position[branch].x(), at.position[branch].y(), high});
      }
      before = here;
      from = theta;
    }
  }
}

void RestCandidates::tidy() {
  const auto unique = [](auto& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  unique(twos_);
  unique(threes_);
  unique(round_threes_);
}

std::vector<double> RestCandidates::level_orientations() {
  tidy();
  const auto is_level = [&](int pair) {
    const ContactPair& p = space_.pairs[pair];
    return p.kind == ContactKind::CornerOnEdge &&
           std::abs(space_.obstacles.edges[p.fixed].normal.dot(gravity_.down)) > 1 - kStraight;
  };
  std::vector<double> out;
  for (const auto& [first, second] : twos_) {
    if (!is_level(first) || !is_level(second)) continue;
    for (const double theta :
         horizontal_orientations(space_.part, space_.obstacles, space_.pairs[first], space_.pairs[second])) {
      if (space_.orientations[first].contains(theta, kSameAngle_rad) &&
          space_.orientations[second].contains(theta, kSameAngle_rad)) {
        out.push_back(theta);
      }
    }
  }
  std::sort(out.begin(), out.end());
  const auto same = [](double a, double b) { return b - a <= kSameAngle_rad; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

std::vector<Configuration> RestCandidates::found() {
  tidy();
  std::vector<Configuration> out;
  for (const auto& three : round_threes_) meet_round(three, out);
  for (const auto& [first, second] : twos_) least_along(first, second, out);
  for (const auto& [i, j, k] : threes_) {
    const auto met = three_contacts(space_.part, space_.obstacles, {space_.pairs[i], space_.pairs[j], space_.pairs[k]});
    out.insert(out.end(), met.begin(), met.end());
  }
  return out;
}

}  // namespace formotion
