// The landscape of heights that the page shows: closed forms of the heights, basins against going downhill.
#include "report/nest_landscape.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "analysis/contact/free_slice.hpp"
#include "analysis/energy/lowest_positions.hpp"
#include "report/nest_data.hpp"

using namespace formotion;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSide_mm = 20;
constexpr LandscapeGrid kCoarse{24, 25, 2};

AffineLoop affine(const Loop& loop) {
  AffineLoop result;
  for (const Point& p : loop) {
    AffinePoint q;
    q[0].constant = p.x();
    q[1].constant = p.y();
    result.push_back(q);
  }
  return result;
}

nest::NestSpec spec_of(const Loop& part, const std::vector<Loop>& nest_mm, const Configuration& seat) {
  nest::NestSpec spec;
  AspectSpec aspect;
  aspect.name = "up";
  aspect.outline_mm = affine(part);
  aspect.height_mm = 5;
  spec.part.aspects.push_back(aspect);
  spec.designs.emplace_back();
  for (const Loop& loop : nest_mm) spec.designs[0].nest_mm.push_back(affine(loop));
  spec.goal.seat.aspect = "up";
  spec.goal.seat.at_mm = affine({seat.position()})[0];
  spec.goal.seat.orientation_rad = seat.theta_rad;
  return spec;
}

std::unique_ptr<nest::Scene> square_in(const std::vector<Loop>& nest_mm) {
  const nest::NestProblem problem(spec_of({{0, 0}, {kSide_mm, 0}, {kSide_mm, kSide_mm}, {0, kSide_mm}}, nest_mm, {}));
  return problem.scene(0, std::vector<double>{}, "up");
}

nest::NestRest rest_at(double x, double y, double theta) {
  nest::NestRest rest;
  rest.aspect = "up";
  rest.at = {x, y, theta};
  rest.height_mm = y;
  return rest;
}

// Two right-angled vees beside each other, at x = -40 and 40.
const Loop kTwoVees{{-120, -10}, {120, -10}, {120, 80}, {40, 0}, {0, 40}, {-40, 0}, {-120, 80}};

double lowered(const nest::Scene& scene, double across, double theta) {
  return drop_height_mm(free_slice(scene.part, scene.obstacles, theta), scene.gravity, across).value_or(1e9);
}

// Downhill on the surface itself, by ever smaller steps: slow, and no grid.
Point downhill(const nest::Scene& scene, Point at) {
  double least = lowered(scene, at.x(), at.y());
  for (double step = 0.5; step > 0.01;) {
    bool is_better = false;
    for (int k = 0; k < 16; ++k) {
      const Point next = at + step * Point(std::cos(k * kPi / 8), 0.06 * std::sin(k * kPi / 8));
      const double height = lowered(scene, next.x(), next.y());
      if (height >= least - 1e-9) continue;
      at = next;
      least = height;
      is_better = true;
      break;
    }
    if (!is_better) step /= 2;
  }
  return at;
}

}  // namespace

TEST_CASE("A square lowered into a vee stops where its support along a flank allows") {
  const auto scene = square_in({{{-100, -10}, {100, -10}, {100, 100}, {0, 0}, {-100, 100}}});
  REQUIRE(scene->symmetry == 4);
  const Landscape land = landscape_of(*scene, {rest_at(0, kSide_mm / std::sqrt(2), kPi / 4)});
  REQUIRE(land.height.size() == 72);
  CHECK(land.from_mm == Approx(-land.to_mm));
  double worst = 0;
  for (std::size_t row = 0; row < land.height.size(); ++row) {
    const double theta = 2 * kPi * static_cast<double>(row) / 72;
    REQUIRE(land.height[row].size() == 73);
    for (std::size_t column = 0; column < 73; ++column) {
      const double u = land.from_mm + static_cast<double>(column) * (land.to_mm - land.from_mm) / 72;
      // The flank y = |x| on either side: the square's support towards it, over its slope.
      const auto support = [&](double towards) {
        return kSide_mm / 2 * (std::abs(std::cos(towards - theta)) + std::abs(std::sin(towards - theta)));
      };
      const double expected = std::max(std::sqrt(2) * support(kPi / 4) - u, std::sqrt(2) * support(3 * kPi / 4) + u);
      REQUIRE(land.height[row][column]);
      worst = std::max(worst, std::abs(*land.height[row][column] - expected));
      CHECK(land.basin[row][column] == 0);  // of the one rest, in all four orientations
    }
  }
  CHECK(worst < 1e-6);
  CHECK(land.hidden.empty());
}

