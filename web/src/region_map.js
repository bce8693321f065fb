// The success region: what becomes of every start, over its lateral and its angular error. A start is picked on it.

import { axisBottom, axisLeft } from 'd3-axis';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { h, onWidth, s } from './dom.js';
import { degrees, outcome, percent, short } from './format.js';

const kHeight = 330;
const kMargin = { left: 52, right: 14, top: 12, bottom: 42 };

const widened = ([a, b]) => (b > a ? [a, b] : [a - 0.5, b + 0.5]);

// Bands of one outcome as polygons in (x, theta): where neighbouring rows agree their ends are joined, else each row
// reaches half-way to the next.
export function bands(rows, [low, high]) {
  const found = [];
  const add = (below, above, from, to) =>
    below.forEach(([a, b, name], i) => {
      const [c, d] = above[i];
      found.push({
        outcome: name,
        corners: [
          [a, from],
          [b, from],
          [d, to],
          [c, to],
        ],
      });
    });
  const alike = (p, q) => p.length === q.length && p.every(([, , name], i) => name === q[i][2]);
  const flat = (row, from, to) => to > from && add(row.intervals, row.intervals, from, to);
  rows.forEach((row, i) => {
    if (i === 0) flat(row, low, row.theta_deg);
    const next = rows[i + 1];
    if (!next) return flat(row, row.theta_deg, high);
    if (alike(row.intervals, next.intervals)) return add(row.intervals, next.intervals, row.theta_deg, next.theta_deg);
    const half = (row.theta_deg + next.theta_deg) / 2;
    flat(row, row.theta_deg, half);
    flat(next, half, next.theta_deg);
  });
  return found;
}

const kWords = {
  x: 'lateral error of the start (mm)',
  theta: 'angular error of the start (\u00b0)',
  shows: 'plays it',
};

