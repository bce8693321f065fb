#include "analysis/insertion/success_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace formotion {
namespace {

using At = std::function<StartOutcome(double u, double v)>;

struct Sample {
  double at = 0;
  StartOutcome found;
};

// Samples of a line between two ends, close together where outcomes change. The line's starts are projected by `at`.
class LineScan {
 public:
  LineScan(const std::function<StartOutcome(double)>& at, double from, double to, const RegionOptions& options)
      : at_(at), boundary_((to - from) * options.boundary), history_((to - from) * options.history) {
    const int steps = std::max(1, options.starts_a_row - 1);
    samples.push_back({from, at_(from)});
    for (int i = 1; i <= steps; ++i) {
      const double place = i == steps ? to : from + (to - from) * i / steps;
      const Sample last = samples.back(), next{place, at_(place)};
      between(last, next);
      samples.push_back(next);
    }
  }
  std::vector<Sample> samples;

 private:
  void between(const Sample& a, const Sample& b) {
    const double width = b.at - a.at;
    const bool same = a.found.outcome == b.found.outcome;
    if (same && (a.found.history == b.found.history || width <= history_)) return;
    const double middle = a.at + width / 2;
    if (width <= boundary_ || !(middle > a.at && middle < b.at)) return;
    const Sample found{middle, at_(middle)};
    between(a, found);
    samples.push_back(found);
    between(found, b);
  }
  const std::function<StartOutcome(double)>& at_;
  double boundary_, history_;
};

RegionRow row_at(const ErrorBox& box, double v, const At& at, const RegionOptions& options) {
  const std::function<StartOutcome(double)> on_row = [&](double u) { return at(u, v); };
  const LineScan scan(on_row, box.u_min, box.u_max, options);
  RegionRow row{v, {}};
  double last = box.u_min;
  for (const Sample& sample : scan.samples) {
    if (row.intervals.empty()) {
      row.intervals.push_back({box.u_min, box.u_max, sample.found.outcome});
    } else if (row.intervals.back().outcome != sample.found.outcome) {
      const double boundary = last + (sample.at - last) / 2;
      row.intervals.back().to = boundary;
      row.intervals.push_back({boundary, box.u_max, sample.found.outcome});
    }
    last = sample.at;
  }
  return row;
}

// All u are one: a row on each side of every change along v, and the first and the last.
std::vector<RegionRow> rows_of_points(const ErrorBox& box, const At& at, const RegionOptions& options) {
  const std::function<StartOutcome(double)> on_line = [&](double v) { return at(box.u_min, v); };
  const std::vector<Sample> samples = LineScan(on_line, box.v_min, box.v_max, options).samples;
  std::vector<RegionRow> rows;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const int outcome = samples[i].found.outcome;
    const bool changes = i == 0 || i + 1 == samples.size() || samples[i - 1].found.outcome != outcome ||
                         samples[i + 1].found.outcome != outcome;
    if (changes) rows.push_back({samples[i].at, {{box.u_min, box.u_min, outcome}}});
  }
  return rows;
}

bool same_sequence(const RegionRow& a, const RegionRow& b) {
  return std::equal(a.intervals.begin(), a.intervals.end(), b.intervals.begin(), b.intervals.end(),
                    [](const auto& one, const auto& other) { return one.outcome == other.outcome; });
}

// The length of u on which two rows have different outcomes.
double mismatch(const RegionRow& a, const RegionRow& b) {
  double length = 0;
  for (std::size_t i = 0, j = 0; i < a.intervals.size() && j < b.intervals.size();) {
    const RegionInterval &one = a.intervals[i], &other = b.intervals[j];
    if (one.outcome != other.outcome) {
      length += std::max(0.0, std::min(one.to, other.to) - std::max(one.from, other.from));
    }
    if (one.to < other.to) {
      ++i;
    } else {
      ++j;
    }
  }
  return length;
}

// How far a row's boundaries are from the middle between those of its neighbours of the same sequence.
double deviation(const RegionRow& a, const RegionRow& middle, const RegionRow& b) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < middle.intervals.size(); ++i) {
    most = std::max(most, std::abs(middle.intervals[i].to - (a.intervals[i].to + b.intervals[i].to) / 2));
  }
  return most;
}

