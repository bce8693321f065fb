// Which sequences of features cannot reach the goal whatever their numbers are: by laws alone, whose proofs are in
// docs/grammar.md.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "applications/feeder/grammar.hpp"
#include "applications/feeder/part_model.hpp"

namespace formotion::feeder {

// Why a kind of feature that lets one pose through cannot reject another one.
enum Law : unsigned {
  kNoLaw = 0,
  kSameFootprint = 1,
  kMirrorImage = 2,
  kNoTaller = 4,         // a wiper rejects what is taller
  kRailRejectsNone = 8,  // a hold-down rail that stands alone only stops poses
  kBalconyWidth = 16,    // the other pose needs no wider balcony
  kGapLength = 32,       // the other pose bears a gap as long
};

class Pruning {
 public:
  // Prunes nothing of a part with variables, and no sequence of several features that may act at the same time.
  Pruning(const FeederSpec& spec, std::vector<GrammarKind> kinds);

  // Whether the sequence (indices of kinds) cannot be feasible; counted for found().
  bool prunes(const std::vector<int>& sequence);
  // One entry for all sequences that the same laws prune.
  std::vector<PrunedSequences> found() const;

 private:
  Law law(const GrammarKind& kind, int passes, int other) const;
  double threshold(const GrammarKind& kind, int pose) const;
  std::optional<unsigned> laws_against(unsigned set) const;

  const FeederSpec& spec_;
  std::vector<GrammarKind> kinds_;
  std::optional<PartModel> part_;        // of a part without variables
  std::vector<int> goals_;               // poses that a feasible design may deliver
  std::vector<std::vector<int>> wrong_;  // of every goal: the poses that must then be lost, likely twins first
  std::map<std::string, std::vector<double>> thresholds_;  // of balconies and gaps, by pose
  std::map<unsigned, std::optional<unsigned>> known_;      // by set of kinds: the laws that prune it
  struct Entry {
    unsigned set = 0;  // kinds that occur
    std::int64_t count = 0;
  };
  std::map<unsigned, Entry> entries_;  // by laws
};

// Of a grammar that is pruned wholly: types that would not be, "cutout, fence or pin"; nothing if none helps.
std::string helpful_features(const FeederSpec& spec, const GrammarSpec& grammar);

}  // namespace formotion::feeder
