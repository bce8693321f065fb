// The part and the fixed shapes of a problem as drawn: the start without errors.

import { h, onWidth, s } from './dom.js';
import { boxOf, pathOf } from './geometry.js';
import { drawJoint } from './insertion_travel.js';
import { makeView, placedBy, scaleBar } from './scene.js';

// Of the knee, else of the first design that has pictures.
export function drawnJoint(report) {
  const design = report.designs.find((d) => d.id === report.knee?.id && d.joint) ?? report.designs.find((d) => d.joint);
  if (!design) return null;
  const { joint } = design;
  const stage = h('div', { class: 'plot' });
  onWidth(stage, (px) => {
    const moved = joint.part.map((loop) => loop.map(([x, y]) => [x + joint.centre_mm[0], y + joint.centre_mm[1]]));
    const box = boxOf([...joint.fixed, ...moved]);
    const scale = Math.min(px / (box.xMax - box.xMin + 2), 260 / (box.yMax - box.yMin + 2));
    const frame = { xMin: box.xMin - 1, xMax: box.xMax + 1, yMin: box.yMin - 1, yMax: box.yMax + 1 };
    const view = makeView(frame.xMin, frame.yMax, scale, (px - scale * (frame.xMax - frame.xMin)) / 2, 0);
    const { node, inside } = drawJoint(joint.fixed, frame, view);
    const d = pathOf(joint.part, view.to);
    inside.append(
      s(
        'g',
        { class: 'part', transform: placedBy(view, ...joint.centre_mm, 0) },
        s('path', { class: 'area', d, 'fill-rule': 'evenodd' }),
        s('path', { class: 'outline', d, 'fill-rule': 'evenodd' }),
      ),
      s('path', {
        class: 'centre-cross',
        d: 'M-6,0h12M0,-6v12',
        transform: `translate(${view.to(joint.centre_mm)})`,
      }),
    );
    const bottom = view.y(frame.yMin);
    stage.replaceChildren(
      s(
        'svg',
        {
          viewBox: `0 0 ${px} ${bottom + 24}`,
          role: 'img',
          'aria-label': 'The part as drawn, before the fixed shapes',
        },
        node,
        scaleBar(view, 4, bottom + 16),
      ),
    );
  });
  return h(
    'figure',
    { class: 'drawn-joint' },
    stage,
    h('figcaption', null, `As drawn, with the shapes of design ${design.id}; the cross is the compliance centre.`),
  );
}
