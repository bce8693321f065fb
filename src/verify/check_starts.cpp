#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "applications/feeder/turning_track.hpp"
#include "verify/checks.hpp"
#include "verify/settling.hpp"

namespace formotion {
namespace {

using namespace feeder;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kRing = 1440;                                    // starts: every 0.25 degrees
constexpr double kBeside_rad = 2e-6 * std::numbers::pi / 180;  // of a boundary; maps locate them to half of this
constexpr double kBasinEdge_rad = 1e-9;
constexpr double kSamePose_rad = 1e-9;

double wrapped(double rad) {
  const double turned = std::fmod(rad, kTurn);
  return turned < 0 ? turned + kTurn : turned;
}

std::string degrees(double rad) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(6) << rad * 360 / kTurn << " deg";
  return out.str();
}

// The stable pose in whose basin an orientation lies; -1 within kBasinEdge_rad of a basin's end.
int basin_of(const PartModel& part, int aspect, double theta) {
  const int order = part.symmetry[static_cast<std::size_t>(aspect)];
  const double period = kTurn / order;
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    const StablePose& stable = part.poses[i].stable;
    if (stable.aspect != aspect) continue;
    const double into = std::fmod(wrapped(theta - stable.basin_from_rad), period), width = stable.basin_rad / order;
    if (width >= period - kBasinEdge_rad) return static_cast<int>(i);
    if (into > kBasinEdge_rad && into < width - kBasinEdge_rad) return static_cast<int>(i);
  }
  return -1;
}

const MapInterval* interval_of(const FeederEvaluation& evaluation, const std::string& aspect, double theta) {
  for (const MapInterval& interval : evaluation.outcome_map) {
    if (interval.aspect == aspect && wrapped(theta - interval.from_rad) <= interval.width_rad()) return &interval;
  }
  return nullptr;
}

// Parts settle on the wall before they meet the track: every orientation is followed into its pose.
void check_settling(const TestedDesign& design, Check& check) {
  const PartModel& part = design.part;
  for (int aspect = 0; aspect < static_cast<int>(part.shapes.size()); ++aspect) {
    const AspectShape& shape = part.shapes[static_cast<std::size_t>(aspect)];
    Loop corners;
    for (const Polygon& body : shape.bodies) corners.insert(corners.end(), body.outer.begin(), body.outer.end());
    const Loop hull = convex_hull(corners);
    const double period = kTurn / part.symmetry[static_cast<std::size_t>(aspect)];
    for (int k = 0; k < kRing; ++k) {
      const double theta = kTurn * k / kRing;
      const int basin = basin_of(part, aspect, theta);
      const std::optional<double> rest = settled(hull, design.environment().settling_friction, theta);
      ++check.count;
      if (basin < 0 || !rest) {
        ++check.skipped;
        continue;
      }
      const PoseModel& pose = part.poses[static_cast<std::size_t>(basin)];
      if (std::abs(std::remainder(*rest - pose.stable.orientation_rad, period)) > kSamePose_rad) {
        // Chords of arcs hold nothing: their poses were given up for the one that the arc leads to.
        bool known = false;
        for (const PoseModel& other : part.poses) {
          known = known || (other.stable.aspect == aspect &&
                            std::abs(std::remainder(*rest - other.stable.orientation_rad, period)) <= kSamePose_rad);
        }
        if (known)
          check.fail(shape.name + " " + degrees(theta) + " settles at " + degrees(*rest) + ", not in pose " +
                     degrees(pose.stable.orientation_rad) + " in whose basin it is said to be");
        ++check.skipped;
        continue;
      }
      if (!design.turns) continue;
      const MapInterval* interval = interval_of(design.evaluation, shape.name, theta);
      const Outcome outcome = design.arrivals[static_cast<std::size_t>(basin)].result.outcome;
      if (!interval || interval->outcome != outcome)
        check.fail(shape.name + " " + degrees(theta) + " is " + name(outcome) + ", other than the outcome map says");
    }
  }
  if (check.skipped > 0) check.note = "skipped ones begin on a basin's end or rest on the chord of an arc";
}

// On a belt every start is projected: a ring of them, and both sides of every boundary.
void check_belt(const TestedDesign& design, Check& check) {
  const std::vector<MapInterval>& map = design.evaluation.outcome_map;
  std::optional<TurningTrack> track = TurningTrack::of(design.part, design.layout, design.environment());
  const auto as_said = [&](int aspect, double theta, std::size_t interval) {
    const PoseTravel& claimed = design.arrivals[interval];
    const StartTravel travel = track->travel_quickly(aspect, track->belt_start(wrapped(theta)));
    ++check.count;
    const double period = kTurn / design.part.symmetry[static_cast<std::size_t>(aspect)];
    const bool same_exit =
        claimed.exit_class < 0 ||
        (travel.exit_rad &&
         std::abs(std::remainder(*travel.exit_rad - *claimed.result.exit_orientation_rad, period)) <= kSameExit_rad);
    if (travel.outcome != claimed.result.outcome || !same_exit) {
      std::string how = name(travel.outcome);
      if (travel.exit_rad) how += " at " + degrees(*travel.exit_rad);
      check.fail("start " + map[interval].aspect + " " + degrees(wrapped(theta)) + " is " + how +
                 ", the outcome map says " + name(claimed.result.outcome) +
                 (claimed.result.exit_orientation_rad ? " at " + degrees(*claimed.result.exit_orientation_rad)
                                                      : std::string()));
    }
  };
  for (int aspect = 0; aspect < static_cast<int>(design.part.shapes.size()); ++aspect) {
    const std::string& name_of_aspect = design.part.shapes[static_cast<std::size_t>(aspect)].name;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const MapInterval& interval = map[i];
      if (interval.aspect != name_of_aspect || interval.thin) continue;
      const double width = interval.width_rad();
      if (width > 2 * kBeside_rad) {
        as_said(aspect, interval.from_rad + kBeside_rad, i);
        as_said(aspect, interval.from_rad + width - kBeside_rad, i);
      }
      for (int k = 0; k < kRing; ++k) {
        const double theta = kTurn * k / kRing, into = wrapped(theta - interval.from_rad);
        if (into > kBeside_rad && into < width - kBeside_rad) as_said(aspect, theta, i);
      }
    }
  }
}

}  // namespace

Check check_starts(const TestedDesign& design) {
  Check check{"starts"};
  check.unit = "orientations";
  design.belt ? check_belt(design, check) : check_settling(design, check);
  return check;
}

}  // namespace formotion
