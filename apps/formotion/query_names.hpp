// Corners and edges by their numbers in the problem file, whatever the analysis made of them (turned around, cleaned of
// straight corners, united): found again by where they are.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "applications/feeder/feeder_problem.hpp"
#include "applications/feeder/world.hpp"

namespace formotion {

class WrittenNames {
 public:
  WrittenNames(const feeder::FeederProblem& problem, int topology, std::span<const double> values,
               const std::string& aspect, const feeder::World& world);

  // In the part's frame (the centre of mass, as given). None for corners that only the union of layers has.
  std::optional<int> moving_corner(const Point& p) const;
  // The edge along `along` on which p lies.
  std::optional<int> moving_edge(const Point& p, const Point& along) const;

  // Component and number; in the world. likely: the component that it should be of.
  std::pair<int, int> fixed_corner(const Point& p, int likely) const;
  std::pair<int, int> fixed_edge(const Point& p, const Point& along, int likely) const;

 private:
  std::vector<Loop> part_;                // the outline, then holes; with layers: those of one after those of another
  std::vector<std::vector<Loop>> fixed_;  // by component; a pin: one loop of its centre
};

}  // namespace formotion
