// The worst case of a design over its uncertain values: what is delivered, whatever they are, and what decides.
#pragma once

#include "applications/feeder/judge.hpp"
#include "applications/feeder/part_spread.hpp"
#include "applications/feeder/turning.hpp"

namespace formotion::feeder {

// A design as it has been judged without uncertainties.
struct JudgedCase {
  const DesignCase& design;
  const Layout& layout;
  const TurningEvaluation& travels;
  const Metrics& metrics;
  std::vector<bool> wanted;  // of every arrival: whether it serves the goal where it is delivered
  bool turns = false;        // among obstacles
};

struct WorstCaseOptions {
  bool in_detail = false;       // sentences
  bool wants_tolerance = true;  // costs more than the rest
};

struct WorstCase {
  Metrics metrics;
  // What is wrong in some member, in mm (of probability where parts turn), 0 iff nothing is; and each of it.
  double lacking = 0;
  std::vector<Violation> violations;
  std::optional<std::string> bites;
  std::int64_t work = 0;
};

// Every number is a bound: no member delivers less or jams more (docs/uncertainty.md: for which members, and where
// that rests on members that were looked at).
WorstCase worst_case(const JudgedCase& judged, const Spreads& spreads, const WorstCaseOptions& options);

// Of a design that is not feasible as drawn: about how much more it lacks for being feasible at the worst. An estimate
// without any further sweep, for the search to walk along: every margin or depth shall come to what errors may cost.
double robust_shortfall(const JudgedCase& judged, const PartSpread& spread);

}  // namespace formotion::feeder
