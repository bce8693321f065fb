#include "optimize/certificate.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "optimize/search_task.hpp"

namespace formotion {
namespace {

constexpr int kMostVariables = 3;     // that are free, of a kind: cells grow too many beyond
constexpr double kRounding = 1e-7;    // of the sweeps that answer, mm
constexpr double kNearest_mm = 1e-5;  // a bound that is as near as this to the best is not brought nearer
constexpr double kNearer = 0.25;

// A box of one kind's values, with the states that a stage of the box may lose at the tolerance asked about.
struct Cell {
  std::vector<double> centre, half;
  double displacement = 0;
  StateSet may_lose = 0;
};

// One wanted state, which every stage has to keep.
class CoverProof {
 public:
  CoverProof(const StagedProblem& problem, const std::set<std::vector<int>>& sequences, int kept, StateSet to_lose,
             double tolerance, ProofWork& work, const std::atomic<bool>& stop)
      : problem_(problem),
        sequences_(sequences),
        kept_(kept),
        to_lose_(to_lose),
        tolerance_(tolerance),
        work_(work),
        stop_(stop) {}

  bool excludes() {
    for (int k = 0; k < static_cast<int>(problem_.kinds().size()); ++k) {
      Cell box;
      for (const Variable& variable : problem_.kinds()[static_cast<std::size_t>(k)].variables) {
        box.centre.push_back(0.5 * (variable.min + variable.max));
        box.half.push_back(0.5 * (variable.max - variable.min));
      }
      cells_.emplace_back();
      const bool used = std::any_of(sequences_.begin(), sequences_.end(), [&](const std::vector<int>& kinds) {
        return std::find(kinds.begin(), kinds.end(), k) != kinds.end();
      });
      if (used) look_at(k, std::move(box));
    }
    for (;;) {
      if (stop_.load(std::memory_order_relaxed)) throw SearchStopped();
      const std::vector<std::pair<int, StateSet>> cover = find_cover();
      if (cover.empty()) return true;
      if (!split(cover)) return false;
    }
  }

 private:
  void look_at(int kind, Cell cell) {
    ++work_.done;  // also where no sweep is needed: cells must not grow without end
    cell.displacement = *problem_.displacement_mm(kind, cell.half);
    const double error = tolerance_ - cell.displacement - kRounding;
    if (error <= 0) {
      cell.may_lose = to_lose_;
    } else {
      if (!problem_.bears(kind, cell.centre, kept_, true, error, work_.done)) return;
      for (const int state : members(to_lose_)) {
        if (problem_.bears(kind, cell.centre, state, false, error, work_.done)) cell.may_lose |= only(state);
      }
    }
    cells_[static_cast<std::size_t>(kind)].push_back(std::move(cell));
  }

  // Sets of states, one for every stage of some sequence, that together hold all that is to be lost; empty if there are
  // none.
  std::vector<std::pair<int, StateSet>> find_cover() const {
    std::vector<std::vector<StateSet>> sets(cells_.size());  // by kind, those that no other one holds
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      for (const Cell& cell : cells_[k]) sets[k].push_back(cell.may_lose);
      std::sort(sets[k].begin(), sets[k].end());
      sets[k].erase(std::unique(sets[k].begin(), sets[k].end()), sets[k].end());
      const std::vector<StateSet> all = sets[k];
      std::erase_if(sets[k], [&](StateSet set) {
        return std::any_of(all.begin(), all.end(), [&](StateSet other) { return other != set && (set & ~other) == 0; });
      });
    }
    for (const std::vector<int>& kinds : sequences_) {
      std::vector<std::pair<int, StateSet>> chosen;
      if (cover(sets, kinds, 0, to_lose_, chosen)) return chosen;
    }
    return {};
  }
  static bool cover(const std::vector<std::vector<StateSet>>& sets, const std::vector<int>& kinds, std::size_t at,
                    StateSet left, std::vector<std::pair<int, StateSet>>& chosen) {
    if (at == kinds.size()) return left == 0;
    for (const StateSet set : sets[static_cast<std::size_t>(kinds[at])]) {
      chosen.emplace_back(kinds[at], set);
      if (cover(sets, kinds, at + 1, left & ~set, chosen)) return true;
      chosen.pop_back();
    }
    return false;
  }

