// From pose to pose through each feature, and how much the outcome hangs on how readily the part turns.

import { h } from './dom.js';
import { fixed, percent, short } from './format.js';

const shade = (p) =>
  p > 0 ? `background: rgb(0 98 163 / ${(0.08 + 0.62 * p).toFixed(3)}); ${p > 0.6 ? 'color: #fff' : ''}` : '';

export function transitionTables({ poses, features }) {
  const heads = poses.map((pose) => pose.replace(' deg', '\u00b0'));
  return h(
    'div',
    { class: 'matrices', id: 'transitions' },
    features.map(({ name, matrix }) =>
      h(
        'table',
        { class: 'matrix' },
        h('caption', null, name),
        h(
          'thead',
          null,
          h(
            'tr',
            null,
            h('th', { scope: 'col' }, 'in \\ out'),
            heads.map((pose) => h('th', { scope: 'col' }, pose)),
            h('th', { scope: 'col', class: 'lost' }, 'lost'),
          ),
        ),
        h(
          'tbody',
          null,
          matrix.map((row, i) => {
            const lost = Math.max(0, 1 - row.reduce((sum, p) => sum + p, 0));
            return h(
              'tr',
              null,
              h('th', { scope: 'row' }, heads[i]),
              row.map((p, j) =>
                h(
                  'td',
                  { style: shade(p), title: `${heads[i]} leaves as ${heads[j]}: ${percent(p)}` },
                  p > 0 ? fixed(p, 2) : '\u00b7',
                ),
              ),
              h('td', { class: 'lost' }, lost > 5e-7 ? fixed(lost, 2) : '\u00b7'),
            );
          }),
        ),
      ),
    ),
  );
}

export function sensitivityWords(rows) {
  const held = rows.every((row) => row.same_outcomes);
  return h(
    'div',
    { class: 'sensitivity', id: 'sensitivity' },
    h(
      'p',
      { class: 'small' },
      'How readily a part turns against how readily it slides is not known well (its radius of gyration on the track). ',
      held
        ? 'Over the factors tried on it, every outcome stays the same.'
        : 'Over the factors tried on it, outcomes change: rely on this design only after a trial.',
    ),
    h(
      'table',
      { class: 'plain' },
      h('tbody', null, [
        h(
          'tr',
          null,
          h('th', { scope: 'row' }, 'Radius of gyration'),
          rows.map((r) => h('td', { class: 'num' }, `\u00d7 ${short(r.gyration_factor, 2)}`)),
        ),
        h(
          'tr',
          null,
          h('th', { scope: 'row' }, 'Outcomes'),
          rows.map((r) =>
            h('td', { class: r.same_outcomes ? 'num' : 'num changed' }, r.same_outcomes ? 'same' : 'change'),
          ),
        ),
        h(
          'tr',
          null,
          h('th', { scope: 'row' }, 'Parts that end otherwise'),
          rows.map((r) => h('td', { class: 'num' }, percent(r.changed_probability))),
        ),
      ]),
    ),
  );
}
