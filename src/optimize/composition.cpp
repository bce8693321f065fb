#include "optimize/composition.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace formotion {
namespace {

// A part of a track: what has become of every state that arrived.
struct Label {
  StateSet gone = 0;    // lost, and some stage is relied on for it
  StateSet ghost = 0;   // lost, but nobody is relied on for it yet: a later passive stage may be
  StateSet weak = 0;    // still there, but nobody is relied on for it
  std::vector<int> at;  // of every state that arrived: as what it travels; empty where all kinds are passive
  double tolerance = std::numeric_limits<double>::infinity();
  double length = 0;
  std::size_t parent = 0, choice = 0;

  auto key() const { return std::tie(gone, ghost, weak, at); }
};

// Most tolerance first, of equal ones the shortest.
template <class T>
bool before(const T& a, const T& b) {
  return std::tie(b.tolerance, a.length) < std::tie(a.tolerance, b.length);
}

// Topologies by their common beginnings.
struct Node {
  int kind = 0;
  std::map<int, std::size_t> next;  // by the kind of the next stage
  std::vector<int> topologies;      // that end here
};

std::vector<Node> tree_of(const StagedProblem& problem, int topologies) {
  std::vector<Node> nodes(1);
  for (int t = 0; t < topologies; ++t) {
    std::size_t at = 0;
    for (const StageUse& use : problem.stages(t)) {
      const auto [known, is_new] = nodes[at].next.try_emplace(use.kind, nodes.size());
      at = known->second;
      if (is_new) nodes.push_back({use.kind, {}, {}});
    }
    if (at != 0) nodes[at].topologies.push_back(t);
  }
  return nodes;
}

class Composer {
 public:
  Composer(const StagedProblem& problem, int topologies, std::span<const StageChoice> choices,
           const CompositionLimits& limits)
      : problem_(problem),
        choices_(choices),
        limits_(limits),
        nodes_(tree_of(problem, topologies)),
        in_full_(static_cast<std::size_t>(topologies) <= limits.topologies_in_full) {
    const std::size_t states = problem.states().size();
    all_ = states >= kMostStates ? ~StateSet{0} : (StateSet{1} << states) - 1;
    for (const StageKind& kind : problem.kinds()) passive_ = passive_ && kind.passive;
  }

  ComposedTracks run() {
    for (alternative_ = 0; alternative_ < problem_.goals().size(); ++alternative_) {
      goal_ = 0;
      for (const int state : problem_.goals()[alternative_]) goal_ |= only(state);
      choose();
      bounds_.clear();
      Label begin;
      if (passive_)
        begin.weak = all_ & ~goal_;
      else
        for (std::size_t i = 0; i < problem_.states().size(); ++i) begin.at.push_back(static_cast<int>(i));
      path_.assign(1, {begin});
      follow(0);
    }
    std::stable_sort(result_.tracks.begin(), result_.tracks.end(), [](const Composed& a, const Composed& b) {
      return a.composition.topology < b.composition.topology;
    });
    return std::move(result_);
  }

