#include "witness/insertion_stepping.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/geometry/boolean.hpp"
#include "witness/contact_lcp.hpp"

namespace formotion::witness {
namespace {

using Place = Eigen::Vector3d;  // x, y, theta

// A shape's edges; corner i is where edge i begins and edge before[i] ends.
struct Outline {
  std::vector<Point> from, along, normal;  // the normal points out of the material
  std::vector<double> length;
  std::vector<std::size_t> before, after;

  void add(const Loop& loop) {
    const std::size_t first = from.size(), n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point side = loop[(i + 1) % n] - loop[i];
      from.push_back(loop[i]);
      length.push_back(side.norm());
      along.push_back(side.normalized());
      normal.emplace_back(along.back().y(), -along.back().x());
      before.push_back(first + (i + n - 1) % n);
      after.push_back(first + (i + 1) % n);
    }
  }
  bool is_convex(std::size_t corner) const { return cross(along[before[corner]], along[corner]) > 0; }
  // Whether this corner's material lies on the side that the direction points to.
  bool lies_towards(std::size_t corner, const Point& direction) const {
    return along[corner].dot(direction) >= -1e-12 && -along[before[corner]].dot(direction) >= -1e-12;
  }
};

Outline outline_of(const std::vector<Polygon>& polygons) {
  Outline outline;
  for (const Polygon& polygon : polygons) {
    for (const Loop& loop : loops_of(polygon)) outline.add(loop);
  }
  return outline;
}

struct NearContact {
  double gap = 0;
  Point point, normal;  // into the part
};

// The middle of an edge near a convex corner of the other shape, apart from the edge's own convex ends. sign: of the
// edge's normal, so that it points into the part.
void add_on_edges(std::vector<NearContact>& found, const Outline& corners, const Outline& edges, double sign,
                  double near) {
  for (std::size_t i = 0; i < corners.from.size(); ++i) {
    if (!corners.is_convex(i)) continue;
    for (std::size_t j = 0; j < edges.from.size(); ++j) {
      const Point from_start = corners.from[i] - edges.from[j];
      const double gap = edges.normal[j].dot(from_start), along = edges.along[j].dot(from_start);
      if (std::abs(gap) > near || along < -1e-3 || along > edges.length[j] + 1e-3) continue;
      const std::size_t end = edges.after[j];
      if (edges.is_convex(j) && from_start.norm() < near) continue;
      if (edges.is_convex(end) && (corners.from[i] - edges.from[end]).norm() < near) continue;
      found.push_back({gap, corners.from[i], sign * edges.normal[j]});
    }
  }
}

// Convex corner near convex corner: apart as long as one of the lines parts them; the one with the largest gap stands.
void add_on_corners(std::vector<NearContact>& found, const Outline& part, const Outline& fixed, double near) {
  for (std::size_t i = 0; i < part.from.size(); ++i) {
    for (std::size_t j = 0; j < fixed.from.size(); ++j) {
      const Point apart = part.from[i] - fixed.from[j];
      if (!part.is_convex(i) || !fixed.is_convex(j) || apart.norm() >= near) continue;
      NearContact best{-1e300, {}, {}};
      for (const std::size_t edge : {fixed.before[j], j}) {
        const Point& normal = fixed.normal[edge];
        if (part.lies_towards(i, normal) && normal.dot(apart) > best.gap) {
          best = {normal.dot(apart), part.from[i], normal};
        }
      }
      for (const std::size_t edge : {part.before[i], i}) {
        const Point normal = -part.normal[edge];
        if (fixed.lies_towards(j, part.normal[edge]) && normal.dot(apart) > best.gap) {
          best = {normal.dot(apart), fixed.from[j], normal};
        }
      }
      if (best.gap > -1e300) found.push_back(best);
    }
  }
}

struct Stepper {
  const SteppingScene& scene;
  const SteppingOptions& options;
  Outline fixed;
  Place stiffness;
  double reach = 0;

  struct Solution {
    Place q;
    std::vector<NearContact> contacts;
    std::vector<double> force, slip;  // of each contact: normal force, displacement along its tangent
  };

  Polygon placed_part(const Place& q) const { return placed(scene.part, q[2], q.head<2>()); }

