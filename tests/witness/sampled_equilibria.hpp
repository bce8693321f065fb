// Equilibria by slices: at many orientations the corners of free space (two contacts each) and places along its sides
// that touch twice, each held or not by trying combinations of friction cone edges for sampled forces. Slow, and blind
// between slices; shares with equilibria() the slices' geometry at most, none of its curves, cuts and cones.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "analysis/contact/clearance.hpp"
#include "analysis/contact/free_slice.hpp"
#include "analysis/energy/equilibria.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::witness {

struct SampledHold {
  bool is_known = true;  // false: convex corners meet there, or fewer than two places touch
  Verdict verdict = Verdict::Impossible;
  std::vector<ContactPoint> contacts;
};

// target = a non-negative combination of three generators (or fewer), to within the tolerance: all combinations tried.
inline bool in_cone(const std::vector<Eigen::Vector3d>& generators, const Eigen::Vector3d& target, double tolerance) {
  const std::size_t n = generators.size();
  const auto near = [&](std::initializer_list<std::size_t> chosen, const Eigen::VectorXd& weights) {
    Eigen::Vector3d rest = target;
    int k = 0;
    for (const std::size_t g : chosen) {
      if (!(weights[k] >= -tolerance)) return false;
      rest -= weights[k++] * generators[g];
    }
    return rest.norm() <= tolerance;
  };
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a; b < n; ++b) {
      Eigen::Matrix<double, 3, 2> two;
      two << generators[a], generators[b];
      if (a == b) {
        const double weight = generators[a].dot(target) / generators[a].squaredNorm();
        if (near({a}, Eigen::VectorXd::Constant(1, weight))) return true;
        continue;
      }
      const Eigen::Matrix2d square = two.transpose() * two;
      if (square.determinant() > 1e-18 && near({a, b}, square.inverse() * (two.transpose() * target))) return true;
      for (std::size_t c = b + 1; c < n; ++c) {
        Eigen::Matrix3d three;
        three << generators[a], generators[b], generators[c];
        if (std::abs(three.determinant()) > 1e-12 && near({a, b, c}, three.inverse() * target)) return true;
      }
    }
  }
  return false;
}

// Some force between two directions is held iff the one, with a share of the other, is.
inline Verdict sampled_verdict(std::span<const ContactPoint> contacts, const PushSet& push, double gyration_mm,
                               double tolerance) {
  const auto edges = [&](double friction) {
    std::vector<Eigen::Vector3d> list;
    for (const ContactPoint& contact : contacts) {
      for (const double side : {-1.0, 1.0}) {
        const Point f = contact.normal + side * friction * turned_left(contact.normal);
        list.push_back({f.x(), f.y(), cross(contact.lever, f) / gyration_mm});
      }
    }
    return list;
  };
  const auto against = [](double angle) { return Eigen::Vector3d(-std::cos(angle), -std::sin(angle), 0); };
  std::vector<Eigen::Vector3d> some = edges(push.friction_max);
  some.push_back(-against(push.to_rad));
  bool is_possible = in_cone(some, against(push.from_rad), tolerance);
  some.back() = -against(push.from_rad);
  is_possible = is_possible || in_cone(some, against(push.to_rad), tolerance);
  if (!is_possible) return Verdict::Impossible;
  const std::vector<Eigen::Vector3d> least = edges(push.friction_min);
  for (int i = 0; i <= 4; ++i) {
    if (!in_cone(least, against(push.from_rad + (push.to_rad - push.from_rad) * i / 4), tolerance))
      return Verdict::Possible;
  }
  return Verdict::Certain;
}

inline SampledHold sampled_hold(const MovingShape& part, const Obstacles& obstacles, const PushSet& push,
                                const Configuration& q, double tolerance = 1e-7) {
  SampledHold hold;
  for (const Contact& contact : contacts_at(part, obstacles, q, 1e-6)) {
    bool fixed_corner = false, moving_corner = false;
    for (const FixedCorner& corner : obstacles.corners)
      fixed_corner = fixed_corner || (corner.centre - contact.point).norm() < 1e-4;
    for (const MovingCorner& corner : part.corners)
      moving_corner = moving_corner || (rotated(corner.at, q.theta_rad) - contact.state.lever).norm() < 1e-4;
    if (fixed_corner && moving_corner) hold.is_known = false;
    hold.contacts.push_back({contact.state.normal, contact.state.lever});
  }
  if (hold.contacts.size() < 2) hold.is_known = false;
  if (hold.is_known) hold.verdict = sampled_verdict(hold.contacts, push, part.gyration_mm, tolerance);
  return hold;
}

