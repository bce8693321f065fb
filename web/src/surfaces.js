// Surfaces from slices: the boundary of the configuration-space obstacle is given at steps of theta; pieces of one
// facet in neighbouring slices are joined by strips.

const kLinked_mm = 0.2; // ends of pieces that continue each other

const between = (a, b, t) => [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

// Slices between two positions along the track, and above the wall: a wall is a body with other sides, and long.
export function windowed(slices, [least, most], wall) {
  const cutAt = (piece) => {
    const [facet, x0, y0, x1, y1, support] = piece;
    if ((y0 + y1) / 2 < wall || Math.max(x0, x1) <= least || Math.min(x0, x1) >= most) return [];
    if (Math.min(x0, x1) >= least && Math.max(x0, x1) <= most) return [piece];
    const at = (x) => {
      const inside = Math.max(least, Math.min(most, x));
      return [inside, y0 + ((inside - x0) / (x1 - x0)) * (y1 - y0)];
    };
    return [[facet, ...at(x0), ...at(x1), support]];
  };
  return slices.map((slice) => ({ ...slice, pieces: slice.pieces.flatMap(cutAt) }));
}

// Free on the left of a piece: farther from the wall lies nothing, so that an even number of pieces is crossed.
function freeOnLeft([, x0, y0, x1, y1], pieces) {
  const size = Math.hypot(x1 - x0, y1 - y0) || 1;
  const x = (x0 + x1) / 2 - (0.05 * (y1 - y0)) / size + 1.3e-5;
  const y = (y0 + y1) / 2 + (0.05 * (x1 - x0)) / size;
  let odd = false;
  for (const [, a, b, c, d] of pieces) {
    if (a > x !== c > x && y < b + ((x - a) / (c - a)) * (d - b)) odd = !odd;
  }
  return !odd;
}

// A slice's pieces by facet and support, as polylines with the free side on their left.
function chainsOf(slice, sides) {
  const groups = new Map();
  for (const [facet, x0, y0, x1, y1, support] of slice.pieces) {
    if (x0 === x1 && y0 === y1) continue; // a place that is free alone
    const key = `${facet} ${support}`;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(
      sides[facet] < 0
        ? [
            [x1, y1],
            [x0, y0],
          ]
        : [
            [x0, y0],
            [x1, y1],
          ],
    );
  }
  for (const [key, chains] of groups) groups.set(key, linked(chains));
  return groups;
}

function linked(chains) {
  const rest = [...chains];
  const done = [];
  while (rest.length) {
    let chain = rest.pop();
    for (let found = true; found;) {
      found = false;
      for (let i = 0; i < rest.length && !found; ++i) {
        const other = rest[i];
        if (apart(chain[chain.length - 1], other[0]) < kLinked_mm) chain = [...chain, ...other.slice(1)];
        else if (apart(other[other.length - 1], chain[0]) < kLinked_mm) chain = [...other, ...chain.slice(1)];
        else continue;
        rest.splice(i, 1);
        found = true;
      }
    }
    done.push(chain);
  }
  return done;
}

function shares(chain) {
  const at = [0];
  for (let i = 1; i < chain.length; ++i) at.push(at[i - 1] + apart(chain[i - 1], chain[i]));
  return at.map((s) => s / (at[at.length - 1] || 1));
}

function resampled(chain, ts) {
  const at = shares(chain);
  return ts.map((t) => {
    let i = 0;
    while (i + 2 < at.length && at[i + 1] < t) ++i;
    return between(
      chain[i],
      chain[i + 1],
      at[i + 1] > at[i] ? Math.max(0, Math.min(1, (t - at[i]) / (at[i + 1] - at[i]))) : 0,
    );
  });
}

// The part of a chain between two shares of its length.
function cut(chain, from, to) {
  const inner = shares(chain).filter((t) => t > from + 1e-9 && t < to - 1e-9);
  return resampled(chain, [from, ...inner, to]);
}

// Pairs of chains that continue each other. A chain that meets several is cut between them.
function pairs(below, above, near) {
  const [few, many, swapped] = below.length <= above.length ? [below, above, false] : [above, below, true];
  const taken = few.map(() => []);
  const alone = { below: [], above: [] };
  if (few.length === many.length && few.length === 1) {
    if (closest(few[0], many[0]) < near) taken[0].push(many[0]);
    else alone[swapped ? 'below' : 'above'].push(many[0]);
  } else {
    for (const chain of many) {
      const gaps = few.map((other) => closest(other, chain));
      const best = gaps.indexOf(Math.min(...gaps));
      if (best >= 0 && gaps[best] < near) taken[best].push(chain);
      else alone[swapped ? 'below' : 'above'].push(chain);
    }
  }
  const found = [];
  few.forEach((one, i) => {
    if (!taken[i].length) return alone[swapped ? 'above' : 'below'].push(one);
    const spots = taken[i]
      .map((chain) => ({ chain, from: share(one, chain[0]), to: share(one, chain[chain.length - 1]) }))
      .sort((a, b) => a.from - b.from);
    spots.forEach((spot, k) => {
      const from = k === 0 ? 0 : Math.max(0, Math.min(1, (spots[k - 1].to + spot.from) / 2));
      const to = k + 1 === spots.length ? 1 : Math.max(from, Math.min(1, (spot.to + spots[k + 1].from) / 2));
      const piece = cut(one, from, to);
      found.push(swapped ? [spot.chain, piece] : [piece, spot.chain]);
    });
  });
  return { found, alone };
}

// The nearest ends and beginnings first; those left over have null in place of the other.
function meetings(ending, beginning, near) {
  const ends = (c) => [c[0], c[c.length - 1]];
  const off = (a, b) => apart(ends(a)[0], ends(b)[0]) + apart(ends(a)[1], ends(b)[1]);
  const options = ending
    .flatMap((low) => beginning.map((high) => ({ low, high, gap: off(low.chain, high.chain) })))
    .filter(({ gap }) => gap < near)
    .sort((a, b) => a.gap - b.gap);
  const used = new Set();
  const met = [];
  for (const { low, high } of options) {
    if (used.has(low) || used.has(high)) continue;
    used.add(low).add(high);
    met.push([low, high]);
  }
  for (const low of ending) if (!used.has(low)) met.push([low, null]);
  for (const high of beginning) if (!used.has(high)) met.push([null, high]);
  return met;
}

function midway(a, b) {
  const ts = merged(a, b);
  const [p, q] = [resampled(a, ts), resampled(b, ts)];
  return p.map((point, i) => between(point, q[i], 0.5));
}

const merged = (a, b) =>
  [...new Set([...shares(a), ...shares(b)].map((t) => Math.round(t * 1e6) / 1e6))].sort((x, y) => x - y);

// Where along a chain, as a share of its length, a point is nearest.
function share(chain, p) {
  const [a, b] = [chain[0], chain[chain.length - 1]];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  return Math.max(0, Math.min(1, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy || 1)));
}

