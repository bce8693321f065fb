#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "analysis/geometry/boolean.hpp"
#include "report/joint_drawing.hpp"
#include "report/track_drawing.hpp"
#include "solid/reread.hpp"

using namespace formotion;
using feeder::PlacedFeature;

namespace {

void check_closed(const std::vector<Facet>& facets) {
  CHECK_FALSE(facets.empty());
  CHECK(open_edges(facets) == 0);
  CHECK(bad_facets(facets) == 0);
}

// A slot, a gap over the whole width, a pin, a fence over the free edge, a recess in the wall and a ramp on it.
TrackDrawing track() {
  TrackDrawing drawing;
  drawing.title = "track";
  drawing.track_width_mm = 40;
  drawing.plate_mm = 2;
  drawing.obstacle_height_mm = 4;
  PlacedFeature slot{"slot", 0, 20, {{rectangle(0, 10, 20, 20), {}}}, {}};
  PlacedFeature gap{"gap", 30, 35, {{rectangle(30, 0, 35, 40), {}}}, {}};
  PlacedFeature pin{"pin", 50, 56, {}, {}};
  pin.obstacles = {{{{Point(53, 20)}, {}}, 3}};
  PlacedFeature fence{"fence", 60, 70, {}, {}};
  fence.obstacles = {{{rectangle(60, 30, 70, 45), {}}}};
  PlacedFeature wall{"wall", 80, 100, {}, {}};
  wall.wall_face_mm = {{80, 0}, {85, 6}, {85, -2}, {100, -2}, {100, 0}};
  wall.obstacles = {{normalised({{{80, 0}, {85, 6}, {85, -2}, {100, -2}, {100, 0}, {100, -200}, {80, -200}}, {}})}};
  drawing.features = {slot, gap, pin, fence, wall};
  return drawing;
}

}  // namespace

TEST_CASE("a track in three dimensions is closed and encloses plate and wall and what stands on it") {
  const std::vector<Facet> facets = reread(track_stl(track()));
  check_closed(facets);
  // 30 mm of plain track on either side; the wall reaches 5 mm behind the recess of 2 mm.
  const double length = 160, wall = length * 7 - 15 * 2;
  const double plate = length * 40 - 200 - 200 + wall;
  const double standing = wall + 15 + 3.14159265 * 9 + 150;  // ramp, pin, fence
  CHECK(volume(facets) == Approx(2 * plate + 4 * standing).margin(1));
  float z_min = 1e9F, z_max = -1e9F;
  for (const Facet& facet : facets) {
    for (const auto& p : facet.corners) {
      z_min = std::min(z_min, p.z());
      z_max = std::max(z_max, p.z());
    }
  }
  CHECK(z_min == 0);
  CHECK(z_max == 6);
}

TEST_CASE("a plain track has a wall and a plate under both") {
  TrackDrawing drawing;
  drawing.track_width_mm = 40;
  const std::vector<Facet> facets = reread(track_stl(drawing));
  check_closed(facets);
  CHECK(volume(facets) == Approx(60 * (45 * 3 + 5 * 10)));
}

TEST_CASE("a joint in three dimensions is its fixed shapes and those that touch are one") {
  JointDrawing drawing;
  drawing.title = "joint";
  drawing.fixed_mm = {rectangle(0, 0, 10, 30), rectangle(20, 0, 30, 30), rectangle(0, -5, 30, 0)};
  drawing.thickness_mm = 8;
  const std::vector<Facet> facets = reread(joint_stl(drawing));
  check_closed(facets);
  CHECK(volume(facets) == Approx(8 * 750));
}

TEST_CASE("admesh finds nothing to repair where it is installed") {
  if (!std::filesystem::exists("/usr/bin/admesh")) return;
  const auto path = std::filesystem::temp_directory_path() / ("stl_test_" + std::to_string(::getpid()) + ".stl");
  std::ofstream(path, std::ios::binary) << track_stl(track());
  FILE* pipe = popen(("/usr/bin/admesh " + path.string() + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string said;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) said += buffer;
  CHECK(pclose(pipe) == 0);
  std::filesystem::remove(path);
  CAPTURE(said);
  for (const char* what : {"Total disconnected facets        :     0 ", "Degenerate facets     :     0",
                           "Edges fixed           :     0", "Backwards edges       :     0"})
    CHECK(said.find(what) != std::string::npos);
}
