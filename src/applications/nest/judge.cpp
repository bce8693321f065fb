#include "applications/nest/judge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/push_backprojection.hpp"
#include "analysis/energy/rests.hpp"
#include "analysis/energy/vibrating_table.hpp"
#include "applications/nest/drops.hpp"
#include "applications/nest/scene.hpp"
#include "applications/shared/judging.hpp"
#include "applications/shared/starts.hpp"

namespace formotion::nest {
namespace {

constexpr double kTouches_mm = 1e-6;

struct Effort {
  RestOptions rests;
  EscapeOptions escape;
  EquilibriaOptions equilibria;
  RegionOptions region;
};
Effort effort(bool in_detail) {
  Effort effort;
  if (in_detail) {
    effort.escape.gap_mm = 0.05;
    return effort;
  }
  effort.rests.grid_rad = 5 * std::numbers::pi / 180;
  effort.escape.gap_mm = 0.5;
  effort.escape.least_cell_mm = 0.25;
  effort.escape.most_cells = 200000;
  effort.equilibria.grid_rad = 5 * std::numbers::pi / 180;
  effort.region = search_region_options();
  return effort;
}

std::vector<ContactPoint> contact_points(const Scene& scene, const Configuration& q) {
  std::vector<ContactPoint> points;
  for (const Contact& contact : contacts_at(scene.part, scene.obstacles, q, kTouches_mm))
    points.push_back({contact.state.normal, contact.state.lever});
  return points;
}

class DesignJudge {
 public:
  DesignJudge(const NestSpec& spec, int topology, std::span<const double> values, bool in_detail)
      : spec_(spec), topology_(topology), values_(values), in_detail_(in_detail), effort_(effort(in_detail)) {}

  Judged run() {
    Judged judged;
    NestEvaluation& evaluation = judged.evaluation;
    evaluation.violations = defects_of(spec_, topology_, values_);
    if (!evaluation.violations.empty()) {
      judged.violation = 1000;
      for (const Violation& violation : evaluation.violations) judged.violation += violation.by;
      return judged;
    }
    shapes_ = aspect_shapes(spec_.part, values_);
    evaluation.metrics = member_metrics({}, &evaluation);
    worst_case(evaluation);
    const Metrics& metrics = spec_.robust && evaluation.worst_case ? *evaluation.worst_case : evaluation.metrics;
    require(metrics, evaluation, judged.violation);
    evaluation.feasible = evaluation.violations.empty();
    if (evaluation.feasible) judged.violation = 0;
    judged.work = work_;
    return judged;
  }

 private:
  bool is_pallet() const { return spec_.purpose == Purpose::Pallet; }

  // Everything that one set of uncertain values gives; what is not a number goes to the evaluation, if it is given.
  Metrics member_metrics(const Member& member, NestEvaluation* evaluation) {
    std::vector<std::unique_ptr<Scene>> scenes;
    for (const AspectShape& shape : shapes_) {
      scenes.push_back(scene_of(spec_, topology_, values_, shape, member));
      if (!scenes.back()) return {};
    }
    Metrics metrics;
    // The part stands where it stood; its centre of mass, and what it stands on, may be elsewhere.
    written_ = seat_of(spec_, values_);
    const Point off = rotated(member.centre_off_mm, written_.theta_rad);
    written_.x_mm += off.x();
    written_.y_mm += off.y();
    at_seat_mm_ = spec_.goal.seat.near_mm + 2 * std::abs(member.grow_mm);
    std::vector<NestRest> rests;
    for (const auto& scene : scenes) {
      const std::vector<NestRest> found = rests_of(*scene);
      rests.insert(rests.end(), found.begin(), found.end());
    }
    const auto goal = std::find_if(scenes.begin(), scenes.end(),
                                   [&](const auto& scene) { return scene->shape.name == spec_.goal.seat.aspect; });
    const Scene& seated = **goal;
    // Where the part really sits.
    Configuration seat = written_;
    const auto own = std::find_if(rests.begin(), rests.end(), [](const NestRest& rest) { return rest.is_seat; });
    if (own != rests.end()) seat = own->at;
    starts(seated, seat, metrics, evaluation);
    if (is_pallet()) {
      escapes(scenes, rests, metrics);
    } else {
      equilibria_of(scenes, seated, seat, member, metrics, evaluation);
    }
    if (evaluation) {
      if (in_detail_) details(scenes, seated, rests, seat, *evaluation);
      evaluation->rests = std::move(rests);
    }
    return metrics;
  }

