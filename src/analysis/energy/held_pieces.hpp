// The free configurations on two or more contacts at which a part can be held, as pieces of curves and single points.
#pragma once

#include <vector>

#include "analysis/energy/equilibria.hpp"

namespace formotion {

struct HeldPiece {
  std::vector<Configuration> samples;  // along it, ends included; one: a point
  Verdict verdict = Verdict::Possible;
  Configuration middle;
};

// Curves of two contacts, cut where a third touches, where the part stops being free, and where what holds changes:
// where a force or a third edge crosses a face that two edges of friction cones span, or where an edge's moment
// vanishes (all that a verdict can change by, derived). Between cuts one place speaks for all. Pieces meet at their
// ends.
std::vector<HeldPiece> held_pieces(const ContactSpace& space, const PushSet& push, double grid_rad);

// Of all that touches at a configuration, which is taken as free; of convex corners that meet each alternative alone.
// Impossible on fewer than two contacts.
Verdict verdict_at(const ContactSpace& space, const PushSet& push, const Configuration& q);

}  // namespace formotion
