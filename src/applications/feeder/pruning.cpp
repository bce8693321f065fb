#include "applications/feeder/pruning.hpp"

#include <algorithm>
#include <cmath>

#include "applications/feeder/judge.hpp"
#include "applications/feeder/pose_travel.hpp"

namespace formotion::feeder {
namespace {

constexpr double kSameShape_mm = 1e-6;  // what differs by less is decided by nothing (kMarginal_mm)

bool same_points(const Point& a, const Point& b) { return (a - b).cwiseAbs().maxCoeff() <= kSameShape_mm; }

// The same corners in the same order, wherever they begin.
bool same_loop(const Loop& a, const Loop& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t shift = 0; shift < b.size(); ++shift) {
    std::size_t i = 0;
    while (i < a.size() && same_points(a[i], b[(i + shift) % b.size()])) ++i;
    if (i == a.size()) return true;
  }
  return false;
}

bool same_area(const Polygon& a, const Polygon& b) {
  return same_loop(a.outer, b.outer) && a.holes.size() == b.holes.size() &&
         std::all_of(a.holes.begin(), a.holes.end(), [&](const Loop& hole) {
           return std::any_of(b.holes.begin(), b.holes.end(),
                              [&](const Loop& other) { return same_loop(hole, other); });
         });
}

Loop mirrored(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  for (Point& p : loop) p.x() = -p.x();
  return loop;
}

Polygon mirrored(Polygon polygon) {
  polygon.outer = mirrored(std::move(polygon.outer));
  for (Loop& hole : polygon.holes) hole = mirrored(std::move(hole));
  return polygon;
}

bool same_supported_point(const PoseModel& a, const PoseModel& b) {
  return std::abs(a.travelling.supported_y_mm - b.travelling.supported_y_mm) <= kSameShape_mm;
}
bool same_footprint(const PoseModel& a, const PoseModel& b) {
  return same_supported_point(a, b) && same_area(a.footprint, b.footprint);
}
bool mirror_images(const PoseModel& a, const PoseModel& b) {
  return same_supported_point(a, b) && same_area(mirrored(a.footprint), b.footprint);
}

bool is_void(const std::string& type) {
  static const std::vector<std::string> kVoids{"balcony", "gap", "canyon", "slot", "cutout", "dish-out", "scallop"};
  return std::find(kVoids.begin(), kVoids.end(), type) != kVoids.end();
}
bool is_passive(const std::string& type) { return is_void(type) || type == "wiper" || type == "hold-down"; }
// Under x -> -x about its middle.
bool is_symmetric_void(const std::string& type) { return is_void(type) && type != "cutout"; }

std::string joined(const std::vector<std::string>& words, const std::string& between, const std::string& before_last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? before_last : between) + words[i];
  return text;
}

}  // namespace

Pruning::Pruning(const FeederSpec& spec, std::vector<GrammarKind> kinds) : spec_(spec), kinds_(std::move(kinds)) {
  if (!is_literal(spec.part)) return;
  part_ = part_model(spec.part, spec.environment, {});
  const std::vector<PoseModel>& poses = part_->poses;
  const auto stands = [&](std::size_t i) { return poses[i].travelling.plain_margin_mm >= kLost_mm; };
  const auto named = [&](std::size_t i) {
    return spec.goal.one_pose || named_by_goal(spec.goal, *part_, poses[i].stable);
  };
  for (std::size_t g = 0; g < poses.size(); ++g) {
    if (!stands(g) || !named(g)) continue;
    std::vector<int> alike, others;
    for (std::size_t j = 0; j < poses.size(); ++j) {
      const bool wrong = j != g && stands(j) && (spec.goal.one_pose || !named(j));
      if (!wrong) continue;
      const bool is_twin = same_footprint(poses[g], poses[j]) || mirror_images(poses[g], poses[j]);
      (is_twin ? alike : others).push_back(static_cast<int>(j));
    }
    alike.insert(alike.end(), others.begin(), others.end());
    goals_.push_back(static_cast<int>(g));
    wrong_.push_back(std::move(alike));
  }
  for (const GrammarKind& kind : kinds_) {
    if (kind.type != "balcony" && kind.type != "gap") continue;
    std::vector<double>& of_kind = thresholds_[kind.type];
    for (std::size_t i = 0; i < poses.size(); ++i)
      of_kind.push_back(stands(i) ? threshold(kind, static_cast<int>(i)) : 0);
  }
}

// The least width of a balcony, or the greatest length of a gap, that lets the pose through. Both are monotone: a wider
// balcony and a shorter gap have voids that lie within those of the other, but for a move along the track.
double Pruning::threshold(const GrammarKind& kind, int pose) const {
  const TravellingPart& part = part_->poses[static_cast<std::size_t>(pose)].travelling;
  const bool is_gap = kind.type == "gap";
  const auto passes = [&](double value) {
    FeatureSpec feature;
    if (is_gap) {
      feature.shape = Gap{{value, {}}};
    } else {
      feature.shape = Balcony{{value, {}}, {long_mm(part_->longest_mm), {}}};
    }
    const Layout layout = lay_out({feature}, spec_.environment, spec_.manufacture, part_->diameter_mm, {});
    for (const VoidGroup& group : grouped(layout, part_->longest_mm)) {
      const VoidOutline outline = VoidOutline::of(group.loops);
      const LeastMargin least = least_margin(Travel{part, outline, {}});
      if (least.margin_mm < kLost_mm || least.unsupported) return false;
    }
    return true;
  };
  double pass = is_gap ? 0 : spec_.environment.track_width_mm, lost = is_gap ? part_->longest_mm + 1 : 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (pass + lost);
    (passes(middle) ? pass : lost) = middle;
  }
  return pass;
}

