// A report of two designs of a joint: a peg and a hole with chamfers. Insertions follow from plain geometry with made-up
// forces, slices of the configuration space from trying sampled contacts.
import { fillPage } from './turning_fixture.mjs';
import { isConvex, isFree, outward, placed } from './turning_mechanics.mjs';

export { fillPage };

const kRad = Math.PI / 180;
const kHalf_mm = 5; // of the peg's width
const kClear_mm = 0.1;
const kChamfer_mm = 1.5;
const kGoal_mm = 14;
const kDistance_mm = 16;
const kCentre = [0, 10]; // the peg's bottom is 2 mm above the hole
const kFriction = 0.2;
const kStarts = { x_mm: [-2, 2], theta_deg: [-3, 3] };

const round = (v) => Math.round(v * 1e4) / 1e4 + 0;
const peg = [
  [-5, -8],
  [5, -8],
  [5, 8],
  [2, 8],
  [2, 6],
  [-5, 6],
];
const inner = kHalf_mm + kClear_mm;
const right = [
  [inner, -18],
  [18, -18],
  [18, 0],
  [inner + kChamfer_mm, 0],
  [inner, -kChamfer_mm],
];
const left = right.map(([x, y]) => [-x, y]).reverse();
const fixed = [left, right];

export function outcomeOf(x, theta) {
  if (Math.abs(x) > kChamfer_mm + kClear_mm) return 'blocked';
  if (Math.abs(theta) > 2.4) return 'wedged';
  return Math.abs(x) + 0.5 * Math.abs(theta) > 2 ? 'jammed' : 'assembled';
}

const kWhy = {
  assembled: 'the goal is reached with two contacts',
  blocked: 'the peg stands on the face beside the chamfer',
  wedged: 'two contacts see each other inside both friction cones',
  jammed: 'the contacts hold the peg against the push',
};

// Down to the chamfer, along it, into the hole; the carrier goes straight down.
export function insertionOf(x, theta, outcome = outcomeOf(x, theta), turn = 0) {
  const side = Math.sign(x) || 1;
  const off = Math.max(0, Math.abs(x) - kClear_mm);
  const stop = { blocked: 2, jammed: 6, wedged: 9, assembled: kGoal_mm }[outcome];
  const meets = outcome === 'blocked' ? 2 : 2 + kChamfer_mm - Math.min(off, kChamfer_mm);
  const moments = [];
  const add = (travel, depth, aside, event, contacts) => {
    const force = 0.8 * Math.abs(x - aside) + 2 * (travel - depth) + (contacts.length ? 0.3 : 0);
    moments.push({
      travel_mm: round(travel),
      q: [round(aside), round(kCentre[1] - depth), theta + turn],
      depth_mm: round(depth),
      axial_n: round(force),
      lateral_n: round(-0.6 * side * Math.abs(x - aside)),
      moment_nmm: round(4 * (x - aside)),
      event,
      contacts: contacts.map((c) => ({
        ...c,
        force: [round(force / contacts.length), round(c.mode === 'stick' ? 0.1 * force : -0.2 * force)],
      })),
    });
  };
  const corner = (aside, depth, normal, mode) => {
    const [point] = placed([[side * kHalf_mm, -8]], [aside, kCentre[1] - depth, (theta + turn) * kRad]);
    return {
      kind: 'VE',
      moving: side > 0 ? 1 : 0,
      fixed: [side > 0 ? 1 : 0, 0],
      point: point.map(round),
      normal,
      mode,
    };
  };
  const slope = [-side * Math.SQRT1_2, Math.SQRT1_2];
  add(0, 0, x, 'start', []);
  if (outcome === 'blocked') {
    add(2, 2, x, 'a corner meets the face', [corner(x, 2, [0, 1], 'stick')]);
    add(kDistance_mm, 2, x, 'it stops', [corner(x, 2, [0, 1], 'stick')]);
  } else {
    const end = side * Math.min(Math.abs(x), kClear_mm);
    if (off > 0) {
      add(meets, meets, x, 'a corner meets the chamfer', [corner(x, meets, slope, 'slide-left')]);
      add(meets + off, meets + off, end, 'the corner is in the hole', [
        corner(end, meets + off, [-side, 0], 'slide-left'),
      ]);
    }
    const mode = outcome === 'assembled' ? 'slide-left' : 'stick';
    const contacts = (depth) => [
      corner(end, depth, [-side, 0], mode),
      {
        kind: 'EV',
        moving: 2,
        fixed: [side > 0 ? 0 : 1, 0],
        point: [-side * inner, -kChamfer_mm],
        normal: [side, 0],
        mode,
      },
    ];
    add(stop, stop, end, outcome === 'assembled' ? 'the goal is reached' : 'it stops', contacts(stop));
    if (outcome !== 'assembled') add(kDistance_mm, stop, end, 'the carrier goes on', contacts(stop));
  }
  const peak = (name) => Math.max(...moments.map((m) => Math.abs(m[name])));
  return {
    x_mm: x,
    y_mm: 0,
    theta_deg: theta,
    outcome,
    why: kWhy[outcome],
    depth_mm: stop,
    deepest_mm: stop,
    peak_axial_n: peak('axial_n'),
    peak_lateral_n: peak('lateral_n'),
    work_nmm: round(3.5 + 8 * Math.abs(x)),
    moments,
  };
}

