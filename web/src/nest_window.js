// How hard a table may shake a pallet, and must.

import { scaleLinear } from 'd3-scale';

import { h, onWidth, s } from './dom.js';
import { fixed, mm, percent, short } from './format.js';

const kRow = 26;
const kMargin = { left: 12, right: 12, top: 22 };

// table: problem.nest.table; shaken: checks of that name of the design's stamp.
export function nestWindow(window, table, stamp) {
  if (!window || !table) return null;
  const shaken = (stamp?.checks ?? []).filter((check) => check.name === 'shaken');
  const { keeps_up_to_amplitude_mm: keeps, loses_from_amplitude_mm: loses } = window;
  const figure = (title, value, key) => h('div', null, h('dt', null, title), h('dd', { 'data-window': key }, value));
  return h(
    'div',
    { id: 'window' },
    h(
      'dl',
      { class: 'figures' },
      figure('Amplitude as given', mm(table.amplitude_mm, 3), 'given'),
      figure('Seat keeps up to', mm(keeps, 3), 'keeps'),
      figure('Wrong rests lose from', loses === null ? 'not known' : mm(loses, 3), 'loses'),
      figure('Throws up to', mm(window.throws_mm, 2), 'throws'),
      figure(
        'Drops for each part',
        window.drops_per_part === null ? 'never filled' : fixed(window.drops_per_part, 2),
        'drops',
      ),
      figure('Right parts', percent(window.right_share), 'right'),
    ),
    bar(keeps, loses, table),
    h('p', { class: 'small' }, windowWords(keeps, loses, table)),
    h(
      'p',
      { class: 'small', id: 'window-honest' },
      'The keeping side is a bound for point masses on level floors and a heuristic for bodies that turn. The losing side says only that a part can be thrown ',
      'as high as a way out rises; it says nothing about how fast wrong parts leave: ',
      h('code', null, 'formotion verify'),
      ' simulates that. Drops for each part, and the share of right ones, are for pockets that are filled again whenever their part leaves.',
    ),
    shaken.map((check) =>
      h(
        'p',
        { class: check.holds ? 'shaken' : 'shaken bad', 'data-shaken': check.holds },
        h('b', null, check.holds ? '\u2713 Simulated: ' : '\u2715 Simulated: '),
        check.says ?? '',
      ),
    ),
    shaken.length ? null : h('p', { class: 'small' }, 'Nothing has been simulated yet for this design.'),
  );
}

function windowWords(keeps, loses, { amplitude_mm: given, frequency_hz: hz }) {
  const at = `At ${short(hz)} Hz and ${short(given)} mm`;
  if (keeps === null) return `${at}: there is no bound on the amplitude that the seat keeps its part at.`;
  const isKept = given <= keeps;
  const seat = isKept ? 'the seat keeps its part' : 'the seat may lose its part';
  if (loses === null) return `${at}, ${seat}; a wrong rest has no known way out, so nothing is said about losing.`;
  const wrong = given >= loses ? 'every wrong rest can lose its part' : 'some wrong rest keeps its part or may keep it';
  const span =
    loses <= keeps
      ? `Amplitudes from ${mm(loses, 3)} to ${mm(keeps, 3)} do both.`
      : 'No amplitude at this frequency does both.';
  return `${at}, ${seat} and ${wrong}. ${span}`;
}

function bar(keeps, loses, table) {
  const plot = h('div', { class: 'plot window-plot' });
  const values = [keeps, loses, table.amplitude_mm].filter((v) => v !== null);
  const most = 1.3 * Math.max(...values, 1e-3);
  onWidth(
    plot,
    (px) => {
      const x = scaleLinear([0, most], [kMargin.left, px - kMargin.right]);
      const rows = [
        { cls: 'keeps', from: 0, to: keeps ?? most, words: 'the seat keeps its part' },
        {
          cls: 'loses',
          from: loses ?? most,
          to: most,
          words: loses === null ? 'not known when wrong rests lose theirs' : 'wrong rests can lose theirs',
        },
      ];
      const bottom = kMargin.top + 2 * kRow + 6;
      const both = keeps !== null && loses !== null && loses <= keeps;
      const given = x(table.amplitude_mm);
      plot.replaceChildren(
        s(
          'svg',
          {
            viewBox: `0 0 ${px} ${bottom + 40}`,
            class: 'window-bar',
            role: 'img',
            'aria-label': 'Amplitudes at which the seat keeps its part, and at which wrong rests can lose theirs',
          },
          both
            ? s('rect', {
                class: 'both',
                x: x(loses),
                width: Math.max(1, x(keeps) - x(loses)),
                y: kMargin.top - 4,
                height: 2 * kRow + 10,
              })
            : null,
          rows.map(({ cls, from, to, words }, i) => {
            const y = kMargin.top + i * kRow;
            const [a, b] = [x(from), x(to)];
            const leftHalf = a < px / 2;
            return [
              s('line', { class: 'rail-line', x1: x(0), x2: x(most), y1: y + kRow / 2, y2: y + kRow / 2 }),
              s('rect', { class: cls, x: a, y: y + 4, width: Math.max(0, b - a), height: kRow - 8 }),
              s(
                'text',
                {
                  class: 'bar-words',
                  x: leftHalf ? a + 6 : Math.min(a, px - kMargin.right) - 6,
                  'text-anchor': leftHalf ? 'start' : 'end',
                  y: y + kRow / 2 + 4,
                },
                words,
              ),
            ];
          }),
          s('path', { class: 'given', d: `M${given},${kMargin.top - 6}V${bottom}` }),
          s(
            'text',
            { class: 'given-words', x: Math.max(30, Math.min(px - 30, given)), y: 12, 'text-anchor': 'middle' },
            'as given',
          ),
          s('line', { class: 'base', x1: x(0), x2: x(most), y1: bottom, y2: bottom }),
          x
            .ticks(6)
            .map((v) => [
              s('line', { class: 'base', x1: x(v), x2: x(v), y1: bottom, y2: bottom + 4 }),
              s('text', { class: 'tick', x: x(v), y: bottom + 17, 'text-anchor': 'middle' }, short(v)),
            ]),
          s(
            'text',
            { class: 'axis-title', x: px / 2, y: bottom + 34, 'text-anchor': 'middle' },
            `amplitude of the table at ${short(table.frequency_hz)} Hz (mm)`,
          ),
        ),
      );
    },
    1,
  );
  return plot;
}
