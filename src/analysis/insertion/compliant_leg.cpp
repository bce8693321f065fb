#include "analysis/insertion/compliant_leg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace formotion {
namespace {

constexpr int kMostIterations = 14;
constexpr double kSolved_mm = 1e-12;  // Newton's last step
constexpr double kFarthest_mm = 1e3;  // a step beyond has lost its way

double slide_sign(ContactMode mode) { return mode == ContactMode::SlideLeft ? 1 : -1; }

double left_of(const DirectionRange& range, double direction) {
  const double off = std::remainder(direction - range.from_rad - range.width_rad / 2, 2 * std::numbers::pi);
  // Less than the slack of touching: where one feature gives way to the next both still touch.
  return range.width_rad / 2 + kContact_rad / 2 - std::abs(off);
}

}  // namespace

CompliantLeg::CompliantLeg(const ContactSpace& space, const Eigen::Vector3d& stiffness, double friction,
                           const CarrierLine& line, std::vector<ContactPair> pairs, std::vector<ContactMode> modes,
                           const Configuration& q)
    : space_(&space),
      stiffness_(stiffness),
      friction_(friction),
      line_(line),
      pairs_(std::move(pairs)),
      modes_(std::move(modes)),
      start_(q) {
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    indices_.push_back(space.index_of(pairs_[i]));
    anchors_.push_back(contact_state(space.part, space.obstacles, pairs_[i], q.position(), c, s));
    unknowns_ += modes_[i] == ContactMode::Stick ? 2 : 1;
  }
  base_.z = Vector::Zero(unknowns_);
  base_.z.head<3>() = vector_of(q);
  base_.rate = Vector::Zero(unknowns_);
  base_.good = true;
  last_.h = std::numeric_limits<double>::quiet_NaN();
}

// Equilibrium K (carrier - q) + sum of (f, r x f) = 0; gaps; slips since the leg's start where contacts stick. The
// slopes of wrenches: a corner's lever turns with the part; an edge's normal does; a corner on a round corner turns the
// normal by its way along the arc (derived).
void CompliantLeg::residual(const Vector& z, double h, Vector& off, Square& slope) const {
  const Configuration q = configuration_of(z.head<3>());
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  slope.setZero(unknowns_, unknowns_);
  off.setZero(unknowns_);
  off.head<3>() = spring_load(stiffness_, line_.at(h), q);
  for (int k = 0; k < 3; ++k) slope(k, k) = -stiffness_[k];
  int row = 3;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const ContactPair& pair = pairs_[i];
    const ContactState state = contact_state(space_->part, space_->obstacles, pair, q.position(), c, s);
    const Point &n = state.normal, &r = state.lever, t = turned_left(n);
    const bool sticks = modes_[i] == ContactMode::Stick;
    const Eigen::Vector3d w_n(n.x(), n.y(), cross(r, n)), w_t(t.x(), t.y(), cross(r, t));
    const double normal = z[row];
    const double ratio = sticks ? 0 : -slide_sign(modes_[i]) * friction_;
    const double tangential = sticks ? z[row + 1] : ratio * normal;
    const Point f = normal * n + tangential * t;
    off.head<3>() += normal * w_n + tangential * w_t;
    slope.block<3, 1>(0, row) = w_n + ratio * w_t;
    const double inwards = r.dot(f);
    if (pair.kind == ContactKind::CornerOnEdge) {
      slope(2, 2) -= inwards;
    } else if (pair.kind == ContactKind::EdgeOnCorner) {
      const double radius = space_->obstacles.corners[pair.fixed].radius_mm;
      slope(0, 2) -= f.y();
      slope(1, 2) += f.x();
      slope(2, 0) -= f.y();
      slope(2, 1) += f.x();
      slope(2, 2) += inwards - radius * normal;
    } else {
      const double distance = state.gap_mm + space_->obstacles.corners[pair.fixed].radius_mm;
      const Eigen::RowVector3d turns = w_t.transpose() / distance;  // of the normal, by q
      slope.row(0).head<3>() -= f.y() * turns;
      slope.row(1).head<3>() += f.x() * turns;
      slope.row(2).head<3>() += inwards * turns;
      slope(2, 2) -= inwards;
    }
    off[row] = state.gap_mm;
    slope.row(row).head<3>() = w_n.transpose();
    ++row;
    if (!sticks) continue;
    const ContactState& anchor = anchors_[i];
    slope.block<3, 1>(0, row) = w_t;
    if (pair.kind == ContactKind::EdgeOnCorner) {
      const double radius = space_->obstacles.corners[pair.fixed].radius_mm;
      off[row] = state.along_mm - anchor.along_mm + radius * (q.theta_rad - start_.theta_rad);
      slope.row(row).head<3>() = w_t.transpose();
    } else {
      const Point held = turned_left(anchor.normal);
      off[row] = held.dot(q.position() + r - start_.position() - anchor.lever);
      slope.row(row).head<3>() = Eigen::RowVector3d(held.x(), held.y(), cross(r, held));
    }
    ++row;
  }
}

