// Starts of an assembly that scoring did not look at: both sides of every boundary of the region, dense and random
// ones in the box, in the capture box, and of parts held wrongly.
#include <algorithm>
#include <cmath>

#include "applications/assembly/judge.hpp"
#include "verify/checks.hpp"

namespace formotion {
namespace {

using namespace assembly;

constexpr double kInside = 1e-6;  // of the row: how far inside of its boundaries a row is tried
constexpr int kInsideStarts = 4;  // random ones in every interval of a row
constexpr int kSide = 21;         // of the jittered grid over the box; of the capture box's
constexpr int kWrongSide = 13;
constexpr double kShare = 0.01;   // of the box, beside four standard errors
constexpr double kBounds = 1e-2;  // of a bound of forces or work: the largest value found is one of samples alone
constexpr double kDepth_mm = 1e-6;
constexpr double kSlivers = 0.01;  // of the starts on rows: regions miss what is narrow (docs/exclusion.md)
constexpr std::uint64_t kPurpose = 0x6a6f696e74737461;  // of random numbers: starts

double within(double from, double to, double share) { return from + share * (to - from); }

class Starts {
 public:
  Starts(const TestedJoint& joint, std::uint64_t seed, Check& check)
      : joint_(joint),
        check_(check),
        scene_(joint.scene()),
        random_(seed, kPurpose, static_cast<std::uint64_t>(joint.stored.number)) {}

  void run() {
    const AssemblyEvaluation& evaluation = joint_.evaluation;
    for (std::size_t i = 0; i < evaluation.regions.size(); ++i) {
      rows(evaluation.regions[i], evaluation.region_y_mm[i]);
    }
    slivers();
    for (std::size_t i = 0; i < evaluation.regions.size(); ++i) box(evaluation.regions[i], evaluation.region_y_mm[i]);
    capture();
    for (const NeverResult& wrong : evaluation.never) {
      if (wrong.holds) never(wrong);
    }
    bounds();
    check_.worst = apart_;
    check_.worst_of = "of the box, between the share that assembles and the one of these starts";
  }

 private:
  InsertionOutcome ended(double x_mm, double y_mm, double theta_rad) {
    const Insertion found = insert(scene_->task, start_with_errors(scene_->task, x_mm, y_mm, theta_rad));
    ++check_.count;
    peak_n_ = std::max(peak_n_, found.peak_axial_n);
    lateral_n_ = std::max(lateral_n_, found.peak_lateral_n);
    work_nmm_ = std::max(work_nmm_, found.work_nmm);
    return found.outcome;
  }

  // What is said to assemble does. Of other outcomes a few starts may be in slivers that the region missed.
  void expect(double x_mm, double y_mm, double theta_rad, int outcome, const char* where) {
    const InsertionOutcome now = ended(x_mm, y_mm, theta_rad), claimed = static_cast<InsertionOutcome>(outcome);
    ++expected_;
    if (now == claimed) return;
    const std::string text =
        start_text(x_mm, y_mm, theta_rad) + " is " + name(now) + " in place of " + name(claimed) + ", " + where;
    if (claimed == InsertionOutcome::Assembled) check_.fail(text);
    if (others_++ == 0) first_other_ = text;
  }

  void slivers() {
    if (others_ == 0) return;
    const std::string count = std::to_string(others_) + " of " + std::to_string(expected_) + " starts end otherwise";
    if (others_ > kSlivers * static_cast<double>(expected_)) check_.fail(first_other_ + " (" + count + ")");
    note(count + ", the first: " + first_other_);
  }

  void note(const std::string& text) { check_.note += (check_.note.empty() ? "" : "; ") + text; }

  void rows(const OutcomeRegion& region, double y_mm) {
    const double row_mm = region.box.u_max - region.box.u_min;
    for (const RegionRow& row : region.rows) {
      for (const RegionInterval& interval : row.intervals) {
        const double from = interval.from + kInside * row_mm, to = interval.to - kInside * row_mm;
        if (from > to) continue;
        expect(from, y_mm, row.v, interval.outcome, "at a boundary of its region");
        if (row_mm <= 0) continue;
        expect(to, y_mm, row.v, interval.outcome, "at a boundary of its region");
        for (int k = 0; k < kInsideStarts; ++k)
          expect(within(from, to, random_.uniform()), y_mm, row.v, interval.outcome, "inside of its region");
      }
    }
  }

  // The share that assembles, by one random start in every cell of a grid. Its standard error is at most that of
  // independent starts.
  void box(const OutcomeRegion& region, double y_mm) {
    const ErrorBox& whole = region.box;
    const int across = whole.u_max > whole.u_min ? kSide : 1, turned = whole.v_max > whole.v_min ? kSide : 1;
    int assembled = 0;
    for (int i = 0; i < across; ++i) {
      for (int k = 0; k < turned; ++k) {
        const double u = (i + random_.uniform()) / across, v = (k + random_.uniform()) / turned;
        assembled += ended(within(whole.u_min, whole.u_max, u), y_mm, within(whole.v_min, whole.v_max, v)) ==
                     InsertionOutcome::Assembled;
      }
    }
    const double n = across * turned, share = assembled / n;
    const double claimed = share_of(region, static_cast<int>(InsertionOutcome::Assembled));
    const double apart = std::abs(share - claimed);
    apart_ = std::max(apart_, apart);
    if (apart > kShare + 4 * std::sqrt(claimed * (1 - claimed) / n))
      check_.fail("of " + number_text(n) + " starts " + number_text(100 * share) + " % assemble in place of " +
                  number_text(100 * claimed) + " %");
  }

