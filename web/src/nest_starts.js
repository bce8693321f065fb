// From placement to rest: the map of starts, and the part at a start and where it ends.

import { h } from './dom.js';
import { degrees, outcome, percent, short } from './format.js';
import { frameAround, partLoops, placementOf, united } from './nest_frame.js';
import { stillPicture } from './nest_picture.js';
import { badge } from './poses.js';
import { regionMap } from './region_map.js';
import { middleStart } from './wrong_ways.js';

// Starts at the height that the map is of.
export function startsOnMap({ starts, region }) {
  if (!region) return starts;
  const off = (one) => Math.abs(one.y_mm - (region.y_mm ?? 0));
  const least = Math.min(...starts.map(off));
  return starts.filter((one) => off(one) <= least + 1e-9);
}

const startOf = ({ seat }, one) => [seat.x_mm + one.x_mm, seat.y_mm + one.y_mm, seat.orientation_deg + one.theta_deg];
const hasEnd = (one) => one.end && !['blocked', 'undecided'].includes(one.outcome);

export function nestStarts(nest, fixed) {
  const starts = startsOnMap(nest);
  const shown = h('div', { id: 'start-picture' });
  if (!starts.length) return h('p', { class: 'empty' }, 'This report holds no starts of this design.');
  const loops = partLoops(nest, nest.seat.aspect);
  const frame = united(
    starts.map((one) =>
      frameAround(fixed, loops, [
        startOf(nest, one),
        ...(hasEnd(one) && one.outcome !== 'escaped' ? [placementOf(one.end)] : []),
      ]),
    ),
  );
  const map = nest.region
    ? regionMap({ region: nest.region, starts }, choose, {
        x: 'start, along x from the seat (mm)',
        theta: 'start, turned from the seat (\u00b0)',
        shows: 'shows it',
      })
    : null;

  function choose(index) {
    const one = starts[index];
    map?.mark(index);
    const bodies = [{ q: startOf(nest, one), cls: 'nest-start' }];
    if (hasEnd(one)) bodies.push({ q: placementOf(one.end), cls: `part ${one.outcome}` });
    shown.replaceChildren(
      h(
        'p',
        { class: 'verdict' },
        badge(one.outcome),
        ' ',
        hasEnd(one)
          ? `it ends at x ${short(one.end.x_mm, 2)} mm, y ${short(one.end.y_mm, 2)} mm, turned ${degrees(one.end.orientation_deg)}`
          : `${outcome(one.outcome).word}: no end to show`,
        '.',
      ),
      stillPicture(nest, fixed, nest.seat.aspect, bodies, {
        tall: 300,
        frame,
        columns: 2,
        label: `The part at the start, dashed, and at its end: ${outcome(one.outcome).word}`,
        scaled: true,
      }),
      h(
        'p',
        { class: 'legend' },
        h('span', null, h('i', { class: 'key carrier', 'aria-hidden': 'true' }), 'where it starts'),
        h('span', null, h('i', { class: 'key part', 'aria-hidden': 'true' }), 'where it ends'),
      ),
    );
  }
  choose(middleStart({ region: nest.region, insertions: starts }));
  return h(
    'div',
    { class: 'nest-starts' },
    map ? map.node : h('p', { class: 'empty' }, 'There is no map of the starts.'),
    h('figure', { class: 'start-figure' }, shown),
  );
}

export function sureWords(nest) {
  if (nest.sure_fraction === null || nest.sure_fraction === undefined) return '';
  const certain = nest.certain_fraction;
  return (
    `From ${percent(nest.sure_fraction)} of the starts looked at the part must end in the seat by energy alone, whatever friction and impacts do.` +
    (certain === null || certain === undefined
      ? ''
      : ` Without bouncing, ${percent(certain)} end in it for every direction and friction asked for.`)
  );
}
