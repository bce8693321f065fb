#include "applications/feeder/turning_track.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numbers>
#include <sstream>

#include "analysis/geometry/offset.hpp"

namespace formotion::feeder {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kSameExit_rad = 1e-7;  // exits of branches
constexpr double kRunUp_mm = 1;         // before the first feature
constexpr double kPullsToWall = -1e-9;  // of the drive's sine

double wrapped(double rad) {
  const double turned = std::fmod(rad, kTurn);
  return turned < 0 ? turned + kTurn : turned;
}

std::string degrees(double rad) {
  std::ostringstream out;
  const double tenths = std::fmod(std::round(rad * 3600 / kTurn), 3600);  // not 360.0
  out << std::fixed << std::setprecision(1) << tenths / 10 << " deg";
  return out.str();
}

std::string at_x(double x_mm) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(1) << "x = " << x_mm << " mm";
  return out.str();
}

}  // namespace

bool is_belt(const Environment& environment) { return std::sin(environment.drive_rad) >= kPullsToWall; }

bool has_obstacles(const Layout& layout) {
  return std::any_of(layout.features.begin(), layout.features.end(),
                     [](const LaidFeature& f) { return !f.obstacles.empty() || !f.wall_cuts.empty(); });
}

double MapInterval::width_rad() const {
  const double width = to_rad - from_rad;
  return width > 0 ? width : width + kTurn;
}

// Ends a path at a blade that is too low, or where support is lost.
struct TurningTrack::Watch {
  const TurningTrack& track;
  int aspect;
  PathSupport support;
  std::optional<int> blade;  // that ended it
  Configuration blade_at;

  Watch(const TurningTrack& t, int a) : track(t), aspect(a), support(t.part_.shapes[a], *t.floor_, t.environment_) {}

  double front(const Configuration& q) const {
    double most = -1e300;
    for (const Polygon& body : track.part_.shapes[aspect].bodies) {
      for (const Point& p : body.outer) most = std::max(most, rotated(p, q.theta_rad).x());
    }
    return most + q.x_mm;
  }

  std::optional<double> operator()(const PathStretch& stretch) {
    const std::optional<double> unsupported = support(stretch);
    const double until = unsupported.value_or(1);
    for (int i = 0; i < static_cast<int>(track.layout_.features.size()); ++i) {
      const LaidFeature& feature = track.layout_.features[i];
      if (!feature.blade_mm || track.part_.shapes[aspect].height_mm <= *feature.blade_mm) continue;
      if (front(stretch.at(until)) < feature.start_mm) continue;
      double low = 0, high = until;
      for (int k = 0; k < 50 && high - low > 1e-15; ++k) {
        const double middle = (low + high) / 2;
        (front(stretch.at(middle)) < feature.start_mm ? low : high) = middle;
      }
      blade = i;
      blade_at = stretch.at(high);
      return high;
    }
    return unsupported;
  }
};

std::optional<TurningTrack> TurningTrack::of(const PartModel& part, const Layout& layout,
                                             const Environment& environment, const TrackErrors& errors) {
  TurningTrack track(part, layout, environment);
  std::vector<VoidGroup> groups = grouped(layout, part.longest_mm);
  if (errors.voids_mm != 0) {
    for (VoidGroup& group : groups) group.loops = offset(group.loops, errors.voids_mm);
    std::erase_if(groups, [](const VoidGroup& group) { return group.loops.empty(); });
  }
  track.floor_ = std::make_shared<Floor>(Floor::of(std::move(groups), environment.track_width_mm, recesses(layout)));
  track.first_mm_ = 0;
  for (const LaidFeature& feature : layout.features) {
    track.first_mm_ = std::min(track.first_mm_, feature.start_mm);
    for (const ObstacleShape& obstacle : feature.obstacles) {
      track.first_mm_ = std::min(track.first_mm_, bounding_box(obstacle.area.outer).min.x() - obstacle.radius_mm);
    }
    if (!feature.voids.empty()) track.first_mm_ = std::min(track.first_mm_, feature.x_min);
  }
  track.first_mm_ -= std::max(0.0, errors.obstacles_mm) + std::max(0.0, errors.voids_mm);
  for (const AspectShape& shape : part.shapes) {
    std::optional<World> world = world_of(shape, layout, environment, part.diameter_mm, errors.obstacles_mm);
    if (!world) return std::nullopt;
    track.aspects_.push_back(std::make_shared<Aspect>(std::move(*world)));
  }
  return track;
}

