// libFuzzer: problem_fuzzer FOLDER ../../problems/feeder ../corpus/problems
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/input_law.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string breach =
      fuzz::breach(fuzz::Reader::Problem, std::string(reinterpret_cast<const char*>(data), size));
  if (breach.empty()) return 0;
  std::fprintf(stderr, "%s\n", breach.c_str());
  std::abort();
}
