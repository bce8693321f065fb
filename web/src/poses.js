// Every pose as a small picture at the instant that decides it, with its outcome, prior and margin.

import { h, s } from './dom.js';
import { degrees, fixed, mm, outcome, percent, poseName } from './format.js';
import { boxOf, loopsOf, pathOf } from './geometry.js';
import { outlineOf } from './path.js';
import { drawCentre, drawPart, drawTrack, makeView } from './scene.js';
import { supportAt } from './travel.js';

const kAside_mm = 3;

// Where a pose is shown at rest: the deciding instant, or the middle of the track; before all that may turn it.
export function restingPlace(result, design, pose) {
  if (design.turning) {
    const starts = design.track.map((f) => f.start_mm);
    return Math.min(boxOf(design.turning.obstacles.map(outlineOf)).xMin, ...starts) - pose.x_max_mm - 1;
  }
  if (result.decided_by) return result.decided_by.x_mm;
  const xs = design.track.flatMap((f) => [f.start_mm, f.end_mm]);
  return xs.length ? (Math.min(...xs) + Math.max(...xs)) / 2 : 0;
}

export function marginWords(result) {
  if (result.margin_mm === null) return 'no margin';
  return result.outcome === 'delivered' ? `least margin ${mm(result.margin_mm)}` : `lost by ${mm(result.margin_mm)}`;
}

export function decidedWords(result, design) {
  if (!result.decided_by) return 'decided by the plain track';
  const { feature, x_mm } = result.decided_by;
  return `decided at x = ${fixed(x_mm, 2)} mm, feature ${feature} (${design.track[feature]?.type})`;
}

export function badge(name) {
  const { word, sign } = outcome(name);
  return h('span', { class: `badge ${word}` }, h('span', { 'aria-hidden': 'true' }, sign), ` ${word}`);
}

export function poseCards(design, part, width, state) {
  const tallest = Math.max(...part.poses.map((p) => boxOf([p.footprint.outer_mm]).yMax), 0);
  const longest = Math.max(...part.poses.map((p) => p.x_max_mm - p.x_min_mm), 1);
  const size = { across: longest + 2 * kAside_mm, up: Math.max(width, tallest) + kAside_mm };
  const cards = design.poses.map((result, i) => card(result, i, design, part.poses[i], width, size, state));
  const mark = () => cards.forEach((c, i) => c.setAttribute('aria-pressed', String(i === state.get('pose'))));
  mark();
  return { node: h('div', { class: 'cards', id: 'poses' }, cards), mark };
}

function card(result, index, design, pose, width, size, state) {
  const isGoal = index === design.goal_pose;
  return h(
    'button',
    {
      type: 'button',
      class: `card ${result.outcome}`,
      'data-pose': index,
      title: result.reason,
      onclick: () => state.set('pose', index),
    },
    thumbnail(result, index, design, pose, width, size),
    h(
      'span',
      { class: 'facts' },
      h(
        'span',
        { class: 'line' },
        h('strong', null, poseName(result)),
        isGoal ? h('span', { class: 'goal' }, 'goal') : null,
      ),
      h(
        'span',
        { class: 'line' },
        badge(result.outcome),
        result.may_catch ? h('span', { class: 'flag' }, '\u26a0 nose may catch') : null,
        result.marginal ? h('span', { class: 'flag' }, '\u26a0 marginal') : null,
      ),
      h(
        'span',
        { class: 'line' },
        `arrives ${percent(result.prior)}`,
        design.turning && (result.exit_orientation_deg ?? null) !== null
          ? `, leaves at ${degrees(result.exit_orientation_deg)}`
          : '',
      ),
      design.turning && result.margin_mm === null ? null : h('span', { class: 'line' }, marginWords(result)),
      h(
        'span',
        { class: 'line small' },
        design.turning && !result.decided_by ? result.reason : decidedWords(result, design),
      ),
    ),
  );
}

function thumbnail(result, index, design, pose, width, size) {
  const px = 148;
  const scale = px / size.across;
  const x = restingPlace(result, design, pose);
  const middle = x + (pose.x_min_mm + pose.x_max_mm) / 2;
  const [from, to] = [middle - size.across / 2, middle + size.across / 2];
  const view = makeView(from, size.up, scale, 0, 0);
  const svg = s('svg', {
    viewBox: `0 0 ${px} ${view.y(0) + 9}`,
    width: px,
    class: `thumb ${result.outcome}`,
    role: 'img',
    'aria-label': `Pose ${poseName(result)} with its centre of mass at x = ${fixed(x, 2)} mm, rotated ${degrees(result.orientation_deg)}`,
  });
  const { group, clip } = drawTrack(design.track, width, from, to, view);
  const body = drawPart(pose, view, clip);
  body.move(x);
  const centre = drawCentre(pose, view, 3);
  centre.setAttribute('transform', `translate(${x * scale},0)`);
  svg.append(group, body.node);
  const travel = design.travel?.[index];
  if (travel) {
    const { hull } = supportAt(pose, travel, x);
    svg.append(s('path', { class: 'hull', d: pathOf([hull], ([px_, py]) => view.to([px_ + x, py])) }));
  }
  svg.append(centre);
  return svg;
}

// The part as it arrives, for the page's first section: one picture an aspect, to one scale.
export function aspectPictures(part) {
  const boxes = part.aspects.map((a) => boxOf([a.footprint.outer_mm, ...a.upper.map((u) => u.outer_mm)]));
  const scale = Math.min(
    5,
    150 / Math.max(...boxes.map((b) => b.xMax - b.xMin)),
    150 / Math.max(...boxes.map((b) => b.yMax - b.yMin)),
  );
  return part.aspects.map((aspect, i) => {
    const box = boxes[i];
    const [w, t] = [box.xMax - box.xMin, box.yMax - box.yMin];
    const view = makeView(box.xMin, box.yMax, scale, 40, 8);
    const bottom = view.y(box.yMin);
    const at = { com_y_mm: 0, supported_y_mm: 0 };
    return h(
      'figure',
      { class: 'aspect' },
      s(
        'svg',
        {
          viewBox: `0 0 ${w * scale + 52} ${bottom + 26}`,
          width: w * scale + 52,
          role: 'img',
          'aria-label': `Part, aspect ${aspect.name}`,
        },
        s('path', { class: 'area', d: pathOf(loopsOf(aspect.footprint), view.to), 'fill-rule': 'evenodd' }),
        aspect.upper.map((u) => s('path', { class: 'upper', d: pathOf(loopsOf(u), view.to), 'fill-rule': 'evenodd' })),
        drawCentre(at, view, 4),
        s(
          'g',
          { class: 'dimension' },
          s('path', {
            class: 'lines',
            d:
              `M${view.x(box.xMin)},${bottom + 5}v8m0,-4H${view.x(box.xMax)}m0,-4v8` +
              `M35,${view.y(box.yMin)}h-8m4,0V${view.y(box.yMax)}m-4,0h8`,
          }),
          s('text', { x: view.x((box.xMin + box.xMax) / 2), y: bottom + 22, 'text-anchor': 'middle' }, fixed(w, 2)),
          s(
            'text',
            {
              x: 20,
              y: view.y((box.yMin + box.yMax) / 2),
              'text-anchor': 'middle',
              transform: `rotate(-90 20 ${view.y((box.yMin + box.yMax) / 2)})`,
            },
            fixed(t, 2),
          ),
        ),
      ),
      h('figcaption', null, `aspect \u201c${aspect.name}\u201d, arrives ${percent(aspect.probability)}`),
    );
  });
}
