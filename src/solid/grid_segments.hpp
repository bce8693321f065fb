// Segments between points of an integer grid that bound regions, and their splitting wherever they meet.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <utility>

namespace formotion {

struct GridPoint {
  std::int32_t x = 0, y = 0;
  auto operator<=>(const GridPoint&) const = default;
};

// Coordinates up to this are floats, and leave room for exact predicates in 64 bits.
inline constexpr std::int32_t kLargestCoordinate = 1 << 24;

// A bit for each region.
using RegionBits = std::uint32_t;

// By their ends, the lesser one first: the regions whose boundary has the segment an odd number of times. A point is in
// a region iff a ray from it crosses an odd number of the region's segments.
using GridSegments = std::map<std::pair<GridPoint, GridPoint>, RegionBits>;

// Once more in the boundaries of these regions: twice is not at all.
void toggle(GridSegments& segments, GridPoint a, GridPoint b, RegionBits regions);

// Afterwards segments have at most ends in common. Where two cross between points of the grid, both are bent to the
// nearest one; that may make new crossings, so it is repeated (iterated snap rounding: Halperin, Packer 2002). Returns
// false if this did not settle.
bool split_where_they_meet(GridSegments& segments);

}  // namespace formotion
