#include "optimize/archive.hpp"

#include <catch2/catch.hpp>

#include "optimize/random_stream.hpp"

using namespace formotion;

namespace {

std::vector<std::vector<double>> random_losses(int count, int objectives, std::uint64_t seed, int grid) {
  RandomStream random(seed, 1, 2);
  std::vector<std::vector<double>> all;
  for (int i = 0; i < count; ++i) {
    std::vector<double> losses;
    for (int k = 0; k < objectives; ++k) losses.push_back(grid > 0 ? random.below(grid) : random.uniform());
    all.push_back(losses);
  }
  return all;
}

}  // namespace

TEST_CASE("without resolution and limit the archive is the set that nobody dominates, by brute force") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto all = random_losses(200, 2 + static_cast<int>(seed % 3), seed, seed % 2 ? 12 : 0);
    Archive archive(std::vector<double>(all[0].size(), 0), 1000);
    for (std::size_t i = 0; i < all.size(); ++i) archive.offer(static_cast<std::int64_t>(i) + 1, all[i]);
    std::vector<std::int64_t> expected;
    for (std::size_t i = 0; i < all.size(); ++i) {
      bool best = true;
      for (std::size_t j = 0; j < all.size(); ++j)
        best = best && !dominates(all[j], all[i]) && !(j < i && all[j] == all[i]);
      if (best) expected.push_back(static_cast<std::int64_t>(i) + 1);
    }
    std::vector<std::int64_t> found;
    for (const Archive::Member& member : archive.members()) found.push_back(member.number);
    REQUIRE(found == expected);
  }
}

TEST_CASE("whatever resolution and limit: no member dominates another, and the best of every objective stays") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto all = random_losses(500, 3, seed, 0);
    Archive archive({0.05, 0, 0.1}, 25);
    for (std::size_t i = 0; i < all.size(); ++i) archive.offer(static_cast<std::int64_t>(i) + 1, all[i]);
    REQUIRE(archive.members().size() <= 25);
    for (const auto& a : archive.members()) {
      for (const auto& b : archive.members()) REQUIRE_FALSE(dominates(a.losses, b.losses));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      double least = 1, kept = 1;
      for (const auto& losses : all) least = std::min(least, losses[k]);
      for (const auto& member : archive.members()) kept = std::min(kept, member.losses[k]);
      REQUIRE(kept == least);
    }
  }
}

TEST_CASE("every offered design is nearly dominated by some member: within one box of the resolution") {
  const auto all = random_losses(2000, 2, 7, 0);
  const double r = 0.02;
  Archive archive({r, r}, 1000);
  for (std::size_t i = 0; i < all.size(); ++i) archive.offer(static_cast<std::int64_t>(i) + 1, all[i]);
  for (const auto& losses : all) {
    bool covered = false;
    for (const auto& m : archive.members())
      covered = covered || (m.losses[0] <= losses[0] + r && m.losses[1] <= losses[1] + r);
    REQUIRE(covered);
  }
}