const grid = ([from, to], count) =>
  Array.from({ length: count }, (_, i) => round(from + ((to - from) * i) / (count - 1)));

function regionOf() {
  const shares = {};
  const rows = grid(kStarts.theta_deg, 25).map((theta) => {
    const intervals = [];
    const xs = grid(kStarts.x_mm, 401);
    for (let i = 0; i + 1 < xs.length; ++i) {
      const name = outcomeOf((xs[i] + xs[i + 1]) / 2, theta);
      shares[name] = (shares[name] ?? 0) + 1 / (25 * 400);
      const last = intervals[intervals.length - 1];
      if (last?.[2] === name) last[1] = xs[i + 1];
      else intervals.push([xs[i], xs[i + 1], name]);
    }
    return { theta_deg: theta, intervals };
  });
  return { ...kStarts, shares, rows };
}

// Facets of the peg on the hole, with their stretches that no other contact cuts off.
function spaceOf() {
  const shapes = fixed.map((loop) => ({ loop }));
  const facets = [];
  fixed.forEach((loop, component) =>
    loop.forEach((b, i) =>
      peg.forEach((a, j) => {
        const [next, after] = [loop[(i + 1) % loop.length], peg[(j + 1) % peg.length]];
        const name = component === 0 ? 'the left shape' : 'the right shape';
        const common = { moving: j, fixed: [component, i] };
        if (isConvex(peg, j))
          facets.push({
            ...common,
            kind: 'VE',
            label: `corner ${j} on edge ${i} of ${name}`,
            line: (turn) => [b, next].map((p) => minus(p, placed([a], [0, 0, turn])[0])),
          });
        if (isConvex(loop, i))
          facets.push({
            ...common,
            kind: 'EV',
            label: `edge ${j} on corner ${i} of ${name}`,
            line: (turn) => placed([a, after], [0, 0, turn]).map((p) => minus(b, p)),
          });
      }),
    ),
  );
  const slices = grid([-4, 4], 9).map((deg) => {
    const turn = (deg + 1e-6) * kRad;
    const pieces = facets.flatMap(({ line }, index) => {
      const [a, b] = line(turn);
      const size = Math.hypot(b[0] - a[0], b[1] - a[1]);
      const off = [(-0.01 * (b[1] - a[1])) / size, (0.01 * (b[0] - a[0])) / size];
      const steps = Math.ceil(size / 0.1);
      const at = (u) => [a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1])];
      const isOpen = (u) => {
        const p = at(u);
        const free = [1, -1].map((side) => isFree(peg, shapes, [p[0] + side * off[0], p[1] + side * off[1], turn]));
        return free[0] !== free[1];
      };
      const found = [];
      for (let k = 0; k < steps; ++k) {
        if (!isOpen((k + 0.5) / steps)) continue;
        const last = found[found.length - 1];
        if (last?.end === k) last.end = k + 1;
        else found.push({ begin: k, end: k + 1 });
      }
      return found.map(({ begin, end }) => [index, ...at(begin / steps).map(round), ...at(end / steps).map(round), 1]);
    });
    return { theta_deg: deg, pieces };
  });
  return { theta_step_deg: 1, slices, facets: facets.map(({ line, ...facet }) => facet) };
}

