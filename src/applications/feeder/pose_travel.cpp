#include "applications/feeder/pose_travel.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

#include "analysis/geometry/boolean.hpp"

namespace formotion::feeder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kGravity_mm_s2 = 9810;
constexpr double kTipDrop_mm = 1;
constexpr double kThinLip_mm = 1;  // lips thinner than this are likely not meant

struct Group {
  VoidGroup voids;
  std::shared_ptr<GroupPassages> passages;
};

std::string mm(double value) {
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << (std::abs(value) < 0.005 ? 0 : value) << " mm";  // no -0.00
  return out.str();
}

std::string named(const Layout& layout, int feature) {
  return "feature " + std::to_string(feature) + " (" + layout.features[feature].type + ")";
}

// The feature of the group that the pose covers most of its length at x.
int feature_under(const VoidGroup& group, const Layout& layout, const PoseModel& pose, double x) {
  int best = group.features.front();
  double most = -kInfinity;
  for (const int i : group.features) {
    const LaidFeature& feature = layout.features[i];
    const double common = std::min(feature.x_max, x + pose.x_max) - std::max(feature.x_min, x + pose.x_min);
    if (common > most) {
      most = common;
      best = i;
    }
  }
  return best;
}

// How a lost part tips over the first tipping edge.
struct Tipping {
  double gyration_squared = 0;  // mm^2, about the axis through the centre of mass along the edge
  double nose_mm = 0;           // the farthest material beyond the edge
  double reach_mm = kInfinity;  // forward travel until the nose is over the void's far edge
};

Tipping tipping_of(const PoseModel& pose, const SupportLoss& loss, const VoidOutline& outline) {
  Point direction = loss.tipping.empty() ? Point(0, 0) : Point(loss.tipping.front().to - loss.tipping.front().from);
  const Point from = loss.tipping.empty() ? Point(0, 0) : loss.tipping.front().from;
  if (direction.norm() < 1e-9) direction = from.norm() > 0 ? Point(from.y(), -from.x()) : Point(0, 1);
  direction.normalize();
  const Point normal(direction.y(), -direction.x());
  const AreaMoments moments = area_moments(pose.footprint);
  Tipping tipping;
  tipping.gyration_squared =
      normal.dot(moments.second_mm4 * normal) / moments.area_mm2 + pose.height_mm * pose.height_mm / 12;
  const Point on_line = from + Point(0, pose.travelling.supported_y_mm);
  for (const Point& p : pose.footprint.outer) tipping.nose_mm = std::max(tipping.nose_mm, normal.dot(p - on_line));
  for (const Point& p : pose.footprint.outer) {
    if (normal.dot(p - on_line) < tipping.nose_mm - 1e-6) continue;
    for (const Interval& slice : void_slice(outline, p.y())) {
      const double x = p.x() + loss.x_mm;
      if (slice.from - 1e-6 <= x && x < slice.to) tipping.reach_mm = std::min(tipping.reach_mm, slice.to - x);
    }
  }
  return tipping;
}

// Travel at speed v in which the nose, r beyond the tipping edge, drops by h while the centre of mass is d beyond it:
// angular acceleration g d / (rho^2 + d^2), so h = r g d t^2 / (2 (rho^2 + d^2)) (derived, docs/feeder.md).
std::optional<double> drop_travel(const Tipping& tipping, double d, double h, double v) {
  if (!(d > 0) || !(tipping.nose_mm > 0)) return std::nullopt;
  return v * std::sqrt(2 * h * (tipping.gyration_squared + d * d) / (kGravity_mm_s2 * d * tipping.nose_mm));
}

class Judge {
 public:
  Judge(const PartModel& part, const Layout& layout, const Environment& environment, bool detail, Passages& passages)
      : part_(part), layout_(layout), environment_(environment), detail_(detail), sweeps_(passages.sweeps) {
    for (VoidGroup& group : grouped_in_own_frames(layout, part.longest_mm)) {
      auto past = passages.past(group, held_from(group.origin_mm, part, layout));
      groups_.push_back({std::move(group), std::move(past)});
    }
  }

