// This run beside another one of the same objectives.

import { h } from './dom.js';
import { measure, whole, withUnit } from './format.js';

export function comparison(report) {
  const other = report.compared;
  if (!other) return null;
  const best = (designs, k, maximise) =>
    designs.length === 0
      ? null
      : designs.map((d) => d.objectives[k]).reduce((a, b) => (maximise ? Math.max(a, b) : Math.min(a, b)));
  const own = report.designs.filter((d) => d.feasible);
  const rivals = other.designs.filter((d) => d.feasible);
  const row = (title, a, b) =>
    h('tr', null, h('th', { scope: 'row' }, title), h('td', { class: 'num' }, a), h('td', { class: 'num' }, b));
  const dominated = (designs, by) => designs.filter((d) => by.some((o) => dominates(report, o, d))).length;
  return h(
    'div',
    { id: 'comparison' },
    h('h3', null, 'Beside another run'),
    h(
      'table',
      { class: 'plain' },
      h(
        'thead',
        null,
        h(
          'tr',
          null,
          h('th', null),
          h('th', { scope: 'col', class: 'num' }, 'this run'),
          h('th', { scope: 'col', class: 'num' }, other.name),
        ),
      ),
      h(
        'tbody',
        null,
        row('evaluations', whole(report.run.evaluations), whole(other.evaluations)),
        row('seed', whole(report.run.seed), whole(other.seed)),
        row('non-dominated designs', whole(own.length), whole(rivals.length)),
        row('of them dominated by the other run', whole(dominated(own, rivals)), whole(dominated(rivals, own))),
        row(
          'hypervolume, in one box',
          withUnit('hypervolume', report.history.at(-1)?.hypervolume),
          withUnit('hypervolume', other.history.at(-1)?.hypervolume),
        ),
        report.problem.objectives.map((o, k) =>
          row(
            `best ${measure(o.name).title.toLowerCase()}`,
            withUnit(o.name, best(own, k, o.maximise)),
            withUnit(o.name, best(rivals, k, o.maximise)),
          ),
        ),
      ),
    ),
  );
}

function dominates(report, a, b) {
  const gains = report.problem.objectives.map((o, k) => (o.maximise ? 1 : -1) * (a.objectives[k] - b.objectives[k]));
  return gains.every((g) => g >= 0) && gains.some((g) => g > 0);
}
