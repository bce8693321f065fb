// A part that turns, along its path over the track: contacts, what happens, the way of its centre of mass.

import { animation } from './animation.js';
import { contactSign } from './contact_sign.js';
import { h, s } from './dom.js';
import { degrees, fixed } from './format.js';
import { boxOf, pathOf } from './geometry.js';
import { carried, measured, outlineOf, placed, touching } from './path.js';
import { badge } from './poses.js';
import { drawCentre, drawObstacles, drawPart, drawTrack, makeView, placedBy, scaleBar } from './scene.js';

const kSpeeds_mm_s = [5, 10, 20, 50, 100];
const kMostGhosts = 9;
const kMotions = {
  free: 'moves freely',
  translation: 'translates',
  slide: 'slides and turns',
  curve: 'turns on two contacts',
  pivot: 'pivots',
};

// moved(placement, path): told of every move. Answers {node, pause, run, pick}; pick draws a placement beside the path.
export function pathTravel(path, design, outline, reach, width, moved) {
  const { turning } = design;
  const way = measured(path, reach);
  const outlines = [outline.outline_mm, ...(outline.holes_mm ?? [])];
  const body = { footprint: { outer_mm: outline.outline_mm, holes_mm: outline.holes_mm ?? [] }, upper: [] };
  let picked = null;
  let redrawPicked = () => {};

  const timed = animation({
    from: 0,
    to: Math.max(way.length, 1e-3),
    start: opening(path, way),
    speeds: kSpeeds_mm_s.map((v) => [v, `${v} mm/s`]),
    speed: 50,
    steps: [0.2, 5],
    jump: { text: 'Next event', to: (at) => way.starts.find((start) => start > at + 1e-6) ?? 0 },
    label: 'Place on the path',
    makeStage,
  });

  function makeStage(px) {
    const box = boxOf([path.points.map(([x, y]) => [x, y]), ...turning.obstacles.map(outlineOf)]);
    const [xFrom, xTo] = [box.xMin - reach - 3, box.xMax + reach + 3];
    const tall = Math.max(width, boxOf([path.points]).yMax + reach) + 1;
    const [left, right, top] = [12, 12, 6];
    const scale = Math.min((px - left - right) / (xTo - xFrom), 420 / tall);
    const inset = left + Math.max(0, (px - left - right - scale * (xTo - xFrom)) / 2);
    const view = makeView(xFrom, tall, scale, inset, top);
    const floor = view.y(Math.max(-30, Math.min(0, box.yMin))) + 12;
    const strip = floor + 34;
    const svg = s('svg', {
      viewBox: `0 0 ${px} ${strip + 30}`,
      class: `travel turning ${path.outcome}`,
      role: 'img',
      'aria-label': `The part over the track, to scale, started at ${degrees(path.start_deg)}`,
    });
    const { group, clip } = drawTrack(design.track, width, xFrom, xTo, view);
    const part = drawPart(body, view, clip);
    const centre = drawCentre({ com_y_mm: 0, supported_y_mm: 0 }, view, 5);
    const trace = s('path', { class: 'trace' });
    const contacts = s('g', { class: 'contacts' });
    const other = s('g', { class: 'picked' });
    const d = pathOf(outlines, view.to);
    const whole = s('path', { class: 'trace rest', d: lineOf(path.points, view) });
    svg.append(
      group,
      drawObstacles(turning.obstacles, view),
      ghosts(d, view),
      whole,
      trace,
      part.node,
      other,
      contacts,
      centre,
    );
    svg.append(scaleBar(view, inset, floor + 14), ...legStrip(px, strip));
    const hand = s('path', { class: 'strip-hand' });
    svg.append(hand);
    redrawPicked = () => {
      other.replaceChildren(...(picked ? drawPicked(d, view) : []));
    };
    redrawPicked();
    const along = (at) => left + (at / Math.max(way.length, 1e-3)) * (px - left - right);
    return {
      svg,
      left,
      right: px - right,
      move(at) {
        const placement = way.placement(at);
        const leg = way.legAt(at);
        part.move(...placement);
        centre.setAttribute('transform', placedBy(view, placement[0], placement[1], 0));
        trace.setAttribute('d', lineOf([...path.points.filter((_, i) => way.along[i] <= at), placement], view));
        const now = path.legs[leg];
        const touches = now ? carried(now.contacts, path.points[now.from], placement, turning.obstacles) : [];
        contacts.replaceChildren(...touches.flatMap((c) => contactSign(c, turning.friction, view)));
        hand.setAttribute('d', `M${along(at)},${strip - 4}v24`);
        steps.forEach((step, i) =>
          i === leg ? step.setAttribute('aria-current', 'step') : step.removeAttribute('aria-current'),
        );
        say(at, placement, now, touches);
        moved(placement, path);
      },
    };
  }

  // The part at events, faint: what a still picture shows of the motion.
  function ghosts(d, view) {
    const all = [...way.starts, way.length];
    const every = Math.ceil(all.length / kMostGhosts);
    return s(
      'g',
      { class: 'ghosts' },
      all
        .filter((_, i) => i % every === 0 || i === all.length - 1)
        .map((at) => s('path', { d, transform: placedBy(view, ...way.placement(at)), 'fill-rule': 'evenodd' })),
    );
  }

  function drawPicked(d, view) {
    const hit = touching(picked.facet, outlines, picked.placement, turning);
    const nodes = [s('path', { class: 'picked-part', d, transform: placedBy(view, ...picked.placement) })];
    if (!hit) return nodes;
    if (hit.partEdge)
      nodes.push(s('path', { class: 'picked-edge', d: `M${view.to(hit.partEdge[0])}L${view.to(hit.partEdge[1])}` }));
    const [x, y] = view.to(hit.point);
    return [...nodes, s('circle', { class: 'picked-point', cx: x, cy: y, r: 6 })];
  }

  // The legs on the slider's length, shaded by motion.
  function legStrip(px, top) {
    const [left, right] = [12, px - 12];
    const at = (v) => left + (v / Math.max(way.length, 1e-3)) * (right - left);
    return path.legs.map((leg, i) => {
      const [a, b] = [at(way.starts[i]), at(way.starts[i + 1] ?? way.length)];
      return s(
        'g',
        { class: `leg ${leg.motion}`, onclick: () => go(i) },
        s('title', null, `${i + 1} ${leg.event}: ${kMotions[leg.motion] ?? leg.motion}`),
        s('rect', { x: a, y: top, width: Math.max(0.5, b - a), height: 16 }),
        b - a > 13
          ? s('text', { x: (a + b) / 2, y: top + 12, 'text-anchor': 'middle' }, b - a > 78 ? leg.motion : String(i + 1))
          : null,
      );
    });
  }
  function go(leg) {
    timed.pause();
    timed.show(way.starts[leg] + 1e-6);
  }
  const steps = path.legs.map((leg, i) =>
    h(
      'button',
      { type: 'button', class: 'step', onclick: () => go(i) },
      h('b', null, String(i + 1)),
      ` ${leg.event} `,
      h('span', { class: 'faint' }, leg.motion),
    ),
  );

  function say(at, [x, y, theta], leg, touches) {
    timed.readout.replaceChildren(
      h('span', null, 'x ', h('b', { 'data-x': x, 'data-at': at }, fixed(x, 2)), ' mm'),
      h('span', null, 'y ', h('b', null, fixed(y, 2)), ' mm'),
      h('span', null, '\u03b8 ', h('b', { 'data-theta': theta }, fixed(theta, 1)), '\u00b0'),
      leg
        ? h(
            'span',
            { class: 'event' },
            h('b', null, leg.event),
            `: ${kMotions[leg.motion] ?? leg.motion}`,
            touches.some((c) => c.sticks) ? ', a contact sticks' : '',
          )
        : '',
    );
  }

  const pickedWords = h('p', { class: 'small picked-words', id: 'picked-words', hidden: true });
  const node = h(
    'div',
    { class: `animation ${path.outcome}`, id: 'animation' },
    h(
      'p',
      { class: 'verdict' },
      badge(path.outcome),
      ' ',
      h('strong', null, `${path.aspect}, started at ${degrees(path.start_deg)}`),
      path.is_goal ? [' ', h('span', { class: 'goal' }, 'goal')] : '',
      path.reason ? `: ${path.reason}.` : '',
    ),
    timed.controls,
    timed.stage,
    timed.slider,
    h('div', { class: 'steps screen', 'aria-label': 'Events of the path' }, steps),
    pickedWords,
    legend(turning.friction > 0),
  );
  return {
    node,
    pause: timed.pause,
    run() {
      timed.show(0);
      timed.run();
    },
    pick(facet, placement) {
      picked = facet ? { facet, placement } : null;
      pickedWords.hidden = !picked;
      pickedWords.textContent = picked ? `Dotted: the placement picked below, ${facet.label}.` : '';
      redrawPicked();
    },
  };
}

// A picture of a motion is best where the part turns most: the middle of that leg.
function opening(path, way) {
  let best = [-1, 0];
  path.legs.forEach((leg, i) => {
    const next = path.legs[i + 1]?.from ?? path.points.length - 1;
    const turn = Math.abs(path.points[next][2] - path.points[leg.from][2]);
    if (leg.contacts.length && turn > best[0]) best = [turn, (way.starts[i] + (way.starts[i + 1] ?? way.length)) / 2];
  });
  return best[1];
}

const lineOf = (points, view) =>
  points.length
    ? `M${points
        .map((p) =>
          view
            .to(p)
            .map((v) => v.toFixed(2))
            .join(),
        )
        .join('L')}`
    : '';

function legend(hasFriction) {
  const item = (cls, text) => h('span', null, h('i', { class: `key ${cls}`, 'aria-hidden': 'true' }), text);
  return h(
    'p',
    { class: 'legend' },
    item('part', 'part'),
    item('supported', 'part on metal'),
    item('com', 'centre of mass and its way'),
    item('contact', 'contact that slides, with its normal'),
    item('contact sticks', 'contact that sticks'),
    hasFriction ? item('cone', 'friction cone') : null,
  );
}
