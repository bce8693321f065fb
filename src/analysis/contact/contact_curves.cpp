#include "analysis/contact/contact_curves.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/contact/facets.hpp"
#include "analysis/contact/trig_roots.hpp"

namespace formotion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPole = 1e-14;            // sine of the angle between lines that meet nowhere
constexpr double kTangent = 1e-12;         // relative square of half a chord: a point
constexpr double kAlwaysParallel = 1e-12;  // sine
constexpr double kNoTriple = 1e-12;        // relative: a determinant that vanishes at every theta
constexpr double kIllPlaced = 1e-9;        // sine of the largest angle between three normals: no isolated point
constexpr double kSolved_mm = 1e-9;        // gaps after polishing
constexpr double kSameRoot = 1e-7;         // mm and rad
constexpr int kSamples = 1440;

bool is_edge_contact(const ContactPair& pair) { return pair.kind != ContactKind::CornerOnCorner; }

// An edge contact as N . p = h over theta, about an origin in the world: in world axes, or in those of the part
// (p and N turned back).
struct MovingLine {
  TrigPolynomial nx, ny, h;
};

MovingLine moving_line(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair,
                       const Point& origin, bool in_part_axes) {
  const auto turning = [](const Point& m, double sense) {  // m turned by theta (sense 1) or back (-1)
    return std::pair(TrigPolynomial{0, m.x(), -sense * m.y()}, TrigPolynomial{0, m.y(), sense * m.x()});
  };
  const auto fixed = [](const Point& n) { return std::pair(TrigPolynomial{n.x()}, TrigPolynomial{n.y()}); };
  if (pair.kind == ContactKind::CornerOnEdge) {
    const FixedEdge& edge = obstacles.edges[pair.fixed];
    const Point& a = part.corners[pair.moving].at;
    const auto [nx, ny] = in_part_axes ? turning(edge.normal, -1) : fixed(edge.normal);
    return {nx, ny, {edge.normal.dot(edge.from - origin), -edge.normal.dot(a), -edge.normal.dot(turned_left(a))}};
  }
  const MovingEdge& edge = part.edges[pair.moving];
  const FixedCorner& corner = obstacles.corners[pair.fixed];
  const Point b = corner.centre - origin;
  const auto [nx, ny] = in_part_axes ? fixed(edge.normal) : turning(edge.normal, 1);
  return {
      nx, ny, {-edge.normal.dot(edge.from) - corner.radius_mm, edge.normal.dot(b), turned_left(edge.normal).dot(b)}};
}

TrigPolynomial cross_of(const MovingLine& a, const MovingLine& b) { return a.nx * b.ny - a.ny * b.nx; }

Point fixed_point(const Obstacles& obstacles, const ContactPair& pair) {
  return pair.kind == ContactKind::CornerOnEdge ? obstacles.edges[pair.fixed].from
                                                : obstacles.corners[pair.fixed].centre;
}

// Newton on the three gaps; false where they do not vanish.
bool polish(const MovingShape& part, const Obstacles& obstacles, const std::array<ContactPair, 3>& pairs,
            Configuration& q) {
  double before = 1e300;
  Configuration best = q;
  for (int i = 0; i < 12; ++i) {
    Eigen::Matrix3d gradients;
    Eigen::Vector3d gaps;
    const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
    for (int k = 0; k < 3; ++k) {
      const ContactState state = contact_state(part, obstacles, pairs[k], q.position(), c, s);
      gradients.row(k) = state.gradient();
      gaps[k] = state.gap_mm;
    }
    const double worst = gaps.cwiseAbs().maxCoeff();
    if (!(worst < before)) break;
    before = worst;
    best = q;
    const Eigen::FullPivLU<Eigen::Matrix3d> lu(gradients);
    if (worst == 0 || lu.rank() < 3) break;
    const Eigen::Vector3d step = lu.solve(gaps);
    q = {q.x_mm - step.x(), q.y_mm - step.y(), q.theta_rad - step.z()};
  }
  q = best;
  return before <= kSolved_mm;
}

bool is_within(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair, const Configuration& q,
               const ThreeContactOptions& options) {
  const ContactState state =
      contact_state(part, obstacles, pair, q.position(), std::cos(q.theta_rad), std::sin(q.theta_rad));
  if (state.along_mm < -options.tolerance_mm || state.along_mm > state.extent_mm + options.tolerance_mm) return false;
  const auto orientations = contact_orientations(part, obstacles, pair);
  if (!orientations || !orientations->contains(q.theta_rad, options.tolerance_rad)) return false;
  if (is_edge_contact(pair)) return true;
  return part.corners[pair.moving].normals.contains(std::atan2(-state.normal.y(), -state.normal.x()) - q.theta_rad,
                                                    options.tolerance_rad);
}

