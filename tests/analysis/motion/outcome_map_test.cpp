// Outcome maps against dense samples of what they map, and against functions made to be awkward.
#include "analysis/motion/outcome_map.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/polygon.hpp"
#include "analysis/motion/contact_space.hpp"
#include "analysis/motion/projection.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

double wrapped(double rad) {
  const double turned = std::fmod(rad, kTurn);
  return turned < 0 ? turned + kTurn : turned;
}

bool is_in(const OutcomeInterval& interval, double theta) {
  if (interval.from_rad < interval.to_rad) return theta >= interval.from_rad && theta <= interval.to_rad;
  return theta >= interval.from_rad || theta <= interval.to_rad;
}

int outcome_at(const OutcomeMap& map, double theta) {
  for (const OutcomeInterval& interval : map.intervals) {
    if (is_in(interval, theta)) return interval.outcome;
  }
  return -1000;
}

double off_bounds(const OutcomeMap& map, double theta) {
  double least = kTurn;
  for (const OutcomeInterval& interval : map.intervals) {
    least = std::min(least, std::abs(std::remainder(theta - interval.from_rad, kTurn)));
    least = std::min(least, std::abs(std::remainder(theta - interval.to_rad, kTurn)));
  }
  return least;
}

// What holds for every map: the intervals cover the circle, share their ends, and differ from their neighbours.
void check_shape(const OutcomeMap& map) {
  REQUIRE_FALSE(map.intervals.empty());
  if (map.intervals.size() == 1) {
    CHECK(map.intervals[0].from_rad == 0);
    CHECK(map.intervals[0].to_rad == kTurn);
    return;
  }
  double covered = 0;
  for (std::size_t i = 0; i < map.intervals.size(); ++i) {
    const OutcomeInterval& interval = map.intervals[i];
    const OutcomeInterval& next = map.intervals[(i + 1) % map.intervals.size()];
    CHECK(interval.to_rad == next.from_rad);
    CHECK(interval.outcome != next.outcome);
    CHECK(interval.from_rad >= 0);
    CHECK(interval.from_rad < kTurn);
    if (i + 1 < map.intervals.size()) CHECK(interval.from_rad < next.from_rad);
    CHECK(is_in(interval, wrapped(interval.sample_rad)));
    covered += wrapped(interval.to_rad - interval.from_rad);
  }
  CHECK(covered == Approx(kTurn).epsilon(1e-12));
}

// A function of steps: outcome k from bounds[k] to the next, the last one wraps.
struct Steps {
  std::vector<double> bounds;  // ascending
  std::vector<int> outcomes;
  StartOutcome operator()(double theta) const {
    std::size_t k = bounds.size() - 1;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (theta >= bounds[i]) k = i;
    }
    if (theta < bounds.front()) k = bounds.size() - 1;
    return {outcomes[k], static_cast<std::uint64_t>(outcomes[k] + 10)};
  }
};

Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}

struct World {
  MovingShape part;
  Obstacles obstacles;
  Drive drive;
  double height_mm = 0;
};

ObstacleShape block(const Loop& loop) { return {normalised({loop, {}}), 0, false}; }
ObstacleShape wall() { return {{{{-1e5, -50}, {1e5, -50}, {1e5, 0}, {-1e5, 0}}, {}}, 0, true}; }

