// A chosen fixture or pallet: its rests and ways out, what becomes of every start, the landscape, the table.

import { h } from './dom.js';
import { landscapeMap } from './nest_landscape.js';
import { choices, restCards } from './nest_rests.js';
import { nestStarts, sureWords } from './nest_starts.js';
import { nestTravel } from './nest_travel.js';
import { nestWindow } from './nest_window.js';

const title = (id, text) => h('h3', { id }, text);
const small = (...words) => h('p', { class: 'small' }, ...words);

// asked: problem.nest. Answers {node, pause}.
export function nestSection(design, asked) {
  const { nest, shapes } = design;
  if (!nest?.aspects?.length)
    return { node: h('p', { class: 'empty' }, 'This report holds no pictures of this design.'), pause() {} };
  const fixed = shapes.nest_mm;
  const isPallet = asked.purpose === 'pallet';
  const list = choices(nest);
  const travel = h('div', { id: 'travel' });
  let running = null;
  const maps = (nest.landscape ?? []).map((land) => landscapeMap(land, nest, fixed, (index) => choose(index, false)));
  const cards = restCards(list, nest, fixed, (index) => choose(index, true));

  function choose(index, plays) {
    running?.pause();
    running = nestTravel(list[index], nest, fixed);
    cards.mark(index);
    maps.forEach((map) => map.mark(list[index].kind === 'rest' ? list[index].index : -1));
    travel.replaceChildren(running.node);
    if (plays) running.run();
  }

  const node = h(
    'div',
    { class: 'nest-section' },
    title('rests-title', isPallet ? 'Where parts can rest, and how they get out' : 'Where parts can rest'),
    small(
      isPallet
        ? 'Every place at which the height of the centre of mass is least, without friction. A way out must rise at least as high as the first number; the second is the rise of a way that was found. '
        : 'Every place at which the height of the centre of mass is least, without friction; and every other place at which friction can hold the part (wrong equilibria). ',
      h('span', { class: 'screen' }, isPallet ? 'Choose one to see its way out.' : 'Choose one to see it.'),
    ),
    list.length ? cards.node : h('p', { class: 'empty' }, 'The part rests nowhere in this nest.'),
    isPallet ? null : wrongWords(nest),
    travel,
    title('starts-title', 'What becomes of every start'),
    small(
      'Every point is a placement at which the part is let go, at rest; dots are starts that this report can show. ',
      sureWords(nest),
      ' ',
      h('span', { class: 'screen' }, 'Click, or use the arrow keys, to see the nearest one.'),
    ),
    nestStarts(nest, fixed),
    title('landscape-title', 'All placements at once: the landscape of heights'),
    maps.length
      ? [
          small(
            'The part is lowered from above at a place across gravity, turned by an angle: the height over the seat at which it first touches. Without bounces and friction it sinks downhill, into the rest that the colour names. ',
            'To change over from one rest to another, or out, it must go over a pass. Places under an overhang are not in this picture. ',
            h('span', { class: 'screen' }, 'Click, or use the arrow keys, to see a placement.'),
          ),
          h(
            'div',
            { id: 'landscape' },
            maps.map((map) => map.node),
          ),
        ]
      : h(
          'p',
          { class: 'empty' },
          'This report leaves out the landscape of this design: it is shown for the first designs only.',
        ),
    isPallet
      ? [
          title('window-title', 'How hard the table may shake'),
          nestWindow(nest.window, asked.table, design.stamp) ??
            h('p', { class: 'empty' }, 'The problem names no table, so nothing is said about shaking.'),
        ]
      : null,
  );
  const first = list.findIndex(({ one }) => one.is_seat);
  if (list.length) choose(Math.max(0, first), false);
  return {
    node,
    pause() {
      running?.pause();
    },
  };
}

function wrongWords(nest) {
  const holds = {
    certain: 'In the seat, contacts hold the part for every friction and direction of force that was asked for.',
    possible:
      'In the seat, contacts hold the part for some of the frictions and directions of force that were asked for.',
    impossible: 'In the seat, contacts cannot hold the part.',
  }[nest.seat_holds];
  return small(
    nest.wrong?.length
      ? 'A wrong equilibrium that is certain is held whatever friction and direction are within their intervals; one that is possible, for some of them. '
      : 'Friction holds the part nowhere but in the seat. ',
    holds ?? '',
  );
}
