// Searches laid out for questions of escape.hpp.
#pragma once

#include "analysis/energy/escape.hpp"
#include "analysis/energy/lowest_way.hpp"

namespace formotion {

// A search whose cells keep to the places given: what fits without clearance there is found. Between these ends, or
// (none) with room to pass beside all obstacles.
class LaidOutSearch {
 public:
  LaidOutSearch(const ContactSpace& space, const Gravity& gravity, const std::vector<Configuration>& places,
                const std::optional<EscapeGoal>& goal, const EscapeOptions& options);
  LaidOutSearch(const LaidOutSearch&) = delete;
  LaidOutSearch& operator=(const LaidOutSearch&) = delete;

  const OpenHeights& heights() const { return heights_; }
  WaySearch& search() { return search_; }

 private:
  OpenHeights heights_;
  WaySearch search_;
};

WayDemand demand_of(const EscapeOptions& options);
// As a rise over the start, which the path begins with.
EscapeBracket bracket_of(const LowestWay& way, const OpenHeights& heights, const Configuration& start);
// The highest place of a way's path.
std::optional<Configuration> pass_of(const LowestWay& way, const OpenHeights& heights);
bool is_beyond(const EscapeGoal& goal, const Place& place);

}  // namespace formotion