World random_world(std::uint64_t seed, bool belt) {
  Random random(seed);
  const Polygon outline = centred(random_polygon(random, 15));
  const AreaMoments moments = area_moments(outline);
  World world;
  world.part = MovingShape::of({outline}, std::sqrt(moments.second_mm4.trace() / moments.area_mm2));
  std::vector<ObstacleShape> shapes;
  if (belt) {
    // Two fences, one behind the other, and a pin on some.
    const double a = uniform(random, 0.4, 1.0), b = -uniform(random, 0.4, 1.0);
    const auto fence = [](const Point& from, double angle, double length) {
      const Point along(std::cos(angle), std::sin(angle));
      const Point back = (angle > 0 ? -8 : 8) * Point(-along.y(), along.x());
      return block({from, from + length * along, from + length * along + back, from + back});
    };
    shapes = {fence({0, -40}, a, 130), fence({130, 90}, b, 110)};
    if (below(random, 2)) shapes.push_back({{{{60, 60}}, {}}, 3, false});
    world.drive = {{1, 0}, uniform(random, 0, 0.3)};
    world.height_mm = 0;
  } else {
    shapes = {wall(),
              block({{-5, -2}, {40, -2}, {40, uniform(random, 8, 25)}}),
              {{{{uniform(random, 60, 80), uniform(random, 10, 30)}}, {}}, uniform(random, 1, 4), false}};
    const double angle = -uniform(random, 0.3, 0.9);
    world.drive = {{std::cos(angle), std::sin(angle)}, uniform(random, 0, 0.4)};
    world.height_mm = 17;
  }
  world.obstacles = *make_obstacles(shapes);
  return world;
}

// Ends, and where they leave: in one of the orientations met so far.
class Ends {
 public:
  explicit Ends(const World& world) : world_(world), space_(world.part, world.obstacles) {}
  StartOutcome at(double theta, Funnels* funnels = nullptr) {
    ProjectionOptions options;
    options.keep_path = false;
    options.funnels = funnels;
    const Projection path = project(space_, world_.drive, {-45, world_.height_mm, theta}, options);
    int outcome = -1 - static_cast<int>(path.end);
    if (path.end == ProjectionEnd::Steady && path.funnelled) {
      outcome = -1;
      for (std::size_t i = 0; i < exits_.size(); ++i) {
        if (std::abs(std::remainder(exits_[i] - path.last.theta_rad, kTurn)) < 1e-4) outcome = static_cast<int>(i);
      }
      if (outcome < 0) {
        exits_.push_back(path.last.theta_rad);
        outcome = static_cast<int>(exits_.size()) - 1;
      }
    }
    return {outcome, path.history};
  }

 private:
  const World& world_;
  ContactSpace space_;
  std::vector<double> exits_;
};

}  // namespace

TEST_CASE("a map of steps gives the steps back: 400 random circles") {
  Random random(20261231);
  for (int i = 0; i < 400; ++i) {
    Steps steps;
    const int count = 2 + below(random, 8);
    // Wider than the grid, so that each is met.
    const double slack = kTurn - count * 0.06;
    std::vector<double> cuts;
    for (int k = 0; k < count; ++k) cuts.push_back(uniform(random, 0, 1));
    double sum = 0;
    for (const double cut : cuts) sum += cut;
    double at = uniform(random, 0, 0.06);
    for (int k = 0; k < count; ++k) {
      if (at >= kTurn) break;
      steps.bounds.push_back(at);
      steps.outcomes.push_back(k % 2 ? below(random, 3) + 1 : 0);
      at += 0.06 + slack * cuts[static_cast<std::size_t>(k)] / sum * 0.99;
    }
    const OutcomeMap map = outcome_map([&](double theta) { return steps(theta); }, {});
    CAPTURE(i);
    check_shape(map);
    for (int k = 0; k < 200; ++k) {
      const double theta = uniform(random, 0, kTurn);
      if (map.intervals.size() > 1 && off_bounds(map, theta) < 2e-8) continue;
      REQUIRE(outcome_at(map, theta) == steps(theta).outcome);
    }
    for (const OutcomeInterval& interval : map.intervals) {
      if (map.intervals.size() == 1) continue;
      double off = kTurn;
      for (const double bound : steps.bounds)
        off = std::min(off, std::abs(std::remainder(bound - interval.from_rad, kTurn)));
      CHECK(off <= 1e-8);
      CHECK_FALSE(interval.thin);
    }
  }
}

