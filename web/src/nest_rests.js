// Every rest of the part in a nest, and every wrong equilibrium, as a small picture that can be chosen.

import { h, s } from './dom.js';
import { degrees, mm, percent, short } from './format.js';
import { frameAround, partLoops, placementOf, united } from './nest_frame.js';
import { bodyAt, nestStage } from './nest_picture.js';

const kThumb_px = 148;
const kThumbTall_px = 130;

// Told apart by number as well as by colour (Okabe and Ito 2008; wine and the last two from Tol).
const kColours = ['#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7d1f4f', '#999933', '#44aa99'];
const kOfSeat = '#0072b2';
export const kOfOutside = '#9aa5b0';

// Of a rest's number; -1: outside.
export function restColour(nest, index) {
  if (index < 0) return kOfOutside;
  if (nest.rests[index].is_seat) return kOfSeat;
  const wrong = nest.rests.slice(0, index).filter((rest) => !rest.is_seat).length;
  return kColours[wrong % kColours.length];
}

export const restName = (nest, index) =>
  index < 0 ? 'outside' : nest.rests[index].is_seat ? `rest ${index + 1}, the seat` : `rest ${index + 1}`;

const poseWords = (nest, one) =>
  `${nest.aspects.length > 1 || one.aspect !== 'up' ? `\u201c${one.aspect}\u201d, ` : ''}turned ${degrees(one.orientation_deg)}`;

export function escapeWords({ escape_height_mm: bracket }) {
  if (!bracket) return null;
  const [low, high] = bracket;
  if (high === null) return `no way out found; none rises less than ${mm(low, 2)}`;
  if (high - low < 0.005) return `to get out it must rise ${mm(high, 2)}`;
  return `to get out it must rise ${mm(low, 2)}; a way rises ${mm(high, 2)}`;
}

// What can be chosen: rests, then wrong equilibria.
export function choices(nest) {
  const name = (one) => `${one.aspect}, x ${short(one.x_mm, 2)} mm, turned ${degrees(one.orientation_deg)}`;
  const rests = nest.rests.map((rest, index) => {
    const wayOut = (rest.way_out ?? []).map(placementOf);
    const isWay = wayOut.length > 1;
    const set = (rest.set ?? []).map(placementOf);
    return {
      kind: 'rest',
      index,
      one: rest,
      aspect: rest.aspect,
      title: `${restName(nest, index).replace(/^r/, 'R')} (${name(rest)})`,
      placements: isWay ? wayOut : set.length > 1 ? set : [placementOf(rest)],
      is_way: isWay,
      lower_mm: rest.escape_height_mm?.[0] ?? null,
      says: isWay
        ? 'the lowest way out that was found'
        : rest.escape_height_mm
          ? 'no way out was found'
          : set.length > 1
            ? 'a set of rests of one height, from end to end'
            : '',
    };
  });
  const wrong = (nest.wrong ?? []).map((set, index) => ({
    kind: 'wrong',
    index,
    one: set,
    aspect: set.aspect,
    title: `Wrong equilibrium ${index + 1} (${name(set)})`,
    placements: set.samples?.length > 1 ? set.samples.map(placementOf) : [placementOf(set)],
    is_way: false,
    lower_mm: null,
    says: set.samples?.length > 1 ? 'places at which friction can hold the part, one after the other' : '',
  }));
  return [...rests, ...wrong];
}

// picked(index of the list). Answers {node, mark(index)}.
export function restCards(list, nest, fixed, picked) {
  const frame = list.length
    ? united(list.map(({ one, aspect }) => frameAround(fixed, partLoops(nest, aspect), [placementOf(one)])))
    : null;
  const cards = list.map((choice, i) =>
    h(
      'button',
      {
        type: 'button',
        class: `card nest-card ${choice.one.is_seat ? 'seat' : choice.kind}`,
        'data-choice': i,
        'data-kind': choice.kind,
        'aria-pressed': 'false',
        onclick: () => picked(i),
      },
      thumbnail(choice, nest, fixed, frame),
      h('span', { class: 'facts' }, (choice.kind === 'rest' ? restFacts : wrongFacts)(choice, nest).filter(Boolean)),
    ),
  );
  return {
    node: h('div', { class: 'cards', id: 'rests' }, cards),
    mark: (index) => cards.forEach((card, i) => card.setAttribute('aria-pressed', String(i === index))),
  };
}

const line = (...words) => h('span', { class: 'line' }, ...words);
const small = (...words) => h('span', { class: 'line small' }, ...words);

function restFacts({ index, one: rest }, nest) {
  return [
    line(
      h('i', { class: 'rest-number', style: `--of: ${restColour(nest, index)}` }, String(index + 1)),
      h('strong', null, poseWords(nest, rest)),
      rest.is_seat ? h('span', { class: 'goal' }, '\u2713 the seat') : null,
    ),
    line(escapeWords(rest)),
    line(`${percent(rest.drop_share)} of dropped parts come to rest here`),
    rest.is_seat ? null : small(`${mm(rest.height_mm, 2)} over the seat`),
    rest.set?.length > 1 ? small('a level set of rests, not a single one') : null,
    rest.why ? small(rest.why) : null,
  ];
}

function wrongFacts({ index, one: set }, nest) {
  return [
    line(
      h('i', { class: 'rest-number wrong' }, `W${index + 1}`),
      h('strong', null, poseWords(nest, set)),
      h('span', { class: 'goal' }, '\u2715 wrong'),
    ),
    line(
      h(
        'span',
        null,
        h('b', null, set.verdict),
        set.verdict === 'certain' ? ': friction holds it here' : ': friction may hold it here',
      ),
    ),
    small(set.size_mm > 0 ? `a set of places, up to ${mm(set.size_mm, 2)} apart` : 'a single place'),
  ];
}

function thumbnail({ one, aspect, kind }, nest, fixed, frame) {
  const { view, node, inside, bottom } = nestStage(fixed, frame, kThumb_px, kThumbTall_px);
  const state = one.is_seat ? 'seated' : kind === 'wrong' ? 'misseated' : 'elsewhere';
  inside.append(bodyAt(partLoops(nest, aspect), view, placementOf(one), 'part'));
  return s(
    'svg',
    {
      viewBox: `0 0 ${kThumb_px} ${bottom + 2}`,
      width: kThumb_px,
      class: `thumb nest-picture ${state}`,
      'aria-hidden': 'true',
    },
    node,
  );
}
