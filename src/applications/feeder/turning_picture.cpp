#include "applications/feeder/turning_picture.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>

namespace formotion::feeder {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kStraight_mm = 0.01;   // that points between others may lie beside them
constexpr double kSamePlace_mm = 1e-6;  // ends of stretches, and events: starts are settled onto their contacts
constexpr double kSamePose_rad = 1e-7;  // goals name stable poses
constexpr double kBelowFace_mm = 4;     // how much of a wall's body is shown
constexpr double kMostRun_mm = 500;     // of the last translation

double apart(const Configuration& a, const Configuration& b, double reach) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm, reach * (a.theta_rad - b.theta_rad));
}

double beside_chord(const Configuration& q, const Configuration& a, const Configuration& b, double reach) {
  const Eigen::Vector3d way(b.x_mm - a.x_mm, b.y_mm - a.y_mm, reach * (b.theta_rad - a.theta_rad));
  const Eigen::Vector3d off(q.x_mm - a.x_mm, q.y_mm - a.y_mm, reach * (q.theta_rad - a.theta_rad));
  const double size = way.squaredNorm();
  return (off - (size > 0 ? std::clamp(off.dot(way) / size, 0.0, 1.0) : 0) * way).norm();
}

// Keeps of points[first..] what a line through them needs (Douglas & Peucker 1973).
void thin_out(std::vector<Configuration>& points, std::size_t first, double reach) {
  const std::vector<Configuration> all(points.begin() + static_cast<std::ptrdiff_t>(first), points.end());
  if (all.size() < 3) return;
  std::vector<bool> kept(all.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, all.size() - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    std::size_t worst = 0;
    double most = kStraight_mm;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double off = beside_chord(all[i], all[a], all[b], reach);
      if (off > most) {
        most = off;
        worst = i;
      }
    }
    if (worst == 0) continue;
    kept[worst] = true;
    open.emplace_back(a, worst);
    open.emplace_back(worst, b);
  }
  points.resize(first);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept[i]) points.push_back(all[i]);
  }
}

// The same motion with the same contacts: what happened changed nothing.
bool goes_on(const LegPicture& before, const Leg& leg) {
  return before.motion == leg.motion &&
         std::equal(before.contacts.begin(), before.contacts.end(), leg.contacts.begin(), leg.contacts.end(),
                    [](const auto& a, const auto& b) { return a.pair == b.pair && a.sticks == b.sticks; });
}

// What a path's watch sees, in places close enough for a picture.
struct Recorder {
  double reach_mm = 0;
  std::vector<std::vector<Configuration>> stretches;

  void operator()(const PathStretch& stretch, double until) {
    stretches.push_back({stretch.at(0)});
    halve(stretch, 0, stretches.back().back(), until, stretch.at(until), 0);
  }

 private:
  void halve(const PathStretch& stretch, double from, const Configuration& a, double to, const Configuration& b,
             int depth) {
    const double middle = (from + to) / 2;
    const Configuration q = stretch.at(middle);
    const bool bends = beside_chord(q, a, b, reach_mm) > kStraight_mm / 4;
    if ((bends && depth < 12) || (depth < 2 && (q.theta_rad != a.theta_rad || q.theta_rad != b.theta_rad))) {
      halve(stretch, from, a, middle, q, depth + 1);
      halve(stretch, middle, q, to, b, depth + 1);
    } else {
      stretches.back().push_back(b);
    }
  }
};

class Pictures {
 public:
  Pictures(const FeederProblem& problem, int topology, std::span<const double> values)
      : spec_(problem.spec()),
        topology_(topology),
        values_(values),
        part_(part_model(spec_.part, spec_.environment, values)),
        layout_(lay_out(spec_.designs[static_cast<std::size_t>(topology)], spec_.environment, spec_.manufacture,
                        part_.diameter_mm, values)) {}

