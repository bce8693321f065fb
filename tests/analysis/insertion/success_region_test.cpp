// Regions of start errors against shapes whose areas and boxes are known.
#include "analysis/insertion/success_region.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace formotion;

namespace {

using At = std::function<StartOutcome(double, double)>;

// Outcome 1 where f > 0, else 0; one history for each.
At where(const std::function<double(double, double)>& f) {
  return [f](double u, double v) {
    const int outcome = f(u, v) > 0 ? 1 : 0;
    return StartOutcome{outcome, static_cast<std::uint64_t>(outcome)};
  };
}

const ErrorBox kBox{-2, 2, -0.5, 0.5};

At ellipse(double a, double b) {
  return where([=](double u, double v) { return 1 - u * u / (a * a) - v * v / (b * b); });
}

// |u + tilt v| < half.
At band(double half, double tilt) {
  return where([=](double u, double v) { return half - std::abs(u + tilt * v); });
}

bool same(const OutcomeRegion& a, const OutcomeRegion& b) {
  return std::equal(a.rows.begin(), a.rows.end(), b.rows.begin(), b.rows.end(), [](const auto& one, const auto& other) {
    return one.v == other.v && std::equal(one.intervals.begin(), one.intervals.end(), other.intervals.begin(),
                                          other.intervals.end(), [](const auto& i, const auto& j) {
                                            return i.from == j.from && i.to == j.to && i.outcome == j.outcome;
                                          });
  });
}

}  // namespace

TEST_CASE("rows ascend and cover the box: intervals meet bit for bit and neighbours have different outcomes") {
  const OutcomeRegion region = outcome_region(kBox, ellipse(1.5, 0.4));
  CHECK(region.rows.front().v == kBox.v_min);
  CHECK(region.rows.back().v == kBox.v_max);
  for (std::size_t i = 0; i < region.rows.size(); ++i) {
    const RegionRow& row = region.rows[i];
    if (i > 0) CHECK(row.v > region.rows[i - 1].v);
    CHECK(row.intervals.front().from == kBox.u_min);
    CHECK(row.intervals.back().to == kBox.u_max);
    for (std::size_t k = 0; k + 1 < row.intervals.size(); ++k) {
      CHECK(row.intervals[k].to == row.intervals[k + 1].from);
      CHECK(row.intervals[k].outcome != row.intervals[k + 1].outcome);
    }
  }
}

TEST_CASE("boundaries on rows are located to the tolerance") {
  const OutcomeRegion region = outcome_region(kBox, ellipse(1.5, 0.8));
  for (const RegionRow& row : region.rows) {
    const double half = 1.5 * std::sqrt(1 - row.v * row.v / 0.64);
    REQUIRE(row.intervals.size() == 3);
    CHECK(std::abs(row.intervals[0].to + half) <= 4e-7);
    CHECK(std::abs(row.intervals[1].to - half) <= 4e-7);
  }
}

TEST_CASE("the share of straight bands is exact and that of an ellipse is its area") {
  const OutcomeRegion straight = outcome_region(kBox, band(0.7, 1.3));
  CHECK(std::abs(share_of(straight, 1) - 0.35) <= 1e-6);
  CHECK(std::abs(share_of(straight, 0) + share_of(straight, 1) - 1) <= 1e-12);
  CHECK(straight.rows.size() == 13);  // the middles say that nothing more is needed
  for (const double b : {0.37, 0.45, 0.6}) {
    // The area within |v| <= 1/2.
    const double t = std::min(1.0, 0.5 / b);
    const double share = 1.5 * b * 2 * (std::asin(t) + t * std::sqrt(1 - t * t)) / 4;
    CHECK(std::abs(share_of(outcome_region(kBox, ellipse(1.5, b)), 1) - share) <= 2e-3);
  }
}

TEST_CASE("a wedge that ends within the box and a change along v alone are found between the rows") {
  // |u| < 4 (v + 0.1): a triangle from v = -0.1 up, 4.8 wide at the top, cut at |u| = 2 from v = 0.4 on.
  const OutcomeRegion wedge =
      outcome_region(kBox, where([](double u, double v) { return 4 * (v + 0.1) - std::abs(u); }));
  CHECK(std::abs(share_of(wedge, 1) - (0.5 * 0.5 * 4 + 0.1 * 4) / 4) <= 2e-3);
  const OutcomeRegion step = outcome_region(kBox, where([](double, double v) { return v - 0.123; }));
  CHECK(std::abs(share_of(step, 1) - 0.377) <= 2e-3);
}

TEST_CASE("a narrow interval between starts of one outcome is found where their histories differ") {
  // 2 percent of the row, between two ways to the other outcome.
  const At at = [](double u, double) {
    if (std::abs(u - 0.21) < 0.04) return StartOutcome{0, 3};
    return StartOutcome{1, u < 0.21 ? 2u : 1u};
  };
  CHECK(std::abs(share_of(outcome_region({-2, 2, 0, 0}, at), 0) - 0.02) <= 1e-6);
}

