#include "analysis/energy/hold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/energy/equilibria.hpp"

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kInPlane = 1e-9;    // of an edge's length: out of the plane by less is in it
constexpr double kCancelled = 1e-9;  // relative: two edges that carry only each other

// In [0, 2 pi), and never just below a full turn where it is none.
double ahead(double angle_rad) {
  const double turned = angle_rad - 2 * kPi * std::floor(angle_rad / (2 * kPi));
  return turned >= 2 * kPi - kHeld_rad ? 0 : turned;
}

// Rays of the cone of edges in the plane of u and v, normal w.
std::vector<Point> section(const std::vector<Eigen::Vector3d>& edges, const Eigen::Vector3d& u,
                           const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  struct Cut {
    Point in_plane;
    double out = 0;
  };
  std::vector<Cut> above, below;
  std::vector<Point> rays;
  for (const Eigen::Vector3d& edge : edges) {
    const Cut cut{{edge.dot(u), edge.dot(v)}, edge.dot(w)};
    if (std::abs(cut.out) > kInPlane * edge.norm()) {
      (cut.out > 0 ? above : below).push_back(cut);
    } else if (cut.in_plane.norm() > 0) {
      rays.push_back(cut.in_plane);
    }
  }
  for (const Cut& a : above) {
    for (const Cut& b : below) {
      const Point from_a = -b.out * a.in_plane, from_b = a.out * b.in_plane;
      const Point ray = from_a + from_b;
      if (ray.norm() > kCancelled * (from_a.norm() + from_b.norm())) rays.push_back(ray);
    }
  }
  return rays;
}

double farthest_lever(std::span<const ContactPoint> contacts) {
  double length = 0;
  for (const ContactPoint& contact : contacts) length = std::max(length, contact.lever.norm());
  return length > 0 ? length : 1;
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::Impossible:
      return "impossible";
    case Verdict::Possible:
      return "possible";
    case Verdict::Certain:
      return "certain";
  }
  return "";
}

bool PlaneCone::contains(double direction_rad) const {
  switch (kind) {
    case Kind::Nothing:
      return false;
    case Kind::Everything:
      return true;
    case Kind::Line:
      return std::abs(std::remainder(direction_rad - from_rad, kPi)) <= kHeld_rad;
    case Kind::Sector: {
      const double off = std::remainder(direction_rad - from_rad - width_rad / 2, 2 * kPi);
      return std::abs(off) <= width_rad / 2 + kHeld_rad;
    }
  }
  return false;
}

bool PlaneCone::covers(double range_from_rad, double range_to_rad) const {
  // Convex: with two directions less than pi apart it has all between them.
  const double width = std::max(0.0, range_to_rad - range_from_rad);
  const int steps = width > 0 ? static_cast<int>(std::ceil(width / (0.75 * kPi))) : 0;
  for (int i = 0; i <= steps; ++i) {
    if (!contains(steps > 0 ? range_from_rad + width * i / steps : range_from_rad)) return false;
  }
  return true;
}

bool PlaneCone::meets(double range_from_rad, double range_to_rad) const {
  if (kind == Kind::Nothing) return false;
  if (contains(range_from_rad) || contains(range_to_rad)) return true;
  const double width = std::max(0.0, range_to_rad - range_from_rad);
  const auto in_range = [&](double direction) { return ahead(direction - range_from_rad) <= width + kHeld_rad; };
  return in_range(from_rad) || (kind == Kind::Line && in_range(from_rad + kPi));
}

PlaneCone cone_of(const std::vector<Point>& rays) {
  if (rays.empty()) return {};
  std::vector<double> angles;
  for (const Point& ray : rays) angles.push_back(std::atan2(ray.y(), ray.x()));
  std::sort(angles.begin(), angles.end());
  std::size_t first = 0;  // after the widest gap
  double gap = angles.front() + 2 * kPi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) {
    if (angles[i] - angles[i - 1] <= gap) continue;
    gap = angles[i] - angles[i - 1];
    first = i;
  }
  PlaneCone cone{PlaneCone::Kind::Sector, angles[first], 2 * kPi - gap};
  if (gap < kPi - kHeld_rad) {
    cone.kind = PlaneCone::Kind::Everything;
  } else if (gap < kPi + kHeld_rad) {
    const bool bulges = std::any_of(angles.begin(), angles.end(), [&](double angle) {
      return std::abs(std::remainder(angle - cone.from_rad - kPi / 2, 2 * kPi)) < kPi / 2 - 2 * kHeld_rad;
    });
    if (!bulges) cone.kind = PlaneCone::Kind::Line;
    cone.width_rad = kPi;
  }
  return cone;
}

