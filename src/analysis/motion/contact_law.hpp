// Contact mechanics of one instant: every motion that a part can have under a load, with Coulomb friction.
//
//   twist = D (load + sum of contact wrenches),  0 <= normal force, perpendicular to  0 <= separation speed,
//   |friction| <= mu normal force, against the sliding.
// D is the mobility of the support: a generalised damper (Lozano-Perez, Mason, Taylor 1984), or the inverse of a
// spring's stiffness. There may be more than one solution (Erdmann 1994; Stewart & Trinkle 1996 for the
// complementarity form): all are listed, none is chosen.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "analysis/contact/configuration.hpp"

namespace formotion {

struct ContactPoint {
  Point normal;  // unit, into the part
  Point lever;   // from the centre of mass
};

// Left: the part's material at the contact moves to the left of the normal.
enum class ContactMode { Break, Stick, SlideLeft, SlideRight };

struct MotionLaw {
  Eigen::Vector3d load;                                    // force, moment (N, N mm): what moves the part
  Eigen::Matrix3d mobility = Eigen::Matrix3d::Identity();  // symmetric, positive definite
  double friction = 0;
  double length_mm = 1;  // that makes angles comparable to lengths: a radius of gyration
};

// Diagonal mobility (1, 1, 1 / gyration^2).
MotionLaw damped(const Point& force, double gyration_mm, double friction);

struct ContactForce {
  double normal = 0, tangential = 0;  // tangential: along the normal turned left
};

struct Motion {
  Twist twist;  // in the load's units times mobility
  std::vector<ContactMode> modes;
  std::vector<ContactForce> forces;
  bool at_rest() const { return twist.linear.isZero(0) && twist.angular == 0; }
};

// The motion in which the contacts do as modes say, whether or not that is consistent (signs are not looked at).
// None if the modes' equations are singular. At most six force components.
std::optional<Motion> motion_of_modes(std::span<const ContactPoint> contacts, std::span<const ContactMode> modes,
                                      const MotionLaw& law);

// Whether signs and friction of a motion are as its modes require. tolerance: relative to the load.
bool is_consistent(std::span<const ContactPoint> contacts, const Motion& motion, const MotionLaw& law,
                   double tolerance = 1e-9);

// Forces that hold the part at rest: a non-negative combination of at most three edges of friction cones.
std::optional<std::vector<ContactForce>> equilibrium(std::span<const ContactPoint> contacts, const MotionLaw& law,
                                                     double tolerance = 1e-9);

// All consistent motions; motions that differ in their forces alone are listed once (with the first forces found),
// rest included where forces can hold it. Up to about six contacts: 4^k modes.
std::vector<Motion> consistent_motions(std::span<const ContactPoint> contacts, const MotionLaw& law);

double separation_speed(const ContactPoint& contact, const Twist& twist);
double sliding_speed(const ContactPoint& contact, const Twist& twist);  // to the left of the normal
// The twist's size with angles times length_mm.
double speed(const Twist& twist, double length_mm);

}  // namespace formotion
