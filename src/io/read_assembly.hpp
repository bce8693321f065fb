// The pieces of an assembly's problem file; issues gather in the list.
#pragma once

#include "applications/assembly/spec.hpp"
#include "io/problem_reader.hpp"

namespace formotion {

assembly::PartSpec read_assembly_part(const nlohmann::ordered_json& value, ReadContext& context);
// Friction, support and approach; intervals written there count as uncertain under their keys' names.
void read_assembly_environment(const nlohmann::ordered_json* value, assembly::AssemblySpec& spec, ReadContext& context);
// The goal with what it requires; the part says which aspects there are.
void read_assembly_goal(const nlohmann::ordered_json& value, assembly::AssemblySpec& spec, ReadContext& context);
void read_assembly_uncertainty(const nlohmann::ordered_json* value, assembly::AssemblySpec& spec, ReadContext& context);
// ignored: what a design file may say beside its shapes.
assembly::DesignSpec read_fixed_shapes(const nlohmann::ordered_json& value, const std::string& pointer,
                                       const std::vector<std::string>& ignored, ReadContext& context);

}  // namespace formotion
