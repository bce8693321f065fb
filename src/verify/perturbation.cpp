#include "verify/perturbation.hpp"

#include <cmath>
#include <numbers>

#include "verify/tested_design.hpp"

namespace formotion {
namespace {

using namespace feeder;

constexpr double kKnots = 4;  // times the error: corners nearer to each other move together

// A vector of at most this length: half of them of the full one.
Point random_vector(double most, RandomStream& random) {
  const double angle = 2 * std::numbers::pi * random.uniform();
  const double length = most * std::min(1.0, 2 * random.uniform());
  return length * Point(std::cos(angle), std::sin(angle));
}

// Moves the corners of a line; closed: the last one joins the first.
void move_corners(Loop& points, bool closed, double most, RandomStream& random) {
  const std::size_t n = points.size();
  std::vector<double> along(n + 1, 0);  // arc length
  for (std::size_t i = 0; i < n; ++i) along[i + 1] = along[i] + (points[(i + 1) % n] - points[i]).norm();
  const double whole = closed ? along[n] : along[n - 1];
  std::vector<std::size_t> knots{0};
  for (std::size_t i = 1; i < n; ++i) {
    if (along[i] - along[knots.back()] < kKnots * most) continue;
    if (closed && whole - along[i] < kKnots * most) break;
    knots.push_back(i);
  }
  std::vector<Point> moves;
  for (std::size_t k = 0; k < knots.size(); ++k) moves.push_back(random_vector(most, random));
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const bool last = k + 1 == knots.size();
    const std::size_t end = last ? n : knots[k + 1];
    const Point to = !last ? moves[k + 1] : closed ? moves[0] : moves[k];
    const double from_at = along[knots[k]], length = (last ? whole : along[knots[k + 1]]) - from_at;
    for (std::size_t i = knots[k]; i < end; ++i) {
      const double t = length > 0 ? std::min(1.0, (along[i] - from_at) / length) : 0;
      points[i] += (1 - t) * moves[k] + t * to;
    }
  }
}

bool move_voids(LaidFeature& feature, double most, RandomStream& random) {
  std::vector<Loop> voids = feature.voids;
  for (Loop& loop : voids) {
    const bool island = signed_area(loop) < 0;
    move_corners(loop, true, most, random);
    if ((signed_area(loop) < 0) != island || defect(normalised({loop, {}}))) return false;
  }
  set_voids(feature, std::move(voids));
  return true;
}

bool move_obstacle(ObstacleShape& obstacle, const PerturbationOptions& options, RandomStream& random) {
  Loop& loop = obstacle.area.outer;
  if (obstacle.radius_mm > 0) {
    const double shift = options.most_mm * random.uniform();
    loop.front() += random_vector(shift, random);
    obstacle.radius_mm += (options.most_mm - shift) * (2 * random.uniform() - 1);
    return obstacle.radius_mm > 0;
  }
  if (options.turn_edges) {
    move_corners(loop, true, options.most_mm, random);
  } else {
    const Point shift = random_vector(options.most_mm, random);
    for (Point& p : loop) p += shift;
  }
  return signed_area(loop) > 0 && !defect(normalised({loop, {}}));
}

// A wall profile is laid out anew from its moved face.
bool move_profile(LaidFeature& feature, const Environment& environment, const PerturbationOptions& options,
                  RandomStream& random) {
  Loop face = feature.wall_face_mm;
  if (options.turn_edges) {
    move_corners(face, false, options.most_mm, random);
  } else {
    const Point shift = random_vector(options.most_mm, random);
    for (Point& p : face) p += shift;
  }
  FeatureSpec spec;
  WallProfile profile;
  for (const Point& p : face) profile.profile_mm.push_back({Affine{p.x(), {}}, Affine{p.y(), {}}});
  spec.shape = std::move(profile);
  spec.at_mm = Affine{0, {}};
  const Layout laid = lay_out({spec}, environment, {}, 0, {});
  if (!laid.invalid.empty()) return false;
  feature = laid.features.front();
  return true;
}

}  // namespace

std::optional<Layout> perturbed(const Layout& plain, const Environment& environment, const PerturbationOptions& options,
                                RandomStream& random) {
  Layout layout = plain;
  for (LaidFeature& feature : layout.features) {
    if (!feature.voids.empty() && !move_voids(feature, options.most_mm, random)) return std::nullopt;
    if (!feature.wall_face_mm.empty()) {
      if (!move_profile(feature, environment, options, random)) return std::nullopt;
      continue;
    }
    for (ObstacleShape& obstacle : feature.obstacles) {
      if (!move_obstacle(obstacle, options, random)) return std::nullopt;
    }
  }
  return layout;
}

Loop perturbed(Loop loop, double most_mm, RandomStream& random) {
  move_corners(loop, true, most_mm, random);
  return loop;
}

}  // namespace formotion