TEST_CASE("an interval thinner than the grid is found where its history differs, or by a critical orientation") {
  const double middle = 1.2345, width = 1e-5;
  const auto thin = [&](double theta, bool tells) {
    const double off = theta - middle;
    const bool inside = std::abs(off) < width / 2;
    // Paths on its two sides take other events, as beside a corner.
    return StartOutcome{inside ? 1 : 0, inside ? 5u : tells && off > 0 ? 7u : 6u};
  };
  // Histories are followed down to 0.05 degrees: what is thinner may be missed, but not at a critical orientation.
  const std::array critical{middle};
  const OutcomeMap hinted = outcome_map([&](double theta) { return thin(theta, false); }, critical);
  check_shape(hinted);
  REQUIRE(hinted.intervals.size() == 2);
  CHECK_FALSE(hinted.intervals[0].thin);
  CHECK(wrapped(hinted.intervals[0].to_rad - hinted.intervals[0].from_rad) == Approx(width).margin(4e-8));
  const double wide = 0.002;
  const auto wider = [&](double theta) {
    const double off = theta - middle;
    const bool inside = std::abs(off) < wide / 2;
    return StartOutcome{inside ? 1 : 0, inside ? 5u : off > 0 ? 7u : 6u};
  };
  const OutcomeMap told = outcome_map(wider, {});
  check_shape(told);
  REQUIRE(told.intervals.size() == 2);
  CHECK(wrapped(told.intervals[0].to_rad - told.intervals[0].from_rad) == Approx(wide).margin(4e-8));
  // A point's outcome between its neighbours', at a critical orientation's side.
  const auto point = [&](double theta) { return StartOutcome{theta < middle ? 0 : theta < middle + 1e-9 ? 1 : 2, 0}; };
  const std::array at_point{middle + 0.5 * OutcomeMapOptions{}.boundary_rad + 5e-10};
  const OutcomeMap pointed = outcome_map(point, at_point);
  check_shape(pointed);
  bool listed = false;
  for (const OutcomeInterval& interval : pointed.intervals) listed = listed || (interval.outcome == 1 && interval.thin);
  CHECK(listed);
}

TEST_CASE("maps wrap: boundaries at 0, one interval, first and last the same") {
  const OutcomeMap one = outcome_map([](double) { return StartOutcome{4, 1}; }, {});
  REQUIRE(one.intervals.size() == 1);
  CHECK(one.intervals[0].outcome == 4);
  check_shape(one);

  for (const double bound : {0.0, 1e-9, kTurn - 1e-9, 1e-12}) {
    const Steps steps{{bound, 3}, {0, 1}};
    const OutcomeMap map = outcome_map([&](double theta) { return steps(theta); }, {});
    CAPTURE(bound);
    check_shape(map);
    if (bound < 3) {
      REQUIRE(map.intervals.size() == 2);
      double off = kTurn;
      for (const OutcomeInterval& interval : map.intervals)
        off = std::min(off, std::abs(std::remainder(interval.from_rad - bound, kTurn)));
      CHECK(off <= 1e-8);
    }
  }
  const Steps around{{1, 5}, {0, 1}};
  const OutcomeMap map = outcome_map([&](double theta) { return around(theta); }, {});
  check_shape(map);
  REQUIRE(map.intervals.size() == 2);
  CHECK(map.intervals[1].from_rad == Approx(5));
  CHECK(map.intervals[1].to_rad == Approx(1));  // the last one wraps
  CHECK(map.intervals[1].outcome == 1);

  // A critical orientation at the seam, and beyond a turn.
  const std::array critical{0.0, kTurn, -1.0, 7.0};
  check_shape(outcome_map([&](double theta) { return around(theta); }, critical));
  // All the function's orientations are asked for in [0, 2 pi).
  bool outside = false;
  outcome_map(
      [&](double theta) {
        outside = outside || theta < 0 || theta >= kTurn;
        return around(theta);
      },
      critical);
  CHECK_FALSE(outside);
}