TEST_CASE("sides that are single values leave shares of lengths") {
  const OutcomeRegion along_u = outcome_region({-2, 2, 0.1, 0.1}, ellipse(1, 0.2));
  CHECK(along_u.rows.size() == 1);
  CHECK(std::abs(share_of(along_u, 1) - std::sqrt(0.75) / 2) <= 1e-6);
  const OutcomeRegion along_v = outcome_region({0.5, 0.5, -0.5, 0.5}, ellipse(1, 0.2));
  CHECK(std::abs(share_of(along_v, 1) - 0.4 * std::sqrt(0.75)) <= 1e-6);
  for (const double u : {0.5, 1.5}) {
    const OutcomeRegion point = outcome_region({u, u, 0, 0}, ellipse(1, 0.2));
    CHECK(point.starts == 1);
    CHECK(share_of(point, 1) == (u < 1 ? 1 : 0));
    CHECK(largest_scaled_box(point, 1, ellipse(1, 0.2)) == (u < 1 ? 1 : 0));
  }
  CHECK(std::abs(largest_scaled_box(along_v, 1, ellipse(1, 0.2)) - 0.4 * std::sqrt(0.75)) <= 1e-6);
  CHECK(std::abs(largest_scaled_box(along_u, 1, ellipse(1, 0.2)) - std::sqrt(0.75) / 2) <= 1e-6);
}

TEST_CASE("the largest scaled box is the closed form's for ellipses bands wedges and free boxes") {
  const auto largest = [](const At& at) { return largest_scaled_box(outcome_region(kBox, at), 1, at); };
  // Corners (2 k, k / 2) on the ellipse.
  CHECK(std::abs(largest(ellipse(1.5, 0.4)) - 1 / std::hypot(2 / 1.5, 0.5 / 0.4)) <= 2e-6);
  CHECK(std::abs(largest(ellipse(4, 0.45)) - 1 / std::hypot(2 / 4.0, 0.5 / 0.45)) <= 2e-6);
  // 2 k + 1.3 k / 2 = 0.7.
  CHECK(std::abs(largest(band(0.7, 1.3)) - 0.7 / 2.65) <= 2e-6);
  CHECK(std::abs(largest(band(0.7, 0)) - 0.35) <= 2e-6);
  // 2 k = 4 (0.1 - k / 2).
  CHECK(std::abs(largest(where([](double u, double v) { return 4 * (v + 0.1) - std::abs(u); })) - 0.1) <= 2e-6);
  CHECK(std::abs(largest(where([](double, double v) { return 0.123 - v; })) - 0.246) <= 2e-6);
  CHECK(largest(where([](double, double) { return 1; })) == 1);
  CHECK(largest(where([](double, double) { return -1; })) == 0);
  CHECK(largest(where([](double u, double) { return std::abs(u) - 0.01; })) == 0);
}

TEST_CASE("the largest scaled box of hundreds of random bumps has no other outcome on a fine grid inside") {
  for (int seed = 1; seed <= 200; ++seed) {
    // Forbidden: beyond a wavy boundary about the middle.
    const double a = 0.3 + 0.25 * std::sin(1.7 * seed), b = 2 * std::sin(2.9 * seed), c = 0.15 * std::cos(5.1 * seed);
    const At at = where([=](double u, double v) {
      const double x = u / 2, y = v * 2, angle = std::atan2(y, x);
      return 0.2 + a * a + c * std::cos(3 * angle + b) - std::hypot(x, y);
    });
    const OutcomeRegion region = outcome_region(kBox, at);
    const double k = largest_scaled_box(region, 1, at);
    CAPTURE(seed, k);
    if (at(0, 0).outcome == 0) {
      CHECK(k == 0);
      continue;
    }
    int others_inside = 0, others_beyond = 0;
    for (int i = -50; i <= 50; ++i) {
      for (int j = -50; j <= 50; ++j) {
        const double inside = 0.99 * k / 50, beyond = std::min(1.0, 1.001 * k + 1e-3) / 50;
        others_inside += at(2 * i * inside, 0.5 * j * inside).outcome == 0;
        others_beyond += at(2 * i * beyond, 0.5 * j * beyond).outcome == 0;
      }
    }
    CHECK(others_inside == 0);
    if (k < 0.998) CHECK(others_beyond > 0);
  }
}

TEST_CASE("starts are counted and equal questions have the same rows bit for bit") {
  int calls = 0;
  const At inner = ellipse(1.5, 0.4);
  const At counting = [&](double u, double v) {
    ++calls;
    return inner(u, v);
  };
  const OutcomeRegion first = outcome_region(kBox, counting);
  CHECK(first.starts == calls);
  CHECK(first.rows.size() <= 65);
  const OutcomeRegion second = outcome_region(kBox, inner);
  CHECK(second.starts == first.starts);
  CHECK(same(first, second));
}
