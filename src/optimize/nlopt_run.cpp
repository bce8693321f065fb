#include "optimize/nlopt_run.hpp"

#include <algorithm>
#include <exception>
#include <nlopt.hpp>

namespace formotion {
namespace {

constexpr double kConverged = 1e-9;   // of every variable's range
constexpr double kNotCalled = 1e300;  // what NLopt sees of points that are no longer evaluated

nlopt::algorithm algorithm(NloptMethod method) {
  switch (method) {
    case NloptMethod::DirectL:
      return nlopt::GN_DIRECT_L;
    case NloptMethod::Crs2:
      return nlopt::GN_CRS2_LM;
    case NloptMethod::Sbplx:
      return nlopt::LN_SBPLX;
  }
  return nlopt::LN_SBPLX;
}

// From C++ exceptions only nlopt::forced_stop may cross NLopt, and some algorithms overrun their budget.
struct Call {
  nlopt::opt& optimizer;
  const std::function<double(const std::vector<double>&)>& objective;
  std::int64_t left = 0;
  std::exception_ptr failure = nullptr;

  static double evaluate(const std::vector<double>& x, std::vector<double>&, void* self) {
    auto& call = *static_cast<Call*>(self);
    if (call.left-- > 0) {
      try {
        return call.objective(x);
      } catch (...) { call.failure = std::current_exception(); }
    }
    call.optimizer.force_stop();
    return kNotCalled;
  }
};

}  // namespace

void minimise(const NloptRun& run, const std::function<double(const std::vector<double>&)>& objective) {
  const std::size_t n = run.start.size();
  nlopt::opt optimizer(algorithm(run.method), static_cast<unsigned>(n));
  optimizer.set_lower_bounds(std::vector<double>(n, 0.0));
  optimizer.set_upper_bounds(std::vector<double>(n, 1.0));
  Call call{optimizer, objective, run.evaluations};
  optimizer.set_min_objective(&Call::evaluate, &call);
  optimizer.set_maxeval(static_cast<int>(std::min<std::int64_t>(run.evaluations, 1 << 30)));
  optimizer.set_xtol_abs(kConverged);
  if (run.method == NloptMethod::Sbplx) optimizer.set_initial_step(run.step);
  nlopt::srand(static_cast<unsigned long>(run.seed));
  std::vector<double> x = run.start;
  double value = 0;
  try {
    optimizer.optimize(x, value);
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {  // as good as it gets
  }
  if (call.failure) std::rethrow_exception(call.failure);
}

}  // namespace formotion
