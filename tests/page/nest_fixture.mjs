// Reports of a pallet (a tee in a pocket, gravity tilted) and of a fixture (a block in a vee): heights and rests by
// sampling, ways out straight up and aside, lower bounds and shares made up.
import { dropHeight, sink, turnedBy } from './nest_mechanics.mjs';
import { fillPage } from './turning_fixture.mjs';

export { fillPage };

const round = (v, per = 1e4) => Math.round(v * per) / per + 0;
const grid = ([from, to], count) =>
  Array.from({ length: count }, (_, i) => round(from + ((to - from) * i) / (count - 1)));

const about = (loop, [x, y]) => loop.map((p) => [p[0] - x, p[1] - y]);
const mirrored = (loop) => loop.map(([x, y]) => [-x, y]).reverse();
const kTee = [
  [0, 0],
  [16, 0],
  [16, 5],
  [9, 5],
  [9, 14],
  [4, 14],
  [4, 5],
  [0, 5],
];
const tee = about(kTee, [7.46, 5.02]);
const pocket = [
  [-30, -20],
  [30, -20],
  [30, 0],
  [3.1, 0],
  [3.1, -9],
  [-3.1, -9],
  [-3.1, 0],
  [-30, 0],
];
const block = about(
  [
    [0, 0],
    [20, 0],
    [20, 20],
    [0, 20],
  ],
  [10, 10],
);
const vee = [
  [-35, -10],
  [60, -10],
  [60, 30],
  [45, 30],
  [45, 12],
  [16, 16],
  [0, 0],
  [-30, 30],
  [-35, 30],
];

const kRows = 72;
const kColumns = 61;

const nearest = (v) => Math.round(v);

// The node, as row * columns + column, at which going downhill by neighbours ends.
function descend(heights, row, column) {
  let [r, c] = [((row % kRows) + kRows) % kRows, Math.max(0, Math.min(kColumns - 1, column))];
  for (;;) {
    let [least, next] = [heights[r][c], null];
    for (let i = -1; i <= 1; ++i) {
      for (let k = -1; k <= 1; ++k) {
        const [rr, cc] = [(r + i + kRows) % kRows, c + k];
        const h = heights[rr]?.[cc];
        if (h !== undefined && h !== null && h < least - 1e-9) [least, next] = [h, [rr, cc]];
      }
    }
    if (!next) return r * kColumns + c;
    [r, c] = next;
  }
}

