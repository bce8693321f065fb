#include "optimize/composition.hpp"

#include <catch2/catch.hpp>

#include "optimize/random_stream.hpp"
#include "optimize/stage_demands.hpp"
#include "toy_stages.hpp"

using namespace formotion;

namespace {

using Topologies = std::vector<std::vector<int>>;

std::vector<ToyStages::Thing> things(int count, RandomStream& random) {
  std::vector<ToyStages::Thing> result;
  for (int i = 0; i < count; ++i) result.push_back({20 * random.uniform(), 20 * random.uniform(), 1.0 / count});
  return result;
}

// Random stages, with tolerances of random sets of their ends; some ends become stuck.
std::vector<StageRecord> random_stages(const ToyStages& problem, int count, RandomStream& random, bool stuck = true) {
  std::vector<StageRecord> records;
  for (int i = 0; i < count; ++i) {
    StageTrial trial;
    trial.kind = i % static_cast<int>(problem.kinds().size());
    for (const Variable& variable : problem.kinds()[static_cast<std::size_t>(trial.kind)].variables)
      trial.values.push_back(variable.min + random.uniform() * (variable.max - variable.min));
    trial.result = problem.pass(trial.kind, trial.values);
    for (std::size_t s = 0; s < problem.states().size(); ++s) trial.demanded.push_back(random.below(4) > 0);
    trial.tolerance_mm = problem.tolerance(trial.kind, trial.values, trial.result, trial.demanded, 1e9).tolerance_mm;
    for (std::size_t s = 0; stuck && s < problem.states().size(); ++s) {
      if (random.below(15) > 0) continue;
      trial.result.ends[s] = {kStuckState, 0, 1};
      trial.demanded[s] = false;
    }
    records.push_back({i + 1, trial, "random"});
  }
  return records;
}

// Every sequence of stages, followed state by state: what may be relied on at the end, and the Pareto-best of it.
struct Track {
  int topology;
  std::vector<int> ends;
  double tolerance, length;
  auto operator<=>(const Track&) const = default;
};

class EverySequence {
 public:
  EverySequence(const ToyStages& problem, int topologies, const std::vector<StageRecord>& stages)
      : problem_(problem), stages_(stages) {
    for (int t = 0; t < topologies; ++t) {
      chosen_.clear();
      choose(t);
    }
  }

  std::vector<Track> best() const {
    std::vector<Track> best;
    for (const Track& a : tracks_) {
      const bool beaten = std::any_of(tracks_.begin(), tracks_.end(), [&](const Track& b) {
        return b.topology == a.topology && b.ends == a.ends && b.tolerance >= a.tolerance && b.length <= a.length &&
               (b.tolerance > a.tolerance || b.length < a.length);
      });
      if (!beaten) best.push_back(a);
    }
    std::sort(best.begin(), best.end());
    best.erase(std::unique(best.begin(), best.end()), best.end());
    return best;
  }

 private:
  void choose(int topology) {
    const auto uses = problem_.stages(topology);
    if (chosen_.size() == uses.size()) return judge(topology);
    for (const StageRecord& record : stages_) {
      if (record.trial.kind != uses[chosen_.size()].kind) continue;
      chosen_.push_back(&record.trial);
      choose(topology);
      chosen_.pop_back();
    }
  }

  void judge(int topology) {
    for (const std::vector<int>& goal : problem_.goals()) {
      Track track{topology, {}, 1e9, 0};
      for (const StageTrial* stage : chosen_) {
        track.tolerance = std::min(track.tolerance, stage->tolerance_mm);
        track.length += stage->result.length_mm;
      }
      bool good = track.tolerance > 0;
      for (int state = 0; state < static_cast<int>(problem_.states().size()); ++state) {
        int at = state;
        bool relied_lost = false, there = true, relied_kept = true;
        for (const StageTrial* stage : chosen_) {
          const StageEnd& end = stage->result.ends[static_cast<std::size_t>(at)];
          const bool relied = stage->demanded[static_cast<std::size_t>(at)];
          const bool passive = problem_.kinds()[static_cast<std::size_t>(stage->kind)].passive;
          if (relied_lost) break;
          if (!passive && (!relied || !there || !relied_kept)) good = false;
          if (end.to == kStuckState) {
            if (there) good = false;
          } else if (end.to == kLostState) {
            there = false;
            relied_lost = relied;
          } else if (there) {
            at = end.to;
            relied_kept = relied_kept && relied;
          }
        }
        if (!there && !relied_lost) good = false;
        if (there && (!relied_kept || at != goal[0])) good = false;
        track.ends.push_back(there ? at : kLostState);
      }
      const bool any = std::any_of(track.ends.begin(), track.ends.end(), [](int end) { return end >= 0; });
      if (good && any) tracks_.push_back(track);
    }
  }

  const ToyStages& problem_;
  const std::vector<StageRecord>& stages_;
  std::vector<const StageTrial*> chosen_;
  std::vector<Track> tracks_;
};

std::vector<Track> composed(const ToyStages& problem, int topologies, const std::vector<StageRecord>& stages,
                            const CompositionLimits& limits = {}) {
  const std::vector<StageChoice> choices = measured_choices(problem, stages);
  std::vector<Track> tracks;
  for (const Composed& track : compose(problem, topologies, choices, limits).tracks) {
    const Composition& c = track.composition;
    tracks.push_back({c.topology, c.ends, c.tolerance_mm, c.length_mm});
  }
  std::sort(tracks.begin(), tracks.end());
  return tracks;
}

void check_equal(const std::vector<Track>& a, const std::vector<Track>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].topology == b[i].topology);
    REQUIRE(a[i].ends == b[i].ends);
    REQUIRE(a[i].tolerance == b[i].tolerance);
    REQUIRE(a[i].length == Approx(b[i].length).epsilon(1e-12));
  }
}

}  // namespace