  std::optional<TurningPicture> operator()(bool with_space) {
    if (!has_obstacles(layout_)) return std::nullopt;
    track_.emplace(*TurningTrack::of(part_, layout_, spec_.environment));  // what is not shrunk does not vanish
    for (const LaidFeature& feature : layout_.features) {
      last_mm_ = std::max(last_mm_, feature.end_mm);
      for (const ObstacleShape& o : feature.obstacles)
        last_mm_ = std::max(last_mm_, bounding_box(o.area.outer).max.x() + o.radius_mm);
    }
    const TurningEvaluation nominal = travel_all_turning(part_, layout_, spec_.environment, false);
    const bool belt = is_belt(spec_.environment);
    find_goal(nominal);
    TurningPicture picture;
    const World& any = track_->world(0);
    for (std::size_t k = 1; k < any.shapes.size(); ++k)
      picture.obstacles.push_back({obstacle_name(layout_, static_cast<int>(k)), shown(any.shapes[k])});
    for (std::size_t aspect = 0; aspect < part_.shapes.size(); ++aspect)
      picture.parts.push_back(track_->world(static_cast<int>(aspect)).part.bodies.front());
    belt ? of_belt(nominal, picture) : of_poses(nominal, picture);
    if (with_space) {
      double from = 0, to = last_mm_;
      for (const PathPicture& path : picture.paths) {
        for (const Configuration& q : path.points) {
          from = std::min(from, q.x_mm);
          to = std::max(to, q.x_mm);
        }
      }
      const SpaceScene scene{spec_, topology_, values_, part_, layout_, from, to};
      for (int aspect = 0; aspect < static_cast<int>(part_.shapes.size()); ++aspect)
        picture.spaces.push_back(space_picture(scene, track_->world(aspect), aspect));
    }
    picture.sensitivity = gyration_sensitivity(part_, layout_, spec_.environment, nominal);
    if (!belt) {
      for (const PoseModel& pose : part_.poses) picture.poses.push_back(name_of(pose.stable));
      for (std::size_t i = 0; i < layout_.features.size(); ++i)
        picture.features.push_back("feature " + std::to_string(i) + " (" + layout_.features[i].type + ")");
      picture.transitions = transition_matrices(part_, layout_, spec_.environment);
    }
    return picture;
  }

 private:
  std::string name_of(const StablePose& pose) const {
    std::ostringstream out;
    out << part_.shapes[static_cast<std::size_t>(pose.aspect)].name << " " << std::fixed << std::setprecision(2)
        << pose.orientation_rad * 360 / kTurn << " deg";
    return out.str();
  }

  static ObstacleShape shown(ObstacleShape shape) {
    const Box box = bounding_box(shape.area.outer);
    std::vector<double> ys;
    for (const Point& p : shape.area.outer) ys.push_back(p.y());
    std::sort(ys.begin(), ys.end());
    // A wall profile's body goes down far below its face.
    const auto face = std::find_if(ys.begin(), ys.end(), [&](double y) { return y > box.min.y() + 50; });
    if (face == ys.end() || box.min.y() > -50) return shape;
    for (Point& p : shape.area.outer) p.y() = std::max(p.y(), std::min(0.0, *face) - kBelowFace_mm);
    return shape;
  }

  // With "one pose": the exit that most arrivals have.
  void find_goal(const TurningEvaluation& nominal) {
    std::map<int, double> leaving;
    double most = 0;
    for (const PoseTravel& arrival : nominal.arrivals) {
      if (arrival.exit_class < 0) continue;
      double& probability = leaving[arrival.exit_class];
      probability += arrival.result.prior;
      if (probability <= most) continue;
      most = probability;
      goal_class_ = arrival.exit_class;
    }
  }

  bool serves(const PoseTravel& arrival, bool belt) const {
    const Goal& goal = spec_.goal;
    if (arrival.exit_class < 0 || arrival.result.outcome != Outcome::Delivered) return false;
    if (goal.one_pose) return arrival.exit_class == goal_class_;
    const std::size_t aspect = static_cast<std::size_t>(arrival.aspect);
    if (goal.aspect != "any" && goal.aspect != part_.shapes[aspect].name) return false;
    const double exit = belt ? *arrival.result.exit_orientation_rad
                             : part_.poses[static_cast<std::size_t>(arrival.exit_pose)].stable.orientation_rad;
    return std::abs(std::remainder(exit - goal.orientation_rad, kTurn / part_.symmetry[aspect])) <=
           (belt ? goal.within_rad : kSamePose_rad);
  }