Configuration TurningTrack::pose_start(const PoseModel& pose) const {
  return {first_mm_ - pose.x_max - kRunUp_mm, pose.stable.com_wall_mm, pose.stable.orientation_rad};
}

Configuration TurningTrack::belt_start(double theta_rad) const {
  const double y = environment_.start_y_mm.value_or(environment_.track_width_mm / 2);
  return {first_mm_ - part_.diameter_mm - kRunUp_mm, y, theta_rad};
}

StartTravel TurningTrack::travel(int aspect, const Configuration& start, const TravelOptions& options) {
  return run(aspect, start, options, false);
}
StartTravel TurningTrack::travel_quickly(int aspect, const Configuration& start) {
  return run(aspect, start, {}, true);
}

StartTravel TurningTrack::run(int index, const Configuration& start, const TravelOptions& options, bool quickly) {
  Aspect& aspect = *aspects_[index];
  Watch watch(*this, index);
  ProjectionOptions how;
  how.keep_path = options.keep_path;
  how.watch = [&](const PathStretch& stretch) {
    const std::optional<double> ends = watch(stretch);
    if (options.seen) options.seen(stretch, ends.value_or(1));
    return ends;
  };
  if (quickly) how.funnels = &aspect.funnels;
  Projection path = project(aspect.space, aspect.world.drive, start, how);
  if (quickly) {  // a known funnel may end in a loss that another start has found
    aspect.losses.insert(aspect.losses.end(), watch.support.losses().begin(), watch.support.losses().end());
  }
  StartTravel travel = ended(index, path, watch, options.tell);
  travel.path = std::move(path);
  return travel;
}

