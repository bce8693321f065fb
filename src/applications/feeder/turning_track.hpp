// A track with obstacles, on which parts turn: forward projection of single starts, with support, voids and blades.
#pragma once

#include <functional>
#include <memory>

#include "analysis/motion/contact_space.hpp"
#include "applications/feeder/path_support.hpp"
#include "applications/feeder/pose_travel.hpp"
#include "applications/feeder/world.hpp"

namespace formotion::feeder {

struct StartTravel {
  Outcome outcome = Outcome::Undecided;
  std::optional<double> exit_rad;  // delivered: the orientation in which it leaves, [0, 2 pi)
  bool settled = false;            // its exit does not change with the start a little: it has been guided by an edge
  double margin_mm = 0;            // delivered: the least on its way; lost: the depth of the loss
  std::optional<Decision> decided_by;
  double lacking_mm = 0;
  bool marginal = false;
  std::string reason;
  std::uint64_t history = 0;
  Projection path;
};

struct TravelOptions {
  bool keep_path = false;
  bool tell = false;  // reasons
  // Told of every stretch and of the part of it (up to 1) that is gone along; of the ways out of ambiguities, too.
  std::function<void(const PathStretch&, double)> seen = {};
};

// How far edges are off.
struct TrackErrors {
  double obstacles_mm = 0, voids_mm = 0;
};

class TurningTrack {
 public:
  // None where shrunk obstacles vanish. part, layout and environment must outlive it.
  static std::optional<TurningTrack> of(const PartModel& part, const Layout& layout, const Environment& environment,
                                        const TrackErrors& errors = {});

  // Where a pose on the wall, and where a part of any orientation on a belt, comes from: before the first feature.
  Configuration pose_start(const PoseModel& pose) const;
  Configuration belt_start(double theta_rad) const;

  StartTravel travel(int aspect, const Configuration& start, const TravelOptions& options = {});
  // For many starts: paths that run into one another are followed once. No margin, no path.
  StartTravel travel_quickly(int aspect, const Configuration& start);

  const World& world(int aspect) const { return aspects_[aspect]->world; }

 private:
  struct Aspect {
    World world;
    ContactSpace space;
    Funnels funnels;
    std::vector<PathLoss> losses;
    explicit Aspect(World w) : world(std::move(w)), space(world.part, world.obstacles) {}
  };
  struct Watch;
  TurningTrack(const PartModel& part, const Layout& layout, const Environment& environment)
      : part_(part), layout_(layout), environment_(environment) {}
  StartTravel run(int aspect, const Configuration& start, const TravelOptions& options, bool quickly);
  StartTravel ended(int aspect, const Projection& path, const Watch& watch, bool tell) const;
  void lost(int aspect, const Projection& path, const PathLoss& loss, bool tell, StartTravel& travel) const;
  int feature_touched(int aspect, const Configuration& q) const;

  const PartModel& part_;
  const Layout& layout_;
  const Environment& environment_;
  double first_mm_ = 0;  // where anything begins
  std::shared_ptr<Floor> floor_;
  std::vector<std::shared_ptr<Aspect>> aspects_;
};

// Whether the drive does not pull parts to the wall: they come in every orientation.
bool is_belt(const Environment& environment);
bool has_obstacles(const Layout& layout);

}  // namespace formotion::feeder
