#include "applications/feeder/inverse_goals.hpp"

#include <iomanip>
#include <numbers>
#include <sstream>

#include "analysis/contact/clearance.hpp"
#include "applications/feeder/configuration_support.hpp"

namespace formotion::feeder {
namespace {

constexpr double kFacing = 1e-12;  // sine

std::string words(double mm_or_deg) {
  std::ostringstream out;
  out << std::setprecision(10) << mm_or_deg;
  return out.str();
}
double degrees(double rad) { return std::round(rad * 180 / std::numbers::pi * 1e9) / 1e9; }

std::string named(const AspectSpec& aspect, const Configuration& q) {
  return "configuration " + aspect.name + " at x " + words(q.x_mm) + ", y " + words(q.y_mm) + " mm, " +
         words(degrees(q.theta_rad)) + " deg";
}
std::string named(const AspectSpec& aspect, const FacetGoal& goal) {
  return std::string("facet ") + (goal.edge_moves ? "EV " : "VE ") + std::to_string(goal.moving) + " on [" +
         std::to_string(goal.component) + ", " + std::to_string(goal.fixed) + "], " + aspect.name + " at " +
         words(degrees(goal.theta_rad)) + " deg";
}

// A corner of a loop by its number: outline, then holes, as written.
std::optional<CornerRef> numbered(const std::vector<TracedLoop<double>>& loops, Body body, int index) {
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const int count = static_cast<int>(loops[l].points.size());
    if (index < count) return CornerRef{body, static_cast<int>(l), index};
    index -= count;
  }
  return std::nullopt;
}

struct Edges {
  Point before, after;  // unit, away from the corner
  bool convex = false;
};
Edges edges_at(const TracedLoop<double>& loop, int index) {
  const int n = static_cast<int>(loop.points.size());
  const Point &p = loop.points[static_cast<std::size_t>(index)],
              &b = loop.points[static_cast<std::size_t>((index + n - 1) % n)],
              &a = loop.points[static_cast<std::size_t>((index + 1) % n)];
  return {(b - p).normalized(), (a - p).normalized(), loop.sense * cross(p - b, a - p) > 0};
}
Point normal_of(const TracedLoop<double>& loop, int index) {
  const std::size_t k = static_cast<std::size_t>(index), n = loop.points.size();
  const Point along = loop.points[(k + 1) % n] - loop.points[k];
  return loop.sense * Point(along.y(), -along.x()).normalized();
}

struct Written {
  std::optional<CornerRef> moving;               // its corner, or where its edge begins
  const TracedLoop<double>* part = nullptr;      // null: there is none
  const TracedLoop<double>* obstacle = nullptr;  // null: the wall, or there is none
};
Written written(const FacetGoal& goal, const TracedShapes<double>& shapes) {
  Written found{numbered(shapes.part, Body::Part, goal.moving), nullptr, nullptr};
  if (found.moving) found.part = &shapes.part[static_cast<std::size_t>(found.moving->loop)];
  if (goal.component > 0 && goal.component <= static_cast<int>(shapes.obstacles.size())) {
    const TracedLoop<double>& obstacle = shapes.obstacles[static_cast<std::size_t>(goal.component - 1)];
    if (goal.fixed < static_cast<int>(obstacle.points.size())) found.obstacle = &obstacle;
  }
  return found;
}

// Where the part touches at the facet's middle.
Configuration middle_of(const FacetGoal& goal, const TracedShapes<double>& shapes) {
  const Written found = written(goal, shapes);
  const auto at = [](const TracedLoop<double>& loop, int index) {
    return loop.points[static_cast<std::size_t>(index) % loop.points.size()];
  };
  const int moving = found.moving->index;
  Point on_part = at(*found.part, moving), on_obstacle = Point::Zero();
  if (goal.edge_moves) {
    on_part =
        0.5 * (on_part + at(*found.part, moving + 1)) + found.obstacle->radius_mm * normal_of(*found.part, moving);
    on_obstacle = at(*found.obstacle, goal.fixed);
  } else if (found.obstacle) {
    on_obstacle = 0.5 * (at(*found.obstacle, goal.fixed) + at(*found.obstacle, goal.fixed + 1));
  }
  const Point p = on_obstacle - rotated(on_part, goal.theta_rad);
  return {p.x(), p.y(), goal.theta_rad};
}

}  // namespace

GapRef facet_gap(const FacetGoal& goal, const TracedShapes<double>& shapes) {
  const Written found = written(goal, shapes);
  const CornerRef fixed{Body::Obstacle, goal.component - 1, goal.fixed};
  if (goal.edge_moves) return {{fixed}, LineRef{LineRef::Kind::Edge, *found.moving, 0, {0, 1}, 0}};
  if (!found.obstacle) return {{*found.moving}, LineRef{}};  // the wall's face
  return {{*found.moving}, LineRef{LineRef::Kind::Edge, fixed, 0, {0, 1}, 0}};
}

