// How a part moves while the same contacts carry in the same modes.
//
// In closed form: translations, pivots about a sticking contact, and a corner that slides on a straight edge (the
// motion is a function of theta alone). A motion guided by two contacts is placed on their curve by Newton's method.
// An edge sliding on a fixed corner, and contacts with round corners, are integrated (Runge-Kutta-Fehlberg 7(8),
// Boost.Odeint) and put back on the contact.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "analysis/motion/contact_law.hpp"
#include "analysis/motion/contact_space.hpp"
#include "analysis/motion/guided_path.hpp"
#include "analysis/motion/projection.hpp"

namespace formotion {

// Forces of a Drive as the contact law wants them.
MotionLaw law_of(const Drive& drive, const MovingShape& part);

class Flow final : public GuidedPath {
 public:
  // The flow through q. motion: consistent there, modes in the order of pairs (all of which carry: none breaks).
  // None if these contacts leave no such motion.
  static std::optional<Flow> through(const ContactSpace& space, const Drive& drive, std::span<const ContactPair> pairs,
                                     const Motion& motion, const Configuration& q);

  MotionKind kind() const { return kind_; }
  const std::vector<ContactPair>& pairs() const override { return pairs_; }
  const std::vector<ContactMode>& modes() const { return modes_; }
  const Configuration& start() const { return start_; }

  // The configuration after h (mm of scaled arc length; rad for pivots and corners sliding on edges). For the
  // integrated kinds one step from the start: h at most longest_step().
  Configuration at(double h) const override;
  // d configuration / d h at a place of this flow.
  Twist tangent(const Configuration& q) const;
  Twist rate(double, const Configuration& q) const override { return tangent(q); }
  // A look-ahead: small against every feature, large against rounding.
  double small_step() const;
  // Steps no longer than this follow the flow within its error bounds; infinite for translations.
  double longest_step() const;
  // The same with the step's error (mm); 0 where at() is exact.
  Configuration at(double h, double& error) const;
  // Puts the start exactly on its contacts (it is found to within the contact slack): paths that run into the same
  // contacts become the same.
  void settle();
  // Goes on from q, which is at(h).
  void restart(const Configuration& q, double h);

  // What is left until the contacts can no longer do as their modes say: the least of normal forces, friction
  // reserves, sliding speeds (all relative to the drive), and distances (mm) to the ends of features and orientations
  // (rad). Negative: they cannot.
  double reserve(const Configuration& q) const;

 private:
  Flow(const ContactSpace& space, const Drive& drive) : space_(&space), drive_(drive) {}
  ContactState state(std::size_t i, const Configuration& q) const;
  Twist single_twist(const Configuration& q) const;
  Eigen::Vector3d curve_direction(const Configuration& q) const;
  Eigen::Vector3d scaled_direction(const Configuration& q) const;
  Configuration slide(double h) const;
  Configuration along_curve(double h) const;
  Configuration integrated(double h, double* error) const;
  Configuration put_back(Configuration q) const;
  double force_reserve(const Configuration& q) const;

  const ContactSpace* space_;
  Drive drive_;
  std::vector<ContactPair> pairs_;
  std::vector<std::size_t> indices_;  // of the pairs in space
  std::vector<ContactMode> modes_;
  MotionKind kind_ = MotionKind::Free;
  bool integrates_ = false;
  Configuration start_;
  Twist direction_;              // of translations; at the start
  double turning_ = 1;           // sign of the angular velocity, for kinds that go by theta
  Eigen::Vector3d curve_start_;  // unit, scaled
  double last_step_ = 1;         // mm, what the integration took last
};

}  // namespace formotion