// Orientations at which three lines meet in a point, and the point.
std::vector<Configuration> meetings_of_lines(const MovingShape& part, const Obstacles& obstacles,
                                             const std::array<ContactPair, 3>& pairs) {
  const auto corners = std::count_if(pairs.begin(), pairs.end(),
                                     [](const ContactPair& p) { return p.kind == ContactKind::CornerOnEdge; });
  const Point origin = fixed_point(obstacles, pairs[0]);
  std::array<MovingLine, 3> lines;
  double scale = 0;
  for (int k = 0; k < 3; ++k) {
    lines[k] = moving_line(part, obstacles, pairs[k], origin, corners < 2);
    scale = std::max(scale, lines[k].h.size());
  }
  const TrigPolynomial determinant = lines[0].h * cross_of(lines[1], lines[2]) -
                                     lines[1].h * cross_of(lines[0], lines[2]) +
                                     lines[2].h * cross_of(lines[0], lines[1]);
  if (determinant.size() <= kNoTriple * scale) return {};
  std::vector<Configuration> found;
  for (const double theta : zeros(determinant)) {
    const double c = std::cos(theta), s = std::sin(theta);
    std::array<ContactLocus, 3> loci;
    for (int k = 0; k < 3; ++k) loci[k] = contact_locus(part, obstacles, pairs[k], c, s);
    int best = 0;
    double sine = 0;
    for (int k = 0; k < 3; ++k) {
      const double here = std::abs(cross(loci[k].normal, loci[(k + 1) % 3].normal));
      if (here <= sine) continue;
      sine = here;
      best = k;
    }
    if (sine < kIllPlaced) continue;
    const auto meeting = two_contact_positions(part, obstacles, pairs[best], pairs[(best + 1) % 3], c, s);
    if (meeting.count > 0) found.push_back({meeting.position[0].x(), meeting.position[0].y(), theta});
  }
  return found;
}

// The third gap along the curve of the first two, where these meet; branch: which of two meetings.
struct ThirdGap {
  const MovingShape& part;
  const Obstacles& obstacles;
  std::array<ContactPair, 3> pairs;
  int branch = 0;

  std::optional<Point> position(double theta) const {
    const auto meeting = two_contact_positions(part, obstacles, pairs[0], pairs[1], std::cos(theta), std::sin(theta));
    return branch < meeting.count ? std::optional(meeting.position[branch]) : std::nullopt;
  }
  std::optional<double> operator()(double theta) const {
    const auto p = position(theta);
    if (!p) return std::nullopt;
    return contact_state(part, obstacles, pairs[2], *p, std::cos(theta), std::sin(theta)).gap_mm;
  }
};

// The last theta from `in` towards `out` that the predicate holds for.
template <typename Holds>
double bisected(double in, double out, const Holds& holds) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (in + out);
    (holds(middle) ? in : out) = middle;
  }
  return in;
}

std::vector<Configuration> meetings_with_round(const MovingShape& part, const Obstacles& obstacles,
                                               const std::array<ContactPair, 3>& pairs) {
  // Each contact as the third: a gap that only touches zero along one curve changes its sign along another, and two of
  // the contacts may be parallel always.
  std::vector<Configuration> found;
  for (int way = 0; way < 6; ++way) {
    const int third = way % 3, branch = way / 3;
    const std::array<ContactPair, 3> turned{pairs[(third + 1) % 3], pairs[(third + 2) % 3], pairs[third]};
    const ThirdGap gap{part, obstacles, turned, branch};
    for (int i = 0; i < kSamples; ++i) {
      double from = 2 * kPi * i / kSamples, to = 2 * kPi * (i + 1) / kSamples;
      if (!gap(from) && !gap(to)) continue;
      const auto exists = [&](double theta) { return gap(theta).has_value(); };
      if (!gap(from)) from = bisected(to, from, exists);
      if (!gap(to)) to = bisected(from, to, exists);
      const double at_from = *gap(from), at_to = *gap(to);
      if ((at_from < 0) == (at_to < 0) && at_from != 0 && at_to != 0) continue;
      const double theta = bisected(from, to, [&](double t) {
        const auto here = gap(t);
        return here && (*here < 0) == (at_from < 0);
      });
      if (const auto p = gap.position(theta)) found.push_back({p->x(), p->y(), theta});
    }
  }
  return found;
}

}  // namespace

