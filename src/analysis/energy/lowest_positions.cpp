#include "analysis/energy/lowest_positions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSamePlace_mm = 1e-7;  // ends of pieces that meet
constexpr double kLevel_mm = 1e-9;      // a straight piece that rises less is level
constexpr double kLevel_rad = 1e-9;     // slope of an arc's end
constexpr double kSameRay_rad = 1e-9;
constexpr int kArcSamples = 16;

Point direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

bool is_arc(const SlicePiece& piece) { return piece.radius_mm > 0; }
bool is_place(const SlicePiece& piece) {
  return is_arc(piece) ? piece.radius_mm * piece.width_rad <= kSamePlace_mm
                       : (piece.to - piece.from).norm() <= kSamePlace_mm;
}

// A piece of boundary as it leaves a place.
struct Ray {
  double from_down_rad = 0;  // counter-clockwise from straight down, (0, 2 pi]
  bool starts = false;       // the piece starts here: free space is clockwise of the ray, else counter-clockwise
  bool falls = false;
};

struct Node {
  Point at;
  std::vector<Ray> rays;
};

bool is_level(const SlicePiece& piece, const Gravity& gravity) {
  return !is_arc(piece) && std::abs(gravity.height_mm(piece.to) - gravity.height_mm(piece.from)) <= kLevel_mm;
}

Ray ray_of(const SlicePiece& piece, const Gravity& gravity, const Point& at, bool starts) {
  Ray ray;
  ray.starts = starts;
  Point along;
  if (is_arc(piece)) {
    along = turned_left((at - piece.centre).normalized());
  } else {
    along = (piece.to - piece.from).normalized();
  }
  if (!starts) along = -along;
  const double angle = std::atan2(cross(gravity.down, along), gravity.down.dot(along));
  ray.from_down_rad = angle > 0 ? angle : angle + 2 * kPi;
  const double rise = gravity.height_mm(along);
  if (is_arc(piece)) {  // bends towards its centre
    ray.falls = rise < -kLevel_rad || (rise <= kLevel_rad && gravity.down.dot(piece.centre - at) > 0);
  } else {
    ray.falls = !is_level(piece, gravity) && rise < 0;
  }
  return ray;
}

// Whether free space lies straight below a place, by the first ray that is met counter-clockwise from there. Two at
// one angle are the sides of a slot without width, and what ends comes first.
bool is_free_below(const Node& node) {
  if (node.rays.empty()) return false;
  double first = 1e300;
  for (const Ray& ray : node.rays) first = std::min(first, ray.from_down_rad);
  return std::none_of(node.rays.begin(), node.rays.end(),
                      [&](const Ray& ray) { return ray.from_down_rad <= first + kSameRay_rad && !ray.starts; });
}

bool goes_down(const Node& node) {
  return is_free_below(node) ||
         std::any_of(node.rays.begin(), node.rays.end(), [](const Ray& ray) { return ray.falls; });
}

// The rays of a piece that runs on through a place in its middle.
bool pass_through(Node& node, const SlicePiece& piece, const Gravity& gravity) {
  const auto apart = [&](const Point& p) { return (p - node.at).norm() > kSamePlace_mm; };
  if (is_place(piece) || !apart(piece.from) || !apart(piece.to)) return false;
  if (is_arc(piece)) {
    const Point out = node.at - piece.centre;
    if (std::abs(out.norm() - piece.radius_mm) > kSamePlace_mm) return false;
    double turn = std::remainder(std::atan2(out.y(), out.x()) - piece.from_rad, 2 * kPi);
    if (turn < 0) turn += 2 * kPi;
    if (turn > piece.width_rad) return false;
  } else if (distance_to_segment(node.at, piece.from, piece.to) > kSamePlace_mm) {
    return false;
  }
  node.rays.push_back(ray_of(piece, gravity, node.at, true));
  node.rays.push_back(ray_of(piece, gravity, node.at, false));
  return true;
}

struct Boundary {
  std::vector<Node> nodes;
  std::vector<int> from, to;                   // nodes of each piece
  std::vector<std::pair<int, int>> in_middle;  // node, piece

  int node_at(const Point& p) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if ((nodes[i].at - p).norm() <= kSamePlace_mm) return static_cast<int>(i);
    }
    nodes.push_back({p, {}});
    return static_cast<int>(nodes.size()) - 1;
  }

  Boundary(const FreeSlice& slice, const Gravity& gravity) {
    for (const SlicePiece& piece : slice.pieces) {
      from.push_back(node_at(piece.from));
      to.push_back(node_at(piece.to));
      if (is_place(piece)) continue;
      nodes[from.back()].rays.push_back(ray_of(piece, gravity, piece.from, true));
      nodes[to.back()].rays.push_back(ray_of(piece, gravity, piece.to, false));
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (std::size_t k = 0; k < slice.pieces.size(); ++k) {
        if (pass_through(nodes[i], slice.pieces[k], gravity)) {
          in_middle.emplace_back(static_cast<int>(i), static_cast<int>(k));
        }
      }
    }
  }
};

