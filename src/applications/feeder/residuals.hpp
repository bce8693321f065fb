// What a feeder design lacks, as residuals with exact derivatives: of configurations and facets that the goal asks for,
// and of the poses of a passive track at a wanted tolerance.
#pragma once

#include "applications/feeder/active_pieces.hpp"
#include "applications/feeder/judge.hpp"
#include "applications/feeder/track_layout.hpp"
#include "problem/smooth_problem.hpp"

namespace formotion::feeder {

class FeederProblem;

// A target and the piece that decides it: the residual is max(0, wanted_mm - sign * piece).
struct Residual {
  int aspect = 0;
  Piece piece;
  double sign = 1;
  double wanted_mm = 0;
  double got_mm = 0;   // as the exact analysis says, with the sign
  bool lasts = false;  // what is asked for is the least of many pieces, of which this is one
};

// What the goal asks of configurations and facets, met or not, where it has derivatives.
std::vector<Residual> goal_residuals(const DesignCase& design, const Layout& layout);

// Of every pose past every group of voids that are off by tolerance_mm to the adverse side: kept[i] poses must keep
// that margin, the others must be lost by it in some group. Of a track without obstacles; what blades do is left out.
std::vector<Residual> tolerance_residuals(const DesignCase& design, const Layout& layout, const std::vector<bool>& kept,
                                          double tolerance_mm);

// values: of all the problem's variables, used: the indices of those that a candidate of the topology has.
std::unique_ptr<SmoothPieces> as_pieces(const FeederSpec& spec, int topology, std::vector<double> values,
                                        std::vector<int> used, std::vector<Residual> residuals,
                                        double part_diameter_mm);

class FeederResiduals final : public SmoothProblem {
 public:
  explicit FeederResiduals(const FeederProblem& problem) : problem_(problem) {}
  std::unique_ptr<SmoothPieces> pieces(const Candidate& candidate, const SmoothAim& aim) const override;

 private:
  const FeederProblem& problem_;
};

}  // namespace formotion::feeder
