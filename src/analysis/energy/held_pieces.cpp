#include "analysis/energy/held_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/hold.hpp"
#include "analysis/energy/sign_changes.hpp"
#include "analysis/energy/two_contact_curves.hpp"
#include "analysis/motion/guided_path.hpp"

namespace formotion {
namespace {

constexpr double kSamePlace = 1e-11;  // of a curve's parameter: one cut
constexpr double kGap_mm = 1e-10;     // of a third contact: closed
constexpr double kFace = 1e-12;       // of a determinant of unit wrenches
constexpr double kNear_mm = 1e-6;     // slack of a third contact's place on its features
constexpr double kNear_rad = 1e-6;    // and of its orientations
constexpr std::size_t kMostSamples = 2000;

using Places = std::vector<double>;

Verdict best_of(const std::vector<TouchCluster>& clusters, std::size_t next, std::vector<ContactPoint>& chosen,
                const PushSet& push, double gyration_mm) {
  if (next == clusters.size()) return can_hold(chosen, push, gyration_mm);
  Verdict best = Verdict::Impossible;
  for (const Touch& touch : clusters[next]) {
    chosen.push_back(point_of(touch.state));
    best = std::max(best, best_of(clusters, next + 1, chosen, push, gyration_mm));
    chosen.pop_back();
    if (best == Verdict::Certain) break;
  }
  return best;
}

// One curve, cut.
class Cutter {
 public:
  Cutter(const ContactSpace& space, const PushSet& push, double grid_rad, std::vector<HeldPiece>& pieces)
      : space_(space), push_(push), grid_rad_(grid_rad), pieces_(pieces) {
    forces_ = {{std::cos(push.from_rad), std::sin(push.from_rad), 0}};
    if (push.to_rad > push.from_rad) forces_.push_back({std::cos(push.to_rad), std::sin(push.to_rad), 0});
    frictions_ = {push.friction_max};
    if (push.friction_min < push.friction_max) frictions_.push_back(push.friction_min);
  }

  void cut(const TwoContactCurve& curve) {
    curve_ = &curve;
    double from = curve.from, to = curve.to;
    // Two facets that are parallel at the end of their orientations meet nowhere there.
    const double inward = 1e-9 * (to - from);
    if (!std::isfinite(at(from).x_mm)) from += inward;
    if (!std::isfinite(at(to).x_mm)) to -= inward;
    if (!std::isfinite(at(from).x_mm) || !std::isfinite(at(to).x_mm)) return;
    if (stays_on_one_place(from, to)) return;
    const Places cuts = touch_cuts(from, to);
    std::vector<bool> free(cuts.size() - 1);
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) free[i] = is_free_at(0.5 * (cuts[i] + cuts[i + 1]));
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const bool before = i > 0 && free[i - 1], after = i + 1 < cuts.size() && free[i];
      const Configuration q = at(cuts[i]);
      const Verdict verdict = verdict_at(space_, push_, q);
      if (verdict != Verdict::Impossible && (before || after || is_free(space_.part, space_.obstacles, q)))
        pieces_.push_back({{q}, verdict, q});
      if (after) stretch(cuts[i], cuts[i + 1]);
    }
  }

 private:
  Configuration at(double place) const { return curve_->at(space_, place); }
  bool is_free_at(double place) const {
    const Configuration q = at(place);
    return std::isfinite(q.x_mm) && is_free(space_.part, space_.obstacles, q);
  }
  ContactState state(std::size_t index, const Configuration& q) const {
    return contact_state(space_.part, space_.obstacles, space_.pairs[index], q.position(), std::cos(q.theta_rad),
                         std::sin(q.theta_rad));
  }

  bool stays_on_one_place(double from, double to) const {
    const Configuration q = at(0.5 * (from + to));
    if (!std::isfinite(q.x_mm)) return true;
    const ContactState one = state(curve_->first, q), other = state(curve_->second, q);
    if ((one.lever - other.lever).norm() > kContact_mm) return false;
    const CornerMeeting meeting = meeting_of(space_, {space_.pairs[curve_->first], one});
    return meeting.is_one() && meeting == meeting_of(space_, {space_.pairs[curve_->second], other});
  }

