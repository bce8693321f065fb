#include <catch2/catch.hpp>

#include "analysis/geometry/boolean.hpp"
#include "witness/feeder_specs.hpp"

using namespace formotion;
using namespace formotion::witness;
using feeder::Outcome;

TEST_CASE("a wiper rejects what is taller, a hold-down rail stops it") {
  for (const bool rail : {false, true}) {
    const auto evaluation = evaluated(feeder_spec(block(), {rail ? hold_down(10, 50) : wiper(10)}, 40));
    for (const auto& pose : evaluation.poses) {
      const bool flat = pose.aspect == "flat";
      CHECK(pose.outcome == (flat ? Outcome::Delivered : rail ? Outcome::Jammed : Outcome::Rejected));
      if (!flat) CHECK(*pose.margin_mm == Approx(8));
    }
    CHECK(*evaluation.metrics.tolerance_mm == Approx(4).margin(1e-6));  // the flat block's room under the blade
  }
}

TEST_CASE("a blade as high as the part lets it pass, marginally") {
  const auto evaluation = evaluated(feeder_spec(block(), {wiper(6)}, 40));
  CHECK(evaluation.poses[0].outcome == Outcome::Delivered);
  CHECK(evaluation.poses[0].marginal);
  CHECK(*evaluation.metrics.tolerance_mm == 0);
}

TEST_CASE("a rail holds a pose over a gap while the whole of it is under the rail") {
  // The flat block, 30 long on the wall: the gap of 20 loses it, a rail over gap and part lengths keeps it.
  const auto outcome = [](feeder::DesignSpec design) {
    return evaluated(feeder_spec(block(), design, 40)).poses[0].outcome;
  };
  CHECK(outcome({gap(20)}) == Outcome::Rejected);
  CHECK(outcome({at(hold_down(10, 80), -30), at(gap(20), 0)}) == Outcome::Delivered);
  CHECK(outcome({at(hold_down(10, 40), -30), at(gap(20), 0)}) == Outcome::Rejected);
}

TEST_CASE("a pose that two rails hand over above a gap longer than it is lost") {
  const auto evaluation =
      evaluated(feeder_spec(block(), {at(hold_down(10, 100), -50), at(gap(120), 0), at(hold_down(10, 150), 50)}, 40));
  CHECK(evaluation.poses[0].outcome == Outcome::Rejected);
  CHECK(*evaluation.metrics.tolerance_mm == 0);
}

TEST_CASE("a rail twice as high as the part, or more, holds nothing down") {
  const auto outcome = [](double height) {
    return evaluated(feeder_spec(block(), {at(hold_down(height, 80), -30), at(gap(20), 0)}, 40)).poses[0].outcome;
  };
  CHECK(outcome(11.9) == Outcome::Delivered);
  CHECK(outcome(12) == Outcome::Rejected);
}
