// The configuration space of one aspect among a design's obstacles, as a picture shows it: slices of the boundary of
// free space, facet by facet, with the part's support.
#pragma once

#include <string>
#include <vector>

#include "analysis/contact/contact_pair.hpp"
#include "applications/feeder/part_model.hpp"
#include "applications/feeder/track_layout.hpp"
#include "applications/feeder/world.hpp"

namespace formotion::feeder {

struct FacetPicture {
  ContactKind kind{};
  int moving = 0;     // numbers of corners and edges are those of the problem file, where they are found there
  int component = 0;  // 0: the wall
  int fixed = 0;
  std::string label;  // "edge 3 on corner 1 of feature 0 (fence)"
};

// A straight stretch of the boundary of free space, the part's support alike all along.
struct PiecePicture {
  int facet = 0;
  ContactPair pair;  // in the aspect's world
  Point from, to;
  bool supported = false;
};

struct SpacePicture {
  int aspect = 0;
  double step_rad = 0;
  std::vector<FacetPicture> facets;
  std::vector<std::vector<PiecePicture>> slices;
  // The orientation of a slice: a little beside the round one, at which edges may be parallel.
  double theta_rad(std::size_t slice) const { return static_cast<double>(slice) * step_rad + 1e-5; }
};

struct SpaceScene {
  const FeederSpec& spec;
  int topology = 0;
  std::span<const double> values;
  const PartModel& part;
  const Layout& layout;
  double from_mm = 0, to_mm = 0;  // positions of the centre of mass along the track
};

SpacePicture space_picture(const SpaceScene& scene, const World& world, int aspect);

}  // namespace formotion::feeder
