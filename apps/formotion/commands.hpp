// The subcommands: each takes its options, writes results to stdout and returns the exit code.
// InputError, StoreError and EngineError leave through main.
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
  std::string engine = "local";  // or work-queue: then what follows counts
  std::optional<int> port;
  int spawn_local = 0;
  std::string password_file;
  int chunk = 1;
  double candidate_seconds = 600;
};

// What a worker is given and where its report goes.
struct WorkFiles {
  std::string problem, order, report;
};

// A design of a problem: the design file (if any) in place of the problem's own, and values by name.
struct DesignChoice {
  std::string problem, design;
  std::vector<std::string> settings;  // NAME=VALUE
  std::optional<int> topology;        // of a problem that lists several; the first if none is named
};

struct VerifyCommand {
  std::vector<std::string> designs;  // ids; none: the front
  int perturbations = 64;
  std::uint64_t seed = 1;  // of the perturbations
  int threads = 0;
  std::string format = "text";  // or json
};

int run_optimize(const RunOptions& options);
int run_resume(const std::string& folder, const RunOptions& options);
int run_work(const WorkFiles& files);
int run_status(const std::string& folder, const std::string& format);
// compare: the folder of another run with the same objectives, or empty.
int run_report(const std::string& folder, const std::string& format, const std::string& compare);
int run_export(const std::string& folder, const std::string& design, const std::string& format);
int run_verify(const std::string& folder, const VerifyCommand& command);
int run_evaluate(const DesignChoice& choice, const std::string& format);  // json, svg, dxf or stl
int run_query(const DesignChoice& choice);
// folder_only: prints nothing but the folder that optimize would use.
int run_validate(const std::string& problem, bool folder_only);

}  // namespace formotion
