// Motions of one mode against an integration of the law that shares no formula with them.
#include "analysis/motion/flow.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"
#include "witness/random_shapes.hpp"

using namespace formotion;
using namespace formotion::witness;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array kSlides{ContactMode::SlideLeft, ContactMode::SlideRight};

Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

Polygon centred(Polygon polygon) {
  polygon = normalised(std::move(polygon));
  return placed(polygon, 0, -area_moments(polygon).centroid);
}
double gyration(const Polygon& polygon) {
  const AreaMoments moments = area_moments(polygon);
  return std::sqrt(moments.second_mm4.trace() / moments.area_mm2);
}

// A half plane below y = 0, a post with a sharp corner at the origin, a pin.
Obstacles floor_plate() { return *make_obstacles({{{{{-1e4, -100}, {1e4, -100}, {1e4, 0}, {-1e4, 0}}, {}}, 0, true}}); }
Obstacles post() { return *make_obstacles({{{{{-1, -60}, {1, -60}, {0, 0}}, {}}, 0, false}}); }
Obstacles pin(double radius) { return *make_obstacles({{{{{0, -radius}}, {}}, radius, false}}); }
// Two walls that meet in the origin, at angles left and right from +x.
Obstacles groove(double right, double left) {
  const Point a = 500 * direction(right), b = 500 * direction(left);
  return *make_obstacles({{{{a, {0, 0}, b, {b.x(), -600}, {a.x(), -600}}, {}}, 0, true}});
}

// Where contact `pair` touches, from the shapes alone: normal into the part, lever.
ContactPoint touching(const ContactSpace& space, const ContactPair& pair, const Configuration& q) {
  const auto& fixed = space.obstacles;
  switch (pair.kind) {
    case ContactKind::CornerOnEdge:
      return {fixed.edges[pair.fixed].normal, rotated(space.part.corners[pair.moving].at, q.theta_rad)};
    case ContactKind::EdgeOnCorner: {
      const Point normal = -rotated(space.part.edges[pair.moving].normal, q.theta_rad);
      const FixedCorner& corner = fixed.corners[pair.fixed];
      return {normal, corner.centre + corner.radius_mm * normal - q.position()};
    }
    default: {
      const Point at = rotated(space.part.corners[pair.moving].at, q.theta_rad);
      return {(q.position() + at - fixed.corners[pair.fixed].centre).normalized(), at};
    }
  }
}

// The law with one contact, as one system: v - l f = F, gyration^2 w - l (r x f) = 0, n . (v + w J r) = rolling, where
// sticking: both components of the contact's velocity. On a round corner a sticking contact rolls: material at rest.
Eigen::Vector3d rate(const ContactSpace& space, const Drive& drive, const ContactPair& pair, ContactMode mode,
                     const Configuration& q) {
  const auto [n, r] = touching(space, pair, q);
  const Point t(-n.y(), n.x());
  const double g2 = space.part.gyration_mm * space.part.gyration_mm;
  Eigen::Matrix<double, 5, 5> m = Eigen::Matrix<double, 5, 5>::Zero();  // vx, vy, w, normal and tangential force
  Eigen::Matrix<double, 5, 1> b = Eigen::Matrix<double, 5, 1>::Zero();
  m.row(0) << 1, 0, 0, -n.x(), -t.x();
  m.row(1) << 0, 1, 0, -n.y(), -t.y();
  m.row(2) << 0, 0, g2, -cross(r, n), -cross(r, t);
  m.row(3) << n.x(), n.y(), cross(r, n), 0, 0;
  if (mode == ContactMode::Stick) {
    m.row(4) << t.x(), t.y(), cross(r, t), 0, 0;
  } else {
    const double along = mode == ContactMode::SlideLeft ? -drive.friction : drive.friction;
    m.row(4) << 0, 0, 0, -along, 1;
  }
  b[0] = drive.force.x();
  b[1] = drive.force.y();
  const Eigen::Matrix<double, 5, 1> solved = m.fullPivLu().solve(b);
  return solved.head<3>();
}

