// Dimension lines as in workshop drawings: extension lines, arrowheads, a number.

import { s } from './dom.js';

const kCharacter = 6.4; // width of a digit at the drawing's text size
const kArrow = 6;

function arrow(x, y, dx, dy) {
  const [nx, ny] = [-dy, dx];
  const [bx, by] = [x - dx * kArrow, y - dy * kArrow];
  return `M${x},${y}L${bx + nx * 2},${by + ny * 2}L${bx - nx * 2},${by - ny * 2}Z`;
}

// A chain of dimensions between neighbouring positions, along x. Numbers that do not fit move down a step.
// at: the line's y; from: where the extension lines begin.
export function chain(xs, view, from, at, format) {
  const group = s('g', { class: 'dimension' });
  let lines = '';
  let heads = '';
  let lastRight = -Infinity;
  let row = 0;
  for (const x of xs) lines += `M${view.x(x)},${from}V${at + 4}`;
  for (let i = 0; i + 1 < xs.length; ++i) {
    const a = view.x(xs[i]);
    const b = view.x(xs[i + 1]);
    const text = format(xs[i + 1] - xs[i]);
    const wide = text.length * kCharacter + 4;
    const middle = (a + b) / 2;
    lines += `M${a},${at}H${b}`;
    if (b - a > 2 * kArrow + 2) heads += arrow(a, at, -1, 0) + arrow(b, at, 1, 0);
    else lines += `M${a - 3},${at + 3}l6,-6M${b - 3},${at + 3}l6,-6`;
    const fits = b - a > wide + 2;
    row = fits ? 0 : middle - wide / 2 < lastRight ? row + 1 : 1;
    if (!fits) lastRight = middle + wide / 2;
    if (row > 0) lines += `M${middle},${at}V${at + row * 13 - 2}`;
    group.append(s('text', { x: middle, y: row > 0 ? at + row * 13 + 8 : at - 4, 'text-anchor': 'middle' }, text));
  }
  group.prepend(s('path', { class: 'lines', d: lines }), s('path', { class: 'heads', d: heads }));
  return group;
}

// A chain over the plate: numbers above the line, those that do not fit further up.
export function chainAbove(xs, view, from, at, format) {
  const group = s('g', { class: 'dimension' });
  let lines = xs.map((x) => `M${view.x(x)},${from}V${at - 4}`).join('');
  let heads = '';
  for (let i = 0; i + 1 < xs.length; ++i) {
    const [a, b] = [view.x(xs[i]), view.x(xs[i + 1])];
    const text = format(xs[i + 1] - xs[i]);
    const fits = b - a > text.length * kCharacter + 6;
    lines += `M${a},${at}H${b}`;
    if (b - a > 2 * kArrow + 2) heads += arrow(a, at, -1, 0) + arrow(b, at, 1, 0);
    else lines += `M${a - 3},${at + 3}l6,-6M${b - 3},${at + 3}l6,-6`;
    group.append(s('text', { x: (a + b) / 2, y: fits ? at - 4 : at - 15, 'text-anchor': 'middle' }, text));
  }
  group.prepend(s('path', { class: 'lines', d: lines }), s('path', { class: 'heads', d: heads }));
  return group;
}

// One dimension across the track, from y0 to y1 (mm), at picture x; the number stands beside the line.
export function across(y0, y1, view, x, text, side = 1) {
  const a = view.y(y0);
  const b = view.y(y1);
  const inside = Math.abs(a - b) > 2 * kArrow + 2;
  const lines = `M${x - 4},${a}h8M${x - 4},${b}h8` + (inside ? `M${x},${a}V${b}` : `M${x},${a + 10}V${b - 10}`);
  const heads = inside ? arrow(x, a, 0, 1) + arrow(x, b, 0, -1) : arrow(x, a, 0, -1) + arrow(x, b, 0, 1);
  return s(
    'g',
    { class: 'dimension' },
    s('path', { class: 'lines', d: lines }),
    s('path', { class: 'heads', d: heads }),
    s('text', { x: x + side * 6, y: (a + b) / 2 + 4, 'text-anchor': side > 0 ? 'start' : 'end' }, text),
  );
}
