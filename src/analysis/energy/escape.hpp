// How high a part must rise to get out of where it rests: a lower bound that no motion can undercut, and a motion that
// gives an upper bound.
//
// Without anything that adds energy, a part whose energy is m g E stays in the connected set of free configurations of
// heights up to E that holds its start (mechanics.md 3.3; derived). Height alone decides, whatever friction and impacts
// do. The least E for which this set reaches outside is the escape height.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/energy/gravity.hpp"
#include "analysis/motion/contact_space.hpp"

namespace formotion {

// Where a part is out: its centre of mass beyond these, across gravity.
struct EscapeGoal {
  double from_mm = 0, to_mm = 0;
};
// Of the obstacles: their extent across gravity.
EscapeGoal beyond(const Obstacles& obstacles, const Gravity& gravity);

struct EscapeOptions {
  double gap_mm = 0.1;          // refined until upper - lower is at most this
  double least_cell_mm = 0.05;  // never smaller cells than this; angles by the part's reach
  long most_cells = 1000000;    // looked at, for one bracket; the bracket found by then is returned
  bool want_path = true;        // else the upper bound is left out: what is free is looked at in places alone
};

struct EscapeBracket {
  double lower_mm = 0;                // rise over the start; no way out stays below it. Infinite: enclosed
  std::optional<double> upper_mm;     // the rise of `path`; none where no path was found
  std::vector<Configuration> path;    // from the start to outside: each next one is reached by a straight motion in
                                      // (x, y, theta) that is free (or touches)
  std::optional<Configuration> pass;  // the highest place of the path
  long cells = 0;
  std::string why;  // where the bracket is wider than asked for; "enclosed" where no way out exists
};

// The start must be free (touching counts as free).
EscapeBracket escape(const ContactSpace& space, const Gravity& gravity, const Configuration& start,
                     const EscapeGoal& goal, const EscapeOptions& options = {});

// The same question between two places: how high a part must rise over the start to get to `end`.
EscapeBracket rise_between(const ContactSpace& space, const Gravity& gravity, const Configuration& start,
                           const Configuration& end, const EscapeOptions& options = {});

// The merge tree of rests: which of them join, at what height, as energy grows; outside is one of them (the last).
struct Pass {
  int first = 0, second = 0;  // rests, or groups of earlier passes (numbers from starts.size() + 1 on)
  double lower_mm = 0;        // heights (not rises), as brackets above
  std::optional<double> upper_mm;
  std::optional<Configuration> at;
};
struct MergeTree {
  std::vector<Pass> passes;             // ascending in height
  std::vector<EscapeBracket> brackets;  // of each start, to outside
  long cells = 0;
};
MergeTree merge_tree(const ContactSpace& space, const Gravity& gravity, const std::vector<Configuration>& starts,
                     const EscapeGoal& goal, const EscapeOptions& options = {});

// Whether a part let go at `from`, at rest, is certain to end in the rest at `at`, the only one of its puddle: if it is
// free, connected to `at` below the height that it falls from, and that height is below every pass out of the puddle
// (Brost 1991's energy puddle). rise_mm: the height of the lowest pass over the rest (its bracket's lower bound).
// False also where that is not shown within the options.
bool surely_captured(const ContactSpace& space, const Gravity& gravity, const Configuration& at, double rise_mm,
                     const Configuration& from, const EscapeOptions& options = {});
// The same of a part that passes `from` with the energy of one that is at rest at the height energy_mm.
bool surely_captured(const ContactSpace& space, const Gravity& gravity, const Configuration& at, double rise_mm,
                     const Configuration& from, double energy_mm, const EscapeOptions& options = {});

}  // namespace formotion
