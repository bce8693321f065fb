#include "applications/feeder/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "applications/feeder/turning_sets.hpp"
#include "applications/feeder/worst_ends.hpp"

namespace formotion::feeder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLeast_mm = 1e-6;
constexpr int kMostHalvings = 5;  // of a turning track's tolerance

// How one pose (or one arrival of a belt) ends over all members.
struct Ending {
  bool delivers = false;  // always, in the goal pose
  bool may_pass = false;  // somewhere, as a wrong pose
  bool may_jam = false;   // somewhere; or it does not end alike everywhere
  double slack_mm = 0;    // what is left of its margin or depth
  double least_prior = 0, most_prior = 0;
  double extent_mm = 0;
};

class Judge {
 public:
  Judge(const JudgedCase& judged, const Spreads& spreads, const WorstCaseOptions& options)
      : judged_(judged), spreads_(spreads), spread_(spreads.all), options_(options) {}

  WorstCase run() {
    result_.metrics = judged_.metrics;
    judged_.turns ? turning() : past_voids();
    sum_up();
    return std::move(result_);
  }

 private:
  const Environment& environment() const { return judged_.design.spec.environment; }
  const std::vector<PoseTravel>& arrivals() const { return judged_.travels.arrivals; }
  bool delivered(std::size_t i) const { return arrivals()[i].result.outcome == Outcome::Delivered; }

  void lack(const char* what, const StablePose& pose, double by) {
    result_.lacking += by;
    if (options_.in_detail)
      result_.violations.push_back(
          {std::string("at the worst ") + what, "pose " + pose_name(judged_.design.part, pose), by});
  }

  // Voids and blades: bounds for all members.
  void past_voids() {
    const std::size_t nominal = arrivals().size();
    for (std::size_t i = 0; i < spread_.poses.size(); ++i) {
      const bool is_kept = i < nominal && judged_.wanted[i] && delivered(i);
      (is_kept ? kept_ : lost_).poses.push_back(static_cast<int>(i));
    }
    const bool require_tip = judged_.design.spec.goal.require_tip;
    kept_.ends = worst_kept(spread_, kept_.poses, judged_.layout, environment(), result_.work);
    lost_.ends = worst_lost(spread_, lost_.poses, judged_.layout, environment(), require_tip, result_.work);
    endings_.resize(spread_.poses.size());
    for (std::size_t i = 0; i < endings_.size(); ++i) {
      endings_[i].least_prior = spread_.poses[i].least_prior;
      endings_[i].most_prior = spread_.poses[i].most_prior;
      endings_[i].extent_mm = spread_.least.poses[i].x_max - spread_.least.poses[i].x_min;
    }
    for (std::size_t k = 0; k < kept_.poses.size(); ++k) {
      const StablePose& pose = spread_.least.poses[static_cast<std::size_t>(kept_.poses[k])].stable;
      Ending& ending = endings_[static_cast<std::size_t>(kept_.poses[k])];
      ending.slack_mm = kept_.ends[k].slack_mm;
      ending.delivers = kept_.ends[k].slack_mm >= 0;
      ending.may_jam = !ending.delivers;
      if (!ending.delivers) lack("the goal pose may be lost", pose, -ending.slack_mm);
      consider(kept_.poses[k], true, ending.slack_mm);
    }
    for (std::size_t k = 0; k < lost_.poses.size(); ++k) {
      const std::size_t i = static_cast<std::size_t>(lost_.poses[k]);
      const StablePose& pose = spread_.least.poses[i].stable;
      Ending& ending = endings_[i];
      ending.slack_mm = lost_.ends[k].slack_mm;
      ending.may_pass = lost_.ends[k].slack_mm < 0;
      // One that all members deliver jams nowhere.
      const bool passes = i < nominal && delivered(i);
      ending.may_jam = lost_.ends[k].may_jam || (ending.may_pass && !passes) ||
                       (i < nominal && arrivals()[i].result.outcome == Outcome::Jammed);
      if (ending.may_pass) lack("a wrong pose may be delivered", pose, -ending.slack_mm);
      if (ending.may_jam && !ending.may_pass) lack("a pose may jam", pose, std::max(1e-3, lost_.ends[k].lacking_mm));
      if (lost_.ends[k].hurried_mm > 0) lack("a lost pose may have no time to tip", pose, lost_.ends[k].hurried_mm);
      consider(lost_.poses[k], false, ending.slack_mm);
    }
    find_what_bites();
    result_.metrics.margin_mm = std::max(0.0, std::isfinite(least_slack_) ? least_slack_ : 0);
    result_.metrics.tolerance_mm = std::nullopt;
    if (!options_.wants_tolerance || !judged_.layout.invalid.empty()) return;
    result_.metrics.tolerance_mm =
        result_.lacking > 0 ? 0 : worst_tolerance(spread_, kept_, lost_, judged_.layout, result_.work);
  }

