// The configuration space as a picture: surfaces of contact over (x, y, theta), paths along them. Turned by dragging.

import {
  AmbientLight,
  BufferGeometry,
  DirectionalLight,
  Group,
  LineBasicMaterial,
  LineSegments,
  PerspectiveCamera,
  Plane,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';

import { axesOverlay } from './axes3.js';
import { h, onWidth } from './dom.js';
import { boxOf } from './geometry.js';
import { outlineOf, turned } from './path.js';
import { colour, floorOf, linesOf, markerOf, surfaceMeshes, tubesOf } from './space_meshes.js';
import { surfaces, windowed } from './surfaces.js';

const kTall = 0.5; // a full turn's height, as a share of the length along the track
const kFilled = 0.85; // share of the picture that the box fills
const kPaper_px = 700; // up to this width the picture is drawn finely enough for paper
const kFlat_deg = 2; // of views along an axis: nearly parallel
const kView = { azimuth: -64, elevation: 26 };

// One renderer for the whole page: browsers allow few of them.
let shared = null;
function rendererOrNull() {
  if (shared) return shared;
  const canvas = h('canvas', { tabindex: 0, role: 'img', 'aria-label': 'Configuration space; arrow keys turn it' });
  const context = canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });
  if (!context) return null;
  shared = new WebGLRenderer({ canvas, context, antialias: true, preserveDrawingBuffer: true });
  shared.localClippingEnabled = true;
  shared.setClearColor(0xffffff);
  return shared;
}

