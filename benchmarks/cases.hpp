// What the benchmarks score: the el of docs/feeder.md on a balcony and a triangular cut-out, and shapes of any size.
#pragma once

#include <random>

#include "applications/feeder/feeder_problem.hpp"

namespace formotion::bench {

using Random = std::mt19937_64;
double uniform(Random& random, double from, double to);

// problems/feeder/el_bracket.json's second topology: balcony width w, triangle (x0, y0), (x1, y1), (x2, y2); both
// faces, tilt 5 degrees. objectives: names.
feeder::FeederSpec el_bracket(const std::vector<std::string>& objectives);

std::vector<Candidate> random_candidates(const feeder::FeederProblem& problem, int count, std::uint64_t seed);
// Feasible candidates: short walks from a design that a search found.
std::vector<Candidate> feasible_candidates(const feeder::FeederProblem& problem, int count, std::uint64_t seed);

// Star-shaped about the origin, corners at random radii between inner and outer.
Loop star(Random& random, int corners, double inner, double outer);
// Alternating radii: every second corner is reflex.
Loop gear(int corners, double inner, double outer);

// A part of this outline over one cut-out; no tolerance.
feeder::FeederSpec part_over_cutout(const Loop& part, const Loop& hole);

}  // namespace formotion::bench