function nestOf({ part, names, symmetry, nest, gravity_deg, span, seat, starts, isPallet }) {
  const turn = -90 - gravity_deg; // into gravity's frame
  const ground = [turnedBy(nest, turn)];
  const loops = { [names[0]]: part, ...(names[1] ? { [names[1]]: mirrored(part) } : {}) };
  const heightOf = (name) => (across, deg) => dropHeight(ground, turnedBy(loops[name], deg + turn), across);
  const world = (across, height) => turnedBy([[across, height]], -turn)[0].map((v) => round(v));
  const own = turnedBy([[seat.x_mm, seat.y_mm]], turn)[0];
  const zero = heightOf(seat.aspect)(own[0], seat.orientation_deg);

  // Rests: where sinking ends, of a coarse set of placements; ends outside of the span have left.
  const period = 360 / symmetry;
  const rests = [];
  const landscape = [];
  const sinks = new Map();
  for (const name of names) {
    const height = heightOf(name);
    const found = [];
    const turns = grid([0, 360 - 360 / kRows], kRows);
    const places = grid(span, kColumns);
    const heights = turns.map((deg) => places.map((across) => height(across, deg)));
    // Downhill from node to node, then on from the lowest one by ever smaller steps.
    const ends = new Map();
    const numberOf = (across, deg) => {
      const end = descend(
        heights,
        nearest(deg / (360 / kRows)),
        nearest(((across - span[0]) / (span[1] - span[0])) * (kColumns - 1)),
      );
      if (!ends.has(end)) ends.set(end, known(sink(height, places[end % kColumns], turns[Math.floor(end / kColumns)])));
      return ends.get(end);
    };
    const known = (end) => {
      if (!end || end.across <= span[0] + 0.5 || end.across >= span[1] - 0.5) return -1;
      const like = (a, b) => Math.abs(((((a - b) % period) + 1.5 * period) % period) - 0.5 * period);
      const same = found.findIndex(
        (rest) =>
          Math.abs(rest.height - end.height) < 0.3 &&
          like(rest.deg, end.deg) < 6 &&
          Math.abs(rest.across - end.across) < 2,
      );
      if (same >= 0) return same;
      found.push({ ...end, deg: end.deg % period });
      return found.length - 1;
    };
    const numbers = turns.map((deg) => places.map((across) => numberOf(across, deg)));
    const order = found.map((_, i) => i).sort((a, b) => found[a].height - found[b].height);
    const first = rests.length;
    // Too small basins are rests of the sampling alone.
    const size = (i) => numbers.flat().filter((n) => n === i).length;
    const kept = order.filter((i) => size(i) > 12).slice(0, 6);
    const number = (i) => (kept.includes(i) ? first + kept.indexOf(i) : -1);
    for (const i of kept) {
      const { across, deg, height: h } = found[i];
      const [x, y] = world(across, h);
      const isSeat = name === seat.aspect && Math.hypot(x - seat.x_mm, y - seat.y_mm) < 1 && h < zero + 0.2;
      rests.push(restOf(name, x, y, deg, h, isSeat, size(i) / (kRows * kColumns) / names.length));
    }
    sinks.set(name, (across, deg) => number(numberOf(across, deg)));
    landscape.push({
      aspect: name,
      across_mm: span,
      theta_deg: [0, 360],
      hidden: rests.length > first + 1 ? [rests.length - 1] : [],
      heights_mm: heights.map((row) => row.map((h) => (h === null ? null : round(h - zero, 100)))),
      basin: numbers.map((row) => row.map(number)),
    });
  }

  // Straight up until nothing is beside it, aside, and down to the rim.
  function restOf(name, x, y, deg, height, isSeat, share) {
    const reach = Math.max(...loops[name].map((p) => Math.hypot(...p)));
    const top =
      Math.max(...ground[0].map(([, h]) => h)) - Math.min(...turnedBy(loops[name], deg + turn).map((p) => p[1]));
    const [across] = turnedBy([[x, y]], turn)[0];
    const rise = Math.max(0.02, top - height);
    const far = Math.max(...ground[0].map(([u]) => u)) + reach;
    const way = [
      [across, height],
      [across, height + rise / 2],
      [across, height + rise],
      [far, height + rise],
      [far, height + rise - 3],
    ].map(([u, h], i) => {
      const [px, py] = world(u, h);
      return { x_mm: px, y_mm: py, orientation_deg: round((deg + (i > 2 ? 20 : 0)) % 360) };
    });
    const q = { x_mm: x, y_mm: y, orientation_deg: round(deg) };
    const rest = { aspect: name, ...q, is_seat: isSeat, height_mm: round(height - zero) };
    if (isPallet) {
      rest.escape_height_mm = [round(0.97 * rise), round(rise)];
      rest.why = '';
      rest.way_out = way;
    }
    return { ...rest, set: [], drop_share: round(share) };
  }

  const endOf = ({ x_mm: ex, y_mm: ey, theta_deg: et }) => {
    const [across] = turnedBy([[seat.x_mm + ex, seat.y_mm + ey]], turn)[0];
    const number = sinks.get(seat.aspect)(across, seat.orientation_deg + et);
    const outcome = number < 0 ? 'escaped' : rests[number].is_seat ? 'seated' : 'misseated';
    const rest = rests[Math.max(0, number)];
    return { outcome, end: { x_mm: rest.x_mm, y_mm: rest.y_mm, orientation_deg: rest.orientation_deg } };
  };
  const ys = starts.y_mm[0] === starts.y_mm[1] ? [starts.y_mm[0]] : grid(starts.y_mm, 3);
  const placed = grid(starts.theta_deg, 5).flatMap((theta_deg) =>
    ys.flatMap((y_mm) => grid(starts.x_mm, 5).map((x_mm) => ({ x_mm, y_mm, theta_deg }))),
  );
  const shares = {};
  const middle = ys[Math.floor(ys.length / 2)];
  const rows = grid(starts.theta_deg, 13).map((theta_deg) => {
    const xs = grid(starts.x_mm, 41);
    const intervals = [];
    for (let i = 0; i + 1 < xs.length; ++i) {
      const { outcome: name } = endOf({ x_mm: (xs[i] + xs[i + 1]) / 2, y_mm: middle, theta_deg });
      shares[name] = (shares[name] ?? 0) + 1 / (13 * 40);
      const last = intervals.at(-1);
      if (last?.[2] === name) last[1] = xs[i + 1];
      else intervals.push([xs[i], xs[i + 1], name]);
    }
    return { theta_deg, intervals };
  });
  return {
    gravity_deg,
    seat,
    aspects: names.map((name) => ({ name, symmetry, outline: { outer: loops[name], holes: [] } })),
    rests,
    starts: placed.map((one) => ({ ...one, ...endOf(one) })),
    region: { x_mm: starts.x_mm, y_mm: middle, theta_deg: starts.theta_deg, shares, rows },
    sure_fraction: 0.44,
    landscape,
    passes: passesOf(rests, names),
  };
}

