// Escape heights in random nests: laws that brackets keep, and walks that look for a lower way.
#include <catch2/catch.hpp>

#include "analysis/energy/nests.hpp"

using namespace formotion;
using namespace formotion::testing;

namespace {

struct Walks {
  bool got_out = false;
  double highest_mm = -1e300;
};

// Trees of small free motions from the start that stay below a height, as random trees grow (LaValle 1998): towards
// random places, from the nearest place known. Motions are sampled.
Walks grow_tree(const Nest& nest, const Configuration& start, double below_mm, int steps, witness::Random& random) {
  Walks walks;
  const double reach = nest.part.reach_mm;
  std::vector<Configuration> tree{start};
  for (int i = 0; i < steps && !walks.got_out; ++i) {
    const bool outward = i % 4 == 0;
    const Configuration goal{outward ? (i % 8 ? -50 : 50) : witness::uniform(random, -50, 50),
                             outward ? below_mm : witness::uniform(random, -25, below_mm),
                             start.theta_rad + witness::uniform(random, -4, 4)};
    const auto distance = [&](const Configuration& q) {
      return std::hypot(q.x_mm - goal.x_mm, q.y_mm - goal.y_mm, reach * (q.theta_rad - goal.theta_rad));
    };
    const Configuration from = *std::min_element(
        tree.begin(), tree.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    const double step = std::min(1.0, witness::uniform(random, 0.1, 4) / std::max(distance(from), 1e-9));
    const Configuration to{std::lerp(from.x_mm, goal.x_mm, step), std::lerp(from.y_mm, goal.y_mm, step),
                           std::lerp(from.theta_rad, goal.theta_rad, step)};
    if (to.y_mm >= below_mm || nest.overlaps_on({from, to}, 12) > 0) continue;
    tree.push_back(to);
    walks.highest_mm = std::max(walks.highest_mm, to.y_mm);
    walks.got_out = nest.is_out(to);
  }
  return walks;
}

}  // namespace

TEST_CASE("brackets of random nests are as narrow as asked and their paths are free and lead out") {
  int rising = 0;
  for (int i = 0; i < 40; ++i) {
    const RandomNest drawn(i);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm);
    if (!nest.is_free(drawn.start)) continue;
    const EscapeBracket found = nest.escape(drawn.start);
    CAPTURE(i, found.lower_mm, found.why);
    CHECK(found.lower_mm >= 0);
    if (found.why == "enclosed") continue;
    REQUIRE(found.upper_mm);
    CHECK(*found.upper_mm >= found.lower_mm);
    CHECK(*found.upper_mm - found.lower_mm <= 0.1);
    CHECK(nest.overlaps_on(found.path) == 0);
    CHECK(nest.is_out(found.path.back()));
    CHECK(nest.highest_on(found.path) - drawn.start.y_mm == Approx(*found.upper_mm).margin(1e-9));
    rising += found.lower_mm > 0.5;
  }
  CHECK(rising > 10);
}

TEST_CASE("brackets of several gaps hold the same height") {
  for (int i = 0; i < 24; ++i) {
    const RandomNest drawn(i);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm);
    if (!nest.is_free(drawn.start)) continue;
    double lower = 0, upper = 1e300;
    for (const double gap : {2.0, 0.5, 0.1}) {
      EscapeOptions options;
      options.gap_mm = gap;
      const EscapeBracket found = nest.escape(drawn.start, options);
      if (found.why == "enclosed") break;
      lower = std::max(lower, found.lower_mm);
      if (found.upper_mm) upper = std::min(upper, *found.upper_mm);
      CAPTURE(i, gap, lower, upper);
      CHECK(lower <= upper + 1e-9);
      if (gap == 0.5) CHECK(nest.escape(drawn.start, options).cells == found.cells);
    }
  }
}

TEST_CASE("turning everything and looking from behind change no escape height") {
  for (int i = 0; i < 12; ++i) {
    const RandomNest drawn(i);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm);
    if (!nest.is_free(drawn.start)) continue;
    const EscapeBracket found = nest.escape(drawn.start);
    const auto same = [&](const EscapeBracket& other) {
      CAPTURE(i, found.lower_mm, other.lower_mm);
      REQUIRE(found.upper_mm.has_value() == other.upper_mm.has_value());
      if (!found.upper_mm) return;
      CHECK(other.lower_mm <= *found.upper_mm + 1e-6);
      CHECK(found.lower_mm <= *other.upper_mm + 1e-6);
    };
    const double turned = 0.6 + i;
    const Nest turned_nest(drawn.part, drawn.fixed, drawn.grow_mm, turned);
    const Point at = rotated(drawn.start.position(), turned);
    same(turned_nest.escape({at.x(), at.y(), drawn.start.theta_rad + turned}));
    std::vector<ObstacleShape> mirrored = drawn.fixed;
    for (ObstacleShape& shape : mirrored) shape.area = mirrored_x(shape.area);
    const Nest mirror(mirrored_x(drawn.part), mirrored, drawn.grow_mm);
    same(mirror.escape({-drawn.start.x_mm, drawn.start.y_mm, -drawn.start.theta_rad}));
  }
}

TEST_CASE("no random tree gets out below the lower bound and some do above the upper one") {
  witness::Random random(9);
  int tried = 0, out = 0;
  for (int i = 0; i < 24; ++i) {
    const RandomNest drawn(i);
    const Nest nest(drawn.part, drawn.fixed, drawn.grow_mm);
    if (!nest.is_free(drawn.start)) continue;
    const EscapeBracket found = nest.escape(drawn.start);
    if (!found.upper_mm || found.lower_mm < 0.2) continue;
    CAPTURE(i, found.lower_mm, *found.upper_mm);
    ++tried;
    CHECK_FALSE(grow_tree(nest, drawn.start, drawn.start.y_mm + found.lower_mm, 1200, random).got_out);
    out += grow_tree(nest, drawn.start, drawn.start.y_mm + *found.upper_mm + 4, 2500, random).got_out;
  }
  CHECK(tried > 5);
  CHECK(out > 2);
}
