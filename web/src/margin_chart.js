// The margin of a pose over its travel, under the track and in line with it.

import { axisLeft } from 'd3-axis';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { s } from './dom.js';
import { fixed } from './format.js';

// curve: [{x, margin, held}]; deciding: position or null. Places itself between top and top + height.
export function marginChart(curve, view, top, height, deciding) {
  const margins = curve.map((p) => p.margin).filter((m) => m !== null);
  const low = Math.min(0, ...margins);
  const high = Math.max(0, ...margins);
  const spare = 0.08 * (high - low || 1);
  const y = scaleLinear([low - spare, high + spare], [top + height, top]);
  const [left, right] = [view.x(curve[0].x), view.x(curve[curve.length - 1].x)];
  const group = s('g', { class: 'margin-chart' });
  group.append(
    s('rect', { class: 'lost', x: left, y: y(0), width: right - left, height: Math.max(0, top + height - y(0)) }),
    s('line', { class: 'zero', x1: left, x2: right, y1: y(0), y2: y(0) }),
    s('text', { class: 'note', x: right - 4, y: y(0) - 4, 'text-anchor': 'end' }, 'supported'),
    s('text', { class: 'note', x: right - 4, y: y(0) + 12, 'text-anchor': 'end' }, 'lost'),
  );
  let line = '';
  let none = null;
  const endNone = (x) => {
    if (none !== null)
      group.append(
        s('rect', { class: 'none', x: view.x(none), y: top, width: Math.max(1, view.x(x) - view.x(none)), height }),
      );
    none = null;
  };
  let pen = 'M';
  for (const { x, margin, held } of curve) {
    if (margin === null) {
      if (!held && none === null) none = x;
      pen = 'M';
    } else {
      endNone(x);
      line += `${pen}${view.x(x).toFixed(2)},${y(margin).toFixed(2)}`;
      pen = 'L';
    }
  }
  endNone(curve[curve.length - 1].x);
  group.append(s('path', { class: 'curve', d: line }));
  if (deciding !== null) {
    group.append(
      s('line', { class: 'deciding', x1: view.x(deciding), x2: view.x(deciding), y1: top, y2: top + height }),
    );
  }
  const axis = s('g', { class: 'axis', transform: `translate(${left},0)` });
  select(axis).call(
    axisLeft(y)
      .ticks(4)
      .tickFormat((v) => fixed(v, 1).replace(/\.0$/, '')),
  );
  const title = s(
    'text',
    {
      class: 'axis-title',
      x: left - 34,
      y: top + height / 2,
      'text-anchor': 'middle',
      transform: `rotate(-90 ${left - 34} ${top + height / 2})`,
    },
    'margin (mm)',
  );
  const dot = s('circle', { class: 'here', r: 4.5 });
  group.append(axis, title, dot);
  return {
    node: group,
    move(x, margin) {
      dot.setAttribute('cx', view.x(x));
      dot.setAttribute('cy', margin === null ? y(low) : y(Math.max(low - spare, Math.min(high + spare, margin))));
      dot.setAttribute('class', margin === null ? 'here none' : margin < 0 ? 'here lost' : 'here');
    },
  };
}
