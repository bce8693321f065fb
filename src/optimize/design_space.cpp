#include "optimize/design_space.hpp"

#include <algorithm>
#include <array>

#include "optimize/random_stream.hpp"

namespace formotion {
namespace {

constexpr std::array<int, 32> kPrimes{2,  3,  5,  7,  11, 13, 17, 19, 23, 29,  31,  37,  41,  43,  47,  53,
                                      59, 61, 67, 71, 73, 79, 83, 89, 97, 101, 103, 107, 109, 113, 127, 131};

double radical_inverse(std::uint64_t index, int base) {
  double value = 0, digit = 1.0 / base;
  for (; index > 0; index /= static_cast<std::uint64_t>(base), digit /= base) {
    value += static_cast<double>(index % static_cast<std::uint64_t>(base)) * digit;
  }
  return value;
}

}  // namespace

DesignSpace::DesignSpace(const Problem& problem, int topology) : topology_(topology) {
  for (const int index : problem.topologies()[static_cast<std::size_t>(topology)].variables)
    add(problem.variables()[static_cast<std::size_t>(index)]);
}

DesignSpace::DesignSpace(std::span<const Variable> variables) {
  for (const Variable& variable : variables) add(variable);
}

void DesignSpace::add(const Variable& variable) {
  if (variable.max > variable.min) free_.push_back(static_cast<int>(low_.size()));
  low_.push_back(variable.min);
  high_.push_back(variable.max);
  guess_.push_back(variable.start());
}

Candidate DesignSpace::at(std::span<const double> unit) const {
  Candidate candidate{topology_, low_};
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const auto v = static_cast<std::size_t>(free_[i]);
    const double t = std::clamp(unit[i], 0.0, 1.0);
    candidate.values[v] = t == 1 ? high_[v] : low_[v] + t * (high_[v] - low_[v]);
  }
  return candidate;
}

std::vector<double> DesignSpace::unit_of(const Candidate& candidate) const {
  std::vector<double> unit;
  for (const int i : free_) {
    const auto v = static_cast<std::size_t>(i);
    unit.push_back(std::clamp((candidate.values[v] - low_[v]) / (high_[v] - low_[v]), 0.0, 1.0));
  }
  return unit;
}

std::vector<double> DesignSpace::start() const { return unit_of({topology_, guess_}); }

std::vector<double> DesignSpace::spread_point(std::uint64_t index, std::uint64_t seed) const {
  std::vector<double> unit;
  for (std::size_t d = 0; d < free_.size(); ++d) {
    // A random shift modulo 1 (Cranley, Patterson 1976) makes seeds differ; beyond the primes plain random numbers do.
    const double shift = RandomStream(seed, 0x5eed, d).uniform();
    const double value = d < kPrimes.size() ? radical_inverse(index + 1, kPrimes[d]) + shift
                                            : RandomStream(seed, 0xfa11 + d, index).uniform();
    unit.push_back(value >= 1 ? value - 1 : value);
  }
  return unit;
}

}  // namespace formotion