const CompliantLeg::Solution& CompliantLeg::solved(double h) const {
  if (last_.h == h) return last_;
  last_.h = h;
  last_.good = false;
  last_.z = base_.z + (h - base_.h) * base_.rate;
  Vector off;
  Square slope;
  const double reach = space_->part.reach_mm;
  for (int i = 0; i < kMostIterations; ++i) {
    ++solves_;
    residual(last_.z, h, off, slope);
    const Eigen::PartialPivLU<Square> lu(slope);
    const Vector step = lu.solve(off);
    if (!step.allFinite()) return last_;
    last_.z -= step;
    const double moved = std::max({std::abs(step[0]), std::abs(step[1]), std::abs(step[2]) * reach});
    if (moved > kFarthest_mm) return last_;
    if (moved > kSolved_mm && i + 1 < kMostIterations) continue;
    if (moved > 1e-9) return last_;
    // The same slope serves for the rate: d off / d h is the spring's.
    Vector pull = Vector::Zero(unknowns_);
    pull.head<3>() = stiffness_.cwiseProduct(line_.way);
    last_.rate = -lu.solve(pull);
    last_.good = last_.rate.allFinite();
    return last_;
  }
  return last_;
}

Configuration CompliantLeg::at(double h) const {
  const Solution& found = solved(h);
  if (!found.good) return {NAN, NAN, NAN};
  return configuration_of(found.z.head<3>());
}

Twist CompliantLeg::rate(double h, const Configuration&) const {
  const Solution& found = solved(h);
  if (!found.good) return {{NAN, NAN}, NAN};
  return {{found.rate[0], found.rate[1]}, found.rate[2]};
}

std::vector<ContactForce> CompliantLeg::forces(double h) const {
  const Solution& found = solved(h);
  std::vector<ContactForce> forces(pairs_.size());
  int row = 3;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    forces[i].normal = found.z[row++];
    forces[i].tangential =
        modes_[i] == ContactMode::Stick ? found.z[row++] : -slide_sign(modes_[i]) * friction_ * forces[i].normal;
  }
  return forces;
}

double CompliantLeg::reserve(double h) const {
  const Configuration q = at(h);
  if (!std::isfinite(q.x_mm)) return -1;
  const std::vector<ContactForce> carried = forces(h);
  const Twist twist = rate(h, q);
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  const double stiff = std::max(stiffness_[0], stiffness_[1]);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const ContactPair& pair = pairs_[i];
    const ContactState state = contact_state(space_->part, space_->obstacles, pair, q.position(), c, s);
    least = std::min(least, carried[i].normal / stiff);
    if (modes_[i] == ContactMode::Stick) {
      least = std::min(least, (friction_ * carried[i].normal - std::abs(carried[i].tangential)) / stiff);
    } else if (friction_ > 0) {
      least = std::min(least, slide_sign(modes_[i]) * sliding_speed(point_of(state), twist));
    }
    least = std::min({least, state.along_mm + kContact_mm, state.extent_mm + kContact_mm - state.along_mm,
                      left_of(space_->orientations[indices_[i]], q.theta_rad)});
    if (pair.kind != ContactKind::CornerOnCorner) continue;
    const double facing = std::atan2(-state.normal.y(), -state.normal.x()) - q.theta_rad;
    least = std::min(least, left_of(space_->part.corners[pair.moving].normals, facing));
  }
  return least;
}

void CompliantLeg::restart(double h) const {
  const Solution& found = solved(h);
  if (found.good) base_ = found;
}

}  // namespace formotion
