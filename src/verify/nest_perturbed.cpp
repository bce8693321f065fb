// Nests made a little wrong: every corner somewhere else.
#include "applications/nest/judge.hpp"
#include "applications/nest/scene.hpp"
#include "io/nest_json.hpp"
#include "io/problem_reader.hpp"
#include "verify/checks.hpp"
#include "verify/perturbed_shapes.hpp"

namespace formotion {
namespace {

using namespace nest;

constexpr std::uint64_t kPurpose = 0x6e657374206f6666;  // of random numbers: perturbed nests

}  // namespace

Check check_perturbed(const TestedNest& tested, const VerifyOptions& options) {
  if (!tested.evaluation.feasible) {
    Check check{"perturbed"};
    check.note = "the design is not feasible as drawn";
    return check;
  }
  const bool is_pallet = tested.spec().purpose == Purpose::Pallet;
  const auto judged = [&](const std::vector<Loop>& shapes, double most_mm) {
    PerturbedMember member;
    DesignSpec design;
    for (const Loop& shape : shapes) design.nest_mm.push_back(literal_loop(shape));
    // This one design, without uncertainties of its own; where corners have moved so has the rest in the seat.
    NestSpec spec = tested.spec();
    spec.designs = {design};
    spec.uncertainty = {};
    spec.robust = false;
    spec.goal.seat.near_mm += 2 * most_mm;
    member.usable = defects_of(spec, 0, tested.values).empty();
    if (!member.usable) return member;
    NestEvaluation found = judge(spec, 0, tested.values, false).evaluation;
    // As evaluate will say it.
    if (!found.feasible) found = judge(spec, 0, tested.values, true).evaluation;
    member.figure = is_pallet ? found.metrics.selectivity_mm : found.metrics.seated_fraction;
    member.feasible = found.feasible;
    if (member.feasible) return member;
    member.why = found.violations.front().what;
    member.design = shapes_json(design);
    member.design["values"] = values_json(tested.problem, tested.topology, tested.values);
    return member;
  };
  return check_perturbed_shapes(tested.problem.nest_mm(tested.topology, tested.values), tested.spec().uncertainty,
                                kPurpose ^ static_cast<std::uint64_t>(tested.stored.number),
                                is_pallet ? "mm of selectivity" : "of the placements seated", options, judged);
}

}  // namespace formotion
