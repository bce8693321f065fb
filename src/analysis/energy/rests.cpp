#include "analysis/energy/rests.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/lowest_positions.hpp"
#include "analysis/energy/rest_candidates.hpp"
#include "analysis/motion/contact_law.hpp"

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kForce = 1e-7;      // of forces and moments in balance
constexpr double kAside_rad = 1e-4;  // how far slices aside of a rest are
constexpr double kFarAside = 0.01;   // of the part's reach
constexpr double kFlat = 1e-3;       // of the part's reach: heights that bend less than this are level
constexpr double kNoise_mm = 1e-11;
constexpr double kSolved_mm = 1e-9;  // places of three contacts are off by up to 4e-10 where edges are nearly parallel
constexpr double kSameAngle_rad = 1e-11;
constexpr double kRepeat_mm = 1e-12;  // a place found again; others as near may be less exact, and fail
constexpr double kLeastSine = 1e-3;   // between normals
constexpr double kSameHeight_mm = 1e-7;
constexpr double kStretch_mm = 1e-9;  // a shorter level stretch is a place

double wrapped(double theta) {
  theta = std::fmod(theta, 2 * kPi);
  if (theta < 0) theta += 2 * kPi;
  return theta >= 2 * kPi ? 0 : theta;
}

struct Tester {
  const ContactSpace& space;
  const Gravity& gravity;

  FreeSlice slice(double theta) const { return free_slice(space.part, space.obstacles, theta); }

  std::vector<ContactPoint> contact_points(const Configuration& q) const {
    std::vector<ContactPoint> points;
    for (const TouchCluster& cluster : touches_at(space, q)) {
      for (const Touch& touch : cluster) points.push_back({touch.state.normal, touch.state.lever});
    }
    return points;
  }

  // Forces can hold the part without friction: to first order no way leads down (necessary; where corners meet
  // corners, all of them are counted as holding).
  bool balances(const Configuration& q) const {
    const std::vector<ContactPoint> points = contact_points(q);
    if (points.empty()) return false;
    return equilibrium(points, damped(gravity.down, space.part.gyration_mm, 0), kForce).has_value();
  }

  // Nothing lower nearby: neither at its own orientation nor a little turned. The disc looked at holds all that turning
  // can bring about, by the sines between the normals.
  // Where all normals are parallel the part may slide far for a little turn; then as far as room_mm.
  bool is_lowest(const Configuration& q, double room_mm = 1e300) const {
    const double reach = space.part.reach_mm;
    double sine = 2;
    const std::vector<ContactPoint> points = contact_points(q);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j) {
        const double here = std::abs(cross(points[i].normal, points[j].normal));
        if (here > kLeastSine) sine = std::min(sine, here);
      }
    }
    const double around = sine > 1 ? std::min(kFarAside * reach, room_mm) : 4 * reach * kAside_rad / sine;
    for (const double turn : {0.0, -kAside_rad, kAside_rad}) {
      const double slack = turn == 0 ? kSolved_mm : kFlat * reach * kAside_rad * kAside_rad + kNoise_mm;
      const auto lowest = lowest_within(slice(q.theta_rad + turn), gravity, q.position(), around);
      if (lowest && *lowest < gravity.height_mm(q) - slack) return false;
    }
    return true;
  }
};

// A rest as found, before those that are one are joined.
struct Found {
  Configuration at;
  Point left, right;  // of a level stretch
};

// The parts of a level stretch on which the part balances. What touches, and whether the centre of mass is over it,
// changes only where it passes a fixed corner or a corner of the part does.
std::vector<Found> balanced_stretches(const Tester& tester, const LowestPosition& lowest, double theta) {
  const auto& [space, gravity] = tester;
  const double from = gravity.across_mm(lowest.left), to = gravity.across_mm(lowest.right);
  std::vector<double> places{from, to};
  const auto add = [&](double across) {
    if (across > from && across < to) places.push_back(across);
  };
  const auto passes = [&](const Point& fixed) {
    const double across = gravity.across_mm(fixed);
    add(across);
    for (const MovingCorner& corner : space.part.corners) add(across - gravity.across_mm(rotated(corner.at, theta)));
  };
  for (const FixedEdge& edge : space.obstacles.edges) {
    passes(edge.from);
    passes(edge.to);
  }
  for (const FixedCorner& corner : space.obstacles.corners) passes(corner.centre);
  std::sort(places.begin(), places.end());
  const Point along = turned_left(gravity.down);
  std::vector<Found> found;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    if (places[i + 1] - places[i] <= kStretch_mm) continue;
    const Point left = lowest.left + (places[i] - from) * along, right = lowest.left + (places[i + 1] - from) * along;
    const Point middle = 0.5 * (left + right);
    if (!tester.balances({middle.x(), middle.y(), theta})) continue;
    if (!found.empty() && (found.back().right - left).norm() <= 2 * kStretch_mm) {
      found.back().right = right;
    } else {
      found.push_back({{}, left, right});
    }
  }
  for (Found& one : found) {
    const Point middle = 0.5 * (one.left + one.right);
    one.at = {middle.x(), middle.y(), theta};
  }
  return found;
}

