#include "applications/assembly/judge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "analysis/insertion/exclusion.hpp"
#include "applications/shared/judging.hpp"
#include "applications/shared/starts.hpp"

namespace formotion::assembly {
namespace {

constexpr double kWithin_mm = 1e-6;  // of a never-goal's depth

const InsertionOptions kNoPath{};

StartResult started(const InsertionTask& task, double x_mm, double y_mm, double theta_rad) {
  return {x_mm, y_mm, theta_rad, insert(task, start_with_errors(task, x_mm, y_mm, theta_rad), kNoPath)};
}

// at(x, y, theta): the result of a start.
template <class At>
std::vector<StartResult> grid(const StartsSpec& starts, int count, const At& at) {
  std::vector<StartResult> results;
  for (const double theta : values_of(starts.theta_rad, count)) {
    for (const double y : values_of(starts.y_mm, std::min(count, 3))) {
      for (const double x : values_of(starts.x_mm, count)) results.push_back(at(x, y, theta));
    }
  }
  return results;
}

// The largest values along all insertions that are projected for a design.
struct Peaks {
  double axial_n = 0, lateral_n = 0, work_nmm = 0;
  void take(const Insertion& insertion) {
    axial_n = std::max(axial_n, insertion.peak_axial_n);
    lateral_n = std::max(lateral_n, insertion.peak_lateral_n);
    work_nmm = std::max(work_nmm, insertion.work_nmm);
  }
};

ProjectedStart projected(const StartResult& start, const Member& member) {
  const Insertion& insertion = start.insertion;
  return {member,
          start.x_mm,
          start.y_mm,
          start.theta_rad,
          insertion.outcome,
          insertion.history,
          insertion.peak_axial_n,
          insertion.peak_lateral_n,
          insertion.work_nmm};
}

class DesignJudge {
 public:
  DesignJudge(const AssemblySpec& spec, int topology, std::span<const double> values, bool in_detail,
              std::vector<ProjectedStart>* projected)
      : spec_(spec), topology_(topology), values_(values), in_detail_(in_detail), projected_(projected) {}

  Judged run() {
    Judged judged;
    AssemblyEvaluation& evaluation = judged.evaluation;
    evaluation.violations = defects(spec_, topology_, values_);
    if (!evaluation.violations.empty()) {
      judged.violation = 1000;
      for (const Violation& violation : evaluation.violations) judged.violation += violation.by;
      return judged;
    }
    evaluation.metrics = member_metrics({}, &evaluation);
    worst_case(evaluation);
    const Metrics& metrics = spec_.robust && evaluation.worst_case ? *evaluation.worst_case : evaluation.metrics;
    require(metrics, evaluation, judged.violation);
    if (in_detail_) friction_limit(evaluation);
    evaluation.feasible = evaluation.violations.empty();
    if (evaluation.feasible) judged.violation = 0;
    judged.work = work_;
    return judged;
  }

 private:
  // Everything that one set of uncertain values gives; what is not a number goes to the evaluation, if it is given.
  Metrics member_metrics(const Member& member, AssemblyEvaluation* evaluation) {
    Metrics metrics;
    metrics.chamfer_mm = chamfer_mm(spec_, topology_, values_);
    const std::unique_ptr<Scene> scene = scene_of(spec_, topology_, values_, "up", 0, member);
    if (!scene) return metrics;
    success(scene->task, member, metrics, evaluation);
    never(member, metrics, evaluation);
    return metrics;
  }

