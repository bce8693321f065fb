#include "analysis/motion/contact_law.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace formotion {
namespace {

using Wrench = Eigen::Vector3d;  // force, moment / length
using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 6>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

constexpr double kSingular = 1e-11;  // of a determinant whose columns are unit wrenches

struct Wrenches {
  Wrench normal, tangent;
};

Wrenches wrenches(const ContactPoint& contact, double length) {
  const Point& n = contact.normal;
  const Point t = turned_left(n);
  return {{n.x(), n.y(), cross(contact.lever, n) / length}, {t.x(), t.y(), cross(contact.lever, t) / length}};
}

Eigen::Matrix3d scaled_mobility(const MotionLaw& law) {
  const Eigen::Vector3d scale(1, 1, law.length_mm);
  return scale.asDiagonal() * law.mobility * scale.asDiagonal();
}

Wrench scaled_load(const MotionLaw& law) { return {law.load[0], law.load[1], law.load[2] / law.length_mm}; }

double slide_sign(ContactMode mode) { return mode == ContactMode::SlideLeft ? 1 : -1; }

}  // namespace

MotionLaw damped(const Point& force, double gyration_mm, double friction) {
  MotionLaw law;
  law.load = {force.x(), force.y(), 0};
  law.mobility(2, 2) = 1 / (gyration_mm * gyration_mm);
  law.friction = friction;
  law.length_mm = gyration_mm;
  return law;
}

double separation_speed(const ContactPoint& contact, const Twist& twist) {
  return contact.normal.dot(twist.linear + twist.angular * turned_left(contact.lever));
}
double sliding_speed(const ContactPoint& contact, const Twist& twist) {
  return turned_left(contact.normal).dot(twist.linear + twist.angular * turned_left(contact.lever));
}
double speed(const Twist& twist, double length_mm) {
  return std::sqrt(twist.linear.squaredNorm() + twist.angular * length_mm * twist.angular * length_mm);
}

std::optional<Motion> motion_of_modes(std::span<const ContactPoint> contacts, std::span<const ContactMode> modes,
                                      const MotionLaw& law) {
  Columns rows(3, 6), columns(3, 6);
  int count = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (modes[i] == ContactMode::Break) continue;
    if (count + (modes[i] == ContactMode::Stick) >= 6) return std::nullopt;
    const auto [normal, tangent] = wrenches(contacts[i], law.length_mm);
    rows.col(count) = normal;
    if (modes[i] == ContactMode::Stick) {
      columns.col(count) = normal;
      rows.col(++count) = tangent;
      columns.col(count++) = tangent;
    } else {
      columns.col(count++) = normal - slide_sign(modes[i]) * law.friction * tangent;
    }
  }
  if (count > 3) return std::nullopt;  // more equations than freedoms: singular, or rest
  const Eigen::Matrix3d mobility = scaled_mobility(law);
  const Wrench load = scaled_load(law);
  Vector forces(count);
  Wrench total = load;
  if (count > 0) {
    const Square matrix = rows.leftCols(count).transpose() * mobility * columns.leftCols(count);
    const Vector right = -rows.leftCols(count).transpose() * (mobility * load);
    if (count == 1) {
      if (std::abs(matrix(0, 0)) < kSingular) return std::nullopt;
      forces[0] = right[0] / matrix(0, 0);
    } else {
      const Eigen::PartialPivLU<Square> lu(matrix);
      if (std::abs(lu.determinant()) < kSingular) return std::nullopt;
      forces = lu.solve(right);
    }
    total += columns.leftCols(count) * forces;
  }
  const Wrench velocity = mobility * total;
  Motion motion;
  motion.twist = {{velocity[0], velocity[1]}, velocity[2] / law.length_mm};
  motion.modes.assign(modes.begin(), modes.end());
  motion.forces.resize(contacts.size());
  int next = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (modes[i] == ContactMode::Break) continue;
    motion.forces[i].normal = forces[next++];
    motion.forces[i].tangential = modes[i] == ContactMode::Stick
                                      ? forces[next++]
                                      : -slide_sign(modes[i]) * law.friction * motion.forces[i].normal;
  }
  return motion;
}

bool is_consistent(std::span<const ContactPoint> contacts, const Motion& motion, const MotionLaw& law,
                   double tolerance) {
  const double size = scaled_load(law).norm(), small = tolerance * size;
  const double slow = small * scaled_mobility(law).diagonal().maxCoeff();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactForce& force = motion.forces[i];
    switch (motion.modes[i]) {
      case ContactMode::Break:
        if (separation_speed(contacts[i], motion.twist) < -slow) return false;
        break;
      case ContactMode::Stick:
        if (force.normal < -small || std::abs(force.tangential) > law.friction * force.normal + small) return false;
        break;
      default:
        if (force.normal < -small) return false;
        if (slide_sign(motion.modes[i]) * sliding_speed(contacts[i], motion.twist) < -slow) return false;
    }
  }
  return true;
}