  std::vector<NearContact> near_contacts(const Place& q) const {
    const Outline part = outline_of({placed_part(q)});
    std::vector<NearContact> found;
    add_on_edges(found, part, fixed, 1, options.near_mm);
    add_on_edges(found, fixed, part, -1, options.near_mm);
    add_on_corners(found, part, fixed, options.near_mm);
    return found;
  }

  double size(const Place& dq) const { return dq.head<2>().norm() + reach * std::abs(dq[2]); }

  // K (carrier - q) - viscosity K (q - q0) + W lambda = 0 with the gaps linearised at the last solution.
  std::optional<Solution> solve(const Place& carrier, const Place& q0, double viscosity, int& solves) const {
    Solution solution{q0, {}, {}, {}};
    for (int round = 0; round < options.linearisations; ++round) {
      const Place q = solution.q;
      const Place free = ((carrier - q) - viscosity * (q - q0)) / (1 + viscosity);
      solution.contacts = near_contacts(q);
      const auto k = static_cast<Eigen::Index>(solution.contacts.size());
      Eigen::MatrixXd normal(3, k), tangent(3, k);
      Eigen::VectorXd rhs = Eigen::VectorXd::Zero(4 * k);
      for (Eigen::Index i = 0; i < k; ++i) {
        const NearContact& contact = solution.contacts[static_cast<std::size_t>(i)];
        const Point lever = contact.point - q.head<2>(), left = turned_left(contact.normal);
        normal.col(i) << contact.normal, cross(lever, contact.normal);
        tangent.col(i) << left, cross(lever, left);
        rhs[i] = contact.gap + normal.col(i).dot(free);
        rhs[k + i] = tangent.col(i).dot(q - q0 + free);
        rhs[2 * k + i] = -rhs[k + i];
      }
      // Forces in units of the stiffness, so that the matrix is of order one.
      const double unit = stiffness[0];
      Eigen::MatrixXd wrenches(3, 3 * k);
      wrenches << normal, tangent, -tangent;
      const Eigen::MatrixXd gives = (unit / (1 + viscosity)) * stiffness.cwiseInverse().asDiagonal() * wrenches;
      Eigen::MatrixXd m = Eigen::MatrixXd::Zero(4 * k, 4 * k);
      m.topLeftCorner(3 * k, 3 * k) = wrenches.transpose() * gives;
      for (Eigen::Index i = 0; i < k; ++i) {
        m(k + i, 3 * k + i) = m(2 * k + i, 3 * k + i) = 1;
        m(3 * k + i, i) = scene.friction;
        m(3 * k + i, k + i) = m(3 * k + i, 2 * k + i) = -1;
      }
      ++solves;
      Eigen::VectorXd z = Eigen::VectorXd::Zero(4 * k);
      if (k > 0) {
        // Where Lemke's method ends on a ray, from other sides.
        auto found = solve_lcp(m, rhs, Eigen::VectorXd::Ones(4 * k));
        for (int side = 1; !found && side < 6; ++side) {
          found = solve_lcp(m, rhs, Eigen::VectorXd::LinSpaced(4 * k, 1, 1 + side * side).cwiseSqrt());
        }
        if (!found) return std::nullopt;
        z = *found;
      }
      const Place dq = free + gives * z.head(3 * k);
      solution.q = q + dq;
      solution.force.assign(static_cast<std::size_t>(k), 0);
      solution.slip.assign(static_cast<std::size_t>(k), 0);
      for (Eigen::Index i = 0; i < k; ++i) {
        solution.force[static_cast<std::size_t>(i)] = unit * z[i];
        solution.slip[static_cast<std::size_t>(i)] = tangent.col(i).dot(solution.q - q0);
      }
      if (size(solution.q - q0) > options.most_mm) break;  // to be repeated with more viscosity
    }
    return solution;
  }
};

// Why the part stands still, from the contacts that carry.
InsertionOutcome stopped_by(const Stepper::Solution& end, double friction, double step_mm) {
  const double cosine = 1 / std::hypot(1, friction);
  bool sticks = false, wedged = false;
  for (std::size_t i = 0; i < end.contacts.size(); ++i) {
    if (end.force[i] <= 1e-7) continue;
    sticks = sticks || std::abs(end.slip[i]) < 1e-5 * step_mm;
    for (std::size_t j = 0; j < i; ++j) {
      if (end.force[j] <= 1e-7) continue;
      const Point between = end.contacts[j].point - end.contacts[i].point;
      const double least = cosine * between.norm();
      wedged = wedged || (between.norm() > 1e-6 && between.dot(end.contacts[i].normal) >= least &&
                          -between.dot(end.contacts[j].normal) >= least);
    }
  }
  if (!sticks) return InsertionOutcome::Blocked;
  return wedged ? InsertionOutcome::Wedged : InsertionOutcome::Jammed;
}

double overlap_mm2(const Polygon& part, const std::vector<Polygon>& fixed) {
  double area = 0;
  for (const Polygon& piece : intersection(loops_of(part), loops_of(fixed))) {
    for (const Loop& loop : loops_of(piece)) area += signed_area(loop);
  }
  return area;
}

}  // namespace