// Runge-Kutta of fourth order in `steps` steps, by theta or by arc length (angles times the radius of gyration).
Configuration integrated(const ContactSpace& space, const Drive& drive, const ContactPair& pair, ContactMode mode,
                         const Configuration& start, bool by_theta, double way, int steps) {
  const auto slope = [&](const Eigen::Vector3d& q) {
    const Eigen::Vector3d v = rate(space, drive, pair, mode, {q[0], q[1], q[2]});
    const double fast = by_theta ? v[2] : std::hypot(v[0], v[1], space.part.gyration_mm * v[2]);
    return Eigen::Vector3d(v / fast);
  };
  Eigen::Vector3d q(start.x_mm, start.y_mm, start.theta_rad);
  const double h = way / steps;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d a = slope(q), b = slope(q + h / 2 * a), c = slope(q + h / 2 * b), d = slope(q + h * c);
    q += h / 6 * (a + 2 * b + 2 * c + d);
  }
  return {q[0], q[1], q[2]};
}

double apart(const Configuration& a, const Configuration& b, double reach) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm, reach * (a.theta_rad - b.theta_rad));
}

// Puts the part onto a pair at theta: the contact is moved to gap 0.
std::optional<Configuration> placed_on(const ContactSpace& space, const ContactPair& pair, double theta, double share) {
  const std::size_t index = space.index_of(pair);
  if (index >= space.pairs.size() || !space.orientations[index].contains(theta, -1e-3)) return std::nullopt;
  const double c = std::cos(theta), s = std::sin(theta);
  switch (pair.kind) {
    case ContactKind::CornerOnEdge: {
      const FixedEdge& edge = space.obstacles.edges[pair.fixed];
      const Point p = edge.from + 0.5 * edge.length_mm * edge.along - rotated(space.part.corners[pair.moving].at, c, s);
      return Configuration{p.x(), p.y(), theta};
    }
    case ContactKind::EdgeOnCorner: {
      const MovingEdge& edge = space.part.edges[pair.moving];
      const FixedCorner& corner = space.obstacles.corners[pair.fixed];
      const Point normal = -rotated(edge.normal, c, s);
      const Point p = corner.centre + corner.radius_mm * normal -
                      rotated(Point(edge.from + share * edge.length_mm * edge.along), c, s);
      return Configuration{p.x(), p.y(), theta};
    }
    default: {
      const MovingCorner& corner = space.part.corners[pair.moving];
      const FixedCorner& fixed = space.obstacles.corners[pair.fixed];
      const double facing = corner.normals.from_rad + share * corner.normals.width_rad + theta;
      const Point p = fixed.centre - fixed.radius_mm * direction(facing) - rotated(corner.at, c, s);
      return Configuration{p.x(), p.y(), theta};
    }
  }
}

struct Tally {
  int slides = 0, pivots = 0, followed = 0;
  double worst = 0, worst_gap = 0;
};

// Every consistent motion of one contact is followed for up to its reserve, and against the integration.
void follow(const ContactSpace& space, const Drive& drive, const ContactPair& pair, const Configuration& q,
            Tally& tally) {
  const ContactPoint contact = touching(space, pair, q);
  for (const ContactMode mode : {ContactMode::SlideLeft, ContactMode::SlideRight, ContactMode::Stick}) {
    const MotionLaw law = law_of(drive, space.part);
    const auto motion = motion_of_modes(std::span(&contact, 1), std::span(&mode, 1), law);
    if (!motion || !is_consistent(std::span(&contact, 1), *motion, law)) continue;
    auto flow = Flow::through(space, drive, std::span(&pair, 1), *motion, q);
    if (!flow) continue;
    Configuration end = q;
    double way = 0;
    for (int i = 0; i < 200 && std::abs(end.theta_rad - q.theta_rad) < 0.25; ++i) {
      double h = 0.5 * flow->longest_step(), error = 0;
      Configuration next = flow->at(h, error);
      while (h > 1e-6 && (!(error < 1e-9) || flow->reserve(next) < 0)) next = flow->at(h /= 2, error);
      if (h <= 1e-6) break;
      end = next;
      way += h;
      flow->restart(end, h);
    }
    const double turned = end.theta_rad - q.theta_rad;
    if (std::abs(turned) < 1e-3) continue;
    // Without integration it goes by theta, to either side.
    const bool round = pair.kind != ContactKind::CornerOnEdge && space.obstacles.corners[pair.fixed].radius_mm > 0;
    const bool by_theta = mode == ContactMode::Stick ? !round : pair.kind == ContactKind::CornerOnEdge;
    const Configuration there =
        integrated(space, drive, pair, mode, q, by_theta, by_theta ? turned : way, by_theta ? 6000 : 2000);
    ++(mode == ContactMode::Stick ? tally.pivots : tally.slides);
    tally.followed += std::abs(turned) > 0.1;
    tally.worst = std::max(tally.worst, apart(end, there, space.part.reach_mm));
    const ContactState state = contact_state(space.part, space.obstacles, pair, end.position(), std::cos(end.theta_rad),
                                             std::sin(end.theta_rad));
    tally.worst_gap = std::max(tally.worst_gap, std::abs(state.gap_mm));
  }
}