StartTravel TurningTrack::ended(int aspect, const Projection& path, const Watch& watch, bool tell) const {
  StartTravel travel;
  travel.history = path.history;
  travel.settled = path.funnelled;
  travel.margin_mm = std::max(0.0, watch.support.least_margin_mm());
  switch (path.end) {
    case ProjectionEnd::Steady:
      if (path.last_twist.linear.x() <= 0) {
        travel.reason = "is not carried along the track";
        break;
      }
      travel.outcome = Outcome::Delivered;
      travel.exit_rad = wrapped(path.last.theta_rad);
      travel.marginal = watch.support.marginal();
      if (tell) travel.reason = "leaves at " + degrees(*travel.exit_rad);
      break;
    case ProjectionEnd::AtRest: {
      travel.outcome = Outcome::Jammed;
      travel.lacking_mm = 1;
      if (const int feature = feature_touched(aspect, path.last); feature >= 0)
        travel.decided_by = Decision{feature, path.last.x_mm};
      if (tell) {
        travel.reason = "comes to rest at " + at_x(path.last.x_mm) + ", " + degrees(wrapped(path.last.theta_rad));
        if (travel.decided_by) travel.reason += ", against feature " + std::to_string(travel.decided_by->feature);
      }
      break;
    }
    case ProjectionEnd::Stopped: {
      const auto same = [&](const Configuration& q) {
        return q.x_mm == path.last.x_mm && q.y_mm == path.last.y_mm && q.theta_rad == path.last.theta_rad;
      };
      if (watch.blade && same(watch.blade_at)) {
        const LaidFeature& feature = layout_.features[*watch.blade];
        travel.outcome = feature.holds_down ? Outcome::Jammed : Outcome::Rejected;
        travel.margin_mm = part_.shapes[aspect].height_mm - *feature.blade_mm;
        travel.lacking_mm = feature.holds_down ? travel.margin_mm : 0;
        travel.decided_by = Decision{*watch.blade, path.last.x_mm};
        if (tell) travel.reason = "is too high for the blade at " + at_x(path.last.x_mm);
        break;
      }
      for (const std::vector<PathLoss>* losses : {&watch.support.losses(), &std::as_const(aspects_[aspect]->losses)}) {
        const auto found =
            std::find_if(losses->rbegin(), losses->rend(), [&](const PathLoss& loss) { return same(loss.at); });
        if (found == losses->rend()) continue;
        lost(aspect, path, *found, tell, travel);
        break;
      }
      break;
    }
    case ProjectionEnd::Ambiguous: {
      // One outcome whichever way it goes is that outcome.
      std::vector<StartTravel> ways;
      for (const Projection& branch : path.branches) ways.push_back(ended(aspect, branch, watch, tell));
      const bool one = !ways.empty() && std::all_of(ways.begin(), ways.end(), [&](const StartTravel& way) {
        const bool same_exit =
            way.exit_rad.has_value() == ways[0].exit_rad.has_value() &&
            (!way.exit_rad || std::abs(std::remainder(*way.exit_rad - *ways[0].exit_rad, kTurn)) <= kSameExit_rad);
        return way.outcome == ways[0].outcome && same_exit && way.outcome != Outcome::Undecided;
      });
      if (one) {
        const std::uint64_t history = travel.history;
        travel = ways.front();
        travel.history = history;
        break;
      }
      travel.outcome = Outcome::Ambiguous;
      if (const int feature = feature_touched(aspect, path.last); feature >= 0)
        travel.decided_by = Decision{feature, path.last.x_mm};
      if (tell) travel.reason = path.why + ", at " + at_x(path.last.x_mm) + ", with different ends";
      break;
    }
    case ProjectionEnd::Undecided:
      if (tell) travel.reason = path.why;
      break;
  }
  return travel;
}

void TurningTrack::lost(int aspect, const Projection& path, const PathLoss& loss, bool tell,
                        StartTravel& travel) const {
  const Configuration& q = path.last;
  StablePose stable;
  stable.aspect = aspect;
  stable.orientation_rad = q.theta_rad;
  stable.com_wall_mm = q.y_mm;
  const PoseModel pose = pose_model(part_.shapes[aspect], stable, environment_);
  VoidPieces pieces;
  for (const VoidGroup& group : floor_->groups) {
    VoidPieces more = void_pieces(group, environment_.track_width_mm);
    pieces.pieces.insert(pieces.pieces.end(), more.pieces.begin(), more.pieces.end());
  }
  travel.lacking_mm = fall_shortfall(pose, loss.loss, pieces, environment_.track_width_mm);
  travel.outcome = travel.lacking_mm == 0 ? Outcome::Rejected : Outcome::Jammed;
  travel.margin_mm = std::min(part_.diameter_mm, loss.depth_mm);
  if (loss.group >= 0) travel.decided_by = Decision{floor_->groups[loss.group].features.front(), q.x_mm};
  if (tell) {
    travel.reason = "loses its support at " + at_x(q.x_mm) + ", " + degrees(wrapped(q.theta_rad)) +
                    (travel.outcome == Outcome::Rejected ? ", and falls" : ", and stays there");
  }
}

int TurningTrack::feature_touched(int index, const Configuration& q) const {
  const Aspect& aspect = *aspects_[index];
  for (const TouchCluster& cluster : touches_at(aspect.space, q)) {
    for (const Touch& touch : cluster) {
      const FixedName& name = touch.pair.kind == ContactKind::CornerOnEdge
                                  ? aspect.world.obstacles.edges[touch.pair.fixed].name
                                  : aspect.world.obstacles.corners[touch.pair.fixed].name;
      if (const int feature = feature_of(layout_, name.component); feature >= 0) return feature;
    }
  }
  return -1;
}

}  // namespace formotion::feeder
