// Problem files and design files: JSON in, specifications out. The contract is docs/problem-format.md.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "applications/assembly/spec.hpp"
#include "applications/feeder/spec.hpp"
#include "applications/nest/spec.hpp"
#include "io/input_error.hpp"

namespace formotion {

struct SearchSpec {
  std::int64_t evaluations = 20000;
  std::uint64_t seed = 1;
};

struct ProblemFile {
  std::string path;  // as given
  std::string name;
  std::string slug;  // name made fit for a folder: "el bracket" -> "el_bracket"
  std::string kind;  // feeder, assembly, fixture or pallet
  feeder::FeederSpec feeder;
  // Of the other kinds; feeder then says nothing.
  std::optional<assembly::AssemblySpec> assembly;
  std::optional<nest::NestSpec> nest;
  SearchSpec search;
  std::string canonical;  // the problem as run: canonical JSON text, files it refers to written into it as outlines
};

// Whatever the kind.
std::span<const Variable> variables_of(const ProblemFile& file);
std::size_t topologies_in(const ProblemFile& file);
std::size_t aspects_in(const ProblemFile& file);

// The run's folder unless the user names one: results/SLUG.
inline std::string default_folder(const ProblemFile& file) { return "results/" + file.slug; }

// Throws InputError with every issue of the file. Files that it names are read relative to it.
ProblemFile read_problem_file(const std::string& path);
// The same from text (path is for messages and relative files): what fuzzing feeds.
ProblemFile parse_problem(const std::string& text, const std::string& path);

// A design file ({"features": [...]}, {"fixed_mm": [...]} for assemblies, {"nest_mm": [...]} for nests: an entry of
// pareto.json or designs/ID.json is one) replaces the problem's topologies by this one; its optional "values" are
// variables' values.
void apply_design_file(ProblemFile& problem, const std::string& path,
                       std::vector<std::pair<std::string, double>>& values);

}  // namespace formotion
