// Which features of a problem are stages by themselves, and which of them are of one kind.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "applications/feeder/part_model.hpp"
#include "problem/staged_problem.hpp"

namespace formotion::feeder {

// A feature with expressions in the kind's own variables.
struct FeatureKind {
  FeatureSpec feature;
  StageKind stage;
};

struct StageCatalogue {
  std::vector<FeatureKind> kinds;
  std::vector<std::vector<StageUse>>
      stages;  // of every topology, in the order of travel; empty where it does not compose
};

// A topology composes if each of its features can be judged alone: none is placed absolutely, no two share a variable,
// and what acts of a feature on any pose is past before the next one begins. Features are of one kind if they are the
// same up to the names of their variables.
StageCatalogue stage_catalogue(const FeederSpec& spec, const PartModel& part);

// A bound of how far any boundary point of the feature's void, or any blade, moves when every variable moves by up to
// its half width. None for obstacles, rails, arcs, and for voids that a cutter rounds.
std::optional<double> displacement_mm(const FeatureSpec& feature, const Manufacture& manufacture,
                                      std::span<const double> half_widths);

}  // namespace formotion::feeder
