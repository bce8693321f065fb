// A path of a part that turns: placements between its points, and its contacts on the way. Lengths in mm, angles in
// degrees; a placement is [x, y, theta] of the centre of mass.

const kRad = Math.PI / 180;
const kOnPin_mm = 0.02;

export const turned = (deg) => ((deg % 360) + 360) % 360;

export function placed([u, v], [x, y, deg]) {
  const [c, s] = [Math.cos(deg * kRad), Math.sin(deg * kRad)];
  return [x + c * u - s * v, y + s * u + c * v];
}

// The farthest point of an outline from the centre of mass.
export const reachOf = (outline) => Math.max(...outline.map(([x, y]) => Math.hypot(x, y)), 1);

// An obstacle's, a pin's in forty steps.
export function outlineOf(obstacle) {
  if (obstacle.outline_mm) return obstacle.outline_mm;
  const { centre_mm: c, radius_mm: r } = obstacle;
  return Array.from({ length: 40 }, (_, i) => {
    const phi = (i * Math.PI) / 20;
    return [c[0] + r * Math.cos(phi), c[1] + r * Math.sin(phi)];
  });
}

// Travel is measured in mm, a turn as the way of a point at half of the part's reach.
export function measured(path, reach) {
  const { points } = path;
  const at = [0];
  for (let i = 1; i < points.length; ++i) {
    const [a, b] = [points[i - 1], points[i]];
    at.push(at[i - 1] + Math.hypot(b[0] - a[0], b[1] - a[1], (b[2] - a[2]) * kRad * 0.5 * reach));
  }
  const last = points.length - 1;
  const starts = path.legs.map((leg) => at[Math.min(leg.from, last)]);
  return {
    length: at[last],
    starts,
    along: at,
    placement(s) {
      let [low, high] = [0, last];
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (at[middle] <= s) low = middle;
        else high = middle;
      }
      const t = high > low && at[high] > at[low] ? Math.max(0, Math.min(1, (s - at[low]) / (at[high] - at[low]))) : 0;
      return points[low].map((v, k) => v + t * (points[high][k] - v));
    },
    legAt(s) {
      let leg = 0;
      while (leg + 1 < starts.length && starts[leg + 1] <= s + 1e-9) ++leg;
      return leg;
    },
  };
}

// A leg's contacts, given at its start, at a later placement of it: corners of the part go with the part, edges of it
// turn about what they touch.
export function carried(contacts, begin, now, obstacles) {
  const pins = obstacles.filter((o) => o.radius_mm > 0);
  const turn = now[2] - begin[2];
  return contacts.map(({ kind, point_mm: point, normal, sticks }) => {
    const pin = pins.find(
      ({ centre_mm: c, radius_mm: r }) => Math.abs(Math.hypot(point[0] - c[0], point[1] - c[1]) - r) < kOnPin_mm,
    );
    if (kind === 'EV') {
      const to = placed(normal, [0, 0, turn]);
      const at = pin ? pin.centre_mm.map((c, k) => c + pin.radius_mm * to[k]) : point;
      return { point: at, normal: to, sticks };
    }
    const [x, y] = placed([point[0] - begin[0], point[1] - begin[1]], [0, 0, turn]);
    const at = [now[0] + x, now[1] + y];
    if (!pin) return { point: at, normal, sticks };
    const away = [at[0] - pin.centre_mm[0], at[1] - pin.centre_mm[1]];
    const size = Math.hypot(...away) || 1;
    return { point: at, normal: away.map((v) => v / size), sticks };
  });
}

function nearestOn(a, b, p) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const size2 = dx * dx + dy * dy || 1;
  const t = Math.max(0, Math.min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / size2));
  const at = [a[0] + t * dx, a[1] + t * dy];
  return { at, distance: Math.hypot(p[0] - at[0], p[1] - at[1]) };
}

const edges = (loop) => loop.map((a, i) => [a, loop[(i + 1) % loop.length]]);

// Where a part at a placement on a facet touches what the facet is of: the nearest of such features. component: 0 the
// wall, then the obstacles. Placements between slices are off by a little, so that nothing is looked up by number.
export function touching({ kind, fixed }, outlines, placement, turning) {
  const loops = outlines.map((loop) => loop.map((p) => placed(p, placement)));
  const obstacle = turning.obstacles[fixed[0] - 1];
  const candidates = [];
  const add = (edge, corner, radius) => {
    const { at, distance } = nearestOn(...edge, corner);
    candidates.push({ off: Math.abs(distance - radius), point: kind === 'EV' ? corner : at, edge, corner, at, radius });
  };
  if (kind === 'EV') {
    const corners = obstacle?.outline_mm ?? (obstacle ? [obstacle.centre_mm] : []);
    for (const corner of corners) {
      for (const loop of loops) for (const edge of edges(loop)) add(edge, corner, obstacle.radius_mm ?? 0);
    }
  } else {
    const far = 1e4;
    const fixedEdges = !obstacle
      ? [
          [
            [-far, turning.wall_y],
            [far, turning.wall_y],
          ],
        ]
      : obstacle.outline_mm
        ? edges(obstacle.outline_mm)
        : [[obstacle.centre_mm, obstacle.centre_mm]];
    for (const edge of fixedEdges) {
      for (const loop of loops) for (const corner of loop) add(edge, corner, obstacle?.radius_mm ?? 0);
    }
  }
  if (!candidates.length) return null;
  const best = candidates.reduce((a, b) => (b.off < a.off ? b : a));
  const partEdge = kind === 'EV' ? best.edge : null;
  // Of a round corner its centre stands in for the corner: the part's side of the contact is the point then.
  const point = (kind === 'EV') === best.radius > 0 ? best.at : best.corner;
  return { point, partEdge, off: best.off };
}
