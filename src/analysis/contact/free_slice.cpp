#include "analysis/contact/free_slice.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/facet_paths.hpp"
#include "analysis/contact/interiors.hpp"

namespace formotion {
namespace {

constexpr double kSamePlace_mm = 1e-8;

// Whether the part, at one orientation, may be at a position.
class FreeTest {
 public:
  FreeTest(const MovingShape& part, const Obstacles& obstacles, double c, double s)
      : turned_(placed_boundary(part, Point::Zero(), c, s)), fixed_(fixed_boundary(obstacles)) {}

  bool operator()(const Point& position) {
    move_to(turned_, position, placed_);
    return !interiors_overlap(placed_, fixed_);
  }

 private:
  Boundary turned_, fixed_, placed_;
};

SlicePiece piece_of(const FacetPath& path, double from_mm, double to_mm) {
  SlicePiece piece;
  piece.pair = path.pair;
  piece.along = {path.along_from_mm + from_mm, path.along_from_mm + to_mm};
  piece.from = path.at(from_mm);
  piece.to = path.at(to_mm);
  if (path.is_arc()) {
    piece.centre = path.centre;
    piece.radius_mm = path.radius_mm;
    piece.from_rad = path.from_rad + from_mm / path.radius_mm;
    piece.width_rad = (to_mm - from_mm) / path.radius_mm;
  }
  return piece;
}

double distance_to_box(const Box& box, const Point& p) {
  return (box.min - p).cwiseMax(p - box.max).cwiseMax(Point::Zero()).norm();
}

}  // namespace

FreeSlice free_slice(const MovingShape& part, const Obstacles& obstacles, double theta_rad) {
  FreeSlice slice;
  slice.theta_rad = theta_rad;
  const double c = std::cos(theta_rad), s = std::sin(theta_rad);
  FreeTest is_free_at(part, obstacles, c, s);
  const std::vector<FacetPath> paths = facet_paths(part, obstacles, c, s);
  std::vector<std::pair<int, double>> lone;  // nodes between buried pieces: path, place
  std::vector<Point> ends;                   // of pieces
  for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
    const FacetPath& path = paths[i];
    const std::vector<PathNode> nodes = path_nodes(paths, i);
    bool free_before = false;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const bool last = k + 1 == nodes.size();
      const double from = nodes[k].place_mm, to = last ? from : nodes[k + 1].place_mm;
      const bool is_boundary = !last && is_free_at(path.at(0.5 * (from + to)));
      if (is_boundary) {
        if (free_before) {  // others only touch here
          SlicePiece& piece = slice.pieces.back();
          piece = piece_of(path, piece.along.from_mm - path.along_from_mm, to);
        } else {
          slice.pieces.push_back(piece_of(path, from, to));
        }
        ends.push_back(path.at(from));
        ends.push_back(path.at(to));
      } else if (!free_before && nodes[k].meets >= 2) {
        lone.emplace_back(i, from);
      }
      free_before = is_boundary;
    }
  }
  for (const auto& [i, place] : lone) {
    const Point p = paths[i].at(place);
    const auto same = [&](const Point& q) { return (p - q).norm() <= kSamePlace_mm; };
    if (std::any_of(ends.begin(), ends.end(), same) || !is_free_at(p)) continue;
    slice.pieces.push_back(piece_of(paths[i], place, place));
    ends.push_back(p);
  }
  return slice;
}

std::optional<NearestBoundary> nearest_boundary(const MovingShape& part, const Obstacles& obstacles, double theta_rad,
                                                const Point& position) {
  const double c = std::cos(theta_rad), s = std::sin(theta_rad);
  FreeTest is_free_at(part, obstacles, c, s);
  const std::vector<FacetPath> paths = facet_paths(part, obstacles, c, s);
  struct Near {
    double distance_mm;
    int path;
  };
  std::vector<Near> order;
  for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
    order.push_back({paths[i].is_arc() ? distance_to_box(paths[i].box, position)
                                       : distance_to_segment(position, paths[i].from, paths[i].to),
                     i});
  }
  std::sort(order.begin(), order.end(), [](const Near& a, const Near& b) {
    return a.distance_mm < b.distance_mm || (a.distance_mm == b.distance_mm && a.path < b.path);
  });

  struct Stretch {
    double distance_mm, place_mm;
    double test_mm;  // free there: free all along
  };
  double best = 1e300;
  std::optional<NearestBoundary> found;
  std::vector<Stretch> stretches;
  for (const Near& near : order) {
    if (near.distance_mm >= best) break;
    const FacetPath& path = paths[near.path];
    const std::vector<PathNode> nodes = path_nodes(paths, near.path);
    const double foot = path.nearest_place(position);
    stretches.clear();
    const auto add = [&](double place, double test) {
      stretches.push_back({(path.at(place) - position).norm(), place, test});
    };
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double from = nodes[k].place_mm;
      if (nodes[k].meets >= 2) add(from, from);
      if (k + 1 == nodes.size()) break;
      const double to = nodes[k + 1].place_mm, middle = 0.5 * (from + to);
      if (foot >= from && foot <= to) {
        add(foot, middle);
      } else {
        const bool nearer = (path.at(from) - position).norm() < (path.at(to) - position).norm();
        add(nearer ? from : to, middle);
      }
    }
    std::sort(stretches.begin(), stretches.end(),
              [](const Stretch& a, const Stretch& b) { return a.distance_mm < b.distance_mm; });
    for (const Stretch& stretch : stretches) {
      if (stretch.distance_mm >= best) break;
      if (!is_free_at(path.at(stretch.test_mm))) continue;
      best = stretch.distance_mm;
      found = NearestBoundary{path.pair, path.at(stretch.place_mm)};
    }
  }
  if (found) {
    found->contact = found->position + contact_state(part, obstacles, found->pair, found->position, c, s).lever;
  }
  return found;
}

}  // namespace formotion