double turn_between(double a, double b) { return std::abs(std::remainder(a - b, 2 * kPi)); }

double distance_to_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d d = b - a;
  const double length = d.squaredNorm();
  const double t = length > 0 ? std::clamp(d.dot(p - a) / length, 0.0, 1.0) : 0;
  return (a + t * d - p).norm();
}

double distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
  const double rim =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  if (normal.squaredNorm() <= 0) return rim;
  const Eigen::Vector3d n = normal.normalized(), foot = p - n.dot(p - a) * n;
  const bool inside =
      n.dot((b - a).cross(foot - a)) >= 0 && n.dot((c - b).cross(foot - b)) >= 0 && n.dot((a - c).cross(foot - c)) >= 0;
  return inside ? std::abs(n.dot(p - a)) : rim;
}

// Found rests of one height whose orientations differ (a part that turns about its own centre of mass) are one if a
// place between them is a rest, too.
bool is_level_between(const Tester& tester, const Found& a, const Found& b) {
  const double turn = std::remainder(b.at.theta_rad - a.at.theta_rad, 2 * kPi), middle = a.at.theta_rad + 0.5 * turn;
  const double height = tester.gravity.height_mm(a.at);
  const double near = tester.space.part.reach_mm * std::abs(turn) + kSameHeight_mm;
  for (const LowestPosition& lowest : lowest_positions(tester.slice(middle), tester.gravity)) {
    if (std::abs(lowest.height_mm - height) > kSameHeight_mm) continue;
    for (const Point& p : {lowest.left, lowest.middle(), lowest.right}) {
      if ((p - 0.5 * (a.at.position() + b.at.position())).norm() > near) continue;
      const Configuration q{p.x(), p.y(), middle};
      if (tester.balances(q) && tester.is_lowest(q)) return true;
    }
  }
  return false;
}

Rest rest_of(const Tester& tester, std::vector<Found> members) {
  Rest rest;
  const auto configuration = [](const Point& p, double theta) { return Configuration{p.x(), p.y(), theta}; };
  if (members.size() == 1) {
    const Found& one = members.front();
    rest.at = one.at;
    if ((one.right - one.left).norm() > kStretch_mm) {
      rest.set = {configuration(one.left, one.at.theta_rad), configuration(one.right, one.at.theta_rad)};
    }
  } else {  // along theta: the ends, or the four corners
    const double first = members.front().at.theta_rad;
    for (Found& one : members) one.at.theta_rad = first + std::remainder(one.at.theta_rad - first, 2 * kPi);
    std::sort(members.begin(), members.end(),
              [](const Found& a, const Found& b) { return a.at.theta_rad < b.at.theta_rad; });
    rest.at = members[members.size() / 2].at;
    const bool wide = std::any_of(members.begin(), members.end(),
                                  [](const Found& f) { return (f.right - f.left).norm() > kStretch_mm; });
    const Found &low = members.front(), &high = members.back();
    rest.set = {configuration(low.left, low.at.theta_rad)};
    if (wide) rest.set.push_back(configuration(low.right, low.at.theta_rad));
    rest.set.push_back(configuration(high.right, high.at.theta_rad));
    if (wide) rest.set.push_back(configuration(high.left, high.at.theta_rad));
  }
  const double turns = wrapped(rest.at.theta_rad) - rest.at.theta_rad;
  rest.at.theta_rad += turns;
  for (Configuration& q : rest.set) q.theta_rad += turns;
  rest.height_mm = tester.gravity.height_mm(rest.at);
  for (const TouchCluster& cluster : touches_at(tester.space, rest.at)) {
    for (const Touch& touch : cluster) rest.contacts.push_back(touch.pair);
  }
  return rest;
}

}  // namespace

bool Rest::holds(const Configuration& q, double reach_mm, double tolerance_mm) const {
  // Turns count by what they move the farthest point, from the nearest turn to `at`.
  const auto scaled = [&](const Configuration& c, double near_rad) {
    const double theta = near_rad + std::remainder(c.theta_rad - near_rad, 2 * kPi);
    return Eigen::Vector3d(c.x_mm, c.y_mm, reach_mm * theta);
  };
  if (set.empty()) return (scaled(q, at.theta_rad) - scaled(at, at.theta_rad)).norm() <= tolerance_mm;
  double middle = 0;  // the set's own turns are kept
  for (const Configuration& c : set) middle += c.theta_rad / static_cast<double>(set.size());
  const Eigen::Vector3d p = scaled(q, middle);
  std::vector<Eigen::Vector3d> corners;
  for (const Configuration& c : set) corners.emplace_back(c.x_mm, c.y_mm, reach_mm * c.theta_rad);
  if (corners.size() == 1) return (p - corners[0]).norm() <= tolerance_mm;
  double distance = distance_to_segment(p, corners[0], corners[1]);
  for (std::size_t i = 2; i < corners.size(); ++i) {
    distance = std::min(distance, distance_to_triangle(p, corners[0], corners[i - 1], corners[i]));
  }
  return distance <= tolerance_mm;
}

