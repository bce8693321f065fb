#include <algorithm>
#include <cmath>
#include <sstream>

#include "applications/feeder/turning_track.hpp"
#include "verify/checks.hpp"
#include "verify/exact_support.hpp"
#include "verify/travel_places.hpp"

namespace formotion {
namespace {

using namespace feeder;

constexpr double kBeside_mm = 2e-6;  // what is lost at one place alone is the rounding of a touch
constexpr double kFirstLoss_mm = 1e-5;

std::vector<Loop> voids_of(const Layout& layout) {
  std::vector<Loop> voids;
  for (const LaidFeature& feature : layout.features)
    voids.insert(voids.end(), feature.voids.begin(), feature.voids.end());
  return voids;
}

std::string at_x(double x_mm) {
  std::ostringstream out;
  out.precision(9);
  out << "x = " << x_mm << " mm";
  return out.str();
}

// Every pose's travel on a track that turns nothing.
void check_travels(const TestedDesign& design, const ExactTrack& track, const std::vector<Loop>& voids, Check& check) {
  for (std::size_t i = 0; i < design.part.poses.size(); ++i) {
    const PoseModel& pose = design.part.poses[i];
    const PoseResult& claimed = design.arrivals[i].result;
    const std::vector<Interval> held = held_intervals(pose, design.layout);
    const Point supported(0, pose.travelling.supported_y_mm);
    const bool decided = claimed.outcome != Outcome::Delivered && claimed.decided_by;
    const bool by_blade =
        decided && design.layout.features[static_cast<std::size_t>(claimed.decided_by->feature)].blade_mm.has_value();
    // The travel is claimed to be supported up to here.
    const bool never = claimed.outcome != Outcome::Delivered && !claimed.decided_by;
    const double good_until = never ? -1e300 : decided ? claimed.decided_by->x_mm - kFirstLoss_mm : 1e300;
    bool lost = false;
    std::vector<double> places = travel_places(pose.footprint, voids, design.environment().track_width_mm);
    for (double after = 1e-4; decided && after < 1; after *= 4) places.push_back(claimed.decided_by->x_mm + after);
    for (const double x : places) {
      if (std::any_of(held.begin(), held.end(), [&](const Interval& h) { return h.from <= x && x <= h.to; })) continue;
      if (by_blade && x > good_until) continue;
      ++check.count;
      const ExactSupport answer = track.support(pose.footprint, supported, x);
      if (answer == ExactSupport::Marginal) ++check.skipped;
      if (answer != ExactSupport::Lost) continue;
      const bool truly = track.support(pose.footprint, supported, x - kBeside_mm) == ExactSupport::Lost ||
                         track.support(pose.footprint, supported, x + kBeside_mm) == ExactSupport::Lost;
      if (!truly) continue;
      lost = true;
      if (x < good_until)
        check.fail(design.pose_name(design.arrivals[i]) + " is " + name(claimed.outcome) +
                   (decided ? ", lost at " + at_x(claimed.decided_by->x_mm) : std::string()) +
                   ", but its supported point is outside of the hull at " + at_x(x));
    }
    if (claimed.outcome != Outcome::Delivered && !by_blade && !lost)
      check.fail(design.pose_name(design.arrivals[i]) + " is " + name(claimed.outcome) +
                 ", but its supported point is inside of the hull at all places");
  }
}

// Configurations on the paths of parts that turn, up to where they end.
void check_paths(const TestedDesign& design, const ExactTrack& track, Check& check) {
  std::optional<TurningTrack> world = TurningTrack::of(design.part, design.layout, design.environment());
  for (std::size_t i = 0; i < design.arrivals.size(); ++i) {
    const PoseTravel& arrival = design.arrivals[i];
    const AspectShape& shape = design.part.shapes[static_cast<std::size_t>(arrival.aspect)];
    const Point supported(0, -wall_shift(shape.com_height_mm, design.environment()));
    const auto at = [&](const Configuration& q) {
      const Polygon turned = placed(shape.footprint, q.theta_rad, {0, q.y_mm});
      return track.support(turned, supported + Point(0, q.y_mm), q.x_mm);
    };
    TravelOptions options;
    options.seen = [&](const PathStretch& stretch, double until) {
      constexpr int kPieces = 8;
      for (int k = 0; k <= kPieces; ++k) {
        const Configuration q = stretch.at(until * k / kPieces);
        ++check.count;
        const ExactSupport answer = at(q);
        if (answer == ExactSupport::Marginal) ++check.skipped;
        const bool ends_here = until < 1 && k == kPieces;  // lost, or at a blade
        if (answer != ExactSupport::Lost || ends_here) continue;
        check.fail(design.pose_name(arrival) + " is taken to be supported at " + at_x(q.x_mm) +
                   ", but its supported point is outside of the hull there");
      }
    };
    const Configuration start =
        design.belt ? world->belt_start(arrival.result.orientation_rad) : world->pose_start(design.part.poses[i]);
    world->travel(arrival.aspect, start, options);
  }
}

}  // namespace

Check check_exact(const TestedDesign& design) {
  Check check{"exact"};
  check.unit = design.turns ? "configurations" : "positions";
  const std::vector<Loop> voids = voids_of(design.layout);
  const ExactTrack track(design.environment().track_width_mm, voids);
  design.turns ? check_paths(design, track, check) : check_travels(design, track, voids, check);
  if (check.skipped > 0) check.note = "marginal ones decide nothing";
  return check;
}

}  // namespace formotion
