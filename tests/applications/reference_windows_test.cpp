// The numbers of docs/feeder.md, where they can be had in closed form and where only a search tells.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

int delivered_count(const feeder::FeederEvaluation& evaluation) {
  int count = 0;
  for (const auto& pose : evaluation.poses) count += pose.outcome == feeder::Outcome::Delivered;
  return count;
}

// Where the truth of a statement changes between low and high, to 1e-7.
double change(double low, double high, const std::function<bool(double)>& holds) {
  const bool at_low = holds(low);
  REQUIRE(at_low != holds(high));
  while (high - low > 1e-7) {
    const double middle = 0.5 * (low + high);
    (holds(middle) == at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

int delivered_by_balcony(double width, double tilt_rad = 0) {
  feeder::FeederSpec spec = feeder_spec(flat_part(bibazu_l(), false), {balcony(width, 100)}, 60);
  spec.environment.tilt_rad = tilt_rad;
  return delivered_count(evaluated(spec));
}
int delivered_by_gap(double length) {
  return delivered_count(evaluated(feeder_spec(flat_part(bibazu_l(), false), {gap(length)}, 60)));
}

// From the outline's dimensions: arms a wide (10.4514) and b wide (9.52185).
struct LPart {
  Point com = area_moments({bibazu_l(), {}}).centroid;
  double low = -com.y(), high = -com.x();  // 10.275, 14.855
};

}  // namespace

TEST_CASE("the BiBaZu L-part has three poses of the documented heights and priors, its centre of mass outside of it") {
  const feeder::FeederProblem problem(feeder_spec(flat_part(bibazu_l(), false), {balcony(12, 100)}));
  const auto poses = problem.stable_poses({});
  REQUIRE(poses.size() == 3);
  std::vector<std::pair<double, double>> found;
  for (const auto& pose : poses) found.emplace_back(pose.com_wall_mm, pose.prior);
  std::sort(found.begin(), found.end());
  CHECK(found[0].first == Approx(10.275).margin(5e-4));
  CHECK(found[1].first == Approx(14.087).margin(5e-4));
  CHECK(found[2].first == Approx(14.855).margin(5e-4));
  CHECK(found[0].second == Approx(0.343).margin(5e-4));
  CHECK(found[1].second == Approx(0.411).margin(5e-4));
  CHECK(found[2].second == Approx(0.245).margin(6e-4));
  CHECK(found[0].second + found[1].second + found[2].second == Approx(1).epsilon(1e-12));
  CHECK(locate(Polygon{bibazu_l(), {}}, LPart().com, 0) == Side::Outside);
}

TEST_CASE("a balcony delivers exactly one pose of the L-part from 10.404 up to 14.087 mm") {
  const double first = change(9, 12, [](double w) { return delivered_by_balcony(w) >= 1; });
  const double second = change(12, 14.5, [](double w) { return delivered_by_balcony(w) >= 2; });
  const double third = change(14.5, 20, [](double w) { return delivered_by_balcony(w) >= 3; });
  // The line from the far end of the lying arm's top to the standing arm's inner side at the lip passes the centre.
  const LPart l;
  const double back = 40.62175 - l.high, front = l.high - 10.4514;
  CHECK(first == Approx(9.52185 + (l.low - 9.52185) * (back + front) / back).margin(1e-6));
  CHECK(first == Approx(10.404).margin(5e-4));
  // The pose on its two arm ends: the lip's height is the centre's.
  const Point hypotenuse = Point(-40.62175, -9.52185) - Point(-10.4514, -30.491329);
  const double height = std::abs(cross(hypotenuse, l.com - Point(-10.4514, -30.491329))) / hypotenuse.norm();
  CHECK(second == Approx(height).margin(1e-6));
  CHECK(second == Approx(14.087).margin(5e-4));
  CHECK(third == Approx(15.019).margin(5e-4));
  for (double w = 10.41; w < 14.08; w += 0.1) REQUIRE(delivered_by_balcony(w) == 1);
  const auto one = evaluated(feeder_spec(flat_part(bibazu_l(), false), {balcony(12, 100)}, 60));
  CHECK(one.metrics.efficiency == Approx(0.343).margin(5e-4));
  CHECK(one.feasible);
}

TEST_CASE("a gap delivers exactly one pose of the L-part from the leg's width, 10.4514, to 20.0466 mm") {
  CHECK(change(9, 12, [](double length) { return delivered_by_gap(length) <= 1; }) == Approx(10.4514).margin(1e-6));
  CHECK(change(12, 25, [](double length) { return delivered_by_gap(length) <= 0; }) == Approx(20.0466).margin(5e-5));
  const auto one = evaluated(feeder_spec(flat_part(bibazu_l(), false), {gap(15)}, 60));
  CHECK(one.metrics.efficiency == Approx(0.411).margin(5e-4));
}

TEST_CASE("a tilt towards the wall moves the switch of the convex pose by half the thickness times its tangent") {
  const double tilt = 5 * std::numbers::pi / 180;
  const double level = change(12, 14.5, [](double w) { return delivered_by_balcony(w) >= 2; });
  const double tilted = change(12, 14.5, [&](double w) { return delivered_by_balcony(w, tilt) >= 2; });
  CHECK(level - tilted == Approx(1.5 * std::tan(tilt)).margin(1e-6));
  CHECK(level - tilted == Approx(0.131).margin(5e-4));
}

TEST_CASE("a balcony from 7.5 to 10.06 mm passes just the long edge of the el, on either face") {
  const auto passed = [](double width) {
    std::vector<std::string> names;
    for (const auto& pose : evaluated(feeder_spec(flat_part(el_outline(), true), {balcony(width, 100)}, 40)).poses) {
      if (pose.outcome != feeder::Outcome::Delivered) continue;
      names.push_back(pose.aspect + " " + std::to_string(std::lround(pose.orientation_rad * 180 / std::numbers::pi)));
    }
    return names;
  };
  const std::vector<std::string> long_edges{"up 0", "down 0"};
  for (double w = 7.5; w < 10.06; w += 0.05) REQUIRE(passed(w) == long_edges);
  CHECK(change(6, 9, [&](double w) { return !passed(w).empty(); }) == Approx(7.5).margin(1e-6));
  CHECK(change(9, 11, [&](double w) { return passed(w).size() > 2; }) == Approx(10.06).margin(5e-3));
}
