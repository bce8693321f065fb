#include "shaking/shaken_world.hpp"

#include <box2d/box2d.h>

#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "shaking/convex_pieces.hpp"

namespace formotion {
namespace {

// The part's size in the engine's units of length.
constexpr double kUnits = 40;
// Radius of all outlines, in units. Bodies rest up to twice this apart, 0.0004 of the part's size (0.005 less without
// restitution). Impacts are found 0.005 apart, so that what rests has none.
constexpr float kSkin = 0.0075f;
constexpr int kVelocityIterations = 12, kPositionIterations = 4;

double polar_per_area(const Polygon& part) {
  const AreaMoments moments = area_moments(part);
  return moments.second_mm4.trace() / moments.area_mm2 + moments.centroid.squaredNorm();
}

}  // namespace

struct ShakenWorld::Engine {
  ShakenScene scene;
  double unit_mm, step_s, omega, phase, gyration_mm;
  Point origin;  // of the engine, in the nest's frame: floats are finest near it
  long steps = 0;
  b2World world{b2Vec2(0, 0)};
  b2Body* nest = nullptr;
  b2Body* part = nullptr;

  b2Vec2 units(const Point& p) const {
    return {static_cast<float>(p.x() / unit_mm), static_cast<float>(p.y() / unit_mm)};
  }
  Point millimetres(const b2Vec2& p) const { return Point(p.x, p.y) * unit_mm; }
  Point up() const { return -scene.gravity.down; }
  // The engine's velocities are those of the middle of a step (leapfrog): half a step's gravity leads to its end.
  Point half_step() const { return scene.gravity.down * (kGravity_mm_s2 * step_s / 2); }
  double table_mm(double time_s) const { return scene.table.amplitude_mm * std::sin(omega * time_s + phase); }
  double table_mm_s(double time_s) const { return scene.table.amplitude_mm * omega * std::cos(omega * time_s + phase); }

  // Twice the part's energy of motion relative to the nest, if it moves at this velocity.
  float square_speed(const b2Vec2& velocity) const {
    const float turning = static_cast<float>(gyration_mm / unit_mm) * part->GetAngularVelocity();
    return (velocity - nest->GetLinearVelocity()).LengthSquared() + turning * turning;
  }

  void add(b2Body& body, b2Shape& shape) const {
    shape.m_radius = kSkin;
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = static_cast<float>(scene.friction);
    fixture.restitution = static_cast<float>(scene.table.restitution);
    fixture.restitutionThreshold = 0;
    body.CreateFixture(&fixture);
  }

  void add_outline(b2Body& body, const Loop& loop) const {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      b2EdgeShape edge;
      edge.SetOneSided(units(loop[(i + n - 1) % n] - origin), units(loop[i] - origin),
                       units(loop[(i + 1) % n] - origin), units(loop[(i + 2) % n] - origin));
      add(body, edge);
    }
  }

  Engine(const ShakenScene& of, const ShakenStart& start, double step)
      : scene(of),
        unit_mm(diameter(of.part.outer) / kUnits),
        step_s(step),
        omega(2 * std::numbers::pi * of.table.frequency_hz),
        phase(start.phase_rad),
        gyration_mm(std::sqrt(polar_per_area(of.part))),
        origin(start.at.position()) {
    world.SetAllowSleeping(false);
    world.SetContinuousPhysics(true);
    world.SetGravity(units(scene.gravity.down * kGravity_mm_s2));
    b2BodyDef nest_def;
    nest_def.type = b2_kinematicBody;
    nest_def.position = units(up() * table_mm(0));
    nest = world.CreateBody(&nest_def);
    for (const Polygon& solid : united(loops_of(scene.nest))) {
      for (const Loop& loop : loops_of(normalised(solid))) add_outline(*nest, loop);
    }
    b2BodyDef part_def;
    part_def.type = b2_dynamicBody;
    part_def.bullet = true;
    part_def.position = nest_def.position;
    part_def.angle = static_cast<float>(start.at.theta_rad);
    part_def.linearVelocity = units(start.velocity.linear + up() * table_mm_s(0) - half_step());
    part_def.angularVelocity = static_cast<float>(start.velocity.angular);
    part = world.CreateBody(&part_def);
    for (const Loop& piece : convex_pieces(normalised(scene.part), b2_maxPolygonVertices)) {
      b2Vec2 corners[b2_maxPolygonVertices];
      for (std::size_t i = 0; i < piece.size(); ++i) corners[i] = units(piece[i]);
      b2PolygonShape shape;
      shape.Set(corners, static_cast<int32>(piece.size()));
      add(*part, shape);
    }
    b2MassData mass;
    mass.mass = 1;
    mass.center.SetZero();
    mass.I = static_cast<float>(gyration_mm * gyration_mm / (unit_mm * unit_mm));
    part->SetMassData(&mass);
  }
};

ShakenWorld::ShakenWorld(const ShakenScene& scene, const ShakenStart& start, double step_s)
    : engine_(std::make_unique<Engine>(scene, start, step_s)) {}
ShakenWorld::~ShakenWorld() = default;

void ShakenWorld::step() {
  Engine& e = *engine_;
  // The step's mean velocity from where rounding has left the nest: it cannot drift.
  const Point target = e.up() * e.table_mm((e.steps + 1) * e.step_s);
  e.nest->SetLinearVelocity(e.units((target - e.millimetres(e.nest->GetPosition())) / e.step_s));
  const float h = static_cast<float>(e.step_s);
  const float most = e.square_speed(e.part->GetLinearVelocity() + h * e.world.GetGravity());
  e.world.Step(h, kVelocityIterations, kPositionIterations);
  ++e.steps;
  // Seen from the nest, no impact gives energy. Newton's restitution with friction can (Stronge 1990), so that is
  // undone.
  const float now = e.square_speed(e.part->GetLinearVelocity());
  if (now <= most * (1 + 1e-5f)) return;
  const float kept = std::sqrt(most / now);
  const b2Vec2 nest = e.nest->GetLinearVelocity();
  e.part->SetLinearVelocity(nest + kept * (e.part->GetLinearVelocity() - nest));
  e.part->SetAngularVelocity(kept * e.part->GetAngularVelocity());
}

double ShakenWorld::time_s() const { return engine_->steps * engine_->step_s; }
double ShakenWorld::nest_mm() const { return engine_->table_mm(time_s()); }
double ShakenWorld::gyration_mm() const { return engine_->gyration_mm; }

Configuration ShakenWorld::part() const {
  const Engine& e = *engine_;
  const Point p = e.origin + e.millimetres(e.part->GetPosition() - e.nest->GetPosition());
  return {p.x(), p.y(), e.part->GetAngle()};
}

Twist ShakenWorld::velocity() const {
  return {engine_->millimetres(engine_->part->GetLinearVelocity()) + engine_->half_step(),
          engine_->part->GetAngularVelocity()};
}

double ShakenWorld::energy_mm() const {
  const Twist v = velocity();
  const double turning = engine_->gyration_mm * v.angular;
  return engine_->scene.gravity.height_mm(part()) + nest_mm() +
         (v.linear.squaredNorm() + turning * turning) / (2 * kGravity_mm_s2);
}

}  // namespace formotion