std::vector<Rest> rests(const ContactSpace& space, const Gravity& gravity, const RestOptions& options) {
  const Tester tester{space, gravity};
  const double reach = space.part.reach_mm;
  const RestSlices slices = rest_slices(space, gravity, options.grid_rad);
  RestCandidates near(space, gravity, options.grid_rad);
  std::vector<Configuration> places;
  std::vector<Found> found;
  const auto look = [&](double theta, bool special) {
    for (const LowestPosition& lowest : lowest_positions(tester.slice(theta), gravity)) {
      if (lowest.is_level() && special) {
        for (const Found& one : balanced_stretches(tester, lowest, theta)) {
          if (tester.is_lowest(one.at, 0.45 * (one.right - one.left).norm())) found.push_back(one);
        }
      }
      for (const Point& p : {lowest.left, lowest.middle(), lowest.right}) {
        places.push_back({p.x(), p.y(), theta});
        near.add(p, theta);
        if (!lowest.is_level()) break;
      }
    }
  };
  for (std::size_t i = 0; i < slices.theta_rad.size(); ++i) look(slices.theta_rad[i], slices.is_special[i]);
  for (const double theta : near.level_orientations()) {
    const auto known = std::lower_bound(slices.theta_rad.begin(), slices.theta_rad.end(), theta - kSameAngle_rad);
    if (known == slices.theta_rad.end() || *known > theta + kSameAngle_rad ||
        !slices.is_special[known - slices.theta_rad.begin()]) {
      look(theta, true);
    }
  }
  for (const Configuration& q : near.found()) places.push_back(q);

  // Of places found more than once one is looked at.
  for (Configuration& q : places) q.theta_rad = wrapped(q.theta_rad);
  std::stable_sort(places.begin(), places.end(),
                   [](const Configuration& a, const Configuration& b) { return a.theta_rad < b.theta_rad; });
  const double same = options.tolerance_mm;
  const auto is_known = [&](const Configuration& q) {
    return std::any_of(found.begin(), found.end(), [&](const Found& one) {
      return turn_between(one.at.theta_rad, q.theta_rad) * reach <= same &&
             formotion::distance_to_segment(q.position(), one.left, one.right) <= same;
    });
  };
  std::vector<Configuration> looked_at;
  for (const Configuration& q : places) {
    bool before = false;
    for (std::size_t k = looked_at.size(); k-- > 0 && !before;) {
      if ((q.theta_rad - looked_at[k].theta_rad) * reach > kRepeat_mm) break;
      before = (q.position() - looked_at[k].position()).norm() <= kRepeat_mm;
    }
    if (before || is_known(q)) continue;
    looked_at.push_back(q);
    if (!tester.balances(q) || !is_free(space.part, space.obstacles, q) || !tester.is_lowest(q)) continue;
    found.push_back({q, q.position(), q.position()});
  }

  // Join those that are one level set over theta.
  std::vector<int> group(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) group[i] = static_cast<int>(i);
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = i + 1; j < found.size(); ++j) {
      if (group[i] == group[j]) continue;
      if (std::abs(gravity.height_mm(found[i].at) - gravity.height_mm(found[j].at)) > kSameHeight_mm) continue;
      const double turn = turn_between(found[i].at.theta_rad, found[j].at.theta_rad);
      if (turn * reach <= same || turn > 1.01 * options.grid_rad) continue;
      if (!is_level_between(tester, found[i], found[j])) continue;
      const int from = std::max(group[i], group[j]), to = std::min(group[i], group[j]);
      for (int& g : group) g = g == from ? to : g;
    }
  }
  std::vector<Rest> all;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (group[i] != static_cast<int>(i)) continue;
    std::vector<Found> members;
    for (std::size_t j = i; j < found.size(); ++j) {
      if (group[j] == group[i]) members.push_back(found[j]);
    }
    all.push_back(rest_of(tester, std::move(members)));
  }
  std::sort(all.begin(), all.end(), [&](const Rest& a, const Rest& b) {
    const double ha = std::round(a.height_mm / kSameHeight_mm), hb = std::round(b.height_mm / kSameHeight_mm);
    if (ha != hb) return ha < hb;
    if (a.at.theta_rad != b.at.theta_rad) return a.at.theta_rad < b.at.theta_rad;
    return gravity.across_mm(a.at.position()) < gravity.across_mm(b.at.position());
  });
  return all;
}

}  // namespace formotion
