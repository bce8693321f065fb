// Compares the contact queries with the exact witnesses in as many placements as asked for:
//   witness_configurations [COUNT] [SEED]
// Prints how many answers (free, touching, overlapping) differ and how near to touching these are, and the largest
// errors of distances and depths. Fails when a wrong answer lies outside the band.
#include <cstdio>
#include <cstdlib>

#include "witness/minkowski_scenes.hpp"

namespace {

constexpr double kBand_mm = 1.002e-9;  // kTouching_mm of the contact queries, and rounding

}  // namespace

int main(int argc, char** argv) {
  using namespace formotion;
  const long count = argc > 1 ? std::atol(argv[1]) : 100000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const char* names[] = {"random", "on a grid", "grown", "pins"};
  bool fine = true;
  for (int kind = 0; kind < 4; ++kind) {
    witness::Random random(seed + static_cast<std::uint64_t>(kind));
    witness::Agreement total;
    const long share = kind == 0 ? count - 3 * (count / 5) : count / 5;
    witness::ContactScene scene;
    for (long i = 0; i < share; ++i) {
      if (i % 20 == 0) {
        scene = kind == 0   ? witness::random_scene(random)
                : kind == 1 ? witness::grid_scene(random)
                            : witness::round_scene(random, kind == 3);
      }
      const Configuration q =
          kind == 1 ? witness::grid_placement(random, scene) : witness::random_placement(random, scene);
      const witness::Agreement one = witness::compare_clearance(scene, q, kind == 0 && i % 100 == 7);
      total.add(one);
      if (one.band_mm <= kBand_mm && one.distance_error_mm <= kBand_mm && one.depth_error_mm <= kBand_mm) continue;
      fine = false;
      std::printf("%s %ld: (%.17g, %.17g, %.17g) found %.12g; band %.3g, errors %.3g, %.3g\n", names[kind], i, q.x_mm,
                  q.y_mm, q.theta_rad, clearance_mm(scene.part, scene.obstacles, q), one.band_mm, one.distance_error_mm,
                  one.depth_error_mm);
    }
    std::printf(
        "%s: %ld placements, %ld overlapping, %ld touching; %ld signs differ, all within %.3g mm; %ld distances within "
        "%.3g mm, %ld depths within %.3g mm\n",
        names[kind], total.placements, total.overlapping, total.touching, total.unlike, total.band_mm, total.distances,
        total.distance_error_mm, total.depths, total.depth_error_mm);
    std::fflush(stdout);
  }
  return fine ? 0 : 1;
}
