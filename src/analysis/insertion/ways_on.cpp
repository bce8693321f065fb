#include "analysis/insertion/ways_on.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/motion/path_step.hpp"

namespace formotion {
namespace {

constexpr double kContinuous_mm = 5e-3;  // the part's way in a look-ahead: more is a snap
constexpr double kJump_mm = 1e-7;        // the same: less is none
constexpr double kOverlap_mm = 1e-9;     // of contacts that do not carry, in a look-ahead
constexpr double kSameWay_mm = 1e-9;     // between continuations, in a look-ahead
constexpr std::size_t kMostTouches = 6;  // 4^k modes

constexpr ContactMode kModes[]{ContactMode::SlideLeft, ContactMode::SlideRight, ContactMode::Stick};

// By the motion's own size: the law's tolerance is one of forces, and where they all but balance the motion is small.
bool does_as_modes_say(const std::vector<ContactPoint>& points, const Motion& motion, double slow) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double slip = sliding_speed(points[i], motion.twist);
    const bool is_against =
        (motion.modes[i] == ContactMode::SlideLeft && slip < -slow) ||
        (motion.modes[i] == ContactMode::SlideRight && slip > slow) ||
        (motion.modes[i] == ContactMode::Break && separation_speed(points[i], motion.twist) < -slow);
    if (is_against) return false;
  }
  return true;
}

// Visits every choice of one touch a cluster.
template <class Visit>
void for_alternatives(const std::vector<TouchCluster>& clusters, const Visit& visit) {
  std::vector<std::size_t> chosen(clusters.size(), 0);
  for (;;) {
    std::vector<ContactPoint> points;
    std::vector<ContactPair> pairs;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      points.push_back(point_of(clusters[i][chosen[i]].state));
      pairs.push_back(clusters[i][chosen[i]].pair);
    }
    if (points.size() <= kMostTouches) visit(points, pairs);
    std::size_t i = 0;
    while (i < chosen.size() && ++chosen[i] == clusters[i].size()) chosen[i++] = 0;
    if (i == chosen.size()) return;
  }
}

}  // namespace

MotionLaw WaysOn::law(const Configuration& q, const Eigen::Vector3d& carrier) const {
  MotionLaw pulled;
  pulled.load = spring_load(stiffness_, carrier, q);
  pulled.mobility = stiffness_.cwiseInverse().asDiagonal();
  pulled.friction = friction_;
  pulled.length_mm = space_.part.gyration_mm;
  return pulled;
}

double WaysOn::scaled_size(const Eigen::Vector3d& v) const {
  return std::hypot(v[0], v[1], v[2] * space_.part.gyration_mm);
}

std::vector<Continuation> WaysOn::continuous(const Configuration& q, const CarrierLine& line, double ahead,
                                             int& solves) const {
  const std::vector<TouchCluster> clusters = touches_at(space_, q);
  std::vector<Continuation> found;
  std::vector<int> chosen(clusters.size(), -1);  // -1: the cluster carries nothing
  for (;;) {
    try_choice(q, clusters, chosen, line, ahead, found, solves);
    std::size_t i = 0;
    while (i < chosen.size() && ++chosen[i] == static_cast<int>(clusters[i].size())) chosen[i++] = -1;
    if (i == chosen.size()) break;
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Continuation& a, const Continuation& b) { return a.reserve > b.reserve; });
  std::vector<Continuation> ways;
  for (Continuation& way : found) {
    if (std::none_of(ways.begin(), ways.end(), [&](const Continuation& known) {
          return chord(known.ahead, way.ahead, space_.part.reach_mm) <= kSameWay_mm;
        }))
      ways.push_back(std::move(way));
  }
  if (clusters.size() > 1 && held(q, line.at(ahead))) {
    const bool known = std::any_of(ways.begin(), ways.end(), [&](const Continuation& way) {
      return chord(way.ahead, q, space_.part.reach_mm) <= kSameWay_mm;
    });
    if (!known) ways.push_back({std::nullopt, q, 0});
  }
  return ways;
}

