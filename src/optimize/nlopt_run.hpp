// NLopt as it must be called (docs/search.md).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace formotion {

enum class NloptMethod { DirectL, Crs2, Sbplx };

struct NloptRun {
  NloptMethod method = NloptMethod::Sbplx;
  std::vector<double> start;     // in the unit cube; not empty
  double step = 0.1;             // Sbplx: the first one
  std::int64_t evaluations = 0;  // at most; NLopt may stop earlier
  std::uint64_t seed = 0;
};

// Minimises over the unit cube. The objective keeps its own record: NLopt may forget its best point. It must be finite.
// Its exceptions end the run and are thrown again here.
void minimise(const NloptRun& run, const std::function<double(const std::vector<double>&)>& objective);

}  // namespace formotion
