#include "analysis/motion/projection.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <limits>

#include "analysis/motion/first_touch.hpp"
#include "analysis/motion/flow.hpp"

namespace formotion {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kForever_mm = 9e3;     // translations longer than this meet nothing more
constexpr double kReserve = 2e-9;       // modes hold until their reserve is below minus this
constexpr double kStepError_mm = 1e-9;  // of integration
constexpr double kSamePath_mm = 1e-9;   // between places where guided translations end
constexpr double kSameWay = 1e-7;       // between directions of motion, of unit speed
constexpr double kSlow = 1e-7;          // of the drive: forces that are out of balance by less leave the part at rest
constexpr double kShortest = 1e-12;     // steps

// The first root of a function with f(a) >= 0 > f(b).
template <class F>
double root(const F& f, double a, double b, double fa, double fb) {
  if (fa == 0) return a;
  std::uintmax_t most = 200;
  // Relative to the bracket: a slide goes far within angles of 1e-12 where its force passes by the centre of mass.
  const auto close = [width = b - a](double low, double high) { return high - low <= 1e-13 * width; };
  return boost::math::tools::toms748_solve(f, a, b, fa, fb, close, most).second;
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
        if (at < first && closes(space_, flow, i, flow.at(at))) {
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
      if (!closes(space_, flow, i, flow.at(at))) continue;
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
    for (int steps = 0; steps < 100000; ++steps) {
      const Configuration q = flow.start();
      double h = flow.longest_step();
      if (!(h > kShortest)) return Stop{q, "stalls"};
      const Twist rate = flow.tangent(q);
      FlowStep step{q, rate, q, rate, h, 0};
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
        const double touch = first_touch(space_, flow, step);
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

  // False where the flow cannot be followed so far.
  bool take(const Flow& flow, FlowStep& step, double h) const {
    double error = 0;
    const Configuration end = flow.at(h, error);
    return step_to(flow, step, h, end, space_.part.reach_mm) && error <= kStepError_mm;
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
