// What was asked of a fixture or a pallet, in words.

import { degrees, short } from './format.js';

const range = ([a, b], unit) => (a === b ? `${short(a)}${unit}` : `${short(a)} to ${short(b)}${unit}`);

// [title, words] of every fact.
export function nestFacts({ gravity_deg, tilt_deg, friction, seat, starts, table }) {
  return [
    [
      'Seat',
      `aspect \u201c${seat.aspect}\u201d, the centre of mass at ${short(seat.x_mm, 2)}, ${short(seat.y_mm, 2)} mm, turned ${degrees(seat.orientation_deg)}; seated within ${short(seat.within_mm)} mm`,
    ],
    [
      'Starts',
      [
        `x ${range(starts.x_mm, ' mm')}`,
        `y ${range(starts.y_mm, ' mm')}`,
        `\u03b8 ${range(starts.theta_deg, '\u00b0')}`,
      ].join(', ') + ' from the seat; let go at rest',
    ],
    ['Gravity', `towards ${degrees(gravity_deg)}${tilt_deg ? `, tilted by ${degrees(tilt_deg)}` : ''}`],
    ['Friction', short(friction)],
    table
      ? [
          'Table',
          `shakes along gravity by ${short(table.amplitude_mm)} mm at ${short(table.frequency_hz)} Hz; restitution ${short(table.restitution)}`,
        ]
      : null,
  ].filter(Boolean);
}
