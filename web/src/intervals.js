// The intervals of starting orientations as a list, and what the ring's colours mean.

import { h } from './dom.js';
import { degrees, fixed, outcome } from './format.js';
import { badge } from './poses.js';

// choose(interval) on a click. Answers {node, mark(index)}.
export function intervalTable(intervals, choose) {
  const rows = intervals.map((interval) =>
    h(
      'tr',
      { 'data-interval': interval.index, onclick: () => choose(interval) },
      h('th', { scope: 'row' }, interval.aspect),
      h('td', { class: 'num' }, `${fixed(interval.from_deg, 2)}\u00b0`),
      h('td', { class: 'num' }, `${fixed(interval.to_deg, 2)}\u00b0`),
      h('td', null, badge(interval.outcome), interval.goal ? [' ', h('span', { class: 'goal' }, 'goal')] : ''),
      h(
        'td',
        { class: 'num' },
        interval.exit_orientation_deg === null ? '\u2013' : degrees(interval.exit_orientation_deg),
      ),
    ),
  );
  const heads = [
    ['Aspect', ''],
    ['from', 'num'],
    ['to', 'num'],
    ['Outcome', ''],
    ['leaves at', 'num'],
  ];
  return {
    node: h(
      'div',
      { class: 'intervals' },
      h(
        'table',
        { class: 'plain', id: 'intervals' },
        h(
          'thead',
          null,
          h(
            'tr',
            null,
            heads.map(([text, cls]) => h('th', { scope: 'col', class: cls || null }, text)),
          ),
        ),
        h('tbody', null, rows),
      ),
    ),
    mark: (index) =>
      rows.forEach((row) => row.setAttribute('aria-selected', String(Number(row.dataset.interval) === index))),
  };
}

export function ringLegend(intervals) {
  const present = new Set(
    intervals.map((i) => (i.outcome === 'delivered' ? (i.goal ? 'goal' : 'other exit') : i.outcome)),
  );
  const item = (cls, text) => h('span', null, h('i', { class: `key ring-key ${cls}`, 'aria-hidden': 'true' }), text);
  return h(
    'p',
    { class: 'legend' },
    present.has('goal') ? item('delivered is-goal', '\u2605 delivered in the goal\u2019s pose') : null,
    present.has('other exit') ? item('delivered other-exit', '\u2713 delivered otherwise') : null,
    ['rejected', 'jammed', 'ambiguous', 'undecided']
      .filter((name) => present.has(name))
      .map((name) => item(name, `${outcome(name).sign} ${name}`)),
  );
}