TEST_CASE("maps of real worlds never contradict a start: every quarter degree and 2,000 by chance, belts among them") {
  int worlds = 0, boundaries = 0, contradictions = 0, missed = 0, compared = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const World world = random_world(seed, seed % 2 == 0);
    Ends ends(world);
    Funnels funnels;
    const OutcomeMap map = outcome_map([&](double theta) { return ends.at(theta, &funnels); }, {});
    CAPTURE(seed, map.intervals.size());
    check_shape(map);
    ++worlds;
    boundaries += map.intervals.size() > 1 ? static_cast<int>(map.intervals.size()) : 0;
    Random random(seed);
    for (int k = 0; k < 1440 + 2000; ++k) {
      const double theta = k < 1440 ? kTurn * (k + 0.37) / 1440 : uniform(random, 0, kTurn);
      if (map.intervals.size() > 1 && off_bounds(map, theta) < 2e-8) continue;
      ++compared;
      const int found = ends.at(theta, k < 1440 ? nullptr : &funnels).outcome;
      if (found == outcome_at(map, theta)) continue;
      ++contradictions;
      // An interval that the map does not have: thinner than histories are followed to?
      missed += ends.at(wrapped(theta - 9e-4)).outcome != found && ends.at(wrapped(theta + 9e-4)).outcome != found;
      UNSCOPED_INFO("seed " << seed << " at " << theta << ": " << found << ", map " << outcome_at(map, theta));
    }
  }
  CAPTURE(worlds, boundaries, contradictions, missed, compared);
  CHECK(contradictions == 0);
  CHECK(boundaries > 8);
}

TEST_CASE("a box of frictions and drives has one outcome, or two members with different ones") {
  const std::array<std::pair<double, double>, 2> box{{{0, 1}, {2, 3}}};
  const SetOutcome one = outcome_of_set([](std::span<const double>) { return StartOutcome{3, 1}; }, box);
  CHECK(one.is_one);
  CHECK(one.outcome == 3);
  CHECK(one.members == 9);

  // A corner that differs.
  const SetOutcome corner = outcome_of_set(
      [](std::span<const double> at) {
        return StartOutcome{at[0] > 0.9 && at[1] > 2.9 ? 1 : 0, 0};
      },
      box);
  CHECK_FALSE(corner.is_one);
  REQUIRE(corner.a.size() == 2);
  REQUIRE(corner.b.size() == 2);
  CHECK(corner.b[0] == 1);
  CHECK(corner.b[1] == 3);

  // A patch inside, that a different history leads to.
  const auto patch = [](std::span<const double> at) {
    const bool inside = std::abs(at[0] - 0.25) < 0.05 && std::abs(at[1] - 2.25) < 0.05;
    return StartOutcome{inside ? 1 : 0, at[0] < 0.5 ? 1u : 2u};
  };
  const SetOutcome found = outcome_of_set(patch, box);
  CHECK_FALSE(found.is_one);
  REQUIRE(found.b.size() == 2);
  CHECK(patch(found.b).outcome != patch(found.a).outcome);
  // Sides of no width are one value.
  const std::array<std::pair<double, double>, 2> line{{{0.3, 0.3}, {2, 3}}};
  int members = 0;
  const SetOutcome thin = outcome_of_set(
      [&](std::span<const double> at) {
        ++members;
        CHECK(at[0] == 0.3);
        return StartOutcome{at[1] > 2.7 ? 1 : 0, 0};
      },
      line);
  CHECK_FALSE(thin.is_one);
  CHECK(thin.members == members);
  // Members and outcomes are told of real ones only: whatever is found differs.
  Random random(20261232);
  for (int i = 0; i < 200; ++i) {
    const double slope = uniform(random, -2, 2), offset = uniform(random, -2, 2);
    const auto half = [&](std::span<const double> at) {
      return StartOutcome{at[0] + slope * at[1] > offset ? 1 : 0, 0};
    };
    const SetOutcome set = outcome_of_set(half, box);
    const std::array<std::array<double, 2>, 4> corners{{{0, 2}, {0, 3}, {1, 2}, {1, 3}}};
    bool differ = false;
    for (const auto& c : corners) differ = differ || half(c).outcome != half(corners[0]).outcome;
    CHECK(set.is_one == !differ);  // a line that enters a box has a corner on each side
    if (!set.is_one) CHECK(half(set.a).outcome != half(set.b).outcome);
  }
}
