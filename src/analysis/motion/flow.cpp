#include "analysis/motion/flow.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace formotion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLongestTurn_rad = 0.3;
constexpr double kNoTurning = 1e-10;  // of the speed: slower turning is none
constexpr double kSingular = 1e-12;   // of two contacts' normals
constexpr double kTurnsBack = 0.3;    // cosine between a curve's direction at a step's start and end

double slide_sign(ContactMode mode) { return mode == ContactMode::SlideLeft ? 1 : -1; }

double size(const Twist& twist, double gyration) { return speed(twist, gyration); }

}  // namespace

MotionLaw law_of(const Drive& drive, const MovingShape& part) {
  return damped(drive.force, part.gyration_mm, drive.friction);
}

ContactState Flow::state(std::size_t i, const Configuration& q) const {
  return contact_state(space_->part, space_->obstacles, pairs_[i], q.position(), std::cos(q.theta_rad),
                       std::sin(q.theta_rad));
}

// With one contact (derived; mechanics of a damped body): sliding along f = nu - s mu tau with
// lambda = -(nu . F) / (1 + (r x nu)(r x f) / rho^2); sticking: turning about the contact.
Twist Flow::single_twist(const Configuration& q) const {
  const ContactState contact = state(0, q);
  const Point &r = contact.lever, &n = contact.normal, &force = drive_.force;
  const double gyration2 = space_->part.gyration_mm * space_->part.gyration_mm;
  if (modes_[0] == ContactMode::Stick) {
    const double turning = -force.dot(turned_left(r)) / (r.squaredNorm() + gyration2);
    return {-turning * turned_left(r), turning};
  }
  const Point f = n - slide_sign(modes_[0]) * drive_.friction * turned_left(n);
  const double moment = cross(r, f);
  const double carried = -n.dot(force) / (1 + cross(r, n) * moment / gyration2);
  return {force + carried * f, carried * moment / gyration2};
}

// Along the curve of two contacts, in scaled coordinates; unit, its sense not chosen. Zero where they coincide.
Eigen::Vector3d Flow::curve_direction(const Configuration& q) const {
  const double gyration = space_->part.gyration_mm;
  Eigen::Vector3d a = state(0, q).gradient(), b = state(1, q).gradient();
  a[2] /= gyration;
  b[2] /= gyration;
  return a.cross(b).stableNormalized();
}

std::optional<Flow> Flow::through(const ContactSpace& space, const Drive& drive, std::span<const ContactPair> pairs,
                                  const Motion& motion, const Configuration& q) {
  Flow flow(space, drive);
  flow.pairs_.assign(pairs.begin(), pairs.end());
  flow.modes_ = motion.modes;
  for (const ContactPair& pair : pairs) flow.indices_.push_back(space.index_of(pair));
  flow.start_ = q;
  const double gyration = space.part.gyration_mm, fast = size(motion.twist, gyration);
  if (!(fast > 0)) return std::nullopt;
  flow.turning_ = motion.twist.angular < 0 ? -1 : 1;
  const bool turns = std::abs(motion.twist.angular) * gyration > kNoTurning * fast;
  if (pairs.empty()) {
    flow.kind_ = MotionKind::Free;
  } else if (pairs.size() == 1) {
    const ContactPair& pair = pairs.front();
    const bool round = pair.kind != ContactKind::CornerOnEdge && space.obstacles.corners[pair.fixed].radius_mm > 0;
    if (motion.modes.front() == ContactMode::Stick) {
      if (!turns) return std::nullopt;
      flow.kind_ = MotionKind::Pivot;
      flow.integrates_ = round;
    } else {
      flow.kind_ = pair.kind == ContactKind::CornerOnEdge && !turns ? MotionKind::Translation : MotionKind::Slide;
      flow.integrates_ = pair.kind != ContactKind::CornerOnEdge;
    }
  } else if (!turns) {
    flow.kind_ = MotionKind::Translation;
  } else if (pairs.size() == 2) {
    flow.kind_ = MotionKind::Curve;
    const Eigen::Vector3d twist(motion.twist.linear.x(), motion.twist.linear.y(), motion.twist.angular * gyration);
    flow.curve_start_ = flow.curve_direction(q);
    if (flow.curve_start_.dot(twist) < 0) flow.curve_start_ = -flow.curve_start_;
  } else {
    return std::nullopt;
  }
  flow.direction_ = {motion.twist.linear / motion.twist.linear.norm(), 0};
  if (flow.kind_ != MotionKind::Free && flow.kind_ != MotionKind::Translation) flow.direction_ = {};
  return flow;
}

