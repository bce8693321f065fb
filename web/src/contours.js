// Lines of one level over a grid of values (marching squares, straight between nodes).

// values: rows of columns, null where there is none; at(row, column): a node's place in the picture; answers path data.
// A cell with fewer than four values has no line.
export function contourPath(values, level, at) {
  let d = '';
  for (let r = 0; r + 1 < values.length; ++r) {
    for (let c = 0; c + 1 < values[r].length; ++c) {
      const corners = [
        [r, c],
        [r, c + 1],
        [r + 1, c + 1],
        [r + 1, c],
      ];
      const heights = corners.map(([i, k]) => values[i][k]);
      if (heights.some((v) => v === null)) continue;
      const crossings = [];
      for (let i = 0; i < 4; ++i) {
        const [a, b] = [heights[i], heights[(i + 1) % 4]];
        if (a < level === b < level) continue;
        const t = (level - a) / (b - a);
        crossings.push([
          corners[i][0] + t * (corners[(i + 1) % 4][0] - corners[i][0]),
          corners[i][1] + t * (corners[(i + 1) % 4][1] - corners[i][1]),
        ]);
      }
      // Of a saddle, what the mean says about the middle decides which ends meet.
      const [first, ...others] = crossings;
      const turnsBack = crossings.length === 4 && sum(heights) / 4 < level !== heights[0] < level;
      const pairs =
        crossings.length === 4
          ? turnsBack
            ? [first, others[2], others[0], others[1]]
            : [first, others[0], others[1], others[2]]
          : crossings;
      for (let i = 0; i + 1 < pairs.length; i += 2) d += `M${spot(at(...pairs[i]))}L${spot(at(...pairs[i + 1]))}`;
    }
  }
  return d;
}

const sum = (list) => list.reduce((total, v) => total + v, 0);
const spot = ([x, y]) => `${x.toFixed(1)},${y.toFixed(1)}`;

// About `count` round levels between two values.
export function levels(low, high, count) {
  const rough = (high - low) / count;
  if (!(rough > 0)) return { step: 1, list: [] };
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((v) => v >= rough * 0.999);
  const list = [];
  for (let k = Math.ceil(low / step); k * step < high; ++k) list.push(k * step);
  return { step, list };
}