ContactLocus contact_locus(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair, double c,
                           double s) {
  ContactLocus locus;
  switch (pair.kind) {
    case ContactKind::CornerOnEdge: {
      const FixedEdge& edge = obstacles.edges[pair.fixed];
      locus.normal = edge.normal;
      locus.offset_mm = edge.normal.dot(edge.from - rotated(part.corners[pair.moving].at, c, s));
      break;
    }
    case ContactKind::EdgeOnCorner: {
      const MovingEdge& edge = part.edges[pair.moving];
      const FixedCorner& corner = obstacles.corners[pair.fixed];
      locus.normal = rotated(-edge.normal, c, s);
      locus.offset_mm = locus.normal.dot(corner.centre) + edge.normal.dot(edge.from) + corner.radius_mm;
      break;
    }
    case ContactKind::CornerOnCorner: {
      const FixedCorner& corner = obstacles.corners[pair.fixed];
      locus.centre = corner.centre - rotated(part.corners[pair.moving].at, c, s);
      locus.radius_mm = corner.radius_mm;
      break;
    }
  }
  return locus;
}

TwoContactPositions two_contact_positions(const MovingShape& part, const Obstacles& obstacles, const ContactPair& first,
                                          const ContactPair& second, double c, double s) {
  ContactLocus a = contact_locus(part, obstacles, first, c, s), b = contact_locus(part, obstacles, second, c, s);
  if (a.radius_mm > 0 && b.radius_mm == 0) std::swap(a, b);
  TwoContactPositions found;
  if (b.radius_mm == 0) {  // two lines
    const double sine = cross(a.normal, b.normal);
    if (std::abs(sine) < kPole) return found;
    found.count = 1;
    found.position[0] = Point(a.offset_mm * b.normal.y() - b.offset_mm * a.normal.y(),
                              b.offset_mm * a.normal.x() - a.offset_mm * b.normal.x()) /
                        sine;
    return found;
  }
  // A chord of the circle b: its middle, half of it, and its direction.
  Point middle, direction;
  double off = 0;
  if (a.radius_mm == 0) {
    off = a.offset_mm - a.normal.dot(b.centre);
    middle = b.centre + off * a.normal;
    direction = turned_left(a.normal);
  } else {
    const Point between = a.centre - b.centre;
    const double d = between.norm();
    if (d == 0) return found;
    off = (d * d + b.radius_mm * b.radius_mm - a.radius_mm * a.radius_mm) / (2 * d);
    middle = b.centre + off / d * between;
    direction = turned_left(between) / d;
  }
  const double squared = b.radius_mm * b.radius_mm - off * off;
  const double rounding = kTangent * b.radius_mm * b.radius_mm;
  if (squared < -rounding) return found;
  const double half = squared > rounding ? std::sqrt(squared) : 0;
  found.count = half > 0 ? 2 : 1;
  found.position = {middle + half * direction, middle - half * direction};
  return found;
}

std::vector<double> horizontal_orientations(const MovingShape& part, const Obstacles& obstacles,
                                            const ContactPair& first, const ContactPair& second) {
  if (!is_edge_contact(first) || first.kind != second.kind) return {};
  const bool in_part_axes = first.kind == ContactKind::EdgeOnCorner;
  const Point origin = fixed_point(obstacles, first);
  const MovingLine a = moving_line(part, obstacles, first, origin, in_part_axes);
  const MovingLine b = moving_line(part, obstacles, second, origin, in_part_axes);
  if (cross_of(a, b).size() > kAlwaysParallel) return {};
  const bool same_way = a.nx.constant * b.nx.constant + a.ny.constant * b.ny.constant > 0;
  const TrigPolynomial between = same_way ? b.h - a.h : b.h + a.h;
  if (between.size() <= kNoTriple * (a.h.size() + b.h.size())) return {};  // the same line always
  return zeros(between);
}

Eigen::Vector3d curve_tangent(const ContactState& first, const ContactState& second, double gyration_mm) {
  const Eigen::Vector3d along = scaled_normal(first, gyration_mm).cross(scaled_normal(second, gyration_mm));
  const double length = along.norm();
  return length < kPole ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(along / length);
}

std::vector<Configuration> three_contacts(const MovingShape& part, const Obstacles& obstacles,
                                          const std::array<ContactPair, 3>& pairs, const ThreeContactOptions& options) {
  const bool lines = std::all_of(pairs.begin(), pairs.end(), is_edge_contact);
  std::vector<Configuration> found;
  for (Configuration q :
       lines ? meetings_of_lines(part, obstacles, pairs) : meetings_with_round(part, obstacles, pairs)) {
    if (!polish(part, obstacles, pairs, q)) continue;
    q.theta_rad -= 2 * kPi * std::floor(q.theta_rad / (2 * kPi));
    const bool within = !options.within_facets || std::all_of(pairs.begin(), pairs.end(), [&](const ContactPair& pair) {
      return is_within(part, obstacles, pair, q, options);
    });
    const bool known = std::any_of(found.begin(), found.end(), [&](const Configuration& other) {
      return (q.position() - other.position()).norm() < kSameRoot &&
             std::abs(std::remainder(q.theta_rad - other.theta_rad, 2 * kPi)) < kSameRoot;
    });
    if (within && !known) found.push_back(q);
  }
  return found;
}

}  // namespace formotion
