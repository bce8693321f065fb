#include "applications/feeder/active_search.hpp"

#include <array>
#include <limits>

#include "analysis/constraints/hull_margin.hpp"
#include "analysis/contact/clearance.hpp"
#include "applications/feeder/feeder_problem.hpp"

namespace formotion::feeder {
namespace {

constexpr double kSamePlace_mm = 1e-6;  // unions move corners by far less
constexpr double kParallel = 1e-7;      // sine
constexpr double kStationary = 1e-6;    // mm of margin a mm of travel

LineRef horizontal(double y, bool up) { return {LineRef::Kind::Constant, {}, 0, {0, up ? 1.0 : -1.0}, up ? y : -y}; }

double angle_between(const Point& a, const Point& b) { return std::abs(cross(a.normalized(), b.normalized())); }

}  // namespace

const std::vector<TracedLoop<double>>& ActiveSearch::loops(Body body) const {
  return body == Body::Part ? shapes_.part : body == Body::Void ? shapes_.voids : shapes_.obstacles;
}

Point ActiveSearch::world_corner(Body body, const TracedLoop<double>& loop, std::size_t k,
                                 const Configuration& q) const {
  const Point& p = loop.points[k % loop.points.size()];
  return body == Body::Part ? Point(q.position() + rotated(p, q.theta_rad)) : p;
}

std::optional<CornerRef> ActiveSearch::corner_at(Body body, const Point& p, const Configuration& q) const {
  const auto& all = loops(body);
  for (std::size_t l = 0; l < all.size(); ++l) {
    for (std::size_t k = 0; k < all[l].points.size(); ++k) {
      if ((world_corner(body, all[l], k, q) - p).norm() < kSamePlace_mm)
        return CornerRef{body, static_cast<int>(l), static_cast<int>(k)};
    }
  }
  return std::nullopt;
}

std::optional<LineRef> ActiveSearch::edge_at(Body body, const Point& p, const Configuration& q) const {
  const auto& all = loops(body);
  for (std::size_t l = 0; l < all.size(); ++l) {
    for (std::size_t k = 0; k < all[l].points.size() && all[l].points.size() > 1; ++k) {
      const Point from = world_corner(body, all[l], k, q), to = world_corner(body, all[l], k + 1, q);
      if (distance_to_segment(p, from, to) < kSamePlace_mm) {
        return LineRef{LineRef::Kind::Edge, {body, static_cast<int>(l), static_cast<int>(k)}, 0, {0, 1}, 0};
      }
    }
  }
  return std::nullopt;
}

std::optional<GapRef> ActiveSearch::gap_of(const World& world, const ContactPair& pair) const {
  const Configuration own{};  // the part's own frame
  if (pair.kind == ContactKind::EdgeOnCorner) {
    const MovingEdge& edge = world.part.edges[static_cast<std::size_t>(pair.moving)];
    const FixedCorner& corner = world.obstacles.corners[static_cast<std::size_t>(pair.fixed)];
    const auto line = edge_at(Body::Part, 0.5 * (edge.from + edge.to), own);
    const auto at = corner_at(Body::Obstacle, corner.centre, own);
    if (!line || !at) return std::nullopt;
    return GapRef{{*at}, *line};
  }
  const auto at = corner_at(Body::Part, world.part.corners[static_cast<std::size_t>(pair.moving)].at, own);
  if (!at) return std::nullopt;
  if (pair.kind == ContactKind::CornerOnCorner) {
    const auto pin =
        corner_at(Body::Obstacle, world.obstacles.corners[static_cast<std::size_t>(pair.fixed)].centre, own);
    return pin ? std::optional<GapRef>(GapRef{{*at}, *pin}) : std::nullopt;
  }
  const FixedEdge& edge = world.obstacles.edges[static_cast<std::size_t>(pair.fixed)];
  if (const auto line = edge_at(Body::Obstacle, 0.5 * (edge.from + edge.to), own)) return GapRef{{*at}, *line};
  if (std::abs(edge.from.y()) < kSamePlace_mm && std::abs(edge.normal.x()) < kParallel)
    return GapRef{{*at}, horizontal(0, true)};
  return std::nullopt;
}

ActiveAnswer ActiveSearch::clearance(const World& world, const Configuration& q) const {
  const Clearance found = formotion::clearance(world.part, world.obstacles, q);
  ActiveAnswer answer{found.mm, std::nullopt};
  if (!std::isfinite(found.mm)) return {};
  const PlaceRef place{q, std::nullopt, std::nullopt};
  const Point out = found.mm < 0 ? Point(found.on_obstacles - found.on_part) : Point::Zero();
  if (found.mm > 0) {
    const auto of_part = corner_at(Body::Part, found.on_part, q);
    auto of_obstacle = corner_at(Body::Obstacle, found.on_obstacles, q);
    for (std::size_t l = 0; l < shapes_.obstacles.size() && !of_obstacle; ++l) {  // the rim of a pin
      const TracedLoop<double>& pin = shapes_.obstacles[l];
      if (pin.points.size() == 1 &&
          std::abs((pin.points.front() - found.on_obstacles).norm() - pin.radius_mm) < kSamePlace_mm) {
        of_obstacle = CornerRef{Body::Obstacle, static_cast<int>(l), 0};
      }
    }
    if (of_part && of_obstacle) {
      answer.piece = Piece{place, GapRef{{*of_part}, *of_obstacle}};
    } else if (of_part) {
      auto line = edge_at(Body::Obstacle, found.on_obstacles, q);
      if (!line && std::abs(found.on_obstacles.y()) < kSamePlace_mm) line = horizontal(0, true);
      if (line) answer.piece = Piece{place, GapRef{{*of_part}, *line}};
    } else if (of_obstacle) {
      if (const auto line = edge_at(Body::Part, found.on_part, q))
        answer.piece = Piece{place, GapRef{{*of_obstacle}, *line}};
    }
    return answer;
  }
  // Touching, or where the least move out of an overlap ends in contact.
  const Configuration free{q.x_mm + out.x(), q.y_mm + out.y(), q.theta_rad};
  const std::vector<Contact> contacts = contacts_at(world.part, world.obstacles, free, kSamePlace_mm);
  for (const Contact& contact : contacts) {
    if (out.norm() > kSamePlace_mm && !(contact.state.normal.dot(out) > (1 - kParallel) * out.norm())) continue;
    const auto gap = gap_of(world, contact.pair);
    if (gap) return {found.mm, Piece{place, *gap}};
  }
  for (const Contact& a : contacts) {
    for (const Contact& b : contacts) {
      // The move out is between the two normals.
      const double det = cross(a.state.normal, b.state.normal);
      if (det < kParallel || cross(a.state.normal, out) < 0 || cross(out, b.state.normal) < 0) continue;
      if (a.pair.kind == ContactKind::CornerOnCorner || b.pair.kind == ContactKind::CornerOnCorner) continue;
      const auto gap_a = gap_of(world, a.pair), gap_b = gap_of(world, b.pair);
      if (gap_a && gap_b) return {found.mm, Piece{place, SlotRef{{*gap_a, *gap_b}}}};
    }
  }
  return answer;
}

std::optional<LineRef> ActiveSearch::grown_edge(const Point& from, const Point& to, double grow_mm) const {
  const Point along = (to - from).normalized(), normal(along.y(), -along.x()), middle = 0.5 * (from + to);
  std::optional<LineRef> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < shapes_.voids.size(); ++l) {
    const TracedLoop<double>& loop = shapes_.voids[l];
    for (std::size_t k = 0; k < loop.points.size(); ++k) {
      const CornerRef corner{Body::Void, static_cast<int>(l), static_cast<int>(k)};
      const Point& a = loop.points[k];
      const Point& b = loop.points[(k + 1) % loop.points.size()];
      const Point outward = loop.sense * Point(b.y() - a.y(), a.x() - b.x()).normalized();
      const double off = distance_to_segment(middle, a, b);
      if (outward.dot(normal) > 0 && angle_between(outward, normal) < kParallel &&
          std::abs(normal.dot(from - a) - grow_mm) < kSamePlace_mm && off < nearest) {
        nearest = off;
        best = LineRef{LineRef::Kind::Edge, corner, grow_mm, {0, 1}, 0};
      }
      // A tangent of the arc about a.
      if (std::abs(grow_mm) > kSamePlace_mm && std::abs(normal.dot(from - a) - grow_mm) < kSamePlace_mm &&
          (middle - a).norm() < std::min(nearest, 1.2 * std::abs(grow_mm))) {
        nearest = (middle - a).norm();
        best = LineRef{LineRef::Kind::Tangent, corner, grow_mm, normal, 0};
      }
    }
  }
  return best;
}