// From each rest to the one before, at its way's highest point; one has no place.
function passesOf(rests, names) {
  return names.flatMap((aspect) =>
    rests.flatMap((rest, i) => {
      if (rest.aspect !== aspect || !rest.way_out) return [];
      const [low, high] = rest.escape_height_mm.map((v) => round(v + rest.height_mm));
      const top = rest.way_out[2];
      const other = rests[i - 1]?.aspect === aspect ? i - 1 : -1;
      return [{ aspect, first: i, second: other, lower_mm: low, upper_mm: i % 3 === 2 ? null : high, ...top }];
    }),
  );
}

const kStarts = {
  pallet: { x_mm: [-2, 2], y_mm: [12, 12], theta_deg: [-30, 30] },
  fixture: { x_mm: [-8, 28], y_mm: [10, 14], theta_deg: [-70, 70] },
};
const kSeats = {
  pallet: { aspect: 'up', x_mm: -0.36, y_mm: -0.02, orientation_deg: 180 },
  fixture: { aspect: 'up', x_mm: 0, y_mm: 14.142136, orientation_deg: 45 },
};

export function nestData(kind) {
  if (kind === 'pallet') {
    const nest = nestOf({
      part: tee,
      names: ['up', 'down'],
      symmetry: 1,
      nest: pocket,
      gravity_deg: -85,
      span: [-20, 20],
      seat: kSeats.pallet,
      starts: kStarts.pallet,
      isPallet: true,
    });
    const window = {
      throws_mm: 1.83,
      keeps_up_to_amplitude_mm: 1.42,
      loses_from_amplitude_mm: 0.38,
      drops_per_part: 3.4,
      right_share: 0.93,
    };
    return { ...nest, window };
  }
  const nest = nestOf({
    part: block,
    names: ['up'],
    symmetry: 4,
    nest: vee,
    gravity_deg: -90,
    span: [-30, 44],
    seat: kSeats.fixture,
    starts: kStarts.fixture,
    isPallet: false,
  });
  const lean = [0, 2, 4, 6, 8].map((deg) => ({
    x_mm: round(-9 + 0.3 * deg),
    y_mm: round(23 - 0.2 * deg),
    orientation_deg: 10 + deg,
  }));
  return {
    ...nest,
    seat_holds: 'certain',
    wrong: [
      { aspect: 'up', ...lean[2], verdict: 'certain', size_mm: 3.2, samples: lean },
      { aspect: 'up', x_mm: 9, y_mm: 23, orientation_deg: 75, verdict: 'possible', size_mm: 0, samples: [] },
    ],
  };
}

