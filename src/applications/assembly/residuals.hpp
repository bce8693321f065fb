// By how much an assembly's forces, work and chamfers lie above what is asked of them, as residuals with derivatives.
#pragma once

#include "problem/smooth_problem.hpp"

namespace formotion::assembly {

class AssemblyProblem;

// What is smooth in the values: peak_force_n, peak_lateral_force_n and work_nmm of one start's insertion, and
// chamfer_mm. A peak or the work of a design is that of the worst of its starts: its pieces are the insertions of this
// start and of those near it (judged as a search does), one for each history, with the place of the start held. The
// aim's residual counts once, limits on other objectives and on bounds of the goal count so much more that they are
// kept.
//
// Derivatives are central differences between insertions of one history (one contact after the other in the same
// modes), else of the one side that has the history here. Where neither has it (corners almost in one line: faces come
// and go), of the sides on which the outcome is the same and values go on straight over two steps, without a jump. A
// slope down to the side on which alone the outcome is another one is 0: nothing is gained there. A start that has no
// such side has the slope 0, and decides nothing; evaluate() returns false where this is so of all, where an outcome is
// another one than at the candidate, and where shapes are not valid.
class AssemblyResiduals final : public SmoothProblem {
 public:
  explicit AssemblyResiduals(const AssemblyProblem& problem) : problem_(problem) {}
  std::unique_ptr<SmoothPieces> pieces(const Candidate& candidate, const SmoothAim& aim) const override;
  // Whether an objective of this name has residuals.
  static bool has(const std::string& objective);

 private:
  const AssemblyProblem& problem_;
};

}  // namespace formotion::assembly