std::vector<Eigen::Vector3d> friction_edges(std::span<const ContactPoint> contacts, double friction, double length_mm) {
  std::vector<Eigen::Vector3d> edges;
  for (const ContactPoint& contact : contacts) {
    for (const double side : {1.0, -1.0}) {
      const Point force = contact.normal + side * friction * turned_left(contact.normal);
      edges.push_back({force.x(), force.y(), cross(contact.lever, force) / length_mm});
      if (friction <= 0) break;
    }
  }
  return edges;
}

PlaneCone held_forces(const std::vector<Eigen::Vector3d>& edges) {
  std::vector<Point> rays = section(edges, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  for (Point& ray : rays) ray = -ray;
  return cone_of(rays);
}

PlaneCone held_moments(const std::vector<Eigen::Vector3d>& edges, double along_rad) {
  const double c = std::cos(along_rad), s = std::sin(along_rad);
  std::vector<Point> rays = section(edges, {c, s, 0}, {0, 0, 1}, {-s, c, 0});
  for (Point& ray : rays) ray = -ray;
  return cone_of(rays);
}

double way_out(const PlaneCone& cone, double along_rad, double towards_rad) {
  if (!cone.contains(along_rad)) return 0;
  if (cone.kind == PlaneCone::Kind::Everything || cone.contains(towards_rad)) return kInfinite;
  const double turn = std::remainder(towards_rad - along_rad, 2 * kPi);
  if (std::abs(turn) >= kPi - kHeld_rad) return 1;  // back to nothing, which is held, and no farther
  if (cone.kind == PlaneCone::Kind::Line) return 0;
  // To the cone's edge on the side of the turn; the sine rule.
  const double middle = std::remainder(along_rad - cone.from_rad - cone.width_rad / 2, 2 * kPi);
  const double left = std::max(0.0, cone.width_rad / 2 + (turn > 0 ? -middle : middle));
  const double beyond = std::abs(turn) - left;
  return beyond > 0 ? std::sin(left) / std::sin(beyond) : kInfinite;
}

Verdict can_hold(std::span<const ContactPoint> contacts, const PushSet& push, double gyration_mm) {
  if (contacts.empty()) return Verdict::Impossible;
  if (!held_forces(friction_edges(contacts, push.friction_max, gyration_mm)).meets(push.from_rad, push.to_rad))
    return Verdict::Impossible;
  const PlaneCone surely = held_forces(friction_edges(contacts, push.friction_min, gyration_mm));
  return surely.covers(push.from_rad, push.to_rad) ? Verdict::Certain : Verdict::Possible;
}

double resisted(std::span<const ContactPoint> contacts, double along_rad, double friction, double towards_rad) {
  return way_out(held_forces(friction_edges(contacts, friction, farthest_lever(contacts))), along_rad, towards_rad);
}

double least_resisted(std::span<const ContactPoint> contacts, double along_rad, double friction) {
  const PlaneCone cone = held_forces(friction_edges(contacts, friction, farthest_lever(contacts)));
  if (!cone.contains(along_rad) || cone.kind == PlaneCone::Kind::Line) return 0;
  if (cone.kind == PlaneCone::Kind::Everything) return kInfinite;
  // The distance to the nearer of the two lines that bound it.
  const double middle = std::remainder(along_rad - cone.from_rad - cone.width_rad / 2, 2 * kPi);
  const double right = std::max(0.0, cone.width_rad / 2 + middle), left = std::max(0.0, cone.width_rad / 2 - middle);
  return std::max(0.0, std::min(std::sin(right), std::sin(left)));
}

double resisted_moment_mm(std::span<const ContactPoint> contacts, double along_rad, double friction) {
  const double length = farthest_lever(contacts);
  const PlaneCone cone = held_moments(friction_edges(contacts, friction, length), along_rad);
  return length * std::min(way_out(cone, 0, kPi / 2), way_out(cone, 0, -kPi / 2));
}

}  // namespace formotion
