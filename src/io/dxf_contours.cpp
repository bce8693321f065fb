#include "io/dxf_contours.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <unordered_map>

#include "io/dxf_groups.hpp"

namespace formotion {
namespace {

constexpr std::size_t kMostCorners = 20'000;  // of one contour: the analysis compares edges with edges
constexpr double kLeastJoin_mm = 1e-9;
constexpr double kSamePoint_mm = 1e-6;

// Points closer than a tolerance are one: nodes found by a grid, so that many ends cost little.
class Nodes {
 public:
  explicit Nodes(double tolerance) : tolerance_(tolerance), cell_(tolerance / std::numbers::sqrt2) {}

  void add(const Point& p) {
    const int here = static_cast<int>(points_.size());
    points_.push_back(p);
    parent_.push_back(here);
    const auto cx = std::llround(p.x() / cell_), cy = std::llround(p.y() / cell_);
    for (std::int64_t x = cx - 2; x <= cx + 2; ++x) {
      for (std::int64_t y = cy - 2; y <= cy + 2; ++y) {
        const auto found = grid_.find({x, y});
        if (found == grid_.end()) continue;
        for (const int other : found->second) {
          if ((point(other) - p).norm() <= tolerance_) unite(here, other);
        }
      }
    }
    // Ends in one cell are one node in any case; a few of them are enough to find its neighbours by.
    std::vector<int>& own = grid_[{cx, cy}];
    if (own.size() < kKeptPerCell) own.push_back(here);
  }
  int node(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  const Point& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  std::size_t size() const { return points_.size(); }

 private:
  static constexpr std::size_t kKeptPerCell = 16;
  using Cell = std::pair<std::int64_t, std::int64_t>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const {
      std::uint64_t h = static_cast<std::uint64_t>(cell.first) * 0x9E3779B97F4A7C15u;
      h = (h ^ (h >> 29) ^ static_cast<std::uint64_t>(cell.second)) * 0xBF58476D1CE4E5B9u;
      return static_cast<std::size_t>(h ^ (h >> 32));
    }
  };
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
  void unite(int a, int b) {
    a = node(a), b = node(b);
    parent(std::max(a, b)) = std::min(a, b);  // the first in file order is the node
  }

  double tolerance_, cell_;
  std::vector<Point> points_;
  std::vector<int> parent_;
  std::unordered_map<Cell, std::vector<int>, Hash> grid_;
};

struct Edge {
  int from = 0, to = 0;  // nodes
  int path = 0;
};

struct Ring {
  int first = 0;  // index of its first path in the drawing
  Loop points;
};

std::string length_text(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value << " mm";
  return out.str();
}

bool same_path(const Loop& a, const Loop& b, double tolerance) {
  if (a.size() != b.size()) return false;
  const auto near = [&](const Point& p, const Point& q) { return (p - q).norm() <= tolerance; };
  return std::equal(a.begin(), a.end(), b.begin(), near) || std::equal(a.begin(), a.end(), b.rbegin(), near);
}

// The paths of one layer as a graph; its cycles are the contours.
class LayerJoin {
 public:
  LayerJoin(const DxfDrawing& drawing, const std::vector<int>& paths, double tolerance, DxfIssues& issues)
      : drawing_(drawing), tolerance_(std::max(tolerance, kLeastJoin_mm)), issues_(issues), nodes_(tolerance_) {
    std::vector<int> open;
    for (const int path : paths) {
      const Loop& points = loop(path);
      if (points.empty() || !has_extent(points)) continue;  // a line without length
      if (drawing_.paths[static_cast<std::size_t>(path)].closed) {
        rings_.push_back({path, points});
        continue;
      }
      nodes_.add(points.front());
      nodes_.add(points.back());
      open.push_back(path);
    }
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Edge edge{nodes_.node(static_cast<int>(2 * i)), nodes_.node(static_cast<int>(2 * i + 1)), open[i]};
      if (edge.from != edge.to) {
        edges_.push_back(edge);
      } else {
        Loop points = loop(open[i]);
        points.back() = points.front();
        rings_.push_back({open[i], std::move(points)});
      }
    }
    drop_repeated();
    join();
  }

  std::vector<Ring> take() { return std::move(rings_); }

 private:
  const Loop& loop(int path) const { return drawing_.paths[static_cast<std::size_t>(path)].points_mm; }
  const Edge& edge(int i) const { return edges_[static_cast<std::size_t>(i)]; }
  bool has_extent(const Loop& points) const {
    return std::any_of(points.begin(), points.end(),
                       [&](const Point& p) { return (p - points.front()).norm() > tolerance_; });
  }

  // Lines drawn twice: the later ones go.
  void drop_repeated() {
    constexpr std::size_t kCompared = 8;  // more than two different paths between two nodes are an issue in any case
    std::map<std::pair<int, int>, std::vector<int>> kept;
    std::erase_if(edges_, [&](const Edge& candidate) {
      std::vector<int>& others = kept[std::minmax(candidate.from, candidate.to)];
      const bool repeated = std::any_of(others.begin(), others.end(), [&](int path) {
        return same_path(loop(path), loop(candidate.path), 2 * tolerance_);
      });
      if (!repeated && others.size() < kCompared) others.push_back(candidate.path);
      return repeated;
    });
  }