  void success(const InsertionTask& task, const Member& member, Metrics& metrics, AssemblyEvaluation* evaluation) {
    const StartsSpec& starts = spec_.goal.starts;
    Peaks peaks;
    // Boundaries and scaled boxes ask for corners again and again, and for the only start of a box that is a point.
    std::map<std::array<double, 3>, StartResult> known;
    const auto at = [&](double x, double y, double theta) -> const StartResult& {
      const auto [place, is_new] = known.try_emplace({x, y, theta});
      if (!is_new) return place->second;
      place->second = started(task, x, y, theta);
      peaks.take(place->second.insertion);
      if (projected_ && (evaluation || spec_.robust)) projected_->push_back(projected(place->second, member));
      ++work_;
      return place->second;
    };
    const auto outcome_at = [&](double x, double y, double theta) {
      const Insertion& insertion = at(x, y, theta).insertion;
      return StartOutcome{static_cast<int>(insertion.outcome), insertion.history};
    };
    const StartShares shares = shares_of_starts(starts, static_cast<int>(InsertionOutcome::Assembled), outcome_at,
                                                in_detail_ ? RegionOptions{} : search_region_options());
    if (evaluation) {
      evaluation->regions = shares.regions;
      evaluation->region_y_mm = shares.y_mm;
      evaluation->starts = grid(starts, in_detail_ ? 5 : 3, at);
    }
    metrics.success_fraction = shares.share;
    if (!starts.x_mm.is_single()) metrics.capture_mm = shares.scaled_box * (starts.x_mm.max - starts.x_mm.min) / 2;
    if (!starts.theta_rad.is_single())
      metrics.capture_deg =
          shares.scaled_box * (starts.theta_rad.max - starts.theta_rad.min) / 2 * 180 / std::numbers::pi;
    metrics.peak_force_n = peaks.axial_n;
    metrics.peak_lateral_force_n = peaks.lateral_n;
    metrics.work_nmm = peaks.work_nmm;
  }

  void never(const Member& member, Metrics& metrics, AssemblyEvaluation* evaluation) {
    for (const NeverSpec& goal : spec_.goal.never) {
      const std::vector<std::string> aspects = goal.aspect == "any" && spec_.part.flips
                                                   ? std::vector<std::string>{"up", "down"}
                                               : goal.aspect == "any" ? std::vector<std::string>{"up"}
                                                                      : std::vector<std::string>{goal.aspect};
      for (const std::string& aspect : aspects) {
        const std::unique_ptr<Scene> scene = scene_of(spec_, topology_, values_, aspect, goal.orientation_rad, member);
        if (!scene) continue;
        NeverResult result = wrong(*scene, goal);
        result.aspect = aspect;
        const double margin = spec_.goal.depth_mm - result.deepest.insertion.deepest_mm;
        metrics.depth_margin_mm = std::min(metrics.depth_margin_mm.value_or(margin), margin);
        if (evaluation) evaluation->never.push_back(std::move(result));
      }
    }
  }

  // Depth alone counts, wherever the wrong part stands; its deepest way is the adverse one.
  NeverResult wrong(Scene& scene, const NeverSpec& goal) {
    constexpr double kAnywhere = 1e9;
    scene.task.goal = {spec_.goal.depth_mm, kAnywhere, kAnywhere};
    const StartsSpec& starts = goal.starts ? *goal.starts : spec_.goal.starts;
    NeverResult result;
    result.orientation_rad = goal.orientation_rad;
    result.box = starts;
    const std::vector<StartResult> ends = grid(
        starts, in_detail_ ? 9 : 3, [&](double x, double y, double theta) { return started(scene.task, x, y, theta); });
    result.starts = static_cast<int>(ends.size());
    work_ += result.starts;
    result.deepest = *std::max_element(ends.begin(), ends.end(), [](const StartResult& a, const StartResult& b) {
      return a.insertion.deepest_mm < b.insertion.deepest_mm;
    });
    result.holds = result.deepest.insertion.deepest_mm < spec_.goal.depth_mm - kWithin_mm;
    if (!in_detail_ || !result.holds) return result;
    const StartBox box{starts.x_mm.min, starts.x_mm.max,      starts.y_mm.min,
                       starts.y_mm.max, starts.theta_rad.min, starts.theta_rad.max};
    const Exclusion exclusion = deepest_reachable(scene.task, box, spec_.goal.depth_mm);
    result.proved = exclusion.proved;
    if (exclusion.proved) result.bound_mm = exclusion.bound_mm;
    result.why = exclusion.why;
    return result;
  }

  void worst_case(AssemblyEvaluation& evaluation) {
    judge_worst_case(spec_, "center_mm", objective, evaluation, [&](const Member& member, Metrics& worst) {
      const Metrics metrics = member_metrics(member, nullptr);
      take_worse(worst, metrics);
      return metrics;
    });
  }

  static void take_worse(Metrics& worst, const Metrics& other) {
    const auto least = [](std::optional<double>& a, const std::optional<double>& b) {
      if (a && b) a = std::min(*a, *b);
    };
    worst.success_fraction = std::min(worst.success_fraction, other.success_fraction);
    least(worst.capture_mm, other.capture_mm);
    least(worst.capture_deg, other.capture_deg);
    least(worst.depth_margin_mm, other.depth_margin_mm);
    worst.peak_force_n = std::max(worst.peak_force_n, other.peak_force_n);
    worst.peak_lateral_force_n = std::max(worst.peak_lateral_force_n, other.peak_lateral_force_n);
    worst.work_nmm = std::max(worst.work_nmm, other.work_nmm);
  }

