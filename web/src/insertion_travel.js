// One insertion, moving: the part between the fixed shapes, contacts and their forces, the carrier, forces over depth.

import { animation } from './animation.js';
import { arrow, contactSign } from './contact_sign.js';
import { h, s } from './dom.js';
import { degrees, fixed } from './format.js';
import { forceChart } from './force_chart.js';
import { boxOf, pathOf } from './geometry.js';
import { heldLoops, insertionPath, placedLoops } from './insertion_path.js';
import { badge } from './poses.js';
import { startWords } from './region_map.js';
import { makeView, placedBy, scaleBar } from './scene.js';

const kTall = 430; // px, of the joint's picture
const kSideBySide = 700; // px, from which on the chart stands beside it
const kLongest = 70; // px, of the largest force's arrow

// asked: problem.assembly; moved(q, insertion): told of every move. Answers {node, pause, run, pick}.
export function insertionTravel(insertion, joint, asked, moved) {
  const way = insertionPath(insertion, asked.approach.direction_deg);
  const loops = heldLoops(joint.part, false);
  const largest = Math.max(...insertion.moments.flatMap((m) => m.contacts.map((c) => Math.hypot(...c.force))), 1e-9);
  const ends = [...insertion.moments.map((m) => m.travel_mm)];
  const length = Math.max(way.to - way.from, 1e-3);
  const pace = [0.02, 0.05, 0.1, 0.25].map((share) => share * length);
  let picked = null;
  let redrawPicked = () => {};

  const timed = animation({
    from: way.from,
    to: way.from + length,
    start: opening(),
    speeds: pace.map((v, i) => [v, ['very slow', 'slow', 'medium', 'fast'][i]]),
    speed: pace[2],
    steps: [0.005 * length, 0.1 * length],
    jump: { text: 'Next event', to: (at) => ends.find((end) => end > at + 1e-6) ?? way.from },
    label: 'Travel of the carrier',
    makeStage,
  });

  // Where the forces are largest.
  function opening() {
    const sum = (m) => m.contacts.reduce((total, c) => total + Math.hypot(...c.force), 0);
    return insertion.moments.reduce((a, b) => (sum(b) > sum(a) ? b : a)).travel_mm;
  }

  function makeStage(px) {
    const beside = px >= kSideBySide;
    const wide = beside ? Math.round(0.56 * px) : px;
    const frame = frameOf(insertion, joint, loops);
    const scale = Math.min((wide - 8) / (frame.xMax - frame.xMin), (kTall - 34) / (frame.yMax - frame.yMin));
    const used = scale * (frame.xMax - frame.xMin);
    const view = makeView(frame.xMin, frame.yMax, scale, (wide - used) / 2, 4);
    const bottom = view.y(frame.yMin);
    const chartAt = beside
      ? { x: wide + 12, y: 0, width: px - wide - 12, height: Math.min(kTall, Math.max(300, bottom)) }
      : { x: 0, y: bottom + 34, width: px, height: 240 };
    const chart = forceChart(insertion, asked.goal.depth_mm, chartAt);
    const { node: shapes, inside } = drawJoint(joint.fixed, frame, view);
    const d = pathOf(loops, view.to);
    const body = (cls) => s('path', { class: cls, d, 'fill-rule': 'evenodd' });
    const [ghost, area, rim] = [body('carrier'), body('area'), body('outline')];
    const part = s('g', { class: 'part' }, area, rim);
    const trace = s('path', { class: 'trace rest', d: `M${insertion.moments.map((m) => view.to(m.q)).join('L')}` });
    const centre = s('path', { class: 'centre-cross', d: 'M-6,0h12M0,-6v12' });
    const contacts = s('g', { class: 'contacts' });
    const other = s('g', { class: 'picked' });
    inside.append(ghost, part, trace, other, contacts, centre);
    const svg = s(
      'svg',
      {
        viewBox: `0 0 ${px} ${Math.max(bottom + 30, chartAt.y + chartAt.height)}`,
        class: `insertion ${insertion.outcome}`,
        role: 'img',
        'aria-label': `The part between the fixed shapes, to scale, and the forces over depth: ${startWords(insertion)}`,
      },
      shapes,
      scaleBar(view, view.x(frame.xMin) + 4, bottom + 16),
      chart.node,
    );
    redrawPicked = () =>
      other.replaceChildren(
        ...(picked ? [s('path', { class: 'picked-part', d, transform: placedBy(view, ...picked) })] : []),
      );
    redrawPicked();
    return {
      svg,
      left: 12,
      right: px - 12,
      move(at) {
        const now = way.at(at);
        part.setAttribute('transform', placedBy(view, ...now.q));
        ghost.setAttribute('transform', placedBy(view, ...now.carrier));
        const [cx, cy] = view.to(now.q);
        centre.setAttribute('transform', `translate(${cx},${cy})`);
        contacts.replaceChildren(
          ...now.contacts.flatMap((c) => contactSign(c, asked.friction, view)),
          ...now.contacts.flatMap((c) => forceArrow(c, view)),
        );
        chart.move(now);
        say(at, now);
        moved(now.q, insertion);
      },
    };
  }

  function forceArrow({ point, force }, view) {
    const size = Math.hypot(...force);
    const px = (kLongest * size) / largest;
    if (px < 2) return [];
    return arrow(view.to(point), [force[0] / size, -force[1] / size], px, 'force', 'force-head');
  }

  function say(at, now) {
    const number = (title, value, digits, unit, key) =>
      h('span', null, `${title} `, h('b', { [`data-${key}`]: value }, fixed(value, digits)), unit);
    timed.readout.replaceChildren(
      number('travel', at, 2, ' mm', 'at'),
      number('depth', now.depth, 2, ' mm', 'depth'),
      number('tilt', now.q[2], 2, '\u00b0', 'theta'),
      number('along', now.axial, 2, ' N', 'axial'),
      number('across', now.lateral, 2, ' N', 'lateral'),
      number('moment', now.moment, 1, ' N mm', 'moment'),
      h('span', { class: 'event' }, h('b', null, now.event)),
    );
  }

  const figure = (title, value, digits, unit, key) =>
    h('div', null, h('dt', null, title), h('dd', { 'data-of': key }, `${fixed(value, digits)} ${unit}`));
  const node = h(
    'div',
    { class: `animation ${insertion.outcome}`, id: 'animation' },
    h(
      'p',
      { class: 'verdict' },
      badge(insertion.outcome),
      ' ',
      h('strong', null, startWords(insertion)),
      insertion.why ? `: ${insertion.why}.` : '',
    ),
    h(
      'dl',
      { class: 'figures', id: 'insertion-figures' },
      figure('Depth reached', insertion.deepest_mm, 2, 'mm', 'deepest'),
      figure('Peak along the approach', insertion.peak_axial_n, 2, 'N', 'axial'),
      figure('Peak across it', insertion.peak_lateral_n, 2, 'N', 'lateral'),
      figure('Work', insertion.work_nmm, 1, 'N mm', 'work'),
    ),
    timed.controls,
    timed.stage,
    timed.slider,
    legend(asked.friction > 0),
  );
  return {
    node,
    pause: timed.pause,
    run() {
      timed.show(way.from);
      timed.run();
    },
    pick(placement) {
      picked = placement;
      redrawPicked();
    },
  };
}

