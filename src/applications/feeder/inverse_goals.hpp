// Goals on the motion constraints themselves: this configuration must be free, blocked, supported or unsupported by so
// much, that facet must move outward by so much. What a design makes of them.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "applications/feeder/active_search.hpp"
#include "applications/feeder/evaluation.hpp"
#include "applications/feeder/judge.hpp"

namespace formotion::feeder {

// One answer a goal, in their order. Designs whose shapes are impossible answer none of them: every goal then lacks the
// part's diameter.
std::vector<GoalAnswer> goal_answers(const DesignCase& design, const Layout& layout);

// What is missing, as violations.
std::vector<Violation> violations_of(const std::vector<GoalAnswer>& goals);

// The facet as written, whose gap at the goal's reference is minus how far it has moved.
GapRef facet_gap(const FacetGoal& goal, const TracedShapes<double>& shapes);
// Whether the two features are there, and can touch at this orientation without their neighbours overlapping.
bool facet_exists(const FacetGoal& goal, const TracedShapes<double>& shapes);

// Sets the references of all facet goals. Says why one of them names no facet at the starting values: (its place in the
// list, in words).
std::optional<std::pair<std::size_t, std::string>> place_references(FeederSpec& spec);

}  // namespace formotion::feeder
