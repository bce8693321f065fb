#include "analysis/motion/projection.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <limits>
#include <sstream>

#include "analysis/motion/flow.hpp"

namespace formotion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kOverlap_mm = 1e-8;     // gaps below minus this are contacts that have been missed
constexpr double kForever_mm = 9e3;      // translations longer than this meet nothing more
constexpr double kReserve = 2e-9;        // modes hold until their reserve is below minus this
constexpr double kChordError_mm = 1e-5;  // of a cubic that stands for a gap that begins flat
constexpr double kFlat_mm = 1e-9;
constexpr double kLongestChord_mm = 0.3;  // steps that bend more are shortened
constexpr double kStepError_mm = 1e-9;    // of integration
constexpr double kSamePath_mm = 1e-9;     // between places where guided translations end
constexpr double kSameWay = 1e-7;         // between directions of motion, of unit speed
constexpr double kSlow = 1e-7;            // of the drive: forces that are out of balance by less leave the part at rest
constexpr double kShortest = 1e-12;       // steps

double chord(const Configuration& a, const Configuration& b, double reach) {
  return std::hypot(a.x_mm - b.x_mm, a.y_mm - b.y_mm, reach * (a.theta_rad - b.theta_rad));
}

// The first root of a function with f(a) >= 0 > f(b).
template <class F>
double root(const F& f, double a, double b, double fa, double fb) {
  if (fa == 0) return a;
  std::uintmax_t most = 200;
  // Relative to the bracket: a slide goes far within angles of 1e-12 where its force passes by the centre of mass.
  const auto close = [width = b - a](double low, double high) { return high - low <= 1e-13 * width; };
  return boost::math::tools::toms748_solve(f, a, b, fa, fb, close, most).second;
}

// The root of a falling function whose slope is known: Newton's method inside a bracket that halves where it fails.
template <class F>
double steep_root(const F& f, double low, double high, double f_low, double f_high) {
  double x = low + (high - low) * f_low / (f_low - f_high);
  for (int i = 0; i < 80; ++i) {
    const auto [value, slope] = f(x);
    (value >= 0 ? low : high) = x;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (std::abs(next - x) <= 1e-15 + 4e-16 * std::abs(x) || !(next > low && next < high)) break;
    x = next;
  }
  return x;
}

struct Candidate {
  Flow flow;
  Twist twist;
  Configuration ahead;
  double reserve = 0;
};

class Follower {
 public:
  Follower(const ContactSpace& space, const Drive& drive, const ProjectionOptions& options)
      : space_(space), drive_(drive), law_(law_of(drive, space.part)), options_(options) {}

  Projection run(const Configuration& start) {
    Projection result;
    std::vector<Funnels::Funnel> entered;
    follow_from(start, result, entered, options_.max_branching);
    if (options_.funnels) {
      for (Funnels::Funnel& funnel : entered) {
        funnel.end = result;
        options_.funnels->known.push_back(std::move(funnel));
      }
    }
    return result;
  }

 private:
  struct Stop {
    Configuration q;
    std::string event;
  };

