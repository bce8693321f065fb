// Feeder problems built in code: short names for features, the parts of the documentation, and random designs.
#pragma once

#include "applications/feeder/feeder_problem.hpp"
#include "witness/random_shapes.hpp"

namespace formotion::witness {

Affine literal(double value);
AffineLoop literal(const Loop& loop);

feeder::FeatureSpec balcony(double width, double length);
feeder::FeatureSpec gap(double length);
feeder::FeatureSpec canyon(double from, double to, double length);
feeder::FeatureSpec slot(double from, double to, double length);
feeder::FeatureSpec cutout(const Loop& polygon);
feeder::FeatureSpec dish_out(double depth, double length);
feeder::FeatureSpec scallop(double depth, double half_angle_deg);
feeder::FeatureSpec wiper(double height);
feeder::FeatureSpec hold_down(double height, double length);
feeder::FeatureSpec at(feeder::FeatureSpec feature, double x);

// Thickness 3 mm. com: default the centroid.
feeder::PartSpec flat_part(const Loop& outline, bool flips, const std::vector<Loop>& holes = {},
                           std::optional<Point> com = std::nullopt);
feeder::PartSpec block();  // 30 x 18 x 6 mm, also stands on its long side: aspects "flat" and "edge"
Loop bibazu_l();           // the L-part of docs/feeder.md
Loop el_outline();         // the el-shaped part of docs/feeder.md

// One design on a track of this width: goal "one pose", all objectives, no tilt.
feeder::FeederSpec feeder_spec(feeder::PartSpec part, feeder::DesignSpec design, double track_width = 60);
feeder::FeederEvaluation evaluated(const feeder::FeederSpec& spec);

// A part (el, L, star, gear, frame, one with layers or aspects of its own), a track and one to three features of all
// types, dimensioned so that outcomes vary; some overlap, some stand apart.
feeder::FeederSpec random_feeder(Random& random);
// The same with features that are symmetric under x -> -x, apart by more than the part.
feeder::FeederSpec random_symmetric_feeder(Random& random);

Loop gear(int teeth, double inner, double outer);

}  // namespace formotion::witness