std::optional<PointRef> ActiveSearch::generator_at(const Point& p, const Configuration& q,
                                                   const std::vector<Loop>& voids, double grow_mm) const {
  if (const auto corner = corner_at(Body::Part, p, q)) return PointRef{corner};
  // Lines through p: edges of the voids, of the part, rims of the strip.
  std::vector<std::pair<LineRef, Point>> lines;  // with directions
  for (const Loop& loop : voids) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point &a = loop[k], &b = loop[(k + 1) % loop.size()];
      if ((b - a).norm() < kSamePlace_mm || distance_to_segment(p, a, b) > kSamePlace_mm) continue;
      if (const auto line = grown_edge(a, b, grow_mm)) lines.emplace_back(*line, b - a);
    }
  }
  if (lines.empty() || angle_between(lines.front().second, lines.back().second) < kParallel) {
    if (const auto line = edge_at(Body::Part, p, q)) {
      const TracedLoop<double>& loop = shapes_.part[static_cast<std::size_t>(line->corner.loop)];
      const auto k = static_cast<std::size_t>(line->corner.index);
      lines.emplace_back(*line, world_corner(Body::Part, loop, k + 1, q) - world_corner(Body::Part, loop, k, q));
    }
  }
  for (const double y : {0.0, track_width_mm_}) {
    if (std::abs(p.y() - y) < kSamePlace_mm) lines.emplace_back(horizontal(y, true), Point(1, 0));
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      if (angle_between(lines[i].second, lines[j].second) > kParallel)
        return PointRef{std::nullopt, lines[i].first, lines[j].first};
    }
  }
  return std::nullopt;
}

