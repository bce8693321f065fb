// A report of two designs, one of which turns its parts: an el-shaped part, a wall, a ramp, a pin and a cut-out.
// Angles of every start by a crude simulation, slices of the configuration space by trying sampled contacts.
import { contactsAt, cross, dot, isConvex, isFree, outward, placed, travel } from './turning_mechanics.mjs';

const kRad = Math.PI / 180;
const kWidth_mm = 50;
const kTheta_deg = 3;
const kFriction = 0.1;
const kRange_mm = [-50, 130]; // of slices, along the track
const kStart = [-34, 24];
const kCut = { from: 96, to: 150, over: 12.5 }; // the plate above it is cut away

const round = (v) => Math.round(v * 1e4) / 1e4 + 0;
const el = [
  [0, 0],
  [30, 0],
  [30, 10],
  [10, 10],
  [10, 20],
  [0, 20],
].map(([x, y]) => [x - 12.5, y - 7.5]);
const outlines = { up: el, down: el.map(([x, y]) => [-x, y]).reverse() };
const ramp = [
  [0, 0],
  [46, 0],
  [46, 13],
];
const pin = { centre: [74, 40], radius: 4 };
const fixed = [
  {
    loop: [
      [-500, -60],
      [500, -60],
      [500, 0],
      [-500, 0],
    ],
  },
  { loop: ramp },
  pin,
];
const names = ['the wall', 'feature 0 (fence)', 'feature 1 (pin)'];
const supported = ([x, y]) => (x > kCut.from && x < kCut.to ? y <= kCut.over : y <= kWidth_mm);

const sceneOf = (aspect) => ({
  part: outlines[aspect],
  fixed,
  force: [Math.cos(-30 * kRad), Math.sin(-30 * kRad)],
  friction: kFriction,
  gyration: 11,
  ends(q) {
    if (!supported(q)) return { outcome: 'rejected', reason: 'loses its support over feature 2 (balcony)' };
    return q[0] > 125 ? { outcome: 'delivered', reason: '' } : null;
  },
});

const turnOf = (deg) => ((deg % 360) + 360) % 360;

function runOf(aspect, deg) {
  const run = travel(sceneOf(aspect), [...kStart, deg * kRad]);
  const last = run.points[run.points.length - 1];
  const exit = run.outcome === 'delivered' ? turnOf(Math.round(last[2] / kRad)) % 360 : null;
  return { ...run, deg, exit, key: `${run.outcome} ${exit}` };
}

// Boundaries between starts of different ends, halved a few times.
function mapOf(aspect) {
  const runs = Array.from({ length: 36 }, (_, i) => runOf(aspect, 10 * i + 1));
  const cuts = [];
  runs.forEach((run, i) => {
    const next = runs[(i + 1) % runs.length];
    if (run.key === next.key) return;
    let [low, high] = [run.deg, run.deg + 10];
    for (let k = 0; k < 5; ++k) {
      const middle = (low + high) / 2;
      if (runOf(aspect, middle).key === run.key) low = middle;
      else high = middle;
    }
    cuts.push({ at: turnOf(high), after: next });
  });
  cuts.sort((a, b) => a.at - b.at);
  return cuts.map((cut, i) => ({ aspect, from: cut.at, to: cuts[(i + 1) % cuts.length].at, run: cut.after }));
}

const range = (deg, from, width) => turnOf(deg - from) <= width;
const angle = (v) => Math.atan2(v[1], v[0]) / kRad;

