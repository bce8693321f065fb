// The lowest way between places, over cells that are refined only where they leave the answer open.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "analysis/energy/energy_cells.hpp"

namespace formotion {

struct WayDemand {
  double gap_mm = 0.1;  // between the bounds
  long most_cells = 1000000;
  bool want_path = true;
  double most_mm = std::numeric_limits<double>::infinity();  // where no way is this low, nothing more is asked
};

// Heights, not rises.
struct LowestWay {
  double lower_mm = -std::numeric_limits<double>::infinity();  // infinite where no way exists
  std::optional<double> upper_mm;
  std::vector<Place> path;
  std::size_t highest = 0;       // its place in path
  int source = -1, target = -1;  // which of those given the path joins
  std::string why;
};

// Where ways begin and end: a place, or (none) outside.
using WayEnd = std::optional<Place>;

// What is refined for one question serves the next.
class WaySearch {
 public:
  // under_mm: a height below everything, at which the part passes under all obstacles from one side to the other.
  WaySearch(const OpenHeights& heights, const CellLayout& layout, double under_mm);

  LowestWay lowest_way(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to, const WayDemand& demand);
  long looked_at() const { return cells_.looked_at(); }

 private:
  struct Flood {
    std::vector<double> cost;  // of nodes; infinite beyond the limit
    std::vector<int> source;   // of nodes
    int reached_from = -1, reached = -1;
    double reached_mm = std::numeric_limits<double>::infinity();
  };
  struct Chain {
    std::vector<int> crossings, nodes;  // node k lies before crossing k; one more node than crossings
    int source = -1, target = -1;
    double least_mm = 0;  // no motion along it is lower, by the places on its crossings
  };
  struct Trial {
    std::vector<Place> path;
    std::size_t failed = 0;  // the node, in the chain
  };

  Flood flood(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to, double beyond_mm) const;
  std::optional<Chain> chain(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to, double most_mm,
                             bool tighten);
  Trial follow(const Chain& chain, const std::vector<WayEnd>& from, const std::vector<WayEnd>& to,
               double most_mm) const;
  std::optional<Place> raised(const Place& place, double most_mm) const;
  std::vector<Place> moved_off(const Place& place, double most_mm) const;
  bool settle(const std::vector<WayEnd>& from, const std::vector<WayEnd>& to, double chain_mm, double most_mm,
              bool tighten, int tries, LowestWay& way, std::vector<int>& failed);
  void sharpen(const Chain& chain, const std::vector<WayEnd>& from, const std::vector<WayEnd>& to, double most_mm,
               std::vector<Place>& path) const;
  std::vector<int> loose_cells(const Flood& forward, const Flood& backward, double level_mm, bool& tightened);
  bool split_largest(std::vector<int> cells);
  std::vector<int> nodes_of(const WayEnd& end) const;

  const OpenHeights* heights_;
  EnergyCells cells_;
  double under_mm_;
};

}  // namespace formotion
