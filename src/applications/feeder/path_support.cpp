#include "applications/feeder/path_support.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/constraints/hull_margin.hpp"
#include "analysis/geometry/boolean.hpp"
#include "analysis/geometry/offset.hpp"
#include "applications/feeder/pose_travel.hpp"

namespace formotion::feeder {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLongestPiece_mm = 4;
constexpr double kMarginPiece_mm =
    0.05;  // the least margin of a turning piece is that of places this near to each other
constexpr double kBeyond_mm = 1e4;

Box grown(Box box, double by) {
  box.min.array() -= by;
  box.max.array() += by;
  return box;
}

template <class Change>
void each_point(Polygon& polygon, const Change& change) {
  for (Point& p : polygon.outer) p = change(p);
  for (Loop& hole : polygon.holes) {
    for (Point& p : hole) p = change(p);
  }
}

}  // namespace

Floor Floor::of(std::vector<VoidGroup> groups, double width_mm, std::vector<Interval> recesses) {
  Floor floor;
  floor.groups = std::move(groups);
  floor.width_mm = width_mm;
  floor.recesses = std::move(recesses);
  for (const VoidGroup& group : floor.groups) {
    Box box;
    for (const Loop& loop : group.loops) {
      for (const Point& p : loop) box.include(p);
    }
    floor.boxes.push_back(box);
  }
  return floor;
}

const Track& Floor::eroded(double by_mm) const {
  const auto known = eroded_.find(by_mm);
  if (known != eroded_.end()) return known->second;
  std::vector<Loop> loops;
  for (const VoidGroup& group : groups) {
    const std::vector<Loop> grown = by_mm > 0 ? offset(group.loops, by_mm) : group.loops;
    loops.insert(loops.end(), grown.begin(), grown.end());
  }
  // The rim at the wall's face is an edge of the metal as well.
  if (by_mm > 0) loops.push_back(rectangle(-kBeyond_mm, -1, kBeyond_mm, by_mm));
  return eroded_.emplace(by_mm, Track{width_mm - by_mm, united(loops)}).first->second;
}

PathSupport::PathSupport(const AspectShape& shape, const Floor& floor, const Environment& environment)
    : shape_(shape), floor_(floor), environment_(environment), shift_(wall_shift(shape.com_height_mm, environment)) {
  for (const Point& p : shape.footprint.outer) reach_ = std::max(reach_, p.norm());
  // Wherever the whole footprint is on metal; the supported point may lie anywhere on a circle about the centre of
  // mass.
  plain_ = hull_margin(shape.footprint.outer).margin_mm - std::abs(shift_);
}

double PathSupport::margin_on(const Track& track, const Configuration& q) const {
  const Polygon part = placed(shape_.footprint, q.theta_rad, q.position());
  return support_margin(part, track, {q.x_mm, q.y_mm - shift_}).value_or(-kInfinity);
}

// The whole footprint on metal.
double PathSupport::plain_margin(double theta_rad) const {
  return hull_margin(placed(shape_.footprint, theta_rad, {0, shift_}).outer).margin_mm;
}

// Everything between two configurations stays on plain track.
bool PathSupport::stands_clear(const Configuration& a, const Configuration& b) const {
  Box box;
  for (const Configuration& q : {a, b}) {
    const Box own = bounding_box(placed(shape_.footprint, q.theta_rad, q.position()).outer);
    box.include(own.min);
    box.include(own.max);
  }
  if (a.theta_rad != b.theta_rad) box = grown(box, farthest_move(a, b));
  const bool behind =
      box.min.y() < -1e-6 && std::any_of(floor_.recesses.begin(), floor_.recesses.end(), [&](const Interval& recess) {
        return recess.from <= box.max.x() && box.min.x() <= recess.to;
      });
  if (behind || box.max.y() > floor_.width_mm) return false;
  return std::none_of(floor_.boxes.begin(), floor_.boxes.end(), [&](const Box& v) {
    return v.min.x() <= box.max.x() && box.min.x() <= v.max.x() && v.min.y() <= box.max.y() && box.min.y() <= v.max.y();
  });
}

