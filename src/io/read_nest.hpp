// The pieces of a fixture's or pallet's problem file; issues gather in the list.
#pragma once

#include "applications/nest/spec.hpp"
#include "io/problem_reader.hpp"

namespace formotion {

// Gravity, friction, and for pallets tilt and table.
void read_nest_environment(const nlohmann::ordered_json* value, nest::NestSpec& spec, ReadContext& context);
// The seat, starts and what is required; the part says which aspects there are.
void read_nest_goal(const nlohmann::ordered_json& value, nest::NestSpec& spec, ReadContext& context);
void read_nest_uncertainty(const nlohmann::ordered_json* value, nest::NestSpec& spec, ReadContext& context);
// ignored: what a design file may say beside its shapes.
nest::DesignSpec read_nest_shapes(const nlohmann::ordered_json& value, const std::string& pointer,
                                  const std::vector<std::string>& ignored, ReadContext& context);

}  // namespace formotion
