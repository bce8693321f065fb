// A track as it might be made: every edge somewhere else, by no more than an error.
#pragma once

#include "applications/feeder/track_layout.hpp"
#include "optimize/random_stream.hpp"

namespace formotion {

struct PerturbationOptions {
  double most_mm = 0;      // no point of an edge moves by more
  bool turn_edges = true;  // obstacles' corners move one by one; else obstacles are moved and sized as a whole
};

// plain as of plain_layout. Corners move by independent vectors; between corners that stand nearer to each other than
// 4 most_mm (arcs) the movement goes over from one to the other, so that shapes stay simple. Since every point of a
// moved edge is within most_mm of where it was, a moved void lies inside of the void grown by most_mm and contains the
// void shrunk by it (derived: docs/verify.md). None where a shape gets invalid.
std::optional<feeder::Layout> perturbed(const feeder::Layout& plain, const feeder::Environment& environment,
                                        const PerturbationOptions& options, RandomStream& random);

// A closed line with its corners moved so.
Loop perturbed(Loop loop, double most_mm, RandomStream& random);

}  // namespace formotion
