#include "witness/feeder_specs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/geometry/boolean.hpp"

namespace formotion::witness {

using feeder::FeatureSpec;

Affine literal(double value) { return {value, {}}; }

AffineLoop literal(const Loop& loop) {
  AffineLoop result;
  for (const Point& p : loop) result.push_back({literal(p.x()), literal(p.y())});
  return result;
}

FeatureSpec balcony(double width, double length) { return {feeder::Balcony{literal(width), literal(length)}, {}}; }
FeatureSpec gap(double length) { return {feeder::Gap{literal(length)}, {}}; }
FeatureSpec canyon(double from, double to, double length) {
  return {feeder::Canyon{literal(from), literal(to), literal(length)}, {}};
}
FeatureSpec slot(double from, double to, double length) {
  return {feeder::Slot{literal(from), literal(to), literal(length)}, {}};
}
FeatureSpec cutout(const Loop& polygon) { return {feeder::Cutout{literal(polygon)}, {}}; }
FeatureSpec dish_out(double depth, double length) { return {feeder::DishOut{literal(depth), literal(length)}, {}}; }
FeatureSpec scallop(double depth, double half_angle_deg) {
  return {feeder::Scallop{literal(depth), literal(half_angle_deg * std::numbers::pi / 180)}, {}};
}
FeatureSpec wiper(double height) { return {feeder::Wiper{literal(height)}, {}}; }
FeatureSpec hold_down(double height, double length) { return {feeder::HoldDown{literal(height), literal(length)}, {}}; }
FeatureSpec at(FeatureSpec feature, double x) {
  feature.at_mm = literal(x);
  return feature;
}

feeder::PartSpec flat_part(const Loop& outline, bool flips, const std::vector<Loop>& holes, std::optional<Point> com) {
  feeder::AspectSpec up;
  up.name = "up";
  up.outline_mm = literal(outline);
  for (const Loop& hole : holes) up.holes_mm.push_back(literal(hole));
  up.height_mm = 3;
  up.com_mm = com;
  if (!flips) return {{up}};
  up.probability = 0.5;
  feeder::AspectSpec down = up;
  down.name = "down";
  const Polygon mirrored = mirrored_x({outline, holes});
  down.outline_mm = literal(mirrored.outer);
  down.holes_mm.clear();
  for (const Loop& hole : mirrored.holes) down.holes_mm.push_back(literal(hole));
  if (com) down.com_mm = Point(-com->x(), com->y());
  return {{up, down}};
}

feeder::PartSpec block() {
  feeder::AspectSpec flat, edge;
  flat.name = "flat";
  flat.outline_mm = literal(rectangle(0, 0, 30, 18));
  flat.height_mm = 6;
  flat.probability = 0.7;
  edge.name = "edge";
  edge.outline_mm = literal(rectangle(0, 0, 30, 6));
  edge.height_mm = 18;
  edge.probability = 0.3;
  return {{flat, edge}};
}

Loop bibazu_l() {
  return {{0, 0}, {0, -30.491329}, {-10.4514, -30.491329}, {-10.4514, -9.52185}, {-40.62175, -9.52185}, {-40.62175, 0}};
}
Loop el_outline() { return {{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 20}, {0, 20}}; }

feeder::FeederSpec feeder_spec(feeder::PartSpec part, feeder::DesignSpec design, double track_width) {
  feeder::FeederSpec spec;
  spec.part = std::move(part);
  spec.environment.track_width_mm = track_width;
  spec.goal.one_pose = true;
  spec.designs = {std::move(design)};
  const auto objectives = feeder::known_objectives();
  spec.objectives.assign(objectives.begin(), objectives.end());
  return spec;
}

feeder::FeederEvaluation evaluated(const feeder::FeederSpec& spec) {
  return feeder::FeederProblem(spec).evaluate(0, {});
}

Loop gear(int teeth, double inner, double outer) {
  Loop loop;
  for (int i = 0; i < 4 * teeth; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / (4 * teeth);
    const double radius = i % 4 < 2 ? outer : inner;
    loop.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return loop;
}

namespace {

feeder::PartSpec random_part(Random& random) {
  switch (below(random, 8)) {
    case 0:
      return flat_part(el_outline(), true);
    case 1:
      return flat_part(bibazu_l(), true);
    case 2:
      return flat_part(gear(5 + below(random, 3), 10, 14), false);
    case 3:
      return flat_part(rectangle(0, 0, 24, 16), false, {{{6, 4}, {6, 11}, {18, 11}, {18, 4}}});
    case 4:
      return block();
    case 5: {  // a plate on a narrower foot
      feeder::AspectSpec foot;
      foot.name = "foot";
      foot.outline_mm = literal(rectangle(4, 3, 20, 12));
      foot.height_mm = 8;
      foot.layers = {{0, 3, literal(rectangle(4, 3, 20, 12)), {}},
                     {3, 8, literal(Loop{{0, 0}, {26, 0}, {26, 15}, {8, 17}, {0, 15}}), {}}};
      return {{foot}};
    }
    case 6: {  // the centre of mass away from the centroid
      const Polygon star = random_polygon(random, 18);
      const Point com = area_moments(star).centroid + Point(uniform(random, -1, 1), uniform(random, -1, 1));
      return flat_part(star.outer, below(random, 2) == 0, {}, com);
    }
    default:
      return flat_part(random_polygon(random, 18).outer, below(random, 2) == 0);
  }
}

FeatureSpec random_feature(Random& random, double width, bool symmetric) {
  const double length = uniform(random, 4, 70);
  const double from = uniform(random, -3, 18), to = from + uniform(random, 0.5, 16);
  switch (below(random, symmetric ? 6 : 10)) {
    case 0:
      return balcony(uniform(random, 3, 18), uniform(random, 0, 3) < 1 ? length : 60);
    case 1:
      return gap(uniform(random, 1, 24));
    case 2:
      return canyon(from, to, 60 + length);
    case 3:
      return slot(from, to, length);
    case 4: {
      const double long_enough = uniform(random, 12, 60);
      return dish_out(std::min(uniform(random, width - 16, width), 0.5 * long_enough), long_enough);
    }
    case 5:
      return scallop(uniform(random, width - 16, width), uniform(random, 5, 60));
    case 6:
      return below(random, 2) ? wiper(uniform(random, 2, 20)) : hold_down(uniform(random, 2, 20), length);
    case 7:
      return cutout({{0, from}, {uniform(random, 5, 40), uniform(random, -2, 20)}, {length, to}});
    default: {
      const Polygon star = random_polygon(random, 14);
      return cutout(placed(star, 0, {uniform(random, -5, 20), uniform(random, 0, 16)}).outer);
    }
  }
}

feeder::FeederSpec on_track(Random& random) {
  feeder::FeederSpec spec = feeder_spec(random_part(random), {}, uniform(random, 20, 45));
  if (below(random, 2)) spec.environment.tilt_rad = uniform(random, -0.1, 0.2);
  if (below(random, 3) == 0) spec.environment.settling_friction = uniform(random, 0, 0.3);
  return spec;
}

}  // namespace

feeder::FeederSpec random_feeder(Random& random) {
  feeder::FeederSpec spec = on_track(random);
  feeder::DesignSpec& design = spec.designs.front();
  const int count = 1 + below(random, 3);
  for (int i = 0; i < count; ++i) {
    design.push_back(random_feature(random, spec.environment.track_width_mm, false));
    if (below(random, 3) == 0) design.back() = at(design.back(), uniform(random, -40, 120));
  }
  return spec;
}

feeder::FeederSpec random_symmetric_feeder(Random& random) {
  feeder::FeederSpec spec = on_track(random);
  const Loop outline = below(random, 3) == 0 ? el_outline() : random_polygon(random, 18).outer;
  spec.part = flat_part(outline, true);
  spec.environment.settling_friction = 0;  // friction tells forward from backward
  for (int i = 0, n = 1 + below(random, 3); i < n; ++i) {
    spec.designs.front().push_back(random_feature(random, spec.environment.track_width_mm, true));
  }
  return spec;
}

}  // namespace formotion::witness
