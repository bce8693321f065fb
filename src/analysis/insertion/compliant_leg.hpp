// A stretch of a compliant part's way on which its contacts keep their modes, while the carrier goes along a straight
// line of configurations: the equations of equilibrium and contact, solved by Newton's method at every place.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "analysis/insertion/insertion.hpp"
#include "analysis/motion/guided_path.hpp"

namespace formotion {

// The carrier's straight line in (x, y, theta): at h it is at from + h * way.
struct CarrierLine {
  Eigen::Vector3d from, way;
  Eigen::Vector3d at(double h) const { return from + h * way; }
};

inline Eigen::Vector3d vector_of(const Configuration& q) { return {q.x_mm, q.y_mm, q.theta_rad}; }
inline Configuration configuration_of(const Eigen::Vector3d& q) { return {q[0], q[1], q[2]}; }

// The spring's force and moment on the part.
inline Eigen::Vector3d spring_load(const Eigen::Vector3d& stiffness, const Eigen::Vector3d& carrier,
                                   const Configuration& q) {
  return stiffness.cwiseProduct(carrier - vector_of(q));
}

class CompliantLeg final : public GuidedPath {
 public:
  // q: where the leg begins; contacts that stick hold on to where they touch there. modes: in the order of pairs, none
  // breaks. stiffness: kx, ky, ktheta. The space must outlive it.
  CompliantLeg(const ContactSpace& space, const Eigen::Vector3d& stiffness, double friction, const CarrierLine& line,
               std::vector<ContactPair> pairs, std::vector<ContactMode> modes, const Configuration& q);

  const std::vector<ContactPair>& pairs() const override { return pairs_; }
  const std::vector<ContactMode>& modes() const { return modes_; }
  Configuration at(double h) const override;
  Twist rate(double h, const Configuration& q) const override;
  std::vector<ContactForce> forces(double h) const;

  // What is left at h until the contacts can no longer do as their modes say, as Flow::reserve: forces count by the
  // displacement (mm) of the stiffer of kx and ky, slips by mm per mm of the carrier.
  double reserve(double h) const;

  // Later solutions are looked for from here on.
  void restart(double h) const;
  int solves() const { return solves_; }

 private:
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
  struct Solution {
    double h = 0;
    Vector z;     // x, y, theta, then of every contact its normal force and, if it sticks, its tangential one
    Vector rate;  // d z / d h
    bool good = false;
  };

  const Solution& solved(double h) const;
  void residual(const Vector& z, double h, Vector& off, Square& slope) const;

  const ContactSpace* space_;
  Eigen::Vector3d stiffness_;
  double friction_;
  CarrierLine line_;
  std::vector<ContactPair> pairs_;
  std::vector<ContactMode> modes_;
  std::vector<std::size_t> indices_;  // of the pairs in the space
  std::vector<ContactState> anchors_;
  Configuration start_;
  int unknowns_ = 3;
  mutable Solution base_, last_;
  mutable int solves_ = 0;
};

}  // namespace formotion
