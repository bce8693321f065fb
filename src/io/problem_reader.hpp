// The pieces of a problem file, one function a subject; issues gather in the list.
#pragma once

#include "applications/feeder/spec.hpp"
#include "io/json_reader.hpp"

namespace formotion {

// What the pieces share.
struct ReadContext {
  IssueList& issues;
  std::string folder;                 // files are named relative to it
  std::vector<std::string> names;     // of the variables
  nlohmann::ordered_json& canonical;  // the document, with files replaced by what they hold
};

feeder::PartSpec read_part(const nlohmann::ordered_json& value, ReadContext& context, bool thickness_required = true);
// Outline, holes and centre of mass of a part that lists no aspects, or its drawing; up.height_mm is read before.
void read_outlines(ObjectReader& object, const nlohmann::ordered_json& part, feeder::AspectSpec& up,
                   ReadContext& context);
// features: the array of a design; canonical: the same array in the canonical document.
feeder::DesignSpec read_features(const nlohmann::ordered_json& features, const std::string& pointer,
                                 ReadContext& context, nlohmann::ordered_json& canonical);
// The catalogue alone; expand_grammar makes the topologies, when everything else of the problem is read and good.
feeder::GrammarSpec read_grammar(const nlohmann::ordered_json& value, ReadContext& context);
void expand_grammar(feeder::FeederSpec& spec, IssueList& issues);
feeder::Environment read_environment(const nlohmann::ordered_json* value, ReadContext& context);
feeder::Goal read_goal(const nlohmann::ordered_json& value, const feeder::PartSpec& part, ReadContext& context);
// The goal's configurations and facets.
void read_constraint_goals(ObjectReader& object, const feeder::PartSpec& part, feeder::Goal& goal,
                           ReadContext& context);
feeder::Manufacture read_manufacture(const nlohmann::ordered_json* value, ReadContext& context);
feeder::Uncertainty read_uncertainty(const nlohmann::ordered_json* value, ReadContext& context);

// At least `least` corners.
AffineLoop read_loop(const nlohmann::ordered_json& value, const std::string& pointer, ReadContext& context,
                     std::size_t least = 3);
std::vector<AffineLoop> read_loops(const nlohmann::ordered_json* value, const std::string& pointer,
                                   ReadContext& context);
Loop constant_loop(const AffineLoop& loop);  // the constants of its expressions
AffineLoop literal_loop(const Loop& loop);
bool is_literal(const AffineLoop& loop);
nlohmann::ordered_json loop_json(const Loop& loop);
nlohmann::ordered_json loops_json(const std::vector<Loop>& loops);
Affine in_radians(Affine degrees);
std::string resolved(const std::string& file, const ReadContext& context);

}  // namespace formotion
