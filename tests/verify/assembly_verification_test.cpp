#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "io/problem_file.hpp"
#include "verify/checks.hpp"
#include "verify/verification.hpp"

using namespace formotion;

namespace {

// A peg of 10 mm over a hole with chamfers; where a wrong way is asked for, its mirrored key stands over solid metal.
std::string problem_text(const std::string& goal, const std::string& more = "") {
  return R"({"formotion": 1, "name": "peg", "kind": "assembly",
    "part": {"outline_mm": [[-5, 6], [2, 6], [2, 2], [4, 2], [4, 6], [5, 6], [5, 26], [-5, 26]], "flips": true},
    "environment": {
      "friction": 0.1,
      "compliance": {"kx_n_per_mm": 5, "ky_n_per_mm": 50, "ktheta_nmm_per_rad": 50000, "center_mm": [0, 6]},
      "approach": {"direction_deg": -90, "distance_mm": 18, "max_force_n": 40}},
    "design": {"fixed_mm": [[[-20, -24], [20, -24], [20, 0], [7.2, 0], [5.2, -2], [5.2, -16], [4.4, -16], [4.4, -21],
                             [1.6, -21], [1.6, -16], [-5.2, -16], [-5.2, -2], [-7.2, 0], [-20, 0]]]},
    "goal": {"depth_mm": 20, "lateral_mm": 0.3, "tilt_deg": 1, )" +
         goal + "}" + more + "}";
}
const char* const kStarts = R"("starts": {"x_mm": [-1, 1]}, "never": [{"aspect": "down", "orientation_deg": 0}])";

struct Case {
  assembly::AssemblyProblem problem;
  Evaluated stored = {};
  explicit Case(const std::string& text) : problem(*parse_problem(text, "peg.json").assembly) {
    stored.number = 3;
    stored.score = problem.score(stored.candidate);
  }
};

std::string reaching(std::string text) {
  const std::string from = "\"distance_mm\": 18";
  return text.replace(text.find(from), from.size(), "\"distance_mm\": 24");
}

std::unique_ptr<Case> sound_case() {
  auto found = std::make_unique<Case>(reaching(problem_text(kStarts)));
  REQUIRE(found->stored.score.feasible);
  return found;
}

const Check& named(const Verification& verification, const std::string& name) {
  return *std::find_if(verification.checks.begin(), verification.checks.end(),
                       [&](const Check& check) { return check.name == name; });
}

}  // namespace

TEST_CASE("an assembly as it was scored holds in all its checks") {
  const auto sound = sound_case();
  const Verification verification = verify_design(sound->problem, sound->stored, true, {2, 1});
  for (const Check& check : verification.checks) {
    CAPTURE(check.name, check.failure, says(check));
    CHECK(check.holds);
    CHECK(check.count > 0);
  }
  CHECK(verification.holds);
  CHECK(verification.checks.size() == 5);
  // The wrong way is proved, and said to be.
  CHECK(named(verification, "finer").note.find("down at 0 deg is proved") != std::string::npos);
  const Verification again = verify_design(sound->problem, sound->stored, true, {2, 1});
  for (std::size_t i = 0; i < again.checks.size(); ++i) CHECK(says(again.checks[i]) == says(verification.checks[i]));
}

TEST_CASE("one wrong bit of an assembly's score is noticed") {
  const auto wrong = sound_case();
  wrong->stored.score.objectives[0] = std::nextafter(wrong->stored.score.objectives[0], 2);
  CHECK_FALSE(check_repeatable(wrong->problem, wrong->stored, true).holds);
  CHECK(check_repeatable(wrong->problem, wrong->stored, false).holds);
}

TEST_CASE("claims about an assembly's starts that are not so fail by the start that shows it") {
  const auto sound = sound_case();
  TestedJoint joint = tested_joint(sound->problem, sound->stored);
  REQUIRE(check_starts(joint, {}).holds);

  TestedJoint capture = joint;  // said to be all jammed
  for (OutcomeRegion& region : capture.evaluation.regions) {
    for (RegionRow& row : region.rows) {
      for (RegionInterval& interval : row.intervals) interval.outcome = static_cast<int>(InsertionOutcome::Jammed);
    }
  }
  const Check jammed = check_starts(capture, {});
  CHECK_FALSE(jammed.holds);
  CHECK(jammed.failure.find("is assembled in place of jammed") != std::string::npos);

  TestedJoint bound = joint;  // a proof of less than what it reaches
  REQUIRE(bound.evaluation.never.size() == 1);
  REQUIRE(bound.evaluation.never[0].proved);
  bound.evaluation.never[0].bound_mm = bound.evaluation.never[0].deepest.insertion.deepest_mm - 1;
  const Check deep = check_starts(bound, {});
  CHECK_FALSE(deep.holds);
  CHECK(deep.failure.find("held down at 0 deg") != std::string::npos);
}

