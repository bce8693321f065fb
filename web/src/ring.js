// What becomes of every starting orientation: a ring of intervals, the part turned in its middle.

import { arc } from 'd3-shape';

import { h, s } from './dom.js';
import { degrees, fixed, outcome } from './format.js';
import { pathOf } from './geometry.js';
import { turned } from './path.js';
import { badge } from './poses.js';

const kSize = 340;
const kInner = 112;
const kOuter = 136;
const kRad = Math.PI / 180;
const kWhole = 359.999999;

// Angles of the part: counter-clockwise from +x; those of d3: clockwise from the top.
const clockwise = (deg) => (90 - deg) * kRad;
const onCircle = (r, deg) => [r * Math.cos(deg * kRad), -r * Math.sin(deg * kRad)];
export const widthOf = ({ from_deg: from, to_deg: to }) => (turned(to - from) === 0 ? 360 : turned(to - from));
export const contains = (interval, deg) => turned(deg - interval.from_deg) <= widthOf(interval) + 1e-9;

export function words(interval) {
  const exit = interval.exit_orientation_deg;
  return exit === null || exit === undefined ? '' : `leaves at ${degrees(exit)}`;
}

function sector(from, width, inner, outer, pad = 0) {
  return arc()({
    startAngle: clockwise(from + width),
    endAngle: clockwise(from),
    innerRadius: inner,
    outerRadius: outer,
    padAngle: width < kWhole ? pad : 0,
  });
}

