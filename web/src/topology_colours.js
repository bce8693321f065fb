// A colour and a mark for every topology on the front: colours that colour-blind readers tell apart, and shapes besides.

import { s } from './dom.js';

// Okabe and Ito 2008, without the yellow that marks the chosen design; what comes after is grey.
const kColours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#56b4e9', '#7d1f4f', '#332288'];
const kGrey = '#6b7680';
const kShapes = ['circle', 'square', 'triangle', 'cross', 'wedge', 'bar', 'star'];

// The topologies of the designs shown, those with most designs first: {topology, label, count, colour, shape}.
export function topologiesShown(report) {
  const found = new Map();
  for (const design of report.designs) {
    const known = found.get(design.topology) ?? { topology: design.topology, label: design.label, count: 0 };
    known.count += 1;
    found.set(design.topology, known);
  }
  return [...found.values()]
    .sort((a, b) => b.count - a.count || a.topology - b.topology)
    .map((t, i) => ({ ...t, colour: kColours[i] ?? kGrey, shape: kShapes[i] ?? 'circle' }));
}

const kPoints = {
  triangle: [
    [0, -1.15],
    [1.1, 0.85],
    [-1.1, 0.85],
  ],
  wedge: [
    [0, 1.15],
    [1.1, -0.85],
    [-1.1, -0.85],
  ],
  square: [
    [-0.9, -0.9],
    [0.9, -0.9],
    [0.9, 0.9],
    [-0.9, 0.9],
  ],
  bar: [
    [-1.3, -0.6],
    [1.3, -0.6],
    [1.3, 0.6],
    [-1.3, 0.6],
  ],
  cross: [
    [-0.4, -1.2],
    [0.4, -1.2],
    [0.4, -0.4],
    [1.2, -0.4],
    [1.2, 0.4],
    [0.4, 0.4],
    [0.4, 1.2],
    [-0.4, 1.2],
    [-0.4, 0.4],
    [-1.2, 0.4],
    [-1.2, -0.4],
    [-0.4, -0.4],
  ],
  star: Array.from({ length: 10 }, (_, i) => {
    const [r, a] = [i % 2 ? 0.55 : 1.3, (Math.PI * i) / 5];
    return [r * Math.sin(a), -r * Math.cos(a)];
  }),
};

export function markShape(shape, cx, cy, r, colour) {
  if (shape === 'circle') return s('circle', { cx, cy, r, fill: colour });
  return s('polygon', {
    points: kPoints[shape].map(([x, y]) => `${cx + r * x},${cy + r * y}`).join(' '),
    fill: colour,
  });
}

export function topologyKey({ shape, colour }) {
  return s(
    'svg',
    { class: 'topology-key', viewBox: '-8 -8 16 16', width: 14, height: 14, 'aria-hidden': 'true' },
    markShape(shape, 0, 0, 5.2, colour),
  );
}