TEST_CASE("composition finds what trying every sequence of passive stages finds") {
  std::size_t found = 0;
  for (std::uint64_t round = 0; round < 40; ++round) {
    RandomStream random(7, 1, round);
    const Topologies topologies{{0}, {1}, {0, 1}, {2, 2}, {2, 1}, {0, 2, 1}};
    const ToyStages problem(things(3 + random.below(3), random), topologies);
    const auto stages = random_stages(problem, 45, random);
    const auto best = EverySequence(problem, 6, stages).best();
    check_equal(composed(problem, 6, stages), best);
    found += best.size();
  }
  CHECK(found > 100);
}

TEST_CASE("composition finds what trying every sequence finds where a stage turns states into others") {
  std::size_t found = 0;
  for (std::uint64_t round = 0; round < 40; ++round) {
    RandomStream random(7, 2, round);
    const Topologies topologies{{3}, {0, 3}, {3, 1}, {2, 3, 0}};
    const ToyStages problem(things(2 + random.below(2), random), topologies);
    const auto stages = random_stages(problem, 60, random, false);
    const auto best = EverySequence(problem, 4, stages).best();
    check_equal(composed(problem, 4, stages), best);
    found += best.size();
  }
  CHECK(found > 50);
}

TEST_CASE("a composed track is the candidate that the problem scores, where all ends are relied on") {
  for (std::uint64_t round = 0; round < 20; ++round) {
    RandomStream random(7, 3, round);
    const ToyStages problem(things(3, random), {{0, 1}, {2, 1, 0}});
    auto stages = random_stages(problem, 60, random, false);
    for (StageRecord& record : stages) {
      StageTrial& trial = record.trial;
      trial.demanded.assign(3, true);
      trial.tolerance_mm = problem.tolerance(trial.kind, trial.values, trial.result, trial.demanded, 1e9).tolerance_mm;
    }
    const std::vector<StageChoice> choices = measured_choices(problem, stages);
    for (const Composed& track : compose(problem, 2, choices).tracks) {
      const Candidate candidate = candidate_of(problem, track, choices, stages);
      const Score score = problem.score(candidate);
      REQUIRE(score.feasible);
      // A state that several stages lose is lost as widely as the best of them loses it.
      REQUIRE(score.objectives[0] >= track.composition.tolerance_mm);
      REQUIRE(score.objectives[1] == Approx(track.composition.length_mm));
    }
  }
}

TEST_CASE("bounds for very many topologies lose none of the best tracks of one end") {
  for (std::uint64_t round = 0; round < 20; ++round) {
    RandomStream random(7, 4, round);
    const ToyStages problem(things(4, random), {{0}, {1}, {0, 1}, {1, 0}, {2, 1}, {0, 2, 1}, {2, 2, 0}});
    const auto stages = random_stages(problem, 60, random, false);
    const auto front = [](std::vector<Track> tracks) {
      std::vector<Track> best;
      for (Track a : tracks) {
        a.topology = 0;
        const bool beaten = std::any_of(tracks.begin(), tracks.end(), [&](const Track& b) {
          return b.ends == a.ends && b.tolerance >= a.tolerance && b.length <= a.length &&
                 (b.tolerance > a.tolerance || b.length < a.length);
        });
        if (!beaten) best.push_back(a);
      }
      std::sort(best.begin(), best.end());
      best.erase(std::unique(best.begin(), best.end()), best.end());
      return best;
    };
    CompositionLimits bounded;
    bounded.topologies_in_full = 1;
    check_equal(front(composed(problem, 7, stages, bounded)), front(composed(problem, 7, stages)));
  }
}

TEST_CASE("guesses tell what to search for: the narrowest wrong end is the one that a demand puts right") {
  const ToyStages problem({{5, 10, 0.5}, {8, 3, 0.3}, {8.5, 12, 0.2}}, {{0, 1}});
  // The bar keeps thing 1 by 0.2 mm too much, the hole keeps all.
  std::vector<StageRecord> stages(2);
  stages[0].trial = {0, {8.2}, problem.pass(0, std::vector<double>{8.2}), {}, 0, 3};
  stages[1].trial = {1, {1}, problem.pass(1, std::vector<double>{1}), {}, 0, 3};
  const std::vector<StageChoice> guesses = guessed_choices(problem, stages);
  const ComposedTracks tracks = compose(problem, 1, guesses);
  REQUIRE_FALSE(tracks.tracks.empty());
  const Composed& nearest = *std::max_element(
      tracks.tracks.begin(), tracks.tracks.end(),
      [](const Composed& a, const Composed& b) { return a.composition.tolerance_mm < b.composition.tolerance_mm; });
  CHECK(nearest.composition.tolerance_mm == Approx(-0.2));
  CHECK(nearest.goal == 0);
  const auto demands = demands_of(problem, nearest, guesses, stages);
  REQUIRE(demands.size() == 2);
  CHECK(demands[0] == Demand{0, only(0), only(1) | only(2)});
  CHECK(demands[1] == Demand{1, only(0), 0});
}