// Facets of an aspect: from -> two placements (or more, on arcs) of the centre of mass at an orientation.
function facetsOf(part) {
  const facets = [];
  const turnAt = (loop, i) =>
    turnOf(angle(outward(loop, i)) - angle(outward(loop, (i + loop.length - 1) % loop.length)));
  const at = (point, corner) => [point[0] - corner[0], point[1] - corner[1]];
  fixed.forEach((shape, component) => {
    const corners = part.map((_, j) => j).filter((j) => isConvex(part, j));
    if (shape.radius) {
      const { centre, radius } = shape;
      part.forEach((_, j) =>
        facets.push({
          kind: 'EV',
          moving: j,
          fixed: [component, 0],
          label: `edge ${j} on ${names[component]}`,
          line(theta) {
            const m = placed([outward(part, j)], [0, 0, theta])[0];
            const touch = [centre[0] - radius * m[0], centre[1] - radius * m[1]];
            return placed([part[j], part[(j + 1) % part.length]], [0, 0, theta]).map((a) => at(touch, a));
          },
        }),
      );
      for (const j of corners) {
        facets.push({
          kind: 'VE',
          moving: j,
          fixed: [component, 0],
          label: `corner ${j} on ${names[component]}`,
          line(theta) {
            const from = angle(outward(part, (j + part.length - 1) % part.length)) + theta / kRad + 180;
            const width = turnAt(part, j);
            const a = placed([part[j]], [0, 0, theta])[0];
            return Array.from({ length: 9 }, (_, k) => {
              const phi = (from + (width * k) / 8) * kRad;
              return at([centre[0] + radius * Math.cos(phi), centre[1] + radius * Math.sin(phi)], a);
            });
          },
        });
      }
      return;
    }
    shape.loop.forEach((b, i) => {
      const n = outward(shape.loop, i);
      for (const j of corners) {
        if (component === 0 && i !== 2) continue;
        facets.push({
          kind: 'VE',
          moving: j,
          fixed: [component, i],
          label: `corner ${j} on edge ${i} of ${names[component]}`,
          line(theta) {
            const width = turnAt(part, j);
            if (!range(theta / kRad, angle(n) + 180 - angle(outward(part, j)), width)) return [];
            const a = placed([part[j]], [0, 0, theta])[0];
            const ends =
              component === 0 ? kRange_mm.map((x) => [x + a[0], 0]) : [b, shape.loop[(i + 1) % shape.loop.length]];
            return ends.map((p) => at(p, a));
          },
        });
      }
      if (component === 0 || !isConvex(shape.loop, i)) return;
      part.forEach((_, j) =>
        facets.push({
          kind: 'EV',
          moving: j,
          fixed: [component, i],
          label: `edge ${j} on corner ${i} of ${names[component]}`,
          line(theta) {
            const before = angle(outward(shape.loop, (i + shape.loop.length - 1) % shape.loop.length));
            if (!range(theta / kRad, before - angle(outward(part, j)) - 180, turnAt(shape.loop, i))) return [];
            return placed([part[j], part[(j + 1) % part.length]], [0, 0, theta]).map((a) => at(b, a));
          },
        }),
      );
    });
  });
  return facets;
}

// The stretches of a facet's line that no other contact cuts off.
function piecesOf(index, line, part, theta) {
  const pieces = [];
  for (let k = 0; k + 1 < line.length; ++k) {
    const [a, b] = [line[k], line[k + 1]];
    const size = Math.hypot(b[0] - a[0], b[1] - a[1]);
    const place = (u) => [a[0] + u * (b[0] - a[0]), a[1] + u * (b[1] - a[1])];
    // A little off to either side (chords of arcs lie inside): one of them is the free side.
    const state = (u) => {
      const p = place(u);
      const off = [(-0.05 * (b[1] - a[1])) / size, (0.05 * (b[0] - a[0])) / size];
      const free = [1, -1].some((side) => isFree(part, fixed, [p[0] + side * off[0], p[1] + side * off[1], theta]));
      return free && p[1] > 0 ? (supported(p) ? 1 : 0) : null;
    };
    const steps = Math.max(2, Math.ceil(size / 3));
    let from = 0;
    let now = state(1e-4);
    for (let i = 1; i <= steps; ++i) {
      const next = state(i === steps ? 1 - 1e-4 : i / steps);
      let cut = 1;
      if (next !== now && i < steps + 1) {
        let [low, high] = [(i - 1) / steps, i / steps];
        for (let m = 0; m < 6; ++m)
          state((low + high) / 2) === now ? (low = (low + high) / 2) : (high = (low + high) / 2);
        cut = high;
      }
      if (next !== now || i === steps) {
        if (now !== null) pieces.push([index, ...place(from).map(round), ...place(cut).map(round), now]);
        from = cut;
        now = next;
      }
    }
  }
  return pieces;
}

function spaceOf(aspect) {
  const part = outlines[aspect];
  const facets = facetsOf(part);
  const slices = [];
  for (let deg = 0; deg < 360; deg += kTheta_deg) {
    const theta = (deg + 1e-6) * kRad;
    slices.push({ theta_deg: deg, pieces: facets.flatMap((f, i) => piecesOf(i, f.line(theta), part, theta)) });
  }
  return { theta_step_deg: kTheta_deg, slices, facets: facets.map(({ line, ...facet }) => facet) };
}