double Flow::small_step() const {
  const bool by_angle = !integrates_ && (kind_ == MotionKind::Pivot || kind_ == MotionKind::Slide);
  return by_angle ? 1e-5 : 1e-4;
}

double Flow::longest_step() const {
  switch (kind_) {
    case MotionKind::Free:
    case MotionKind::Translation:
      return kInfinity;
    case MotionKind::Pivot:
      if (!integrates_) return kLongestTurn_rad;
      break;
    case MotionKind::Slide:
      if (!integrates_) {
        // Fast along the edge near the orientation in which the contact force passes through the centre of mass.
        const ContactState contact = state(0, start_);
        const Point f = contact.normal - slide_sign(modes_[0]) * drive_.friction * turned_left(contact.normal);
        const double sine = cross(contact.lever, f) / (contact.lever.norm() * f.norm());
        return std::min(kLongestTurn_rad, 0.75 * std::abs(sine));
      }
      break;
    case MotionKind::Curve:
      break;
  }
  const double turning = std::abs(tangent(start_).angular);
  const double most = std::min(kLongestTurn_rad / std::max(turning, 1e-12), 0.25 * space_->part.reach_mm);
  return integrates_ ? std::min(most, last_step_) : most;
}

Configuration Flow::at(double h, double& error) const {
  error = 0;
  return integrates_ ? integrated(h, &error) : at(h);
}

void Flow::settle() {
  const double gyration = space_->part.gyration_mm;
  for (int i = 0; i < 2 && pairs_.size() == 1; ++i) start_ = put_back(start_);
  if (pairs_.size() != 2) return;
  for (int i = 0; i < 3; ++i) {  // the least displacement that closes both gaps
    const ContactState a = state(0, start_), b = state(1, start_);
    Eigen::Matrix<double, 2, 3> rows;
    rows.row(0) = a.gradient().transpose();
    rows.row(1) = b.gradient().transpose();
    rows.col(2) /= gyration;
    const Eigen::Matrix2d square = rows * rows.transpose();
    if (square.determinant() < kSingular) return;
    const Eigen::Vector3d by = -rows.transpose() * (square.inverse() * Eigen::Vector2d(a.gap_mm, b.gap_mm));
    if (!(by.norm() < 10 * kContact_mm)) return;
    start_ = {start_.x_mm + by[0], start_.y_mm + by[1], start_.theta_rad + by[2] / gyration};
  }
}

void Flow::restart(const Configuration& q, double h) {
  start_ = q;
  if (kind_ == MotionKind::Curve) {
    const Eigen::Vector3d direction = curve_direction(q);
    curve_start_ = direction.dot(curve_start_) < 0 ? Eigen::Vector3d(-direction) : direction;
  }
  if (integrates_) last_step_ = 4 * h;
}

Twist Flow::tangent(const Configuration& q) const {
  if (kind_ == MotionKind::Free || kind_ == MotionKind::Translation) return direction_;
  const double gyration = space_->part.gyration_mm;
  if (kind_ == MotionKind::Curve) {
    Eigen::Vector3d direction = curve_direction(q);
    const double forward = direction.dot(curve_start_);
    direction /= forward;  // the parameter is the way along the starting direction
    return {{direction[0], direction[1]}, direction[2] / gyration};
  }
  const Twist twist = single_twist(q);
  const double rate = integrates_ ? size(twist, gyration) : std::abs(twist.angular);
  return {twist.linear / rate, twist.angular / rate};
}