  void consider(int pose, bool kept, double slack_mm) {
    if (slack_mm >= least_slack_) return;
    least_slack_ = slack_mm;
    critical_ = pose;
    critical_is_kept_ = kept;
  }

  // The value that alone leaves the least to the pose that has the least left.
  void find_what_bites() {
    double least = kInfinity;
    if (critical_ >= 0) {
      const StablePose& pose = spread_.least.poses[static_cast<std::size_t>(critical_)].stable;
      const double as_drawn = critical_ < static_cast<int>(arrivals().size())
                                  ? arrivals()[static_cast<std::size_t>(critical_)].nominal_mm
                                  : kInfinity;
      for (const auto& [name, alone] : spreads_.alone) {
        const int same = same_pose(alone, pose);
        if (same < 0) continue;  // without the others it is no pose
        const std::vector<WorstEnd> end =
            critical_is_kept_ ? worst_kept(alone, {same}, judged_.layout, environment(), result_.work)
                              : worst_lost(alone, {same}, judged_.layout, environment(), false, result_.work);
        if (end.front().slack_mm >= as_drawn - kLeast_mm || end.front().slack_mm >= least - kLeast_mm) continue;
        least = end.front().slack_mm;
        result_.bites = name;
      }
    }
    if (result_.bites) return;
    const auto changes_priors = std::find_if(spreads_.alone.begin(), spreads_.alone.end(), [](const auto& alone) {
      return std::any_of(alone.second.poses.begin(), alone.second.poses.end(),
                         [](const PartSpread::Pose& pose) { return pose.least_prior < pose.most_prior; });
    });
    if (changes_priors != spreads_.alone.end()) result_.bites = changes_priors->first;
  }
  static int same_pose(const PartSpread& spread, const StablePose& pose) {
    for (std::size_t i = 0; i < spread.poses.size(); ++i) {
      const StablePose& other = spread.least.poses[i].stable;
      if (other.aspect == pose.aspect && std::abs(other.orientation_rad - pose.orientation_rad) < 1e-9)
        return static_cast<int>(i);
    }
    return -1;
  }