std::optional<std::vector<ContactForce>> equilibrium(std::span<const ContactPoint> contacts, const MotionLaw& law,
                                                     double tolerance) {
  struct Edge {
    Wrench wrench;
    std::size_t contact;
    double tangential;
  };
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto [normal, tangent] = wrenches(contacts[i], law.length_mm);
    edges.push_back({normal + law.friction * tangent, i, law.friction});
    if (law.friction > 0) edges.push_back({normal - law.friction * tangent, i, -law.friction});
  }
  const Wrench needed = -scaled_load(law);
  const double small = tolerance * needed.norm();
  const auto found = [&](std::initializer_list<std::size_t> chosen,
                         const Eigen::Vector3d& weights) -> std::optional<std::vector<ContactForce>> {
    Wrench sum = -needed;
    int k = 0;
    for (const std::size_t e : chosen) {
      if (weights[k] < -small) return std::nullopt;
      sum += weights[k++] * edges[e].wrench;
    }
    if (!(sum.norm() <= small)) return std::nullopt;
    std::vector<ContactForce> forces(contacts.size());
    k = 0;
    for (const std::size_t e : chosen) {
      forces[edges[e].contact].normal += weights[k];
      forces[edges[e].contact].tangential += weights[k++] * edges[e].tangential;
    }
    return forces;
  };
  const std::size_t n = edges.size();
  if (needed.isZero(0)) return std::vector<ContactForce>(contacts.size());
  for (std::size_t a = 0; a < n; ++a) {
    const Wrench& wa = edges[a].wrench;
    if (auto forces = found({a}, {wa.dot(needed) / wa.squaredNorm(), 0, 0})) return forces;
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      const Wrench &wa = edges[a].wrench, &wb = edges[b].wrench;
      const double aa = wa.squaredNorm(), ab = wa.dot(wb), bb = wb.squaredNorm(), det = aa * bb - ab * ab;
      if (det < kSingular * aa * bb) continue;
      const double na = wa.dot(needed), nb = wb.dot(needed);
      if (auto forces = found({a, b}, {(na * bb - nb * ab) / det, (nb * aa - na * ab) / det, 0})) return forces;
    }
  }
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      for (std::size_t c = b + 1; c < n; ++c) {
        const Wrench &wa = edges[a].wrench, &wb = edges[b].wrench, &wc = edges[c].wrench;
        const Wrench bc = wb.cross(wc);
        const double det = wa.dot(bc);
        if (std::abs(det) < kSingular * wa.norm() * wb.norm() * wc.norm()) continue;
        const Eigen::Vector3d weights(needed.dot(bc) / det, wa.dot(needed.cross(wc)) / det,
                                      wa.dot(wb.cross(needed)) / det);
        if (auto forces = found({a, b, c}, weights)) return forces;
      }
    }
  }
  return std::nullopt;
}

std::vector<Motion> consistent_motions(std::span<const ContactPoint> contacts, const MotionLaw& law) {
  std::vector<Motion> motions;
  const double size = (scaled_mobility(law) * scaled_load(law)).norm();
  const auto is_new = [&](const Twist& twist) {
    return std::none_of(motions.begin(), motions.end(), [&](const Motion& known) {
      const Twist apart{twist.linear - known.twist.linear, twist.angular - known.twist.angular};
      return speed(apart, law.length_mm) <= 1e-9 * size;
    });
  };
  if (const auto forces = equilibrium(contacts, law)) {
    Motion rest;
    rest.modes.assign(contacts.size(), ContactMode::Stick);
    rest.forces = *forces;
    motions.push_back(rest);
  }
  std::vector<ContactMode> modes(contacts.size(), ContactMode::Break);
  constexpr std::array kModes{ContactMode::Break, ContactMode::Stick, ContactMode::SlideLeft, ContactMode::SlideRight};
  std::vector<std::size_t> digits(contacts.size(), 0);
  for (;;) {
    for (std::size_t i = 0; i < digits.size(); ++i) modes[i] = kModes[digits[i]];
    if (const auto motion = motion_of_modes(contacts, modes, law)) {
      if (is_consistent(contacts, *motion, law) && is_new(motion->twist)) motions.push_back(*motion);
    }
    std::size_t i = 0;
    while (i < digits.size() && ++digits[i] == kModes.size()) digits[i++] = 0;
    if (i == digits.size()) break;
  }
  return motions;
}

}  // namespace formotion