function turningOf() {
  const intervals = Object.keys(outlines).flatMap(mapOf);
  const exits = new Map();
  for (const { aspect, from, to, run } of intervals) {
    if (run.exit !== null)
      exits.set(`${aspect} ${run.exit}`, (exits.get(`${aspect} ${run.exit}`) ?? 0) + turnOf(to - from));
  }
  const goal = [...exits].sort((a, b) => b[1] - a[1])[0][0];
  const paths = intervals.map(({ aspect, run }) => ({
    aspect,
    start_deg: run.deg,
    outcome: run.outcome,
    reason: run.reason,
    is_goal: `${aspect} ${run.exit}` === goal,
    legs: run.legs.map(({ key, ...leg }) => leg),
    points: run.points.map(([x, y, theta]) => [round(x), round(y), round(theta / kRad)]),
  }));
  return {
    wall_y: 0,
    track_width_mm: kWidth_mm,
    friction: kFriction,
    obstacles: [
      { name: names[1], outline_mm: ramp },
      { name: names[2], centre_mm: pin.centre, radius_mm: pin.radius },
    ],
    parts: Object.fromEntries(
      Object.entries(outlines).map(([aspect, outline]) => [aspect, { outline_mm: outline, holes_mm: [] }]),
    ),
    outcome_map: intervals.map(({ aspect, from, to, run }, i) => ({
      aspect,
      from_deg: from,
      to_deg: to,
      outcome: run.outcome,
      exit_orientation_deg: run.exit,
      path: i,
    })),
    paths,
    space: Object.fromEntries(Object.keys(outlines).map((aspect) => [aspect, spaceOf(aspect)])),
    sensitivity: [0.5, 0.7, 1, 1.4, 2].map((factor) => ({
      gyration_factor: factor,
      same_outcomes: factor > 0.6,
      changed_probability: factor > 0.6 ? 0 : 0.05,
    })),
    transitions: {
      poses: ['up 0.00 deg', 'up 90.00 deg', 'down 0.00 deg'],
      features: [
        {
          name: 'feature 0 (fence)',
          matrix: [
            [0.7, 0.3, 0],
            [0, 1, 0],
            [0, 0.1, 0.6],
          ],
        },
        {
          name: 'feature 2 (balcony)',
          matrix: [
            [1, 0, 0],
            [0, 0, 0],
            [0, 0, 0],
          ],
        },
      ],
    },
  };
}

// A pose of the plain track: the outline turned and put on the wall.
function poseOf(aspect, deg) {
  const points = placed(outlines[aspect], [0, 0, deg * kRad]);
  const low = Math.min(...points.map((p) => p[1]));
  const xs = points.map((p) => p[0]);
  const loop = points.map(([x, y]) => [round(x), round(y - low)]);
  return {
    aspect,
    orientation_deg: deg,
    prior: 0.125,
    com_y_mm: round(-low),
    supported_y_mm: round(-low),
    x_min_mm: Math.min(...xs),
    x_max_mm: Math.max(...xs),
    plain_margin_mm: round(-low),
    plain_hull_mm: loop,
    footprint: { outer_mm: loop, holes_mm: [] },
    upper: [],
  };
}

