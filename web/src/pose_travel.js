// A pose travels over the track: the part on the metal, its support hull, the centre of mass, the margin.

import { animation } from './animation.js';
import { h, s } from './dom.js';
import { fixed, mm, poseName, short } from './format.js';
import { boxOf, pathOf } from './geometry.js';
import { marginChart } from './margin_chart.js';
import { badge, decidedWords, marginWords, restingPlace } from './poses.js';
import { drawCentre, drawPart, drawTrack, makeView, scaleBar } from './scene.js';
import { marginCurve, supportAt, travelRange } from './travel.js';

const kSpeeds_mm_s = [5, 10, 20, 50, 100];
const kLost_mm = -1e-3; // numbers are rounded to 1e-4 mm

export function poseTravel(design, index, part, environment) {
  const result = design.poses[index];
  const pose = part.poses[index];
  const travel = design.travel?.[index] ?? null;
  const [from, to] = travelRange(pose, design.track);
  const start = restingPlace(result, design, pose);
  const width = environment.track_width_mm;
  const curve = travel && marginCurve(pose, travel, from, to);
  const firstLoss = result.outcome === 'delivered' ? null : (result.decided_by?.x_mm ?? null);

  const timed = animation({
    from,
    to,
    start,
    speeds: kSpeeds_mm_s.map((v) => [v, `${v} mm/s`]),
    speed: 20,
    steps: [0.1, 5],
    jump: { text: result.decided_by ? 'Deciding instant' : 'Middle', to: () => start },
    label: 'Position of the centre of mass along the track',
    makeStage,
  });

  function makeStage(px) {
    const [xFrom, xTo] = [from + pose.x_min_mm, to + pose.x_max_mm];
    const tall = Math.max(width, boxOf([pose.footprint.outer_mm]).yMax) + 1;
    const [left, right, top] = [52, 10, 6];
    const scale = Math.min((px - left - right) / (xTo - xFrom), 340 / tall);
    const inset = left + Math.max(0, (px - left - right - scale * (xTo - xFrom)) / 2);
    const view = makeView(xFrom, tall, scale, inset, top);
    const floor = view.y(0) + 12;
    const chartTop = floor + 30;
    const chartHeight = curve ? 110 : 0;
    const height = curve ? chartTop + chartHeight + 8 : floor + 24;
    const svg = s('svg', {
      viewBox: `0 0 ${px} ${height}`,
      class: `travel ${result.outcome}`,
      role: 'img',
      'aria-label': `Pose ${poseName(result)} over the track, to scale`,
    });
    const { group, clip } = drawTrack(design.track, width, xFrom, xTo, view);
    const body = drawPart(pose, view, clip);
    const hull = s('path', { class: 'hull' });
    const centre = drawCentre(pose, view, 5);
    svg.append(group, body.node, hull, centre, scaleBar(view, inset, floor + 16));
    const chart = curve && marginChart(curve, view, chartTop, chartHeight, result.decided_by?.x_mm ?? null);
    if (chart) svg.append(chart.node);
    if (result.decided_by) {
      const dx = view.x(start);
      svg.append(
        s(
          'g',
          { class: 'deciding-mark' },
          s('line', { class: 'deciding', x1: dx, x2: dx, y1: view.y(0) + 10, y2: chartTop }),
          s('text', { class: 'note', x: dx + 5, y: floor + 20 }, 'deciding instant'),
        ),
      );
    }
    return {
      svg,
      left: view.x(from),
      right: view.x(to),
      move(x) {
        const support = travel && supportAt(pose, travel, x);
        body.move(x);
        centre.setAttribute('transform', `translate(${x * scale},0)`);
        hull.setAttribute('d', support ? pathOf([support.hull], ([hx, hy]) => view.to([hx + x, hy])) : '');
        const lost = support ? (support.margin === null ? !support.held : support.margin < kLost_mm) : false;
        svg.classList.toggle('unsupported', lost);
        svg.classList.toggle('gone', firstLoss !== null && x > firstLoss + 0.05);
        chart?.move(x, support.margin);
        say(x, support);
      },
    };
  }

  function say(x, support) {
    const state = !support
      ? null
      : support.held
        ? 'held by the rail'
        : support.margin === null
          ? 'nothing under it'
          : support.margin < kLost_mm
            ? `supported point ${mm(-support.margin)} outside of the hull`
            : `supported point ${mm(Math.max(0, support.margin))} inside of the hull`;
    const gone = firstLoss !== null && x > firstLoss + 0.05;
    timed.readout.replaceChildren(
      h('span', null, 'x = ', h('b', { 'data-x': x }, fixed(x, 2)), ' mm'),
      state
        ? h(
            'span',
            { class: (support.margin !== null && support.margin >= kLost_mm) || support.held ? 'good' : 'bad' },
            h(
              'b',
              { 'data-margin': support.margin ?? '' },
              support.margin === null ? '' : `${support.margin < kLost_mm ? '\u2212' : '+'} `,
            ),
            state,
          )
        : '',
      gone ? h('span', { class: 'faint' }, `lost at x = ${fixed(firstLoss, 2)} mm: drawn on as if it went on`) : '',
    );
  }

  const tip =
    result.unsupported_mm === null
      ? null
      : `Unsupported travel ${mm(result.unsupported_mm, 2)}${
          result.tip_mm === null
            ? ''
            : `; its nose needs ${mm(result.tip_mm, 2)} to drop by 1 mm at ${short(environment.conveying_speed_mm_s)} mm/s`
        }.`;
  const node = h(
    'div',
    { class: `animation ${result.outcome}`, id: 'animation' },
    h(
      'p',
      { class: 'verdict' },
      badge(result.outcome),
      ' ',
      h('strong', null, poseName(result)),
      `: ${result.reason || marginWords(result)}.`,
    ),
    tip ? h('p', { class: 'small' }, tip) : null,
    travel
      ? null
      : h(
          'p',
          { class: 'note-box' },
          'This report holds the support hulls of other designs only, to stay small; the part\u2019s contact with the metal is drawn all the same.',
        ),
    timed.controls,
    timed.stage,
    timed.slider,
    legend(Boolean(travel), pose),
  );
  node.dataset.least = curve ? String(Math.min(...curve.map((p) => p.margin ?? Infinity))) : '';
  node.dataset.decided = decidedWords(result, design);
  return { node, pause: timed.pause };
}

function legend(hasHull, pose) {
  const item = (cls, text) => h('span', null, h('i', { class: `key ${cls}`, 'aria-hidden': 'true' }), text);
  const shifted = Math.abs(pose.com_y_mm - pose.supported_y_mm) > 1e-3;
  return h(
    'p',
    { class: 'legend' },
    item('part', 'part'),
    item('supported', 'part on metal'),
    hasHull ? item('hull', 'hull of the support') : null,
    item('com', 'centre of mass'),
    item(
      'target',
      shifted
        ? `supported point (centre of mass projected along gravity, ${mm(pose.com_y_mm - pose.supported_y_mm, 2)} nearer to the wall)`
        : 'supported point',
    ),
  );
}
