#include "applications/feeder/space_picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "analysis/constraints/planar_support.hpp"
#include "analysis/contact/free_slice.hpp"
#include "applications/feeder/path_support.hpp"
#include "applications/feeder/pose_travel.hpp"

namespace formotion::feeder {
namespace {

constexpr int kSlices = 120;
constexpr double kArcStep_rad = 0.2;
constexpr double kSupportStep_mm = 3;      // support is looked at this often along a piece
constexpr double kSupportPlace_mm = 0.01;  // to which the place is found where it changes
constexpr double kSamePlace_mm = 1e-5;     // the union's grid and the cleaning of outlines move points by far less

// The number of the nearest corner; -1 if none is there.
int corner_number(const std::vector<Loop>& loops, const Point& p) {
  int number = 0;
  for (const Loop& loop : loops) {
    for (const Point& corner : loop) {
      if ((corner - p).norm() < kSamePlace_mm) return number;
      ++number;
    }
  }
  return -1;
}

// The number of the edge on which p lies, along the direction or against it: of its first corner as written.
int edge_number(const std::vector<Loop>& loops, const Point& p, const Point& along) {
  int number = 0;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i, ++number) {
      const Point &from = loop[i], &to = loop[(i + 1) % loop.size()];
      if (std::abs(cross(along, to - from)) < kSamePlace_mm && distance_to_segment(p, from, to) < kSamePlace_mm)
        return number;
    }
  }
  return -1;
}

// A feature's obstacles as the problem file has them, in the world.
std::vector<Loop> written_obstacles(const FeatureSpec& feature, double start_mm, std::span<const double> values) {
  std::vector<Loop> loops;
  if (const auto* fence = std::get_if<Fence>(&feature.shape)) loops = {evaluated(fence->polygon_mm, values)};
  if (const auto* wall = std::get_if<WallProfile>(&feature.shape)) loops = {evaluated(wall->profile_mm, values)};
  for (Loop& loop : loops) {
    for (Point& p : loop) p.x() += start_mm;
  }
  return loops;
}

class Labels {
 public:
  Labels(const SpaceScene& scene, const World& world, int aspect)
      : scene_(scene),
        world_(world),
        part_(written_loops(scene.spec.part.aspects[aspect], scene.part.shapes[aspect], scene.values)) {}

  FacetPicture operator()(const ContactPair& pair) const {
    FacetPicture facet;
    facet.kind = pair.kind;
    const bool of_edge = pair.kind == ContactKind::EdgeOnCorner;
    if (of_edge) {
      const MovingEdge& edge = world_.part.edges[pair.moving];
      facet.moving = known(edge_number(part_, (edge.from + edge.to) / 2, edge.along), edge.index);
    } else {
      const MovingCorner& corner = world_.part.corners[pair.moving];
      facet.moving = known(corner_number(part_, corner.at), corner.index);
    }
    const bool on_edge = pair.kind == ContactKind::CornerOnEdge;
    const FixedName& name =
        on_edge ? world_.obstacles.edges[pair.fixed].name : world_.obstacles.corners[pair.fixed].name;
    facet.component = name.component;
    facet.fixed = name.index;
    const int feature = feature_of(scene_.layout, name.component);
    if (feature >= 0) {
      const std::vector<Loop> loops =
          written_obstacles(scene_.spec.designs[static_cast<std::size_t>(scene_.topology)][feature],
                            scene_.layout.features[feature].start_mm, scene_.values);
      if (on_edge) {
        const FixedEdge& edge = world_.obstacles.edges[pair.fixed];
        facet.fixed = known(edge_number(loops, (edge.from + edge.to) / 2, edge.along), name.index);
      } else {
        facet.fixed = known(corner_number(loops, world_.obstacles.corners[pair.fixed].centre), name.index);
      }
    }
    const std::string place = obstacle_name(scene_.layout, name.component);
    const bool whole = name.component == 0 ? on_edge : world_.shapes[name.component].radius_mm > 0;
    facet.label = (of_edge ? "edge " : "corner ") + std::to_string(facet.moving) + " on " +
                  (whole ? "" : (on_edge ? "edge " : "corner ") + std::to_string(facet.fixed) + " of ") + place;
    return facet;
  }

 private:
  static int known(int found, int otherwise) { return found >= 0 ? found : otherwise; }

  const SpaceScene& scene_;
  const World& world_;
  std::vector<Loop> part_;
};