ActiveAnswer ActiveSearch::support(const AspectShape& shape, const Track& track, const Environment& environment,
                                   const Configuration& q) const {
  const double shift = wall_shift(shape.com_height_mm, environment);
  const Point supported(q.x_mm, q.y_mm - shift);
  Loop points = support_generators(placed(shape.footprint, q.theta_rad, q.position()), track);
  if (points.empty()) return {};
  for (Point& p : points) p -= supported;
  const HullMargin margin = hull_margin(points);
  ActiveAnswer answer{margin.margin_mm, std::nullopt};
  std::vector<Loop> voids;
  for (const Polygon& polygon : track.voids) {
    voids.push_back(polygon.outer);
    voids.insert(voids.end(), polygon.holes.begin(), polygon.holes.end());
  }
  const auto generator = [&](int k) {
    return generator_at(points[static_cast<std::size_t>(k)] + supported, q, voids, 0);
  };
  const PlaceRef place{q, std::nullopt, std::nullopt};
  if (margin.at_corner || margin.from == margin.to) {
    const bool at_from =
        points[static_cast<std::size_t>(margin.from)].norm() <= points[static_cast<std::size_t>(margin.to)].norm();
    if (const auto corner = generator(at_from ? margin.from : margin.to))
      answer.piece = Piece{place, HullRef{*corner, std::nullopt, shift}};
    return answer;
  }
  const auto from = generator(margin.from), to = generator(margin.to);
  if (from && to) answer.piece = Piece{place, HullRef{*from, to, shift}};
  return answer;
}