const minus = (p, q) => [p[0] - q[0], p[1] - q[1]];

function jointOf(withSpace) {
  const insertions = grid(kStarts.theta_deg, 5).flatMap((theta) =>
    grid(kStarts.x_mm, 7).map((x) => insertionOf(x, theta)),
  );
  return {
    fixed,
    part: [peg],
    centre_mm: kCentre,
    region: regionOf(),
    capture: { mm: 0.9, deg: 1.35 },
    insertions,
    never: [
      {
        aspect: 'up',
        orientation_deg: 180,
        holds: true,
        proved: true,
        bound_mm: 6.5,
        deepest_mm: 6,
        starts: 25,
        why: '',
        mirrored: false,
        insertion: insertionOf(0.5, 1, 'jammed', 180),
      },
      {
        aspect: 'down',
        orientation_deg: 0,
        holds: false,
        proved: false,
        bound_mm: null,
        deepest_mm: 14,
        starts: 25,
        why: 'a free path leads to the goal',
        mirrored: true,
        insertion: insertionOf(0, 0, 'assembled'),
      },
    ],
    space: withSpace ? spaceOf() : null,
  };
}

export function makeReport() {
  const metrics = {
    success_fraction: 0.62,
    capture_mm: 0.9,
    capture_deg: 1.35,
    peak_force_n: 3.4,
    peak_lateral_force_n: 1.1,
    work_nmm: 19.5,
    depth_margin_mm: 7.5,
    chamfer_mm: kChamfer_mm,
  };
  const design = {
    id: 'd12',
    number: 12,
    topology: 0,
    label: 'two shapes',
    provenance: 'fixture',
    objectives: [0.62, 0.9, 1.5],
    violation: 0,
    feasible: true,
    metrics,
    worst_case: null,
    violations: [],
    values: { c: 1.5 },
    commands: { evaluate: 'formotion evaluate', export: 'formotion export' },
    shapes: { fixed_mm: fixed },
    joint: jointOf(true),
  };
  return {
    formotion: 1,
    program: 'formotion (fixture)',
    problem: {
      name: 'peg in a hole',
      slug: 'fixture',
      path: 'fixture.json',
      kind: 'assembly',
      text: '{}',
      assembly: {
        friction: kFriction,
        damper: false,
        stiffness: { kx_n_per_mm: 2, ky_n_per_mm: 20, ktheta_nmm_per_rad: 500 },
        approach: { direction_deg: -90, distance_mm: kDistance_mm, max_force_n: null },
        goal: {
          depth_mm: kGoal_mm,
          lateral_mm: 0.5,
          tilt_deg: 2.5,
          starts: { ...kStarts, y_mm: [0, 0] },
          never: [
            { aspect: 'up', orientation_deg: 180 },
            { aspect: 'down', orientation_deg: 0 },
          ],
        },
      },
      uncertainty: null,
      objectives: [
        ['success_fraction', true],
        ['capture_mm', true],
        ['chamfer_mm', false],
      ].map(([name, maximise]) => ({ name, maximise, resolution: 1e-9 })),
      variables: [{ name: 'c', min: 0.5, max: 2, value: 1 }],
      topology_count: 1,
      topologies: [{ label: design.label, variables: ['c'] }],
    },
    run: { evaluations: 20, budget: 20, feasible: 2, seed: 1, complete: true },
    history: [{ evaluations: 20, front: 2, best: [0.62, 0.9, 1] }],
    findings: [],
    sample: [
      [12, 0, 1, 0, [0.62, 0.9, 1.5]],
      [7, 0, 1, 0, [0.5, 0.6, 1]],
    ],
    knee: null,
    designs: [
      design,
      {
        ...design,
        id: 'd7',
        number: 7,
        objectives: [0.5, 0.6, 1],
        metrics: { ...metrics, success_fraction: 0.5, capture_mm: 0.6, chamfer_mm: 1 },
        joint: jointOf(false),
      },
    ],
    compared: null,
    parts: [],
  };
}