  // Places from..to, no farther apart than the grid turns a part's corner; near poles many within little theta.
  Places sampled(double from, double to) const {
    const double step_mm = 2 * grid_rad_ * space_.part.reach_mm;
    const int least = curve_->straight ? 4 : std::max(4, static_cast<int>(std::ceil((to - from) / grid_rad_)));
    Places places{from};
    for (int i = 1; i <= least; ++i) {
      const double next = i == least ? to : from + (to - from) * i / least;
      if (curve_->straight) {
        places.push_back(next);
      } else {
        halve(places.back(), next, step_mm, 16, places);
      }
    }
    return places;
  }
  void halve(double from, double to, double step_mm, int depth, Places& places) const {
    const double apart = (at(to).position() - at(from).position()).norm();
    if (!(apart <= step_mm) && depth > 0 && places.size() < kMostSamples) {
      const double middle = 0.5 * (from + to);
      halve(from, middle, step_mm, depth - 1, places);
      halve(middle, to, step_mm, depth - 1, places);
    } else {
      places.push_back(to);
    }
  }

  static Places tidied(Places cuts, double from, double to) {
    std::sort(cuts.begin(), cuts.end());
    Places kept{from};
    for (const double cut : cuts) {
      if (cut > kept.back() + kSamePlace && cut < to - kSamePlace) kept.push_back(cut);
    }
    kept.push_back(to);
    return kept;
  }

  // Where a third contact begins or ends.
  Places touch_cuts(double from, double to) const {
    const Places places = sampled(from, to);
    std::vector<Configuration> qs;
    for (const double place : places) qs.push_back(at(place));
    const double theta_from = curve_->straight ? curve_->theta_rad : from;
    const double theta_to = curve_->straight ? curve_->theta_rad : to;
    Places cuts, roots;
    std::vector<double> gaps(places.size());
    for (std::size_t k = 0; k < space_.pairs.size(); ++k) {
      if (k == curve_->first || k == curve_->second) continue;
      if (!has_orientations(space_.orientations[k], theta_from, theta_to)) continue;
      if (!in_reach(space_, k, curve_->first) || !in_reach(space_, k, curve_->second)) continue;
      double largest = 0;
      for (std::size_t i = 0; i < qs.size(); ++i) {
        gaps[i] = state(k, qs[i]).gap_mm;
        largest = std::max(largest, std::abs(gaps[i]));
      }
      roots.clear();
      if (largest <= kContact_mm) {  // along all of the curve: where its features end
        add_ends(k, places, qs, roots);
      } else {
        add_sign_changes(
            places, gaps, kGap_mm, [&](double place) { return state(k, at(place)).gap_mm; }, roots);
      }
      for (const double root : roots) {
        const Configuration q = at(root);
        const ContactState there = state(k, q);
        if (there.along_mm >= -kNear_mm && there.along_mm <= there.extent_mm + kNear_mm &&
            space_.orientations[k].contains(q.theta_rad, kNear_rad))
          cuts.push_back(root);
      }
    }
    return tidied(std::move(cuts), from, to);
  }
  void add_ends(std::size_t k, const Places& places, const std::vector<Configuration>& qs, Places& roots) const {
    std::vector<double> values(places.size());
    for (const bool at_end : {false, true}) {
      const auto beyond = [&](const ContactState& s) { return at_end ? s.along_mm - s.extent_mm : s.along_mm; };
      for (std::size_t i = 0; i < qs.size(); ++i) values[i] = beyond(state(k, qs[i]));
      add_sign_changes(
          places, values, kGap_mm, [&](double place) { return beyond(state(k, at(place))); }, roots);
    }
  }