// How far any point of the part moves from the middle of a turning piece: half of the way, doubled for bent paths. It
// is then no farther from one of the ends.
double PathSupport::farthest_move(const Configuration& a, const Configuration& b) const {
  return (a.position() - b.position()).norm() + reach_ * std::abs(a.theta_rad - b.theta_rad);
}

std::optional<double> PathSupport::operator()(const PathStretch& stretch) {
  const Configuration a = stretch.at(0), b = stretch.at(1);
  const bool translates = a.theta_rad == b.theta_rad;
  if (stands_clear(a, b)) {
    const double margin = translates && shift_ != 0 ? plain_margin(a.theta_rad) : plain_;
    if (margin >= 0) {
      least_ = std::min(least_, margin);
      return std::nullopt;
    }
  }
  if (translates) {
    const std::optional<double> ends = translate(a, b);
    if (ends) losses_.back().at = stretch.at(*ends);  // bit for bit where the path will say that it stopped
    return ends;
  }
  return turn(stretch, 0, 1, a, b);
}

int PathSupport::group_under(const Configuration& q) const {
  int best = -1;
  double nearest = reach_;
  for (std::size_t g = 0; g < floor_.boxes.size(); ++g) {
    const Box& box = floor_.boxes[g];
    const Point inside = q.position().cwiseMax(box.min).cwiseMin(box.max);
    if ((inside - q.position()).norm() > nearest) continue;
    nearest = (inside - q.position()).norm();
    best = static_cast<int>(g);
  }
  return best;
}

void PathSupport::lose(const Configuration& q, SupportLoss loss, double depth) {
  loss.lost = true;
  loss.x_mm = q.x_mm;
  losses_.push_back({q, std::move(loss), group_under(q), depth});
}

// In a frame whose x runs along the motion; what is beyond the strip is one more void.
std::optional<double> PathSupport::translate(const Configuration& from, const Configuration& to) {
  const Point way = to.position() - from.position();
  const double length = way.norm();
  if (length <= 0) return std::nullopt;
  const Point along = way / length;
  const bool along_track = along.y() == 0 && along.x() > 0;
  const double c = along.x(), s = -along.y();  // turns the motion onto +x
  Polygon part = placed(shape_.footprint, from.theta_rad, Point::Zero());
  Point supported(0, -shift_);
  double lift = from.y_mm;
  std::vector<VoidGroup> groups = floor_.groups;
  double width = floor_.width_mm;
  if (!along_track) {
    each_point(part, [&](const Point& p) { return rotated(p, c, s); });
    supported = rotated(supported, c, s);
    // Only what the part can come to matters.
    Box box;
    box.include(from.position());
    box.include(to.position());
    const double room = reach_ + 10;
    box.min.array() -= room;
    box.max.array() += room;
    VoidGroup all;
    for (const VoidGroup& group : groups) all.loops.insert(all.loops.end(), group.loops.begin(), group.loops.end());
    all.loops.push_back(rectangle(box.min.x(), width, box.max.x(), std::max(box.max.y(), width) + room));
    all.loops.push_back(rectangle(box.min.x(), std::min(box.min.y(), 0.0) - room, box.max.x(), 0));
    all.loops = loops_of(united(all.loops));
    for (Loop& loop : all.loops) {
      for (Point& p : loop) p = rotated(p - from.position(), c, s);
    }
    groups = {std::move(all)};
    lift = kBeyond_mm;
    for (Loop& loop : groups[0].loops) {
      for (Point& p : loop) p += Point(0, lift);
    }
    width = 2 * kBeyond_mm;
  }
  // Of Travel's coordinates: x of the supported point, which is `ahead` of the centre of mass.
  const double ahead = supported.x(), start = along_track ? from.x_mm : 0;
  each_point(part, [&](const Point& p) { return Point(p + Point(-ahead, lift)); });
  const TravellingPart travelling = TravellingPart::of(part, lift, -supported.y(), width);
  if (along_track && travelling.plain_margin_mm < kLost_mm) {
    lose(from, {}, -travelling.plain_margin_mm);
    return 0.0;
  }
  if (along_track) least_ = std::min(least_, travelling.plain_margin_mm);
  const double x0 = start + ahead, x1 = x0 + length;
  double first = kInfinity;
  SupportLoss lost;
  double depth = 0;
  for (const VoidGroup& group : groups) {
    const VoidOutline outline = VoidOutline::of(group.loops);
    const Travel travel{travelling, outline, {{-1e9, x0}, {x1, 1e9}}};
    const LeastMargin least = least_margin(travel);
    const bool loses = least.margin_mm < kLost_mm || least.unsupported;
    if (!loses) {
      least_ = std::min(least_, least.margin_mm);
      continue;
    }
    SupportLoss found = support_loss(travel);
    if (!found.lost || found.x_mm >= first) continue;
    first = found.x_mm;
    depth = std::max(0.0, -least.margin_mm);
    lost = std::move(found);
  }
  if (first == kInfinity) return std::nullopt;
  const double fraction = std::clamp((first - x0) / length, 0.0, 1.0);
  if (!along_track) {
    for (SupportLoss::Edge& edge : lost.tipping) {
      edge.from = rotated(edge.from, c, -s);
      edge.to = rotated(edge.to, c, -s);
    }
    lost.lost_mm.clear();
  }
  const Point p = from.position() + fraction * way;
  lose({p.x(), p.y(), from.theta_rad}, std::move(lost), depth);
  return fraction;
}