 private:
  // The choices of every kind that can be of use for the alternative.
  void choose() {
    usable_.assign(problem_.kinds().size(), {});
    using Key = std::tuple<int, StateSet, StateSet, StateSet, StateSet, std::vector<int>>;
    std::map<Key, std::vector<std::size_t>> alike;
    for (std::size_t c = 0; c < choices_.size(); ++c) {
      const StageChoice& choice = choices_[c];
      if (passive_ && (choice.keeps & goal_) == 0) continue;
      // What is kept and not wanted has to be lost elsewhere, whether or not it can be relied on here.
      const StateSet keeps = passive_ ? choice.keeps & goal_ : choice.keeps;
      alike[{choice.kind, keeps, choice.loses & ~keeps, choice.fades, choice.blocks, choice.to}].push_back(c);
    }
    for (auto& [key, places] : alike) {
      std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return tidy(a) < tidy(b); });
      std::vector<std::size_t> kept;
      for (const std::size_t c : places) {
        if (kept.empty() || choices_[c].length_mm < choices_[kept.back()].length_mm) kept.push_back(c);
      }
      auto& usable = usable_[static_cast<std::size_t>(std::get<0>(key))];
      const std::size_t most = limits_.choices_alike;
      if (kept.size() <= most)
        usable.insert(usable.end(), kept.begin(), kept.end());
      else
        for (std::size_t i = 0; i < most; ++i) usable.push_back(kept[i * (kept.size() - 1) / (most - 1)]);
    }
    for (auto& usable : usable_) without_beaten(usable);
  }
  std::pair<double, double> tidy(std::size_t c) const { return {-choices_[c].tolerance_mm, choices_[c].length_mm}; }

  // Among passive kinds: whether a is of at least as much use as b to every track.
  bool beats(const StageChoice& a, const StageChoice& b) const {
    if (a.tolerance_mm < b.tolerance_mm || a.length_mm > b.length_mm) return false;
    const StateSet others = ~goal_, loses_a = a.loses & others, fades_a = a.fades & others;
    return (a.keeps & goal_) == (b.keeps & goal_) && (a.loses & goal_) == (b.loses & goal_) &&
           (a.fades & goal_) == (b.fades & goal_) && (b.loses & others & ~loses_a) == 0 &&
           (b.fades & others & ~(loses_a | fades_a)) == 0 && (a.blocks & ~b.blocks) == 0;
  }
  void without_beaten(std::vector<std::size_t>& usable) const {
    std::stable_sort(usable.begin(), usable.end(), [&](std::size_t a, std::size_t b) { return tidy(a) < tidy(b); });
    if (!passive_) return;
    std::vector<std::size_t> kept;
    for (const std::size_t c : usable) {
      const bool beaten =
          std::any_of(kept.begin(), kept.end(), [&](std::size_t k) { return beats(choices_[k], choices_[c]); });
      if (!beaten) kept.push_back(c);
    }
    usable.swap(kept);
  }

  // The states that arrived and now travel as members of `set`.
  StateSet arrived(const Label& label, StateSet set) const {
    if (label.at.empty()) return set;
    StateSet found = 0;
    for (std::size_t i = 0; i < label.at.size(); ++i) {
      if (label.at[i] != kLostState && has(set, label.at[i])) found |= only(static_cast<int>(i));
    }
    return found;
  }

  // Past one more stage; false if that stage must not stand there.
  bool pass(const Label& from, const StageChoice& choice, Label& to) const {
    to = from;
    to.tolerance = std::min(from.tolerance, choice.tolerance_mm);
    to.length += choice.length_mm;
    const StateSet here = all_ & ~from.gone & ~from.ghost;
    if ((arrived(from, choice.blocks) & here) != 0) return false;
    const StateSet keeps = arrived(from, choice.keeps), loses = arrived(from, choice.loses);
    if (problem_.kinds()[static_cast<std::size_t>(choice.kind)].passive) {
      const StateSet relied = passive_ ? keeps & goal_ : keeps;
      const StateSet lost = loses & ~relied & ~from.gone;
      const StateSet faded = arrived(from, choice.fades) & here & ~lost;
      to.gone |= lost;
      to.ghost = (from.ghost | faded) & ~lost;
      to.weak = (from.weak | (here & ~keeps)) & ~to.gone & ~to.ghost;
    } else {  // nobody knows where one goes that may or may not be there
      if (from.ghost != 0 || from.weak != 0 || (here & ~keeps & ~loses) != 0) return false;
      to.gone |= loses & here;
      for (const int state : members(here & ~loses)) {
        int& at = to.at[static_cast<std::size_t>(state)];
        at = choice.to[static_cast<std::size_t>(at)];
      }
    }
    for (std::size_t i = 0; i < to.at.size(); ++i) {
      if (has(to.gone, static_cast<int>(i))) to.at[i] = kLostState;
    }
    const StateSet left = all_ & ~to.gone & ~to.ghost & ~to.weak;
    return (passive_ ? left & goal_ : left) != 0;
  }

  bool is_complete(const Label& label) const {
    const StateSet left = all_ & ~label.gone;
    return left != 0 && (label.ghost | label.weak) == 0 && (left & ~arrived(label, goal_)) == 0;
  }

  void follow(std::size_t node) {
    for (const auto& [kind, next] : nodes_[node].next) {
      std::vector<Label> labels;
      const bool leaf = nodes_[next].next.empty();
      for (std::size_t l = 0; l < path_.back().size(); ++l) {
        for (const std::size_t c : usable_[static_cast<std::size_t>(kind)]) {
          Label label;
          if (!pass(path_.back()[l], choices_[c], label)) continue;
          if (leaf && !is_complete(label)) continue;
          label.parent = l;
          label.choice = c;
          if (!is_beaten(label)) labels.push_back(std::move(label));
        }
      }
      prune(labels);
      if (labels.empty()) continue;
      path_.push_back(std::move(labels));
      finish(nodes_[next].topologies);
      if (!leaf) follow(next);
      path_.pop_back();
    }
  }

  // With very many topologies: whether a track with as few stages has as much tolerance on as little length.
  bool is_beaten(const Label& label) const {
    if (in_full_ || problem_.goals()[alternative_].size() != 1) return false;
    return std::any_of(bounds_.begin(), bounds_.end(), [&](const Bound& bound) {
      return bound.stages <= path_.size() && bound.tolerance >= label.tolerance && bound.length <= label.length;
    });
  }

  // Of labels alike the Pareto-best in tolerance and length stay.
  void prune(std::vector<Label>& labels) {
    std::stable_sort(labels.begin(), labels.end(), before<Label>);
    std::map<std::tuple<StateSet, StateSet, StateSet, std::vector<int>>, double> shortest;
    std::vector<Label> kept;
    for (Label& label : labels) {
      const auto [known, is_new] = shortest.try_emplace(label.key(), label.length);
      if (!is_new && known->second <= label.length) continue;
      known->second = label.length;
      if (kept.size() == limits_.labels) {
        result_.cut = true;
        break;
      }
      kept.push_back(std::move(label));
    }
    labels.swap(kept);
  }

  void finish(const std::vector<int>& topologies) {
    if (topologies.empty()) return;
    const std::vector<Label>& last = path_.back();
    for (std::size_t l = 0; l < last.size(); ++l) {
      if (!is_complete(last[l])) continue;
      Composed track;
      track.goal = alternative_;
      track.composition.tolerance_mm = last[l].tolerance;
      track.composition.length_mm = last[l].length;
      for (std::size_t i = 0; i < problem_.states().size(); ++i) {
        const bool lost = has(last[l].gone, static_cast<int>(i));
        track.composition.ends.push_back(lost ? kLostState : passive_ ? static_cast<int>(i) : last[l].at[i]);
      }
      std::size_t at = l;
      for (std::size_t depth = path_.size() - 1; depth > 0; --depth) {
        track.choices.insert(track.choices.begin(), path_[depth][at].choice);
        at = path_[depth][at].parent;
      }
      for (const int topology : topologies) {
        track.composition.topology = topology;
        result_.tracks.push_back(track);
      }
      bounds_.push_back({track.choices.size(), last[l].tolerance, last[l].length});
    }
  }

  struct Bound {
    std::size_t stages = 0;
    double tolerance = 0, length = 0;
  };

  const StagedProblem& problem_;
  std::span<const StageChoice> choices_;
  const CompositionLimits& limits_;
  std::vector<Node> nodes_;
  bool in_full_, passive_ = true;
  StateSet all_ = 0, goal_ = 0;
  std::size_t alternative_ = 0;
  std::vector<std::vector<std::size_t>> usable_;  // by kind: places in choices_
  std::vector<std::vector<Label>> path_;          // the labels after every stage of the way down the tree
  std::vector<Bound> bounds_;
  ComposedTracks result_;
};

}  // namespace

ComposedTracks compose(const StagedProblem& problem, int topologies, std::span<const StageChoice> choices,
                       const CompositionLimits& limits) {
  return Composer(problem, topologies, choices, limits).run();
}

Candidate candidate_of(const Problem& problem, const Composed& track, std::span<const StageChoice> choices,
                       std::span<const StageRecord> stages) {
  Candidate candidate{track.composition.topology, {}};
  for (const int v : problem.topologies()[static_cast<std::size_t>(candidate.topology)].variables)
    candidate.values.push_back(problem.variables()[static_cast<std::size_t>(v)].start());
  const std::span<const StageUse> uses = problem.staged()->stages(candidate.topology);
  for (std::size_t s = 0; s < uses.size(); ++s) {
    const std::vector<double>& values = stages[choices[track.choices[s]].trial].trial.values;
    for (std::size_t v = 0; v < values.size(); ++v)
      candidate.values[static_cast<std::size_t>(uses[s].values[v])] = values[v];
  }
  return candidate;
}

}  // namespace formotion
