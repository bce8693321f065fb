// A pose's travel past the voids: which corners the support hull has at a position, and how far it is from tipping.
// Corners come from the program with the stretch of travel in which they live; they move linearly there. Numbers are
// rounded to 1e-4 mm, so lives are taken that much longer.

import { hull, hullMargin } from './geometry.js';

const kSlack_mm = 1e-4;
const kBeside_mm = 3e-4; // beyond the slack: the hull just before and just behind an event

function cornersAt(pose, travel, x) {
  const group = travel.groups.find((g) => g.from_mm <= x && x <= g.to_mm);
  if (!group) return pose.plain_hull_mm;
  const corners = [];
  for (const [from, to, x0, y0, x1, y1] of group.generators) {
    if (x < from - kSlack_mm || x > to + kSlack_mm) continue;
    if (x1 === undefined) {
      corners.push([x0, y0]);
    } else {
      const t = Math.max(0, Math.min(1, (x - from) / (to - from)));
      corners.push([x0 + t * (x1 - x0), y0 + t * (y1 - y0)]);
    }
  }
  return corners;
}

// Support with the centre of mass at x: the least of just before, at and just behind it, since the margin jumps where
// a corner comes or goes. hull: corners, x from the centre of mass, y from the wall; margin: null without any support.
export function supportAt(pose, travel, x) {
  if (travel.held_mm.some(([from, to]) => from <= x && x <= to)) return { held: true, hull: [], margin: null };
  let worst = null;
  for (const at of [x, x - kBeside_mm, x + kBeside_mm]) {
    const corners = hull(cornersAt(pose, travel, at));
    const margin = hullMargin(corners, [0, pose.supported_y_mm]);
    if (margin === null) return { held: false, hull: [], margin: null };
    if (!worst || margin < worst.margin) worst = { held: false, hull: corners, margin };
  }
  return worst;
}

// Margins over the travel from..to: at even steps, and on both sides of every event.
export function marginCurve(pose, travel, from, to, steps = 400) {
  const xs = new Set();
  for (let i = 0; i <= steps; ++i) xs.add(from + ((to - from) * i) / steps);
  for (const group of travel.groups) {
    for (const [xIn, xOut] of group.generators) {
      for (const x of [xIn - 5e-4, xIn + 5e-4, xOut - 5e-4, xOut + 5e-4]) {
        if (x > from && x < to) xs.add(x);
      }
    }
  }
  return [...xs]
    .sort((a, b) => a - b)
    .map((x) => ({ x, ...supportAt(pose, travel, x) }))
    .map(({ x, margin, held }) => ({ x, margin, held }));
}

// Where the centre of mass goes: from wholly before the first void or blade to wholly behind the last.
export function travelRange(pose, track) {
  const xs = track.flatMap((f) => [f.start_mm, f.end_mm, ...f.voids.flatMap((v) => v.outer_mm.map((p) => p[0]))]);
  const first = xs.length ? Math.min(...xs) : 0;
  const last = xs.length ? Math.max(...xs) : 0;
  return [first - pose.x_max_mm - 2, last - pose.x_min_mm + 2];
}