std::optional<double> PathSupport::turn(const PathStretch& stretch, double from, double to, const Configuration& a,
                                        const Configuration& b) {
  if (stands_clear(a, b) && plain_ >= 0) {
    least_ = std::min(least_, plain_);
    return std::nullopt;
  }
  const double moves = farthest_move(a, b);
  const double middle_at = (from + to) / 2;
  const Configuration middle = stretch.at(middle_at);
  const double margin = margin_on(floor_.eroded(0), middle);
  if (margin < kLost_mm) {
    // Lost here; but perhaps earlier.
    if (moves > kLeastPiece_mm) {
      if (const auto earlier = turn(stretch, from, middle_at, a, middle)) return earlier;
    }
    const Polygon part = placed(shape_.footprint, middle.theta_rad, middle.position());
    const Point supported(middle.x_mm, middle.y_mm - shift_);
    Loop generators = support_generators(part, floor_.eroded(0));
    for (Point& p : generators) p -= supported;
    SupportLoss loss;
    loss.unsupported_entirely = generators.empty();
    if (!generators.empty()) {
      const HullMargin hull = hull_margin(generators);
      loss.tipping.push_back({generators[hull.from], generators[hull.to]});
      if (hull.other_from >= 0) loss.tipping.push_back({generators[hull.other_from], generators[hull.other_to]});
    }
    lose(middle, std::move(loss), margin == -kInfinity ? 0 : -margin);
    return middle_at;
  }
  least_ = std::min(least_, margin);
  double piece = kLongestPiece_mm;
  while (piece > moves && piece > kLeastPiece_mm) piece /= 2;
  piece *= 2;  // the least of a fixed ladder that is not below moves: few floors are made
  if (moves <= kLongestPiece_mm) {
    // Held up all along; and nowhere with less margin than is known, or the piece is too short to matter.
    const double surely = margin_on(floor_.eroded(piece), middle) - 2 * piece;
    if (surely >= 0 && (surely >= least_ || moves <= kMarginPiece_mm)) return std::nullopt;
  }
  if (moves <= kLeastPiece_mm) {
    marginal_ = marginal_ || margin < 2 * piece;
    return std::nullopt;
  }
  if (const auto first = turn(stretch, from, middle_at, a, middle)) return first;
  return turn(stretch, middle_at, to, middle, b);
}

}  // namespace formotion::feeder
