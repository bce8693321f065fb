// Planar geometry that pictures need. Points are [x, y] in mm.

// Convex hull, counter-clockwise (Andrew 1979); fewer than three corners where the points are that few or collinear.
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const chain = [];
    for (const p of list) {
      while (chain.length > 1 && turn(chain[chain.length - 2], chain[chain.length - 1], p) <= 0) chain.pop();
      chain.push(p);
    }
    return chain;
  };
  if (sorted.length < 2) return sorted;
  const lower = half(sorted);
  const upper = half(sorted.reverse());
  return [...lower.slice(0, -1), ...upper.slice(0, -1)];
}

function turn(a, b, c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

function distanceToSegment(p, a, b) {
  const dx = b[0] - a[0];
  const dy = b[1] - a[1];
  const length2 = dx * dx + dy * dy;
  const t = length2 > 0 ? Math.max(0, Math.min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2)) : 0;
  return Math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy);
}

// Signed distance from p to the boundary of a hull: positive inside; null for no hull.
export function hullMargin(corners, p) {
  if (corners.length === 0) return null;
  if (corners.length === 1) return -Math.hypot(p[0] - corners[0][0], p[1] - corners[0][1]);
  let nearest = Infinity;
  let inside = corners.length > 2;
  corners.forEach((a, i) => {
    const b = corners[(i + 1) % corners.length];
    nearest = Math.min(nearest, distanceToSegment(p, a, b));
    if (turn(a, b, p) < 0) inside = false;
  });
  return inside ? nearest : -nearest;
}

export function boxOf(loops) {
  const box = { xMin: Infinity, xMax: -Infinity, yMin: Infinity, yMax: -Infinity };
  for (const loop of loops) {
    for (const [x, y] of loop) {
      box.xMin = Math.min(box.xMin, x);
      box.xMax = Math.max(box.xMax, x);
      box.yMin = Math.min(box.yMin, y);
      box.yMax = Math.max(box.yMax, y);
    }
  }
  return box;
}

export const loopsOf = (polygon) => [polygon.outer_mm, ...polygon.holes_mm];

// SVG path data of closed loops; to maps a point to the picture.
export function pathOf(loops, to) {
  const round = (v) => Math.round(v * 100) / 100;
  return loops
    .filter((loop) => loop.length > 1)
    .map((loop) => `M${loop.map((p) => to(p).map(round).join(',')).join('L')}Z`)
    .join('');
}

// The stretches of [from, to] outside of the given intervals.
export function complement(from, to, intervals) {
  const sorted = intervals.filter(([a, b]) => b > a).sort((a, b) => a[0] - b[0]);
  const rest = [];
  let at = from;
  for (const [a, b] of sorted) {
    if (a > at) rest.push([at, Math.min(a, to)]);
    at = Math.max(at, b);
    if (at >= to) return rest;
  }
  rest.push([at, to]);
  return rest;
}
