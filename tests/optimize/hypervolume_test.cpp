#include "optimize/hypervolume.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "optimize/random_stream.hpp"

using namespace formotion;

namespace {

std::vector<LossPoint> random_points(int count, int objectives, std::uint64_t seed) {
  RandomStream random(seed, 1, 0);
  std::vector<LossPoint> points;
  for (int i = 0; i < count; ++i) {
    LossPoint point;
    for (int k = 0; k < objectives; ++k) point.push_back(random.uniform());
    points.push_back(std::move(point));
  }
  return points;
}

// Share of the unit cube's points that some given point is better than.
double sampled_volume(const std::vector<LossPoint>& points, int objectives, int samples) {
  int dominated = 0;
  for (const LossPoint& sample : random_points(samples, objectives, 99)) {
    dominated += std::any_of(points.begin(), points.end(), [&](const LossPoint& point) {
      for (std::size_t k = 0; k < point.size(); ++k) {
        if (point[k] > sample[k]) return false;
      }
      return true;
    });
  }
  return static_cast<double>(dominated) / samples;
}

}  // namespace

TEST_CASE("one point dominates the box between itself and the reference in one to five dimensions") {
  for (int objectives = 1; objectives <= 5; ++objectives) {
    double box = 1;
    LossPoint point, reference;
    for (int k = 0; k < objectives; ++k) {
      point.push_back(0.25 * k - 1);
      reference.push_back(2.0 + k);
      box *= reference.back() - point.back();
    }
    CAPTURE(objectives);
    CHECK(hypervolume({point}, reference) == Approx(box).epsilon(1e-12));
  }
}

TEST_CASE("a staircase of n steps in two dimensions has the volume of its steps") {
  for (const int n : {1, 2, 10, 100}) {
    std::vector<LossPoint> stairs;
    for (int i = 0; i < n; ++i) stairs.push_back({static_cast<double>(i) / n, 1 - static_cast<double>(i + 1) / n});
    // Step i: width 1/n, height (i + 1)/n.
    CHECK(hypervolume(stairs, std::vector<double>{1, 1}) == Approx((n + 1) / (2.0 * n)).epsilon(1e-12));
  }
}

TEST_CASE("three boxes in three dimensions follow inclusion and exclusion") {
  const std::vector<LossPoint> points{{0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}};
  // Each has 1/4; every pair and all three share the cube of 1/8.
  CHECK(hypervolume(points, std::vector<double>{1, 1, 1}) == Approx(3 * 0.25 - 3 * 0.125 + 0.125).epsilon(1e-12));
}

TEST_CASE("random sets have the volume that samples find") {
  for (int objectives = 2; objectives <= 4; ++objectives) {
    for (const int count : {2, 5, 30}) {
      const auto points = random_points(count, objectives, static_cast<std::uint64_t>(count));
      const double exact = hypervolume(points, std::vector<double>(static_cast<std::size_t>(objectives), 1.0));
      CAPTURE(objectives, count, exact);
      CHECK(sampled_volume(points, objectives, 40000) == Approx(exact).margin(0.0125));  // five standard deviations
    }
  }
}

TEST_CASE("the order of the points changes no bit and neither do dominated or repeated points") {
  const std::vector<double> reference{1, 1, 1};
  std::vector<LossPoint> points = random_points(40, 3, 3);
  const double volume = hypervolume(points, reference);
  RandomStream random(5, 5, 5);
  for (int round = 0; round < 20; ++round) {
    for (std::size_t i = points.size(); i-- > 1;)
      std::swap(points[i], points[static_cast<std::size_t>(random.below(static_cast<int>(i) + 1))]);
    REQUIRE(hypervolume(points, reference) == volume);
  }
  points.push_back(points.front());
  LossPoint worse = points.front();
  worse[1] += 0.01;
  points.push_back(worse);
  points.push_back({-5, 0, 1});  // not better than the reference in the last objective
  CHECK(hypervolume(points, reference) == Approx(volume).epsilon(1e-12));
}

TEST_CASE("a point that nothing dominates adds volume") {
  std::vector<LossPoint> points;
  double volume = 0;
  for (int i = 0; i < 20; ++i) {
    points.push_back({i / 20.0, 1 - (i + 1) / 20.0, 0.5});
    const double more = hypervolume(points, std::vector<double>{1, 1, 1});
    REQUIRE(more > volume);
    volume = more;
  }
}

TEST_CASE("the normalised volume does not depend on units and lies between 0 and 1") {
  const auto points = random_points(12, 3, 8);
  std::vector<LossPoint> scaled;
  for (const LossPoint& p : points) scaled.push_back({1000 * p[0] - 7, 0.01 * p[1], 3 * p[2] + 40});
  const double share = normalised_hypervolume(points, loss_range(points));
  CHECK(share > 0);
  CHECK(share < 1);
  CHECK(normalised_hypervolume(scaled, loss_range(scaled)) == Approx(share).epsilon(1e-9));
  const LossRange range{{0, 0}, {1, 1}};
  CHECK(normalised_hypervolume({}, range) == 0);
  CHECK(normalised_hypervolume({{-3, -4}}, range) == 1);
  CHECK(normalised_hypervolume({{1, 0}, {0, 1}}, range) == 0);
}

TEST_CASE("an objective that is the same everywhere leaves the volume to the others") {
  const LossRange range = loss_range({{-1, 3, 10}, {-1, 5, 6}});
  CHECK(normalised_hypervolume({{-1, 4, 8}}, range) == Approx(0.25));
  CHECK(normalised_hypervolume({{-0.9, 4, 8}}, range) == 0);  // worse in it
  CHECK(normalised_hypervolume({{-2, 4, 8}}, range) == Approx(0.25));
}
