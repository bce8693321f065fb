// Lowering a part onto a nest, sampled: enough for fixtures of the page. Gravity's frame: u across, h up.

const kRad = Math.PI / 180;

export const turnedBy = (loop, deg) => {
  const [c, s] = [Math.cos(deg * kRad), Math.sin(deg * kRad)];
  return loop.map(([x, y]) => [c * x - s * y, s * x + c * y]);
};

// The extreme height of a loop's edges over u: the highest (sign 1) or lowest (sign -1); null where there is none.
function edgeAt(loops, u, sign) {
  let best = null;
  for (const loop of loops) {
    loop.forEach((a, i) => {
      const b = loop[(i + 1) % loop.length];
      if (Math.min(a[0], b[0]) > u || Math.max(a[0], b[0]) < u || a[0] === b[0]) return;
      const v = a[1] + ((u - a[0]) / (b[0] - a[0])) * (b[1] - a[1]);
      if (best === null || sign * v > sign * best) best = v;
    });
  }
  return best;
}

// The height at which a part first touches a nest that is open above. All in gravity's frame.
export function dropHeight(nest, part, across) {
  const kBeside = 1e-7;
  const places = [...part.map(([u]) => u), ...nest.flat().map(([u]) => u - across)];
  let height = null;
  for (const place of places) {
    for (const u of [place - kBeside, place + kBeside]) {
      const below = edgeAt([part], u, -1);
      const ground = edgeAt(nest, u + across, 1);
      if (below === null || ground === null) continue;
      if (height === null || ground - below > height) height = ground - below;
    }
  }
  return height;
}

// Downhill from (across, deg) by ever smaller steps; null: it leaves the nest.
export function sink(heightOf, across, deg) {
  let [at, least] = [[across, deg], heightOf(across, deg)];
  for (let step = 1; step > 1e-4 && least !== null;) {
    let better = null;
    for (const [a, b] of [
      [1, 0],
      [-1, 0],
      [0, 4],
      [0, -4],
      [1, 4],
      [-1, 4],
      [1, -4],
      [-1, -4],
    ]) {
      const next = [at[0] + a * step, at[1] + b * step];
      const height = heightOf(...next);
      if (height === null) return null;
      if (height < least - 1e-9) [better, least] = [next, height];
    }
    if (better) at = better;
    else step /= 2;
  }
  return least === null ? null : { across: at[0], deg: ((at[1] % 360) + 360) % 360, height: least };
}
