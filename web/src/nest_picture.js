// The part in a nest, standing still.

import { h, onWidth, s } from './dom.js';
import { pathOf } from './geometry.js';
import { drawJoint } from './insertion_travel.js';
import { frameAround, gravityFrame, partLoops } from './nest_frame.js';
import { makeView, placedBy, scaleBar } from './scene.js';

const kArrow = 30; // px

// Fits a frame into a width and a height; answers the view, the svg nodes of the nest and where it ends below.
export function nestStage(fixed, frame, px, tall, left = 0) {
  const scale = Math.min((px - 4) / (frame.xMax - frame.xMin), tall / (frame.yMax - frame.yMin));
  const view = makeView(frame.xMin, frame.yMax, scale, left + (px - scale * (frame.xMax - frame.xMin)) / 2, 2);
  return { view, ...drawJoint(fixed, frame, view), bottom: view.y(frame.yMin) };
}

export function gravityArrow(gravity_deg, view, frame) {
  const { down } = gravityFrame(gravity_deg);
  const [x, y] = [view.x(frame.xMin) + 26, view.y(frame.yMax) + 26];
  const [dx, dy] = [down[0], -down[1]];
  const at = (along, aside) => `${x + along * dx - aside * dy},${y + along * dy + aside * dx}`;
  return s(
    'g',
    { class: 'gravity' },
    s('title', null, 'gravity'),
    s('path', { d: `M${at(-kArrow / 2, 0)}L${at(kArrow / 2, 0)}` }),
    s('path', { class: 'head', d: `M${at(kArrow / 2, 0)}L${at(kArrow / 2 - 9, 4)}L${at(kArrow / 2 - 9, -4)}Z` }),
    s('text', { x: x + 9, y: y + 4 }, 'g'),
  );
}

export function bodyAt(loops, view, q, cls) {
  const d = pathOf(loops, view.to);
  const body = (name) => s('path', { class: name, d, 'fill-rule': 'evenodd' });
  return s('g', { class: cls, transform: placedBy(view, ...q) }, body('area'), body('outline'));
}

export const centreCross = (view, q) =>
  s('path', { class: 'centre-cross', d: 'M-6,0h12M0,-6v12', transform: `translate(${view.to(q)})` });

// bodies: [{q, cls}], drawn in turn; a frame of its own unless one is given.
export function stillPicture(nest, fixed, aspect, bodies, { tall = 220, frame, columns = 1, label, scaled = false }) {
  const loops = partLoops(nest, aspect);
  const window =
    frame ??
    frameAround(
      fixed,
      loops,
      bodies.map(({ q }) => q),
    );
  const stage = h('div', { class: 'plot' });
  onWidth(
    stage,
    (px) => {
      const { view, node, inside, bottom } = nestStage(fixed, window, px, tall);
      inside.append(...bodies.map(({ q, cls }) => bodyAt(loops, view, q, cls)));
      const last = bodies.at(-1);
      if (last) inside.append(centreCross(view, last.q));
      stage.replaceChildren(
        s(
          'svg',
          {
            viewBox: `0 0 ${px} ${bottom + (scaled ? 24 : 2)}`,
            class: 'nest-picture',
            role: 'img',
            'aria-label': label,
          },
          node,
          scaled ? scaleBar(view, view.x(window.xMin) + 4, bottom + 16) : null,
          scaled ? gravityArrow(nest.gravity_deg, view, window) : null,
        ),
      );
    },
    columns,
  );
  return stage;
}

// The part in its seat, for the page's first section: of the knee, else of the first design that has pictures.
export function drawnNest(report) {
  const design = report.designs.find((d) => d.id === report.knee?.id && d.nest) ?? report.designs.find((d) => d.nest);
  if (!design?.nest.aspects.length) return null;
  const { nest, shapes } = design;
  const { seat } = nest;
  return h(
    'figure',
    { class: 'drawn-joint' },
    stillPicture(
      nest,
      shapes.nest_mm,
      seat.aspect,
      [{ q: [seat.x_mm, seat.y_mm, seat.orientation_deg], cls: 'part' }],
      {
        tall: 260,
        label: 'The part in its seat',
        scaled: true,
      },
    ),
    h('figcaption', null, `The part in its seat, in the nest of design ${design.id}; the cross is the centre of mass.`),
  );
}
