// Corners and edges by their numbers in the problem file, whatever the analysis made of them (turned around, cleaned of
// straight corners, united): found again by where they are.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/contact/contact_pair.hpp"

namespace formotion {

// The numbers of a contact's two features.
struct FeatureNames {
  std::optional<int> moving;  // none for corners that only the union of layers has
  std::pair<int, int> fixed;  // component and number
};

// {moving, fixed: [component, number]}; null for none.
nlohmann::ordered_json features_json(const FeatureNames& names);
const char* kind_word(ContactKind kind);  // "EV" or "VE"

class WrittenNames {
 public:
  // part: all its loops in the order that they are numbered in, in the frame of the moving shape. fixed: the loops of
  // every component, in the world; a pin is one loop of its centre.
  WrittenNames(std::vector<Loop> part, std::vector<std::vector<Loop>> fixed);

  // place: where the features touch with the part at q, in the world. It says which of several edges as written is
  // meant that run on straight.
  FeatureNames of(const MovingShape& part, const Obstacles& obstacles, const ContactPair& pair, const Configuration& q,
                  const Point& place) const;

 private:
  std::vector<Loop> part_;
  std::vector<std::vector<Loop>> fixed_;
};

}  // namespace formotion
