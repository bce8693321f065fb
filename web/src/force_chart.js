// The forces on the carrier over the depth that the part has reached.

import { axisBottom, axisLeft } from 'd3-axis';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { s } from './dom.js';

const kMargin = { left: 50, right: 12, top: 22, bottom: 40 };

// In a box of the picture. Answers {node, move(state)}; state: of an insertionPath.
export function forceChart(insertion, goalDepth, { x: left, y: top, width, height }) {
  const { moments } = insertion;
  const depths = moments.map((m) => m.depth_mm);
  const forces = moments.flatMap((m) => [m.axial_n, m.lateral_n]);
  const [low, high] = [Math.min(0, ...forces), Math.max(0, ...forces)];
  const spare = 0.06 * (high - low || 1);
  const x = scaleLinear(
    [Math.min(0, ...depths), Math.max(goalDepth, ...depths) || 1],
    [left + kMargin.left, left + width - kMargin.right],
  );
  const y = scaleLinear([low - spare, high + spare], [top + height - kMargin.bottom, top + kMargin.top]);
  const line = (name) => `M${moments.map((m) => `${x(m.depth_mm).toFixed(2)},${y(m[name]).toFixed(2)}`).join('L')}`;
  const [x0, x1] = x.range();
  const [y0, y1] = y.range();
  const axes = [
    s('g', { class: 'axis', transform: `translate(0,${y0})` }),
    s('g', { class: 'axis', transform: `translate(${x0},0)` }),
  ];
  select(axes[0]).call(axisBottom(x).ticks(Math.max(2, width / 80)));
  select(axes[1]).call(axisLeft(y).ticks(5));
  const key = (cls, text, at) => [
    s('path', { class: `curve ${cls}`, d: `M${at},${top + 9}h18` }),
    s('text', { x: at + 23, y: top + 13 }, text),
  ];
  const hand = s('line', { class: 'deciding', y1: y0, y2: y1 });
  const dots = ['axial', 'lateral'].map((cls) => s('circle', { class: `force-dot ${cls}`, r: 4.5 }));
  const node = s(
    'g',
    { class: 'force-chart' },
    axes,
    s('line', { class: 'zero', x1: x0, x2: x1, y1: y(0), y2: y(0) }),
    s('line', { class: 'goal-depth', x1: x(goalDepth), x2: x(goalDepth), y1: y0, y2: y1 }),
    s('text', { class: 'note', x: x(goalDepth) - 4, y: y0 - 5, 'text-anchor': 'end' }, 'goal'),
    key('axial', 'along the approach', x0),
    key('lateral', 'across it', x0 + 150),
    s('path', { class: 'curve lateral', d: line('lateral_n') }),
    s('path', { class: 'curve axial', d: line('axial_n') }),
    hand,
    dots,
    s('text', { class: 'axis-title', x: (x0 + x1) / 2, y: y0 + 34, 'text-anchor': 'middle' }, 'depth (mm)'),
    s(
      'text',
      {
        class: 'axis-title',
        'text-anchor': 'middle',
        transform: `translate(${left + 12},${(y0 + y1) / 2}) rotate(-90)`,
      },
      'force (N)',
    ),
  );
  return {
    node,
    move({ depth, axial, lateral }) {
      hand.setAttribute('x1', x(depth));
      hand.setAttribute('x2', x(depth));
      [axial, lateral].forEach((force, i) => {
        dots[i].setAttribute('cx', x(depth));
        dots[i].setAttribute('cy', y(force));
      });
    },
  };
}
