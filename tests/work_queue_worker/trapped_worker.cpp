// Stands in for `formotion work` in the engine's tests: the problem file is a word that says what happens at one
// candidate.
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "cluster/supervised_work.hpp"
#include "work_queue/trapped_problem.hpp"

using namespace formotion;

int main(int argc, char** argv) {  // work PROBLEM ORDER REPORT
  if (argc != 5) return 2;
  const auto text = [](const char* path) {
    std::ifstream stream(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string act = text(argv[2]);
  if (act == "refuse") return 5;
  const WorkReport report =
      supervised(decoded_order(text(argv[3])), [&] { return std::make_unique<TrappedProblem>(act); });
  std::ofstream(argv[4], std::ios::binary) << encoded(report);
  return 0;
}
