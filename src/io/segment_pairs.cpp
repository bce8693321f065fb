#include "io/segment_pairs.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>

namespace formotion {
namespace {

constexpr std::int64_t kMostWork = 300'000'000;  // box comparisons: a few seconds
constexpr int kLeaf = 8;

struct Segment {
  Point a, b;
  int loop = 0, index = 0;
};

bool overlap(const Box& a, const Box& b, double tolerance) {
  return (a.min.array() <= b.max.array() + tolerance).all() && (b.min.array() <= a.max.array() + tolerance).all();
}

Box box_of(const Segment& s) {
  Box box;
  box.include(s.a);
  box.include(s.b);
  return box;
}

// A tree of boxes over segments, halved at the median of the longer side.
class Tree {
 public:
  explicit Tree(const std::vector<Segment>& segments) : order_(segments.size()) {
    for (const Segment& s : segments) boxes_.push_back(box_of(s));
    std::iota(order_.begin(), order_.end(), 0);
    if (!segments.empty()) build(0, static_cast<int>(segments.size()));
  }

  // Calls visit(j) for every segment whose box meets that of segment i; returns the comparisons made.
  template <class Visit>
  std::int64_t query(int i, double tolerance, const Visit& visit) const {
    std::int64_t work = 0;
    std::vector<int> stack{0};
    while (!stack.empty()) {
      const Node& node = nodes_[static_cast<std::size_t>(stack.back())];
      stack.pop_back();
      ++work;
      if (!overlap(node.box, box(i), tolerance)) continue;
      if (node.right > 0) {
        stack.push_back(node.right);
        stack.push_back(static_cast<int>(&node - nodes_.data()) + 1);
        continue;
      }
      for (int k = node.from; k < node.to; ++k, ++work) {
        const int j = order_[static_cast<std::size_t>(k)];
        if (j > i && overlap(box(j), box(i), tolerance)) visit(j);
      }
    }
    return work;
  }

 private:
  struct Node {
    Box box;
    int from = 0, to = 0, right = 0;  // right: index of the second child, the first one follows; 0 for leaves
  };
  const Box& box(int i) const { return boxes_[static_cast<std::size_t>(i)]; }

  void build(int from, int to) {
    const std::size_t here = nodes_.size();
    nodes_.push_back({{}, from, to, 0});
    for (int k = from; k < to; ++k) {
      nodes_[here].box.include(box(order_[static_cast<std::size_t>(k)]).min);
      nodes_[here].box.include(box(order_[static_cast<std::size_t>(k)]).max);
    }
    if (to - from <= kLeaf) return;
    const Point size = nodes_[here].box.max - nodes_[here].box.min;
    const int axis = size.x() >= size.y() ? 0 : 1;
    const int middle = from + (to - from) / 2;
    const auto centre = [&](int i) { return box(i).min[axis] + box(i).max[axis]; };
    std::nth_element(order_.begin() + from, order_.begin() + middle, order_.begin() + to,
                     [&](int i, int j) { return centre(i) < centre(j) || (centre(i) == centre(j) && i < j); });
    build(from, middle);
    nodes_[here].right = static_cast<int>(nodes_.size());
    build(middle, to);
  }

  std::vector<Box> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

std::optional<Point> crossing(const Segment& s, const Segment& t) {
  const Point u = s.b - s.a, v = t.b - t.a;
  const double t_a = cross(u, t.a - s.a), t_b = cross(u, t.b - s.a);
  const double s_a = cross(v, s.a - t.a), s_b = cross(v, s.b - t.a);
  if (!((t_a < 0) != (t_b < 0) && (s_a < 0) != (s_b < 0))) return std::nullopt;
  if (t_a == t_b || s_a == s_b) return std::nullopt;
  return Point(s.a + u * (s_a / (s_a - s_b)));
}

// Where the segments come within the tolerance of each other. Ends that they share by following each other do not
// count.
std::optional<Point> contact(const Segment& s, const Segment& t, double tolerance, bool t_follows, bool s_follows) {
  if (!t_follows && !s_follows) {
    if (auto at = crossing(s, t)) return at;
  }
  const auto near = [&](const Point& p, const Segment& other) {
    return distance_to_segment(p, other.a, other.b) <= tolerance;
  };
  if (!t_follows && near(t.a, s)) return t.a;
  if (!s_follows && near(t.b, s)) return t.b;
  if (!s_follows && near(s.a, t)) return s.a;
  if (!t_follows && near(s.b, t)) return s.b;
  return std::nullopt;
}

}  // namespace

MeetingsResult meetings(const std::vector<Loop>& loops, double tolerance_mm, std::size_t most,
                        const std::function<bool(int, int)>& comparable) {
  std::vector<Segment> segments;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    for (std::size_t i = 0; i < loops[k].size(); ++i) {
      segments.push_back({loops[k][i], loops[k][(i + 1) % loops[k].size()], static_cast<int>(k), static_cast<int>(i)});
    }
  }
  const Tree tree(segments);
  std::map<std::pair<int, int>, Point> found;
  std::int64_t work = 0;
  MeetingsResult result;
  for (std::size_t i = 0; i < segments.size() && work <= kMostWork && found.size() < most; ++i) {
    work += tree.query(static_cast<int>(i), tolerance_mm, [&](int j) {
      const Segment& s = segments[i];
      const Segment& t = segments[static_cast<std::size_t>(j)];
      if (found.contains({s.loop, t.loop}) || !comparable(s.loop, t.loop)) return;
      const int n = static_cast<int>(loops[static_cast<std::size_t>(s.loop)].size());
      const bool same = s.loop == t.loop;
      const auto at = contact(s, t, tolerance_mm, same && t.index == s.index + 1, same && (t.index + 1) % n == s.index);
      if (at) found.emplace(std::pair(s.loop, t.loop), *at);
    });
  }
  result.complete = work <= kMostWork;
  for (const auto& [pair, at] : found) result.meetings.push_back({pair.first, pair.second, at});
  return result;
}

}  // namespace formotion