// picked(index): of a start; words: titles of the axes, and what Enter does. Answers {node, mark(index)}.
export function regionMap({ region, capture, starts }, picked, words = kWords) {
  const [xs, thetas] = [widened(region.x_mm), widened(region.theta_deg)];
  const size = [xs[1] - xs[0], thetas[1] - thetas[0]];
  const far = (a, b) => Math.hypot((a.x_mm - b.x_mm) / size[0], (a.theta_deg - b.theta_deg) / size[1]);
  const nearest = (spot) => starts.reduce((best, one, i) => (far(one, spot) < far(starts[best], spot) ? i : best), 0);
  let chosen = 0;
  let redraw = () => {};

  const plot = h('div', { class: 'plot', id: 'region' });
  const said = h('p', { class: 'small', id: 'region-words', 'aria-live': 'polite' });
  onWidth(plot, (px) => {
    const x = scaleLinear(xs, [kMargin.left, px - kMargin.right]);
    const y = scaleLinear(thetas, [kHeight - kMargin.bottom, kMargin.top]);
    const line = (corners) => `M${corners.map(([a, b]) => `${x(a).toFixed(2)},${y(b).toFixed(2)}`).join('L')}Z`;
    const [bottom, left] = [
      s('g', { class: 'axis', transform: `translate(0,${kHeight - kMargin.bottom})` }),
      s('g', { class: 'axis', transform: `translate(${kMargin.left},0)` }),
    ];
    select(bottom).call(axisBottom(x).ticks(7));
    select(left).call(axisLeft(y).ticks(7));
    const pin = s('g', { class: 'start-picked' });
    const svg = s(
      'svg',
      {
        viewBox: `0 0 ${px} ${kHeight}`,
        class: 'region-map',
        tabindex: 0,
        role: 'group',
        'aria-label': `What becomes of every start; arrow keys pick another start, Enter ${words.shows}`,
        onclick: (event) => {
          const area = svg.getBoundingClientRect();
          const scale = px / area.width;
          choose(
            nearest({
              x_mm: x.invert((event.clientX - area.left) * scale),
              theta_deg: y.invert((event.clientY - area.top) * scale),
            }),
          );
        },
        onkeydown: onKey,
      },
      bands(region.rows, thetas).map((band) =>
        s('path', { class: `region ${band.outcome}`, d: line(degenerate(band.corners)) }),
      ),
      captureBox(x, y),
      starts.map((one, i) =>
        s('circle', { class: 'start', 'data-start': i, cx: x(one.x_mm), cy: y(one.theta_deg), r: 2.2 }),
      ),
      bottom,
      left,
      s(
        'text',
        { class: 'axis-title', x: (x(xs[0]) + x(xs[1])) / 2, y: kHeight - 6, 'text-anchor': 'middle' },
        words.x,
      ),
      s(
        'text',
        { class: 'axis-title', 'text-anchor': 'middle', transform: `translate(14,${kHeight / 2 - 14}) rotate(-90)` },
        words.theta,
      ),
      pin,
    );
    redraw = () => {
      const one = starts[chosen];
      const [cx, cy] = [x(one.x_mm), y(one.theta_deg)];
      pin.replaceChildren(
        s('circle', { cx, cy, r: 7, class: 'halo' }),
        s('circle', { cx, cy, r: 7, class: 'rim', 'data-picked': chosen }),
      );
    };
    plot.replaceChildren(svg);
    if (starts.length) redraw();
  });

  // A side that is a single point fills the picture's width or height.
  function degenerate(corners) {
    if (region.x_mm[1] > region.x_mm[0]) return corners;
    return corners.map(([, theta], i) => [xs[i === 1 || i === 2 ? 1 : 0], theta]);
  }

  function captureBox(x, y) {
    if (!capture || ((capture.mm ?? 0) <= 0 && (capture.deg ?? 0) <= 0)) return null;
    const middle = [(xs[0] + xs[1]) / 2, (thetas[0] + thetas[1]) / 2];
    const half = [capture.mm ?? size[0] / 2, capture.deg ?? size[1] / 2];
    return s('rect', {
      class: 'capture',
      x: x(middle[0] - half[0]),
      y: y(middle[1] + half[1]),
      width: x(middle[0] + half[0]) - x(middle[0] - half[0]),
      height: y(middle[1] - half[1]) - y(middle[1] + half[1]),
    });
  }

  function onKey(event) {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (event.key === 'Enter' || event.key === ' ') {
      event.preventDefault();
      choose(chosen);
    }
    if (!way) return;
    event.preventDefault();
    // The nearest start that lies more that way than aside.
    const here = starts[chosen];
    const steps = starts
      .map((one, i) => {
        const off = [(one.x_mm - here.x_mm) / size[0], (one.theta_deg - here.theta_deg) / size[1]];
        const [along, aside] = way[0] ? [off[0] * way[0], off[1]] : [off[1] * way[1], off[0]];
        return { i, along, cost: along + 3 * Math.abs(aside) };
      })
      .filter(({ along }) => along > 1e-9)
      .sort((a, b) => a.cost - b.cost);
    if (steps.length) choose(steps[0].i);
  }

  function choose(index) {
    if (starts.length) picked(index);
  }

  const item = ([name, share]) =>
    h(
      'span',
      { 'data-share': name },
      h('i', { class: `key region-key ${name}`, 'aria-hidden': 'true' }),
      `${outcome(name).sign} ${outcome(name).word} ${percent(share)}`,
    );
  const shares = Object.entries(region.shares ?? {}).filter(([, share]) => share > 0);
  const node = h(
    'figure',
    { class: 'region-figure' },
    plot,
    h(
      'p',
      { class: 'legend', id: 'region-legend' },
      shares.sort((a, b) => b[1] - a[1]).map(item),
      capture?.mm || capture?.deg
        ? h(
            'span',
            null,
            h('i', { class: 'key capture', 'aria-hidden': 'true' }),
            `captured box ${[
              capture.mm ? `\u00b1${short(capture.mm)} mm` : null,
              capture.deg ? `\u00b1${degrees(capture.deg)}` : null,
            ]
              .filter(Boolean)
              .join(', ')}`,
          )
        : null,
    ),
    said,
  );
  return {
    node,
    mark(index) {
      chosen = index;
      redraw();
      const one = starts[index];
      said.textContent = `Picked: ${startWords(one)}, ${outcome(one.outcome).word}.`;
    },
  };
}

export const startWords = (one) =>
  `start ${short(one.x_mm)} mm aside, turned ${degrees(one.theta_deg)}${one.y_mm ? `, y ${short(one.y_mm)} mm` : ''}`;