// What is looked at: everywhere that the part goes, and of the fixed shapes what is near.
export function frameOf(insertion, joint, loops) {
  const { moments } = insertion;
  const swept = boxOf(moments.flatMap((m) => placedLoops(loops, m.q)));
  const near = Math.max(2, 0.3 * Math.min(swept.xMax - swept.xMin, swept.yMax - swept.yMin));
  const shapes = boxOf(joint.fixed);
  return {
    xMin: Math.min(swept.xMin, Math.max(shapes.xMin, swept.xMin - 2 * near)) - 0.2 * near,
    xMax: Math.max(swept.xMax, Math.min(shapes.xMax, swept.xMax + 2 * near)) + 0.2 * near,
    yMin: Math.min(swept.yMin, Math.max(shapes.yMin, swept.yMin - near)) - 0.1 * near,
    yMax: Math.max(swept.yMax, Math.min(shapes.yMax, swept.yMax + near)) + 0.1 * near,
  };
}

// Fixed shapes in a frame; inside: what else is cut off at it.
export function drawJoint(fixedLoops, frame, view) {
  const inside = s(
    'svg',
    {
      class: 'joint-view',
      x: view.x(frame.xMin),
      y: view.y(frame.yMax),
      width: (frame.xMax - frame.xMin) * view.scale,
      height: (frame.yMax - frame.yMin) * view.scale,
    },
    s('rect', { class: 'joint-back', width: '100%', height: '100%' }),
  );
  const own = s('g', { transform: `translate(${-view.x(frame.xMin)},${-view.y(frame.yMax)})` });
  own.append(...fixedLoops.map((loop) => s('path', { class: 'fixed-shape', d: pathOf([loop], view.to) })));
  inside.append(own);
  return { node: inside, inside: own };
}

function legend(hasFriction) {
  const item = (cls, text) => h('span', null, h('i', { class: `key ${cls}`, 'aria-hidden': 'true' }), text);
  return h(
    'p',
    { class: 'legend' },
    item('part', 'part'),
    item('carrier', 'where the carrier holds it'),
    item('contact', 'contact that slides'),
    item('contact sticks', 'contact that sticks'),
    hasFriction ? item('cone', 'friction cone') : null,
    item('force', 'force on the part, to one scale'),
  );
}
