// Right and wrong side by side: how deep the right insertion goes, and every insertion that must not succeed.

import { h, onWidth, s } from './dom.js';
import { degrees, mm, short } from './format.js';
import { boxOf, pathOf } from './geometry.js';
import { heldLoops, placedLoops } from './insertion_path.js';
import { drawJoint } from './insertion_travel.js';
import { badge } from './poses.js';
import { makeView, placedBy } from './scene.js';

const kTall = 220; // px

// The start nearest to the middle of the box.
export function middleStart({ region, insertions }) {
  if (!region) return 0;
  const middle = (range) => (range[0] + range[1]) / 2;
  const size = (range) => range[1] - range[0] || 1;
  const far = (one) =>
    Math.hypot(
      (one.x_mm - middle(region.x_mm)) / size(region.x_mm),
      (one.theta_deg - middle(region.theta_deg)) / size(region.theta_deg),
    );
  return insertions.reduce((best, one, i) => (far(one) < far(insertions[best]) ? i : best), 0);
}

const nameOf = (never) => `${never.aspect === 'down' ? 'turned over' : 'as drawn'}, ${degrees(never.orientation_deg)}`;

function provedWords(never) {
  if (never.proved)
    return `proved: no start of its box can get deeper than ${mm(never.bound_mm, 2)}, by free space alone`;
  const starts = `${short(never.starts, 0)} ${never.starts === 1 ? 'start' : 'starts'} projected`;
  return `${never.holds ? 'only projected' : 'it goes in'}: ${starts}, nothing proved${never.why ? ` (${never.why})` : ''}`;
}

export function wrongWays(joint, goal) {
  const right = joint.insertions[middleStart(joint)];
  const shown = [
    ...(right
      ? [{ title: 'The right way', insertion: right, mirrored: false, says: 'from the middle of the starts' }]
      : []),
    ...joint.never.map((never) => ({
      title: `Never: ${nameOf(never)}`,
      insertion: never.insertion,
      mirrored: never.mirrored,
      never,
      says: provedWords(never),
    })),
  ];
  const frame = frameOfAll(joint, shown);
  return h(
    'div',
    { class: 'wrong-ways', id: 'wrong-ways' },
    shown.map((one) => card(one, joint, goal, frame)),
    joint.never.length ? null : h('p', { class: 'empty' }, 'No way to insert the part was named as wrong.'),
  );
}

// One frame for all, so that depths compare.
function frameOfAll(joint, shown) {
  const parts = shown.flatMap(({ insertion, mirrored }) =>
    insertion?.moments.length ? placedLoops(heldLoops(joint.part, mirrored), insertion.moments.at(-1).q) : [],
  );
  const near = boxOf(parts.length ? parts : joint.fixed);
  const all = boxOf(joint.fixed);
  const spare = 0.2 * (near.xMax - near.xMin);
  return {
    xMin: Math.min(near.xMin, Math.max(all.xMin, near.xMin - spare)) - 1,
    xMax: Math.max(near.xMax, Math.min(all.xMax, near.xMax + spare)) + 1,
    yMin: Math.min(near.yMin, Math.max(all.yMin, near.yMin - spare)) - 1,
    yMax: near.yMax + 1,
  };
}

function card({ title, insertion, mirrored, never, says }, joint, goal, frame) {
  const stage = h('div', { class: 'plot' });
  const last = insertion?.moments.at(-1);
  if (last)
    onWidth(
      stage,
      (px) => {
        const scale = Math.min(px / (frame.xMax - frame.xMin), kTall / (frame.yMax - frame.yMin));
        const inset = (px - scale * (frame.xMax - frame.xMin)) / 2;
        const view = makeView(frame.xMin, frame.yMax, scale, inset, 0);
        const { node, inside } = drawJoint(joint.fixed, frame, view);
        const d = pathOf(heldLoops(joint.part, mirrored), view.to);
        const body = (cls) => s('path', { class: cls, d, 'fill-rule': 'evenodd' });
        inside.append(s('g', { class: 'part', transform: placedBy(view, ...last.q) }, body('area'), body('outline')));
        stage.replaceChildren(
          s(
            'svg',
            {
              viewBox: `0 0 ${px} ${view.y(frame.yMin)}`,
              class: `insertion ${insertion.outcome}`,
              role: 'img',
              'aria-label': `${title}: the part at its last moment`,
            },
            node,
          ),
        );
      },
      2,
    );
  return h(
    'figure',
    { class: never ? (never.holds ? 'way never' : 'way never fails') : 'way', 'data-way': never ? 'never' : 'right' },
    h('h4', null, title),
    stage,
    h(
      'figcaption',
      null,
      insertion ? badge(insertion.outcome) : null,
      ' ',
      never
        ? [
            h('b', null, never.holds ? '\u2713 it holds' : '\u2715 it does not hold'),
            `, deepest ${mm(never.deepest_mm, 2)} of the goal\u2019s ${mm(goal.depth_mm, 2)}; `,
          ]
        : insertion
          ? `deepest ${mm(insertion.deepest_mm, 2)} of the goal\u2019s ${mm(goal.depth_mm, 2)}; `
          : '',
      says,
      '.',
    ),
  );
}
