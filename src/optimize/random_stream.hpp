// Random numbers that depend on what they are for, never on the thread that draws them.
#pragma once

#include <cstdint>
#include <vector>

namespace formotion {

// A stream keyed by (seed, purpose, index): SplitMix64 (Steele, Lea, Flood 2014) over a mix of the keys.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index)
      : state_(mixed(mixed(mixed(seed) ^ purpose) + index)) {}

  std::uint64_t next() {
    state_ += kStep;
    return mixed(state_);
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }  // [0, 1)
  template <class T>
  const T& pick(const std::vector<T>& items) {  // items not empty
    return items[static_cast<std::size_t>(next() % items.size())];
  }
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;
  static std::uint64_t mixed(std::uint64_t z) {
    z += kStep;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace formotion
