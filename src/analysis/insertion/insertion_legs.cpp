// Legs and rest: how far the part goes on one way, the carrier's work meanwhile.
#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "analysis/insertion/inserter.hpp"
#include "analysis/motion/first_touch.hpp"

namespace formotion::inserting {
namespace {

constexpr double kShortest = 1e-10;  // steps, of the leg's length
constexpr double kWork = 1e-6;       // of work, to its share
constexpr int kHalvings = 12;        // of a step, for its work

template <class F>
double falling_root(const F& f, double a, double b, double fa, double fb) {
  if (fa <= 0) return a;
  std::uintmax_t most = 200;
  const auto close = [width = b - a](double low, double high) { return high - low <= 1e-13 * width; };
  return boost::math::tools::toms748_solve(f, a, b, fa, fb, close, most).second;
}

// Simpson's rule on halves until they agree with the whole. fa, fm, fb: at the ends and in the middle.
template <class F>
double integral(const F& f, double a, double b, double fa, double fm, double fb, int halvings) {
  const double m = (a + b) / 2, left = f((a + m) / 2), right = f((m + b) / 2);
  const double whole = (b - a) / 6 * (fa + 4 * fm + fb);
  const double halves = (b - a) / 12 * (fa + 4 * left + 2 * fm + 4 * right + fb);
  const double size = (b - a) * (std::abs(fa) + std::abs(fm) + std::abs(fb));
  if (halvings == 0 || std::abs(halves - whole) <= kWork * size) return halves;
  return integral(f, a, m, fa, left, fm, halvings - 1) + integral(f, m, b, fm, right, fb, halvings - 1);
}

// A leg seen from one of its places on.
struct ShiftedLeg final : GuidedPath {
  const CompliantLeg& leg;
  double by;
  ShiftedLeg(const CompliantLeg& of, double from) : leg(of), by(from) {}
  const std::vector<ContactPair>& pairs() const override { return leg.pairs(); }
  Configuration at(double h) const override { return leg.at(by + h); }
  Twist rate(double h, const Configuration& q) const override { return leg.rate(by + h, q); }
};

// Ends a step earlier.
void cut(const ShiftedLeg& path, FlowStep& step, double h, double reach_mm) {
  if (h == step.h) return;
  if (h > 0) {
    step_to(path, step, h, path.at(h), reach_mm);
    return;
  }
  step.h = 0;
  step.end = step.start;
  step.rate_end = step.rate;
}

}  // namespace

template <class At>
void Inserter::add_work(State& state, const CarrierLine& line, double from, double to, const At& at) const {
  Insertion& result = state.result;
  const auto force = [&](double h) {
    const Eigen::Vector3d load = spring_load(stiffness_, line.at(h), at(h));
    result.peak_axial_n = std::max(result.peak_axial_n, std::abs(axial(load)));
    result.peak_lateral_n = std::max(result.peak_lateral_n, std::abs(lateral(load)));
    return axial(load);
  };
  result.work_nmm += integral(force, from, to, force(from), force((from + to) / 2), force(to), kHalvings);
}

Went Inserter::slide(State& state, const CompliantLeg& leg, const Stretch& stretch) const {
  const auto& [stiffness, line, length, is_real] = stretch;
  const double reach = space_.part.reach_mm;
  state.is_stopped = false;
  mix(state.result.history, is_real ? 1 : 2);
  for (std::size_t i = 0; i < leg.pairs().size(); ++i) {
    const ContactPair& pair = leg.pairs()[i];
    mix(state.result.history, static_cast<std::uint64_t>(pair.kind) << 40 |
                                  static_cast<std::uint64_t>(pair.moving) << 20 |
                                  static_cast<std::uint64_t>(pair.fixed));
    mix(state.result.history, static_cast<std::uint64_t>(leg.modes()[i]));
  }
  note(state, supported(state, stretch, 0), is_real ? "moves" : "snaps", carried_by(leg, 0, state.q), !is_real);
  const int before = leg.solves();
  double from = 0, longest = length;
  const char* event = nullptr;
  const auto at = [&](double h) { return leg.at(h); };
  for (int steps = 0; steps < 20000 && from < length && !event; ++steps) {
    double h = std::min(longest, length - from);
    const ShiftedLeg shifted{leg, from};
    FlowStep step;
    step.start = shifted.at(0);
    step.rate = shifted.rate(0, step.start);
    while (!step_to(shifted, step, h, shifted.at(h), reach) && h > kShortest * length) h /= 2;
    if (!(h > kShortest * length)) {
      event = "stalls";
      break;
    }
    longest = 2 * h;
    double end = h;
    const auto left = [&](double t) { return leg.reserve(from + t) + kLegReserve; };
    double begun = 0;
    for (const double t : {h / 2, h}) {
      if (const double at_end = left(t); at_end < 0) {
        const double at_begun = left(begun);
        end = at_begun <= 0 ? begun : falling_root(left, begun, t, at_begun, at_end);
        event = "contact changes";
        break;
      }
      begun = t;
    }
    cut(shifted, step, end, reach);
    if (step.h > 0) {
      const double touch = first_touch(space_, shifted, step);
      if (touch < step.h || (touch == step.h && !event)) {
        event = "touches";
        cut(shifted, step, touch, reach);
      }
    }
    const auto ends_at = [&](const auto& missing, const char* what) {
      const double now = missing(0.0), then = missing(step.h);
      if (then > 0) return;
      event = what;
      cut(shifted, step, now <= 0 ? 0.0 : falling_root(missing, 0.0, step.h, now, then), reach);
    };
    ends_at([&](double t) { return -reached(leg.at(from + t)); }, kReaches);
    if (is_real && task_.approach.max_force_n) {
      ends_at(
          [&](double t) {
            return *task_.approach.max_force_n - axial(spring_load(stiffness, line.at(from + t), leg.at(from + t)));
          },
          kLimit);
    }
    if (is_real) add_work(state, line, from, from + step.h, at);
    from += step.h;
    state.q = leg.at(from);
    leg.restart(from);
    if (is_real) state.travel_mm += step.h;
    note(state, supported(state, stretch, from), event ? event : "", carried_by(leg, from, state.q), !is_real);
    if (!event && step.h <= 0) event = "stalls";
  }
  state.result.solves += leg.solves() - before;
  if (event == kReaches) {
    finish(state, InsertionOutcome::Assembled);
    return {Ride::Ended, from};
  }
  if (event == kLimit) {
    stop(state, "the force's limit is reached");
    return {Ride::Ended, from};
  }
  return {Ride::Arrived, from};
}

Went Inserter::rest(State& state, const Stretch& stretch) const {
  const CarrierLine& line = stretch.line;
  double far = stretch.length;
  bool by_force = false;
  if (task_.approach.max_force_n) {
    const double until = (*task_.approach.max_force_n - axial(spring_load(stiffness_, line.from, state.q))) /
                         axial(stiffness_.cwiseProduct(line.way));
    if (until < far) {
      far = std::max(0.0, until);
      by_force = true;
    }
  }
  auto carried = ways_.held(state.q, line.at(far));
  if (!carried) {
    double low = 0, high = far;
    for (int i = 0; i < 60 && high - low > 1e-12 * far; ++i) {
      const double middle = (low + high) / 2;
      if (auto found = ways_.held(state.q, line.at(middle))) {
        low = middle;
        carried = std::move(found);
      } else {
        high = middle;
      }
    }
    far = high;
    by_force = false;
  }
  // Another way on may begin while the part rests: it ends there.
  if (!has_left_rest(state)) {
    for (const double place : ways_.ways_off_rest(state.q, line, far)) {
      if (place < kLookAhead_mm) continue;
      const CarrierLine onwards{line.at(place), line.way};
      const auto found = ways_.continuous(state.q, onwards, std::min(kLookAhead_mm, (stretch.length - place) / 2),
                                          state.result.solves);
      if (std::none_of(found.begin(), found.end(), [](const Continuation& way) { return way.leg.has_value(); }))
        continue;
      far = place;
      by_force = false;
      carried = ways_.held(state.q, line.at(far));
      break;
    }
  }
  mix(state.result.history, 77);
  const std::vector<CarriedContact> contacts = carried ? *carried : state.contacts;
  add_work(state, line, 0, far, [&](double) { return state.q; });
  state.travel_mm += far;
  state.is_stopped = true;
  note(state, spring_load(stiffness_, line.at(far), state.q), "rests", contacts);
  if (by_force) {
    stop(state, "the force's limit is reached");
    return {Ride::Ended, far};
  }
  return {Ride::Arrived, far};
}

std::vector<CarriedContact> Inserter::carried_by(const CompliantLeg& leg, double h, const Configuration& q) const {
  std::vector<CarriedContact> contacts;
  const double c = std::cos(q.theta_rad), s = std::sin(q.theta_rad);
  const std::vector<ContactForce> forces = leg.forces(h);
  for (std::size_t i = 0; i < leg.pairs().size(); ++i) {
    const ContactState state = contact_state(space_.part, space_.obstacles, leg.pairs()[i], q.position(), c, s);
    contacts.push_back({leg.pairs()[i], q.position() + state.lever, state.normal, leg.modes()[i], forces[i]});
  }
  return contacts;
}

}  // namespace formotion::inserting
