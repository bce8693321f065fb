#include "optimize/closing.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "optimize/certificate.hpp"
#include "optimize/stage_demands.hpp"

namespace formotion {
namespace {

constexpr std::size_t kMostTold = 12;            // topologies of a ranking, and of those not reached
constexpr std::size_t kMostNamed = 4;            // topologies in a sentence
constexpr std::int64_t kLeastProofWork = 20000;  // sweeps; and a quarter of the search's own work
constexpr std::int64_t kProofShare = 4;

// To 1e-6 mm, rounded so that what is said of it stays true.
std::string in_mm(double value, bool up = false) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(6) << (up ? std::ceil(value * 1e6) : std::floor(value * 1e6)) / 1e6 << " mm";
  return out.str();
}

class Closing {
 public:
  Closing(const Problem& problem, const RunState& state)
      : problem_(problem),
        staged_(*problem.staged()),
        state_(state),
        measured_(measured_choices(staged_, state.stages())) {
    for (const Composed& track : compose(staged_, static_cast<int>(problem.topologies().size()), measured_).tracks) {
      const auto [known, is_new] = best_.try_emplace(track.composition.topology, track.composition.tolerance_mm);
      known->second = std::max(known->second, track.composition.tolerance_mm);
    }
    const auto k = staged_.tolerance_objective();
    for (const Evaluated& e : state.evaluations()) {
      if (!k || !e.score.feasible) continue;
      const auto [known, is_new] = best_.try_emplace(e.candidate.topology, e.score.objectives[*k]);
      known->second = std::max(known->second, e.score.objectives[*k]);
    }
  }

  void rank(std::vector<Finding>& findings) const {
    std::vector<std::pair<double, int>> order;
    for (const auto& [topology, tolerance] : best_) {
      if (!staged_.stages(topology).empty()) order.emplace_back(-tolerance, topology);
    }
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < std::min(order.size(), kMostTold); ++i) {
      findings.push_back({"ranked", label(order[i].second),
                          "number " + std::to_string(i + 1) + " of " + std::to_string(order.size()) +
                              " that tracks were composed for, by tolerance: " + in_mm(-order[i].first)});
    }
    std::vector<StageChoice> seen = guessed_choices(staged_, state_.stages());
    std::erase_if(seen, [](const StageChoice& choice) { return choice.tolerance_mm <= 0; });
    const bool in_full = problem_.topologies().size() <= CompositionLimits{}.topologies_in_full;
    std::size_t unreached = 0;
    for (int t = 0; t < static_cast<int>(problem_.topologies().size()); ++t) {
      if (staged_.stages(t).empty() || best_.contains(t)) continue;
      if (++unreached <= kMostTold && in_full)
        findings.push_back({"ranked", label(t), "not reached: " + why_unreached(staged_, t, seen)});
    }
    if (!in_full && unreached > 0) {
      findings.push_back({"ranked", std::to_string(unreached) + " more topologies",
                          "not reached by compositions, or shorter tracks have as much tolerance"});
    } else if (unreached > kMostTold) {
      findings.push_back({"ranked", std::to_string(unreached - kMostTold) + " more topologies",
                          "not reached by any composition of the stages that were tried"});
    }
  }

  void prove(std::vector<Finding>& findings, const std::atomic<bool>& stop) const {
    const ProofScope scope = proof_scope(staged_, static_cast<int>(problem_.topologies().size()));
    std::string why;
    for (const std::string& hindrance : scope.hindrances) why += (why.empty() ? "" : "; ") + hindrance;
    if (scope.topologies.empty()) {
      findings.push_back({"proved", "nothing", "no bound on the tolerance can be proved: " + why});
      return;
    }
    double best = 0;
    std::string subject;
    for (std::size_t i = 0; i < scope.topologies.size(); ++i) {
      const auto known = best_.find(scope.topologies[i]);
      if (known != best_.end()) best = std::max(best, known->second);
      if (i < kMostNamed) subject += (i ? ", " : "") + label(scope.topologies[i]);
    }
    if (scope.topologies.size() > kMostNamed)
      subject += " and " + std::to_string(scope.topologies.size() - kMostNamed) + " more";
    ProofWork work{0, kLeastProofWork + (state_.history().empty() ? 0 : state_.history().back().work / kProofShare)};
    const auto bound = least_excluded(staged_, scope.topologies, best, work, stop);
    std::string text;
    if (!bound) {
      text = "no bound on the tolerance was proved within " + std::to_string(work.limit) + " sweeps";
    } else {
      text = "no design within these bounds has a tolerance of " + in_mm(*bound, true) +
             " or more; the best found has " + in_mm(best);
    }
    if (!why.empty()) text += ". Not of the other topologies: " + why;
    findings.push_back({"proved", bound ? subject : "nothing", text});
  }

 private:
  const std::string& label(int topology) const {
    return problem_.topologies()[static_cast<std::size_t>(topology)].label;
  }

  const Problem& problem_;
  const StagedProblem& staged_;
  const RunState& state_;
  std::vector<StageChoice> measured_;
  std::map<int, double> best_;  // tolerance by topology, of composed tracks and of designs
};

}  // namespace

std::vector<Finding> closing_findings(const Problem& problem, const RunState& state, const std::atomic<bool>& stop) {
  std::vector<Finding> findings;
  const StagedProblem* staged = problem.staged();
  if (!staged || staged->states().size() > kMostStates || staged->goals().empty()) return findings;
  const Closing closing(problem, state);
  closing.rank(findings);
  closing.prove(findings, stop);
  return findings;
}

}  // namespace formotion
