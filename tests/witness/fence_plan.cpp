#include "witness/fence_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <set>

namespace formotion::witness {
namespace {

constexpr double kPi = std::numbers::pi;

// A fence seen with its face as the wall y = 0 below the part: the part slides along +x on a right fence, along -x on a
// left one, and the world is turned by this.
double seen_turn(const Fence& fence) {
  return fence.side == FenceSide::Right ? -fence.angle_rad : kPi + fence.angle_rad;
}

double lean_friction(FenceSide side, double friction) { return side == FenceSide::Right ? friction : -friction; }

// After the tip the face runs along the belt: the orientation that rested on the fence, turned back by this.
double tip_turn(FenceSide side) { return side == FenceSide::Right ? 0 : -kPi; }

struct State {
  FenceSide side;
  std::vector<double> orientations;  // as they leave the last fence, each once up to symmetry, ascending
  auto key() const {
    std::vector<long> rounded;
    for (const double angle : orientations) rounded.push_back(std::lround(angle * 1e9));
    return std::pair(side, rounded);
  }
};

std::vector<double> distinct(std::vector<double> angles, double period) {
  for (double& angle : angles) {
    angle = std::fmod(angle, period);
    if (angle < 0) angle += period;
    if (period - angle < 1e-9) angle = 0;
  }
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end(), [](double a, double b) { return b - a < 1e-9; }),
               angles.end());
  return angles;
}

// Angles of the next fence, one in the middle of each range over which no orientation changes its basin.
std::vector<double> useful_angles(const State& state, FenceSide next, const PushFunction& push,
                                  const FencePlanOptions& options) {
  std::vector<double> cuts{options.least_angle_rad, options.greatest_angle_rad};
  for (const double orientation : state.orientations) {
    for (const double bound : push.bounds_rad) {
      // orientation + seen_turn = bound
      double angle = next == FenceSide::Right ? orientation - bound : bound - orientation - kPi;
      angle = std::fmod(angle, 2 * kPi);
      if (angle < 0) angle += 2 * kPi;
      if (angle > options.least_angle_rad && angle < options.greatest_angle_rad) cuts.push_back(angle);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  std::vector<double> angles;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] > 2 * options.margin_rad) angles.push_back(0.5 * (cuts[i] + cuts[i + 1]));
  }
  return angles;
}

}  // namespace

double after_fence(const Loop& corners, double friction, const Fence& fence, double start_rad) {
  const PushFunction push = push_function(corners, lean_friction(fence.side, friction));
  return push.rest(start_rad + seen_turn(fence)) + tip_turn(fence.side);
}

std::optional<FencePlan> fence_plan(const Loop& corners, double friction, int symmetry,
                                    const FencePlanOptions& options) {
  const double period = 2 * kPi / symmetry;
  const PushFunction pushes[2] = {push_function(corners, friction), push_function(corners, -friction)};
  struct Node {
    State state;
    std::vector<Fence> fences;
  };
  std::queue<Node> open;
  std::set<std::pair<FenceSide, std::vector<long>>> seen;
  const auto visit = [&](State state, std::vector<Fence> fences) {
    if (seen.insert(state.key()).second) open.push({std::move(state), std::move(fences)});
  };
  for (const FenceSide side : {FenceSide::Right, FenceSide::Left}) {
    std::vector<double> all = pushes[side == FenceSide::Left].rests_rad;
    for (double& angle : all) angle += tip_turn(side);
    visit({side, distinct(std::move(all), period)}, {{side, 0.7}});
  }
  while (!open.empty()) {
    const Node node = std::move(open.front());
    open.pop();
    if (node.state.orientations.size() == 1) return FencePlan{node.fences, node.state.orientations.front()};
    for (const FenceSide side : {FenceSide::Right, FenceSide::Left}) {
      const PushFunction& push = pushes[side == FenceSide::Left];
      for (const double angle : useful_angles(node.state, side, push, options)) {
        const Fence fence{side, angle};
        std::vector<double> next;
        for (const double orientation : node.state.orientations) {
          next.push_back(push.rest(orientation + seen_turn(fence)) + tip_turn(side));
        }
        std::vector<Fence> fences = node.fences;
        fences.push_back(fence);
        visit({side, distinct(std::move(next), period)}, std::move(fences));
      }
    }
  }
  return std::nullopt;
}

Belt belt(const std::vector<Fence>& fences, double reach_mm, double settle_mm) {
  Belt made;
  // Where the part may be across the belt as it arrives: above (right fence) or below (left) the last tip.
  double low = -reach_mm, high = reach_mm, x = 2 * reach_mm;
  for (const Fence& fence : fences) {
    const bool right = fence.side == FenceSide::Right;
    const double across = right ? 1 : -1;
    Point at(x, right ? low - reach_mm : high + reach_mm);
    Loop face{at};
    const auto go = [&](double angle, double length) {
      at += length * Point(std::cos(angle), across * std::sin(angle));
      face.push_back(at);
    };
    // Long enough that the highest part has met the face and settled on it.
    go(fence.angle_rad, (high - low + 2 * reach_mm) / std::sin(fence.angle_rad) + settle_mm);
    double angle = fence.angle_rad;
    while (angle > 0.008) {
      angle = angle > 2 * kTipFacet_rad ? angle - kTipFacet_rad : angle / 2;
      go(angle, 12 * reach_mm);
    }
    go(0, 4 * reach_mm);
    const double back = face.front().y() - across * reach_mm;
    Loop outline = face;
    outline.emplace_back(at.x(), back);
    outline.emplace_back(face.front().x(), back);
    if (right) std::reverse(outline.begin(), outline.end());
    made.fences.push_back({outline, {}});
    low = right ? at.y() : at.y() - 2 * reach_mm;
    high = right ? at.y() + 2 * reach_mm : at.y();
    x = at.x() + 4 * reach_mm;
  }
  made.end_x_mm = x;
  return made;
}

}  // namespace formotion::witness