  void follow_from(const Configuration& start, Projection& result, std::vector<Funnels::Funnel>& entered, int branching,
                   std::optional<Flow> flow = std::nullopt) const {
    Configuration q = start;
    std::string event = "start";
    for (int legs = 0; legs < options_.max_legs; ++legs) {
      result.last = q;
      if (!flow) {
        std::vector<Flow> flows = choose(q, result);
        if (flows.size() > 1 || result.end == ProjectionEnd::Ambiguous) branch(q, flows, result, branching);
        if (flows.empty() || result.end == ProjectionEnd::Ambiguous) return;
        flow = std::move(flows.front());
      }
      flow->settle();
      q = flow->start();
      remember(*flow, result.history);
      if (options_.keep_path) result.legs.push_back(leg_of(*flow, q, event));
      const bool translates = flow->longest_step() == kInfinity;
      const Twist direction = flow->tangent(q);
      result.funnelled = result.funnelled || (translates && flow->pairs().size() > 1);
      std::optional<Stop> stop =
          translates ? translate(*flow) : turn(*flow, options_.keep_path ? &result.legs.back().between : nullptr);
      if (translates && options_.watch) {
        const double way = stop ? (stop->q.position() - q.position()).norm() : kForever_mm;
        if (const auto ends = options_.watch({flow->kind(), [&](double t) { return flow->at(t * way); }})) {
          stop = Stop{flow->at(*ends * way), kStops};
        }
      }
      if (!stop) {
        result.end = ProjectionEnd::Steady;
        result.last_twist = direction;
        return;
      }
      q = stop->q;
      event = stop->event;
      if (event == kStops) {
        result.last = q;
        result.end = ProjectionEnd::Stopped;
        return;
      }
      if (translates && options_.funnels && flow->pairs().size() > 1) {
        for (const Funnels::Funnel& known : options_.funnels->known) {
          if (known.pairs != flow->pairs() || chord(known.mouth, q, space_.part.reach_mm) > kSamePath_mm) continue;
          const std::uint64_t own = result.history;
          result = known.end;
          result.history = own * 31 + known.end.history;  // two ways into one funnel are two
          return;
        }
        entered.push_back({flow->pairs(), q, {}});
      }
      flow.reset();
    }
    result.end = ProjectionEnd::Undecided;
    result.why = "it makes more than " + std::to_string(options_.max_legs) + " legs";
  }

  static void remember(const Flow& flow, std::uint64_t& history) {  // FNV-1a
    const auto mix = [&](std::uint64_t word) { history = (history ^ word) * 1099511628211ull; };
    mix(14695981039346656037ull + static_cast<std::uint64_t>(flow.kind()));
    for (std::size_t i = 0; i < flow.pairs().size(); ++i) {
      const ContactPair& pair = flow.pairs()[i];
      mix(static_cast<std::uint64_t>(pair.kind) << 40 | static_cast<std::uint64_t>(pair.moving) << 20 |
          static_cast<std::uint64_t>(pair.fixed));
      mix(static_cast<std::uint64_t>(flow.modes()[i]));
    }
  }

  void branch(const Configuration& q, const std::vector<Flow>& flows, Projection& result, int branching) const {
    if (branching <= 0) return;
    if (result.may_rest) {
      result.branches.emplace_back();
      result.branches.back().end = ProjectionEnd::AtRest;
      result.branches.back().last = q;
    }
    ProjectionOptions without_legs = options_;
    without_legs.keep_path = false;
    without_legs.funnels = nullptr;
    const Follower other(space_, drive_, without_legs);
    for (const Flow& flow : flows) {
      Projection end;
      std::vector<Funnels::Funnel> none;
      other.follow_from(q, end, none, branching - 1, flow);
      result.history = result.history * 31 + end.history;
      result.branches.push_back(std::move(end));
    }
  }

  // The motions from q; where there is not just one, result says how the path ends.
  std::vector<Flow> choose(const Configuration& q, Projection& result) const {
    const std::vector<TouchCluster> clusters = touches_at(space_, q);
    std::vector<Flow> flows;
    for (const double shorter : {1.0, 1e-2}) {
      std::vector<Candidate> candidates = candidates_at(q, clusters, shorter);
      if (candidates.empty()) continue;
      result.may_rest = can_rest(clusters, kReserve);
      // Those that lead the same way are one: the one with the most in reserve.
      std::stable_sort(candidates.begin(), candidates.end(),
                       [](const Candidate& a, const Candidate& b) { return a.reserve > b.reserve; });
      std::vector<Twist> ways;  // of unit speed: flows go by different parameters
      for (Candidate& candidate : candidates) {
        const double fast = speed(candidate.twist, law_.length_mm);
        const Twist way{candidate.twist.linear / fast, candidate.twist.angular / fast};
        const bool known = std::any_of(ways.begin(), ways.end(), [&](const Twist& other) {
          return speed({way.linear - other.linear, way.angular - other.angular}, law_.length_mm) <= kSameWay;
        });
        if (known) continue;
        ways.push_back(way);
        flows.push_back(std::move(candidate.flow));
      }
      if (flows.size() == 1 && !result.may_rest) return flows;
      result.end = ProjectionEnd::Ambiguous;
      result.why = flows.size() > 1 ? "several motions are consistent with friction here" : "it may move or stay";
      return flows;
    }
    // Motions so slow that none is left stand still: where a part comes to rest without friction it slows down for
    // ever.
    result.end = can_rest(clusters, kSlow) ? ProjectionEnd::AtRest : ProjectionEnd::Undecided;
    if (result.end == ProjectionEnd::Undecided) result.why = "no motion is consistent with its contacts";
    return flows;
  }

