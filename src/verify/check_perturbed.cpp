#include <sstream>

#include "analysis/geometry/offset.hpp"
#include "io/feeder_json.hpp"
#include "verify/checks.hpp"
#include "verify/perturbation.hpp"

namespace formotion {
namespace {

using namespace feeder;

constexpr double kOfTolerance = 0.95;  // errors stay below the claimed tolerance by this
constexpr double kMarginsAgree_mm = 1e-6;
constexpr std::uint64_t kPurpose = 0x7065727475726264;  // of random numbers: perturbed tracks

std::string text(double mm) {
  std::ostringstream out;
  out.precision(6);
  out << mm << " mm";
  return out.str();
}

// All voids grown or shrunk: the worst that errors can do to what is supported.
Layout resized(const Layout& plain, double e) {
  Layout layout = plain;
  for (LaidFeature& feature : layout.features) {
    if (feature.voids.empty()) continue;
    set_voids(feature, offset(feature.voids, e));
  }
  std::erase_if(layout.features, [](const LaidFeature& feature) {
    return feature.voids.empty() && feature.obstacles.empty() && feature.wall_cuts.empty() && !feature.blade_mm;
  });
  return layout;
}

class Perturbed {
 public:
  Perturbed(const TestedDesign& design, Check& check)
      : design_(design), check_(check), most_mm_(kOfTolerance * design.claimed_mm) {}

  // The contract's condition itself, where voids alone are cut.
  void resize(bool grown) {
    const Layout layout = resized(design_.plain, grown ? most_mm_ : -most_mm_);
    CompareOptions options;
    options.delivered = grown;
    options.lost = !grown;
    const Comparison found = judge(layout, options, std::string("with all voids ") + (grown ? "grown" : "shrunk"));
    const double least = grown ? found.least_margin_mm : found.least_depth_mm;
    if (least < most_mm_ - kMarginsAgree_mm)
      fail(layout, std::string("with all voids ") + (grown ? "grown by " : "shrunk by ") + text(most_mm_) +
                       (grown ? " a delivered pose keeps " : " a lost pose is lost by ") + text(least));
  }

  void random(int number, RandomStream stream) {
    PerturbationOptions options;
    options.most_mm = most_mm_;
    options.turn_edges = !design_.belt;
    const std::optional<Layout> layout = perturbed(design_.plain, design_.environment(), options, stream);
    if (!layout) {
      ++check_.skipped;
      return;
    }
    const std::string which = "perturbation " + std::to_string(number);
    const Comparison found = judge(*layout, {}, which);
    // A moved void lies inside of the grown one.
    if (!design_.turns && found.least_margin_mm < most_mm_ - kMarginsAgree_mm)
      fail(*layout, which + ": a delivered pose keeps " + text(found.least_margin_mm) + ", less than errors of " +
                        text(most_mm_) + " may leave it");
  }

  void finish() {
    if (least_margin_mm_ < 1e300) {
      check_.worst = least_margin_mm_;
      check_.worst_of = "mm, the least margin of what is delivered, with errors up to " + text(most_mm_);
    }
    if (jammed_ > 0) check_.note = std::to_string(jammed_) + " times a lost pose jams in place of falling";
    if (failures_ > 1)
      check_.failure += " (" + std::to_string(failures_) + " of " + std::to_string(check_.count) + " fail)";
  }

 private:
  Comparison judge(const Layout& layout, const CompareOptions& options, const std::string& which) {
    ++check_.count;
    Comparison found = compare_ends(design_, layout, options);
    if (found.difference) fail(layout, which + " (up to " + text(most_mm_) + "): " + *found.difference);
    jammed_ += found.newly_jammed;
    least_margin_mm_ = std::min(least_margin_mm_, found.least_margin_mm);
    return found;
  }

  void fail(const Layout& layout, const std::string& what) {
    if (check_.holds) {
      if (const auto literal = literal_features(layout)) check_.design = {{"features", features_json(*literal)}};
    }
    check_.fail(what);
    ++failures_;
  }

  const TestedDesign& design_;
  Check& check_;
  double most_mm_, least_margin_mm_ = 1e300;
  int jammed_ = 0, failures_ = 0;
};

}  // namespace

Check check_perturbed(const TestedDesign& design, const VerifyOptions& options) {
  Check check{"perturbed"};
  check.unit = "perturbations";
  if (design.claimed_mm <= 0 || !design.layout.invalid.empty()) {
    check.note = "no tolerance is claimed";
    return check;
  }
  Perturbed tracks(design, check);
  if (!design.turns && options.perturbations > 0) {
    tracks.resize(true);
    tracks.resize(false);
  }
  for (int k = 0; k < options.perturbations; ++k) {
    const auto number = static_cast<std::uint64_t>(design.stored.number);
    tracks.random(k + 1, RandomStream(options.seed, kPurpose ^ number, static_cast<std::uint64_t>(k)));
  }
  tracks.finish();
  return check;
}

}  // namespace formotion