  // All of it is said to assemble: a grid with its sides and corners, and as many random starts.
  void capture() {
    const StartsSpec& starts = joint_.spec().goal.starts;
    const Metrics& metrics = joint_.evaluation.metrics;
    double share = 1 - kInside;
    if (metrics.capture_mm) {
      share *= *metrics.capture_mm / ((starts.x_mm.max - starts.x_mm.min) / 2);
    } else if (metrics.capture_deg) {
      share *= *metrics.capture_deg * std::acos(-1.0) / 180 / ((starts.theta_rad.max - starts.theta_rad.min) / 2);
    } else {
      return;  // a single start, which the rows have
    }
    if (!(share > 0)) return;
    const auto at = [&](const ErrorInterval& interval, double place) {
      return (interval.min + interval.max) / 2 + share * (place - 0.5) * (interval.max - interval.min);
    };
    const int across = starts.x_mm.is_single() ? 1 : kSide, turned = starts.theta_rad.is_single() ? 1 : kSide;
    const std::vector<double>& ys = joint_.evaluation.region_y_mm;
    const int assembled = static_cast<int>(InsertionOutcome::Assembled);
    for (int i = 0; i < across; ++i) {
      for (int k = 0; k < turned; ++k) {
        const double u = across > 1 ? static_cast<double>(i) / (across - 1) : 0.5,
                     v = turned > 1 ? static_cast<double>(k) / (turned - 1) : 0.5;
        expect(at(starts.x_mm, u), ys[static_cast<std::size_t>(i + k) % ys.size()], at(starts.theta_rad, v), assembled,
               "in the capture box");
        const double x = random_.uniform(), theta = random_.uniform(), y = random_.uniform();
        expect(at(starts.x_mm, x), within(starts.y_mm.min, starts.y_mm.max, y), at(starts.theta_rad, theta), assembled,
               "in the capture box");
      }
    }
  }

  void never(const NeverResult& wrong) {
    const std::unique_ptr<Scene> held = joint_.scene(wrong);
    const double goal_mm = joint_.spec().goal.depth_mm;
    const double limit_mm = wrong.proved ? std::min(goal_mm, wrong.bound_mm.value_or(goal_mm)) : goal_mm;
    const auto deep = [&](double x_mm, double y_mm, double theta_rad) {
      const Insertion found = insert(held->task, start_with_errors(held->task, x_mm, y_mm, theta_rad));
      ++check_.count;
      if (found.deepest_mm > limit_mm - (wrong.proved ? -kDepth_mm : kDepth_mm))
        check_.fail(never_text(wrong) + ", " + start_text(x_mm, y_mm, theta_rad) + ", gets " +
                    number_text(found.deepest_mm) + " mm deep, where " + number_text(limit_mm) + " mm is the limit");
    };
    const StartsSpec& box = wrong.box;
    const auto side = [](const ErrorInterval& interval) { return interval.is_single() ? 1 : kWrongSide; };
    for (int i = 0; i < side(box.x_mm); ++i) {
      for (int k = 0; k < side(box.theta_rad); ++k) {
        const double u = (i + random_.uniform()) / side(box.x_mm), v = (k + random_.uniform()) / side(box.theta_rad);
        deep(within(box.x_mm.min, box.x_mm.max, u), within(box.y_mm.min, box.y_mm.max, random_.uniform()),
             within(box.theta_rad.min, box.theta_rad.max, v));
      }
    }
  }

  // What the problem asks of the worst start is asked of these, too.
  void bounds() {
    Metrics found = joint_.evaluation.metrics;
    if (peak_n_ > found.peak_force_n * (1 + 1e-9))
      note("a force of " + number_text(peak_n_) + " N, where scoring found " + number_text(found.peak_force_n) +
           " N at most");
    found.peak_force_n = peak_n_;
    found.peak_lateral_force_n = lateral_n_;
    found.work_nmm = work_nmm_;
    for (const Bound& bound : joint_.spec().bounds) {
      const bool of_starts =
          bound.metric == "peak_force_n" || bound.metric == "peak_lateral_force_n" || bound.metric == "work_nmm";
      if (!of_starts || !bound.max || !joint_.evaluation.feasible) continue;
      const double value = objective(found, bound.metric);
      if (value > *bound.max * (1 + kBounds))
        check_.fail(bound.metric + " is " + number_text(value) + " for one of the starts, above its bound of " +
                    number_text(*bound.max));
    }
  }

  const TestedJoint& joint_;
  Check& check_;
  std::unique_ptr<Scene> scene_;
  RandomStream random_;
  std::int64_t expected_ = 0, others_ = 0;
  std::string first_other_;
  double apart_ = 0, peak_n_ = 0, lateral_n_ = 0, work_nmm_ = 0;
};

}  // namespace

Check check_starts(const TestedJoint& joint, const VerifyOptions& options) {
  Check check{"starts"};
  check.unit = "starts";
  Starts(joint, options.seed, check).run();
  return check;
}

}  // namespace formotion
