// The subcommands: each takes its options, writes results to stdout and returns the exit code.
// InputError and StoreError leave through main.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace formotion {

inline constexpr int kDone = 0, kBug = 1, kBadInput = 2, kNotFeasible = 3, kStopped = 4;

struct RunOptions {
  std::string problem, out;
  std::optional<std::int64_t> evaluations;
  std::optional<std::uint64_t> seed;
  int threads = 0;
  bool overwrite = false;
  bool json_log = false;
};

// A design of a problem: the design file (if any) in place of the problem's own, and values by name.
struct DesignChoice {
  std::string problem, design;
  std::vector<std::string> settings;  // NAME=VALUE
  std::optional<int> topology;        // of a problem that lists several; the first if none is named
};

int run_optimize(const RunOptions& options);
int run_resume(const std::string& folder, const RunOptions& options);
int run_status(const std::string& folder, const std::string& format);
int run_report(const std::string& folder, const std::string& format);
int run_export(const std::string& folder, const std::string& design, const std::string& format);
int run_evaluate(const DesignChoice& choice, const std::string& format);  // json, svg or dxf
int run_query(const DesignChoice& choice);
// folder_only: prints nothing but the folder that optimize would use.
int run_validate(const std::string& problem, bool folder_only);

}  // namespace formotion