// intervals: of one aspect, [{...interval, index, goal}]; outline: {outline_mm, holes_mm}; choose(index, deg) plays it.
// Answers {node, mark(index, deg)}: mark shows which is chosen and draws the part as it starts.
export function ring(aspect, intervals, outline, choose) {
  const loops = [outline.outline_mm, ...(outline.holes_mm ?? [])];
  const reach = Math.max(...outline.outline_mm.map(([x, y]) => Math.hypot(x, y)), 1);
  const scale = 84 / reach;
  const body = pathOf(loops, ([x, y]) => [x * scale, -y * scale]);
  const leaves = s('path', { class: 'leaves', d: body, 'fill-rule': 'evenodd' });
  const arrives = s('path', { class: 'arrives', d: body, 'fill-rule': 'evenodd' });
  const hand = s('path', { class: 'hand', d: 'M-4,12L0,0L4,12Z' });
  const ends = s('g', { class: 'ends' });
  const said = h('output', { class: 'ring-words', 'aria-live': 'polite' });
  let chosen = null;

  function show(interval, deg) {
    const width = widthOf(interval);
    arrives.setAttribute('transform', `rotate(${-deg})`);
    const exit = interval.exit_orientation_deg;
    leaves.setAttribute('visibility', exit === null || exit === undefined ? 'hidden' : 'visible');
    if (exit !== null && exit !== undefined) leaves.setAttribute('transform', `rotate(${-exit})`);
    hand.setAttribute('transform', `translate(${onCircle(kInner - 2, deg).join()}) rotate(${90 - deg})`);
    // Angles of both boundaries, outside of the ring: a narrow interval's are pushed apart.
    const spread = Math.max(0, 9 - width) / 2;
    ends.replaceChildren(
      ...(width > kWhole
        ? []
        : [
            [interval.from_deg, -spread],
            [interval.to_deg, spread],
          ]
      ).flatMap(([at, aside]) => {
        const [x, y] = onCircle(kOuter + 21, at + aside);
        const [x0, y0] = onCircle(kInner - 4, at);
        const [x1, y1] = onCircle(kOuter + 9, at);
        return [
          s('line', { x1: x0, y1: y0, x2: x1, y2: y1 }),
          s(
            'text',
            {
              x,
              y: y + 4,
              'text-anchor': Math.abs(x) < 40 ? 'middle' : x > 0 ? 'start' : 'end',
              dx: Math.abs(x) < 40 ? 0 : x > 0 ? -8 : 8,
            },
            `${fixed(at, 2)}\u00b0`,
          ),
        ];
      }),
    );
    arrives.setAttribute('class', `arrives ${interval.outcome}`);
    said.replaceChildren(
      h(
        'span',
        null,
        `Starts at ${degrees(turned(deg))} `,
        h('span', { class: 'faint' }, `(${fixed(interval.from_deg, 2)}\u00b0 to ${fixed(interval.to_deg, 2)}\u00b0)`),
      ),
      h(
        'span',
        null,
        badge(interval.outcome),
        ` ${words(interval)}`,
        interval.goal ? [' ', h('span', { class: 'goal' }, 'goal')] : '',
      ),
    );
  }
  const back = () => chosen && show(...chosen);

  const svg = s('svg', {
    viewBox: `${-kSize / 2 - 30} ${-kSize / 2} ${kSize + 60} ${kSize}`,
    class: 'ring',
    role: 'group',
    'aria-label': `Outcome of every starting orientation, aspect ${aspect}; arrow keys move, Enter plays`,
  });
  const hatch = `ring-hatch-${aspect.replace(/[^a-z0-9]/gi, '')}`;
  svg.append(
    s(
      'defs',
      null,
      s(
        'pattern',
        { id: hatch, width: 6, height: 6, patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)' },
        s('line', { class: 'hatch', x1: 0, y1: 0, x2: 0, y2: 6 }),
      ),
    ),
    ...[...Array(36).keys()].map((i) => {
      const [a, b] = [onCircle(kInner - 1, 10 * i), onCircle(kInner - (i % 9 ? 4 : 8), 10 * i)];
      return s('line', { class: 'tick', x1: a[0], y1: a[1], x2: b[0], y2: b[1] });
    }),
    ...[0, 90, 180, 270].map((deg) => {
      const [x, y] = onCircle(kInner - (deg % 180 ? 19 : 24), deg);
      return s('text', { class: 'note', x, y: y + 4, 'text-anchor': 'middle' }, `${deg}\u00b0`);
    }),
  );
  const sectors = intervals.map((interval, i) => {
    const width = widthOf(interval);
    const middle = interval.from_deg + width / 2;
    const wrong = interval.outcome === 'delivered' && !interval.goal;
    const node = s(
      'g',
      {
        class: `sector ${interval.outcome}${interval.goal ? ' is-goal' : ''}`,
        role: 'button',
        tabindex: i === 0 ? 0 : -1,
        'data-interval': interval.index,
        'aria-label': `${fixed(interval.from_deg, 2)}\u00b0 to ${fixed(interval.to_deg, 2)}\u00b0: ${outcome(interval.outcome).word} ${words(interval)}${interval.goal ? ', the goal' : ''}`,
      },
      s('path', { class: 'band', d: sector(interval.from_deg, width, kInner, kOuter, 0.008) }),
      wrong
        ? s('path', {
            class: 'over',
            d: sector(interval.from_deg, width, kInner, kOuter, 0.008),
            fill: `url(#${hatch})`,
          })
        : null,
      interval.goal ? s('path', { class: 'rim', d: sector(interval.from_deg, width, kOuter + 3, kOuter + 7) }) : null,
      width > 7
        ? s(
            'text',
            {
              class: 'sign',
              x: onCircle((kInner + kOuter) / 2, middle)[0],
              y: onCircle((kInner + kOuter) / 2, middle)[1] + 4.5,
              'text-anchor': 'middle',
            },
            interval.goal ? '\u2605' : outcome(interval.outcome).sign,
          )
        : null,
    );
    const angleAt = (event) => {
      const box = svg.getBoundingClientRect();
      const [x, y] = [event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2];
      const deg = turned(Math.atan2(-y, x) / kRad);
      return contains(interval, deg) ? deg : middle;
    };
    node.addEventListener('pointermove', (event) => show(interval, angleAt(event)));
    node.addEventListener('pointerleave', back);
    node.addEventListener('focus', () => {
      if (node.matches(':focus-visible')) show(interval, middle);
    });
    node.addEventListener('blur', back);
    node.addEventListener('click', () => choose(interval.index));
    node.addEventListener('keydown', (event) => {
      const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      if (by) focusOn((i + by + sectors.length) % sectors.length);
      else if (event.key === 'Enter' || event.key === ' ') choose(interval.index);
      else return;
      event.preventDefault();
    });
    return node;
  });
  function focusOn(i) {
    sectors.forEach((node, k) => node.setAttribute('tabindex', k === i ? 0 : -1));
    sectors[i].focus();
  }
  svg.append(...sectors, ends, leaves, arrives, s('path', { class: 'centre-mark', d: 'M-6,0H6M0,-6V6' }), hand);
  return {
    node: h(
      'figure',
      { class: 'ring-box', 'data-aspect': aspect },
      h('figcaption', null, `aspect \u201c${aspect}\u201d`),
      svg,
      said,
    ),
    mark(index, deg) {
      sectors.forEach((node) => {
        const mine = Number(node.dataset.interval) === index;
        node.classList.toggle('chosen', mine);
        node.setAttribute('aria-pressed', String(mine));
      });
      const interval = intervals.find((x) => x.index === index) ?? null;
      svg.classList.toggle('aside', !interval);
      chosen = interval ? [interval, deg] : chosen;
      if (!chosen && intervals.length) chosen = [intervals[0], intervals[0].from_deg + widthOf(intervals[0]) / 2];
      back();
    },
  };
}
