// 360 starting orientations of each scene through forward projection and through Box2D: how often they agree, where
// they do not, and what a start costs in both.
//
// Disagreements are sorted by how far the start is from one with another outcome: within a degree of orientation (the
// starts are a degree apart), within obstacles that are 0.1 mm larger or smaller (Box2D's slop and skin come to 0.05 mm
// a contact, and a jam has two), or neither. The last kind is listed. Starts that forward projection calls ambiguous or
// undecided are counted apart.
//
// compare_box2d [finer]: with "finer", those listed go through Box2D again in steps of 0.05 mm with 100 velocity and 50
// position iterations and a tenth of the slop.
// compare_box2d random COUNT SEED: 30 starts of each of COUNT random scenes.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "analysis/motion/contact_space.hpp"
#include "turning_scenes.hpp"

namespace {

using namespace formotion;
using namespace formotion::bench;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSameOrientation_rad = 3 * kDegree;  // Box2D's slop lets a part rest up to 0.3 degrees off
constexpr double kSlop_mm = 0.05;                     // b2_linearSlop

struct Fate {
  enum class End { Delivered, Stuck, None } end = End::None;
  Configuration last;
  std::string why;
};

bool same(const Fate& a, const Fate& b) {
  if (a.end != b.end || a.end == Fate::End::None) return false;
  return a.end == Fate::End::Stuck ||
         std::abs(std::remainder(a.last.theta_rad - b.last.theta_rad, 2 * std::numbers::pi)) < kSameOrientation_rad;
}

std::string words(const Fate& fate) {
  const double degrees = std::fmod(fate.last.theta_rad / kDegree + 3600, 360);
  char text[200];
  const char* end = fate.end == Fate::End::Delivered ? "delivered" : fate.end == Fate::End::Stuck ? "stuck" : "none";
  std::snprintf(text, sizeof text, "%s at x %.2f y %.2f, %.2f deg%s%s", end, fate.last.x_mm, fate.last.y_mm, degrees,
                fate.why.empty() ? "" : ": ", fate.why.c_str());
  return text;
}

Fate projected(const ContactSpace& space, const TurningScene& scene, double theta) {
  ProjectionOptions options;
  options.keep_path = false;
  const Projection went = project(space, scene.drive, start_at(scene, theta), options);
  Fate fate{Fate::End::None, went.last, went.why};
  if (went.end == ProjectionEnd::Steady) fate.end = Fate::End::Delivered;
  if (went.end == ProjectionEnd::AtRest) fate.end = Fate::End::Stuck;
  return fate;
}

Fate simulated(const TurningScene& scene, double theta, const Box2dOptions& options = {}) {
  const Box2dOutcome went = run_box2d(box2d_track(scene), start_at(scene, theta), options);
  Fate fate{Fate::End::None, went.last, ""};
  if (went.end == Box2dOutcome::End::Delivered) fate.end = Fate::End::Delivered;
  if (went.end == Box2dOutcome::End::Stuck) fate.end = Fate::End::Stuck;
  return fate;
}

// Whether forward projection changes its outcome within a degree of this start.
bool near_boundary(const ContactSpace& space, const TurningScene& scene, double theta, const Fate& here) {
  for (const double off : {0.25, 0.5, 0.75, 1.0}) {
    if (!same(here, projected(space, scene, theta - off * kDegree))) return true;
    if (!same(here, projected(space, scene, theta + off * kDegree))) return true;
  }
  return false;
}

double start_angle(int i, int starts) { return (i + 0.5) * 2 * std::numbers::pi / starts; }

template <class F>
double milliseconds_a_start(int starts, const F& run) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < starts; ++i) run(i);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count() / starts;
}

void compare(const TurningScene& scene, int starts, bool finer) {
  const MovingShape part = MovingShape::of({scene.part}, scene.gyration_mm);
  const Obstacles obstacles = *make_obstacles(scene.obstacles);
  const ContactSpace space(part, obstacles);
  std::vector<Fate> exact(starts), engine(starts);
  const double exact_ms =
      milliseconds_a_start(starts, [&](int i) { exact[i] = projected(space, scene, start_angle(i, starts)); });
  const double engine_ms =
      milliseconds_a_start(starts, [&](int i) { engine[i] = simulated(scene, start_angle(i, starts)); });
  const Obstacles larger = *make_obstacles(scene.obstacles, kSlop_mm);
  const Obstacles smaller = *make_obstacles(scene.obstacles, -kSlop_mm);
  const ContactSpace larger_space(part, larger), smaller_space(part, smaller);
  int agree = 0, unanswered = 0, at_boundary = 0, within_slop = 0;
  int first_unanswered = -1;
  std::vector<int> elsewhere;
  for (int i = 0; i < starts; ++i) {
    if (same(exact[i], engine[i])) {
      ++agree;
    } else if (exact[i].end == Fate::End::None) {
      ++unanswered;
      if (first_unanswered < 0) first_unanswered = i;
    } else if (near_boundary(space, scene, start_angle(i, starts), exact[i])) {
      ++at_boundary;
    } else if (!same(exact[i], projected(larger_space, scene, start_angle(i, starts))) ||
               !same(exact[i], projected(smaller_space, scene, start_angle(i, starts)))) {
      ++within_slop;
    } else {
      elsewhere.push_back(i);
    }
  }
  std::printf("| %s | %d | %d | %d | %d | %d | %zu | %.3f | %.2f | %.1f |\n", scene.name.c_str(), starts, agree,
              unanswered, at_boundary, within_slop, elsewhere.size(), exact_ms, engine_ms, engine_ms / exact_ms);
  if (first_unanswered >= 0) {
    std::printf("  %.1f deg, the first without an answer: %s; Box2D %s\n",
                start_angle(first_unanswered, starts) / kDegree, words(exact[first_unanswered]).c_str(),
                words(engine[first_unanswered]).c_str());
  }
  for (const int i : elsewhere) {
    std::printf("  %.1f deg: projection %s; Box2D %s", start_angle(i, starts) / kDegree, words(exact[i]).c_str(),
                words(engine[i]).c_str());
    if (finer)
      std::printf("; finer %s", words(simulated(scene, start_angle(i, starts), {0.05, 100, 50, 1'000'000, 1})).c_str());
    std::printf("\n");
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  std::printf(
      "| scene | starts | agree | ambiguous | within 1 degree | within 0.1 mm | elsewhere | projection, ms | Box2D, "
      "ms | ratio "
      "|\n");
  std::printf("|---|---|---|---|---|---|---|---|---|---|\n");
  if (mode == "random" && argc > 3) {
    const std::uint64_t first = std::stoull(argv[3]), count = std::stoull(argv[2]);
    for (std::uint64_t k = 0; k < count; ++k) compare(random_scene(first + k), 30, true);
    return 0;
  }
  for (const TurningScene& scene : turning_scenes()) compare(scene, 360, mode == "finer");
}