TEST_CASE("Basins of a nest that is its own mirror image are mirrored") {
  const auto scene = square_in({kTwoVees});
  const double y = kSide_mm / std::sqrt(2);
  const Landscape land = landscape_of(*scene, {rest_at(-40, y, kPi / 4), rest_at(40, y, kPi / 4)}, kCoarse);
  int middle = 0;
  for (int row = 0; row < 24; ++row) {
    for (int column = 0; column < 25; ++column) {
      const int own = land.basin[row][column], mirrored = land.basin[(24 - row) % 24][24 - column];
      CHECK(land.height[row][column].value() == Approx(land.height[(24 - row) % 24][24 - column].value()));
      REQUIRE((own == 0 || own == 1));
      if (own == mirrored) ++middle;  // on the ridge either will do
    }
  }
  CHECK(middle <= 2 * 24);
  CHECK(land.basin[3][4] == 0);
  CHECK(land.basin[3][20] == 1);
}

TEST_CASE("Basins are where going downhill ends") {
  // A vee, and a shallow corner behind its lower flank: their basins meet along oblique lines.
  const auto scene = square_in({{{-80, -10}, {60, -10}, {60, 30}, {45, 30}, {45, 12}, {16, 16}, {0, 0}, {-80, 80}}});
  const std::vector<nest::NestRest> rests{rest_at(0, kSide_mm / std::sqrt(2), kPi / 4),
                                          rest_at(34.023757, 23.608641, 82.146687 * kPi / 180)};
  const Landscape land = landscape_of(*scene, rests, {24, 25, 4});
  int wrong = 0, first = 0, all = 0;
  for (int row = 0; row < 6; ++row) {  // a quarter turn: then all is the same again
    for (int column = 1; column < 24; ++column) {
      const double u = land.from_mm + column * (land.to_mm - land.from_mm) / 24;
      const Point end = downhill(*scene, {u, row * 2 * kPi / 24});
      ++all;
      first += end.x() < 20;
      wrong += land.basin[row][column] != (end.x() < 20 ? 0 : 1);
      CHECK(land.basin[row + 6][column] == land.basin[row][column]);
    }
  }
  CHECK(first > all / 4);
  CHECK(first < 3 * all / 4);
  CHECK(wrong <= 4);  // beside the boundary: the grid's step is not the surface's
}

TEST_CASE("A level floor is its rest's from end to end") {
  const auto scene = square_in({{{-60, -10}, {60, -10}, {60, 0}, {-60, 0}}});
  nest::NestRest rest = rest_at(0, kSide_mm / 2, 0);
  rest.set = {{-60, kSide_mm / 2, 0}, {60, kSide_mm / 2, 0}};
  const Landscape land = landscape_of(*scene, {rest}, kCoarse);
  for (const std::vector<int>& row : land.basin) {
    for (const int basin : row) CHECK(basin == 0);
  }
}

TEST_CASE("Where nothing is below a part there is no height and no basin") {
  const auto scene =
      square_in({{{-60, -10}, {-30, -10}, {-30, 0}, {-60, 0}}, {{30, -10}, {60, -10}, {60, 0}, {30, 0}}});
  const Landscape land = landscape_of(*scene, {}, kCoarse);
  CHECK(land.from_mm == Approx(-60));
  CHECK(land.to_mm == Approx(60));
  for (int row = 0; row < 24; ++row) {
    CHECK_FALSE(land.height[row][12]);
    CHECK(land.height[row][0]);
    for (const int basin : land.basin[row]) CHECK(basin == kNoRest);
  }
}

TEST_CASE("A rest under an overhang is said to be hidden and has no basin") {
  // A shelf of 30 mm, open to the right, with a lid over it.
  const auto scene =
      square_in({{{-50, -10}, {50, -10}, {50, 5}, {45, 0}, {-40, 0}, {-40, 30}, {45, 30}, {45, 40}, {-50, 40}}});
  const Landscape land =
      landscape_of(*scene, {rest_at(-30, kSide_mm / 2, 0), rest_at(-20, 40 + kSide_mm / 2, 0)}, kCoarse);
  CHECK(land.hidden == std::vector<int>{0});
  bool has_upper = false;
  for (const std::vector<int>& row : land.basin) {
    for (const int basin : row) {
      CHECK(basin != 0);
      has_upper = has_upper || basin == 1;
    }
  }
  CHECK(has_upper);
}

