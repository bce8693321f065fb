// What stands in the picture of the configuration space: surfaces, lines, the track below, paths, the part's marker.
// `to` takes [x, y, theta] to the picture's coordinates.

import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  Color,
  FrontSide,
  GreaterDepth,
  Group,
  Line,
  LineBasicMaterial,
  LineLoop,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Shape,
  ShapeGeometry,
  SphereGeometry,
  Vector2,
  Vector3,
} from 'three';

import { outlineOf, placed } from './path.js';
import { tube } from './tube.js';

// A colour of the page.
export const colour = (name) => new Color(getComputedStyle(document.documentElement).getPropertyValue(name).trim());
const outcomeColour = (name) =>
  colour(`--${['delivered', 'rejected', 'jammed', 'assembled', 'wedged'].includes(name) ? name : 'other'}`);

export function surfaceMeshes(made, space, to, clip) {
  const kinds = { EV: colour('--contact-ev'), VE: colour('--contact-ve') };
  const supports = { 1: colour('--supported'), 0: colour('--unsupported'), '-1': colour('--other') };
  const geometry = new BufferGeometry();
  const positions = new Float32Array(made.vertices.flatMap((v) => to(v).toArray()));
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(made.triangles.flat());
  geometry.setAttribute('normal', new BufferAttribute(normalsOf(made, positions), 3));
  const colours = new BufferAttribute(new Float32Array(positions.length), 3);
  geometry.setAttribute('color', colours);
  const colourBy = (what) => {
    made.vertices.forEach(([, , , facet, support], i) => {
      const c = what === 'support' ? supports[support] : kinds[space.facets[facet].kind];
      colours.setXYZ(i, c.r, c.g, c.b);
    });
    colours.needsUpdate = true;
  };
  colourBy('kind');
  const common = {
    vertexColors: true,
    clippingPlanes: clip,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  };
  const front = new Mesh(geometry, new MeshLambertMaterial({ ...common, side: FrontSide }));
  const back = new Mesh(
    geometry,
    new MeshLambertMaterial({ ...common, side: BackSide, transparent: true, opacity: 0.17, depthWrite: false }),
  );
  // The same triangles, but only those of one facet.
  const chosen = new BufferGeometry();
  chosen.setAttribute('position', geometry.attributes.position);
  chosen.setIndex(geometry.index);
  const highlight = new Mesh(
    chosen,
    new MeshBasicMaterial({
      color: colour('--highlight'),
      transparent: true,
      opacity: 0.55,
      clippingPlanes: clip,
      side: FrontSide,
    }),
  );
  highlight.visible = false;
  return { front, back, highlight, colourBy };
}

// Smooth over strips of one facet: mean of the triangles at the same place.
function normalsOf(made, positions) {
  const sums = new Map();
  const key = ([x, y, deg, facet]) => `${facet} ${Math.round(deg * 100)} ${Math.round(x * 20)} ${Math.round(y * 20)}`;
  const corner = (i) => new Vector3().fromArray(positions, 3 * i);
  for (const [a, b, c] of made.triangles) {
    const normal = corner(b)
      .sub(corner(a))
      .cross(corner(c).sub(corner(a)));
    for (const i of [a, b, c]) {
      const k = key(made.vertices[i]);
      if (!sums.has(k)) sums.set(k, new Vector3());
      sums.get(k).add(normal);
    }
  }
  sums.forEach((sum) => sum.normalize());
  return new Float32Array(made.vertices.flatMap((v) => (sums.get(key(v)) ?? new Vector3(0, 0, 1)).toArray()));
}

// Facets' ends, contours at every thirty degrees, where support ends.
export function linesOf(made, slices, to, clip) {
  const contours = slices
    .filter(({ theta_deg }) => theta_deg % 30 === 0)
    .flatMap(({ theta_deg: t, pieces }) =>
      pieces.flatMap(([, x0, y0, x1, y1]) => [
        [x0, y0, t],
        [x1, y1, t],
      ]),
    );
  return [
    [made.borders, 0.42],
    [contours, 0.16],
    [made.supportEnds, 0.8],
  ].map(
    ([points, opacity]) =>
      new LineSegments(
        new BufferGeometry().setFromPoints(points.map(to)),
        new LineBasicMaterial({ color: colour('--ink'), transparent: true, opacity, clippingPlanes: clip }),
      ),
  );
}