// Rows of the whole box. gaps_[i] is what is wrong between rows i and i + 1, as a share of the box's area: 0 where
// nothing is left to do.
class RowRefiner {
 public:
  RowRefiner(const ErrorBox& box, const At& at, const RegionOptions& options) : box_(box), at_(at), options_(options) {
    const int steps = std::max(2, options.rows) - 1;
    for (int i = 0; i <= steps; ++i) {
      rows.push_back(row(i == steps ? box.v_max : box.v_min + (box.v_max - box.v_min) * i / steps));
    }
    gaps_.assign(steps, std::numeric_limits<double>::infinity());
    while (static_cast<int>(rows.size()) < options.most_rows) {
      const auto worst = std::max_element(gaps_.begin(), gaps_.end());
      if (*worst == 0) break;
      split(static_cast<std::size_t>(worst - gaps_.begin()));
    }
  }
  std::vector<RegionRow> rows;

 private:
  RegionRow row(double v) const { return row_at(box_, v, at_, options_); }

  void split(std::size_t gap) {
    const double low = rows[gap].v, high = rows[gap + 1].v, v = low + (high - low) / 2;
    if (!(v > low && v < high)) {
      gaps_[gap] = 0;
      return;
    }
    const RegionRow middle = row(v);
    const RegionRow &a = rows[gap], &b = rows[gap + 1];
    const double width = box_.u_max - box_.u_min, height = (v - low) / (box_.v_max - box_.v_min);
    // Of neighbours of one sequence it is known how badly the last ones predicted; else all that differs may be wrong.
    const double unpredicted =
        same_sequence(a, middle) && same_sequence(middle, b) ? deviation(a, middle, b) / width : 1;
    const auto wrong = [&](const RegionRow& below, const RegionRow& above) {
      if (same_sequence(below, above)) return unpredicted <= options_.row_error ? 0 : height * unpredicted;
      const double area = height * mismatch(below, above) / width;
      return area <= options_.row_error ? 0 : area;
    };
    const double lower = wrong(a, middle), upper = wrong(middle, b);
    rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(gap) + 1, middle);
    gaps_[gap] = lower;
    gaps_.insert(gaps_.begin() + static_cast<std::ptrdiff_t>(gap) + 1, upper);
  }

  const ErrorBox& box_;
  const At& at_;
  const RegionOptions& options_;
  std::vector<double> gaps_;
};

double share_of_row(const OutcomeRegion& region, const RegionRow& row, int outcome) {
  const double width = region.box.u_max - region.box.u_min;
  if (width <= 0) return row.intervals.front().outcome == outcome ? 1 : 0;
  double length = 0;
  for (const RegionInterval& interval : row.intervals) {
    if (interval.outcome == outcome) length += interval.to - interval.from;
  }
  return length / width;
}

}  // namespace

OutcomeRegion outcome_region(const ErrorBox& box, const At& at, const RegionOptions& options) {
  OutcomeRegion region{box, {}, 0};
  const At counted = [&](double u, double v) {
    ++region.starts;
    return at(u, v);
  };
  const bool one_u = box.u_min >= box.u_max, one_v = box.v_min >= box.v_max;
  if (one_u && one_v) {
    region.rows.push_back({box.v_min, {{box.u_min, box.u_min, counted(box.u_min, box.v_min).outcome}}});
  } else if (one_u) {
    region.rows = rows_of_points(box, counted, options);
  } else if (one_v) {
    region.rows.push_back(row_at(box, box.v_min, counted, options));
  } else {
    region.rows = RowRefiner(box, counted, options).rows;
  }
  return region;
}

double share_of(const OutcomeRegion& region, int outcome) {
  const std::vector<RegionRow>& rows = region.rows;
  if (rows.size() == 1) return share_of_row(region, rows.front(), outcome);
  double area = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const double mean = (share_of_row(region, rows[i], outcome) + share_of_row(region, rows[i + 1], outcome)) / 2;
    area += mean * (rows[i + 1].v - rows[i].v);
  }
  return std::min(1.0, area / (region.box.v_max - region.box.v_min));  // sums of rounded pieces
}

}  // namespace formotion