Eigen::Vector3d Flow::scaled_direction(const Configuration& q) const {
  const Twist t = tangent(q);
  return {t.linear.x(), t.linear.y(), t.angular * space_->part.gyration_mm};
}

Configuration Flow::at(double h) const {
  switch (kind_) {
    case MotionKind::Free:
    case MotionKind::Translation:
      return {start_.x_mm + h * direction_.linear.x(), start_.y_mm + h * direction_.linear.y(), start_.theta_rad};
    case MotionKind::Pivot: {
      if (integrates_) return integrated(h, nullptr);
      const Point lever = state(0, start_).lever;
      const Point p = start_.position() + lever - rotated(lever, turning_ * h);
      return {p.x(), p.y(), start_.theta_rad + turning_ * h};
    }
    case MotionKind::Slide:
      return integrates_ ? integrated(h, nullptr) : slide(h);
    case MotionKind::Curve:
      return along_curve(h);
  }
  return start_;
}

// dp_tau/dtheta = rho^2 (F_tau / k + f_tau) / (r x f) + (F_tau / k)(r x nu), k = -F . nu, r = |a| (cos psi, sin psi),
// integrates to -rho^2 (F_tau / k + f_tau) / (|a| |f|) ln|tan((phi - psi) / 2)| + (F_tau / k) r . nu (derived).
Configuration Flow::slide(double h) const {
  const ContactState contact = state(0, start_);
  const Point &n = contact.normal, t = turned_left(n), &r = contact.lever;
  const double along = -slide_sign(modes_[0]) * drive_.friction;
  const Point f = n + along * t;
  const double pressed = -drive_.force.dot(n), ratio = drive_.force.dot(t) / pressed;
  const Point r_end = rotated(r, turning_ * h);
  const double gyration2 = space_->part.gyration_mm * space_->part.gyration_mm;
  // tan(u / 2) = sin u / (1 + cos u), u from r to f.
  const auto log_tan = [&](const Point& lever) {
    const double s = cross(lever, f), c = lever.dot(f), l = lever.norm() * f.norm();
    return c >= 0 ? std::log(std::abs(s) / (l + c)) : std::log((l - c) / std::abs(s));
  };
  const double moved = -gyration2 * (ratio + along) / (r.norm() * f.norm()) * (log_tan(r_end) - log_tan(r)) +
                       ratio * (r_end.dot(n) - r.dot(n));
  const Point p = start_.position() + moved * t - (r_end.dot(n) - r.dot(n)) * n;
  return {p.x(), p.y(), start_.theta_rad + turning_ * h};
}

// The place of the curve whose way along the starting direction is h.
Configuration Flow::along_curve(double h) const {
  const double gyration = space_->part.gyration_mm;
  // A second-order guess, then Newton on both gaps and the way.
  const auto moved = [&](const Eigen::Vector3d& by) {
    return Configuration{start_.x_mm + by[0], start_.y_mm + by[1], start_.theta_rad + by[2] / gyration};
  };
  Eigen::Vector3d way = h * curve_start_;
  if (const Configuration half = moved(way / 2); h != 0) {
    const Eigen::Vector3d direction = curve_direction(half);
    const double forward = direction.dot(curve_start_);
    if (std::abs(forward) > 0.5) way = h / forward * direction;
  }
  Eigen::Matrix3d rows;
  rows.row(2) = curve_start_.transpose();
  for (int i = 0; i < 6; ++i) {
    const Configuration q = moved(way);
    const ContactState a = state(0, q), b = state(1, q);
    rows.row(0) = a.gradient().transpose();
    rows.row(1) = b.gradient().transpose();
    rows(0, 2) /= gyration;
    rows(1, 2) /= gyration;
    const Eigen::Vector3d off(a.gap_mm, b.gap_mm, curve_start_.dot(way) - h);
    const Eigen::Vector3d correction = rows.inverse() * off;
    if (!correction.allFinite()) break;
    way -= correction;
    if (correction.norm() < 1e-13 * (1 + std::abs(h))) break;
  }
  const Configuration q = moved(way);
  // Beyond where the curve turns back there is no such place, or another branch's: not a number.
  const bool on_curve = std::max(std::abs(state(0, q).gap_mm), std::abs(state(1, q).gap_mm)) < 1e-9;
  const double forward = curve_direction(q).dot(curve_start_) * curve_direction(start_).dot(curve_start_);
  if (!on_curve || forward < kTurnsBack) return {NAN, NAN, NAN};
  return q;
}