export function makeReport() {
  const poses = ['up', 'down'].flatMap((aspect) => [0, 90, 180, 270].map((deg) => poseOf(aspect, deg)));
  const turning = turningOf();
  const metrics = {
    efficiency: 0.41,
    purity: 1,
    jam_probability: 0,
    tolerance_mm: 0.6,
    margin_mm: 1.2,
    length_mm: 150,
    feature_count: 3,
    feed_rate_per_min: 40,
  };
  const judged = (pose) => {
    const at = pose.orientation_deg;
    const hit = turning.outcome_map.find(
      (o) => o.aspect === pose.aspect && range(at, o.from_deg, turnOf(o.to_deg - o.from_deg)),
    );
    return {
      aspect: pose.aspect,
      orientation_deg: at,
      prior: pose.prior,
      outcome: hit.outcome,
      exit_orientation_deg: hit.exit_orientation_deg,
      margin_mm: null,
      unsupported_mm: null,
      tip_mm: null,
      decided_by: null,
      may_catch: false,
      marginal: false,
      reason: turning.paths[hit.path].reason,
      is_goal: turning.paths[hit.path].is_goal,
    };
  };
  const results = poses.map(judged);
  const area = (loop) => ({ outer_mm: loop, holes_mm: [] });
  const cut = area([
    [kCut.from, kCut.over],
    [kCut.to, kCut.over],
    [kCut.to, kWidth_mm],
    [kCut.from, kWidth_mm],
  ]);
  const design = {
    id: 'd12',
    number: 12,
    topology: 0,
    label: 'fence + pin + balcony',
    provenance: 'fixture',
    objectives: [0.41, 0.6, 150],
    violation: 0,
    feasible: true,
    metrics,
    worst_case: { ...metrics, bites: null },
    violations: [],
    warnings: [],
    goal_pose: results.findIndex((r) => r.is_goal),
    poses: results.map(({ is_goal, ...r }) => r),
    values: { h: 13 },
    features: [
      { type: 'fence', polygon_mm: ramp },
      { type: 'pin', x_mm: 74, y_mm: 40, diameter_mm: 8, at_mm: 0 },
      { type: 'balcony', width_mm: kCut.over, length_mm: kCut.to - kCut.from, at_mm: kCut.from },
    ],
    track: [
      { type: 'fence', start_mm: 0, end_mm: 46, voids: [], dimensions: [] },
      {
        type: 'pin',
        start_mm: 70,
        end_mm: 78,
        voids: [],
        dimensions: [
          ['x_mm', 74],
          ['y_mm', 40],
          ['diameter_mm', 8],
        ],
      },
      {
        type: 'balcony',
        start_mm: kCut.from,
        end_mm: kCut.to,
        voids: [cut],
        dimensions: [
          ['width_mm', kCut.over],
          ['length_mm', kCut.to - kCut.from],
        ],
      },
    ],
    part: 0,
    travel: null,
    commands: { evaluate: 'formotion evaluate', export: 'formotion export' },
    turning,
  };
  const { turning: none, ...plain } = design;
  return {
    formotion: 1,
    program: 'formotion (fixture)',
    problem: {
      name: 'el bracket turned by a fence',
      slug: 'fixture',
      path: 'fixture.json',
      kind: 'feeder',
      text: '{}',
      goal: { one_pose: true, require_tip: false },
      environment: {
        track_width_mm: kWidth_mm,
        wall_friction: kFriction,
        drive_deg: -30,
        conveying_speed_mm_s: 50,
        tilt_deg: 0,
        spacing_mm: null,
        settling_friction: 0,
      },
      manufacture: { cutter_radius_mm: null, min_web_mm: null },
      uncertainty: null,
      objectives: [
        ['efficiency', true],
        ['tolerance_mm', true],
        ['length_mm', false],
      ].map(([name, maximise]) => ({ name, maximise, resolution: 1e-9 })),
      variables: [{ name: 'h', min: 5, max: 20, value: 10 }],
      topology_count: 1,
      topologies: [{ label: design.label, variables: ['h'] }],
    },
    run: { evaluations: 20, budget: 20, feasible: 2, seed: 1, complete: true },
    history: [{ evaluations: 20, front: 2, best: [0.41, 0.6, 150] }],
    sample: [
      [12, 0, 1, 0, [0.41, 0.6, 150]],
      [7, 0, 1, 0, [0.3, 0.7, 140]],
    ],
    knee: null,
    designs: [
      design,
      {
        ...plain,
        id: 'd7',
        number: 7,
        objectives: [0.3, 0.7, 140],
        metrics: { ...metrics, efficiency: 0.3, tolerance_mm: 0.7, length_mm: 140 },
      },
    ],
    parts: [
      {
        diameter_mm: 36.06,
        poses,
        aspects: Object.entries(outlines).map(([name, loop]) => ({
          name,
          probability: 0.5,
          height_mm: 3,
          com_height_mm: 1.5,
          footprint: area(loop),
          upper: [],
        })),
      },
    ],
  };
}

export const fillPage = (page, report) =>
  page.replace('@formotion-report-data@', () => JSON.stringify(report).replaceAll('<', '\\u003c'));
