// What the report page shows of one assembly design: the joint, its success region, insertions, wrong ways, free space.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "applications/assembly/assembly_problem.hpp"

namespace formotion {

// The page's problem.assembly.
nlohmann::ordered_json asked_json(const assembly::AssemblySpec& spec, std::span<const double> values);
// The page's joint of a design; with_space: its configuration space, some 100 kB.
nlohmann::ordered_json joint_json(const assembly::AssemblyProblem& problem, int topology,
                                  std::span<const double> values, const assembly::AssemblyEvaluation& evaluation,
                                  bool with_space);

}  // namespace formotion
