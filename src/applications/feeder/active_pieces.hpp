// The pieces that decide a clearance, a margin or a facet's place: which corners and edges, as written. With these held
// fast, the number that they decide is a smooth function of the variables; here it is, over any scalar.
#pragma once

#include <optional>
#include <variant>

#include "applications/feeder/traced_shapes.hpp"

namespace formotion::feeder {

enum class Body { Part, Void, Obstacle };

struct CornerRef {
  Body body = Body::Part;
  int loop = 0, index = 0;  // places in TracedShapes
  bool operator==(const CornerRef&) const = default;
};

// A line with its normal out of what it bounds.
struct LineRef {
  enum class Kind {
    Edge,     // through a written edge, which begins at `corner`
    Tangent,  // through a written corner, in a fixed direction: an arc's, where a corner is rounded
    Constant  // normal . p = offset_mm: the wall's face, the track's rim
  };
  Kind kind = Kind::Constant;
  CornerRef corner = {};
  double grow_mm = 0;  // then moved along the normal
  Point normal = {0, 1};
  double offset_mm = 0;
};

// A written corner, or where two lines meet.
struct PointRef {
  std::optional<CornerRef> corner;
  LineRef first = {}, second = {};
};

// The distance of a point from a line, less than 0 beyond it, one of them the part's and one fixed; or of two corners.
// A pin's centre is a corner.
struct GapRef {
  PointRef point;
  std::variant<LineRef, CornerRef> other;
};

// Where the part is. Travelling poses lie on the wall, so that they turn and rise as the part's shape changes, and are
// where an event happens.
struct PlaceRef {
  Configuration q;
  std::optional<std::array<CornerRef, 2>> rests_on;  // corners of the part on the wall, from left to right
  std::optional<GapRef> event;                       // stays 0
};

// minus the distance to where two contacts hold at once: how deep a part is in a corner of the free space.
struct SlotRef {
  std::array<GapRef, 2> contacts;
};

// The signed distance of the supported point, shift_mm nearer to the wall than the centre of mass, from an edge of the
// support hull, counter-clockwise; from a corner of it (less than 0) where `to` is none.
struct HullRef {
  PointRef from;
  std::optional<PointRef> to;
  double shift_mm = 0;
};

struct Piece {
  PlaceRef place;
  std::variant<GapRef, SlotRef, HullRef> decided_by;
};

template <class T>
class PieceKernel {
 public:
  PieceKernel(const TracedShapes<T>& shapes, const PlaceRef& place) : shapes_(shapes) { put(place); }

  T operator()(const GapRef& gap) const {
    const PointOf<T> point = at(gap.point);
    const T radius = gap.point.corner ? loop_of(*gap.point.corner).radius_mm : T(0.0);
    if (const auto* line = std::get_if<LineRef>(&gap.other)) {
      const LineOf on = at(*line);
      return on.normal.dot(point) - on.offset - radius;
    }
    const CornerRef& other = std::get<CornerRef>(gap.other);
    return length(point - at(other)) - radius - loop_of(other).radius_mm;
  }

  // One step of Newton's method carries the derivatives of the implicit function; the values stay.
  T operator()(const SlotRef& slot) const {
    const PointOf<T> ways[2] = {way(slot.contacts[0]), way(slot.contacts[1])};
    const T gap0 = (*this)(slot.contacts[0]), gap1 = (*this)(slot.contacts[1]);
    const T det = cross_of<T>(ways[0], ways[1]);
    // The move that closes both gaps.
    const PointOf<T> move((-gap0 * ways[1].y() + gap1 * ways[0].y()) / det,
                          (-gap1 * ways[0].x() + gap0 * ways[1].x()) / det);
    return -length(move);
  }

  T operator()(const HullRef& hull) const {
    const PointOf<T> supported(position_.x(), position_.y() - hull.shift_mm);
    const PointOf<T> from = at(hull.from) - supported;
    if (!hull.to) return -length(from);
    const PointOf<T> along = at(*hull.to) - supported - from;
    return cross_of<T>(from, along) / length(along);
  }

 private:
  struct LineOf {
    PointOf<T> normal;
    T offset;
  };

