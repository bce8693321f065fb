// Axes of the configuration space: edges of its box nearest to the reader, ticks and names, drawn over the picture.

import { ticks } from 'd3-array';

import { s } from './dom.js';

const kTick = 6;

const kTitles = { x: 'x along the track (mm)', y: 'y from the wall (mm)' };

// base: theta of the box's bottom; span: to its top.
export function axesOverlay({ xMin, xMax, yMin, yMax }, base, to, span = 360, titles = kTitles) {
  const quarters =
    span < 360
      ? ticks(base, base + span, 5)
      : [0, 1, 2, 3, 4].map((i) => 90 * (Math.ceil(base / 90) + i)).filter((deg) => deg <= base + 360);
  const node = s('svg', { class: 'space-axes', 'aria-hidden': 'true' });
  return {
    node,
    draw(camera, width, height, azimuth) {
      node.setAttribute('viewBox', `0 0 ${width} ${height}`);
      const screen = (p) => {
        const v = to(p).project(camera);
        return [((v.x + 1) / 2) * width, ((1 - v.y) / 2) * height];
      };
      const a = (azimuth * Math.PI) / 180;
      const near = [Math.cos(a) > 0 ? xMax : xMin, Math.sin(a) > 0 ? yMax : yMin];
      const corners = [xMin, xMax].flatMap((x) => [yMin, yMax].map((y) => [x, y]));
      const leftmost = corners.reduce((best, c) =>
        screen([...c, base + span / 2])[0] < screen([...best, base + span / 2])[0] ? c : best,
      );
      const middle = screen([(xMin + xMax) / 2, (yMin + yMax) / 2, base]);
      const axis = (name, values, at, format = (v) => String(v)) => {
        const [from, end] = [screen(at(values.range[0])), screen(at(values.range[1]))];
        // Ticks point away from the middle of the box.
        const along = [end[0] - from[0], end[1] - from[1]];
        const size = Math.hypot(...along);
        if (size < 40) return [];
        let out = [-along[1] / size, along[0] / size];
        const centre = [(from[0] + end[0]) / 2 - middle[0], (from[1] + end[1]) / 2 - middle[1]];
        if (out[0] * centre[0] + out[1] * centre[1] < 0) out = [-out[0], -out[1]];
        const anchor = out[0] > 0.3 ? 'start' : out[0] < -0.3 ? 'end' : 'middle';
        const put = (p, by) => [p[0] + out[0] * by, p[1] + out[1] * by];
        const every = Math.max(1, Math.ceil((34 * values.list.length) / size));
        const marks = values.list
          .filter((_, i) => i % every === 0)
          .flatMap((v) => {
            const p = screen(at(v));
            const [q, t] = [put(p, kTick), put(p, kTick + 5)];
            return [
              s('line', { x1: p[0], y1: p[1], x2: q[0], y2: q[1] }),
              s('text', { x: t[0], y: t[1] + 4 + 4 * Math.max(0, out[1]), 'text-anchor': anchor }, format(v)),
            ];
          });
        const upright = Math.abs(along[0]) < 0.15 * size && name.length > 8;
        const away = upright ? 42 : anchor === 'middle' ? 34 + 3.4 * name.length * Math.abs(out[0]) : 46;
        const [tx, ty] = put([(from[0] + end[0]) / 2, (from[1] + end[1]) / 2], away);
        const wide = upright ? 0 : 6.6 * name.length;
        const x = Math.max(anchor === 'end' ? wide : 0, Math.min(tx, anchor === 'start' ? width - wide : width));
        const y = Math.max(14, Math.min(ty, height - 13)) + 4;
        return [
          s('line', { class: 'axis-line', x1: from[0], y1: from[1], x2: end[0], y2: end[1] }),
          ...marks,
          s(
            'text',
            {
              class: 'axis-title',
              x,
              y,
              'text-anchor': upright ? 'middle' : anchor,
              transform: upright ? `rotate(-90 ${x} ${y})` : null,
            },
            name,
          ),
        ];
      };
      const listed = (low, high, count) => ({ range: [low, high], list: ticks(low, high, count) });
      const rim = corners.map((c) => screen([...c, base + span]));
      const top = [rim[0], rim[1], rim[3], rim[2]];
      node.replaceChildren(
        s('path', { class: 'box', d: `M${top.map((p) => p.map((v) => v.toFixed(1)).join()).join('L')}Z` }),
        ...axis(titles.x, listed(xMin, xMax, 8), (v) => [v, near[1], base]),
        ...axis(titles.y, listed(yMin, yMax, 5), (v) => [near[0], v, base]),
        ...axis('\u03b8 (\u00b0)', { range: [base, base + span], list: quarters }, (v) => [...leftmost, v]),
      );
    },
  };
}
