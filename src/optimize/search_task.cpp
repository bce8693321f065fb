#include "optimize/search_task.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlopt.hpp>

#include "optimize/design_space.hpp"

namespace formotion {
namespace {

constexpr double kBroken = 1e3;      // all merits of unwanted candidates lie above all others'
constexpr double kConverged = 1e-9;  // of every variable's range

// Scores candidates until the budget is spent, and keeps them: NLopt may overrun its limits and forget its best point.
class Recorder {
 public:
  Recorder(const Problem& problem, const SearchTask& task, const KnownScores& known, const std::atomic<bool>& stop)
      : problem_(problem),
        task_(task),
        known_(known),
        stop_(stop),
        space_(problem, task.topology),
        objectives_(problem.objectives().begin(), problem.objectives().end()) {}

  const DesignSpace& space() const { return space_; }
  bool spent() const { return static_cast<std::int64_t>(trials_.size()) >= task_.evaluations; }

  double operator()(const std::vector<double>& unit) {
    if (stop_.load(std::memory_order_relaxed)) throw SearchStopped();
    Candidate candidate = space_.at(unit);
    const Score* known = known_.find(candidate);
    Score score = known ? *known : problem_.score(candidate);
    const double merit = task_.merit(score, objectives_);
    trials_.push_back({std::move(candidate), std::move(score)});
    return merit;
  }

  std::vector<Trial> take() { return std::move(trials_); }

 private:
  const Problem& problem_;
  const SearchTask& task_;
  const KnownScores& known_;
  const std::atomic<bool>& stop_;
  DesignSpace space_;
  std::vector<Objective> objectives_;
  std::vector<Trial> trials_;
};

// NLopt as it must be called: from C++ exceptions only nlopt::forced_stop may cross it.
class NloptRun {
 public:
  NloptRun(Recorder& record, const SearchTask& task, nlopt::algorithm algorithm)
      : record_(record), optimizer_(algorithm, static_cast<unsigned>(record.space().dimensions())) {
    const auto n = static_cast<std::size_t>(record.space().dimensions());
    optimizer_.set_lower_bounds(std::vector<double>(n, 0.0));
    optimizer_.set_upper_bounds(std::vector<double>(n, 1.0));
    optimizer_.set_min_objective(&NloptRun::objective, this);
    optimizer_.set_maxeval(static_cast<int>(std::min<std::int64_t>(task.evaluations, 1 << 30)));
    optimizer_.set_xtol_abs(kConverged);
    nlopt::srand(static_cast<unsigned long>(task.seed));
  }

  nlopt::opt& optimizer() { return optimizer_; }

  void run(std::vector<double> start) {
    double merit = 0;
    try {
      optimizer_.optimize(start, merit);
    } catch (const nlopt::forced_stop&) {
    } catch (const nlopt::roundoff_limited&) {  // as good as it gets
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  static double objective(const std::vector<double>& x, std::vector<double>&, void* self) {
    auto& run = *static_cast<NloptRun*>(self);
    if (run.record_.spent()) {
      run.optimizer_.force_stop();
      return kBroken;
    }
    try {
      return run.record_(x);
    } catch (...) {
      run.failure_ = std::current_exception();
      run.optimizer_.force_stop();
      return kBroken;
    }
  }

  Recorder& record_;
  nlopt::opt optimizer_;
  std::exception_ptr failure_;
};

void run_nlopt(Recorder& record, const SearchTask& task) {
  const DesignSpace& space = record.space();
  switch (task.driver) {
    case Driver::DirectL:
      NloptRun(record, task, nlopt::GN_DIRECT_L).run(space.start());
      return;
    case Driver::Crs2:
      NloptRun(record, task, nlopt::GN_CRS2_LM).run(space.spread_point(task.first_point, task.seed));
      return;
    case Driver::Sbplx: {
      NloptRun run(record, task, nlopt::LN_SBPLX);
      run.optimizer().set_initial_step(task.step);
      run.run(task.start ? space.unit_of(*task.start) : space.start());
      return;
    }
    case Driver::Spread:
      return;
  }
}

}  // namespace

const char* name(Driver driver) {
  switch (driver) {
    case Driver::Spread:
      return "spread points";
    case Driver::DirectL:
      return "DIRECT-L";
    case Driver::Crs2:
      return "CRS2";
    case Driver::Sbplx:
      return "SBPLX";
  }
  return "";
}

double Merit::operator()(const Score& score, const std::vector<Objective>& objectives) const {
  double broken = 0;
  for (std::size_t k = 0; k < objectives.size(); ++k) {
    if (!at_most[k]) continue;
    broken += std::max(0.0, objectives[k].loss(score.objectives[k]) - *at_most[k]) / scale[k];
  }
  if (!score.feasible || broken > 0) return kBroken + score.violation + broken;
  return objectives[focus].loss(score.objectives[focus]) / scale[focus];
}

std::vector<Trial> run_task(const Problem& problem, const SearchTask& task, const KnownScores& known,
                            const std::atomic<bool>& stop) {
  Recorder record(problem, task, known, stop);
  if (record.space().dimensions() == 0) {
    record({});
  } else if (task.driver == Driver::Spread) {
    for (std::uint64_t i = 0; !record.spent(); ++i)
      record(record.space().spread_point(task.first_point + i, task.seed));
  } else {
    run_nlopt(record, task);
  }
  return record.take();
}

}  // namespace formotion