// The held ones at these orientations.
inline std::vector<Configuration> sampled_equilibria(const MovingShape& part, const Obstacles& obstacles,
                                                     const PushSet& push, const std::vector<double>& thetas) {
  std::vector<Configuration> found;
  for (const double theta : thetas) {
    for (const SlicePiece& piece : free_slice(part, obstacles, theta).pieces) {
      for (const double share : {0.0, 0.37, 0.71, 1.0}) {
        if (piece.radius_mm > 0 && share != 0 && share != 1) continue;
        const Point p = piece.from + share * (piece.to - piece.from);
        const Configuration q{p.x(), p.y(), theta};
        const SampledHold hold = sampled_hold(part, obstacles, push, q);
        if (hold.is_known && hold.verdict != Verdict::Impossible) found.push_back(q);
      }
    }
  }
  return found;
}

struct StaticScene {
  std::vector<Polygon> shapes;
  MovingShape part;
  Obstacles obstacles;
  PushSet push;
};

// A part over a pocket: a floor, walls, and lumps on them; forces about straight down. on_grid: whole mm and right
// angles.
inline StaticScene random_static_scene(Random& random, bool on_grid, double grow_mm = 0) {
  StaticScene scene;
  while (true) {
    Polygon part = normalised(on_grid ? grid_polygon(random, 4) : random_polygon(random, 4));
    const AreaMoments moments = area_moments(part);
    part = placed(part, 0, -moments.centroid);
    scene.part = MovingShape::of({part}, std::sqrt(moments.second_mm4.trace() / moments.area_mm2));
    if (part.outer.size() > 6) continue;
    const auto number = [&](double from, double to) {
      const double x = uniform(random, from, to);
      return on_grid ? std::round(x) : x;
    };
    std::vector<ObstacleShape> shapes{
        {{{{-12, -5}, {12, -5}, {12, number(-2, 2)}, {-12, number(-2, 2)}}, {}}, 0, false}};
    const int lumps = 1 + below(random, 2);
    for (int i = 0; i < lumps; ++i) {
      Polygon lump = normalised(on_grid ? grid_polygon(random, 6) : random_polygon(random, 5));
      if (lump.outer.size() > 7) continue;
      shapes.push_back({placed(lump, 0, Point(number(-8, 8), number(-1, 3))), 0, false});
    }
    auto obstacles = make_obstacles(shapes, grow_mm);
    if (!obstacles) continue;
    scene.obstacles = std::move(*obstacles);
    break;
  }
  const double down = -std::numbers::pi / 2 + (on_grid ? 0 : uniform(random, -0.4, 0.4));
  const double spread = below(random, 2) == 0 ? 0 : uniform(random, 0.02, 0.8);
  scene.push = {down - spread / 2, down + spread / 2, 0, 0};
  scene.push.friction_min = below(random, 4) == 0 ? 0 : uniform(random, 0.05, 0.7);
  scene.push.friction_max = scene.push.friction_min + (below(random, 2) == 0 ? 0 : uniform(random, 0.02, 0.4));
  return scene;
}

struct SetAgreement {
  int sets = 0, held = 0, samples = 0;
  int missed = 0;    // held configurations that are on no set
  int unheld = 0;    // members that the sampling does not hold
  int short_of = 0;  // sets that reach farther over theta than the sampling does, by more than a slice
  double farthest_mm = 0;
};

