// What problems of several kinds ask in the same words: uncertain numbers, boxes of starts, bounds on metrics.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "analysis/geometry/polygon.hpp"
#include "problem/affine.hpp"

namespace formotion {

// A number of a file that may be uncertain: its value, and the interval where it is [min, max] there (value: the
// middle).
struct Number {
  Affine value;
  std::optional<std::pair<double, double>> interval;
};

struct ErrorInterval {
  double min = 0, max = 0;
  bool is_single() const { return min == max; }
  double middle() const { return (min + max) / 2; }
};

// Errors of a start.
struct StartsSpec {
  ErrorInterval x_mm, y_mm, theta_rad;
};

// Bounds that feasible designs keep, by metric's name: {"success_fraction": {"min": 1}}.
struct Bound {
  std::string metric;
  std::optional<double> min, max;
};

// What may differ from what is drawn, about shapes that are fixed.
struct ShapeUncertainty {
  double outline_mm = 0, feature_mm = 0;                       // half-widths
  double centre_mm = 0;                                        // of the part's reference point, each way
  std::map<std::string, std::pair<double, double>> intervals;  // by the environment's keys: "friction", ...
  bool any() const { return outline_mm > 0 || feature_mm > 0 || centre_mm > 0 || !intervals.empty(); }
};

// What uncertain quantities are worth in one judgement; nominal: none given, nothing grown.
struct Member {
  std::string name;                      // of what differs from nominal; empty: nothing
  std::map<std::string, double> values;  // of intervals
  double grow_mm = 0;                    // of the fixed shapes
  Point centre_off_mm = Point::Zero();   // of the part's reference point

  double value_of(const std::string& key, double nominal) const {
    const auto given = values.find(key);
    return given == values.end() ? nominal : given->second;
  }
};

}  // namespace formotion