Configuration Flow::put_back(Configuration q) const {
  const double gyration = space_->part.gyration_mm;
  for (int i = 0; i < 2; ++i) {
    const ContactState contact = state(0, q);
    const double turn = cross(contact.lever, contact.normal) / gyration;
    const double by = contact.gap_mm / (1 + turn * turn);
    q.x_mm -= by * contact.normal.x();
    q.y_mm -= by * contact.normal.y();
    q.theta_rad -= by * turn / gyration;
  }
  return q;
}

Configuration Flow::integrated(double h, double* error) const {
  using State = std::array<double, 3>;
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper;
  State q{start_.x_mm, start_.y_mm, start_.theta_rad}, off{};
  const auto rate = [&](const State& at, State& out, double) {
    const Twist t = tangent({at[0], at[1], at[2]});
    out = {t.linear.x(), t.linear.y(), t.angular};
  };
  stepper.do_step(rate, q, 0.0, h, off);
  if (error) *error = std::hypot(off[0], off[1], off[2] * space_->part.gyration_mm);
  return put_back({q[0], q[1], q[2]});
}

double Flow::force_reserve(const Configuration& q) const {
  if (pairs_.empty()) return kInfinity;
  std::vector<ContactPoint> contacts;
  for (std::size_t i = 0; i < pairs_.size(); ++i) contacts.push_back(point_of(state(i, q)));
  const std::optional<Motion> motion = motion_of_modes(contacts, modes_, law_of(drive_, space_->part));
  if (!motion) return -1;  // the contacts have come together
  double least = kInfinity;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactForce& force = motion->forces[i];
    least = std::min(least, force.normal);
    if (modes_[i] == ContactMode::Stick) {
      least = std::min(least, drive_.friction * force.normal - std::abs(force.tangential));
    } else if (drive_.friction > 0) {
      least = std::min(least, slide_sign(modes_[i]) * sliding_speed(contacts[i], motion->twist));
    }
  }
  if (kind_ == MotionKind::Curve) {  // without friction nothing else says that it stops and turns back
    const Twist t = tangent(q);
    const double gyration = space_->part.gyration_mm;
    least =
        std::min(least, (motion->twist.linear.dot(t.linear) + motion->twist.angular * t.angular * gyration * gyration) /
                            size(t, gyration));
  } else if (kind_ == MotionKind::Pivot) {
    least = std::min(least, turning_ * motion->twist.angular * space_->part.gyration_mm);
  }
  return least / drive_.force.norm();
}

double Flow::reserve(const Configuration& q) const {
  if (!std::isfinite(q.x_mm)) return -1;
  double least = force_reserve(q);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const ContactState contact = state(i, q);
    least = std::min({least, contact.along_mm + kContact_mm, contact.extent_mm + kContact_mm - contact.along_mm});
    const DirectionRange& range = space_->orientations[indices_[i]];
    const double off = std::remainder(q.theta_rad - range.from_rad - range.width_rad / 2, 2 * std::numbers::pi);
    least = std::min(least, range.width_rad / 2 + kContact_rad - std::abs(off));
    if (pairs_[i].kind != ContactKind::CornerOnCorner) continue;
    const DirectionRange& cone = space_->part.corners[pairs_[i].moving].normals;
    const double facing = std::atan2(-contact.normal.y(), -contact.normal.x()) - q.theta_rad;
    const double aside = std::remainder(facing - cone.from_rad - cone.width_rad / 2, 2 * std::numbers::pi);
    least = std::min(least, cone.width_rad / 2 + kContact_rad - std::abs(aside));
  }
  return least;
}

}  // namespace formotion