// Straight stretches of a piece, cut to the positions shown.
std::vector<std::pair<Point, Point>> straight(const SlicePiece& piece, double from_mm, double to_mm) {
  Loop points{piece.from};
  if (piece.radius_mm > 0) {
    const int steps = std::max(1, static_cast<int>(std::ceil(piece.width_rad / kArcStep_rad)));
    for (int i = 1; i < steps; ++i)
      points.push_back(piece.centre + rotated(Point(piece.radius_mm, 0), piece.from_rad + i * piece.width_rad / steps));
  }
  points.push_back(piece.to);
  std::vector<std::pair<Point, Point>> stretches;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    Point a = points[i], b = points[i + 1];
    if (std::max(a.x(), b.x()) <= from_mm || std::min(a.x(), b.x()) >= to_mm) continue;
    const auto at = [&](double x, const Point& keep) -> Point {
      return a.x() == b.x() ? keep : Point(a + (x - a.x()) / (b.x() - a.x()) * (b - a));
    };
    const Point begin = at(std::clamp(a.x(), from_mm, to_mm), a), end = at(std::clamp(b.x(), from_mm, to_mm), b);
    stretches.emplace_back(begin, end);
  }
  return stretches;
}

// Whether the part would be held up, at one orientation.
class SupportAt {
 public:
  SupportAt(const AspectShape& shape, const Track& track, const Environment& environment, double theta)
      : part_(placed(shape.footprint, theta, Point::Zero())),
        track_(track),
        shift_(wall_shift(shape.com_height_mm, environment)) {}

  bool operator()(const Point& p) const {
    const std::optional<double> margin = support_margin(placed(part_, 0, p), track_, p - Point(0, shift_));
    return margin && *margin >= kLost_mm;
  }

  // Cuts a stretch where support changes.
  template <class Add>
  void along(const Point& from, const Point& to, const Add& add) const {
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / kSupportStep_mm)));
    const auto at = [&](double t) -> Point { return from + t * (to - from); };
    double begin = 0;
    bool held = (*this)(at(0.5 / steps));
    for (int i = 1; i < steps; ++i) {
      const bool next = (*this)(at((i + 0.5) / steps));
      if (next == held) continue;
      double low = (i - 0.5) / steps, high = (i + 0.5) / steps;
      while ((high - low) * (to - from).norm() > kSupportPlace_mm) {
        const double middle = (low + high) / 2;
        ((*this)(at(middle)) == held ? low : high) = middle;
      }
      add(at(begin), at(high), held);
      begin = high;
      held = next;
    }
    add(at(begin), to, held);
  }

 private:
  Polygon part_;
  const Track& track_;
  double shift_;
};

}  // namespace

SpacePicture space_picture(const SpaceScene& scene, const World& world, int aspect) {
  SpacePicture picture;
  picture.aspect = aspect;
  picture.step_rad = 2 * std::numbers::pi / kSlices;
  const Labels label(scene, world, aspect);
  const Environment& environment = scene.spec.environment;
  const Floor floor =
      Floor::of(grouped(scene.layout, scene.part.longest_mm), environment.track_width_mm, recesses(scene.layout));
  // Contacts that are called alike are one facet: obstacles cut the wall's face into several edges.
  std::map<std::tuple<ContactKind, int, int>, int> known;
  const auto index_of = [&](const ContactPair& pair) {
    const auto [entry, is_new] = known.try_emplace({pair.kind, pair.moving, pair.fixed}, 0);
    if (!is_new) return entry->second;
    FacetPicture named = label(pair);
    const auto same = std::find_if(picture.facets.begin(), picture.facets.end(),
                                   [&](const FacetPicture& f) { return f.label == named.label; });
    entry->second = static_cast<int>(same - picture.facets.begin());
    if (same == picture.facets.end()) picture.facets.push_back(std::move(named));
    return entry->second;
  };
  for (std::size_t k = 0; k < kSlices; ++k) {
    const double theta = picture.theta_rad(k);
    const SupportAt support(scene.part.shapes[aspect], floor.eroded(0), environment, theta);
    std::vector<PiecePicture>& pieces = picture.slices.emplace_back();
    for (const SlicePiece& piece : free_slice(world.part, world.obstacles, theta).pieces) {
      const auto stretches = straight(piece, scene.from_mm, scene.to_mm);
      if (stretches.empty()) continue;
      const int index = index_of(piece.pair);
      for (const auto& [from, to] : stretches) {
        support.along(from, to, [&](const Point& a, const Point& b, bool held) {
          pieces.push_back({index, piece.pair, a, b, held});
        });
      }
    }
  }
  return picture;
}

}  // namespace formotion::feeder
