// A contact as pictures show it: its normal, its friction cone, a dot that is filled where it sticks.

import { s } from './dom.js';

const kArrow = 34; // px

// An arrow of that many pixels at a point of the picture, along a direction whose y is downwards.
export function arrow([x, y], [dx, dy], size, line, head) {
  const side = (angle, length) => {
    const [c, sn] = [Math.cos(angle), Math.sin(angle)];
    return [x + length * (c * dx - sn * dy), y + length * (sn * dx + c * dy)];
  };
  const tip = side(0, size);
  const back = Math.max(0, size - 9);
  const [one, other] = [
    side(0.12 * (kArrow / Math.max(size, 12)), back),
    side(-0.12 * (kArrow / Math.max(size, 12)), back),
  ];
  return [
    s('path', { class: line, d: `M${x},${y}L${tip}` }),
    s('path', { class: head, d: `M${tip}L${one}L${other}Z` }),
  ];
}

export function contactSign({ point, normal, sticks }, friction, view) {
  const [x, y] = view.to(point);
  const [nx, ny] = [normal[0], -normal[1]];
  const half = friction > 0 ? Math.atan(friction) : 0;
  const size = kArrow + 8;
  const at = (angle) => {
    const [c, sn] = [Math.cos(angle), Math.sin(angle)];
    return [x + size * (c * nx - sn * ny), y + size * (sn * nx + c * ny)];
  };
  return [
    half ? s('path', { class: 'cone', d: `M${x},${y}L${at(-half)}A${size},${size} 0 0 1 ${at(half)}Z` }) : '',
    ...arrow([x, y], [nx, ny], kArrow, 'normal', 'normal-head'),
    s('circle', { class: sticks ? 'contact sticks' : 'contact', cx: x, cy: y, r: 4.5 }),
  ].filter(Boolean);
}
