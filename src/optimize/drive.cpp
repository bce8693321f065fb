#include "optimize/drive.hpp"

#include <stdexcept>

#include "optimize/nlopt_run.hpp"

namespace formotion {
namespace {

NloptRun nlopt_run_of(const DesignSpace& space, const SearchTask& task) {
  NloptRun run{NloptMethod::Sbplx, space.start(), task.step, task.evaluations, task.seed};
  if (task.driver == Driver::DirectL) run.method = NloptMethod::DirectL;
  if (task.driver == Driver::Crs2) {
    run.method = NloptMethod::Crs2;
    run.start = space.spread_point(task.first_point, task.seed);
  }
  if (task.driver == Driver::Sbplx && task.start) run.start = space.unit_of(*task.start);
  return run;
}

}  // namespace

void drive(const DesignSpace& space, const SearchTask& task, const std::function<double(const Candidate&)>& merit) {
  if (task.driver == Driver::Listed) {
    for (const Candidate& candidate : task.listed) merit(candidate);
    return;
  }
  if (space.dimensions() == 0) {
    merit(space.at({}));
    return;
  }
  switch (task.driver) {
    case Driver::Spread:
      for (std::int64_t i = 0; i < task.evaluations; ++i)
        merit(space.at(space.spread_point(task.first_point + static_cast<std::uint64_t>(i), task.seed)));
      return;
    case Driver::DirectL:
    case Driver::Crs2:
    case Driver::Sbplx:
      minimise(nlopt_run_of(space, task), [&](const std::vector<double>& unit) { return merit(space.at(unit)); });
      return;
    default:
      throw std::logic_error(std::string("no driver of merits alone: ") + name(task.driver));
  }
}

}  // namespace formotion