  PathPicture path_of(int aspect, const Configuration& start, bool is_goal) {
    Recorder recorder{track_->world(aspect).part.reach_mm, {}};
    TravelOptions options{true, true, [&](const PathStretch& s, double until) { recorder(s, until); }};
    const StartTravel travel = track_->travel(aspect, start, options);
    PathPicture picture{aspect, start.theta_rad, travel.outcome, travel.reason, is_goal, {}, {}};
    const Projection& path = travel.path;
    const double reach = track_->world(aspect).part.reach_mm;
    std::vector<Configuration>& points = picture.points;
    std::size_t next = 0;
    for (std::size_t i = 0; i < path.legs.size(); ++i) {
      const Leg& leg = path.legs[i];
      const bool last = i + 1 == path.legs.size(), for_ever = last && path.end == ProjectionEnd::Steady;
      const Configuration& end = last ? path.last : path.legs[i + 1].start;
      const std::size_t first = points.size();
      if (picture.legs.empty() || !goes_on(picture.legs.back(), leg))
        picture.legs.push_back({leg.motion, leg.event, first, leg.contacts});
      points.push_back(leg.start);
      if (for_ever) {
        points.push_back(far_behind(leg.start, path.last_twist.linear));
        break;
      }
      while (next < recorder.stretches.size() &&
             apart(recorder.stretches[next].front(), points.back(), reach) < kSamePlace_mm &&
             apart(points.back(), end, reach) >= kSamePlace_mm) {
        points.insert(points.end(), recorder.stretches[next].begin() + 1, recorder.stretches[next].end());
        ++next;
      }
      thin_out(points, first, reach);
    }
    if (points.empty()) points.push_back(start);
    if (path.end != ProjectionEnd::Steady) points.push_back(path.last);
    return picture;
  }

  // Where pictures of a steady translation end: the whole part is behind everything.
  Configuration far_behind(const Configuration& q, const Point& way) const {
    const Point along = way.normalized();
    double run = part_.diameter_mm;
    if (along.x() > 1e-3) run = std::max(run / 2, (last_mm_ + part_.diameter_mm - q.x_mm) / along.x());
    const Point end = q.position() + std::min(run, std::max(kMostRun_mm, 2 * last_mm_)) * along;
    return {end.x(), end.y(), q.theta_rad};
  }

  void of_belt(const TurningEvaluation& nominal, TurningPicture& picture) {
    for (std::size_t i = 0; i < nominal.map.size(); ++i) {
      const PoseTravel& arrival = nominal.arrivals[i];
      picture.map.push_back({arrival.aspect, nominal.map[i], picture.paths.size()});
      picture.paths.push_back(
          path_of(arrival.aspect, track_->belt_start(nominal.map[i].sample_rad), serves(arrival, true)));
    }
  }

  void of_poses(const TurningEvaluation& nominal, TurningPicture& picture) {
    for (int aspect = 0; aspect < static_cast<int>(part_.shapes.size()); ++aspect) {
      std::vector<std::pair<double, IntervalPicture>> found;  // by where they begin
      const int order = part_.symmetry[static_cast<std::size_t>(aspect)];
      for (std::size_t i = 0; i < part_.poses.size(); ++i) {
        const StablePose& stable = part_.poses[i].stable;
        if (stable.aspect != aspect) continue;
        for (int k = 0; k < order; ++k) {
          Configuration start = track_->pose_start(part_.poses[i]);
          start.theta_rad += k * kTurn / order;
          const PoseResult& end = nominal.poses[i].result;
          MapInterval interval{end.aspect, std::fmod(stable.basin_from_rad + k * kTurn / order, kTurn), 0, end.outcome,
                               end.exit_orientation_rad};
          interval.sample_rad = std::fmod(start.theta_rad, kTurn);
          found.push_back({interval.from_rad, {aspect, interval, picture.paths.size()}});
          picture.paths.push_back(path_of(aspect, start, serves(nominal.poses[i], false)));
        }
      }
      std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t i = 0; i < found.size(); ++i)
        found[i].second.interval.to_rad = found[(i + 1) % found.size()].second.interval.from_rad;
      if (found.size() == 1) {
        found[0].second.interval.from_rad = 0;
        found[0].second.interval.to_rad = kTurn;
      }
      for (auto& [from, interval] : found) picture.map.push_back(std::move(interval));
    }
  }

  const FeederSpec& spec_;
  int topology_;
  std::span<const double> values_;
  PartModel part_;
  Layout layout_;
  std::optional<TurningTrack> track_;
  double last_mm_ = 0;
  int goal_class_ = -1;
};

}  // namespace

std::optional<TurningPicture> turning_picture(const FeederProblem& problem, int topology,
                                              std::span<const double> values, bool with_space) {
  return Pictures(problem, topology, values)(with_space);
}

}  // namespace formotion::feeder
