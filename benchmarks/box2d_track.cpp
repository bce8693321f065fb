#include "box2d_track.hpp"

#include <box2d/box2d.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shaking/convex_pieces.hpp"

namespace formotion::bench {
namespace {

constexpr float kSkin = 0.0025f;  // radius of polygons, in units: what the engine's slop lets overlap
constexpr float kStep_s = 1.0f / 60;
constexpr float kDamping = 6e5f;  // per second: a step keeps 1e-4 of the velocity

b2Vec2 units(const Point& p, double unit_mm) {
  return {static_cast<float>(p.x() / unit_mm), static_cast<float>(p.y() / unit_mm)};
}

void add_area(b2Body& body, const Polygon& area, double friction, double unit_mm) {
  for (const Loop& piece : convex_pieces(area, b2_maxPolygonVertices)) {
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

}  // namespace

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
