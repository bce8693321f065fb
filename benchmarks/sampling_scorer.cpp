#include "sampling_scorer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace formotion::bench {
namespace {

bool inside(const Loop& loop, double x, double y) {
  bool in = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    if ((loop[i].y() > y) != (loop[j].y() > y) &&
        x < (loop[j].x() - loop[i].x()) * (y - loop[i].y()) / (loop[j].y() - loop[i].y()) + loop[i].x()) {
      in = !in;
    }
  }
  return in;
}

// Signed distance of the origin to the boundary of the hull of points; scratch is sorted and overwritten.
double signed_distance(std::vector<Point>& points, std::vector<Point>& hull) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  hull.clear();
  const auto push = [&hull](const Point& p, std::size_t base) {
    while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0) hull.pop_back();
    hull.push_back(p);
  };
  for (const Point& p : points) push(p, 0);
  const std::size_t base = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) push(points[i], base);
  double least = std::numeric_limits<double>::infinity();
  bool in = hull.size() > 3;
  for (std::size_t i = 0; i + 1 < hull.size(); ++i) {
    in = in && cross(hull[i], hull[i + 1]) >= 0;
    least = std::min(least, distance_to_segment(Point::Zero(), hull[i], hull[i + 1]));
  }
  return in ? least : -least;
}

}  // namespace

SampledScore SamplingScorer::travel(const feeder::PoseModel& pose, const std::vector<Loop>& voids, double step,
                                    bool stop) {
  const TravellingPart& part = pose.travelling;
  Box box;
  for (const Loop& loop : voids) {
    for (const Point& p : loop) box.include(p);
  }
  SampledScore score{part.plain_margin_mm < 0, part.plain_margin_mm};
  const double from = box.min.x() - pose.x_max, to = box.max.x() - pose.x_min, dy = part.supported_y_mm;
  for (double x = from; x <= to; x += step) {
    ++samples_;
    points_.clear();
    for (const Point& corner : part.corners) {
      const bool over = std::any_of(voids.begin(), voids.end(),
                                    [&](const Loop& loop) { return inside(loop, corner.x() + x, corner.y() + dy); });
      if (!over) points_.push_back(corner);
    }
    for (const Loop& loop : voids) {
      for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
        const double ax = loop[j].x() - x, ay = loop[j].y() - dy, bx = loop[i].x() - x, by = loop[i].y() - dy;
        if (std::max(ax, bx) < pose.x_min || std::min(ax, bx) > pose.x_max) continue;
        const double y_min = std::min(ay, by), y_max = std::max(ay, by);
        bool in = false;  // the void's corner under the part
        for (const EdgeSet::Edge& edge : part.edges.edges) {
          if ((edge.a.y() > by) != (edge.b.y() > by) && bx < edge.a.x() + (by - edge.a.y()) * edge.dx_dy) in = !in;
          if (edge.y_max < y_min || edge.y_min > y_max) continue;
          const double ex = edge.b.x() - edge.a.x(), ey = edge.b.y() - edge.a.y(), dx = bx - ax, dyy = by - ay;
          const double det = ex * dyy - ey * dx;
          if (det == 0) continue;
          const double t = ((ax - edge.a.x()) * dyy - (ay - edge.a.y()) * dx) / det;
          const double s = ((ax - edge.a.x()) * ey - (ay - edge.a.y()) * ex) / det;
          if (t >= 0 && t <= 1 && s >= 0 && s <= 1) points_.emplace_back(edge.a.x() + t * ex, edge.a.y() + t * ey);
        }
        if (in) points_.emplace_back(bx, by);
      }
    }
    if (points_.empty()) continue;
    const double margin = points_.size() == 1 ? -points_[0].norm() : signed_distance(points_, hull_);
    score.margin_mm = std::min(score.margin_mm, margin);
    if (margin < 0) {
      score.lost = true;
      if (stop) return score;
    }
  }
  return score;
}

void SamplingScorer::score(const feeder::Layout& layout, double step_mm, bool stop_when_lost,
                           std::vector<SampledScore>& scores) {
  scores.assign(part_.poses.size(), {});
  const std::vector<feeder::VoidGroup> groups = feeder::grouped(layout, part_.longest_mm);
  for (std::size_t i = 0; i < part_.poses.size(); ++i) {
    SampledScore& total = scores[i];
    total.margin_mm = part_.poses[i].travelling.plain_margin_mm;
    for (const feeder::VoidGroup& group : groups) {
      const SampledScore one = travel(part_.poses[i], group.loops, step_mm, stop_when_lost);
      total.lost = total.lost || one.lost;
      total.margin_mm = std::min(total.margin_mm, one.margin_mm);
      if (total.lost && stop_when_lost) break;
    }
  }
}

}  // namespace formotion::bench
