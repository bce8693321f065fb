#include "box2d_track.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace formotion::bench {
namespace {

constexpr float kSkin = 0.0025f;  // radius of polygons, in units: what the engine's slop lets overlap
constexpr float kStep_s = 1.0f / 60;
constexpr float kDamping = 6e5f;  // per second: a step keeps 1e-4 of the velocity

b2Vec2 units(const Point& p, double unit_mm) {
  return {static_cast<float>(p.x() / unit_mm), static_cast<float>(p.y() / unit_mm)};
}

void add_area(b2Body& body, const Polygon& area, double friction, double unit_mm) {
  if (!area.holes.empty()) throw std::invalid_argument("holes are not supported here");
  for (const Loop& piece : convex_pieces(area.outer, b2_maxPolygonVertices)) {
    b2Vec2 corners[b2_maxPolygonVertices];
    for (std::size_t i = 0; i < piece.size(); ++i) corners[i] = units(piece[i], unit_mm);
    b2PolygonShape shape;
    shape.Set(corners, static_cast<int32>(piece.size()));
    shape.m_radius = kSkin;
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = static_cast<float>(friction);
    body.CreateFixture(&fixture);
  }
}

void add_disc(b2Body& body, const Point& centre, double radius_mm, double friction, double unit_mm) {
  b2CircleShape shape;
  shape.m_p = units(centre, unit_mm);
  shape.m_radius = static_cast<float>(radius_mm / unit_mm);
  b2FixtureDef fixture;
  fixture.shape = &shape;
  fixture.friction = static_cast<float>(friction);
  body.CreateFixture(&fixture);
}

bool in_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

bool is_convex(const Loop& loop) {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point in = loop[(i + 1) % n] - loop[i], out = loop[(i + 2) % n] - loop[(i + 1) % n];
    if (cross(in, out) < -1e-9 * in.norm() * out.norm()) return false;
  }
  return true;
}

// The union of two counter-clockwise loops that share an edge; empty if they do not.
Loop joined(const Loop& a, const Loop& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j]) continue;
      Loop loop;
      for (std::size_t k = 0; k < a.size(); ++k) loop.push_back(a[(i + 1 + k) % a.size()]);
      for (std::size_t k = 2; k < b.size(); ++k) loop.push_back(b[(j + k) % b.size()]);
      return loop;
    }
  }
  return {};
}

}  // namespace

std::vector<Loop> convex_pieces(const Loop& loop, int max_corners) {
  std::vector<Loop> pieces;
  Loop rest = loop;
  while (rest.size() > 3) {
    const std::size_t n = rest.size();
    std::size_t ear = n;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const Point &a = rest[(i + n - 1) % n], &b = rest[i], &c = rest[(i + 1) % n];
      if (cross(b - a, c - b) <= 0) continue;
      const bool is_empty = std::none_of(rest.begin(), rest.end(), [&](const Point& p) {
        return p != a && p != b && p != c && in_triangle(p, a, b, c);
      });
      if (is_empty) ear = i;
    }
    if (ear == n) throw std::invalid_argument("not a simple counter-clockwise polygon");
    pieces.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  pieces.push_back(rest);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = i + 1; j < pieces.size(); ++j) {
      Loop both = joined(pieces[i], pieces[j]);
      if (both.empty() || both.size() > static_cast<std::size_t>(max_corners) || !is_convex(both)) continue;
      pieces[i] = std::move(both);
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;
    }
  }
  return pieces;
}

Box2dOutcome run_box2d(const Box2dTrack& track, const Configuration& start, const Box2dOptions& options) {
  b2World world(b2Vec2(0, 0));
  world.SetContinuousPhysics(false);
  world.SetAllowSleeping(false);
  b2BodyDef fixed_def;
  b2Body& fixed = *world.CreateBody(&fixed_def);
  for (const ObstacleShape& obstacle : track.obstacles) {
    if (obstacle.radius_mm > 0) {
      add_disc(fixed, obstacle.area.outer.front(), obstacle.radius_mm, track.drive.friction, options.unit_mm);
    } else {
      add_area(fixed, obstacle.area, track.drive.friction, options.unit_mm);
    }
  }
  b2BodyDef moving_def;
  moving_def.type = b2_dynamicBody;
  moving_def.position = units(start.position(), options.unit_mm);
  moving_def.angle = static_cast<float>(start.theta_rad);
  moving_def.linearDamping = moving_def.angularDamping = kDamping;
  b2Body& moving = *world.CreateBody(&moving_def);
  for (const Polygon& body : track.bodies) add_area(moving, body, track.drive.friction, options.unit_mm);
  const double gyration = track.gyration_mm / options.unit_mm;
  b2MassData mass;
  mass.mass = 1;
  mass.center.SetZero();
  mass.I = static_cast<float>(gyration * gyration);
  moving.SetMassData(&mass);
  // One step of free motion: force h / (1 + h damping) h = free travel.
  const double force = options.free_travel_mm / options.unit_mm * (1 + kStep_s * kDamping) / (kStep_s * kStep_s);
  const b2Vec2 push(static_cast<float>(force * track.drive.force.normalized().x()),
                    static_cast<float>(force * track.drive.force.normalized().y()));

  const auto configuration = [&] {
    const b2Vec2 p = moving.GetPosition();
    return Configuration{p.x * options.unit_mm, p.y * options.unit_mm, moving.GetAngle()};
  };
  Box2dOutcome outcome;
  const int window = static_cast<int>(std::ceil(100 / options.free_travel_mm));
  Configuration before = start;
  for (outcome.steps = 1; outcome.steps <= options.max_steps; ++outcome.steps) {
    moving.ApplyForceToCenter(push, true);
    world.Step(kStep_s, options.velocity_iterations, options.position_iterations);
    if (moving.GetPosition().x * options.unit_mm > track.exit_x_mm) {
      outcome.end = Box2dOutcome::End::Delivered;
      break;
    }
    if (outcome.steps % window == 0) {
      const Configuration now = configuration();
      const bool stands = (now.position() - before.position()).norm() < 0.05 &&
                          std::abs(now.theta_rad - before.theta_rad) < 0.05 * std::numbers::pi / 180;
      before = now;
      if (stands) {
        outcome.end = Box2dOutcome::End::Stuck;
        break;
      }
    }
  }
  outcome.last = configuration();
  return outcome;
}

}  // namespace formotion::bench
