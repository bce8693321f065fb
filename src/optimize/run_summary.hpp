// A run as its reports need it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "optimize/evaluated.hpp"

namespace formotion {

struct RunProgress {
  std::int64_t evaluations = 0;  // designs so far
  std::int64_t stages = 0;       // single stages so far
  std::int64_t work = 0;         // of both, in the unit of Score::work
  std::int64_t spent() const { return evaluations + stages; }
  std::int64_t front_size = 0;
  std::vector<double> best;                // per objective, among feasible designs; empty while there is none
  std::vector<std::vector<double>> front;  // the losses of the front's designs
};

// Something that a search found out other than designs, for the report: what it left out, or what is proved.
struct Finding {
  std::string topic;    // "pruned", "ranked" or "proved"
  std::string subject;  // "gap + gap"
  std::string text;     // one sentence
};

struct RunSummary {
  std::int64_t evaluations = 0, budget = 0, feasible = 0;  // evaluations: of designs and of single stages
  std::int64_t stages = 0;                                 // those of single stages among them
  std::uint64_t seed = 0;
  std::string program_version;
  bool complete = false;
  std::vector<Evaluated> front;      // non-dominated feasible designs; if there is none, the nearest infeasible ones
  std::vector<Evaluated> sample;     // at most 3,000 of all evaluations, evenly spaced over the run
  std::vector<RunProgress> history;  // one entry a batch
  std::vector<double> least, most;   // losses over all feasible designs; empty while there is none
  std::vector<Finding> findings;
  std::map<std::string, std::int64_t> failures;  // candidates without a score, by name(Failure)
  std::map<std::string, std::string> stamps;     // by the design's id: what its verification said, as JSON
};

}  // namespace formotion