// The track under the space: its edges, the wall's face, what stands on it.
export function floorOf(turning, box, to) {
  const group = new Group();
  const at = (points) => points.map(to);
  const line = (points, shade) =>
    new Line(new BufferGeometry().setFromPoints(at(points)), new LineBasicMaterial({ color: shade }));
  const flat = (points, shade, below) => {
    const shape = new Shape(at(points).map((v) => new Vector2(v.x, v.y)));
    const mesh = new Mesh(
      new ShapeGeometry(shape),
      new MeshBasicMaterial({
        color: shade,
        depthWrite: false,
        polygonOffset: true,
        polygonOffsetFactor: below,
        polygonOffsetUnits: below,
      }),
    );
    mesh.position.z = to([0, 0]).z;
    return mesh;
  };
  const { xMin, xMax } = box;
  group.add(
    flat(
      [
        [xMin, turning.wall_y],
        [xMax, turning.wall_y],
        [xMax, turning.track_width_mm],
        [xMin, turning.track_width_mm],
      ],
      colour('--floor'),
      6,
    ),
    line(
      [
        [xMin, turning.track_width_mm],
        [xMax, turning.track_width_mm],
      ],
      colour('--muted'),
    ),
    line(
      [
        [xMin, turning.wall_y],
        [xMax, turning.wall_y],
      ],
      colour('--ink'),
    ),
  );
  for (const o of turning.obstacles) group.add(flat(outlineOf(o), colour('--obstacle'), 4));
  return group;
}

export function tubesOf(path, isChosen, base, to, radius) {
  const shade = outcomeColour(path.outcome);
  const thick = isChosen ? 0.0085 * radius : 0.003 * radius;
  const opacity = isChosen ? 1 : 0.8;
  return lapsOf(path.points, base).flatMap((lap) => {
    const line = lap.map(to);
    const geometry = tube(line, thick, isChosen ? 10 : 5);
    if (!geometry) return [];
    const seen = new Mesh(
      geometry,
      new MeshLambertMaterial({
        color: shade,
        transparent: !isChosen,
        opacity,
        emissive: shade,
        emissiveIntensity: 0.25,
      }),
    );
    if (!isChosen) return [seen];
    const hidden = new Mesh(
      geometry,
      new MeshBasicMaterial({
        color: shade,
        transparent: true,
        opacity: 0.28,
        depthFunc: GreaterDepth,
        depthWrite: false,
      }),
    );
    const ends = [line[0], line[line.length - 1]].map((at) => {
      const cap = new Mesh(new SphereGeometry(thick, 10, 8), seen.material);
      cap.position.copy(at);
      return cap;
    });
    return [seen, hidden, ...ends];
  });
}

// A path over full turns, cut where theta passes the seam.
function lapsOf(points, base) {
  const laps = [[]];
  const lapOf = (deg) => Math.floor((deg - base) / 360);
  points.forEach(([x, y, deg], i) => {
    const lap = lapOf(deg);
    if (i > 0 && lapOf(points[i - 1][2]) !== lap) {
      const [px, py, before] = points[i - 1];
      const up = lap > lapOf(before);
      const edge = base + 360 * (up ? lap : lap + 1);
      const t = (edge - before) / (deg - before);
      const at = [px + t * (x - px), py + t * (y - py)];
      laps[laps.length - 1].push([...at, up ? base + 360 : base]);
      laps.push([[...at, up ? base : base + 360]]);
    }
    laps[laps.length - 1].push([x, y, deg - 360 * lap]);
  });
  return laps;
}

// Where the animation is: a ball, the part's outline at its height, a plumb line to the floor.
export function markerOf(outline, radius) {
  const ball = new Mesh(
    new SphereGeometry(0.02 * radius, 20, 14),
    new MeshLambertMaterial({ color: 0xffffff, emissive: 0x999999 }),
  );
  const ring = new Mesh(ball.geometry, new MeshBasicMaterial({ side: BackSide }));
  ring.scale.setScalar(1.35);
  const body = new LineLoop(new BufferGeometry(), new LineBasicMaterial());
  const plumb = new Line(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.5 }));
  const node = new Group();
  node.add(ring, ball, body, plumb);
  return {
    node,
    move([x, y, theta], below, to, result) {
      const shade = outcomeColour(result);
      const at = to([x, y, theta]);
      ball.position.copy(at);
      ring.position.copy(at);
      for (const item of [ring, body, plumb]) item.material.color = shade;
      body.geometry.setFromPoints(outline.outline_mm.map((p) => to([...placed(p, [x, y, theta]), theta])));
      plumb.geometry.setFromPoints([at, below]);
    },
  };
}