  // One for each connected set and for all orientations that are the same.
  std::vector<NestRest> rests_of(const Scene& scene) {
    std::vector<NestRest> kept;
    const Configuration& seat = written_;
    const bool is_goal = scene.shape.name == spec_.goal.seat.aspect;
    for (const Rest& rest : rests(*scene.space, scene.gravity, effort_.rests)) {
      ++work_;
      NestRest one{
          scene.shape.name, reduced(rest.at, scene.symmetry), rest.height_mm, rest.set, false, 0, {}, {}, {}, 0};
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const NestRest& other) {
        return std::abs(other.height_mm - one.height_mm) < 1e-4 && apart_mm(scene, one.at, other) < 1e-4;
      });
      if (known) continue;
      one.is_seat = is_goal && apart_mm(scene, seat, one) <= at_seat_mm_;
      if (one.is_seat) one.at = member_near(one, seat);
      kept.push_back(std::move(one));
    }
    // Heights count from the seat.
    for (NestRest& rest : kept) rest.height_mm -= scene.gravity.height_mm(seat);
    return kept;
  }

  void starts(const Scene& scene, const Configuration& seat, Metrics& metrics, NestEvaluation* evaluation) {
    const StartsSpec& box = spec_.goal.starts;
    const double within = spec_.goal.seat.within_mm;
    const Configuration written = written_;
    std::vector<Configuration> ends;
    Funnels funnels;
    const auto drop = [&](double x, double y, double theta) {
      ++work_;
      const DropEnd end =
          dropped(scene, seat, within, {written.x_mm + x, written.y_mm + y, written.theta_rad + theta}, &funnels);
      if (end.outcome == NestOutcome::Seated) ends.push_back(end.end);
      return end;
    };
    const auto at = [&](double x, double y, double theta) {
      const DropEnd end = drop(x, y, theta);
      return StartOutcome{static_cast<int>(end.outcome), end.history};
    };
    const StartShares shares = shares_of_starts(box, static_cast<int>(NestOutcome::Seated), at, effort_.region);
    (is_pallet() ? metrics.capture_fraction : metrics.seated_fraction) = shares.share;
    if (evaluation) {
      evaluation->regions = shares.regions;
      evaluation->region_y_mm = shares.y_mm;
      for (const double theta : values_of(box.theta_rad, 5)) {
        for (const double y : values_of(box.y_mm, 3)) {
          for (const double x : values_of(box.x_mm, 5)) {
            const DropEnd end = drop(x, y, theta);
            evaluation->starts.push_back({x, y, theta, end.outcome, end.end});
          }
        }
      }
    }
    if (is_pallet() || ends.empty()) return;
    double apart = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) apart = std::max(apart, apart_mm(scene, ends[i], ends[k]));
    }
    metrics.repeatability_mm = apart;
  }

  void escapes(const std::vector<std::unique_ptr<Scene>>& scenes, std::vector<NestRest>& rests, Metrics& metrics) {
    bool all_known = true;
    for (NestRest& rest : rests) {
      const Scene& scene = scene_named(scenes, rest.aspect);
      EscapeBracket bracket = escape(*scene.space, scene.gravity, rest.at, scene.outside, effort_.escape);
      work_ += bracket.cells;
      // Motions out of wedges need smaller cells than most rests.
      if (!rest.is_seat && !bracket.upper_mm && std::isfinite(bracket.lower_mm)) {
        EscapeOptions finer = effort_.escape;
        finer.least_cell_mm /= 5;
        bracket = escape(*scene.space, scene.gravity, rest.at, scene.outside, finer);
        work_ += bracket.cells;
      }
      rest.escape_low_mm = bracket.lower_mm;
      rest.escape_high_mm = bracket.upper_mm;
      rest.why = bracket.why;
      if (in_detail_) rest.way_out = std::move(bracket.path);
      // No way leads out of it, so none leads in.
      if (!std::isfinite(rest.escape_low_mm)) continue;
      if (rest.is_seat) {
        metrics.goal_escape_height_mm = rest.escape_low_mm;
      } else if (rest.escape_high_mm) {
        metrics.worst_wrong_escape_height_mm =
            std::max(metrics.worst_wrong_escape_height_mm.value_or(0), *rest.escape_high_mm);
      } else {
        all_known = false;
      }
    }
    if (!all_known) metrics.worst_wrong_escape_height_mm.reset();
    if (metrics.goal_escape_height_mm && all_known)
      metrics.selectivity_mm = *metrics.goal_escape_height_mm - metrics.worst_wrong_escape_height_mm.value_or(0);
  }

  void equilibria_of(const std::vector<std::unique_ptr<Scene>>& scenes, const Scene& seated, const Configuration& seat,
                     const Member& member, Metrics& metrics, NestEvaluation* evaluation) {
    const PushSet push = push_set(spec_, values_, member);
    const double within = spec_.goal.seat.within_mm;
    int wrong = 0;
    for (const auto& scene : scenes) {
      std::vector<Configuration> counted;  // of this aspect
      for (EquilibriumSet& set : equilibria(*scene->space, push, effort_.equilibria)) {
        const bool holds_seat =
            scene.get() == &seated && std::any_of(set.samples.begin(), set.samples.end(), [&](const Configuration& q) {
              return apart_mm(*scene, q, seat) <= within;
            });
        const bool again = std::any_of(counted.begin(), counted.end(),
                                       [&](const Configuration& q) { return apart_mm(*scene, q, set.certain) < 1e-3; });
        if (holds_seat || again) continue;
        counted.push_back(set.certain);
        ++wrong;
        if (evaluation && in_detail_) evaluation->wrong.push_back({scene->shape.name, std::move(set)});
      }
    }
    metrics.wrong_equilibria = wrong;
    const std::vector<ContactPoint> contacts = contact_points(seated, seat);
    const double along = std::atan2(seated.gravity.down.y(), seated.gravity.down.x());
    metrics.resisted_weights = least_resisted(contacts, along, seated.friction);
    metrics.resisted_moment_mm = resisted_moment_mm(contacts, along, seated.friction);
    if (evaluation) evaluation->seat_holds = can_hold(contacts, push, seated.part.gyration_mm);
  }

  void details(const std::vector<std::unique_ptr<Scene>>& scenes, const Scene& seated, std::vector<NestRest>& rests,
               const Configuration& seat, NestEvaluation& evaluation) {
    for (const auto& scene : scenes) {
      std::vector<std::size_t> own;
      std::vector<NestRest> of_aspect;
      for (std::size_t i = 0; i < rests.size(); ++i) {
        if (rests[i].aspect != scene->shape.name) continue;
        own.push_back(i);
        of_aspect.push_back(rests[i]);
      }
      const std::vector<double> shares = drop_shares(*scene, of_aspect, spec_.goal.seat.within_mm, 24, 72);
      for (std::size_t i = 0; i < own.size(); ++i) rests[own[i]].drop_share = scene->shape.probability * shares[i];
    }
    sure(seated, rests, seat, evaluation);
    certain(seated, seat, evaluation);
    if (is_pallet() && spec_.environment.table) evaluation.window = window(rests);
  }

  // Of the starts that were listed: by energy alone, with what the first impact takes of it.
  void sure(const Scene& seated, const std::vector<NestRest>& rests, const Configuration& seat,
            NestEvaluation& evaluation) {
    const auto own = std::find_if(rests.begin(), rests.end(), [](const NestRest& rest) { return rest.is_seat; });
    if (own == rests.end() || evaluation.starts.empty()) return;
    double rise = std::numeric_limits<double>::infinity();
    EscapeOptions options = effort_.escape;
    options.want_path = false;
    options.gap_mm = std::max(options.gap_mm, 0.2);
    rise = escape(*seated.space, seated.gravity, seat, seated.outside, options).lower_mm;
    for (const NestRest& other : rests) {
      if (other.is_seat || other.aspect != own->aspect) continue;
      rise = std::min(rise, rise_between(*seated.space, seated.gravity, seat, other.at, options).lower_mm);
    }
    const ImpactLaw law = impact_law(spec_, values_, seated);
    for (StartResult& start : evaluation.starts) {
      const Configuration from = start_at(start);
      // Of orientations that are the same the nearest.
      const double period = 2 * std::numbers::pi / seated.symmetry;
      Configuration at = seat;
      at.theta_rad += period * std::round((from.theta_rad - at.theta_rad) / period);
      start.is_sure = surely_captured(*seated.space, seated.gravity, at, rise, from, options);
      if (start.is_sure) continue;
      const auto landed = landing(*seated.space, seated.gravity, from, law);
      start.is_sure =
          landed && surely_captured(*seated.space, seated.gravity, at, rise, landed->at, landed->energy_mm, options);
    }
    evaluation.sure_fraction = share_of(evaluation.starts, [](const StartResult& start) { return start.is_sure; });
  }

  // For every direction and friction that is asked for, without bouncing.
  void certain(const Scene& seated, const Configuration& seat, NestEvaluation& evaluation) {
    if (evaluation.starts.empty()) return;
    const PushSet push = push_set(spec_, values_);
    const double within = spec_.goal.seat.within_mm;
    for (StartResult& start : evaluation.starts) {
      start.pushed = ends_in(*seated.space, push, start_at(start),
                             [&](const Configuration& q) { return apart_mm(seated, q, seat) <= within; });
    }
    evaluation.certain_fraction =
        share_of(evaluation.starts, [](const StartResult& start) { return start.pushed == Verdict::Certain; });
  }

  Configuration start_at(const StartResult& start) const {
    return {written_.x_mm + start.x_mm, written_.y_mm + start.y_mm, written_.theta_rad + start.theta_rad};
  }

  template <typename Is>
  static double share_of(const std::vector<StartResult>& starts, const Is& is) {
    return static_cast<double>(std::count_if(starts.begin(), starts.end(), is)) / static_cast<double>(starts.size());
  }

  ShakingWindow window(const std::vector<NestRest>& rests) const {
    const TableSpec& table = *spec_.environment.table;
    const VibratingTable shaken{table.amplitude_mm, table.frequency_hz, table.restitution.value(values_)};
    ShakingWindow window;
    window.throws_mm = greatest_rise_mm(shaken);
    double wrong = 0;
    bool all_known = true;
    std::vector<RestFate> fates;
    for (const NestRest& rest : rests) {
      if (rest.is_seat) {
        window.keeps_up_to_mm = amplitude_for_rise_mm(rest.escape_low_mm, table.frequency_hz, shaken.restitution);
      } else {
        all_known = all_known && (rest.escape_high_mm || !std::isfinite(rest.escape_low_mm));
        wrong = std::max(wrong, rest.escape_high_mm.value_or(0));
      }
      fates.push_back({rest.drop_share, rest.is_seat, !rest.is_seat && rest.escape_low_mm < window.throws_mm});
    }
    if (all_known) window.loses_from_mm = amplitude_for_rise_mm(wrong, table.frequency_hz, shaken.restitution);
    window.filling = filling(fates);
    return window;
  }

  void worst_case(NestEvaluation& evaluation) {
    judge_worst_case(spec_, "com_mm", objective, evaluation, [&](const Member& member, Metrics& worst) {
      const Metrics metrics = member_metrics(member, nullptr);
      take_worse(worst, metrics);
      return metrics;
    });
  }

  // What a member does not have is missing in the worst case, too.
  static void take_worse(Metrics& worst, const Metrics& other) {
    const auto take = [](auto& a, const auto& b, bool larger_is_worse) {
      if (!a || !b) {
        a.reset();
      } else {
        a = larger_is_worse ? std::max(*a, *b) : std::min(*a, *b);
      }
    };
    take(worst.seated_fraction, other.seated_fraction, false);
    take(worst.wrong_equilibria, other.wrong_equilibria, true);
    take(worst.repeatability_mm, other.repeatability_mm, true);
    take(worst.resisted_weights, other.resisted_weights, false);
    take(worst.resisted_moment_mm, other.resisted_moment_mm, false);
    take(worst.goal_escape_height_mm, other.goal_escape_height_mm, false);
    take(worst.worst_wrong_escape_height_mm, other.worst_wrong_escape_height_mm, true);
    take(worst.selectivity_mm, other.selectivity_mm, false);
    take(worst.capture_fraction, other.capture_fraction, false);
  }

  void require(const Metrics& metrics, NestEvaluation& evaluation, double& violation) const {
    const auto add = [&](const std::string& what, const std::string& where, double by) {
      evaluation.violations.push_back({what, where, by});
      violation += by;
    };
    const Configuration seat = seat_of(spec_, values_);
    const auto own = std::find_if(evaluation.rests.begin(), evaluation.rests.end(),
                                  [](const NestRest& rest) { return rest.is_seat; });
    if (own == evaluation.rests.end()) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const NestRest& rest : evaluation.rests) {
        if (rest.aspect == spec_.goal.seat.aspect)
          nearest = std::min(nearest, (rest.at.position() - seat.position()).norm());
      }
      const bool any = std::isfinite(nearest);
      if (is_pallet() || evaluation.seat_holds == Verdict::Impossible)
        add("the part does not rest in the seat", "/goal/seat", 10 + (any ? nearest : 1000));
    }
    if (is_pallet()) {
      if (!metrics.capture_fraction || !(*metrics.capture_fraction > 0))
        add("no start ends in the seat", "/goal/starts", 1);
      if (own != evaluation.rests.end() && !metrics.goal_escape_height_mm)
        add(std::isfinite(own->escape_low_mm) ? "at the worst of what is uncertain the part does not rest in the seat"
                                              : "no way leads out of the seat, nor into it",
            "/goal/seat", 5);
      if (metrics.goal_escape_height_mm && !metrics.selectivity_mm)
        add("no way out was found for a wrong rest", "/goal/seat", 5);
      if (metrics.selectivity_mm && !(*metrics.selectivity_mm > 0))
        add("a wrong rest holds the part as well as the seat", "/goal/seat", 1e-3 - *metrics.selectivity_mm);
    } else if (!metrics.seated_fraction || !(*metrics.seated_fraction > 0)) {
      add("no start ends in the seat", "/goal/starts", 1);
    }
    judge_bounds(
        spec_.bounds, [&](const std::string& metric) { return objective(metrics, metric); }, add);
  }

  static const Scene& scene_named(const std::vector<std::unique_ptr<Scene>>& scenes, const std::string& aspect) {
    return **std::find_if(scenes.begin(), scenes.end(), [&](const auto& scene) { return scene->shape.name == aspect; });
  }

  const NestSpec& spec_;
  int topology_;
  std::span<const double> values_;
  bool in_detail_;
  Effort effort_;
  std::vector<AspectShape> shapes_;
  Configuration written_;  // the seat, of the member that is judged
  double at_seat_mm_ = 0;
  std::int64_t work_ = 0;
};

}  // namespace

double objective(const Metrics& metrics, const std::string& name) {
  constexpr double kNone = 1e4;  // mm: worse than any nest's
  if (name == "seated_fraction") return metrics.seated_fraction.value_or(0);
  if (name == "repeatability_mm") return metrics.repeatability_mm.value_or(kNone);
  if (name == "wrong_equilibria") return metrics.wrong_equilibria.value_or(static_cast<int>(kNone));
  if (name == "resisted_weights") return std::min(metrics.resisted_weights.value_or(0), kNone);
  if (name == "selectivity_mm") return metrics.selectivity_mm.value_or(-kNone);
  if (name == "goal_escape_height_mm") return metrics.goal_escape_height_mm.value_or(0);
  if (name == "worst_wrong_escape_height_mm") return metrics.worst_wrong_escape_height_mm.value_or(kNone);
  return metrics.capture_fraction.value_or(0);
}

Judged judge(const NestSpec& spec, int topology, std::span<const double> values, bool in_detail) {
  return DesignJudge(spec, topology, values, in_detail).run();
}

}  // namespace formotion::nest