TEST_CASE("Groups of rests have the name of their lowest and outside stays outside") {
  std::vector<nest::NestRest> rests{rest_at(0, 0, 0), rest_at(0, 2, 0), rest_at(0, 1, 0)};
  MergeTree tree;
  tree.passes = {{1, 2, 3, 3.1, std::nullopt}, {0, 4, 5, std::nullopt, std::nullopt}, {3, 5, 7, 7.2, std::nullopt}};
  const std::vector<NamedPass> passes = named(tree, rests);
  REQUIRE(passes.size() == 3);
  CHECK((passes[0].first == 1 && passes[0].second == 2));
  CHECK((passes[1].first == 0 && passes[1].second == 2));
  CHECK((passes[2].first == 0 && passes[2].second == kNoRest));
  CHECK(passes[1].lower_mm == 5);
  CHECK_FALSE(passes[1].upper_mm);
}

TEST_CASE("The page's landscape names rests of its own aspect and counts heights from the seat") {
  const Loop el{{0, 0}, {16, 0}, {16, 5}, {6, 5}, {6, 12}, {0, 12}};
  Loop flipped;
  for (auto p = el.rbegin(); p != el.rend(); ++p) flipped.emplace_back(-p->x(), p->y());
  nest::NestSpec spec =
      spec_of(el, {{{-40, -20}, {40, -20}, {40, 0}, {9, 0}, {9, -6}, {-9, -6}, {-9, 0}, {-40, 0}}}, {0, -2, 0});
  spec.purpose = nest::Purpose::Pallet;
  spec.part.aspects[0].probability = 0.5;
  spec.part.aspects.push_back(spec.part.aspects[0]);
  spec.part.aspects[1].name = "down";
  spec.part.aspects[1].outline_mm = affine(flipped);
  const nest::NestProblem problem(spec);
  const std::vector<double> values;
  const nest::NestEvaluation evaluation = problem.evaluate(0, values);
  const nlohmann::ordered_json json = nest_json(problem, 0, values, evaluation, true);
  REQUIRE(json["landscape"].size() == 2);
  REQUIRE(json["aspects"].size() == 2);
  const auto& rests = json["rests"];
  const auto is_own = [&](int rest, const nlohmann::ordered_json& aspect) {
    return rest == -1 || rests.at(static_cast<std::size_t>(rest))["aspect"] == aspect;
  };
  std::set<int> with_basin;
  double seat_height = 1e9;
  for (const auto& land : json["landscape"]) {
    REQUIRE(land["heights_mm"].size() == 72);
    REQUIRE(land["basin"].size() == 72);
    for (const auto& row : land["basin"]) {
      for (const int basin : row) {
        REQUIRE(is_own(basin, land["aspect"]));
        with_basin.insert(basin);
      }
    }
    for (const auto& row : land["heights_mm"]) {
      for (const double height : row) {
        REQUIRE(std::abs(100 * height - std::round(100 * height)) < 1e-6);
        seat_height = std::min(seat_height, height);
      }
    }
  }
  double lowest = 1e9;
  for (const auto& rest : rests) lowest = std::min(lowest, rest["height_mm"].get<double>());
  CHECK(seat_height > lowest - 0.01);
  CHECK(seat_height < lowest + 1);
  CHECK(with_basin.size() > 2);
  REQUIRE(json["passes"].size() >= 2);
  for (const auto& pass : json["passes"]) {
    CHECK(is_own(pass["first"], pass["aspect"]));
    CHECK(is_own(pass["second"], pass["aspect"]));
    if (!pass["upper_mm"].is_null()) CHECK(pass["lower_mm"].get<double>() <= pass["upper_mm"].get<double>());
  }
  const nlohmann::ordered_json without = nest_json(problem, 0, values, evaluation, false);
  CHECK(without["landscape"].is_null());
  CHECK(without["rests"] == json["rests"]);
}
