#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "applications/nest/drops.hpp"
#include "io/problem_file.hpp"

using namespace formotion;
using namespace formotion::nest;

namespace {

// A square block of side 10 in a pocket of depth `depth` and width `width`; the seat in the middle of its floor.
NestSpec block_in_pocket(double depth, double width, const std::string& kind, const std::string& more = "") {
  const std::string d = std::to_string(depth), half = std::to_string(width / 2);
  return *parse_problem(R"({"formotion": 1, "name": "p", "kind": ")" + kind + R"(",
    "part": {"outline_mm": [[0,0],[10,0],[10,10],[0,10]]},
    "design": {"nest_mm": [[[-40,-5],[40,-5],[40,)" +
                            d + "],[" + half + "," + d + "],[" + half + ",0],[-" + half + ",0],[-" + half + "," + d +
                            "],[-40," + d + R"(]]]},
    "goal": {"seat": {"x_mm": 0, "y_mm": 5, "orientation_deg": 90}, "starts": {"x_mm": [-1, 1], "y_mm": 20}})" +
                            more + "}",
                        "p.json")
              .nest;
}

NestEvaluation judged(const NestSpec& spec) { return NestProblem(spec).evaluate(0, {}); }

// Near the middle of a wide pocket, 6 mm deep.
NestEvaluation dropped_from_8_mm(const std::string& environment) {
  NestSpec spec = block_in_pocket(6, 30, "fixture", R"(, "environment": )" + environment);
  spec.goal.starts.x_mm = {-0.5, 0.5};
  spec.goal.starts.y_mm = {8, 8};
  return judged(spec);
}

}  // namespace

TEST_CASE("a block that fits its pocket closely must rise by the pocket's depth to get out") {
  const NestEvaluation found = judged(block_in_pocket(6, 10, "pallet"));  // no start off the middle falls in
  REQUIRE(found.metrics.goal_escape_height_mm);
  CHECK(*found.metrics.goal_escape_height_mm == Approx(6).margin(0.06));
  CHECK(*found.metrics.goal_escape_height_mm <= 6 + 1e-9);
  for (const NestRest& rest : found.rests) {
    if (!rest.is_seat) continue;
    REQUIRE(rest.escape_high_mm);
    CHECK(*rest.escape_high_mm >= 6 - 1e-9);
    CHECK(rest.at.y_mm == Approx(5).margin(1e-6));
  }
}

TEST_CASE("orientations of a square that are the same are one rest and a goal may name any of them") {
  const NestEvaluation found = judged(block_in_pocket(6, 10.5, "pallet"));
  int seats = 0;
  for (const NestRest& rest : found.rests) seats += rest.is_seat;
  CHECK(seats == 1);
  CHECK(found.metrics.capture_fraction.value_or(0) == Approx(0.25).margin(0.01));  // of x alone, +-0.25 of +-1 falls in
}

TEST_CASE("a block on a floor resists a push by friction times its weight and a lift by its weight") {
  const NestSpec spec = block_in_pocket(1, 60, "fixture", R"(, "environment": {"friction": 0.3})");
  const NestEvaluation found = judged(spec);
  CHECK(found.seat_holds == Verdict::Certain);
  CHECK(found.metrics.resisted_weights.value_or(0) > 0.25);
  CHECK(found.metrics.resisted_weights.value_or(0) <= 0.3 + 1e-9);
  CHECK(found.metrics.resisted_moment_mm.value_or(0) == Approx(5).margin(1e-6));
}

TEST_CASE("a seat in the air is no seat") {
  NestSpec spec = block_in_pocket(6, 10.5, "fixture");
  spec.goal.seat.at_mm[1].constant = 9;
  const NestEvaluation found = judged(spec);
  CHECK_FALSE(found.feasible);
  CHECK(found.seat_holds == Verdict::Impossible);
  bool said = false;
  for (const Violation& violation : found.violations) said = said || violation.where == "/goal/seat";
  CHECK(said);
}

TEST_CASE("the worst case is at no end of what is uncertain better than the nominal one") {
  const NestSpec spec = block_in_pocket(6, 10.5, "pallet", R"(, "uncertainty": {"feature_mm": 0.1, "com_mm": 0.2})");
  const NestEvaluation found = judged(spec);
  REQUIRE(found.worst_case);
  REQUIRE(found.worst_case->goal_escape_height_mm);
  CHECK(*found.worst_case->goal_escape_height_mm <= *found.metrics.goal_escape_height_mm + 1e-9);
  CHECK(found.bites);
}

TEST_CASE("with a table every rest has a share of the drops and the window says what the bounds say") {
  const NestSpec spec =
      block_in_pocket(6, 10.5, "pallet",
                      R"(, "environment": {"table": {"amplitude_mm": 0.3, "frequency_hz": 30, "restitution": 0.2}})");
  const NestEvaluation found = judged(spec);
  REQUIRE(found.window);
  double sum = 0;
  for (const NestRest& rest : found.rests) sum += rest.drop_share;
  CHECK(sum > 0.3);
  CHECK(sum <= 1 + 1e-9);
  CHECK(found.window->keeps_up_to_mm > 0.3);
}

TEST_CASE("expected drops are one over the right share unless a wrong rest keeps its part") {
  const Filling free = filling({{0.2, true, false}, {0.5, false, true}, {0.3, false, true}});
  REQUIRE(free.drops_per_part);
  CHECK(*free.drops_per_part == Approx(5));
  CHECK(free.right_share == 1);
  const Filling trapped = filling({{0.2, true, false}, {0.6, false, false}});
  CHECK_FALSE(trapped.drops_per_part);
  CHECK(trapped.right_share == Approx(0.25));
}

TEST_CASE("a start over the pass is sure where the first impact takes enough of its fall") {
  CHECK(dropped_from_8_mm(R"({"friction": 0.2})").sure_fraction == 0.0);
  // It keeps 1 - 0.96 / (1 + 1.5 + 0.2 * 1.5) of 8 mm, less than the 6 mm of the rim.
  CHECK(dropped_from_8_mm(R"({"friction": 0.2, "restitution": 0.2})").sure_fraction == 1.0);
  CHECK(dropped_from_8_mm(R"({"friction": 0.2, "restitution": [0.1, 0.9]})").sure_fraction == 0.0);
}

TEST_CASE("a start is certain if every direction and friction of the problem ends in the seat") {
  CHECK(dropped_from_8_mm(R"({"friction": 0.2})").certain_fraction == 1.0);
  CHECK(dropped_from_8_mm(R"({"friction": [0.1, 0.3], "gravity_deg": [-92, -88]})").certain_fraction == 1.0);
  // It slides where that is steep.
  CHECK(dropped_from_8_mm(R"({"friction": 0.2, "gravity_deg": [-105, -75]})").certain_fraction == 0.0);
}