Law Pruning::law(const GrammarKind& kind, int passes, int other) const {
  const PoseModel& goal = part_->poses[static_cast<std::size_t>(passes)];
  const PoseModel& pose = part_->poses[static_cast<std::size_t>(other)];
  if (kind.type == "hold-down") return kRailRejectsNone;
  if (kind.type == "wiper") return pose.height_mm <= goal.height_mm ? kNoTaller : kNoLaw;
  if (!is_void(kind.type)) return kNoLaw;
  if (same_footprint(goal, pose)) return kSameFootprint;
  if (is_symmetric_void(kind.type) && mirror_images(goal, pose)) return kMirrorImage;
  const auto found = thresholds_.find(kind.type);
  if (found == thresholds_.end()) return kNoLaw;
  const double of_goal = found->second[static_cast<std::size_t>(passes)];
  const double of_other = found->second[static_cast<std::size_t>(other)];
  if (kind.type == "balcony") return of_other <= of_goal + kMarginal_mm ? kBalconyWidth : kNoLaw;
  return of_other >= of_goal - kMarginal_mm ? kGapLength : kNoLaw;
}

std::optional<unsigned> Pruning::laws_against(unsigned set) const {
  const auto in_set = [&](std::size_t k) { return (set >> k & 1u) != 0; };
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    if (in_set(k) && !is_passive(kinds_[k].type)) return std::nullopt;
  }
  unsigned laws = 0;
  for (std::size_t g = 0; g < goals_.size(); ++g) {
    const auto laws_for = [&](int other) {
      unsigned all = 0;
      for (std::size_t k = 0; k < kinds_.size(); ++k) {
        if (!in_set(k)) continue;
        const Law one = law(kinds_[k], goals_[g], other);
        if (one == kNoLaw) return std::optional<unsigned>();
        all |= one;
      }
      return std::optional<unsigned>(all);
    };
    std::optional<unsigned> found;
    for (std::size_t j = 0; j < wrong_[g].size() && !found; ++j) found = laws_for(wrong_[g][j]);
    if (!found) return std::nullopt;
    laws |= *found;
  }
  return laws;
}

bool Pruning::prunes(const std::vector<int>& sequence) {
  if (!part_) return false;
  const double spacing = spec_.environment.spacing_mm.value_or(part_->diameter_mm);
  if (sequence.size() > 1 && spacing < part_->longest_mm) return false;
  unsigned set = 0;
  for (const int kind : sequence) set |= 1u << kind;
  const auto known = known_.find(set);
  const std::optional<unsigned> laws = known != known_.end() ? known->second : laws_against(set);
  if (known == known_.end()) known_[set] = laws;
  if (!laws) return false;
  entries_[*laws].set |= set;
  ++entries_[*laws].count;
  return true;
}

std::vector<PrunedSequences> Pruning::found() const {
  static const std::vector<std::pair<Law, std::string>> kSentences{
      {kSameFootprint, "their footprints and supported points are the same, so every void treats them alike"},
      {kMirrorImage, "they are mirror images, which voids that are symmetric along the feed treat alike"},
      {kNoTaller, "a wiper rejects none that is no taller"},
      {kRailRejectsNone, "a hold-down rail rejects none"},
      {kBalconyWidth, "the wrong one needs no wider balcony"},
      {kGapLength, "the wrong one bears a gap as long"},
  };
  std::vector<PrunedSequences> all;
  for (const auto& [laws, entry] : entries_) {
    std::vector<std::string> types, sentences;
    for (std::size_t k = 0; k < kinds_.size(); ++k) {
      const std::string& type = kinds_[k].type;
      if ((entry.set >> k & 1u) != 0 && std::find(types.begin(), types.end(), type) == types.end())
        types.push_back(type);
    }
    for (const auto& [law, sentence] : kSentences) {
      if ((laws & law) != 0) sentences.push_back(sentence);
    }
    const std::string reason = goals_.empty()
                                   ? "the plain track itself does not hold a pose that the goal may be"
                                   : "for every pose that may be the goal a wrong one passes wherever it passes: " +
                                         joined(sentences, "; ", "; and ");
    all.push_back({"only " + joined(types, ", ", " and "), reason, entry.count});
  }
  return all;
}

std::string helpful_features(const FeederSpec& spec, const GrammarSpec& grammar) {
  std::vector<std::string> helpful;
  for (const std::string& name : catalogue_names()) {
    std::vector<std::string> catalogue = grammar.features;
    catalogue.push_back(name);
    const std::vector<GrammarKind> kinds = kinds_of(catalogue);
    Pruning pruning(spec, kinds);
    const int added = static_cast<int>(kinds.size()) - 1;
    bool helps = !pruning.prunes({added});
    for (int other = 0; grammar.max_features > 1 && other < added && !helps; ++other)
      helps = !pruning.prunes({added, other});
    // "cutout" says the same as all that follow it.
    if (helps && (helpful.empty() || name.rfind(helpful.back(), 0) != 0)) helpful.push_back(name);
  }
  return joined(helpful, ", ", " or ");
}

}  // namespace formotion::feeder