Tally follow_all(const Obstacles& obstacles, ContactKind kind, std::uint64_t seed, int parts) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < parts; ++i) {
    const Polygon outline = centred(random_polygon(random, 20));
    const MovingShape part = MovingShape::of({outline}, gyration(outline));
    const ContactSpace space(part, obstacles);
    const double friction = below(random, 4) ? uniform(random, 0.05, 0.8) : 0;
    for (const ContactPair& pair : space.pairs) {
      if (pair.kind != kind) continue;
      if (kind == ContactKind::CornerOnEdge && obstacles.edges[pair.fixed].normal.y() < 0.9) continue;
      const DirectionRange& range = space.orientations[space.index_of(pair)];
      const double theta = range.from_rad + uniform(random, 0.1, 0.9) * std::min(range.width_rad, 2 * kPi);
      const auto q = placed_on(space, pair, theta, uniform(random, 0.2, 0.8));
      if (!q) continue;
      follow(space, {direction(uniform(random, -kPi + 0.1, -0.1)), friction}, pair, *q, tally);
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("a corner that slides or pivots on an edge moves as the integrated law does") {
  const Tally tally = follow_all(floor_plate(), ContactKind::CornerOnEdge, 20261211, 60);
  CAPTURE(tally.slides, tally.pivots, tally.followed);
  CHECK(tally.worst < 1e-7);
  CHECK(tally.worst_gap < 1e-11);
  CHECK(tally.slides > 60);
  CHECK(tally.pivots > 20);
  CHECK(tally.followed > 60);
}

TEST_CASE("an edge that slides or pivots on a sharp corner moves as the integrated law does") {
  const Tally tally = follow_all(post(), ContactKind::EdgeOnCorner, 20261212, 60);
  CAPTURE(tally.slides, tally.pivots, tally.followed);
  CHECK(tally.worst < 1e-7);
  CHECK(tally.worst_gap < 1e-9);
  CHECK(tally.slides > 60);
  CHECK(tally.pivots > 20);
  CHECK(tally.followed > 60);
}

TEST_CASE("on a pin edges slide and roll, and corners slide and stick, as the integrated law does") {
  for (const ContactKind kind : {ContactKind::EdgeOnCorner, ContactKind::CornerOnCorner}) {
    const Tally tally = follow_all(pin(3), kind, 20261213, 60);
    CAPTURE(tally.slides, tally.pivots, tally.followed);
    CHECK(tally.worst < 1e-7);
    CHECK(tally.worst_gap < 1e-9);
    CHECK(tally.slides > 60);
    CHECK(tally.pivots > 20);
    CHECK(tally.followed > 60);
  }
}

TEST_CASE("a pivot leaves its contact point where it is") {
  const Polygon outline = centred({rectangle(0, 0, 30, 12), {}});
  const MovingShape part = MovingShape::of({outline}, gyration(outline));
  const Obstacles floor = floor_plate();
  const ContactSpace space(part, floor);
  // The corner (-15, -6) down: leaning to the right, and driven straight down.
  const Configuration q{0, std::abs(rotated(Point(-15, -6), 0.5).y()), 0.5};
  const std::vector<TouchCluster> touches = touches_at(space, q);
  REQUIRE(touches.size() == 1);
  const Drive drive{{0, -1}, 2};
  const ContactPoint contact = point_of(touches[0][0].state);
  const ContactMode stick = ContactMode::Stick;
  const auto motion = motion_of_modes(std::span(&contact, 1), std::span(&stick, 1), law_of(drive, part));
  REQUIRE(motion);
  const auto flow = Flow::through(space, drive, std::span(&touches[0][0].pair, 1), *motion, q);
  REQUIRE(flow);
  CHECK(flow->kind() == MotionKind::Pivot);
  const Point at = q.position() + contact.lever;
  for (const double h : {0.01, 0.1, 0.3}) {
    const Configuration there = flow->at(h);
    CHECK(std::abs(there.theta_rad - 0.5) == Approx(h));
    CHECK((there.position() + rotated(Point(-15, -6), there.theta_rad) - at).norm() < 1e-12);
  }
}

TEST_CASE("a part that two contacts guide keeps both, on the ellipse where both are corners on edges") {
  Random random(20261214);
  int curves = 0, moved = 0;
  for (int i = 0; i < 200; ++i) {
    const Polygon outline = centred(random_polygon(random, 20));
    const MovingShape part = MovingShape::of({outline}, gyration(outline));
    const Obstacles walls = groove(uniform(random, 0.2, 1.2), kPi - uniform(random, 0.2, 1.2));
    const ContactSpace space(part, walls);
    const double theta = uniform(random, 0, 2 * kPi);
    // In the groove: the corner farthest against each wall.
    std::vector<ContactPair> pairs;
    Eigen::Matrix2d rows;
    Point offsets = Point::Zero();
    for (int e = 0; e < static_cast<int>(walls.edges.size()); ++e) {
      if (walls.edges[e].normal.y() < 0.1) continue;
      int lowest = -1;
      double least = 1e9;
      for (int k = 0; k < static_cast<int>(part.corners.size()); ++k) {
        const double y = walls.edges[e].normal.dot(rotated(part.corners[k].at, theta));
        if (y < least) least = y, lowest = k;
      }
      rows.row(static_cast<Eigen::Index>(pairs.size())) = walls.edges[e].normal.transpose();
      offsets[static_cast<Eigen::Index>(pairs.size())] = -least + walls.edges[e].normal.dot(walls.edges[e].from);
      pairs.push_back({ContactKind::CornerOnEdge, lowest, e});
    }
    REQUIRE(pairs.size() == 2);
    if (pairs[0].moving == pairs[1].moving) continue;  // sits in the groove with one corner
    const Point p = rows.inverse() * offsets;
    const Configuration q{p.x(), p.y(), theta};
    const Drive drive{direction(-kPi / 2 + uniform(random, -0.5, 0.5)), below(random, 2) ? uniform(random, 0, 0.3) : 0};
    std::vector<ContactPoint> contacts{touching(space, pairs[0], q), touching(space, pairs[1], q)};
    for (const ContactMode a : kSlides) {
      for (const ContactMode b : kSlides) {
        const std::array modes{a, b};
        const auto motion = motion_of_modes(contacts, modes, law_of(drive, part));
        if (!motion || !is_consistent(contacts, *motion, law_of(drive, part))) continue;
        auto flow = Flow::through(space, drive, pairs, *motion, q);
        if (!flow || flow->kind() != MotionKind::Curve) continue;
        ++curves;
        std::vector<Configuration> path{q};
        for (int k = 0; k < 12; ++k) {
          double h = 0.2 * flow->longest_step();
          while (h > 1e-6 && flow->reserve(flow->at(h)) < 0) h /= 2;
          if (h <= 1e-6) break;
          path.push_back(flow->at(h));
          flow->restart(path.back(), h);
        }
        for (const Configuration& at : path) {
          for (const ContactPair& pair : pairs) {
            const FixedEdge& edge = walls.edges[pair.fixed];
            const Point corner = at.position() + rotated(part.corners[pair.moving].at, at.theta_rad);
            CHECK(std::abs(edge.normal.dot(corner - edge.from)) < 1e-11);
          }
        }
        if (path.size() < 6 || std::abs(path.back().theta_rad - q.theta_rad) < 0.05) continue;
        ++moved;
        // p = p0 + Pc cos + Ps sin through three of its places holds for the others.
        Eigen::Matrix3d basis;
        Eigen::Matrix<double, 3, 2> places;
        const std::array<std::size_t, 3> known{0, path.size() / 2, path.size() - 1};
        for (int k = 0; k < 3; ++k) {
          const Configuration& at = path[known[k]];
          basis.row(k) << 1, std::cos(at.theta_rad), std::sin(at.theta_rad);
          places.row(k) = at.position().transpose();
        }
        const Eigen::Matrix<double, 3, 2> ellipse = basis.fullPivLu().solve(places);
        for (const Configuration& at : path) {
          const Eigen::RowVector3d here(1, std::cos(at.theta_rad), std::sin(at.theta_rad));
          CHECK((here * ellipse - at.position().transpose()).norm() < 1e-7);
        }
      }
    }
  }
  CHECK(curves > 40);
  CHECK(moved > 20);
}
