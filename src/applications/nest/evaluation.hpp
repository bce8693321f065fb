// What the nest application says of one design.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/contact/configuration.hpp"
#include "analysis/energy/equilibria.hpp"
#include "analysis/insertion/success_region.hpp"

namespace formotion::nest {

struct Violation {
  std::string what, where;  // a sentence; a place in the design
  double by = 0;
};

// How a start ends when the part is let go at rest and sinks without bouncing.
enum class NestOutcome { Seated, Misseated, Escaped, Blocked, Ambiguous, Undecided };
inline constexpr int kNestOutcomes = 6;
const char* name(NestOutcome outcome);

// What does not exist for the kind of nest, or could not be found, is missing.
struct Metrics {
  std::optional<double> seated_fraction;   // fixtures
  std::optional<int> wrong_equilibria;     // sets of equilibria with friction that do not hold the seat
  std::optional<double> repeatability_mm;  // how far a point of the part is apart in two seated ends at most
  std::optional<double> resisted_weights;  // the least force, over directions, that moves the part out of the seat,
                                           // over its weight (or the push)
  std::optional<double> resisted_moment_mm;
  std::optional<double> goal_escape_height_mm;         // pallets: no lower way out of the seat
  std::optional<double> worst_wrong_escape_height_mm;  // of all other rests: a way out that is no higher
  std::optional<double> selectivity_mm;
  std::optional<double> capture_fraction;
};

struct NestRest {
  std::string aspect;
  Configuration at;
  double height_mm = 0;            // over the seat's
  std::vector<Configuration> set;  // ends, where it is more than a point
  bool is_seat = false;
  double escape_low_mm = 0;              // no way out rises less
  std::optional<double> escape_high_mm;  // of a way out; none where none was found
  std::vector<Configuration> way_out;    // in detail
  std::string why;                       // where the bracket is wide
  double drop_share = 0;                 // of parts dropped at random that come to rest here (in detail)
};

struct StartResult {
  double x_mm = 0, y_mm = 0, theta_rad = 0;  // errors
  NestOutcome outcome = NestOutcome::Undecided;
  Configuration end;  // where it rests
  // In detail. Whether it must end in the seat, by energy alone; and whether it does for every direction and friction
  // that is asked for, without bouncing.
  bool is_sure = false;
  Verdict pushed = Verdict::Impossible;
};

struct WrongSet {
  std::string aspect;
  EquilibriumSet set;
};

// Expected drops until a pocket holds the right part, and the share of pockets that end up with it, if parts are
// dropped again when they leave. Per kind of rest: its share of drops, whether it is the right one, whether parts
// leave.
struct Filling {
  std::optional<double> drops_per_part;  // none where the right one is never reached
  double right_share = 0;                // of pockets that end with a part that stays
};
// Settings of the table, at its frequency, by the point mass's bound (a rule of thumb for parts): up to which amplitude
// the seat keeps its part, and from which on every wrong rest can lose its own. The second is necessary, not
// sufficient: how fast parts leave is not known from heights (docs/nests.md).
struct ShakingWindow {
  double keeps_up_to_mm = 0;            // amplitude
  std::optional<double> loses_from_mm;  // amplitude; none where a wrong rest has no known way out
  double throws_mm = 0;                 // at the amplitude as given
  Filling filling;                      // at the amplitude as given, if what can leave does in the end
};

struct NestEvaluation {
  bool feasible = false;
  std::vector<Violation> violations;
  Metrics metrics;
  std::optional<Metrics> worst_case;
  std::optional<std::string> bites;
  std::vector<NestRest> rests;
  std::vector<StartResult> starts;
  std::vector<OutcomeRegion> regions;  // over (x, theta), one for each of the starts' y that was looked at
  std::vector<double> region_y_mm;
  std::vector<WrongSet> wrong;  // fixtures
  Verdict seat_holds = Verdict::Impossible;
  std::optional<ShakingWindow> window;
  // In detail, shares of the starts: of those that are sure, and of those that are certain.
  std::optional<double> sure_fraction, certain_fraction;
};

}  // namespace formotion::nest
