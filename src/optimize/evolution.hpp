// The black-box route: a generation of candidates bred from what a search knows, across topologies. For problems that
// do not come apart into stages. docs/search.md says why it is as it is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "optimize/random_stream.hpp"
#include "optimize/run_state.hpp"
#include "optimize/search_task.hpp"

namespace formotion {

// The places of the scores from best to worst (Deb 2000, 2002): feasible ones first, by their rank of non-domination
// and then by crowding, roomier ones first; infeasible ones by violation. Equal ones in the order given.
std::vector<std::size_t> feasible_first(const std::vector<const Score*>& scores, std::span<const Objective> objectives);

// The candidate in another topology: variables that both have keep their values, bit for bit; each other one takes its
// starting value or a random one.
Candidate with_topology(const Problem& problem, const Candidate& candidate, int topology, RandomStream& random);

// New candidates, none known and no two alike; fewer than `count` only where new ones are hard to find. A pure function
// of problem, state and stream. Candidates and their parents are of these topologies alone; none named: of all.
std::vector<Candidate> next_generation(const Problem& problem, const RunState& state, std::size_t count,
                                       RandomStream& random, std::span<const int> topologies = {});

// The same as tasks, in pieces that threads can share. About a hundred evaluations are one generation: what is learnt
// from more at once comes late.
std::vector<SearchTask> evolution_tasks(const Problem& problem, const RunState& state, std::int64_t evaluations,
                                        RandomStream& random, std::span<const int> topologies = {});

}  // namespace formotion