// Distance of two chains, as that of their chords' nearest points.
function closest(a, b) {
  const ends = (c) => [c[0], c[c.length - 1]];
  const toChord = (p, c) => apart(p, between(...ends(c), share(c, p)));
  return Math.min(...ends(a).map((p) => toChord(p, b)), ...ends(b).map((p) => toChord(p, a)));
}

// space: {theta_step_deg, slices, facets}; reach: of the part, mm. Answers
//   vertices  [x, y, theta_deg, facet, support] of strips, in order of their facets
//   triangles indices into them, the free side in front; facetOf: of each triangle
//   borders   [x, y, theta] pairs: where facets end; supportEnds: where support does
//   rangeOf   a facet's indices: [first, count]; middleOf: a placement on it, or null
export function surfaces(space, reach) {
  const { slices, facets } = space;
  const step = space.theta_step_deg ?? 360 / slices.length;
  const near = 3 + 2 * reach * ((step * Math.PI) / 180);
  const votes = facets.map(() => 0);
  for (const slice of slices) {
    for (const piece of slice.pieces) votes[piece[0]] += freeOnLeft(piece, slice.pieces) ? 1 : -1;
  }
  const groups = slices.map((slice) => chainsOf(slice, votes));
  const strips = facets.map(() => []);
  const around =
    slices.length > 1 && Math.abs(slices[0].theta_deg + 360 - slices[slices.length - 1].theta_deg - step) < 1e-6;
  slices.forEach((slice, k) => {
    if (k + 1 === slices.length && !around) return;
    const theta = slice.theta_deg;
    const [lower, upper] = [groups[k], groups[(k + 1) % slices.length]];
    const add = (key, below, above, from, to) => {
      const [facet, support] = key.split(' ').map(Number);
      strips[facet].push({ below, above, from, to, support });
    };
    const ending = [];
    const beginning = [];
    for (const key of new Set([...lower.keys(), ...upper.keys()])) {
      const { found, alone } = pairs(lower.get(key) ?? [], upper.get(key) ?? [], near);
      for (const [below, above] of found) add(key, below, above, theta, theta + step);
      for (const chain of alone.below) ending.push({ key, chain });
      for (const chain of alone.above) beginning.push({ key, chain });
    }
    // Where a facet ends another begins, somewhere between the slices: they meet half-way.
    const half = theta + step / 2;
    for (const [low, high] of meetings(ending, beginning, 2 * near)) {
      const meet = low && high ? midway(low.chain, high.chain) : (low ?? high).chain;
      if (low) add(low.key, low.chain, meet, theta, half);
      if (high) add(high.key, meet, high.chain, half, theta + step);
    }
  });
  return meshed(strips);
}

function meshed(strips) {
  const [vertices, triangles, facetOf, borders, supportEnds, rangeOf, middleOf] = [[], [], [], [], [], [], []];
  strips.forEach((list, facet) => {
    const begin = 3 * triangles.length;
    const ends = [];
    middleOf.push(list.length ? middle(list[list.length >> 1]) : null);
    for (const { below, above, from, to, support } of list) {
      const ts = merged(below, above);
      const [low, high] = [resampled(below, ts), resampled(above, ts)];
      const first = vertices.length;
      ts.forEach((_, i) => vertices.push([...low[i], from, facet, support], [...high[i], to, facet, support]));
      for (let i = 0; i + 1 < ts.length; ++i) {
        const at = first + 2 * i;
        triangles.push([at, at + 1, at + 2], [at + 1, at + 3, at + 2]);
        facetOf.push(facet, facet);
      }
      const last = ts.length - 1;
      ends.push(
        [
          [...low[0], from],
          [...high[0], to],
        ],
        [
          [...low[last], from],
          [...high[last], to],
        ],
      );
    }
    // What two strips share lies inside of the facet: its support changes there.
    const times = new Map();
    const key = (end) =>
      end
        .flat()
        .map((v) => Math.round(v * 50))
        .join();
    for (const end of ends) times.set(key(end), (times.get(key(end)) ?? 0) + 1);
    for (const end of ends) (times.get(key(end)) > 1 ? supportEnds : borders).push(...end);
    rangeOf.push([begin, 3 * triangles.length - begin]);
  });
  return { vertices, triangles, facetOf, borders, supportEnds, rangeOf, middleOf };
}

function middle({ below, from }) {
  return [...resampled(below, [0.5])[0], from];
}
