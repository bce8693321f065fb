// What a compliant part may do next at one place: the continuous ways on, the first motions of a snap, the forces that
// hold it at rest.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/insertion/compliant_leg.hpp"

namespace formotion {

// A way on: a leg on which the part moves, or rest among all that touches.
struct Continuation {
  std::optional<CompliantLeg> leg;
  Configuration ahead;
  double reserve = 0;
};

// How a snap may begin: a velocity (mm, rad) and what carries meanwhile.
struct FirstMotion {
  Eigen::Vector3d velocity;
  std::vector<ContactPair> pairs;
  std::vector<ContactMode> modes;
};

// Reserves below minus this end a mode.
inline constexpr double kLegReserve = 2e-9;

class WaysOn {
 public:
  // stiffness: kx, ky, ktheta. The space must outlive it.
  WaysOn(const ContactSpace& space, const Eigen::Vector3d& stiffness, double friction)
      : space_(space), stiffness_(stiffness), friction_(friction) {}

  // All ways from q that are continuous when the carrier goes on along the line, those with the most in reserve first;
  // ways that lead alike are one. ahead: how far along the line is looked. solves grows by the equations solved.
  std::vector<Continuation> continuous(const Configuration& q, const CarrierLine& line, double ahead,
                                       int& solves) const;

  // The motions of a part at q that its contacts leave it under the spring's pull, damped as it is stiff (D = 1 / K).
  // Rest is none of them.
  std::vector<FirstMotion> first_motions(const Configuration& q, const Eigen::Vector3d& carrier) const;

  // Places h in (0, far), ascending, of the carrier on its line at which a part that rests at q may begin to move
  // without a jump: there the spring is held by two edges of friction cones alone, those of one contact (the part
  // turns about it) or of two (it slides on both).
  std::vector<double> ways_off_rest(const Configuration& q, const CarrierLine& line, double far) const;

  // Forces that hold the part at q against the spring, on all that touches; none if no forces can.
  std::optional<std::vector<CarriedContact>> held(const Configuration& q, const Eigen::Vector3d& carrier) const;

  // The leg of a first motion, with the contacts that carry in it; none if it is not continuous when the carrier goes
  // on along the line, or not consistent.
  std::optional<Continuation> continued(const Configuration& q, const FirstMotion& motion, const CarrierLine& line,
                                        double ahead, int& solves) const;

 private:
  void try_choice(const Configuration& q, const std::vector<TouchCluster>& clusters, const std::vector<int>& chosen,
                  const CarrierLine& line, double ahead, std::vector<Continuation>& found, int& solves) const;
  void try_leg(const Configuration& q, const std::vector<TouchCluster>& clusters, const std::vector<int>& chosen,
               const std::vector<ContactPair>& pairs, const std::vector<ContactMode>& modes, const CarrierLine& line,
               double ahead, std::vector<Continuation>& found, int& solves) const;
  bool stays_free(const std::vector<TouchCluster>& clusters, const std::vector<int>& chosen,
                  const Configuration& next) const;
  MotionLaw law(const Configuration& q, const Eigen::Vector3d& carrier) const;
  double scaled_size(const Eigen::Vector3d& v) const;

  const ContactSpace& space_;
  Eigen::Vector3d stiffness_;
  double friction_;
};

// Whether two of the contacts see each other inside both of their friction cones.
bool is_wedged(std::span<const CarriedContact> contacts, double friction);

}  // namespace formotion