  static T length(const PointOf<T>& p) {
    using std::sqrt;
    const T squared = p.x() * p.x() + p.y() * p.y();
    return T(0.0) < squared ? T(sqrt(squared)) : T(0.0);
  }

  const TracedLoop<T>& loop_of(const CornerRef& ref) const {
    const auto k = static_cast<std::size_t>(ref.loop);
    return ref.body == Body::Part ? shapes_.part[k] : ref.body == Body::Void ? shapes_.voids[k] : shapes_.obstacles[k];
  }
  PointOf<T> turned(const PointOf<T>& p) const { return {c_ * p.x() - s_ * p.y(), s_ * p.x() + c_ * p.y()}; }

  PointOf<T> at(const CornerRef& ref) const {
    const LoopOf<T>& points = loop_of(ref).points;
    const PointOf<T>& p = points[static_cast<std::size_t>(ref.index) % points.size()];
    return ref.body == Body::Part ? PointOf<T>(position_ + turned(p)) : p;
  }
  LineOf at(const LineRef& ref) const {
    if (ref.kind == LineRef::Kind::Constant) {
      return {PointOf<T>(T(ref.normal.x()), T(ref.normal.y())), T(ref.offset_mm + ref.grow_mm)};
    }
    const PointOf<T> from = at(ref.corner);
    PointOf<T> normal(T(ref.normal.x()), T(ref.normal.y()));
    if (ref.kind == LineRef::Kind::Edge) {
      const PointOf<T> along = at(CornerRef{ref.corner.body, ref.corner.loop, ref.corner.index + 1}) - from;
      normal = PointOf<T>(along.y(), -along.x()) * (loop_of(ref.corner).sense / length(along));
    }
    return {normal, normal.dot(from) + ref.grow_mm};
  }
  PointOf<T> at(const PointRef& ref) const {
    if (ref.corner) return at(*ref.corner);
    const LineOf a = at(ref.first), b = at(ref.second);
    const T det = cross_of<T>(a.normal, b.normal);
    return {(a.offset * b.normal.y() - b.offset * a.normal.y()) / det,
            (b.offset * a.normal.x() - a.offset * b.normal.x()) / det};
  }

  // The gap's derivative when the part moves.
  PointOf<T> way(const GapRef& gap) const {
    PointOf<T> away;
    if (const auto* line = std::get_if<LineRef>(&gap.other)) {
      away = at(*line).normal;
    } else {
      const PointOf<T> apart = at(gap.point) - at(std::get<CornerRef>(gap.other));
      away = apart / length(apart);
    }
    const bool point_moves = gap.point.corner && gap.point.corner->body == Body::Part;
    return point_moves ? away : PointOf<T>(-away);
  }

  void put(const PlaceRef& place) {
    using std::atan2;
    using std::cos;
    using std::sin;
    T theta(place.q.theta_rad);
    position_ = PointOf<T>(T(place.q.x_mm), T(place.q.y_mm));
    c_ = cos(theta);
    s_ = sin(theta);
    if (place.rests_on) {
      const PointOf<T>&a = part_point((*place.rests_on)[0]), &b = part_point((*place.rests_on)[1]);
      const PointOf<T> along = turned(b - a);
      theta -= atan2(along.y(), along.x());
      c_ = cos(theta);
      s_ = sin(theta);
      position_.y() = -turned(a).y();
    }
    if (place.event) {
      const T gap = (*this)(*place.event);
      position_.x() -= gap / way(*place.event).x();
    }
  }
  const PointOf<T>& part_point(const CornerRef& ref) const {
    const LoopOf<T>& points = shapes_.part[static_cast<std::size_t>(ref.loop)].points;
    return points[static_cast<std::size_t>(ref.index) % points.size()];
  }

  const TracedShapes<T>& shapes_;
  PointOf<T> position_;
  T c_, s_;
};

template <class T>
T signed_mm(const Piece& piece, const TracedShapes<T>& shapes) {
  return std::visit(PieceKernel<T>(shapes, piece.place), piece.decided_by);
}

}  // namespace formotion::feeder