// The least of this and the distance between q and a set.
inline double from_set(const EquilibriumSet& set, const Configuration& q, double reach_mm, double least) {
  const auto off = [&](const Configuration& a, double share, const Configuration& b) {
    const double turned = std::remainder(b.theta_rad - a.theta_rad, 2 * std::numbers::pi);
    const Point p = a.position() + share * (b.position() - a.position());
    return (p - q.position()).norm() +
           reach_mm * std::abs(std::remainder(a.theta_rad + share * turned - q.theta_rad, 2 * std::numbers::pi));
  };
  for (std::size_t i = 0; i < set.samples.size(); ++i) {
    const Configuration &a = set.samples[i], &b = set.samples[i + 1 < set.samples.size() ? i + 1 : i];
    if ((a.position() - b.position()).norm() > 0.5 * reach_mm && a.theta_rad != b.theta_rad) {
      least = std::min(least, off(a, 0, b));  // the chain jumps
      continue;
    }
    if (off(a, 0, b) - (a.position() - b.position()).norm() - reach_mm * std::abs(a.theta_rad - b.theta_rad) > least)
      continue;
    // The nearest of the chord: a convex function of the share.
    double low = 0, high = 1;
    for (int k = 0; k < 40; ++k) {
      const double one = low + (high - low) / 3, other = high - (high - low) / 3;
      (off(a, one, b) < off(a, other, b) ? high : low) = off(a, one, b) < off(a, other, b) ? other : one;
    }
    least = std::min({least, off(a, low, b), off(a, 0, b), off(a, 1, b)});
  }
  return least;
}

inline SetAgreement compare_sets(const StaticScene& scene, const std::vector<EquilibriumSet>& sets, double slice_rad,
                                 double tolerance_mm) {
  SetAgreement agreement;
  agreement.sets = static_cast<int>(sets.size());
  const double reach = scene.part.reach_mm, turn = 2 * std::numbers::pi;
  std::vector<double> thetas;
  for (double theta = 0.37 * slice_rad; theta < turn; theta += slice_rad) thetas.push_back(theta);
  const std::vector<Configuration> held = sampled_equilibria(scene.part, scene.obstacles, scene.push, thetas);
  agreement.held = static_cast<int>(held.size());
  std::vector<std::vector<Configuration>> of_set(sets.size());
  std::vector<int> set_of(held.size(), -1);
  for (std::size_t k = 0; k < held.size(); ++k) {
    double least = 1e300;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      const double off = from_set(sets[i], held[k], reach, least);
      if (off >= least) continue;
      least = off;
      set_of[k] = static_cast<int>(i);
    }
    if (least > tolerance_mm) {
      ++agreement.missed;
      set_of[k] = -1;
      continue;
    }
    agreement.farthest_mm = std::max(agreement.farthest_mm, least);
    of_set[set_of[k]].push_back(held[k]);
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    // Every slice that a piece of the set crosses has a held configuration there.
    for (std::size_t k = 0; k + 1 < sets[i].samples.size(); ++k) {
      const Configuration &a = sets[i].samples[k], &b = sets[i].samples[k + 1];
      if ((a.position() - b.position()).norm() + reach * std::abs(a.theta_rad - b.theta_rad) > 0.1 * reach) continue;
      const double low = std::min(a.theta_rad, b.theta_rad) + 2e-4, high = std::max(a.theta_rad, b.theta_rad) - 2e-4;
      const double first = 0.37 * slice_rad + slice_rad * std::ceil((low - 0.37 * slice_rad) / slice_rad);
      if (first > high) continue;
      bool covered = false;
      for (const Configuration& q : of_set[i]) {
        covered = covered || (std::abs(std::remainder(q.theta_rad - first, turn)) < 1e-6 &&
                              (q.position() - a.position()).norm() < 0.2 * reach);
      }
      agreement.short_of += !covered;
    }
    // Sets are closed: at an end the forces may have grown beyond all bounds (a wedge).
    for (std::size_t k = 0; k<sets[i].samples.size(); k += k> 3 && k + 8 < sets[i].samples.size() ? 4 : 1) {
      ++agreement.samples;
      bool is_held = false;
      for (const std::size_t other : {k, k > 0 ? k - 1 : k, k + 1 < sets[i].samples.size() ? k + 1 : k}) {
        const Configuration &q = sets[i].samples[k], &to = sets[i].samples[other];
        const Point p = q.position() + 1e-4 * (to.position() - q.position());
        const Configuration near{p.x(), p.y(), q.theta_rad + 1e-4 * (to.theta_rad - q.theta_rad)};
        if (clearance_mm(scene.part, scene.obstacles, near) < -1e-6) continue;
        const SampledHold hold = sampled_hold(scene.part, scene.obstacles, scene.push, near, 1e-6);
        is_held = !hold.is_known || hold.verdict != Verdict::Impossible;
        if (is_held) break;
      }
      agreement.unheld += !is_held;
    }
  }
  return agreement;
}

}  // namespace formotion::witness