  PoseTravel operator()(int index) {
    const PoseModel& pose = part_.poses[index];
    PoseTravel travel;
    PoseResult& result = travel.result;
    result.aspect = part_.shapes[pose.stable.aspect].name;
    result.orientation_rad = pose.stable.orientation_rad;
    result.prior = pose.stable.prior;

    const double plain = pose.travelling.plain_margin_mm;
    if (plain < kLost_mm) return never_stands(index, travel);
    // The least margin decides what is delivered; of a lost pose the first loss decides.
    LeastMargin least;
    int least_group = -1, lost_group = -1;
    std::vector<double> lost_margin(groups_.size(), kInfinity);
    SupportLoss first;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const LeastMargin& found = groups_[g].passages->least(index, sweeps_);
      if (found.margin_mm < least.margin_mm) {
        least = found;
        least_group = static_cast<int>(g);
      }
      // A rail may let go of a pose over nothing at all: a loss without a margin.
      const bool lost = found.margin_mm < kLost_mm || found.unsupported;
      if (!lost || lost_group >= 0) continue;  // groups come in the order of travel
      first = groups_[g].passages->loss(index, detail_);
      if (!first.lost) continue;  // below zero for less than the event tolerance
      lost_group = static_cast<int>(g);
      lost_margin[g] = found.margin_mm;
    }
    const int blade = first_blade(pose);
    const double blade_x = blade < 0 ? kInfinity : layout_.features[blade].start_mm - pose.x_max;
    const double clearance = blade_clearance(pose, layout_);
    if (lost_group < 0 && blade < 0) {
      result.outcome = Outcome::Delivered;
      result.exit_orientation_rad = result.orientation_rad;
      result.margin_mm = std::max(0.0, std::min(least.margin_mm, plain));
      result.marginal = std::min(*result.margin_mm, clearance) < kMarginal_mm;
      travel.nominal_mm = std::min(*result.margin_mm, clearance);
      if (least.margin_mm < plain - kMarginal_mm) {
        result.decided_by = decision(groups_[least_group], pose, least.x_mm);
      }
      if (detail_) tell_delivered(result);
      return travel;
    }
    const double depth = std::min(part_.diameter_mm, std::max({0.0, -std::min(least.margin_mm, plain), -clearance}));
    result.margin_mm = depth;
    result.marginal = depth < kMarginal_mm;
    travel.nominal_mm = depth;
    if (blade >= 0 && (lost_group < 0 || blade_x <= groups_[lost_group].voids.origin_mm + first.x_mm)) {
      const bool rail = layout_.features[blade].holds_down;
      result.outcome = rail ? Outcome::Jammed : Outcome::Rejected;
      if (rail) travel.lacking_mm = pose.height_mm - *layout_.features[blade].blade_mm;
      result.decided_by = Decision{blade, blade_x};
      if (detail_) {
        result.reason = mm(pose.height_mm) + " high, " + mm(-clearance) + " too high for " + named(layout_, blade) +
                        (rail ? ", which stops it" : ", which pushes it off");
      }
      return travel;
    }
    Group& group = groups_[lost_group];
    travel.lacking_mm = group.passages->shortfall(index, environment_.track_width_mm);
    result.outcome = travel.lacking_mm == 0 ? Outcome::Rejected : Outcome::Jammed;
    result.decided_by = decision(group, pose, first.x_mm);
    if (detail_) describe_loss(pose, first, group, -lost_margin[lost_group], result);
    return travel;
  }

 private:
  Decision decision(const Group& group, const PoseModel& pose, double x_mm) const {
    const double x = group.voids.origin_mm + x_mm;
    return {feature_under(group.voids, layout_, pose, x), x};
  }

  int first_blade(const PoseModel& pose) const {
    int first = -1;
    for (int i = 0; i < static_cast<int>(layout_.features.size()); ++i) {
      const LaidFeature& feature = layout_.features[i];
      if (!feature.blade_mm || pose.height_mm <= *feature.blade_mm) continue;
      if (first < 0 || feature.start_mm < layout_.features[first].start_mm) first = i;
    }
    return first;
  }

  // Lost before the first feature; features may make the loss deeper.
  PoseTravel never_stands(int index, PoseTravel travel) {
    const PoseModel& pose = part_.poses[index];
    double least = std::min(pose.travelling.plain_margin_mm, blade_clearance(pose, layout_));
    for (const Group& group : groups_) least = std::min(least, group.passages->least(index, sweeps_).margin_mm);
    const double depth = std::min(part_.diameter_mm, -least);
    travel.result.outcome = pose.footprint_reaches(environment_.track_width_mm) ? Outcome::Rejected : Outcome::Jammed;
    travel.result.margin_mm = depth;
    travel.nominal_mm = depth;
    travel.result.reason = "the plain track does not hold it: its centre of mass lies " +
                           mm(-pose.travelling.plain_margin_mm) + " beyond its support";
    return travel;
  }

  void tell_delivered(PoseResult& result) const {
    result.reason = result.decided_by
                        ? "supported all the way; least margin " + mm(*result.margin_mm) +
                              " at x = " + mm(result.decided_by->x_mm) + ", over " +
                              named(layout_, result.decided_by->feature)
                        : "supported all the way, nowhere less than on the plain track (" + mm(*result.margin_mm) + ")";
    if (result.marginal) result.reason += "; marginal: the least error loses it";
  }

  void describe_loss(const PoseModel& pose, const SupportLoss& loss, const Group& group, double depth,
                     PoseResult& result) const {
    double unsupported = 0;
    for (const Interval& stretch : loss.lost_mm) unsupported += stretch.to - stretch.from;
    result.unsupported_mm = unsupported;
    const Tipping tipping = tipping_of(pose, loss, group.passages->outline());
    const double v = environment_.conveying_speed_mm_s;
    result.tip_mm = drop_travel(tipping, depth, kTipDrop_mm, v);
    const std::optional<double> through = drop_travel(tipping, depth, pose.height_mm, v);
    result.may_catch = std::isfinite(tipping.reach_mm) && (!through || tipping.reach_mm < *through);
    result.reason = "loses its support at x = " + mm(result.decided_by->x_mm) + " over " +
                    named(layout_, result.decided_by->feature) + ", by up to " + mm(depth) + " for " + mm(unsupported) +
                    " of travel; ";
    result.reason += result.outcome == Outcome::Rejected
                         ? "the void lets it fall"
                         : "the void neither opens to the free edge by its thickness nor lets it through edgewise";
    if (result.may_catch) result.reason += "; its nose may catch on the far edge";
    if (result.marginal) result.reason += "; marginal: the least error keeps it";
  }

  const PartModel& part_;
  const Layout& layout_;
  const Environment& environment_;
  bool detail_;
  std::int64_t& sweeps_;
  std::vector<Group> groups_;
};

