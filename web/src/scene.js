// What track pictures share: a scale from mm to the picture, the plate with its voids, the wall, a part.

import { freshId, s } from './dom.js';
import { boxOf, complement, loopsOf, pathOf } from './geometry.js';

const kOnEdge_mm = 1e-3;

// World to picture: x to the right, y (away from the wall) upwards, one scale for both.
export function makeView(xFrom, yTop, scale, left, top) {
  const x = (v) => left + (v - xFrom) * scale;
  const y = (v) => top + (yTop - v) * scale;
  return { scale, x, y, to: ([px, py]) => [x(px), y(py)] };
}

const voidLoops = (track) => track.flatMap((feature) => feature.voids.flatMap(loopsOf));

// The metal of the plate between two positions, as path data for the even-odd rule.
function metalPath(track, width, from, to, view) {
  const strip = [
    [from, 0],
    [to, 0],
    [to, width],
    [from, width],
  ];
  return pathOf([strip], view.to) + pathOf(voidLoops(track), view.to);
}

// Where voids open a line along the track: the free edge, or the wall.
export function openings(track, y) {
  const open = [];
  for (const loop of voidLoops(track)) {
    loop.forEach((a, i) => {
      const b = loop[(i + 1) % loop.length];
      if (Math.abs(a[1] - y) < kOnEdge_mm && Math.abs(b[1] - y) < kOnEdge_mm) {
        open.push([Math.min(a[0], b[0]), Math.max(a[0], b[0])]);
      }
    });
  }
  return open;
}

// Plate, cut edges, free edge, wall and blades between two positions. clip: the id of a clip path of the metal.
export function drawTrack(track, width, from, to, view) {
  const clip = freshId('metal');
  const window = freshId('window');
  const group = s('g', { class: 'track' });
  const overlaps = separateVoids(track);
  group.append(
    s('clipPath', { id: clip }, s('path', { d: metalPath(track, width, from, to, view), 'clip-rule': 'evenodd' })),
    s(
      'clipPath',
      { id: window },
      s('rect', {
        x: view.x(from),
        y: view.y(width) - 2,
        width: (to - from) * view.scale,
        height: width * view.scale + 4,
      }),
    ),
  );
  const inside = s('g', { 'clip-path': `url(#${window})` });
  inside.append(
    s('rect', {
      class: 'metal',
      x: view.x(from),
      y: view.y(width),
      width: (to - from) * view.scale,
      height: width * view.scale,
    }),
  );
  for (const feature of track) {
    for (const area of feature.voids) {
      inside.append(s('path', { class: 'void', d: pathOf(loopsOf(area), view.to), 'fill-rule': 'evenodd' }));
    }
  }
  for (const feature of track) {
    for (const area of feature.voids) inside.append(cutEdges(area, feature, track, width, view, overlaps));
  }
  for (const [a, b] of complement(from, to, openings(track, width))) {
    inside.append(s('line', { class: 'edge', x1: view.x(a), y1: view.y(width), x2: view.x(b), y2: view.y(width) }));
  }
  group.append(inside, drawWall(from, to, view), ...track.flatMap((f) => blade(f, width, from, to, view)));
  return { group, clip };
}

// Features may overlap when they are placed absolutely; their cut edges then hide inside each other.
function separateVoids(track) {
  const boxes = track.map((f) => (f.voids.length ? boxOf(f.voids.map((v) => v.outer_mm)) : null));
  return boxes.some(
    (a, i) =>
      a && boxes.some((b, j) => j > i && b && a.xMin < b.xMax && b.xMin < a.xMax && a.yMin < b.yMax && b.yMin < a.yMax),
  );
}

function cutEdges(area, owner, track, width, view, overlaps) {
  const group = s('g', { class: 'edge' });
  for (const loop of loopsOf(area)) {
    let d = '';
    loop.forEach((a, i) => {
      const b = loop[(i + 1) % loop.length];
      const along = (y) => Math.abs(a[1] - y) < kOnEdge_mm && Math.abs(b[1] - y) < kOnEdge_mm;
      if (along(0) || along(width)) return;
      if (overlaps && track.some((f) => f !== owner && f.voids.some((v) => contains(v, midpoint(a, b))))) return;
      d += `M${view.to(a)}L${view.to(b)}`;
    });
    if (d) group.append(s('path', { d }));
  }
  return group;
}

const midpoint = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];

function contains(area, [x, y]) {
  let odd = false;
  for (const loop of loopsOf(area)) {
    loop.forEach((a, i) => {
      const b = loop[(i + 1) % loop.length];
      if (a[1] > y !== b[1] > y && x < a[0] + ((y - a[1]) / (b[1] - a[1])) * (b[0] - a[0])) odd = !odd;
    });
  }
  return odd;
}