// space: of one aspect; paths: those of that aspect; picked(facet, placement) is told what was clicked.
// part: {from, to, margin} where the space holds only some theta: these, and the mm shown beside the paths; titles: of the
// axes. Answers null without WebGL, else the picture's node, what its controls do (range: of theta, for clipTo),
// show(path), follow(placement, path) and release().
export function spaceView({ space, outline, reach, turning, paths, picked, part = null, titles = undefined }) {
  const renderer = rendererOrNull();
  if (!renderer) return null;
  const canvas = renderer.domElement;
  const base = part ? part.from : seam(space, paths);
  const span = part ? part.to - part.from : 360;
  const margin = part ? part.margin : reach / 2;
  const held = boxOf([...paths.map((p) => p.points), ...turning.obstacles.map(outlineOf)]);
  const [least, most] = [held.xMin - margin, held.xMax + margin];
  const slices = windowed(part ? space.slices : from(space.slices, base), [least, most], turning.wall_y);
  const made = surfaces({ ...space, slices }, reach);
  const box = boxOf([made.vertices, ...paths.map((p) => p.points)]);
  box.yMin = Math.min(box.yMin, turning.wall_y);
  box.yMax = Math.max(box.yMax, turning.track_width_mm);
  const size = [box.xMax - box.xMin, box.yMax - box.yMin];
  const tall = kTall * Math.max(size[0], size[1]);
  const middle = [(box.xMin + box.xMax) / 2, (box.yMin + box.yMax) / 2];
  const to = ([x, y, deg]) => new Vector3(x - middle[0], y - middle[1], ((deg - base) / span - 0.5) * tall);
  const lifted = (deg) => (part ? deg : base + turned(deg - base));
  const radius = Math.hypot(size[0], size[1], tall) / 2;
  const corners = [box.xMin, box.xMax].flatMap((x) =>
    [box.yMin, box.yMax].flatMap((y) => [base, base + span].map((t) => to([x, y, t]))),
  );

  const scene = new Scene();
  const camera = new PerspectiveCamera();
  camera.up.set(0, 0, 1);
  const lamp = new DirectionalLight(0xffffff, 2.1);
  scene.add(new AmbientLight(0xffffff, 1.5), lamp, camera);
  const clip = [new Plane(new Vector3(0, 0, 1), tall), new Plane(new Vector3(0, 0, -1), tall)];

  const { front, back, highlight, colourBy } = surfaceMeshes(made, space, to, clip);
  const section = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: colour('--ink') }));
  const lines = linesOf(made, slices, to, clip);
  scene.add(
    back,
    front,
    highlight,
    ...lines,
    section,
    floorOf(turning, box, ([x, y]) => to([x, y, base])),
  );
  const tubes = new Group();
  scene.add(tubes);
  const marker = markerOf(outline, radius);
  scene.add(marker.node);

  const state = { ...kView, zoom: 1, flat: false, px: 0 };
  const overlay = axesOverlay(box, base, to, span, titles);
  const tip = h('div', { class: 'tip', hidden: true });
  const frame = h('div', { class: 'space-frame', 'data-triangles': made.triangles.length }, canvas, overlay.node, tip);
  let asked = false;
  function render() {
    asked = false;
    if (!frame.isConnected || canvas.parentNode !== frame || !state.px) return;
    const [a, e] = [(state.azimuth * Math.PI) / 180, (state.elevation * Math.PI) / 180];
    const eye = new Vector3(Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e));
    camera.fov = state.flat ? kFlat_deg : state.fov;
    stand(camera, eye, corners, state.zoom, 2 * radius);
    lamp.position
      .copy(camera.position)
      .add(new Vector3(0, 0, radius))
      .applyAxisAngle(new Vector3(0, 0, 1), 0.5);
    renderer.render(scene, camera);
    overlay.draw(camera, state.px, height(), state.azimuth);
  }
  // Out of sight nothing is drawn: the animation above may run.
  let seen = true;
  const watch = new IntersectionObserver(([entry]) => {
    seen = entry.isIntersecting;
    if (seen) soon();
  });
  watch.observe(frame);
  const soon = () => {
    if (asked || !seen) return;
    asked = true;
    requestAnimationFrame(render);
  };
  const height = () => Math.round(Math.max(320, Math.min(600, 0.58 * state.px)));
  onWidth(frame, (px) => {
    state.px = px;
    const ratio = px / height();
    renderer.setPixelRatio(px > kPaper_px ? Math.min(2, devicePixelRatio) : 2);
    renderer.setSize(px, height());
    camera.aspect = ratio;
    state.fov = ratio > 1.5 ? 26 : (2 * Math.atan((Math.tan((13 * Math.PI) / 180) * 1.5) / ratio) * 180) / Math.PI;
    render();
  });

  const look = (azimuth, elevation, { zoom = 1, flat = false } = {}) => {
    state.flat = flat;
    state.azimuth = azimuth;
    state.elevation = Math.max(-5, Math.min(89.9, elevation));
    state.zoom = Math.max(0.25, Math.min(2, state.zoom * zoom));
    soon();
  };
  const hitAt = (event) => {
    const area = canvas.getBoundingClientRect();
    const at = new Vector2(
      ((event.clientX - area.left) / area.width) * 2 - 1,
      1 - ((event.clientY - area.top) / area.height) * 2,
    );
    const ray = new Raycaster();
    ray.setFromCamera(at, camera);
    const hit = ray
      .intersectObject(front)
      .find(({ point }) => clip.every((plane) => plane.distanceToPoint(point) >= 0));
    if (!hit) return null;
    const theta = base + (hit.point.z / tall + 0.5) * span;
    return { facet: made.facetOf[hit.faceIndex], placement: [hit.point.x + middle[0], hit.point.y + middle[1], theta] };
  };
  function choose(hit) {
    highlight.visible = Boolean(hit);
    if (hit) highlight.geometry.setDrawRange(...made.rangeOf[hit.facet]);
    picked(hit ? space.facets[hit.facet] : null, hit?.placement ?? null);
    soon();
  }
  const abort = handle(canvas, state, look, hitAt, choose, (facet) => space.facets[facet].label, tip);

  function clipTo(low, high) {
    clip[0].constant = -((low - base) / span - 0.5) * tall + 1e-3;
    clip[1].constant = ((high - base) / span - 0.5) * tall + 1e-3;
    const cut = [low > base ? low : null, high < base + span ? high : null].filter((v) => v !== null);
    const points = cut.flatMap((deg) => {
      const slice = slices.reduce((a, b) => (Math.abs(b.theta_deg - deg) < Math.abs(a.theta_deg - deg) ? b : a));
      return slice.pieces.flatMap(([, x0, y0, x1, y1]) => [to([x0, y0, deg]), to([x1, y1, deg])]);
    });
    section.geometry.dispose();
    section.geometry = new BufferGeometry().setFromPoints(points);
    soon();
  }
  clipTo(base, base + span);

  return {
    node: frame,
    release() {
      abort.abort();
      watch.disconnect();
      scene.traverse((item) => {
        item.geometry?.dispose();
        item.material?.dispose();
      });
    },
    range: [base, base + span],
    look,
    reset: () => {
      state.zoom = 1;
      look(kView.azimuth, kView.elevation);
    },
    clipTo,
    colourBy: (what) => {
      colourBy(what);
      lines[2].visible = what === 'support';
      soon();
    },
    facet: (index) =>
      choose(index === null || !made.middleOf[index] ? null : { facet: index, placement: made.middleOf[index] }),
    show(chosen) {
      tubes.children.forEach((child) => child.geometry.dispose());
      tubes.clear();
      for (const path of paths) tubes.add(...tubesOf(path, path === chosen, part ? -180 : base, to, radius));
      soon();
    },
    follow(placement, path) {
      const [x, y, deg] = placement;
      marker.move([x, y, lifted(deg)], to([x, y, base]), to, path.outcome);
      soon();
    },
  };
}