  bool can_rest(const std::vector<TouchCluster>& clusters, double tolerance) const {
    std::vector<ContactPoint> contacts;
    for (const TouchCluster& cluster : clusters) contacts.push_back(point_of(cluster.front().state));
    return clusters.size() > 1 && equilibrium(contacts, law_, tolerance).has_value();
  }

  // Every choice of carrying contacts and modes that is consistent now and after a look-ahead.
  std::vector<Candidate> candidates_at(const Configuration& q, const std::vector<TouchCluster>& clusters,
                                       double shorter) const {
    std::vector<Candidate> found;
    std::vector<int> chosen(clusters.size(), -1);  // -1: the cluster carries nothing
    for (;;) {
      try_choice(q, clusters, chosen, shorter, found);
      std::size_t i = 0;
      while (i < chosen.size() && ++chosen[i] == static_cast<int>(clusters[i].size())) chosen[i++] = -1;
      if (i == chosen.size()) return found;
    }
  }

  void try_choice(const Configuration& q, const std::vector<TouchCluster>& clusters, const std::vector<int>& chosen,
                  double shorter, std::vector<Candidate>& found) const {
    std::vector<ContactPoint> points;
    std::vector<ContactPair> pairs;
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      if (chosen[i] < 0) continue;
      points.push_back(point_of(clusters[i][chosen[i]].state));
      pairs.push_back(clusters[i][chosen[i]].pair);
    }
    if (points.size() > 3) return;  // three carry whatever more can
    static constexpr ContactMode kModes[]{ContactMode::SlideLeft, ContactMode::SlideRight, ContactMode::Stick};
    const int mode_count = drive_.friction > 0 ? 3 : 2;
    std::vector<int> digits(points.size(), 0);
    std::vector<ContactMode> modes(points.size());
    for (;;) {
      for (std::size_t i = 0; i < digits.size(); ++i) modes[i] = kModes[digits[i]];
      try_modes(q, clusters, chosen, points, pairs, modes, shorter, found);
      std::size_t i = 0;
      while (i < digits.size() && ++digits[i] == mode_count) digits[i++] = 0;
      if (i == digits.size()) return;
    }
  }

  void try_modes(const Configuration& q, const std::vector<TouchCluster>& clusters, const std::vector<int>& chosen,
                 const std::vector<ContactPoint>& points, const std::vector<ContactPair>& pairs,
                 const std::vector<ContactMode>& modes, double shorter, std::vector<Candidate>& found) const {
    const std::optional<Motion> motion = motion_of_modes(points, modes, law_);
    if (!motion || !is_consistent(points, *motion, law_)) return;
    const double fast = speed(motion->twist, law_.length_mm);
    if (fast <= 1e-9 * drive_.force.norm()) return;  // rest is looked at apart
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      if (chosen[i] >= 0) continue;
      double most = -kInfinity;
      for (const Touch& touch : clusters[i])
        most = std::max(most, separation_speed(point_of(touch.state), motion->twist));
      if (most < -1e-9 * fast) return;
    }
    std::optional<Flow> flow = Flow::through(space_, drive_, pairs, *motion, q);
    if (!flow) return;
    const Configuration ahead = flow->at(shorter * flow->small_step());
    const double reserve = flow->reserve(ahead);
    if (reserve < -kReserve) return;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      if (chosen[i] < 0 && least_overlap(clusters[i], ahead) < -1e-10) return;
    }
    found.push_back({std::move(*flow), motion->twist, ahead, reserve});
  }

  // How far a cluster's gaps have closed below where they were, or below 0; alternatives count by the widest.
  double least_overlap(const TouchCluster& cluster, const Configuration& ahead) const {
    double widest = -kInfinity;
    const double c = std::cos(ahead.theta_rad), s = std::sin(ahead.theta_rad);
    for (const Touch& touch : cluster) {
      const ContactState state = contact_state(space_.part, space_.obstacles, touch.pair, ahead.position(), c, s);
      widest = std::max(widest, state.gap_mm - std::min(0.0, touch.state.gap_mm));
    }
    return widest;
  }

  // The gaps of everything near a step, at its ends.
  struct Watched {
    std::size_t index;
    double gap, rate;
  };

  double gap_at(std::size_t index, const Configuration& q, ContactState* out = nullptr) const {
    const ContactState state = contact_state(space_.part, space_.obstacles, space_.pairs[index], q.position(),
                                             std::cos(q.theta_rad), std::sin(q.theta_rad));
    if (out) *out = state;
    return state.gap_mm;
  }

  static constexpr const char* kTouches = "touches";
  static constexpr const char* kChanges = "contact changes";
  static constexpr const char* kStops = "stopped";

  // Everything moves on straight lines.
  std::optional<Stop> translate(const Flow& flow) const {
    const Configuration& q = flow.start();
    const Twist t = flow.tangent(q);
    const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
    double first = kForever_mm;
    const char* event = nullptr;
    for (std::size_t i = 0; i < space_.pairs.size(); ++i) {
      const ContactPair& pair = space_.pairs[i];
      if (carries(flow, pair)) continue;
      if (pair.kind == ContactKind::CornerOnCorner) {
        const double at = meets_round(pair, q, t, c, s, first);
        if (at < first && closes(flow, i, flow.at(at))) {
          first = at;
          event = kTouches;
        }
        continue;
      }
      const ContactState state = contact_state(space_.part, space_.obstacles, pair, q.position(), c, s);
      const double rate = state.normal.dot(t.linear);
      if (rate >= -1e-12 || state.gap_mm < -kContact_mm) continue;
      const double at = std::max(0.0, state.gap_mm) / -rate;
      if (at >= first) continue;
      // What touched at the start was looked at when this motion was chosen.
      if (state.gap_mm <= kContact_mm && (at == 0 || can_touch(space_, i, state, q.theta_rad))) continue;
      if (!closes(flow, i, flow.at(at))) continue;
      first = at;
      event = kTouches;
    }
    for (const ContactPair& pair : flow.pairs()) {
      const double until = leaves_edge(pair, q, t, c, s);
      if (until >= first) continue;
      first = until;
      event = kChanges;
    }
    // A change of modes.
    if (!flow.pairs().empty()) {
      const auto left = [&](double h) { return flow.reserve(flow.at(h)) + kReserve; };
      const double at_end = left(first);
      if (at_end < 0) {
        const double at_start = left(0);
        first = at_start <= 0 ? 0 : root(left, 0, first, at_start, at_end);
        event = kChanges;
      }
    }
    if (!event) return std::nullopt;
    return Stop{flow.at(first), event};
  }

  // Whether a pair whose gap is about 0 at q touches there: its features are in reach of each other, and where convex
  // corners meet no other pair of their edges keeps them apart.
  bool closes(const Flow& flow, std::size_t index, const Configuration& q) const {
    Touch touch{space_.pairs[index], {}};
    gap_at(index, q, &touch.state);
    if (!can_touch(space_, index, touch.state, q.theta_rad)) return false;
    const CornerMeeting meeting = meeting_of(space_, touch);
    if (!meeting.is_one()) return true;
    for (const std::size_t other : space_.pairs_of(meeting)) {
      if (other == index) continue;
      touch.pair = space_.pairs[other];
      const double gap = gap_at(other, q, &touch.state);
      if (!can_touch(space_, other, touch.state, q.theta_rad) || meeting_of(space_, touch) != meeting) continue;
      if (gap > kOverlap_mm || carries(flow, touch.pair)) return false;
    }
    return true;
  }

  static bool carries(const Flow& flow, const ContactPair& pair) {
    return std::find(flow.pairs().begin(), flow.pairs().end(), pair) != flow.pairs().end();
  }

  // How far a guided translation goes until the contact is at the end of its edge.
  double leaves_edge(const ContactPair& pair, const Configuration& q, const Twist& t, double c, double s) const {
    if (pair.kind == ContactKind::CornerOnCorner) return kInfinity;  // does not translate
    const ContactState state = contact_state(space_.part, space_.obstacles, pair, q.position(), c, s);
    const double rate = pair.kind == ContactKind::CornerOnEdge
                            ? space_.obstacles.edges[pair.fixed].along.dot(t.linear)
                            : -rotated(space_.part.edges[pair.moving].along, c, s).dot(t.linear);
    if (rate > 0) return std::max(0.0, (state.extent_mm - state.along_mm) / rate);
    return rate < 0 ? std::max(0.0, state.along_mm / -rate) : kInfinity;
  }

  double meets_round(const ContactPair& pair, const Configuration& q, const Twist& t, double c, double s,
                     double before) const {
    const FixedCorner& corner = space_.obstacles.corners[pair.fixed];
    const Point from = q.position() + rotated(space_.part.corners[pair.moving].at, c, s) - corner.centre;
    const double half_b = from.dot(t.linear), apart = from.squaredNorm() - corner.radius_mm * corner.radius_mm;
    const double discriminant = half_b * half_b - apart;
    if (half_b >= 0 || discriminant < 0 || from.norm() - corner.radius_mm < kContact_mm) return kInfinity;
    const double at = apart / (-half_b + std::sqrt(discriminant));
    return at < before ? at : kInfinity;
  }

  std::optional<Stop> turn(Flow& flow, std::vector<Configuration>* between) const {
    std::vector<bool> near_edge(space_.edge_boxes.size()), near_corner(space_.corner_boxes.size());
    for (int steps = 0; steps < 100000; ++steps) {
      const Configuration q = flow.start();
      double h = flow.longest_step();
      if (!(h > kShortest)) return Stop{q, "stalls"};
      const Twist rate = flow.tangent(q);
      Step step{q, rate, q, rate, h, 0};
      while (!take(flow, step, h) && h > kShortest) h /= 2;
      const char* event = nullptr;
      const auto left = [&](double at) { return flow.reserve(flow.at(at)) + kReserve; };
      double before = 0;
      for (const double at : {h / 2, h}) {  // twice a step: a mode may end and begin again
        if (const double at_end = left(at); at_end < 0) {
          const double at_start = left(before),
                       ends = at_start <= 0 ? before : root(left, before, at, at_start, at_end);
          take(flow, step, ends);
          event = kChanges;
          break;
        }
        before = at;
      }
      if (step.h > 0) {
        const double touch = first_touch(flow, step, near_edge, near_corner);
        if (touch < step.h || (touch == step.h && !event)) {
          take(flow, step, touch);
          event = kTouches;
        }
      }
      if (options_.watch && step.h > 0) {
        if (const auto ends = options_.watch({flow.kind(), [&](double t) { return flow.at(t * step.h); }})) {
          return Stop{flow.at(*ends * step.h), kStops};
        }
      }
      const Configuration& end = step.end;
      if (event) return Stop{end, event};
      if (between) between->push_back(end);
      flow.restart(end, step.h);
    }
    return Stop{flow.start(), "stalls"};
  }

  struct Step {
    Configuration start;
    Twist rate;
    Configuration end;
    Twist rate_end;
    double h = 0;
    double chord_mm = 0;  // between the flow and the cubic through the step's ends and rates, in its middle
  };

  // False where the flow cannot be followed so far.
  bool take(const Flow& flow, Step& step, double h) const {
    double error = 0;
    step.h = h;
    step.end = flow.at(h, error);
    step.rate_end = flow.tangent(step.end);
    if (!std::isfinite(step.end.x_mm) || !std::isfinite(step.end.y_mm) || !std::isfinite(step.rate_end.angular))
      return false;
    const Configuration middle = flow.at(h / 2);
    const auto cubic = [h](double a, double da, double b, double db) { return (a + b) / 2 + h * (da - db) / 8; };
    const Configuration guess{
        cubic(step.start.x_mm, step.rate.linear.x(), step.end.x_mm, step.rate_end.linear.x()),
        cubic(step.start.y_mm, step.rate.linear.y(), step.end.y_mm, step.rate_end.linear.y()),
        cubic(step.start.theta_rad, step.rate.angular, step.end.theta_rad, step.rate_end.angular)};
    step.chord_mm = chord(middle, guess, space_.part.reach_mm);
    return error <= kStepError_mm && step.chord_mm <= kLongestChord_mm;
  }

  // The first h at which a pair that does not carry closes its gap; infinite if none does.
  double first_touch(const Flow& flow, const Step& step, std::vector<bool>& near_edge,
                     std::vector<bool>& near_corner) const {
    const Configuration &q = step.start, &end = step.end;
    Box swept;
    swept.include(q.position());
    swept.include(end.position());
    const double room = space_.part.reach_mm + 0.25 * (end.position() - q.position()).norm() + 1e-3;
    swept.min.array() -= room;
    swept.max.array() += room;
    const auto meets = [&](const Box& box) {
      return box.min.x() <= swept.max.x() && swept.min.x() <= box.max.x() && box.min.y() <= swept.max.y() &&
             swept.min.y() <= box.max.y();
    };
    for (std::size_t i = 0; i < near_edge.size(); ++i) near_edge[i] = meets(space_.edge_boxes[i]);
    for (std::size_t i = 0; i < near_corner.size(); ++i) near_corner[i] = meets(space_.corner_boxes[i]);
    const double c0 = std::cos(q.theta_rad), s0 = std::sin(q.theta_rad);
    const double c1 = std::cos(end.theta_rad), s1 = std::sin(end.theta_rad);
    double first = kInfinity;
    for (std::size_t i = 0; i < space_.pairs.size(); ++i) {
      const ContactPair& pair = space_.pairs[i];
      if (!(pair.kind == ContactKind::CornerOnEdge ? near_edge[pair.fixed] : near_corner[pair.fixed])) continue;
      if (carries(flow, pair)) continue;
      const ContactState a = contact_state(space_.part, space_.obstacles, pair, q.position(), c0, s0);
      const ContactState b = contact_state(space_.part, space_.obstacles, pair, end.position(), c1, s1);
      const Piece piece{0,
                        step.h,
                        a.gap_mm,
                        separation_speed(point_of(a), step.rate),
                        b.gap_mm,
                        separation_speed(point_of(b), step.rate_end),
                        2 * step.chord_mm,
                        q,
                        end};
      const double floor = (std::abs(a.gap_mm) <= kContact_mm ? std::min(0.0, a.gap_mm) : 0) - kOverlap_mm;
      first = std::min(first, crossing(flow, i, piece, floor, 0));
    }
    return first;
  }

  struct Piece {
    double from, to, gap, rate, gap_end, rate_end;
    double chord_mm;  // bound of the gap's distance from its cubic in the middle
    Configuration start, end;
  };
  static constexpr double kPathOverChord = 1.5;  // paths that bend one way, by less than a right angle: below sqrt 2
  static constexpr double kSharpTurn = 0.2;      // rad: the direction from a pin's centre to a corner, on one piece

  // Whether the contact would lie beyond the same end of its edge all the while: it moves along it by no more than its
  // point moves.
  bool out_of_reach(std::size_t index, const Piece& p) const {
    const ContactPair& pair = space_.pairs[index];
    if (pair.kind == ContactKind::CornerOnCorner) return false;
    ContactState a, b;
    gap_at(index, p.start, &a);
    gap_at(index, p.end, &b);
    const double arm = std::max(a.lever.norm(), b.lever.norm());
    const double moves = kPathOverChord * chord(p.start, p.end, arm) + p.chord_mm;
    const double sum = a.along_mm + b.along_mm;
    return (sum + moves) / 2 < -kContact_mm || (sum - moves) / 2 > a.extent_mm + kContact_mm;
  }

  // Where the gap falls through the floor on this piece of the flow, with the features in reach of each other.
  double crossing(const Flow& flow, std::size_t index, const Piece& p, double floor, int depth) const {
    // The distance to a round corner's centre is no cubic unless the corner turns little about it; but it changes by no
    // more than the corner moves.
    bool divide = false;
    if (const ContactPair& pair = space_.pairs[index]; pair.kind == ContactKind::CornerOnCorner) {
      const double moves = kPathOverChord * chord(p.start, p.end, space_.part.corners[pair.moving].at.norm());
      if ((p.gap + p.gap_end - moves) / 2 - p.chord_mm >= floor) return kInfinity;
      const double radius = space_.obstacles.corners[pair.fixed].radius_mm;
      divide = moves > kSharpTurn * (radius + std::min(p.gap, p.gap_end)) && depth <= 40;
    }
    // The cubic's Bernstein coefficients of degree 4 bound it; what it misses the flow by, with its rate, is nothing at
    // the ends, so about a multiple of t^2 (1 - t)^2: the middle coefficient alone feels it, by 16 / 6.
    const double third = (p.to - p.from) / 3;
    const double b1 = p.gap + third * p.rate, b2 = p.gap_end - third * p.rate_end;
    const double c1 = (p.gap + 3 * b1) / 4, c2 = (b1 + b2) / 2, c3 = (3 * b2 + p.gap_end) / 4;
    const double off = 16.0 / 6 * p.chord_mm;
    if (!divide && std::min({p.gap, c1, c2 - off, c3, p.gap_end}) >= floor) return kInfinity;
    if (!divide && std::max({p.gap, c1, c2 + off, c3, p.gap_end}) < floor) return kInfinity;
    if (out_of_reach(index, p)) return kInfinity;
    // The cubic's slope is bounded by its coefficients' differences; what it misses has slopes of about 3 chords at
    // most.
    const double rises = std::max({b1 - p.gap, b2 - b1, p.gap_end - b2});
    const bool falls = !divide && (rises <= -1.1 * p.chord_mm || (rises <= kFlat_mm && p.chord_mm <= kChordError_mm));
    if (falls && p.gap < floor) return kInfinity;  // below already, and out of reach
    if (falls) {
      const double target = p.gap > kContact_mm ? 0 : floor;
      if (p.gap_end >= target) return closes(flow, index, flow.at(p.to)) ? p.to : kInfinity;
      const auto gap_and_rate = [&](double h) {
        const Configuration q = flow.at(h);
        ContactState state;
        const double gap = gap_at(index, q, &state);
        return std::pair{gap - target, separation_speed(point_of(state), flow.tangent(q))};
      };
      const double at = steep_root(gap_and_rate, p.from, p.to, p.gap - target, p.gap_end - target);
      return closes(flow, index, flow.at(at)) ? at : kInfinity;
    }
    if (depth > 40) return p.gap_end < floor && closes(flow, index, flow.at(p.to)) ? p.to : kInfinity;
    const double middle = (p.from + p.to) / 2;
    const Configuration q = flow.at(middle);
    ContactState state;
    gap_at(index, q, &state);
    const double rate = separation_speed(point_of(state), flow.tangent(q));
    const double found =
        crossing(flow, index, {p.from, middle, p.gap, p.rate, state.gap_mm, rate, p.chord_mm / 16, p.start, q}, floor,
                 depth + 1);
    if (found < kInfinity) return found;
    return crossing(flow, index, {middle, p.to, state.gap_mm, rate, p.gap_end, p.rate_end, p.chord_mm / 16, q, p.end},
                    floor, depth + 1);
  }

  Leg leg_of(const Flow& flow, const Configuration& q, const std::string& event) const {
    Leg leg;
    leg.start = q;
    leg.motion = flow.kind();
    leg.event = event;
    const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
    for (std::size_t i = 0; i < flow.pairs().size(); ++i) {
      const ContactState state = contact_state(space_.part, space_.obstacles, flow.pairs()[i], q.position(), c, s);
      leg.contacts.push_back(
          {flow.pairs()[i], q.position() + state.lever, state.normal, flow.modes()[i] == ContactMode::Stick});
    }
    return leg;
  }

  const ContactSpace& space_;
  const Drive& drive_;
  MotionLaw law_;
  const ProjectionOptions& options_;
};

}  // namespace

Projection project(const ContactSpace& space, const Drive& drive, const Configuration& start,
                   const ProjectionOptions& options) {
  return Follower(space, drive, options).run(start);
}

Projection project(const MovingShape& part, const Obstacles& obstacles, const Drive& drive, const Configuration& start,
                   const ProjectionOptions& options) {
  return project(ContactSpace(part, obstacles), drive, start, options);
}

}  // namespace formotion
