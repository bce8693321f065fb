// What was asked: the part, the track, the goal, what may vary.

import { h } from './dom.js';
import { degrees, measure, percent, short, whole } from './format.js';
import { kindOf } from './kinds.js';
import { aspectPictures } from './poses.js';

const capital = (word) => word.replace(/^./, (c) => c.toUpperCase());
const fact = (name, ...value) => [h('dt', null, name), h('dd', null, ...value)];

function goalWords(goal) {
  const what = goal.one_pose
    ? 'let exactly one pose through, whichever arrives most often'
    : `let the part through as ${goal.aspect === 'any' ? 'any aspect' : `\u201c${goal.aspect}\u201d`} at ${degrees(goal.orientation_deg)}`;
  return `${what}; every other pose must leave the track${goal.require_tip ? ' and have time to tip' : ''}`;
}

const trackFacts = (e, part) => [
  fact(
    'Track',
    `${short(e.track_width_mm)} mm wide, ${e.tilt_deg === 0 ? 'level' : `tilted ${short(e.tilt_deg)}\u00b0 towards the wall`}; parts move at ${short(e.conveying_speed_mm_s)} mm/s`,
  ),
  fact(
    'Spacing',
    `${e.spacing_mm === null ? `${short(part?.diameter_mm, 2)} mm (the part\u2019s diameter)` : `${short(e.spacing_mm)} mm`} between features, unless placed`,
  ),
  fact(
    'Settling',
    e.settling_friction === 0
      ? 'poses arrive as without friction at the wall'
      : `poses arrive as with friction ${short(e.settling_friction)} at the wall`,
  ),
];

export function asked(report) {
  const {
    environment: e,
    goal,
    manufacture: m,
    uncertainty: u,
    objectives,
    variables,
    topologies,
    topology_count: count, // a grammar's are listed only where designs shown have them
    text,
  } = report.problem;
  const kind = kindOf(report);
  const part = report.parts[0];
  const facts = h(
    'dl',
    { class: 'facts' },
    kind.facts ? kind.facts(report.problem).map(([name, words]) => fact(name, words)) : fact('Goal', goalWords(goal)),
    fact(
      'Ranked by',
      objectives.map((o, i) => [
        i ? ', ' : '',
        h(
          'span',
          { title: measure(o.name).says },
          `${measure(o.name).title.toLowerCase()} (${o.maximise ? 'more' : 'less'} is better)`,
        ),
      ]),
    ),
    kind.facts ? null : trackFacts(e, part),
    m && (m.cutter_radius_mm !== null || m.min_web_mm !== null)
      ? fact(
          'Manufacture',
          [
            m.cutter_radius_mm !== null ? `cutter radius ${short(m.cutter_radius_mm)} mm` : null,
            m.min_web_mm !== null ? `webs at least ${short(m.min_web_mm)} mm` : null,
          ]
            .filter(Boolean)
            .join(', '),
        )
      : null,
    u
      ? fact(
          'Uncertainty',
          [
            ['outline_mm', 'outline'],
            ['com_mm', 'centre of mass'],
            ['feature_mm', 'features'],
          ]
            .filter(([key]) => u[key] > 0)
            .map(([key, word]) => `${word} \u00b1${short(u[key])} mm`)
            .concat(Object.entries(u.intervals ?? {}).map(([name, [a, b]]) => `${name} ${short(a)} to ${short(b)}`))
            .join(', '),
        )
      : null,
    count === 1
      ? fact(capital(kind.word), topologies[0].label)
      : fact(
          `${whole(count)} choices of ${kind.word}`,
          h(
            'ul',
            { class: 'inline' },
            topologies.slice(0, 12).map((t) => h('li', null, t.label)),
            count > 12
              ? h('li', { class: 'faint' }, `and ${whole(count - Math.min(12, topologies.length))} more`)
              : null,
          ),
        ),
  );
  return [
    h('h2', { id: 'asked-title' }, 'What was asked'),
    h(
      'div',
      { class: 'asked' },
      h(
        'div',
        null,
        h('div', { class: 'aspects' }, part ? aspectPictures(part) : (kind.picture?.(report) ?? null)),
        part
          ? h(
              'p',
              { class: 'small' },
              `${part.aspects
                .map((a) => `${short(a.height_mm)} mm`)
                .filter((v, i, all) => all.indexOf(v) === i)
                .join(' / ')} thick; outlines as written in the problem, dimensions in mm, `,
              'quartered circle: centre of mass.',
            )
          : null,
      ),
      h(
        'div',
        null,
        facts,
        details('Variables and their bounds', variablesTable(variables, topologies, count)),
        details('The problem as run (JSON)', h('pre', { class: 'json' }, pretty(text))),
      ),
    ),
    kind.section ? null : posesLine(part),
  ];
}

function posesLine(part) {
  if (!part || part.poses.length === 0)
    return h('p', { class: 'empty' }, 'The part rests stably against the wall in no pose.');
  return h(
    'p',
    { class: 'small' },
    `It arrives in ${part.poses.length} stable poses: `,
    part.poses.map((p, i) => [i ? ', ' : '', `${p.aspect} ${degrees(p.orientation_deg)} (${percent(p.prior)})`]),
    '.',
  );
}

function details(title, content) {
  return content && h('details', null, h('summary', null, title), content);
}

function variablesTable(variables, topologies, count) {
  const counted = topologies.length > 1 && topologies.length === count;
  if (variables.length === 0) return h('p', { class: 'small' }, 'None: the designs are fixed.');
  return h(
    'table',
    { class: 'plain' },
    h(
      'thead',
      null,
      h(
        'tr',
        null,
        ['Variable', 'least', 'most', 'guess'].map((t, i) => h('th', { scope: 'col', class: i ? 'num' : null }, t)),
        counted ? h('th', { scope: 'col', class: 'num' }, 'used by') : null,
      ),
    ),
    h(
      'tbody',
      null,
      variables.map((v) =>
        h(
          'tr',
          null,
          h('th', { scope: 'row' }, v.name),
          [v.min, v.max, v.value].map((x) => h('td', { class: 'num' }, short(x, 4))),
          counted
            ? h(
                'td',
                { class: 'num' },
                `${topologies.filter((t) => t.variables.includes(v.name)).length} of ${topologies.length}`,
              )
            : null,
        ),
      ),
    ),
  );
}

function pretty(text) {
  try {
    return JSON.stringify(JSON.parse(text), null, 1);
  } catch {
    return text;
  }
}
