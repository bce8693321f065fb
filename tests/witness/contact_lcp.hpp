// The law of motion at contacts with friction as a linear complementarity problem, solved without looking at modes.
//
//   twist = D (F + Wn ln + Wt (l+ - l-)),  D = diag(1, 1, 1 / gyration^2)
//   0 <= ln complementary to Wn^T twist >= 0,  0 <= l+- to +-Wt^T twist + s >= 0,  0 <= s to f ln - l+ - l- >= 0
//
// (Stewart & Trinkle 1996, Anitescu & Potra 1997 for the form; Wn, Wt the wrenches of unit forces along each contact's
// normal and tangent.)
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/geometry/polygon.hpp"

namespace formotion::witness {

struct LcpContact {
  Point normal;  // unit, into the part
  Point lever;   // from the centre of mass
};

struct LcpCase {
  std::vector<LcpContact> contacts;
  Eigen::Vector3d wrench = Eigen::Vector3d::Zero();  // applied: force, moment
  double friction = 0;
  double gyration_mm = 1;
};

using Twist3 = Eigen::Vector3d;  // velocity of the centre of mass, angular velocity

// A z >= 0 with m z + q >= 0 complementary to it, by Lemke's method with the lexicographic rule; cover: positive, one
// entry a variable, which solution is found depends on it. None if it ends on a ray.
std::optional<Eigen::VectorXd> solve_lcp(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                         const Eigen::VectorXd& cover);

// One solution of the case; cover as in solve_lcp, 4 entries a contact. None if Lemke's method ends on a ray.
std::optional<Twist3> twist_by_lemke(const LcpCase& lcp, const Eigen::VectorXd& cover);

// The twists of all complementary bases that are feasible: 16 bases for one contact, 4,096 for three.
std::vector<Twist3> twists_by_bases(const LcpCase& lcp, double tolerance = 1e-9);

// How far the twist is from the law, in the units of force: the distance of D^-1 twist - F from the cone of the contact
// forces that it admits (by Caratheodory, all triples), plus the depth of its penetrations.
double violation(const LcpCase& lcp, const Twist3& twist, double tolerance = 1e-9);

}  // namespace formotion::witness
