#include "optimize/stage_proposals.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "optimize/joint_proposals.hpp"
#include "optimize/stage_task.hpp"

namespace formotion {
namespace {

constexpr int kMostDirectDimensions = 4;
constexpr std::int64_t kPointsADimension = 60, kMostPoints = 400;  // of a kind's scan
constexpr std::int64_t kPatience = 60, kPatienceADimension = 60;   // trials without gain until a demand is given up
constexpr std::int64_t kShorteningADimension = 150;                // trials
constexpr std::int64_t kTrialsADimension = 80;                     // a task
constexpr double kGain = 1e-3;                                     // relative; less is none
constexpr double kSlack = 1.02;                                    // how much more others have to bear
constexpr double kHope = 2;  // what a search makes of a trial's narrowest margin, where nobody has tried yet
constexpr double kFirstStep = 0.1;
constexpr std::size_t kStarts = 12;
constexpr std::size_t kPiece = 12;        // listed tracks a task
constexpr std::size_t kGuessesATime = 6;  // tracks that are listed on a guess
constexpr int kTurns = 8;                 // of these one is for a demand picked at random, two are for less length

}  // namespace

StageProposals::StageProposals(const Problem& problem, const RunState& state, RandomStream& random)
    : problem_(problem), staged_(*problem.staged()), state_(state), random_(random) {
  if (state.stages().empty()) return;
  read_efforts();
  measured_ = measured_choices(staged_, state.stages());
  guesses_ = measured_;
  for (StageChoice& guess : capped_guesses()) guesses_.push_back(std::move(guess));
  const int topologies = static_cast<int>(problem.topologies().size());
  tracks_ = compose(staged_, topologies, measured_);
  guessed_tracks_ = compose(staged_, topologies, guesses_);
}

void StageProposals::scan(std::int64_t evaluations, std::uint64_t seed) {
  const auto kinds = static_cast<std::int64_t>(staged_.kinds().size());
  for (int k = 0; k < static_cast<int>(kinds); ++k) {
    const DesignSpace space(kind(k).variables);
    const auto share = std::max<std::int64_t>(1, evaluations / kinds);
    SearchTask& guess = add(Driver::Listed, k, 1, kind(k).label + ": starting shapes");
    guess.listed.push_back(space.at(space.start()));
    for (const std::vector<double>& values : staged_.starts(k)) {
      if (static_cast<std::int64_t>(guess.listed.size()) < (share + 1) / 2) guess.listed.push_back({0, values});
    }
    guess.evaluations = static_cast<std::int64_t>(guess.listed.size());
    const std::int64_t left = share - guess.evaluations;
    const std::int64_t points =
        space.dimensions() == 0 ? 0 : std::min({left, kPointsADimension * space.dimensions(), kMostPoints});
    for (std::int64_t done = 0; done < points; done += kTaskEvaluations) {
      SearchTask& spread = add(Driver::Spread, k, std::min(kTaskEvaluations, points - done), kind(k).label + ": scan");
      spread.first_point = static_cast<std::uint64_t>(done);
      spread.seed = seed;
    }
  }
}

// Demands of tracks that guesses promise most of take turns with those of the best tracks, for more tolerance or less
// length. What is left over finds nothing to do.
std::int64_t StageProposals::search(std::int64_t evaluations, std::int64_t evaluations_each) {
  std::vector<Demand> promised = wishes(guessed_tracks_, guesses_), best, long_ones;
  for (const Demand& demand : wishes(tracks_, measured_)) {
    if (!exhausted(demand, false)) best.push_back(demand);
    if (length_matters(demand.kind) && !exhausted(demand, true)) long_ones.push_back(demand);
  }
  std::erase_if(promised, [&](const Demand& demand) { return exhausted(demand, false); });
  const auto early = [&](const std::vector<Demand>& list) {  // a random one, rather from the beginning
    const double u = random_.uniform();
    return list[static_cast<std::size_t>(u * u * static_cast<double>(list.size()))];
  };
  std::size_t next_promised = 0, next_best = 0;
  while (evaluations > 0) {
    const int turn = random_.below(kTurns);
    const bool promises = next_promised < promised.size(), good = next_best < best.size();
    if (turn == 0) {
      const Demand demand = random_demand();
      if (demand.keep != 0 && !exhausted(demand, false)) {
        evaluations -= seek(demand, evaluations_each);
        continue;
      }
    }
    if (turn <= 2 && !long_ones.empty()) {
      evaluations -= shorten(early(long_ones), evaluations_each);
    } else if (promises && (!good || turn % 2 == 0)) {
      evaluations -= seek(promised[next_promised++], evaluations_each);
    } else if (good) {
      evaluations -= seek(best[next_best++], evaluations_each);
    } else if (!long_ones.empty()) {
      evaluations -= shorten(early(long_ones), evaluations_each);
    } else {
      break;
    }
  }
  return std::max<std::int64_t>(evaluations, 0);
}

std::int64_t StageProposals::list(std::size_t most) {
  std::vector<Candidate> listed;
  const auto take = [&](const Composed& track, const std::vector<StageChoice>& choices) {
    Candidate candidate = candidate_of(problem_, track, choices, state_.stages());
    const bool twice = std::any_of(listed.begin(), listed.end(), [&](const Candidate& other) {
      return other.topology == candidate.topology && other.values == candidate.values;
    });
    if (!twice && !state_.find(candidate)) listed.push_back(std::move(candidate));
  };
  Archive archive = state_.front();  // as it would be with the tracks
  std::vector<std::size_t> fresh;
  const auto before = static_cast<std::int64_t>(state_.evaluations().size());
  for (std::size_t t = 0; t < tracks_.tracks.size(); ++t) {
    std::vector<double> losses = staged_.objectives(tracks_.tracks[t].composition);
    for (std::size_t k = 0; k < losses.size(); ++k) losses[k] = problem_.objectives()[k].loss(losses[k]);
    archive.offer(before + 1 + static_cast<std::int64_t>(t), losses);
  }
  for (const Archive::Member& member : archive.members()) {
    if (member.number > before) fresh.push_back(static_cast<std::size_t>(member.number - before - 1));
  }
  for (const std::size_t t : fresh) {
    if (listed.size() < most) take(tracks_.tracks[t], measured_);
  }
  std::vector<const Composed*> guessed;  // the best one of every topology that nothing is known of
  for (const Composed& track : guessed_tracks_.tracks) {
    const int topology = track.composition.topology;
    if (track.composition.tolerance_mm <= 0 || !state_.front_of(topology).members().empty()) continue;
    if (guessed.empty() || guessed.back()->composition.topology != topology)
      guessed.push_back(&track);
    else if (track.composition.tolerance_mm > guessed.back()->composition.tolerance_mm)
      guessed.back() = &track;
  }
  std::stable_sort(guessed.begin(), guessed.end(), [](const Composed* a, const Composed* b) {
    return a->composition.tolerance_mm > b->composition.tolerance_mm;
  });
  for (std::size_t g = 0; g < std::min(guessed.size(), kGuessesATime); ++g) take(*guessed[g], guesses_);
  for (std::size_t from = 0; from < listed.size(); from += kPiece) {
    SearchTask task;
    task.driver = Driver::Listed;
    task.listed.assign(listed.begin() + static_cast<std::ptrdiff_t>(from),
                       listed.begin() + static_cast<std::ptrdiff_t>(std::min(listed.size(), from + kPiece)));
    task.evaluations = static_cast<std::int64_t>(task.listed.size());
    task.merit = {0, std::vector<std::optional<double>>(problem_.objectives().size()),
                  std::vector<double>(problem_.objectives().size(), 1)};
    task.provenance = "composed of stages";
    tasks_.push_back(std::move(task));
  }
  return static_cast<std::int64_t>(listed.size());
}

std::vector<int> StageProposals::ranked() const {
  std::map<int, double> best;
  for (const Composed& track : tracks_.tracks) {
    double& known = best[track.composition.topology];
    known = std::max(known, track.composition.tolerance_mm);
  }
  std::vector<int> topologies;
  for (const auto& [topology, tolerance] : best) topologies.push_back(topology);
  std::stable_sort(topologies.begin(), topologies.end(), [&](int a, int b) { return best[a] > best[b]; });
  return topologies;
}

void StageProposals::read_efforts() {
  for (const StageRecord& record : state_.stages()) {
    const std::size_t comma = record.provenance.find(", ");
    if (comma == std::string::npos) continue;
    DemandEffort& effort = efforts_[record.provenance.substr(comma + 2)];
    ++effort.trials;
    ++effort.since_best;
    if (record.trial.tolerance_mm <= effort.best_mm * (1 + kGain)) continue;
    effort.best_mm = record.trial.tolerance_mm;
    effort.since_best = 0;
  }
}

// The best guess for every state to keep and every set to lose; no more than a demand got that asks for less and was
// given up.
std::vector<StageChoice> StageProposals::capped_guesses() const {
  std::vector<StageChoice> guesses = guessed_choices(staged_, state_.stages());
  StateSet wanted = 0;
  for (const std::vector<int>& goal : staged_.goals()) {
    if (goal.size() != 1) return guesses;
    wanted |= only(goal.front());
  }
  for (const StageKind& k : staged_.kinds()) {
    if (!k.passive) return guesses;
  }
  using Key = std::tuple<int, int, StateSet, StateSet, StateSet>;
  std::map<Key, StageChoice> best;
  for (const StageChoice& guess : guesses) {
    for (const int kept : members(guess.keeps & wanted)) {
      const StateSet loses = guess.loses & ~only(kept);
      const auto [known, is_new] = best.try_emplace({guess.kind, kept, loses, guess.fades, guess.blocks}, guess);
      if (!is_new && known->second.tolerance_mm >= guess.tolerance_mm) continue;
      known->second = guess;
      known->second.keeps = only(kept);
      known->second.loses = loses;
    }
  }
  std::map<std::pair<int, int>, std::vector<std::pair<StateSet, double>>> given_up;
  std::set<Demand> seen;
  for (const auto& [key, guess] : best) {
    const Demand demand{guess.kind, guess.keeps, guess.loses};
    if (!seen.insert(demand).second || !exhausted(demand, false)) continue;
    given_up[{guess.kind, std::get<1>(key)}].emplace_back(guess.loses, efforts_.at(told(demand, false)).best_mm);
  }
  std::vector<StageChoice> capped;
  for (auto& [key, guess] : best) {
    bool hopeless = false;
    for (const auto& [loses, tolerance] : given_up[{guess.kind, std::get<1>(key)}]) {
      if ((loses & ~guess.loses) != 0) continue;
      guess.tolerance_mm = std::min(guess.tolerance_mm, tolerance);
      hopeless = hopeless || tolerance <= 0;
    }
    const bool untried = !efforts_.contains(told({guess.kind, guess.keeps, guess.loses}, false));
    if (untried && guess.tolerance_mm > 0) guess.tolerance_mm *= kHope;
    if (!hopeless) capped.push_back(guess);
  }
  return capped;
}

// The demands of the best track of every topology and alternative, most tolerance first; but for stages that bear more
// than the others do: more of it would not help the track.
std::vector<Demand> StageProposals::wishes(const ComposedTracks& tracks,
                                           const std::vector<StageChoice>& choices) const {
  std::map<std::pair<int, std::size_t>, const Composed*> best;
  for (const Composed& track : tracks.tracks) {
    const Composed*& known = best[{track.composition.topology, track.goal}];
    if (!known || track.composition.tolerance_mm > known->composition.tolerance_mm) known = &track;
  }
  std::map<Demand, double> worth;
  for (const auto& [where, track] : best) {
    const std::vector<Demand> demands = demands_of(staged_, *track, choices, state_.stages());
    for (std::size_t i = 0; i < demands.size(); ++i) {
      const Demand& demand = demands[i];
      const bool is_measured = track->choices[i] < measured_.size();
      if (is_measured && choices[track->choices[i]].tolerance_mm > kSlack * track->composition.tolerance_mm) continue;
      const auto [known, is_new] = worth.try_emplace(demand, track->composition.tolerance_mm);
      known->second = std::max(known->second, track->composition.tolerance_mm);
    }
  }
  std::vector<Demand> list;
  for (const auto& [demand, value] : worth) list.push_back(demand);
  std::stable_sort(list.begin(), list.end(), [&](const Demand& a, const Demand& b) { return worth[a] > worth[b]; });
  return list;
}

std::string StageProposals::told(const Demand& demand, bool shorter) const {
  const auto names = [&](StateSet set) {
    std::string text;
    for (const int state : members(set))
      text += (text.empty() ? "" : ", ") + staged_.states()[static_cast<std::size_t>(state)].name;
    return text;
  };
  std::string text = (shorter ? "shorter " : "") + kind(demand.kind).label + " that keeps " + names(demand.keep);
  if (demand.lose != 0) text += " and loses " + names(demand.lose);
  return text;
}

bool StageProposals::exhausted(const Demand& demand, bool shorter) const {
  const auto found = efforts_.find(told(demand, shorter));
  if (found == efforts_.end()) return false;
  const auto dimensions = static_cast<std::int64_t>(DesignSpace(kind(demand.kind).variables).dimensions());
  if (dimensions == 0) return true;
  if (shorter) return found->second.trials >= kShorteningADimension * dimensions;
  return found->second.since_best >= kPatience + kPatienceADimension * dimensions;
}

// Whether stages of the kind have several lengths, and objectives know it.
bool StageProposals::length_matters(int k) const {
  double least = 1e300, most = 0;
  for (const StageRecord& record : state_.stages()) {
    if (record.trial.kind != k || !record.trial.result.valid) continue;
    least = std::min(least, record.trial.result.length_mm);
    most = std::max(most, record.trial.result.length_mm);
  }
  if (most <= least || tracks_.tracks.empty()) return false;
  Composition longer = tracks_.tracks.front().composition;
  longer.length_mm += most;
  return staged_.objectives(longer) != staged_.objectives(tracks_.tracks.front().composition);
}

SearchTask& StageProposals::add(Driver driver, int k, std::int64_t evaluations, const std::string& what) {
  SearchTask task;
  task.driver = driver;
  task.stage = StageAim{k, {}, {}, 0};
  task.evaluations = std::max<std::int64_t>(1, evaluations);
  task.seed = random_.next() >> 32;
  task.first_point = random_.next() >> 40;
  task.provenance = std::string(name(driver)) + ", " + what;
  tasks_.push_back(std::move(task));
  return tasks_.back();
}

// First from the nearest stage that is known; later also from others, or all over the box.
std::int64_t StageProposals::seek(const Demand& demand, std::int64_t at_most) {
  const std::string what = told(demand, false);
  const auto known = efforts_.find(what);
  const bool first = known == efforts_.end() || known->second.trials == 0;
  const int dimensions = DesignSpace(kind(demand.kind).variables).dimensions();
  const double u = first ? 0 : random_.uniform();
  const bool global = u > 0.8 && kind(demand.kind).passive;
  const Driver driver = !global ? Driver::Sbplx : dimensions <= kMostDirectDimensions ? Driver::DirectL : Driver::Crs2;
  const std::vector<std::size_t> starts = nearest(demand, kStarts);
  SearchTask& task = add(driver, demand.kind, std::min(at_most, kTrialsADimension * dimensions), what);
  task.stage->keep = members(demand.keep);
  task.stage->lose = members(demand.lose);
  if (global || starts.empty()) return task.evaluations;
  std::size_t start = starts.front();
  task.step = kFirstStep;
  if (!first) {
    const std::vector<std::size_t> best = measured(demand);
    if (u < 0.5 && !best.empty())
      start = best.front();
    else
      start = random_.pick(starts);
    task.step = 2 * kFirstStep * std::pow(2.0, -6.0 * random_.uniform());
  }
  task.start = Candidate{0, state_.stages()[start].trial.values};
  return task.evaluations;
}

// From a measured stage of the demand: a millimetre of length counts as much as a random amount of tolerance.
std::int64_t StageProposals::shorten(const Demand& demand, std::int64_t at_most) {
  const std::vector<std::size_t> known = measured(demand);
  if (known.empty()) return seek(demand, at_most);
  const std::int64_t dimensions = DesignSpace(kind(demand.kind).variables).dimensions();
  SearchTask& task =
      add(Driver::Sbplx, demand.kind, std::min(at_most, kTrialsADimension * dimensions), told(demand, true));
  const StageTrial& best = state_.stages()[known.front()].trial;
  const std::size_t start = random_.pick(known);
  task.stage->keep = members(demand.keep);
  task.stage->lose = members(demand.lose);
  task.stage->length_weight =
      best.tolerance_mm / std::max(best.result.length_mm, 1e-9) * std::pow(2.0, 5 * random_.uniform() - 3);
  task.start = Candidate{0, state_.stages()[start].trial.values};
  task.step = 2 * kFirstStep * std::pow(2.0, -4.0 * random_.uniform());
  return task.evaluations;
}

// What some trial almost does: keeps a state that is wanted, and loses a set of others.
Demand StageProposals::random_demand() {
  if (guesses_.empty()) return {};
  const StageChoice& choice = random_.pick(guesses_);
  const std::vector<int>& goal = random_.pick(staged_.goals());
  Demand demand{choice.kind, 0, choice.loses};
  for (const int state : goal) demand.keep |= only(state) & choice.keeps;
  if (!kind(choice.kind).passive) demand.keep = choice.keeps;
  demand.lose &= ~demand.keep;
  if (demand.keep == 0) demand.lose = 0;
  return demand;
}

// Places of the trials that come nearest to the demand: by the narrowest of the ends that it asks for.
std::vector<std::size_t> StageProposals::nearest(const Demand& demand, std::size_t count) const {
  const std::vector<int> keep = members(demand.keep), lose = members(demand.lose);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t place = 0; place < state_.stages().size(); ++place) {
    const StageTrial& trial = state_.stages()[place].trial;
    if (trial.kind != demand.kind || !trial.result.valid) continue;
    double narrowest = 1e300;
    for (const int s : keep) narrowest = std::min(narrowest, kept_by(trial.result.ends[static_cast<std::size_t>(s)]));
    for (const int s : lose) narrowest = std::min(narrowest, lost_by(trial.result.ends[static_cast<std::size_t>(s)]));
    order.emplace_back(-narrowest, place);
  }
  const std::size_t kept = std::min(count, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept), order.end());
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < kept; ++i) places.push_back(order[i].second);
  return places;
}

// Places of the trials whose tolerance for the demand was measured, Pareto-best in it and in length, most tolerance
// first.
std::vector<std::size_t> StageProposals::measured(const Demand& demand) const {
  std::vector<std::pair<std::pair<double, double>, std::size_t>> order;
  for (const StageChoice& choice : measured_) {
    if (choice.kind != demand.kind || (demand.keep & ~choice.keeps) != 0 || (demand.lose & ~choice.loses) != 0)
      continue;
    order.push_back({{-choice.tolerance_mm, choice.length_mm}, choice.trial});
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> places;
  double shortest = 1e300;
  for (const auto& [worth, place] : order) {
    if (worth.second >= shortest) continue;
    shortest = worth.second;
    places.push_back(place);
  }
  return places;
}

}  // namespace formotion
