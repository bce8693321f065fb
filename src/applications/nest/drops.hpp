// Parts let go in a nest: where one start ends, and the shares of many.
#pragma once

#include "analysis/motion/projection.hpp"
#include "applications/nest/nest_problem.hpp"

namespace formotion::nest {

struct DropEnd {
  NestOutcome outcome = NestOutcome::Undecided;
  Configuration end;
  std::uint64_t history = 0;
};

// The part sinks from `start` without bouncing, with the scene's friction (first order, projection.hpp). Ambiguous
// where several ways with different outcomes are consistent.
// funnels: of this scene, shared by many starts, or null.
DropEnd dropped(const Scene& scene, const Configuration& seat, double within_mm, const Configuration& start,
                Funnels* funnels = nullptr);

// The shares of parts that come to rest nearest to each of `rests` (the last share: those that do not come to rest, or
// farther than within_mm from all), when they are let go over the nest and sink without friction (shaking does not let
// it hold them), evenly over the places across it and all orientations: `across` times `turns` starts, in the middles
// of a grid.
std::vector<double> drop_shares(const Scene& scene, const std::vector<NestRest>& rests, double within_mm, int across,
                                int turns);

// Per kind of rest: its share of drops, whether it is the right one, whether parts leave.
struct RestFate {
  double share = 0;
  bool is_right = false, leaves = false;
};
Filling filling(const std::vector<RestFate>& fates);

}  // namespace formotion::nest