void WaysOn::try_choice(const Configuration& q, const std::vector<TouchCluster>& clusters,
                        const std::vector<int>& chosen, const CarrierLine& line, double ahead,
                        std::vector<Continuation>& found, int& solves) const {
  std::vector<ContactPair> pairs;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] >= 0) pairs.push_back(clusters[i][chosen[i]].pair);
  }
  if (pairs.size() > 2) return;  // more leave no freedom
  const int mode_count = friction_ > 0 ? 3 : 1;
  std::vector<int> digits(pairs.size(), 0);
  for (;;) {
    std::vector<ContactMode> modes;
    for (const int digit : digits) modes.push_back(kModes[digit]);
    const auto sticking = std::count(modes.begin(), modes.end(), ContactMode::Stick);
    if (static_cast<long>(pairs.size()) + sticking <= 2) {
      try_leg(q, clusters, chosen, pairs, modes, line, ahead, found, solves);
    }
    std::size_t i = 0;
    while (i < digits.size() && ++digits[i] == mode_count) digits[i++] = 0;
    if (i == digits.size()) return;
  }
}

void WaysOn::try_leg(const Configuration& q, const std::vector<TouchCluster>& clusters, const std::vector<int>& chosen,
                     const std::vector<ContactPair>& pairs, const std::vector<ContactMode>& modes,
                     const CarrierLine& line, double ahead, std::vector<Continuation>& found, int& solves) const {
  CompliantLeg leg(space_, stiffness_, friction_, line, pairs, modes, q);
  const Configuration next = leg.at(ahead);
  const double reach = space_.part.reach_mm, moved = std::isfinite(next.x_mm) ? chord(next, q, reach) : kContinuous_mm;
  // A way that goes on smoothly goes about as far as its rate there says, one that begins as a square root twice as
  // far.
  bool jumps = true;
  if (moved < kContinuous_mm) {
    const Twist rate = leg.rate(ahead, next);
    jumps = moved > kJump_mm + 2.2 * ahead * std::hypot(rate.linear.x(), rate.linear.y(), reach * rate.angular);
  }
  if (!jumps) {
    const double reserve = leg.reserve(ahead);
    if (reserve >= -kLegReserve && stays_free(clusters, chosen, next)) {
      leg.restart(ahead);
      solves += leg.solves();
      found.push_back({std::move(leg), next, reserve});
      return;
    }
  }
  solves += leg.solves();
}

bool WaysOn::stays_free(const std::vector<TouchCluster>& clusters, const std::vector<int>& chosen,
                        const Configuration& next) const {
  const double c = std::cos(next.theta_rad), s = std::sin(next.theta_rad);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    if (chosen[i] >= 0) continue;
    double widest = -std::numeric_limits<double>::infinity();
    for (const Touch& touch : clusters[i]) {
      const ContactState then = contact_state(space_.part, space_.obstacles, touch.pair, next.position(), c, s);
      widest = std::max(widest, then.gap_mm - std::min(0.0, touch.state.gap_mm));
    }
    if (widest < -kOverlap_mm) return false;
  }
  return true;
}

std::vector<FirstMotion> WaysOn::first_motions(const Configuration& q, const Eigen::Vector3d& carrier) const {
  const MotionLaw pulled = law(q, carrier);
  std::vector<FirstMotion> exact, all;
  const auto add = [&](std::vector<FirstMotion>& found, const FirstMotion& motion) {
    const double size = scaled_size(motion.velocity);
    for (FirstMotion& known : found) {
      const double other = scaled_size(known.velocity), apart = scaled_size(known.velocity - motion.velocity);
      // About a corner that rolls friction may be anything, and the speed with it: the fastest stands for them.
      const bool rolls =
          known.pairs == motion.pairs && scaled_size(known.velocity / other - motion.velocity / size) < 1e-6;
      if (apart >= 1e-6 * size && !rolls) continue;
      if (rolls && size > other) known = motion;
      return;
    }
    found.push_back(motion);
  };
  const auto add_all = [&](const std::vector<ContactPoint>& points, const std::vector<ContactPair>& pairs) {
    for (const Motion& motion : consistent_motions(points, pulled)) {
      if (motion.at_rest()) continue;
      FirstMotion first{{motion.twist.linear.x(), motion.twist.linear.y(), motion.twist.angular}, {}, {}};
      const double size = scaled_size(first.velocity);
      if (size < 1e-9) continue;
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (motion.modes[i] == ContactMode::Break) continue;
        first.pairs.push_back(pairs[i]);
        first.modes.push_back(motion.modes[i]);
      }
      add(all, first);
      if (does_as_modes_say(points, motion, 1e-6 * size)) add(exact, first);
    }
  };
  for_alternatives(touches_at(space_, q), add_all);
  return exact.empty() ? all : exact;
}

