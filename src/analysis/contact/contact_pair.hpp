// One contact: a feature of the moving part with a feature of the obstacles, as a constraint on (x, y, theta).
//
// With the contact's unit normal nu pointing into the part and the lever r from the centre of mass to the contact, the
// gap's gradient is (nu, r x nu): the wrench of a unit normal force (derived; Sacks & Joskowicz 2010, ch. 3).
#pragma once

#include <Eigen/Core>

#include "analysis/contact/shapes.hpp"

namespace formotion {

enum class ContactKind {
  CornerOnEdge,    // a corner of the part on a fixed edge (contract: VE; "type B")
  EdgeOnCorner,    // an edge of the part on a fixed corner, sharp or round (contract: EV; "type A")
  CornerOnCorner,  // a corner of the part on a round fixed corner (contract: VE)
};

struct ContactPair {
  ContactKind kind = ContactKind::CornerOnEdge;
  int moving = 0;  // place in MovingShape::corners or edges
  int fixed = 0;   // place in Obstacles::edges or corners
  bool operator==(const ContactPair&) const = default;
};

struct ContactState {
  double gap_mm = 0;     // > 0: apart (of the lines; where the features are, along_mm says)
  Point normal;          // unit, into the part
  Point lever;           // from the centre of mass to the contact point
  double along_mm = 0;   // the contact's place on the edge, 0 to extent_mm when it is on it; for CornerOnCorner on the
  double extent_mm = 0;  //   arc of the fixed corner (direction in its cone times radius)
  Eigen::Vector3d gradient() const { return {normal.x(), normal.y(), cross(lever, normal)}; }
};

// At a configuration with c = cos theta, s = sin theta.
ContactState contact_state(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                           const Point& position, double c, double s);

// The orientations at which the two features can touch without their neighbours overlapping (local feasibility): closed
// range of theta, modulo a full turn. Empty for features that never can.
std::optional<DirectionRange> contact_orientations(const MovingShape& part, const Obstacles& obstacles,
                                                   const ContactPair& pair);

// All pairs of features that can ever touch, in a fixed order.
std::vector<ContactPair> contact_pairs(const MovingShape& part, const Obstacles& obstacles);

}  // namespace formotion
