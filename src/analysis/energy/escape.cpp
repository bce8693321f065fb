#include "analysis/energy/escape.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/way_layout.hpp"

namespace formotion {
namespace {

constexpr double kRise_mm = 1e-9;  // rounding of heights

EscapeBracket refused() {
  EscapeBracket bracket;
  bracket.why = "the part overlaps the obstacles there";
  return bracket;
}

}  // namespace

EscapeBracket escape(const ContactSpace& space, const Gravity& gravity, const Configuration& start,
                     const EscapeGoal& goal, const EscapeOptions& options) {
  if (!is_free(space.part, space.obstacles, start)) return refused();
  const double across = gravity.across_mm(start.position());
  if (is_beyond(goal, {across, 0, 0})) {
    EscapeBracket out;
    if (options.want_path) {
      out.upper_mm = 0;
      out.path = {start};
      out.pass = start;
    }
    return out;
  }
  LaidOutSearch laid_out(space, gravity, {start}, goal, options);
  const WayEnd from = laid_out.heights().place_of(start);
  const LowestWay way = laid_out.search().lowest_way({from}, {std::nullopt}, demand_of(options));
  EscapeBracket bracket = bracket_of(way, laid_out.heights(), start);
  bracket.cells = laid_out.search().looked_at();
  return bracket;
}

EscapeBracket rise_between(const ContactSpace& space, const Gravity& gravity, const Configuration& start,
                           const Configuration& end, const EscapeOptions& options) {
  if (!is_free(space.part, space.obstacles, start) || !is_free(space.part, space.obstacles, end)) return refused();
  LaidOutSearch laid_out(space, gravity, {start, end}, std::nullopt, options);
  const WayEnd from = laid_out.heights().place_of(start), to = laid_out.heights().place_of(end);
  const LowestWay way = laid_out.search().lowest_way({from}, {to}, demand_of(options));
  EscapeBracket bracket = bracket_of(way, laid_out.heights(), start);
  bracket.cells = laid_out.search().looked_at();
  return bracket;
}

bool surely_captured(const ContactSpace& space, const Gravity& gravity, const Configuration& at, double rise_mm,
                     const Configuration& from, const EscapeOptions& options) {
  return surely_captured(space, gravity, at, rise_mm, from, gravity.height_mm(from), options);
}

bool surely_captured(const ContactSpace& space, const Gravity& gravity, const Configuration& at, double rise_mm,
                     const Configuration& from, double energy_mm, const EscapeOptions& options) {
  if (!(energy_mm >= gravity.height_mm(at) - kRise_mm && energy_mm < gravity.height_mm(at) + rise_mm)) return false;
  if (!is_free(space.part, space.obstacles, from) || !is_free(space.part, space.obstacles, at)) return false;
  LaidOutSearch laid_out(space, gravity, {from, at}, std::nullopt, options);
  WayDemand demand = demand_of(options);
  demand.gap_mm = 0;
  demand.want_path = true;
  demand.most_mm = energy_mm + kRise_mm;
  const WayEnd start = laid_out.heights().place_of(from), end = laid_out.heights().place_of(at);
  const LowestWay way = laid_out.search().lowest_way({start}, {end}, demand);
  return way.upper_mm && *way.upper_mm <= energy_mm + kRise_mm;
}

}  // namespace formotion
