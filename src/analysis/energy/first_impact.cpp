#include "analysis/energy/first_impact.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/contact/clearance.hpp"
#include "analysis/energy/open_heights.hpp"

namespace formotion {

double share_kept(const ContactPoint& contact, const Point& down, const ImpactLaw& law) {
  const double approach = -contact.normal.dot(down);
  if (!(approach > 0)) return 1;
  const double about_normal = cross(contact.lever, contact.normal) / law.gyration_mm;
  const double about_tangent = cross(contact.lever, turned_left(contact.normal)) / law.gyration_mm;
  const double yielding = 1 + about_normal * about_normal + law.friction * std::abs(about_normal * about_tangent);
  return 1 - (1 - law.restitution * law.restitution) * approach * approach / yielding;
}

std::optional<Landing> landing(const ContactSpace& space, const Gravity& gravity, const Configuration& from,
                               const ImpactLaw& law) {
  constexpr double kTouches_mm = 1e-6, kSagitta_mm = 1e-3;
  const OpenHeights heights(space, gravity, kSagitta_mm);
  Place place = heights.place_of(from);
  const double from_mm = place.height_mm;
  const auto free = heights.free(place.across_mm, place.turn_rad);
  const auto around = std::find_if(free.begin(), free.end(), [&](const RealRange& range) {
    return range.low <= from_mm + kTouches_mm && from_mm <= range.high + kTouches_mm;
  });
  if (around == free.end() || !std::isfinite(around->low)) return std::nullopt;
  place.height_mm = std::min(around->low, from_mm);
  Landing landed{heights.configuration_of(place), from_mm};
  double kept = 0;  // of contacts that meet at once the first may be any
  bool any = false;
  for (const Contact& contact : contacts_at(space.part, space.obstacles, landed.at, kTouches_mm)) {
    if (!(contact.state.normal.dot(gravity.down) < 0)) continue;
    any = true;
    kept = std::max(kept, share_kept({contact.state.normal, contact.state.lever}, gravity.down, law));
  }
  if (!any) return landed;
  landed.energy_mm = place.height_mm + kept * (from_mm - place.height_mm);
  // Just over the contact, so that ways on are not those of a part that is pressed on it.
  place.height_mm = std::min(place.height_mm + kTouches_mm, from_mm);
  landed.at = heights.configuration_of(place);
  landed.energy_mm = std::max(landed.energy_mm, place.height_mm);
  return landed;
}

}  // namespace formotion