double segment_distance(const Point& a, const Point& b, const Point& c, const Point& d) {
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)});
}

}  // namespace

std::vector<PoseTravel> travel_all(const PartModel& part, const Layout& layout, const Environment& environment,
                                   bool detail) {
  Passages passages(part);
  return travel_all(part, layout, environment, detail, passages);
}

std::vector<PoseTravel> travel_all(const PartModel& part, const Layout& layout, const Environment& environment,
                                   bool detail, Passages& passages) {
  Judge judge(part, layout, environment, detail, passages);
  std::vector<PoseTravel> travels;
  travels.reserve(part.poses.size());
  for (std::size_t i = 0; i < part.poses.size(); ++i) {
    const PoseModel& pose = part.poses[i];
    PoseTravel travel = judge(static_cast<int>(i));
    travel.aspect = pose.stable.aspect;
    travel.extent_mm = pose.x_max - pose.x_min;
    if (travel.result.outcome == Outcome::Delivered) travel.exit_pose = travel.exit_class = static_cast<int>(i);
    travels.push_back(std::move(travel));
  }
  return travels;
}

void check_webs(const Layout& layout, double least_mm, double track_width_mm, std::vector<Violation>& violations) {
  // Voids that touch are one; what stands between different ones must hold.
  std::vector<std::pair<Polygon, int>> pieces;
  for (const VoidGroup& group : grouped(layout, least_mm)) {
    for (VoidPieces::Piece& piece : void_pieces(group, track_width_mm).pieces) {
      int owner = group.features.front();
      for (const int i : group.features) {
        for (const Loop& loop : layout.features[i].voids) {
          if (locate(loop, piece.polygon.outer.front(), 1e-6) != Side::Outside) owner = i;
        }
      }
      pieces.emplace_back(std::move(piece.polygon), owner);
    }
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double web = kInfinity;
      for (const Loop& a : loops_of(pieces[i].first)) {
        for (const Loop& b : loops_of(pieces[j].first)) {
          for (std::size_t k = 0; k < a.size(); ++k) {
            for (std::size_t l = 0; l < b.size(); ++l) {
              web = std::min(web, segment_distance(a[k], a[(k + 1) % a.size()], b[l], b[(l + 1) % b.size()]));
            }
          }
        }
      }
      if (web < least_mm) {
        violations.push_back({"the web between two voids is only " + mm(web) + " wide",
                              named(layout, pieces[j].second) + " and " + named(layout, pieces[i].second),
                              least_mm - web});
      }
    }
  }
}

void collect_warnings(const std::vector<PoseTravel>& travels, const Layout& layout, const Environment& environment,
                      std::vector<std::string>& warnings) {
  for (const PoseTravel& travel : travels) {
    const PoseResult& pose = travel.result;
    std::ostringstream who;
    who << "pose " << pose.aspect << " " << std::fixed << std::setprecision(2)
        << pose.orientation_rad * 180 / std::numbers::pi << " deg: ";
    if (pose.marginal) warnings.push_back(who.str() + "marginal: decided by less than a millionth of a millimetre");
    if (pose.unsupported_mm && pose.tip_mm && *pose.unsupported_mm < *pose.tip_mm) {
      warnings.push_back(who.str() + "unsupported for " + mm(*pose.unsupported_mm) + " only, but needs " +
                         mm(*pose.tip_mm) + " to tip");
    }
    if (pose.may_catch) warnings.push_back(who.str() + "its nose may catch on the void's far edge");
  }
  for (std::size_t i = 0; i < layout.features.size(); ++i) {
    for (const Loop& loop : layout.features[i].voids) {
      // The metal is closed: even a lip of no width between a void and the edge that it is drawn to holds a part.
      const Box box = bounding_box(loop);
      const auto warn = [&](double lip_mm, const std::string& edge) {
        if (lip_mm < 0 || lip_mm >= kThinLip_mm) return;
        warnings.push_back(named(layout, static_cast<int>(i)) + " ends " + mm(lip_mm) + " before " + edge +
                           ": draw it past there if it shall be open");
      };
      warn(environment.track_width_mm - box.max.y(), "the free edge");
      warn(box.min.y(), "the wall");
    }
  }
}

}  // namespace formotion::feeder