TEST_CASE("a capture box wider than the starts that assemble fails") {
  // Starts up to 2.6 mm beside: beyond 2.2 mm the peg stands on the top.
  Case wide(R"({"formotion": 1, "name": "peg", "kind": "assembly",
    "part": {"outline_mm": [[-5, 6], [5, 6], [5, 26], [-5, 26]]},
    "environment": {
      "friction": 0.1, "compliance": {"kx_n_per_mm": 5, "ky_n_per_mm": 50, "ktheta_nmm_per_rad": 50000, "center_mm": [0, 6]},
      "approach": {"direction_deg": -90, "distance_mm": 18}},
    "design": {"fixed_mm": [[[-20, -20], [-5.2, -20], [-5.2, -2], [-7.2, 0], [-20, 0]],
                            [[5.2, -20], [20, -20], [20, 0], [7.2, 0], [5.2, -2]]]},
    "goal": {"depth_mm": 14, "lateral_mm": 0.3, "tilt_deg": 1, "starts": {"x_mm": [-2.6, 2.6]}}})");
  TestedJoint joint = tested_joint(wide.problem, wide.stored);
  REQUIRE(joint.evaluation.metrics.capture_mm);
  const Check honest = check_starts(joint, {});
  CAPTURE(honest.failure);
  CHECK(honest.holds);
  *joint.evaluation.metrics.capture_mm += 0.2;
  const Check wrong = check_starts(joint, {});
  CHECK_FALSE(wrong.holds);
  CHECK(wrong.failure.find("in the capture box") != std::string::npos);
}

TEST_CASE("corners off by more than the clearance keep a peg out and the member that shows it is a design") {
  // 0.2 mm of play a side: within 0.02 mm all members assemble, within 1.5 mm some do not.
  const auto sound = sound_case();
  const Check by_default = check_perturbed(tested_joint(sound->problem, sound->stored), {4, 1});
  CHECK(by_default.holds);
  CHECK(by_default.count == 4);
  CHECK(by_default.note.find("does not say") != std::string::npos);
  CHECK_FALSE(by_default.design);

  const Case rough(reaching(problem_text(kStarts, R"(, "uncertainty": {"feature_mm": 1, "outline_mm": 0.5})")));
  TestedJoint joint = tested_joint(rough.problem, rough.stored);
  joint.evaluation.feasible = true;  // as drawn it is
  const Check found = check_perturbed(joint, {3, 1});
  CHECK_FALSE(found.holds);
  REQUIRE(found.design);
  REQUIRE(found.design->contains("fixed_mm"));
  const auto& corners = (*found.design)["fixed_mm"][0];
  const Loop drawn = rough.problem.joint(0, {}).fixed_mm[0];
  REQUIRE(corners.size() == drawn.size());
  double most = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    most = std::max(most, (Point(corners[i][0].get<double>(), corners[i][1].get<double>()) - drawn[i]).norm());
  CHECK(most <= 1.5 * (1 + 1e-12));
  CHECK(most > 0.5);
}

TEST_CASE("a wrong way that free space leaves open is said not to be proved") {
  // Held as drawn there is a way in: only that its carrier stops short keeps it out.
  Case open(problem_text(R"("starts": {"x_mm": [-1, 1]}, "never": [{"aspect": "up", "orientation_deg": 0}])"));
  const TestedJoint joint = tested_joint(open.problem, open.stored);
  REQUIRE(joint.evaluation.never.size() == 1);
  REQUIRE(joint.evaluation.never[0].holds);
  const Check check = check_finer(joint);
  CAPTURE(check.note);
  CHECK(check.note.find("NOT proved") != std::string::npos);
  CHECK(check.holds);
}

TEST_CASE("a joint's drawing reads back to the same shapes and scores with clockwise shapes and holes in the part") {
  const Case holed(R"({"formotion": 1, "name": "peg", "kind": "assembly",
    "part": {"outline_mm": [[-5, 6], [-5, 26], [5, 26], [5, 6], [0, 6]], "holes_mm": [[[-1, 15], [1, 15], [0, 17]]]},
    "environment": {
      "friction": 0.1, "compliance": {"kx_n_per_mm": 5, "ky_n_per_mm": 50, "ktheta_nmm_per_rad": 50000},
      "approach": {"direction_deg": -90, "distance_mm": 18}},
    "design": {"fixed_mm": [[[-20, 0], [-7.2, 0], [-5.2, -2], [-5.2, -20], [-20, -20]],
                            [[5.2, -20], [20, -20], [20, 0], [7.2, 0], [5.2, -2]], [[-20, -20], [20, -20], [0, -30]]]},
    "goal": {"depth_mm": 14, "lateral_mm": 0.3, "tilt_deg": 1, "starts": {"x_mm": [-1, 1]}}})");
  const Check check = check_drawn(tested_joint(holed.problem, holed.stored));
  CAPTURE(check.failure, check.note);
  CHECK(check.holds);
  CHECK(check.count == 3);  // the fixed shapes are one piece, the part an outline and a hole
  REQUIRE(check.worst);
  CHECK(*check.worst < 1e-6);
}
