#include "solid/solid.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "analysis/geometry/boolean.hpp"
#include "solid/reread.hpp"
#include "solid/stl.hpp"

using namespace formotion;

namespace {

Polygon box(double x_min, double y_min, double x_max, double y_max) {
  return {rectangle(x_min, y_min, x_max, y_max), {}};
}

// Written and read again; a closed solid whatever it is of.
std::vector<Facet> closed(const std::vector<Layer>& layers) {
  const std::vector<Facet> facets = reread(stl(stacked(layers), "test"));
  CHECK(open_edges(facets) == 0);
  CHECK(bad_facets(facets) == 0);
  return facets;
}

double area(const std::vector<Polygon>& polygons) {
  std::vector<Loop> loops = loops_of(polygons);
  double sum = 0;
  for (const Loop& loop : loops_of(united(loops))) sum += signed_area(loop);
  return sum;
}

}  // namespace

TEST_CASE("a box has twelve triangles and its volume") {
  const std::vector<Facet> facets = closed({{{box(-3, 2, 7, 4.5)}, 4}});
  CHECK(facets.size() == 12);
  CHECK(volume(facets) == Approx(100));
}

TEST_CASE("a plate with holes encloses its area times its height") {
  Polygon plate = box(0, 0, 40, 20);
  Loop round;
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::numbers::pi * i / 60;
    round.emplace_back(30 - 5.3 * std::cos(angle), 10 + 5.3 * std::sin(angle));
  }
  plate.holes = {{{5, 5}, {5, 15}, {15, 15}, {15, 5}}, round};
  const std::vector<Facet> facets = closed({{{plate}, 2.5}});
  CHECK(volume(facets) == Approx(2.5 * area_moments(plate).area_mm2).margin(2.5 * 120 * 1e-4));
}

TEST_CASE("pieces apart are solids of their own and pieces that overlap are one") {
  CHECK(closed({{{box(0, 0, 1, 1), box(2, 0, 3, 1)}, 1}}).size() == 24);
  CHECK(volume(closed({{{box(0, 0, 2, 1), box(1, 0, 3, 1)}, 1}})) == Approx(3));
  CHECK(closed({{{box(0, 0, 1, 1), box(1, 0, 3, 1)}, 1}}).size() == 12);  // an edge in common
}

TEST_CASE("what touches in a corner is joined there by a hundredth of a millimetre") {
  const std::vector<Facet> facets = closed({{{box(0, 0, 10, 10), box(10, 10, 20, 20)}, 2}});
  CHECK(volume(facets) > 400);
  CHECK(volume(facets) < 400 + 2 * 4 * 0.01 * 0.01);
}

TEST_CASE("two holes that touch in a corner are parted there") {
  Polygon plate = box(0, 0, 30, 30);
  plate.holes = {{{5, 5}, {5, 15}, {15, 15}, {15, 5}}, {{15, 15}, {15, 25}, {25, 25}, {25, 15}}};
  CHECK(volume(closed({{{plate}, 1}})) == Approx(700).margin(0.001));
}

TEST_CASE("a layer upon another has faces where either ends") {
  // Flush on one side, standing out on another, inside, in a hole's place, and touching along a line from outside.
  Polygon plate = box(0, 0, 40, 20);
  plate.holes = {{{20, 5}, {20, 15}, {30, 15}, {30, 5}}};
  const double area_mm2 = area_moments(plate).area_mm2;
  CHECK(volume(closed({{{plate}, 3}, {{box(0, 5, 5, 10)}, 2}})) == Approx(3 * area_mm2 + 50));
  CHECK(volume(closed({{{plate}, 3}, {{box(35, 5, 45, 10)}, 2}})) == Approx(3 * area_mm2 + 100));
  CHECK(volume(closed({{{plate}, 3}, {{box(20, 5, 30, 15)}, 2}})) == Approx(3 * area_mm2 + 200).margin(2));
  CHECK(volume(closed({{{plate}, 3}, {{box(5, 20, 10, 25)}, 2}})) == Approx(3 * area_mm2 + 50).margin(0.5));
  CHECK(volume(closed({{{plate}, 3}, {{box(0, 0, 40, 20)}, 2}, {{box(1, 1, 2, 2)}, 4}})) ==
        Approx(3 * area_mm2 + 1604));
}

TEST_CASE("nothing is a file without facets") {
  CHECK(stacked({}).triangles.empty());
  CHECK(stacked({{{}, 3}}).triangles.empty());
  CHECK(stacked({{{box(0, 0, 1, 1)}, 0}}).triangles.empty());
  CHECK(stacked({{{box(0, 0, 1, 1e-6)}, 1}}).triangles.empty());
  CHECK(stl({}, "none").size() == 84);
}

TEST_CASE("random layers far from the origin are closed and enclose what they are made of") {
  std::mt19937 random(7);
  const auto number = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  for (int round = 0; round < 60; ++round) {
    // Corners on a coarse lattice in every second round: many touch and are in line.
    const bool lattice = round % 2 == 0;
    const double away = round % 3 == 0 ? 900 : 0;
    std::vector<Layer> layers(3);
    double expected = 0, edges = 0;
    for (Layer& layer : layers) {
      layer.height_mm = 1 + static_cast<double>(random() % 4);
      for (int i = 0; i < 6; ++i) {
        Loop loop;
        for (int k = 0; k < 3; ++k) {
          Point p(number(0, 12), number(0, 12));
          if (lattice) p = {std::floor(p.x()), std::floor(p.y())};
          loop.push_back(p + Point(away, 0));
        }
        if (std::abs(signed_area(loop)) < 1e-9) continue;
        layer.area.push_back(normalised({loop, {}}));
        edges += 3 * diameter(loop);
      }
      expected += area(layer.area) * layer.height_mm;
    }
    CAPTURE(round);
    const std::vector<Facet> facets = closed(layers);
    // Joints are a few, each less than 0.02 mm wide along an edge at most.
    CHECK(volume(facets) == Approx(expected).margin(0.1 + edges * 1e-3));
  }
}

TEST_CASE("the same solid has the same bytes and a header that names it in ASCII") {
  const std::vector<Layer> layers{{{box(0, 0, 10, 5), box(10, 5, 12, 7)}, 2}, {{box(0, 5, 3, 8)}, 1}};
  const std::string once = stl(stacked(layers), "solid \u00e4 \n");
  CHECK(once == stl(stacked(layers), "solid \u00e4 \n"));
  CHECK(once.substr(0, 40) == "Formotion, binary STL in mm: solid ?? ? ");
  CHECK(stl(stacked(layers), std::string(500, 'x')).size() == once.size());
}