  // Obstacles: members are looked at.
  void turning() {
    const bool belt = is_belt(environment());
    PartModel part = judged_.design.part;
    std::vector<PoseTravel> all = arrivals();
    if (!belt) {
      for (std::size_t i = all.size(); i < spread_.poses.size(); ++i) part.poses.push_back(spread_.least.poses[i]);
      add_travels(part, all);
    }
    const SetEvaluation sets =
        arrivals_over_sets({part, judged_.layout, environment(), all}, spread_.uncertainty, true);
    result_.work += sets.projections;
    result_.bites = sets.bites;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const PoseResult& pose = all[i].result;
      Ending ending;
      ending.least_prior = belt ? pose.prior : spread_.poses[i].least_prior;
      ending.most_prior = belt ? pose.prior : spread_.poses[i].most_prior;
      ending.extent_mm = all[i].extent_mm;
      const bool serves = i < arrivals().size() && judged_.wanted[i];
      ending.delivers = sets.alike[i] && serves;
      ending.may_pass = !sets.alike[i] || (pose.outcome == Outcome::Delivered && !serves);
      ending.may_jam = !sets.alike[i] || (pose.outcome != Outcome::Delivered && pose.outcome != Outcome::Rejected);
      if (!sets.alike[i]) {
        result_.lacking += std::max(kLeast_mm, ending.most_prior);
        if (options_.in_detail)
          result_.violations.push_back({"at the worst an arrival ends otherwise",
                                        arrival_name(part, judged_.travels, i, belt),
                                        std::max(kLeast_mm, ending.most_prior)});
      } else if (!ending.delivers && (ending.may_pass || ending.may_jam)) {
        result_.lacking += std::max(kLeast_mm, ending.most_prior);
      }
      endings_.push_back(ending);
    }
    result_.metrics.margin_mm = result_.metrics.tolerance_mm = std::nullopt;
    if (!options_.wants_tolerance || !judged_.layout.invalid.empty()) return;
    result_.metrics.tolerance_mm = result_.lacking > 0 ? 0 : turning_tolerance_left(part, all);
  }

  // Poses that the part as drawn does not rest in, as they travel on the track as drawn.
  void add_travels(const PartModel& part, std::vector<PoseTravel>& all) {
    if (part.poses.size() == all.size()) return;
    TurningEvaluation others;
    PartModel rest = part;
    rest.poses.erase(rest.poses.begin(), rest.poses.begin() + static_cast<std::ptrdiff_t>(all.size()));
    others = travel_all_turning(rest, judged_.layout, environment(), false);
    result_.work += others.projections;
    all.insert(all.end(), others.poses.begin(), others.poses.end());
  }

  // What is left of the tolerance as drawn, halved until everything ends alike with as much more error of every edge.
  double turning_tolerance_left(const PartModel& part, const std::vector<PoseTravel>& all) {
    const TurningTolerance drawn =
        turning_tolerance(judged_.design.part, judged_.layout, environment(), judged_.travels);
    result_.work += drawn.projections;
    double left = drawn.tolerance_mm - spread_.uncertainty.feature_mm;
    for (int k = 0; k < kMostHalvings && left > 0; ++k, left /= 2) {
      Uncertainty more = spread_.uncertainty;
      more.feature_mm += left;
      const SetEvaluation sets = arrivals_over_sets({part, judged_.layout, environment(), all}, more, false);
      result_.work += sets.projections;
      if (std::all_of(sets.alike.begin(), sets.alike.end(), [](bool alike) { return alike; })) return left;
    }
    return 0;
  }

  void sum_up() {
    Metrics& metrics = result_.metrics;
    double surely = 0, passing = 0, jamming = 0, others = 0, arriving = 0, pitch = 0, longest = 0;
    bool priors_are_known = true;
    for (const Ending& ending : endings_) {
      priors_are_known = priors_are_known && ending.least_prior == ending.most_prior;
      if (ending.delivers) surely += ending.least_prior;
      if (!ending.delivers) others += ending.most_prior;
      if (ending.may_pass) passing += ending.most_prior;
      if (ending.may_jam) jamming += ending.most_prior;
      pitch += ending.most_prior * ending.extent_mm;
      longest = std::max(longest, ending.extent_mm);
    }
    for (const PoseTravel& arrival : arrivals()) arriving += arrival.result.prior;
    metrics.efficiency = priors_are_known ? surely : std::max(surely, arriving - others);
    if (surely == 0) metrics.efficiency = 0;
    metrics.jam_probability = std::min(jamming, 1.0);
    metrics.purity = std::nullopt;
    if (metrics.efficiency + passing > 0) metrics.purity = metrics.efficiency / (metrics.efficiency + passing);
    if (!priors_are_known) pitch = std::min(pitch, longest * arriving);
    metrics.feed_rate_per_min = std::nullopt;
    if (pitch > 0) metrics.feed_rate_per_min = 60 * spread_.speed_mm_s.first * metrics.efficiency * arriving / pitch;
    if (metrics.efficiency > 0 || result_.lacking > 0) return;
    result_.lacking = kLeast_mm;
    result_.violations.push_back({"at the worst the goal pose is not delivered", "goal", kLeast_mm});
  }

  const JudgedCase& judged_;
  const Spreads& spreads_;
  const PartSpread& spread_;
  const WorstCaseOptions& options_;
  WorstCase result_;
  DemandedPoses kept_, lost_;
  std::vector<Ending> endings_;
  double least_slack_ = kInfinity;
  int critical_ = -1;
  bool critical_is_kept_ = false;
};

}  // namespace

WorstCase worst_case(const JudgedCase& judged, const Spreads& spreads, const WorstCaseOptions& options) {
  return Judge(judged, spreads, options).run();
}

double robust_shortfall(const JudgedCase& judged, const PartSpread& spread) {
  if (judged.turns) return 1;
  double need = 0;
  for (const PartSpread::Pose& pose : spread.poses) need = std::max(need, pose.away_mm);
  need += spread.uncertainty.feature_mm;
  const std::vector<PoseTravel>& arrivals = judged.travels.arrivals;
  const bool any = judged.design.spec.goal.one_pose;
  bool is_met = false;
  int nearest = -1;  // to being delivered as the goal
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const bool delivered = arrivals[i].result.outcome == Outcome::Delivered;
    is_met = is_met || (delivered && judged.wanted[i]);
    if (delivered || !(judged.wanted[i] || any)) continue;
    if (nearest < 0 || arrivals[i].nominal_mm < arrivals[static_cast<std::size_t>(nearest)].nominal_mm)
      nearest = static_cast<int>(i);
  }
  double shortfall = 0;
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const bool delivered = arrivals[i].result.outcome == Outcome::Delivered;
    const bool is_wrong = delivered ? !judged.wanted[i] : !is_met && static_cast<int>(i) == nearest;
    shortfall += is_wrong ? need : std::max(0.0, need - arrivals[i].nominal_mm);
  }
  return shortfall;
}

}  // namespace formotion::feeder
