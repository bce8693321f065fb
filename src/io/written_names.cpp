#include "io/written_names.hpp"

#include <algorithm>
#include <cmath>

namespace formotion {
namespace {

constexpr double kSamePlace_mm = 1e-5;  // the union's grid and the cleaning of outlines move points by far less
constexpr double kParallel = 1e-6;      // sine

struct Found {
  int index = -1;
  double away_mm = kSamePlace_mm;
};

Found nearest_corner(const std::vector<Loop>& loops, const Point& p) {
  Found found;
  int index = 0;
  for (const Loop& loop : loops) {
    for (const Point& corner : loop) {
      if (const double away = (p - corner).norm(); away < found.away_mm) found = {index, away};
      ++index;
    }
  }
  return found;
}

// The edge along `along` on which p lies.
Found nearest_edge(const std::vector<Loop>& loops, const Point& p, const Point& along) {
  Found found;
  int index = 0;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i, ++index) {
      const Point &from = loop[i], &to = loop[(i + 1) % loop.size()];
      const double length = (to - from).norm();
      if (length <= 0 || std::abs(cross(along, to - from)) > kParallel * length) continue;
      const double away = distance_to_segment(p, from, to);
      if (away + 1e-9 < found.away_mm) found = {index, away};  // ties: the first
    }
  }
  return found;
}

std::optional<int> index_of(const Found& found) {
  return found.index >= 0 ? std::optional<int>(found.index) : std::nullopt;
}

// The likely component's, else the first one that has such a place.
template <class Search>
std::pair<int, int> name_in(const std::vector<std::vector<Loop>>& fixed, int likely, const Search& search) {
  if (likely >= 0 && likely < static_cast<int>(fixed.size())) {
    if (const Found found = search(fixed[static_cast<std::size_t>(likely)]); found.index >= 0)
      return {likely, found.index};
  }
  for (std::size_t k = 0; k < fixed.size(); ++k) {
    if (const Found found = search(fixed[k]); found.index >= 0) return {static_cast<int>(k), found.index};
  }
  return {likely, -1};
}

// Contacts within a large tolerance need not be on the edge itself.
template <class Edge>
Point on_edge(const Edge& edge, const Point& p) {
  return edge.from + std::clamp(edge.along.dot(p - edge.from), 0.0, edge.length_mm) * edge.along;
}

}  // namespace

nlohmann::ordered_json features_json(const FeatureNames& names) {
  using Json = nlohmann::ordered_json;
  return {{"moving", names.moving ? Json(*names.moving) : Json(nullptr)},
          {"fixed", {names.fixed.first, names.fixed.second}}};
}

const char* kind_word(ContactKind kind) { return kind == ContactKind::EdgeOnCorner ? "EV" : "VE"; }

WrittenNames::WrittenNames(std::vector<Loop> part, std::vector<std::vector<Loop>> fixed)
    : part_(std::move(part)), fixed_(std::move(fixed)) {}

FeatureNames WrittenNames::of(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                              const Configuration& q, const Point& place) const {
  FeatureNames names;
  if (pair.kind == ContactKind::EdgeOnCorner) {
    const MovingEdge& edge = part.edges[pair.moving];
    const Point at = on_edge(edge, rotated(place - q.position(), -q.theta_rad));
    names.moving = index_of(nearest_edge(part_, at, edge.along));
  } else {
    names.moving = index_of(nearest_corner(part_, part.corners[pair.moving].at));
  }
  if (pair.kind == ContactKind::CornerOnEdge) {
    const FixedEdge& edge = obstacles.edges[pair.fixed];
    const Point at = on_edge(edge, place);
    names.fixed = name_in(fixed_, edge.name.component,
                          [&](const std::vector<Loop>& loops) { return nearest_edge(loops, at, edge.along); });
  } else {
    const FixedCorner& corner = obstacles.corners[pair.fixed];
    names.fixed = name_in(fixed_, corner.name.component,
                          [&](const std::vector<Loop>& loops) { return nearest_corner(loops, corner.centre); });
  }
  return names;
}

}  // namespace formotion
