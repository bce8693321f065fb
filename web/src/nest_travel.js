// One rest and its lowest way out, moving: the part in the nest, the height of its centre of mass over the way. A set of
// equilibria is gone through in the same way.

import { scaleLinear } from 'd3-scale';

import { animation } from './animation.js';
import { h, s } from './dom.js';
import { fixed as digits, mm } from './format.js';
import { frameAround, gravityFrame, partLoops, unwound } from './nest_frame.js';
import { bodyAt, centreCross, gravityArrow, nestStage, stillPicture } from './nest_picture.js';
import { measured, reachOf } from './path.js';
import { placedBy, scaleBar } from './scene.js';

const kTall = 380; // px
const kSideBySide = 700; // px, from which on the chart stands beside the picture
const kMargin = { left: 46, right: 12, top: 26, bottom: 36 };

// show: {title, aspect, placements, lower_mm, is_way}; is_way: a way out, with its heights. moved(q): told of every
// move. Answers {node, pause, run}.
export function nestTravel(show, nest, fixed, moved) {
  const loops = partLoops(nest, show.aspect);
  const points = unwound(show.placements);
  const way = measured({ points, legs: [] }, reachOf(loops[0]));
  const { height } = gravityFrame(nest.gravity_deg);
  const rises = points.map((q) => height(q) - height(points[0]));
  const highest = rises.reduce((best, rise, i) => (rise > rises[best] ? i : best), 0);
  const length = Math.max(way.length, 1e-3);
  const pace = [0.03, 0.08, 0.15, 0.4].map((share) => share * length);

  if (!(way.length > 1e-6)) return standing(show, nest, fixed);

  const timed = animation({
    from: 0,
    to: length,
    start: 0,
    speeds: pace.map((v, i) => [v, ['very slow', 'slow', 'medium', 'fast'][i]]),
    speed: pace[2],
    steps: [0.005 * length, 0.1 * length],
    jump: show.is_way
      ? { text: 'To the highest point', to: () => way.along[highest] }
      : { text: 'Next place', to: (at) => way.along.find((x) => x > at + 1e-6) ?? 0 },
    label: show.is_way ? 'Way of the part' : 'Place within the set',
    makeStage,
  });

  function makeStage(px) {
    const beside = show.is_way && px >= kSideBySide;
    const wide = beside ? Math.round(0.58 * px) : px;
    const frame = frameAround(fixed, loops, points);
    const { view, node, inside, bottom } = nestStage(fixed, frame, wide, kTall);
    const ghost = bodyAt(loops, view, points[0], 'nest-start');
    const body = bodyAt(loops, view, points[0], 'part');
    const top = show.is_way ? bodyAt(loops, view, points[highest], 'nest-highest') : null;
    const centre = centreCross(view, points[0]);
    const trace = s('path', { class: 'nest-trace', d: `M${points.map((q) => view.to(q)).join('L')}` });
    const [hx, hy] = view.to(points[highest]);
    inside.append(ghost, ...(top ? [top] : []), body, trace, centre);
    if (show.is_way) inside.append(s('circle', { class: 'highest', cx: hx, cy: hy, r: 5 }));
    const area = beside
      ? { x: wide + 10, y: 0, width: px - wide - 10, height: Math.max(240, Math.min(kTall, bottom)) }
      : { x: 0, y: bottom + 30, width: px, height: 220 };
    const chart = show.is_way ? heightChart(area) : null;
    const svg = s(
      'svg',
      {
        viewBox: `0 0 ${px} ${Math.max(bottom + 26, chart ? area.y + area.height : 0)}`,
        class: 'nest-picture',
        role: 'img',
        'aria-label': `${show.title}: the part in the nest, to scale${show.is_way ? ', and its height over the way' : ''}`,
      },
      node,
      scaleBar(view, view.x(frame.xMin) + 4, bottom + 16),
      gravityArrow(nest.gravity_deg, view, frame),
      chart?.node,
    );
    return {
      svg,
      left: 12,
      right: px - 12,
      move(at) {
        const q = way.placement(at);
        body.setAttribute('transform', placedBy(view, ...q));
        centre.setAttribute('transform', `translate(${view.to(q)})`);
        const rise = height(q) - height(points[0]);
        chart?.move(at, rise);
        say(at, q, rise);
        moved?.(q, show.aspect);
      },
    };
  }

  function heightChart({ x: left, y: top, width, height: tall }) {
    const ceiling = Math.max(rises[highest], show.lower_mm ?? 0, 0.1) * 1.15;
    const floor = Math.min(0, ...rises);
    const x = scaleLinear([0, length], [left + kMargin.left, left + width - kMargin.right]);
    const y = scaleLinear([Math.max(floor, -0.6 * ceiling), ceiling], [top + tall - kMargin.bottom, top + kMargin.top]);
    const clamp = (v) => Math.max(v, y.domain()[0]);
    const dot = s('circle', { class: 'force-dot', r: 5 });
    const [x1, x2] = x.range();
    const at = x(way.along[highest]);
    const node = s(
      'g',
      { class: 'height-chart' },
      y
        .ticks(5)
        .map((v) => [
          s('line', { class: 'grid', x1, x2, y1: y(v), y2: y(v) }),
          s('text', { class: 'tick', x: x1 - 6, y: y(v) + 4, 'text-anchor': 'end' }, digits(v, v % 1 ? 1 : 0)),
        ]),
      show.lower_mm === null ? null : s('line', { class: 'bound', x1, x2, y1: y(show.lower_mm), y2: y(show.lower_mm) }),
      s('path', { class: 'curve', d: `M${rises.map((rise, i) => [x(way.along[i]), y(clamp(rise))]).join('L')}` }),
      s('circle', { class: 'highest', cx: at, cy: y(rises[highest]), r: 5 }),
      s(
        'text',
        {
          class: 'highest-words',
          x: Math.max(x1 + 30, Math.min(x2 - 30, at)),
          y: y(rises[highest]) - 9,
          'text-anchor': 'middle',
        },
        mm(rises[highest], 2),
      ),
      dot,
      s(
        'text',
        { class: 'axis-title', x: (x1 + x2) / 2, y: top + tall - 8, 'text-anchor': 'middle' },
        'way of the part from the rest outwards',
      ),
      s('text', { class: 'axis-title', x: left + 2, y: top + 12 }, 'height of the centre of mass over the rest (mm)'),
    );
    return {
      node,
      move(here, rise) {
        dot.setAttribute('cx', x(here));
        dot.setAttribute('cy', y(clamp(rise)));
      },
    };
  }

  function say(at, q, rise) {
    const number = (title, value, places, unit, key) =>
      h('span', null, `${title} `, h('b', { [`data-${key}`]: value }, digits(value, places)), unit);
    timed.readout.replaceChildren(
      number('rise', rise, 2, ' mm', 'rise'),
      number('x', q[0], 2, ' mm', 'x'),
      number('y', q[1], 2, ' mm', 'y'),
      number('turned', q[2], 1, '\u00b0', 'theta'),
      h('span', { hidden: true, 'data-at': at }),
    );
  }

  const keys = (cls, text) => h('span', null, h('i', { class: `key ${cls}`, 'aria-hidden': 'true' }), text);
  const node = h(
    'div',
    { class: 'animation', id: 'animation' },
    h('p', { class: 'verdict' }, h('strong', null, show.title), show.says ? `: ${show.says}` : ''),
    timed.controls,
    timed.stage,
    timed.slider,
    h(
      'p',
      { class: 'legend' },
      keys('part', 'part'),
      keys('carrier', show.is_way ? 'where it rests' : 'one end of the set'),
      show.is_way ? keys('highest', 'highest point of the way found') : null,
      show.is_way && show.lower_mm !== null ? keys('bound', 'no way out stays below this') : null,
    ),
  );
  return {
    node,
    pause: timed.pause,
    run() {
      timed.show(0);
      timed.run();
    },
  };
}

function standing(show, nest, fixed) {
  const stage = stillPicture(nest, fixed, show.aspect, [{ q: show.placements[0], cls: 'part' }], {
    tall: kTall,
    label: show.title,
    scaled: true,
  });
  const node = h(
    'div',
    { class: 'animation', id: 'animation' },
    h('p', { class: 'verdict' }, h('strong', null, show.title), show.says ? `: ${show.says}` : ''),
    stage,
  );
  return { node, pause() {}, run() {} };
}