  void join() {
    for (int i = 0; i < static_cast<int>(edges_.size()); ++i) {
      at_node_[edge(i).from].push_back(i);
      at_node_[edge(i).to].push_back(i);
    }
    used_.assign(edges_.size(), false);
    std::vector<int> loose, crowded;
    for (const auto& [node, incident] : at_node_) {
      if (incident.size() == 1) loose.push_back(node);
      if (incident.size() > 2) crowded.push_back(node);
    }
    // Branches first: what hangs on one is not reported again as open.
    for (const int node : crowded) {
      for (const int i : at_node_[node]) follow(node, i);
      issues_.add(std::to_string(at_node_[node].size()) + " lines that meet at " +
                      dxf_place(nodes_.point(node), drawing_.unit) + " " + on_layer(),
                  "contours that neither branch nor touch themselves");
    }
    for (const int node : loose) {
      if (used_[static_cast<std::size_t>(at_node_[node].front())]) continue;
      const int end = follow(node, at_node_[node].front()).second;
      const Point a = nodes_.point(node), b = nodes_.point(end);
      issues_.add("an open contour " + on_layer() + ": its ends " + dxf_place(a, drawing_.unit) + " and " +
                      dxf_place(b, drawing_.unit) + " are " + length_text((a - b).norm()) + " apart",
                  "a closed one (ends that meet within " + length_text(tolerance_) + ")");
    }
    for (int i = 0; i < static_cast<int>(edges_.size()); ++i) {
      if (used_[static_cast<std::size_t>(i)]) continue;
      rings_.push_back({edge(i).path, follow(edge(i).from, i).first});  // edges are in file order: i is the first
    }
  }

  std::string on_layer() const {
    return "on layer '" + dxf_word(drawing_.paths[static_cast<std::size_t>(edges_.front().path)].layer) + "'";
  }

  // Walks from a node along an edge until a node with other than two edges, or around; the points and the last node.
  std::pair<Loop, int> follow(int node, int at) {
    Loop points;
    while (!used_[static_cast<std::size_t>(at)]) {
      used_[static_cast<std::size_t>(at)] = true;
      Loop next = loop(edge(at).path);
      const bool forward = edge(at).from == node;
      if (!forward) std::reverse(next.begin(), next.end());
      const int end = forward ? edge(at).to : edge(at).from;
      next.front() = nodes_.point(node);
      next.back() = nodes_.point(end);
      points.insert(points.end(), next.begin(), next.end());
      node = end;
      const std::vector<int>& incident = at_node_[node];
      if (incident.size() != 2) break;
      at = incident[0] == at ? incident[1] : incident[0];
    }
    return {std::move(points), node};
  }

  const DxfDrawing& drawing_;
  double tolerance_;
  DxfIssues& issues_;
  Nodes nodes_;
  std::vector<Edge> edges_;
  std::map<int, std::vector<int>> at_node_;
  std::vector<bool> used_;
  std::vector<Ring> rings_;
};

// Without points that repeat the one before.
Loop without_repeats(const Loop& points) {
  const auto same = [](const Point& p, const Point& q) { return (p - q).norm() <= kSamePoint_mm; };
  Loop loop;
  for (const Point& p : points) {
    if (loop.empty() || !same(loop.back(), p)) loop.push_back(p);
  }
  while (loop.size() > 1 && same(loop.back(), loop.front())) loop.pop_back();
  return loop;
}

// The same for loops with the same corners, wherever they start.
std::vector<std::pair<std::int64_t, std::int64_t>> fingerprint(const Loop& loop) {
  std::vector<std::pair<std::int64_t, std::int64_t>> corners;
  for (const Point& p : loop) {
    corners.emplace_back(std::llround(p.x() / kSamePoint_mm), std::llround(p.y() / kSamePoint_mm));
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

std::vector<DxfContour> joined_contours(const DxfDrawing& drawing, double join_tolerance_mm, DxfIssues& issues) {
  std::map<std::string, std::vector<int>> layers;
  for (std::size_t i = 0; i < drawing.paths.size(); ++i) layers[drawing.paths[i].layer].push_back(static_cast<int>(i));
  std::vector<Ring> rings;
  for (const auto& [layer, paths] : layers) {
    for (Ring& ring : LayerJoin(drawing, paths, join_tolerance_mm, issues).take()) rings.push_back(std::move(ring));
  }
  std::sort(rings.begin(), rings.end(), [](const Ring& a, const Ring& b) { return a.first < b.first; });

  std::vector<DxfContour> contours;
  std::set<std::pair<std::string, std::vector<std::pair<std::int64_t, std::int64_t>>>> known;
  for (Ring& ring : rings) {
    const std::string& layer = drawing.paths[static_cast<std::size_t>(ring.first)].layer;
    const std::string where =
        "on layer '" + dxf_word(layer) + "' that begins at " + dxf_place(ring.points.front(), drawing.unit);
    if (ring.points.size() > kMostCorners) {
      issues.add("a contour " + where + " with " + std::to_string(ring.points.size()) + " corners",
                 "at most " + std::to_string(kMostCorners));
      continue;
    }
    Loop loop = normalised({without_repeats(ring.points), {}}).outer;
    const Box box = bounding_box(loop);
    const double size = std::max(1.0, std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff()));
    if (loop.size() < 3 || std::abs(signed_area(loop)) <= 1e-9 * size) {
      issues.add("a contour without area " + where, "one that bounds an area");
    } else if (known.emplace(layer, fingerprint(loop)).second) {
      contours.push_back({layer, std::move(loop)});
    }
  }
  return contours;
}

}  // namespace formotion
