// A nest with one aspect of the part in it, for one member of what is uncertain.
#pragma once

#include "analysis/energy/first_impact.hpp"
#include "applications/nest/nest_problem.hpp"

namespace formotion::nest {

// Null where shapes vanish when they are grown or shrunk.
std::unique_ptr<Scene> scene_of(const NestSpec& spec, int topology, std::span<const double> values,
                                const AspectShape& shape, const Member& member = {});
std::vector<Violation> defects_of(const NestSpec& spec, int topology, std::span<const double> values);
Configuration seat_of(const NestSpec& spec, std::span<const double> values);

// The directions and frictions that pushes can have, at this member of the rest.
PushSet push_set(const NestSpec& spec, std::span<const double> values, const Member& member = {});
// The liveliest impacts of the part on the nest, standing still.
ImpactLaw impact_law(const NestSpec& spec, std::span<const double> values, const Scene& scene);

}  // namespace formotion::nest