std::optional<GapRef> ActiveSearch::event_at(const Configuration& q, const std::vector<Loop>& voids,
                                             double grow_mm) const {
  constexpr double kEvent_mm = 2e-6;
  for (const Loop& loop : voids) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point &a = loop[k], &b = loop[(k + 1) % loop.size()];
      if ((b - a).norm() < kSamePlace_mm || std::abs(b.y() - a.y()) < kSamePlace_mm)
        continue;  // nothing happens along x
      for (std::size_t l = 0; l < shapes_.part.size(); ++l) {
        for (std::size_t i = 0; i < shapes_.part[l].points.size(); ++i) {
          const Point corner = world_corner(Body::Part, shapes_.part[l], i, q);
          if (distance_to_segment(corner, a, b) > kEvent_mm) continue;
          const auto line = grown_edge(a, b, grow_mm);
          if (line) return GapRef{{CornerRef{Body::Part, static_cast<int>(l), static_cast<int>(i)}}, *line};
        }
      }
    }
  }
  for (const Loop& loop : voids) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const auto edge = edge_at(Body::Part, loop[k], q);
      const auto before = grown_edge(loop[(k + loop.size() - 1) % loop.size()], loop[k], grow_mm);
      const auto after = grown_edge(loop[k], loop[(k + 1) % loop.size()], grow_mm);
      if (edge && before && after) return GapRef{{std::nullopt, *before, *after}, *edge};
    }
  }
  return std::nullopt;
}

std::optional<Piece> ActiveSearch::travel(const PoseModel& pose, const AspectShape& shape,
                                          const Environment& environment, const std::vector<Loop>& voids,
                                          double grow_mm, const LeastMargin& least) const {
  const StablePose& stable = pose.stable;
  const double shift = wall_shift(shape.com_height_mm, environment);
  const Configuration q{least.x_mm, stable.com_wall_mm, stable.orientation_rad};
  const Point supported(q.x_mm, q.y_mm - shift);
  const auto from = generator_at(least.from + supported, q, voids, grow_mm);
  const auto to = generator_at(least.to + supported, q, voids, grow_mm);
  if (!from || !to) return std::nullopt;
  PlaceRef place{q, std::nullopt, std::nullopt};
  // The corners that it stands on, from left to right.
  std::array<CornerRef, 2> rests;
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (std::size_t l = 0; l < shapes_.part.size(); ++l) {
    for (std::size_t k = 0; k < shapes_.part[l].points.size(); ++k) {
      const Point p = world_corner(Body::Part, shapes_.part[l], k, q);
      if (std::abs(p.y()) > kSamePlace_mm) continue;
      const CornerRef ref{Body::Part, static_cast<int>(l), static_cast<int>(k)};
      if (p.x() < left) rests[0] = ref;
      if (p.x() > right) rests[1] = ref;
      left = std::min(left, p.x());
      right = std::max(right, p.x());
    }
  }
  if (!(left < right)) return std::nullopt;
  place.rests_on = rests;

  // The nearest place of the hull: within its edge, or an end of it.
  const Point along = least.to - least.from;
  const double foot = -least.from.dot(along);
  HullRef hull{*from, to, shift};
  if (least.margin_mm < 0 && (foot <= 0 || foot >= along.squaredNorm() || along.norm() < kSamePlace_mm)) {
    hull = {least.from.norm() <= least.to.norm() ? *from : *to, std::nullopt, shift};
  }
  const auto margin_at = [&](double x) {
    PlaceRef moved = place;
    moved.q.x_mm = x;
    return signed_mm<double>({moved, hull}, shapes_);
  };
  // Where the margin is not stationary, an event decides.
  constexpr double kStep_mm = 1e-4;
  if (std::abs(margin_at(q.x_mm + kStep_mm) - margin_at(q.x_mm - kStep_mm)) > 2 * kStep_mm * kStationary) {
    place.event = event_at(q, voids, grow_mm);
    if (!place.event) return std::nullopt;
  }
  return Piece{place, hull};
}

}  // namespace formotion::feeder