  void require(const Metrics& metrics, AssemblyEvaluation& evaluation, double& violation) const {
    const auto add = [&](const std::string& what, const std::string& where, double by) {
      evaluation.violations.push_back({what, where, by});
      violation += by;
    };
    if (!(metrics.success_fraction > 0)) {
      double deepest = 0;
      for (const StartResult& start : evaluation.starts) deepest = std::max(deepest, start.insertion.deepest_mm);
      add("no start ends assembled", "/goal/starts", 1 + std::max(0.0, spec_.goal.depth_mm - deepest));
    }
    for (std::size_t i = 0; i < evaluation.never.size(); ++i) {
      const NeverResult& result = evaluation.never[i];
      if (result.holds) continue;
      const double by = std::max(kWithin_mm, result.deepest.insertion.deepest_mm - spec_.goal.depth_mm + 1);
      add("a part held wrongly (" + result.aspect + ") reaches the depth", "/goal/never", by);
    }
    judge_bounds(
        spec_.bounds, [&](const std::string& metric) { return objective(metrics, metric); }, add);
  }

  // Where starts that assemble no longer do when friction grows: halved down, among the corners of the box.
  void friction_limit(AssemblyEvaluation& evaluation) {
    const std::unique_ptr<Scene> scene = scene_of(spec_, topology_, values_, "up", 0);
    std::vector<StartResult> assembled;
    for (const StartResult& start : evaluation.starts) {
      if (start.insertion.outcome == InsertionOutcome::Assembled) assembled.push_back(start);
    }
    const auto failure = [&](double friction) -> std::optional<InsertionOutcome> {
      scene->task.friction = friction;
      for (const StartResult& start : assembled) {
        const StartResult now = started(scene->task, start.x_mm, start.y_mm, start.theta_rad);
        ++work_;
        if (now.insertion.outcome != InsertionOutcome::Assembled) return now.insertion.outcome;
      }
      return std::nullopt;
    };
    if (assembled.empty()) return;
    double low = scene->task.friction, high = low;
    std::optional<InsertionOutcome> as;
    for (double step = 0.1; step < 4 && !as; step *= 2) {
      high = low + step;
      as = failure(high);
      if (!as) low = high;
    }
    if (!as) return;
    for (int i = 0; i < 12; ++i) {
      const double middle = (low + high) / 2;
      if (const auto now = failure(middle)) {
        high = middle;
        as = now;
      } else {
        low = middle;
      }
    }
    evaluation.fails_at_friction = high;
    evaluation.fails_as = as;
  }

  const AssemblySpec& spec_;
  int topology_;
  std::span<const double> values_;
  bool in_detail_;
  std::vector<ProjectedStart>* projected_;
  std::int64_t work_ = 0;
};

}  // namespace

double objective(const Metrics& metrics, const std::string& name) {
  if (name == "success_fraction") return metrics.success_fraction;
  if (name == "capture_mm") return metrics.capture_mm.value_or(0);
  if (name == "capture_deg") return metrics.capture_deg.value_or(0);
  if (name == "chamfer_mm") return metrics.chamfer_mm;
  if (name == "depth_margin_mm") return metrics.depth_margin_mm.value_or(0);
  if (name == "peak_force_n") return metrics.peak_force_n;
  if (name == "peak_lateral_force_n") return metrics.peak_lateral_force_n;
  return metrics.work_nmm;
}

ProjectedStart projected_start(const InsertionTask& task, const ProjectedStart& start) {
  return projected(started(task, start.x_mm, start.y_mm, start.theta_rad), start.member);
}

double chamfer_mm(const AssemblySpec& spec, int topology, std::span<const double> values) {
  if (const auto& own = spec.designs[static_cast<std::size_t>(topology)].chamfer_mm) return (*own)(values);
  return measured_chamfer_mm(joint_of(spec, topology, values), spec.approach.direction_rad);
}

Judged judge(const AssemblySpec& spec, int topology, std::span<const double> values, bool in_detail,
             std::vector<ProjectedStart>* starts) {
  return DesignJudge(spec, topology, values, in_detail, starts).run();
}

}  // namespace formotion::assembly
