// What a later check of a design said (formotion verify).

import { h } from './dom.js';
import { counted } from './format.js';

export function stampSign(design) {
  if (!design.stamp) return null;
  return design.stamp.holds
    ? h('span', { class: 'stamp', title: 'verified' }, '\u2713')
    : h('span', { class: 'stamp fails', title: 'a check fails' }, '\u2715');
}

export function stampPill(design) {
  if (!design.stamp) return null;
  return design.stamp.holds
    ? h('span', { class: 'pill feasible', id: 'stamp' }, '\u2713 verified')
    : h('span', { class: 'pill infeasible', id: 'stamp' }, '\u2715 fails verification');
}

export function stampDetails(design) {
  const { stamp } = design;
  if (!stamp) return null;
  return h(
    'details',
    { id: 'verified', open: !stamp.holds },
    h(
      'summary',
      null,
      `Checked again by formotion verify: ${counted(stamp.checks.length, 'check', 'checks')}, ${stamp.holds ? 'all hold' : 'not all hold'}`,
    ),
    h(
      'table',
      { class: 'plain' },
      h(
        'tbody',
        null,
        stamp.checks.map((check) =>
          h(
            'tr',
            { class: check.holds ? null : 'bad' },
            h('th', { scope: 'row' }, `${check.holds ? '\u2713' : '\u2715'} ${check.name}`),
            h('td', null, check.says ?? ''),
          ),
        ),
      ),
    ),
  );
}
