// Straight motions in (across, height, turn), proved free.
#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/open_heights.hpp"
#include "analysis/motion/first_touch.hpp"

namespace formotion {
namespace {

constexpr double kTouch_mm = 9e-10;  // less than kTouching_mm
constexpr int kMostHalvings = 14;
constexpr double kLongestTurn_rad = 0.05;  // of a step that a cubic stands for

// The least on [0, 1] of a function that is a at 0, b at 1, and bends by at most `bend` (its second derivative).
double least_between(double a, double b, double bend) {
  const double k = bend / 2;
  if (!(std::abs(b - a) < k)) return std::min(a, b);
  return a - (k - (b - a)) * (k - (b - a)) / (4 * k);
}

class StraightPath final : public GuidedPath {
 public:
  StraightPath(const Configuration& from, const Configuration& to) : from_(from) {
    rate_.linear = to.position() - from.position();
    rate_.angular = to.theta_rad - from.theta_rad;
  }
  const std::vector<ContactPair>& pairs() const override { return none_; }
  Configuration at(double h) const override {
    return {from_.x_mm + h * rate_.linear.x(), from_.y_mm + h * rate_.linear.y(), from_.theta_rad + h * rate_.angular};
  }
  Twist rate(double, const Configuration&) const override { return rate_; }

 private:
  std::vector<ContactPair> none_;
  Configuration from_;
  Twist rate_;
};

}  // namespace

// Some edge's line parts the two all along: how far the other piece is beyond it is the least of functions of its
// corners, whose bends are bounded.
bool OpenHeights::pieces_apart(const ConvexPiece& part, const ConvexPiece& fixed, const Place& from, const Place& to,
                               int depth) const {
  const Point a(from.across_mm, from.height_mm), b(to.across_mm, to.height_mm);
  const double ca = std::cos(from.turn_rad), sa = std::sin(from.turn_rad);
  const double cb = std::cos(to.turn_rad), sb = std::sin(to.turn_rad);
  const double turn = std::abs(to.turn_rad - from.turn_rad), way = (b - a).norm();
  const Box swept{a.cwiseMin(b), a.cwiseMax(b)};
  if ((swept.min - fixed.box.max).cwiseMax(fixed.box.min - swept.max).maxCoeff() > part.reach_mm) return true;
  double widest_a = -1e300, widest_b = -1e300;
  const auto parts = [&](double at_a, double at_b, double bend) {
    widest_a = std::max(widest_a, at_a);
    widest_b = std::max(widest_b, at_b);
    return at_a >= -kTouch_mm && at_b >= -kTouch_mm && least_between(at_a, at_b, bend) >= -kTouch_mm;
  };
  for (std::size_t j = 0; j < fixed.normals.size(); ++j) {
    const Point& n = fixed.normals[j];
    const double beyond_a = n.dot(a) - part.support_mm(rotated(-n, ca, -sa)) - fixed.offsets_mm[j];
    const double beyond_b = n.dot(b) - part.support_mm(rotated(-n, cb, -sb)) - fixed.offsets_mm[j];
    if (parts(beyond_a, beyond_b, part.reach_mm * turn * turn)) return true;
  }
  double off = 0;  // of the obstacle's corners from the centre of mass
  for (const Point& o : fixed.corners) off = std::max({off, (o - a).norm(), (o - b).norm()});
  const double bend = off * turn * turn + 2 * turn * way;
  for (std::size_t e = 0; e < part.normals.size(); ++e) {
    const Point ma = rotated(-part.normals[e], ca, sa), mb = rotated(-part.normals[e], cb, sb);
    const double beyond_a = ma.dot(a) - fixed.support_mm(ma) - part.offsets_mm[e];
    const double beyond_b = mb.dot(b) - fixed.support_mm(mb) - part.offsets_mm[e];
    if (parts(beyond_a, beyond_b, bend)) return true;
  }
  if (widest_a < -kTouch_mm || widest_b < -kTouch_mm || depth >= kMostHalvings) return false;
  const Point m = (a + b) / 2;
  const Place middle{m.x(), m.y(), (from.turn_rad + to.turn_rad) / 2};
  return pieces_apart(part, fixed, from, middle, depth + 1) && pieces_apart(part, fixed, middle, to, depth + 1);
}

bool OpenHeights::is_straight_free(const Place& from, const Place& to) const {
  const bool apart = std::all_of(part_.begin(), part_.end(), [&](const ConvexPiece& part) {
    return std::all_of(around_.begin(), around_.end(),
                       [&](const ConvexPiece& fixed) { return pieces_apart(part, fixed, from, to, 0); });
  });
  return apart || (is_round_ && is_straight_free_exactly(from, to));
}

// Near round corners, that are larger as polygons than they are.
bool OpenHeights::is_straight_free_exactly(const Place& from, const Place& to) const {
  const MovingShape& part = space_->part;
  const Configuration a = configuration_of(from), b = configuration_of(to);
  const StraightPath path(a, b);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(b.theta_rad - a.theta_rad) / kLongestTurn_rad)));
  for (int i = 0; i < steps; ++i) {
    const Configuration start = path.at(static_cast<double>(i) / steps), end = path.at((i + 1.0) / steps);
    if (!is_free(part, space_->obstacles, start) || !is_free(part, space_->obstacles, end)) return false;
    const StraightPath piece(start, end);
    const double turn = std::abs(end.theta_rad - start.theta_rad);
    FlowStep step{start, piece.rate(0, start), end, piece.rate(1, end), 1, 0};
    // Of a cosine from its cubic; the levers are about as long as the part.
    step.chord_mm = 2 * part.reach_mm * turn * turn * turn * turn / 384;
    if (first_touch(*space_, piece, step) < 1) return false;
  }
  return true;
}

}  // namespace formotion