bool facet_exists(const FacetGoal& goal, const TracedShapes<double>& shapes) {
  const Written found = written(goal, shapes);
  const bool wall = goal.component == 0 && goal.fixed == 0 && !goal.edge_moves;  // of the wall the face alone
  if (!found.part || (!found.obstacle && !wall)) return false;
  if (found.obstacle && found.obstacle->points.size() == 1) return goal.edge_moves;  // a pin
  if (goal.edge_moves) {
    const Point normal = rotated(normal_of(*found.part, found.moving->index), goal.theta_rad);
    const Edges edges = edges_at(*found.obstacle, goal.fixed);
    return edges.convex && edges.before.dot(normal) >= -kFacing && edges.after.dot(normal) >= -kFacing;
  }
  const Point normal = found.obstacle ? normal_of(*found.obstacle, goal.fixed) : Point(0, 1);
  const Edges edges = edges_at(*found.part, found.moving->index);
  return edges.convex && rotated(edges.before, goal.theta_rad).dot(normal) >= -kFacing &&
         rotated(edges.after, goal.theta_rad).dot(normal) >= -kFacing;
}

std::optional<std::pair<std::size_t, std::string>> place_references(FeederSpec& spec) {
  std::vector<double> values;
  for (const Variable& variable : spec.variables) values.push_back(variable.start());
  for (std::size_t k = 0; k < spec.goal.facets.size(); ++k) {
    FacetGoal& goal = spec.goal.facets[k];
    for (std::size_t t = 0; t < spec.designs.size(); ++t) {
      const TracedShapes<double> shapes = traced_shapes<double>(spec, spec.designs[t], goal.aspect, 0, values);
      if (!facet_exists(goal, shapes)) {
        return std::pair(k, std::string("two features that are not there, or cannot touch at this orientation") +
                                (t > 0 ? " in topology " + std::to_string(t) : ""));
      }
      if (t == 0) goal.reference = middle_of(goal, shapes);
    }
  }
  return std::nullopt;
}

std::vector<GoalAnswer> goal_answers(const DesignCase& design, const Layout& layout) {
  const FeederSpec& spec = design.spec;
  std::vector<GoalAnswer> answers;
  const bool possible = layout.invalid.empty() && design.part_defects.empty();
  const double none = design.part.diameter_mm;
  std::vector<std::optional<World>> worlds(design.part.shapes.size());
  std::optional<Track> track;
  for (const ConfigurationGoal& goal : spec.goal.configurations) {
    const auto aspect = static_cast<std::size_t>(goal.aspect);
    const std::string where = named(spec.part.aspects[aspect], goal.q);
    if (!possible) {
      answers.push_back({name(goal.must), where, goal.by_mm, std::nullopt, none});
      continue;
    }
    const AspectShape& shape = design.part.shapes[aspect];
    std::optional<double> got;
    const bool contact = goal.must == Must::Free || goal.must == Must::Blocked;
    if (contact) {
      if (!worlds[aspect]) worlds[aspect] = world_of(shape, layout, spec.environment, none);
      got = clearance_mm(worlds[aspect]->part, worlds[aspect]->obstacles, goal.q);
    } else {
      if (!track) track = track_of(layout, spec.environment);
      got = support_at(shape, *track, spec.environment, goal.q).margin_mm;
    }
    // Where nothing of the part is on the track it lacks all support.
    const double signed_got = got && std::isfinite(*got) ? *got : -none;
    const bool positive = goal.must == Must::Free || goal.must == Must::Supported;
    const double lacking = std::max(0.0, goal.by_mm - (positive ? signed_got : -signed_got));
    if (got && !positive) got = -*got;
    answers.push_back({name(goal.must), where, goal.by_mm, got, lacking});
  }
  for (const FacetGoal& goal : spec.goal.facets) {
    const std::string where = named(spec.part.aspects[static_cast<std::size_t>(goal.aspect)], goal);
    GoalAnswer answer{"outward", where, goal.outward_mm, std::nullopt, none};
    if (possible) {
      const TracedShapes<double> shapes =
          traced_shapes<double>(spec, design.features, goal.aspect, none, design.values);
      if (facet_exists(goal, shapes)) {
        const Piece piece{{goal.reference, std::nullopt, std::nullopt}, facet_gap(goal, shapes)};
        answer.got_mm = -signed_mm(piece, shapes);
        answer.lacking_mm = std::max(0.0, goal.outward_mm - *answer.got_mm);
      }
    }
    answers.push_back(std::move(answer));
  }
  return answers;
}

std::vector<Violation> violations_of(const std::vector<GoalAnswer>& goals) {
  std::vector<Violation> violations;
  for (const GoalAnswer& goal : goals) {
    if (goal.lacking_mm <= 0) continue;
    const std::string what =
        goal.must == "outward" ? "a facet is not far enough outward" : "not " + goal.must + " by as much as asked";
    violations.push_back({what, goal.where, goal.lacking_mm});
  }
  return violations;
}

}  // namespace formotion::feeder