// The camera looks along -eye; far enough that all corners are in the picture, and aside so that they are in its middle.
function stand(camera, eye, corners, zoom, deep) {
  camera.position.copy(eye);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  const [right, up, back] = [0, 1, 2].map((k) => new Vector3().setFromMatrixColumn(camera.matrixWorld, k));
  const high = Math.tan((camera.fov * Math.PI) / 360) * kFilled;
  // Along one axis of the picture: a corner at c, b towards the eye, is in it when |c - m| <= t (d - b).
  const fit = (axis, t) => {
    const ends = [1, -1].map((sign) => Math.max(...corners.map((p) => (sign * p.dot(axis)) / t + p.dot(back))));
    return { distance: (ends[0] + ends[1]) / 2, middle: ((ends[0] - ends[1]) / 2) * t };
  };
  const [x, y] = [fit(right, high * camera.aspect), fit(up, high)];
  const distance = Math.max(x.distance, y.distance) * zoom;
  camera.near = Math.max(deep / 100, distance - deep);
  camera.far = distance + deep;
  camera.updateProjectionMatrix();
  camera.position.copy(eye).multiplyScalar(distance).addScaledVector(right, x.middle).addScaledVector(up, y.middle);
  camera.updateMatrixWorld();
}

// Theta goes round; the picture is cut open where the paths pass least.
function seam(space, paths) {
  const step = space.theta_step_deg;
  const count = space.slices.map(() => 0);
  for (const { points } of paths) {
    points.forEach(([, , deg], i) => {
      if (i === 0) return;
      const size = Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]) + 1e-3;
      for (let off = -8; off <= 8; ++off) {
        count[(Math.round(turned(deg) / step) + off + 2 * count.length) % count.length] += size * (9 - Math.abs(off));
      }
    });
  }
  const at = space.slices[count.indexOf(Math.min(...count))].theta_deg;
  return at >= 180 ? at - 360 : at;
}

// Slices in order from a theta of them on.
function from(slices, base) {
  const lifted = slices.map((slice) => ({ ...slice, theta_deg: base + turned(slice.theta_deg - base) }));
  return lifted.sort((a, b) => a.theta_deg - b.theta_deg);
}

// Dragging turns, keys and buttons too; a click without dragging picks.
function handle(canvas, state, look, hitAt, choose, labelOf, tip) {
  let from = null;
  let dragged = false;
  const abort = new AbortController();
  const on = (name, listener) => canvas.addEventListener(name, listener, { signal: abort.signal });
  on('pointerdown', (event) => {
    from = [event.clientX, event.clientY, state.azimuth, state.elevation];
    dragged = false;
    canvas.setPointerCapture(event.pointerId);
  });
  on('pointermove', (event) => {
    if (from) {
      const [dx, dy] = [event.clientX - from[0], event.clientY - from[1]];
      if (Math.hypot(dx, dy) > 4) dragged = true;
      if (dragged) look(from[2] - 0.4 * dx, from[3] + 0.4 * dy);
      tip.hidden = true;
      return;
    }
    const hit = hitAt(event);
    tip.hidden = !hit;
    canvas.style.cursor = hit ? 'pointer' : 'grab';
    if (!hit) return;
    const area = canvas.getBoundingClientRect();
    tip.textContent = labelOf(hit.facet);
    tip.style.left = `${Math.min(event.clientX - area.left + 14, area.width - 220)}px`;
    tip.style.top = `${event.clientY - area.top + 12}px`;
  });
  on('pointerup', (event) => {
    if (from && !dragged) choose(hitAt(event));
    from = null;
  });
  on('pointercancel', () => {
    from = null;
  });
  on('pointerleave', () => {
    tip.hidden = true;
  });
  on('wheel', (event) => {
    if (!event.ctrlKey) return; // the page scrolls
    event.preventDefault();
    look(state.azimuth, state.elevation, { zoom: Math.exp(0.004 * event.deltaY), flat: state.flat });
  });
  on('keydown', (event) => {
    const turn = { ArrowLeft: [6, 0], ArrowRight: [-6, 0], ArrowUp: [0, 4], ArrowDown: [0, -4] }[event.key];
    const zoom = { '+': 0.9, '=': 0.9, '-': 1 / 0.9 }[event.key];
    if (!turn && !zoom) return;
    event.preventDefault();
    look(state.azimuth + (turn?.[0] ?? 0), state.elevation + (turn?.[1] ?? 0), { zoom, flat: state.flat && !turn });
  });
  return abort;
}