// A level piece with free space above it.
bool is_floor(const SlicePiece& piece, const Gravity& gravity) {
  return !is_place(piece) && is_level(piece, gravity) && gravity.across_mm(piece.to) < gravity.across_mm(piece.from);
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

std::vector<LowestPosition> lowest_positions(const FreeSlice& slice, const Gravity& gravity) {
  const Boundary boundary(slice, gravity);
  const int count = static_cast<int>(boundary.nodes.size());
  std::vector<int> parent(count);
  std::vector<bool> has_floor(count, false);
  for (int i = 0; i < count; ++i) parent[i] = i;
  for (std::size_t k = 0; k < slice.pieces.size(); ++k) {
    if (!is_floor(slice.pieces[k], gravity)) continue;
    parent[root_of(parent, boundary.from[k])] = root_of(parent, boundary.to[k]);
    has_floor[boundary.from[k]] = has_floor[boundary.to[k]] = true;
  }
  for (const auto& [i, k] : boundary.in_middle) {
    if (is_floor(slice.pieces[k], gravity)) parent[root_of(parent, i)] = root_of(parent, boundary.from[k]);
  }
  std::vector<std::optional<LowestPosition>> of_root(count);
  for (int i = 0; i < count; ++i) {
    const Node& node = boundary.nodes[i];
    const bool down = goes_down(node);
    if (down && !has_floor[i]) continue;
    std::optional<LowestPosition>& lowest = of_root[root_of(parent, i)];
    if (!lowest) lowest = LowestPosition{node.at, node.at, gravity.height_mm(node.at), false};
    lowest->leads_down = lowest->leads_down || down;
    if (gravity.across_mm(node.at) < gravity.across_mm(lowest->left)) lowest->left = node.at;
    if (gravity.across_mm(node.at) > gravity.across_mm(lowest->right)) lowest->right = node.at;
  }
  std::vector<LowestPosition> found;
  for (const auto& lowest : of_root) {
    if (lowest) found.push_back(*lowest);
  }
  std::sort(found.begin(), found.end(), [&](const LowestPosition& a, const LowestPosition& b) {
    if (a.height_mm != b.height_mm) return a.height_mm < b.height_mm;
    return gravity.across_mm(a.left) < gravity.across_mm(b.left);
  });
  return found;
}

std::optional<double> drop_height_mm(const FreeSlice& slice, const Gravity& gravity, double across_mm) {
  std::optional<double> height;
  const auto raise = [&](double h) { height = height ? std::max(*height, h) : h; };
  for (const SlicePiece& piece : slice.pieces) {
    const double a = gravity.across_mm(piece.from), b = gravity.across_mm(piece.to);
    if (!is_arc(piece)) {
      if (across_mm < std::min(a, b) || across_mm > std::max(a, b)) continue;
      const double ha = gravity.height_mm(piece.from), hb = gravity.height_mm(piece.to);
      raise(a == b ? std::max(ha, hb) : ha + (hb - ha) * (across_mm - a) / (b - a));
      continue;
    }
    const double off = across_mm - gravity.across_mm(piece.centre);
    if (std::abs(off) > piece.radius_mm) continue;
    const double up = std::sqrt(std::max(0.0, piece.radius_mm * piece.radius_mm - off * off));
    for (const double rise : {up, -up}) {
      const Point out = off * turned_left(gravity.down) - rise * gravity.down;
      const double turn =
          std::remainder(std::atan2(out.y(), out.x()) - piece.from_rad - 0.5 * piece.width_rad, 2 * kPi);
      if (std::abs(turn) <= 0.5 * piece.width_rad + kLevel_rad) raise(gravity.height_mm(piece.centre) + rise);
    }
  }
  return height;
}

std::optional<double> lowest_within(const FreeSlice& slice, const Gravity& gravity, const Point& p, double reach_mm) {
  std::optional<double> height;
  const auto lower = [&](const Point& q) {
    if ((q - p).norm() > reach_mm * (1 + 1e-9)) return;
    const double h = gravity.height_mm(q);
    height = height ? std::min(*height, h) : h;
  };
  for (const SlicePiece& piece : slice.pieces) {
    lower(piece.from);
    lower(piece.to);
    if (is_place(piece)) continue;
    if (!is_arc(piece)) {  // where it enters the disc
      const Point along = (piece.to - piece.from).normalized();
      const double length = (piece.to - piece.from).norm(), foot = along.dot(p - piece.from);
      const double off = (piece.from + foot * along - p).norm();
      if (off > reach_mm) continue;
      const double half = std::sqrt(reach_mm * reach_mm - off * off);
      for (const double place : {foot - half, foot + half}) {
        if (place >= 0 && place <= length) lower(piece.from + place * along);
      }
      continue;
    }
    const Point out = p - piece.centre;
    if (std::abs(out.norm() - piece.radius_mm) > reach_mm) continue;
    const double middle = piece.from_rad + 0.5 * piece.width_rad;
    const double turn = middle + std::remainder(std::atan2(out.y(), out.x()) - middle, 2 * kPi);
    const double span = reach_mm / piece.radius_mm;
    for (int i = 0; i <= kArcSamples; ++i) {
      const double angle = turn + span * (2.0 * i / kArcSamples - 1);
      if (angle < piece.from_rad || angle > piece.from_rad + piece.width_rad) continue;
      lower(piece.centre + piece.radius_mm * direction(angle));
    }
  }
  return height;
}

}  // namespace formotion