const kMetrics = {
  pallet: {
    goal_escape_height_mm: 8.73,
    worst_wrong_escape_height_mm: 0.9,
    selectivity_mm: 7.83,
    capture_fraction: 0.7125,
  },
  fixture: {
    seated_fraction: 0.62,
    wrong_equilibria: 2,
    repeatability_mm: 0.014,
    resisted_weights: 0.71,
    resisted_moment_mm: 7.07,
  },
};

export function makeReport(kind) {
  const nest = nestData(kind);
  const metrics = kMetrics[kind];
  const names = Object.keys(metrics);
  const ranked = kind === 'pallet' ? ['selectivity_mm', 'capture_fraction'] : ['seated_fraction', 'repeatability_mm'];
  const best = ranked.map((name) => metrics[name]);
  const design = {
    id: 'd12',
    number: 12,
    topology: 0,
    label: 'one shape',
    provenance: 'fixture',
    objectives: best,
    violation: 0,
    feasible: true,
    metrics,
    worst_case: null,
    violations: [],
    values: { d: 9 },
    commands: { evaluate: 'formotion evaluate', export: 'formotion export' },
    shapes: { nest_mm: [kind === 'pallet' ? pocket : vee] },
    nest,
    stamp:
      kind === 'pallet'
        ? { holds: true, checks: [{ name: 'shaken', holds: true, says: '40 of 40 parts stayed in the seat for 20 s' }] }
        : undefined,
  };
  const worse = Object.fromEntries(names.map((name) => [name, 0.8 * metrics[name]]));
  const plain = {
    ...design,
    id: 'd7',
    number: 7,
    objectives: ranked.map((name) => worse[name]),
    metrics: worse,
    nest: {
      ...nest,
      landscape: null,
      passes: null,
      window: nest.window && { ...nest.window, loses_from_amplitude_mm: null },
    },
    stamp: undefined,
  };
  const invalid = {
    ...design,
    id: 'd3',
    number: 3,
    feasible: false,
    violation: 1000,
    violations: [{ what: 'a shape crosses itself', where: '/design/nest_mm/0', by: 0 }],
    metrics: Object.fromEntries(names.map((name) => [name, null])),
    nest: {
      ...nest,
      rests: [],
      starts: [],
      region: null,
      landscape: null,
      passes: null,
      window: null,
      wrong: [],
      sure_fraction: null,
    },
    stamp: undefined,
  };
  return {
    formotion: 1,
    program: 'formotion (fixture)',
    problem: {
      name: kind === 'pallet' ? 'tee in a pocket' : 'block in a vee',
      slug: 'fixture',
      path: 'fixture.json',
      kind,
      text: '{}',
      nest: {
        purpose: kind,
        gravity_deg: -90,
        tilt_deg: kind === 'pallet' ? 5 : 0,
        friction: 0.3,
        seat: { ...kSeats[kind], within_mm: 1 },
        starts: kStarts[kind],
        table: kind === 'pallet' ? { amplitude_mm: 0.5, frequency_hz: 30, restitution: 0.3 } : null,
      },
      uncertainty: null,
      objectives: ranked.map((name) => ({ name, maximise: name !== 'repeatability_mm', resolution: 1e-9 })),
      variables: [{ name: 'd', min: 2, max: 12, value: 9 }],
      topology_count: 1,
      topologies: [{ label: design.label, variables: ['d'] }],
    },
    run: { evaluations: 20, budget: 20, feasible: 2, seed: 1, complete: true },
    history: [{ evaluations: 20, front: 2, best }],
    findings: [],
    sample: [
      [12, 0, 1, 0, best],
      [7, 0, 1, 0, plain.objectives],
    ],
    knee: null,
    designs: [design, plain, invalid],
    compared: null,
    parts: [],
  };
}
