#include "analysis/motion/outcome_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace formotion {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

struct Sample {
  double theta;
  StartOutcome found;
};

// Samples between a and b (exclusive) that the boundaries between them need, ascending.
class Refiner {
 public:
  Refiner(const std::function<StartOutcome(double)>& at, const OutcomeMapOptions& options, std::vector<Sample>& out)
      : at_(at), options_(options), out_(out) {}

  void between(const Sample& a, const Sample& b) {
    const double width = b.theta - a.theta;
    const bool same = a.found.outcome == b.found.outcome;
    if (same && (a.found.history == b.found.history || width <= options_.history_rad)) return;
    if (width <= options_.boundary_rad) return;
    const double middle = a.theta + width / 2;
    if (!(middle > a.theta && middle < b.theta)) return;
    const Sample found = take(middle);
    between(a, found);
    out_.push_back(found);
    between(found, b);
  }
  Sample take(double theta) {
    ++count;
    return {theta, at_(theta >= kTurn ? theta - kTurn : theta)};
  }
  int count = 0;

 private:
  const std::function<StartOutcome(double)>& at_;
  const OutcomeMapOptions& options_;
  std::vector<Sample>& out_;
};

}  // namespace

OutcomeMap outcome_map(const std::function<StartOutcome(double)>& at, std::span<const double> critical,
                       const OutcomeMapOptions& options) {
  std::vector<double> starts;
  const int count = std::max(1, static_cast<int>(std::ceil(kTurn / options.grid_rad)));
  for (int i = 0; i < count; ++i) starts.push_back(kTurn * i / count);
  for (const double theta : critical) {
    for (const double side : {-0.5, 0.5}) {
      double wrapped = std::fmod(theta + side * options.boundary_rad, kTurn);
      if (wrapped < 0) wrapped += kTurn;
      if (wrapped < kTurn) starts.push_back(wrapped);
    }
  }
  std::sort(starts.begin(), starts.end());
  starts.erase(std::unique(starts.begin(), starts.end()), starts.end());

  std::vector<Sample> samples;
  Refiner refiner(at, options, samples);
  Sample last = refiner.take(starts.front());
  const Sample first = last;
  samples.push_back(last);
  for (std::size_t i = 1; i < starts.size(); ++i) {
    const Sample next = refiner.take(starts[i]);
    refiner.between(last, next);
    samples.push_back(next);
    last = next;
  }
  refiner.between(last, {first.theta + kTurn, first.found});

  // Runs of one outcome; each boundary is the middle between the samples beside it.
  OutcomeMap map;
  map.starts = refiner.count;
  struct Run {
    std::size_t from, to;
  };
  std::vector<Run> runs;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!runs.empty() && samples[runs.back().from].found.outcome == samples[i].found.outcome) {
      runs.back().to = i;
    } else {
      runs.push_back({i, i});
    }
  }
  if (runs.size() == 1) {
    map.intervals.push_back({0, kTurn, samples.front().found.outcome, samples.front().theta, false});
    return map;
  }
  const bool wraps = samples[runs.front().from].found.outcome == samples[runs.back().from].found.outcome;
  const double end = samples.front().theta + kTurn;
  const std::size_t intervals = runs.size() - (wraps ? 1 : 0);
  const auto boundary = [&](std::size_t after) {  // between run `after` and the next one
    return (samples[runs[after].to].theta + samples[runs[after + 1].from].theta) / 2;
  };
  const double closing = (samples.back().theta + end) / 2;  // between the last run and the first
  const double seam = closing >= kTurn ? closing - kTurn : closing;
  for (std::size_t i = 0; i < intervals; ++i) {
    // Where the first and the last run are one, it is the last interval and wraps.
    const std::size_t run = wraps ? i + 1 : i;
    OutcomeInterval interval;
    interval.outcome = samples[runs[run].from].found.outcome;
    const std::size_t middle = (runs[run].from + runs[run].to) / 2;
    interval.sample_rad = samples[middle].theta;
    interval.from_rad = run == 0 ? seam : boundary(run - 1);
    interval.to_rad = run + 1 < runs.size() ? boundary(run) : wraps ? boundary(0) : seam;
    double width = interval.to_rad - interval.from_rad;
    if (width < 0) width += kTurn;
    interval.thin = width <= 2 * options.boundary_rad;
    map.intervals.push_back(interval);
  }
  // Ascending from the least beginning on.
  const auto least = std::min_element(map.intervals.begin(), map.intervals.end(),
                                      [](const auto& a, const auto& b) { return a.from_rad < b.from_rad; });
  std::rotate(map.intervals.begin(), least, map.intervals.end());
  return map;
}

namespace {

class SetLooker {
 public:
  SetLooker(const std::function<StartOutcome(std::span<const double>)>& at) : at_(at) {}

  void box(std::vector<std::pair<double, double>> sides, int depth) {
    const std::size_t n = sides.size();
    // Corners, middles of faces, the middle: every member with each coordinate low, middle or high, unless there are
    // too many; then corners and the middle.
    std::vector<int> digits(n, 0);
    std::vector<std::uint64_t> histories;
    const int levels = n <= 3 ? 3 : 2;
    for (;;) {
      std::vector<double> member(n);
      for (std::size_t i = 0; i < n; ++i) {
        const auto [low, high] = sides[i];
        member[i] = digits[i] == 0 ? low : digits[i] == 1 ? high : (low + high) / 2;
      }
      histories.push_back(look(member));
      if (result.a.size()) return;
      std::size_t i = 0;
      while (i < n && (++digits[i] == levels || sides[i].first == sides[i].second)) digits[i++] = 0;
      if (i == n) break;
    }
    const bool same = std::all_of(histories.begin(), histories.end(), [&](auto h) { return h == histories.front(); });
    if (same || depth == 0) return;
    for (int part = 0; part < (1 << n); ++part) {
      std::vector<std::pair<double, double>> half = sides;
      bool is_new = true;
      for (std::size_t i = 0; i < n; ++i) {
        const double middle = (sides[i].first + sides[i].second) / 2;
        if (part >> i & 1) {
          half[i].first = middle;
          is_new = is_new && sides[i].first < sides[i].second;
        } else {
          half[i].second = middle;
        }
      }
      if (is_new) box(half, depth - 1);
      if (result.a.size()) return;
    }
  }
  SetOutcome result;

 private:
  std::uint64_t look(const std::vector<double>& member) {
    const StartOutcome found = at_(member);
    ++result.members;
    if (!first_) {
      first_ = found;
      first_member_ = member;
    } else if (found.outcome != first_->outcome) {
      result.a = first_member_;
      result.b = member;
    }
    result.outcome = first_->outcome;
    return found.history;
  }
  const std::function<StartOutcome(std::span<const double>)>& at_;
  std::optional<StartOutcome> first_;
  std::vector<double> first_member_;
};

}  // namespace

SetOutcome outcome_of_set(const std::function<StartOutcome(std::span<const double>)>& at,
                          std::span<const std::pair<double, double>> box, int depth) {
  SetLooker looker(at);
  looker.box({box.begin(), box.end()}, depth);
  looker.result.is_one = looker.result.a.empty();
  return looker.result;
}

}  // namespace formotion
