// work: what a worker runs. Reads an order, runs its tasks in a child process, writes the report.
#include <fstream>
#include <iterator>

#include "applications/assembly/assembly_problem.hpp"
#include "applications/feeder/feeder_problem.hpp"
#include "applications/nest/nest_problem.hpp"
#include "cluster/supervised_work.hpp"
#include "commands.hpp"
#include "io/problem_file.hpp"
#include "optimize/run_store.hpp"
#include "report/front_files.hpp"

namespace formotion {

namespace {

std::unique_ptr<Problem> problem_of(const ProblemFile& file) {
  if (file.assembly) return std::make_unique<assembly::AssemblyProblem>(*file.assembly);
  if (file.nest) return std::make_unique<nest::NestProblem>(*file.nest);
  return std::make_unique<feeder::FeederProblem>(file.feeder);
}

}  // namespace

int run_work(const WorkFiles& files) {
  std::ifstream stream(files.order, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw StoreError(files.order + ": cannot be read");
  const WorkReport report = supervised(
      decoded_order(bytes), [&]() -> std::unique_ptr<Problem> { return problem_of(read_problem_file(files.problem)); });
  write_file(files.report, encoded(report));
  return kDone;
}

}  // namespace formotion
