#include "applications/feeder/turning_sets.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "analysis/motion/outcome_map.hpp"

namespace formotion::feeder {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kOtherExit = 100;  // added to an outcome
constexpr int kVanished = -1;

// Sides of the box of members. "com x_mm" and "com y_mm" are sides of one uncertain value.
using Sides = std::map<std::string, std::pair<double, double>>;

Sides sides_of(const Uncertainty& uncertainty, const Layout& layout) {
  Sides sides;
  const bool has_voids =
      std::any_of(layout.features.begin(), layout.features.end(), [](const auto& f) { return !f.voids.empty(); });
  for (const auto& [name, interval] : uncertainty.intervals) {
    if (name == "wall_friction" || name == "drive_deg" || (name == "tilt_deg" && has_voids)) sides[name] = interval;
  }
  if (uncertainty.feature_mm > 0) sides["feature_mm"] = {-uncertainty.feature_mm, uncertainty.feature_mm};
  if (uncertainty.outline_mm > 0) sides["outline_mm"] = {-uncertainty.outline_mm, uncertainty.outline_mm};
  if (uncertainty.com_mm > 0) {
    const double off = uncertainty.com_mm / std::numbers::sqrt2;
    sides["com x_mm"] = sides["com y_mm"] = {-off, off};
  }
  return sides;
}

class Sets {
 public:
  explicit Sets(const TurningCase& turning) : turning_(turning) {}

  // Whether some member ends otherwise than the arrival does as drawn.
  bool differs(std::size_t arrival, const Uncertainty& uncertainty) {
    const double off = uncertainty.feature_mm;
    const double voids = turning_.arrivals[arrival].result.outcome == Outcome::Delivered ? off : -off;
    std::vector<std::string> names;
    std::vector<std::pair<double, double>> box;
    for (const auto& [name, side] : sides_of(uncertainty, turning_.layout)) {
      names.push_back(name);
      box.push_back(side);
    }
    if (box.empty()) return false;
    // Halving a box of many sides costs too much: corners, middles of faces and the middle must do.
    const int depth = box.size() <= 2 ? 2 : 0;
    const SetOutcome all =
        outcome_of_set([&](std::span<const double> at) { return end_of(arrival, names, at, voids); }, box, depth);
    return !all.is_one || all.outcome != static_cast<int>(turning_.arrivals[arrival].result.outcome);
  }

  std::int64_t projections = 0;

 private:
  struct Member {
    Environment environment;
    std::optional<PartModel> part;        // where it is not the one as drawn
    std::unique_ptr<TurningTrack> track;  // none where an obstacle vanishes
  };

  Member& member(const std::map<std::string, double>& values) {
    auto [found, is_new] = members_.try_emplace(values);
    Member& member = found->second;
    if (!is_new) return member;
    member.environment = turning_.environment;
    TrackErrors errors;
    double outline = 0;
    Point com(0, 0);
    for (const auto& [name, value] : values) {
      if (name == "feature_mm") {
        errors.obstacles_mm = value;
      } else if (name == "voids_mm") {
        errors.voids_mm = value;
      } else if (name == "outline_mm") {
        outline = value;
      } else if (name == "com x_mm") {
        com.x() = value;
      } else if (name == "com y_mm") {
        com.y() = value;
      } else {
        set_value(member.environment, name, value);
      }
    }
    if (outline != 0 || com != Point(0, 0)) member.part = member_of(turning_.part, member.environment, outline, com);
    const PartModel& part = member.part ? *member.part : turning_.part;
    if (auto track = TurningTrack::of(part, turning_.layout, member.environment, errors))
      member.track = std::make_unique<TurningTrack>(std::move(*track));
    return member;
  }

  StartOutcome end_of(std::size_t index, const std::vector<std::string>& names, std::span<const double> at,
                      double voids_mm) {
    std::map<std::string, double> values{{"voids_mm", voids_mm}};
    for (std::size_t i = 0; i < names.size(); ++i) values[names[i]] = at[i];
    Member& chosen = member(values);
    if (!chosen.track) return {kVanished, 0};
    ++projections;
    TurningTrack& track = *chosen.track;
    const PartModel& part = chosen.part ? *chosen.part : turning_.part;
    const PoseTravel& arrival = turning_.arrivals[index];
    const Configuration start = is_belt(turning_.environment) ? track.belt_start(arrival.result.orientation_rad)
                                                              : track.pose_start(part.poses[index]);
    const StartTravel travel = track.travel(arrival.aspect, start);
    // The same outcome, and where parts are delivered the same exit; exits by their ten-thousandths of a degree would
    // differ at the seams, so they are counted from the nominal one.
    int outcome = static_cast<int>(travel.outcome);
    if (travel.exit_rad && arrival.result.exit_orientation_rad) {
      const double period = kTurn / part.symmetry[arrival.aspect];
      if (std::abs(std::remainder(*travel.exit_rad - *arrival.result.exit_orientation_rad, period)) > kSameExit_rad)
        outcome += kOtherExit;
    }
    return {outcome, travel.history};
  }

  const TurningCase& turning_;
  std::map<std::map<std::string, double>, Member> members_;
};

}  // namespace

SetEvaluation arrivals_over_sets(const TurningCase& turning, const Uncertainty& uncertainty, bool find_what_bites) {
  Sets sets(turning);
  SetEvaluation result;
  const std::vector<std::string> names = uncertain_values(uncertainty);
  for (std::size_t i = 0; i < turning.arrivals.size(); ++i) {
    const bool splits = sets.differs(i, uncertainty);
    result.alike.push_back(!splits);
    if (!splits || result.bites || !find_what_bites) continue;
    const auto alone = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& name) { return sets.differs(i, only(uncertainty, name)); });
    result.bites = alone != names.end() ? *alone : names.front();  // the first if only together
  }
  result.projections = sets.projections;
  return result;
}

}  // namespace formotion::feeder
