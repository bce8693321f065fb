#include "applications/feeder/turning_sets.hpp"

#include <cmath>
#include <numbers>

#include "analysis/motion/outcome_map.hpp"

namespace formotion::feeder {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

class Sets {
 public:
  Sets(const PartModel& part, const Layout& layout, const Environment& environment, const TurningEvaluation& nominal)
      : part_(part), layout_(layout), environment_(environment), nominal_(nominal) {}

  SetOutcome over(std::size_t arrival, const std::map<std::string, std::pair<double, double>>& intervals) {
    std::vector<std::string> names;
    std::vector<std::pair<double, double>> box;
    for (const auto& [name, interval] : intervals) {
      names.push_back(name);
      box.push_back(interval);
    }
    return outcome_of_set([&](std::span<const double> member) { return at(arrival, names, member); }, box);
  }

  std::int64_t projections = 0;

 private:
  struct Member {
    Environment environment;
    std::unique_ptr<TurningTrack> track;
  };

  StartOutcome at(std::size_t index, const std::vector<std::string>& names, std::span<const double> values) {
    std::map<std::string, double> key;
    for (std::size_t i = 0; i < names.size(); ++i) key[names[i]] = values[i];
    auto [found, is_new] = members_.try_emplace(key);
    if (is_new) {
      Member& member = found->second;
      member.environment = environment_;
      for (const auto& [name, value] : key) {
        if (name == "wall_friction") member.environment.wall_friction = value;
        if (name == "drive_deg") member.environment.drive_rad = value * kTurn / 360;
      }
      // What is not shrunk does not vanish.
      member.track = std::make_unique<TurningTrack>(*TurningTrack::of(part_, layout_, member.environment));
    }
    ++projections;
    TurningTrack& track = *found->second.track;
    const PoseTravel& arrival = nominal_.arrivals[index];
    const Configuration start =
        is_belt(environment_) ? track.belt_start(arrival.result.orientation_rad) : track.pose_start(part_.poses[index]);
    const StartTravel travel = track.travel(arrival.aspect, start);
    // The same outcome, and where parts are delivered the same exit; exits by their ten-thousandths of a degree would
    // differ at the seams, so they are counted from the nominal one.
    int outcome = static_cast<int>(travel.outcome);
    if (travel.exit_rad && arrival.result.exit_orientation_rad) {
      const double period = kTurn / part_.symmetry[arrival.aspect];
      if (std::abs(std::remainder(*travel.exit_rad - *arrival.result.exit_orientation_rad, period)) > kSameExit_rad)
        outcome += 100;
    }
    return {outcome, travel.history};
  }

  const PartModel& part_;
  const Layout& layout_;
  const Environment& environment_;
  const TurningEvaluation& nominal_;
  std::map<std::map<std::string, double>, Member> members_;
};

}  // namespace

SetEvaluation arrivals_over_sets(const PartModel& part, const Layout& layout, const Environment& environment,
                                 const std::map<std::string, std::pair<double, double>>& intervals,
                                 const TurningEvaluation& nominal) {
  Sets sets(part, layout, environment, nominal);
  SetEvaluation result;
  const auto differs = [&](std::size_t i, const auto& box) {
    const SetOutcome all = sets.over(i, box);
    return !all.is_one || all.outcome != static_cast<int>(nominal.arrivals[i].result.outcome);
  };
  for (std::size_t i = 0; i < nominal.arrivals.size(); ++i) {
    const bool splits = differs(i, intervals);
    result.arrivals.push_back(splits ? Outcome::Ambiguous : nominal.arrivals[i].result.outcome);
    if (!splits || result.bites) continue;
    for (const auto& interval : intervals) {
      if (differs(i, std::map<std::string, std::pair<double, double>>{interval})) {
        result.bites = interval.first;
        break;
      }
    }
    if (!result.bites) result.bites = intervals.begin()->first;  // only together
  }
  result.projections = sets.projections;
  return result;
}

}  // namespace formotion::feeder