  // A free stretch on which the same features touch.
  void stretch(double from, double to) {
    const double middle = 0.5 * (from + to);
    const std::vector<TouchCluster> clusters = touches_at(space_, at(middle));
    if (clusters.size() < 2) return;
    touching_.clear();
    for (const TouchCluster& cluster : clusters) {
      for (const Touch& touch : cluster) touching_.push_back(space_.index_of(touch.pair));
    }
    const Places cuts = face_cuts(from, to);
    Verdict last = Verdict::Impossible;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const Configuration q = at(0.5 * (cuts[i] + cuts[i + 1]));
      const Verdict verdict = verdict_at(space_, push_, q);
      if (verdict != Verdict::Impossible) {
        HeldPiece piece{{}, verdict, q};
        for (const double place : sampled(cuts[i], cuts[i + 1])) piece.samples.push_back(at(place));
        pieces_.push_back(std::move(piece));
      }
      // A single place: without friction, and where cones only touch.
      if (i > 0) {
        const Configuration between = at(cuts[i]);
        const Verdict here = verdict_at(space_, push_, between);
        if (here > std::max(last, verdict)) pieces_.push_back({{between}, here, between});
      }
      last = verdict;
    }
  }

  // What verdicts can change by: the moment of an edge (c is a), the place of a force against the face between two, or
  // that of a third edge, where the cone becomes all of space (a wedge).
  struct Face {
    std::size_t a = 0, b = 0, c = 0;
    const Eigen::Vector3d* force{};
  };
  std::vector<Eigen::Vector3d> edges_at(const Configuration& q, double friction) const {
    std::vector<ContactPoint> contacts;
    for (const std::size_t index : touching_) contacts.push_back(point_of(state(index, q)));
    std::vector<Eigen::Vector3d> edges = friction_edges(contacts, friction, space_.part.gyration_mm);
    for (Eigen::Vector3d& edge : edges) edge.normalize();
    return edges;
  }
  static double value_of(const Face& face, const std::vector<Eigen::Vector3d>& edges) {
    if (face.a == face.b) return edges[face.a].z();
    return edges[face.a].cross(edges[face.b]).dot(face.force ? *face.force : edges[face.c]);
  }
  Places face_cuts(double from, double to) const {
    const Places places = sampled(from, to);
    std::vector<double> values(places.size());
    std::vector<std::vector<Eigen::Vector3d>> edges(places.size());
    Places cuts;
    for (const double friction : frictions_) {
      for (std::size_t i = 0; i < places.size(); ++i) edges[i] = edges_at(at(places[i]), friction);
      std::vector<Face> faces;
      for (std::size_t a = 0; a < edges.front().size(); ++a) {
        faces.push_back({a, a, a, nullptr});
        for (std::size_t b = a + 1; b < edges.front().size(); ++b) {
          for (const Eigen::Vector3d& force : forces_) faces.push_back({a, b, b, &force});
          for (std::size_t c = b + 1; c < edges.front().size(); ++c) faces.push_back({a, b, c, nullptr});
        }
      }
      for (const Face& face : faces) {
        for (std::size_t i = 0; i < places.size(); ++i) values[i] = value_of(face, edges[i]);
        const auto value = [&](double place) { return value_of(face, edges_at(at(place), friction)); };
        add_sign_changes(places, values, kFace, value, cuts);
      }
    }
    return tidied(std::move(cuts), from, to);
  }

  const ContactSpace& space_;
  const PushSet& push_;
  double grid_rad_;
  std::vector<HeldPiece>& pieces_;
  std::vector<Eigen::Vector3d> forces_;
  std::vector<double> frictions_;
  const TwoContactCurve* curve_ = nullptr;
  std::vector<std::size_t> touching_;
};

}  // namespace

Verdict verdict_at(const ContactSpace& space, const PushSet& push, const Configuration& q) {
  const std::vector<TouchCluster> clusters = touches_at(space, q);
  if (clusters.size() < 2) return Verdict::Impossible;
  std::vector<ContactPoint> chosen;
  return best_of(clusters, 0, chosen, push, space.part.gyration_mm);
}

std::vector<HeldPiece> held_pieces(const ContactSpace& space, const PushSet& push, double grid_rad) {
  std::vector<HeldPiece> pieces;
  Cutter cutter(space, push, grid_rad, pieces);
  for (const TwoContactCurve& curve : two_contact_curves(space, grid_rad)) cutter.cut(curve);
  return pieces;
}

}  // namespace formotion