std::optional<Continuation> WaysOn::continued(const Configuration& q, const FirstMotion& motion,
                                              const CarrierLine& line, double ahead, int& solves) const {
  const std::vector<TouchCluster> clusters = touches_at(space_, q);
  std::vector<int> chosen(clusters.size(), -1);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (std::size_t k = 0; k < clusters[i].size(); ++k) {
      if (std::find(motion.pairs.begin(), motion.pairs.end(), clusters[i][k].pair) != motion.pairs.end())
        chosen[i] = static_cast<int>(k);
    }
  }
  std::vector<Continuation> found;
  try_leg(q, clusters, chosen, motion.pairs, motion.modes, line, ahead, found, solves);
  if (found.empty()) return std::nullopt;
  return std::move(found.front());
}

// K (from + h way - q) + a e + b f = 0 with a, b not negative: linear in h, a and b (derived). With two contacts that
// stick the forces at rest are an interval for every h; a way on begins only where one of its ends is such a pair.
std::vector<double> WaysOn::ways_off_rest(const Configuration& q, const CarrierLine& line, double far) const {
  const Eigen::Vector3d load = spring_load(stiffness_, line.from, q), pull = stiffness_.cwiseProduct(line.way);
  const Eigen::Vector3d scale(1, 1, 1 / space_.part.gyration_mm);
  std::vector<double> places;
  for_alternatives(touches_at(space_, q), [&](const std::vector<ContactPoint>& points, const auto&) {
    std::vector<Eigen::Vector3d> edges;
    for (const ContactPoint& point : points) {
      for (const double side : {-1.0, 1.0}) {
        const Point f = point.normal + side * friction_ * turned_left(point.normal);
        edges.emplace_back(f.x(), f.y(), cross(point.lever, f));
      }
    }
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t k = i + 1; k < edges.size(); ++k) {
        Eigen::Matrix3d columns;
        columns << scale.cwiseProduct(pull), scale.cwiseProduct(edges[i]), scale.cwiseProduct(edges[k]);
        const Eigen::FullPivLU<Eigen::Matrix3d> lu(columns);
        if (!lu.isInvertible()) continue;
        const Eigen::Vector3d at = lu.solve(-scale.cwiseProduct(load));
        if (at[0] > 0 && at[0] < far && at[1] >= 0 && at[2] >= 0) places.push_back(at[0]);
      }
    }
  });
  std::sort(places.begin(), places.end());
  return places;
}

std::optional<std::vector<CarriedContact>> WaysOn::held(const Configuration& q, const Eigen::Vector3d& carrier) const {
  const MotionLaw pulled = law(q, carrier);
  std::optional<std::vector<CarriedContact>> found;
  for_alternatives(
      touches_at(space_, q), [&](const std::vector<ContactPoint>& points, const std::vector<ContactPair>& pairs) {
        if (found) return;
        const auto forces = equilibrium(points, pulled);
        if (!forces) return;
        found.emplace();
        for (std::size_t i = 0; i < points.size(); ++i) {
          if ((*forces)[i].normal > 0) {
            found->push_back(
                {pairs[i], q.position() + points[i].lever, points[i].normal, ContactMode::Stick, (*forces)[i]});
          }
        }
      });
  return found;
}

bool is_wedged(std::span<const CarriedContact> contacts, double friction) {
  const double cosine = 1 / std::hypot(1.0, friction);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = i + 1; j < contacts.size(); ++j) {
      const Point between = contacts[j].point - contacts[i].point;
      const double apart = between.norm();
      if (apart < 1e-6) continue;
      if (contacts[i].normal.dot(between) >= cosine * apart - 1e-12 &&
          -contacts[j].normal.dot(between) >= cosine * apart - 1e-12)
        return true;
    }
  }
  return false;
}

}  // namespace formotion