  // Halves the coarsest cells behind a cover; false if all of them are points, or there is no work left.
  bool split(const std::vector<std::pair<int, StateSet>>& cover) {
    double coarsest = 0;
    for (const auto& [kind, set] : cover) {
      for (const Cell& cell : cells_[static_cast<std::size_t>(kind)]) {
        if (cell.may_lose == set) coarsest = std::max(coarsest, cell.displacement);
      }
    }
    if (coarsest <= 0) return false;
    for (const auto& [kind, set] : cover) {
      std::vector<Cell>& all = cells_[static_cast<std::size_t>(kind)];
      std::vector<Cell> kept, halved;
      for (Cell& cell : all) (cell.may_lose == set && cell.displacement == coarsest ? halved : kept).push_back(cell);
      all.swap(kept);
      for (const Cell& cell : halved) {
        if (work_.spent()) return false;
        halve(kind, cell);
      }
    }
    return true;
  }
  void halve(int kind, const Cell& cell) {
    std::size_t widest = 0;
    double most = -1;
    for (std::size_t v = 0; v < cell.half.size(); ++v) {
      std::vector<double> alone(cell.half.size(), 0);
      alone[v] = cell.half[v];
      const double moves = *problem_.displacement_mm(kind, alone);
      if (moves > most) widest = v;
      most = std::max(most, moves);
    }
    for (const double side : {-0.5, 0.5}) {
      Cell half{cell.centre, cell.half, 0, 0};
      half.centre[widest] += side * cell.half[widest];
      half.half[widest] *= 0.5;
      look_at(kind, std::move(half));
    }
  }

  const StagedProblem& problem_;
  const std::set<std::vector<int>>& sequences_;
  const int kept_;
  const StateSet to_lose_;
  const double tolerance_;
  ProofWork& work_;
  const std::atomic<bool>& stop_;
  std::vector<std::vector<Cell>> cells_;  // by kind: those whose stages may keep the wanted state
};

std::optional<std::string> hindrance(const StagedProblem& problem, int kind) {
  const StageKind& k = problem.kinds()[static_cast<std::size_t>(kind)];
  if (!k.passive) return k.label + " turns parts";
  std::vector<double> half;
  int free = 0;
  for (const Variable& variable : k.variables) {
    half.push_back(0.5 * (variable.max - variable.min));
    free += variable.max > variable.min;
  }
  if (free > kMostVariables) return k.label + " has " + std::to_string(free) + " free variables";
  if (!problem.displacement_mm(kind, half)) return "of " + k.label + " it is not known how far edges move";
  return std::nullopt;
}

}  // namespace

ProofScope proof_scope(const StagedProblem& problem, int topologies) {
  std::vector<std::optional<std::string>> hinders;
  for (int k = 0; k < static_cast<int>(problem.kinds().size()); ++k) hinders.push_back(hindrance(problem, k));
  ProofScope scope;
  for (int t = 0; t < topologies; ++t) {
    const std::span<const StageUse> uses = problem.stages(t);
    const bool free = std::none_of(uses.begin(), uses.end(), [&](const StageUse& use) {
      return hinders[static_cast<std::size_t>(use.kind)].has_value();
    });
    if (!uses.empty() && free) scope.topologies.push_back(t);
  }
  for (const auto& why : hinders) {
    if (why) scope.hindrances.push_back(*why);
  }
  return scope;
}

bool is_excluded(const StagedProblem& problem, const std::vector<int>& topologies, double tolerance_mm, ProofWork& work,
                 const std::atomic<bool>& stop) {
  std::set<std::vector<int>> sequences;  // which kinds; their order does not matter here
  for (const int t : topologies) {
    std::vector<int> kinds;
    for (const StageUse& use : problem.stages(t)) kinds.push_back(use.kind);
    std::sort(kinds.begin(), kinds.end());
    sequences.insert(kinds);
  }
  const std::size_t states = problem.states().size();
  const StateSet all = states >= kMostStates ? ~StateSet{0} : (StateSet{1} << states) - 1;
  for (const std::vector<int>& goal : problem.goals()) {
    StateSet to_lose = all;
    for (const int state : goal) to_lose &= ~only(state);
    for (const int kept : goal) {
      if (!CoverProof(problem, sequences, kept, to_lose, tolerance_mm, work, stop).excludes()) return false;
    }
  }
  return true;
}

std::optional<double> least_excluded(const StagedProblem& problem, const std::vector<int>& topologies, double best_mm,
                                     ProofWork& work, const std::atomic<bool>& stop) {
  std::optional<double> excluded;
  for (double gap = std::max(best_mm, 1.0); gap > kNearest_mm; gap *= kNearer) {
    if (!is_excluded(problem, topologies, best_mm + gap, work, stop)) break;
    excluded = best_mm + gap;
  }
  return excluded;
}

}  // namespace formotion
