#include "analysis/constraints/hull_margin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace formotion {
namespace {

bool before(const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); }

constexpr std::size_t kFew = 16;  // sorted by insertion even without an order to begin with

// Insertion sort: the order is kept between calls and changes little.
void sort_by_x(std::span<const Point> points, std::vector<int>& order) {
  for (std::size_t i = 1; i < order.size(); ++i) {
    const int moving = order[i];
    std::size_t k = i;
    for (; k > 0 && before(points[moving], points[order[k - 1]]); --k) order[k] = order[k - 1];
    order[k] = moving;
  }
}

// Andrew's monotone chain over sorted points; indices of the hull, counter-clockwise.
int hull_indices(std::span<const Point> points, std::span<const int> order, int* hull) {
  int size = 0;
  const auto turns_left = [&](int a, int b, int c) { return cross(points[b] - points[a], points[c] - points[a]) > 0; };
  const int n = static_cast<int>(order.size());
  for (int i = 0; i < n; ++i) {
    while (size >= 2 && !turns_left(hull[size - 2], hull[size - 1], order[i])) --size;
    hull[size++] = order[i];
  }
  const int lower = size + 1;
  for (int i = n - 2; i >= 0; --i) {
    while (size >= lower && !turns_left(hull[size - 2], hull[size - 1], order[i])) --size;
    hull[size++] = order[i];
  }
  return size > 1 ? size - 1 : size;
}

// Edges shorter than this join points that are one but for rounding: their direction means nothing.
constexpr double kShortest_mm = 1e-9;

HullMargin outside(std::span<const Point> points, const int* hull, int size) {
  // The nearest edge as a segment; at a corner both of its edges are candidates.
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < size; ++k) {
    nearest = std::min(nearest, distance_to_segment(Point::Zero(), points[hull[k]], points[hull[(k + 1) % size]]));
  }
  HullMargin result{-nearest, hull[0], hull[0], true, -1, -1};
  double farthest = -std::numeric_limits<double>::infinity();
  const double tie = 1e-9 * (1 + nearest);
  for (int k = 0; k < size; ++k) {
    const Point& p = points[hull[k]];
    const Point& q = points[hull[(k + 1) % size]];
    const double length = (q - p).norm();
    if (length < kShortest_mm || distance_to_segment(Point::Zero(), p, q) > nearest + tie) continue;
    const double beyond = -cross(p, q) / length;
    if (beyond > farthest + tie) {
      farthest = beyond;
      result = {-nearest, hull[k], hull[(k + 1) % size], beyond < nearest - tie, -1, -1};
    } else if (beyond > farthest - tie) {
      result.other_from = hull[k];
      result.other_to = hull[(k + 1) % size];
    }
  }
  return result;
}

}  // namespace

void hull_of_sorted(std::span<const Point> points, std::span<const int> order, std::vector<int>& hull) {
  hull.resize(2 * order.size() + 2);
  hull.resize(static_cast<std::size_t>(hull_indices(points, order, hull.data())));
}

HullMargin margin_of_hull(std::span<const Point> points, std::span<const int> corners) {
  const int* hull = corners.data();
  const int size = static_cast<int>(corners.size());
  if (size == 1 || (size == 2 && points[hull[0]] == points[hull[1]])) {
    return {-points[hull[0]].norm(), hull[0], hull[0], true, -1, -1};
  }
  if (size == 2) return outside(points, hull, size);
  // Inside, the nearest place of the boundary is the foot of a perpendicular on some edge.
  HullMargin result;
  double least = std::numeric_limits<double>::infinity();  // of signed squared distances
  for (int k = 0; k < size; ++k) {
    const Point& p = points[hull[k]];
    const Point& q = points[hull[k + 1 == size ? 0 : k + 1]];
    const Point along = q - p;
    const double squared_length = along.squaredNorm();
    if (squared_length < kShortest_mm * kShortest_mm) continue;
    const double area = cross(p, along);
    if (area < 0) return outside(points, hull, size);
    const double foot = -p.dot(along);
    if (foot < 0 || foot > squared_length) continue;
    const double squared = area * area / squared_length;
    if (squared < least) {
      least = squared;
      result.from = hull[k];
      result.to = hull[k + 1 == size ? 0 : k + 1];
    }
  }
  if (result.from < 0) return outside(points, hull, size);  // on a corner, but for rounding
  result.margin_mm = std::sqrt(least);
  return result;
}

HullMargin hull_margin(std::span<const Point> points, std::vector<int>& order) {
  if (order.size() != points.size()) {
    order.resize(points.size());
    std::iota(order.begin(), order.end(), 0);
    if (order.size() > kFew) {
      std::sort(order.begin(), order.end(), [&](int a, int b) { return before(points[a], points[b]); });
    }
  }
  sort_by_x(points, order);
  thread_local std::vector<int> hull;
  hull_of_sorted(points, order, hull);
  return margin_of_hull(points, hull);
}

HullMargin hull_margin(std::span<const Point> points) {
  std::vector<int> order;
  return hull_margin(points, order);
}

}  // namespace formotion