export function drawWall(from, to, view) {
  const pattern = freshId('hatch');
  const height = Math.max(5, Math.min(10, 3 * view.scale));
  return s(
    'g',
    { class: 'wall' },
    s(
      'pattern',
      { id: pattern, width: 6, height: 6, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' },
      s('line', { x1: 0, y1: 0, x2: 0, y2: 6 }),
    ),
    s('rect', { x: view.x(from), y: view.y(0), width: (to - from) * view.scale, height, fill: `url(#${pattern})` }),
    s('line', { class: 'face', x1: view.x(from), y1: view.y(0), x2: view.x(to), y2: view.y(0) }),
  );
}

export function dimensionOf(feature, name) {
  return feature.dimensions.find(([key]) => key === name)?.[1];
}

export const isBlade = (feature) => feature.type === 'wiper' || feature.type === 'hold-down';

// Seen from above: a wiper is a line across the track, a rail a strip along it.
function blade(feature, width, from, to, view) {
  if (!isBlade(feature) || feature.end_mm < from || feature.start_mm > to) return [];
  const a = Math.max(from, feature.start_mm);
  const b = Math.min(to, feature.end_mm);
  if (feature.type === 'wiper') {
    return [s('line', { class: 'blade', x1: view.x(a), y1: view.y(width), x2: view.x(a), y2: view.y(0) })];
  }
  return [
    s('rect', {
      class: 'blade rail',
      x: view.x(a),
      y: view.y(width),
      width: Math.max(1, (b - a) * view.scale),
      height: width * view.scale,
    }),
  ];
}

const isProfile = (o) => o.outline_mm && Math.min(...o.outline_mm.map(([, y]) => y)) < 0 && o.name.includes('(wall)');

// What stands on the track: fences, wall profiles, pins. A profile takes the place of the wall, which is not there.
export function drawObstacles(obstacles, view) {
  const opened = obstacles.filter(isProfile).map((o) => {
    const { xMin, xMax, yMin } = boxOf([o.outline_mm]);
    return s('rect', {
      class: 'opened',
      x: view.x(xMin),
      y: view.y(0) - 1.5,
      width: (xMax - xMin) * view.scale,
      height: Math.max(-yMin * view.scale, 12) + 3,
    });
  });
  return s(
    'g',
    { class: 'obstacles' },
    opened,
    obstacles.map((o) =>
      o.outline_mm
        ? s('path', { d: pathOf([o.outline_mm], view.to) }, s('title', null, o.name))
        : s(
            'circle',
            { cx: view.x(o.centre_mm[0]), cy: view.y(o.centre_mm[1]), r: o.radius_mm * view.scale },
            s('title', null, o.name),
          ),
    ),
  );
}

// A part at 0, 0 of its own; moved, and turned about that point, by setting the transform of the answer's nodes.
export function drawPart(pose, view, clip) {
  const d = pathOf(loopsOf(pose.footprint), view.to);
  const upper = pose.upper.map((area) =>
    s('path', { class: 'upper', d: pathOf(loopsOf(area), view.to), 'fill-rule': 'evenodd' }),
  );
  const whole = s('g', { class: 'part' }, s('path', { class: 'area', d, 'fill-rule': 'evenodd' }));
  const held = s('path', { class: 'supported', d, 'fill-rule': 'evenodd' });
  const rim = s('g', { class: 'part' }, s('path', { class: 'outline', d, 'fill-rule': 'evenodd' }), upper);
  const node = s('g', null, whole, s('g', { 'clip-path': `url(#${clip})` }, held), rim);
  return {
    node,
    move(x, y = 0, deg = 0) {
      const to = placedBy(view, x, y, deg);
      [whole, held, rim].forEach((n) => n.setAttribute('transform', to));
    },
  };
}

// The transform of what is drawn at 0, 0.
export function placedBy(view, x, y, deg) {
  const turn = deg ? ` rotate(${(-deg).toFixed(4)},${view.x(0)},${view.y(0)})` : '';
  return `translate(${x * view.scale},${-y * view.scale})${turn}`;
}

// The centre of mass as engineers draw it; the supported point as a cross where the two differ.
export function drawCentre(pose, view, radius) {
  const x = view.x(0);
  const y = view.y(pose.com_y_mm);
  const ys = view.y(pose.supported_y_mm);
  const r = radius;
  const quarter = `M${x},${y}h${r}a${r},${r} 0 0 0 ${-r},${-r}zM${x},${y}h${-r}a${r},${r} 0 0 0 ${r},${r}z`;
  return s(
    'g',
    { class: 'centre' },
    s('circle', { cx: x, cy: y, r }),
    s('path', { d: quarter }),
    s('path', { class: 'target', d: `M${x - r - 3},${ys}h${2 * r + 6}M${x},${ys - r - 3}v${2 * r + 6}` }),
  );
}

export function scaleBar(view, x, y) {
  const length = [1, 2, 5, 10, 20, 50, 100].find((mm) => mm * view.scale >= 60) ?? 100;
  const width = length * view.scale;
  return s(
    'g',
    { class: 'scale-bar' },
    s('path', { d: `M${x},${y - 4}v4h${width}v-4M${x + width / 2},${y}v-3` }),
    s('text', { x: x + width + 6, y: y + 1 }, `${length} mm`),
  );
}