SteppedInsertion step_insertion(const SteppingScene& scene, const Configuration& start,
                                const SteppingOptions& options) {
  Stepper stepper{scene,
                  options,
                  outline_of(scene.fixed),
                  {scene.stiffness.kx_n_per_mm, scene.stiffness.ky_n_per_mm, scene.stiffness.ktheta_nmm_per_rad}};
  for (const Point& corner : scene.part.outer) stepper.reach = std::max(stepper.reach, corner.norm());
  const Point direction = scene.approach.direction, left = turned_left(direction);
  const Place began(start.x_mm, start.y_mm, start.theta_rad);
  Place q = began;
  SteppedInsertion result;
  const auto finish = [&](InsertionOutcome outcome) {
    result.outcome = outcome;
    result.q = {q[0], q[1], q[2]};
    result.overlap_mm2 = overlap_mm2(stepper.placed_part(q), scene.fixed);
    return result;
  };
  if (overlap_mm2(stepper.placed_part(q), scene.fixed) > 1e-6) return finish(InsertionOutcome::Blocked);
  const auto reaches_goal = [&] {
    const Point moved = q.head<2>() - scene.drawn.position();
    result.depth_mm = moved.dot(direction);
    result.lateral_mm = moved.dot(left);
    result.tilt_rad = q[2] - scene.drawn.theta_rad;
    return result.depth_mm >= scene.goal.depth_mm && std::abs(result.lateral_mm) <= scene.goal.lateral_mm &&
           std::abs(result.tilt_rad) <= scene.goal.tilt_rad;
  };
  Stepper::Solution last;
  double axial = 0;
  const int steps = static_cast<int>(std::ceil(scene.approach.distance_mm / options.step_mm));
  const double step = scene.approach.distance_mm / steps;
  for (int i = 1; i <= steps; ++i) {
    Place carrier = options.damped ? q : began;
    carrier.head<2>() += (options.damped ? 1 : i) * step * direction;
    for (int substep = 0;; ++substep) {
      if (substep == options.most_substeps) return finish(InsertionOutcome::Undecided);
      double viscosity = 0;
      auto solution = stepper.solve(carrier, q, viscosity, result.solves);
      while (solution && stepper.size(solution->q - q) > options.most_mm && viscosity < 1e6) {
        viscosity = 2 * (1 + viscosity) * stepper.size(solution->q - q) / options.most_mm;
        solution = stepper.solve(carrier, q, viscosity, result.solves);
      }
      if (!solution) return finish(InsertionOutcome::Undecided);
      q = solution->q;
      if (reaches_goal()) return finish(InsertionOutcome::Assembled);
      if (viscosity == 0) {
        last = *solution;
        break;
      }
    }
    const double axial_before = axial;
    axial = stepper.stiffness.cwiseProduct(carrier - q).head<2>().dot(direction);
    result.work_nmm += (axial + axial_before) / 2 * step;
    result.peak_axial_n = std::max(result.peak_axial_n, axial);
    if (scene.approach.max_force_n && axial >= *scene.approach.max_force_n) break;
  }
  return finish(stopped_by(last, scene.friction, step));
}

}  // namespace formotion::witness
