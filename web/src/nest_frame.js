// Geometry of a nest: placements as [x, y, theta_deg] of the centre of mass, directions along and across gravity.

import { boxOf } from './geometry.js';
import { placedLoops } from './insertion_path.js';

const kRad = Math.PI / 180;

export const placementOf = (q) => [q.x_mm, q.y_mm, q.orientation_deg];

export function aspectNamed(nest, name) {
  return nest.aspects.find((aspect) => aspect.name === name) ?? nest.aspects[0];
}
export const partLoops = (nest, name) => {
  const { outline } = aspectNamed(nest, name);
  return [outline.outer, ...outline.holes];
};

// Of points, in mm: across is +x where gravity points along -y.
export function gravityFrame(deg) {
  const down = [Math.cos(deg * kRad), Math.sin(deg * kRad)];
  return {
    down,
    across: ([x, y]) => -down[1] * x + down[0] * y,
    height: ([x, y]) => -(down[0] * x + down[1] * y),
    point: (across, height) => [-down[1] * across - down[0] * height, down[0] * across - down[1] * height],
  };
}

// Angles that go on from one placement to the next by the shorter way.
export function unwound(placements) {
  let last = placements[0]?.[2] ?? 0;
  return placements.map(([x, y, deg]) => {
    last += ((((deg - last) % 360) + 540) % 360) - 180;
    return [x, y, last];
  });
}

// What is looked at: everywhere that the part is, and of the nest what is near.
export function frameAround(fixed, loops, placements) {
  const swept = boxOf(placements.flatMap((q) => placedLoops(loops, q)));
  const near = Math.max(1, 0.25 * Math.min(swept.xMax - swept.xMin, swept.yMax - swept.yMin));
  const nest = boxOf(fixed);
  return {
    xMin: Math.max(Math.min(swept.xMin, nest.xMin), swept.xMin - 3 * near) - 0.3 * near,
    xMax: Math.min(Math.max(swept.xMax, nest.xMax), swept.xMax + 3 * near) + 0.3 * near,
    yMin: Math.max(Math.min(swept.yMin, nest.yMin), swept.yMin - 2 * near) - 0.3 * near,
    yMax: swept.yMax + 0.6 * near,
  };
}

// One frame that holds several.
export function united(frames) {
  return {
    xMin: Math.min(...frames.map((f) => f.xMin)),
    xMax: Math.max(...frames.map((f) => f.xMax)),
    yMin: Math.min(...frames.map((f) => f.yMin)),
    yMax: Math.max(...frames.map((f) => f.yMax)),
  };
}

// Orientations that look the same, over a whole turn.
export const sameTurns = (deg, symmetry) =>
  Array.from({ length: symmetry }, (_, k) => (((deg + (360 * k) / symmetry) % 360) + 360) % 360);
