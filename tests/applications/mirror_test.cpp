#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

TEST_CASE("features that are symmetric along the feed never separate mirror poses: 200 designs") {
  int delivered = 0, lost = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const auto evaluation = evaluated(random_symmetric_feeder(random));
    CAPTURE(seed);
    const std::size_t half = evaluation.poses.size() / 2;
    REQUIRE(evaluation.poses.size() == 2 * half);
    for (std::size_t i = 0; i < half; ++i) {
      const feeder::PoseResult& up = evaluation.poses[i];
      const feeder::PoseResult* down = nullptr;
      for (std::size_t j = half; j < 2 * half; ++j) {
        const double apart = up.orientation_rad + evaluation.poses[j].orientation_rad;
        if (std::abs(std::remainder(apart, 2 * std::numbers::pi)) < 1e-9) down = &evaluation.poses[j];
      }
      REQUIRE(down);
      const bool passes = up.outcome == feeder::Outcome::Delivered;
      REQUIRE(up.prior == Approx(down->prior).epsilon(1e-9));
      if (!up.marginal) REQUIRE(passes == (down->outcome == feeder::Outcome::Delivered));
      REQUIRE(*up.margin_mm == Approx(*down->margin_mm).margin(1e-6));
      (passes ? delivered : lost) += 1;
    }
  }
  CHECK(delivered > 100);
  CHECK(lost > 100);
}

TEST_CASE("an unsymmetric cut-out separates the el from its mirror image") {
  const auto evaluation =
      evaluated(feeder_spec(flat_part(el_outline(), true), {cutout({{0, -5}, {22, -5}, {22, 7}, {0, 11}})}, 40));
  int differ = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = 4; j < 8; ++j) {
      const double apart = evaluation.poses[i].orientation_rad + evaluation.poses[j].orientation_rad;
      if (std::abs(std::remainder(apart, 2 * std::numbers::pi)) < 1e-9) {
        differ += std::abs(*evaluation.poses[i].margin_mm - *evaluation.poses[j].margin_mm) > 0.1;
      }
    }
  }
  CHECK(differ > 0);
}

TEST_CASE("tracks that look alike may differ in function, and one that looks different may do the same") {
  // In the spirit of the 1993 thesis's figure 1.3: the el on three tracks of 40 mm.
  const auto delivered = [](feeder::DesignSpec design) {
    std::vector<bool> passes;
    for (const auto& pose : evaluated(feeder_spec(flat_part(el_outline(), true), std::move(design), 40)).poses) {
      REQUIRE_FALSE(pose.marginal);
      passes.push_back(pose.outcome == feeder::Outcome::Delivered);
    }
    return passes;
  };
  const auto narrow = delivered({balcony(12.2, 60)});
  const auto wide = delivered({balcony(12.8, 60)});  // 0.6 mm more
  const auto vee = delivered({scallop(34, 30)});     // another shape altogether
  CHECK(narrow != wide);
  CHECK(vee == wide);
  CHECK(delivered({gap(12)}) == narrow);
}
