// A crude motion of a part among fixed shapes, for pages to draw: small steps, contacts by nearest points, forces by
// projected Gauss-Seidel. Nothing here is judged by; the program's own analysis is exact.

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1];
export const cross = (a, b) => a[0] * b[1] - a[1] * b[0];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
const length = (a) => Math.hypot(a[0], a[1]);
const kNear_mm = 0.05;
const kStep_mm = 0.5;

export function placed(points, [x, y, theta]) {
  const [c, s] = [Math.cos(theta), Math.sin(theta)];
  return points.map(([u, v]) => [x + c * u - s * v, y + s * u + c * v]);
}

export function contains(loop, [x, y]) {
  let odd = false;
  loop.forEach((a, i) => {
    const b = loop[(i + 1) % loop.length];
    if (a[1] > y !== b[1] > y && x < a[0] + ((y - a[1]) / (b[1] - a[1])) * (b[0] - a[0])) odd = !odd;
  });
  return odd;
}

export function outward(loop, i) {
  const e = minus(loop[(i + 1) % loop.length], loop[i]);
  return [e[1] / length(e), -e[0] / length(e)];
}
export const isConvex = (loop, i) => {
  const n = loop.length;
  return cross(minus(loop[i], loop[(i + n - 1) % n]), minus(loop[(i + 1) % n], loop[i])) > 0;
};

// Signed distance to a loop, the edge nearest and whether it is its inside that is near.
function nearest(loop, p) {
  let best = { distance: Infinity };
  loop.forEach((a, i) => {
    const e = minus(loop[(i + 1) % loop.length], a);
    const t = dot(minus(p, a), e) / dot(e, e);
    const u = Math.max(0, Math.min(1, t));
    const at = [a[0] + u * e[0], a[1] + u * e[1]];
    const distance = length(minus(p, at));
    if (distance < best.distance)
      best = { distance, at, edge: i, corner: t <= 0 ? i : t >= 1 ? (i + 1) % loop.length : -1 };
  });
  return { ...best, gap: contains(loop, p) ? -best.distance : best.distance };
}

// Contacts at a place: the normal points into the part.
export function contactsAt(part, fixed, q, near = kNear_mm) {
  const loop = placed(part, q);
  const found = [];
  const add = (kind, id, point, normal, gap) => {
    if (gap < near) found.push({ kind, id, point, normal, gap, lever: minus(point, [q[0], q[1]]) });
  };
  fixed.forEach((shape, component) => {
    if (shape.radius) {
      const hit = nearest(loop, shape.centre);
      const away = minus(hit.at, shape.centre);
      const normal = [away[0] / length(away), away[1] / length(away)];
      const point = [shape.centre[0] + shape.radius * normal[0], shape.centre[1] + shape.radius * normal[1]];
      const kind = hit.corner < 0 ? 'EV' : 'VE';
      add(kind, `${kind} ${hit.edge} ${component}`, point, normal, hit.gap - shape.radius);
      return;
    }
    loop.forEach((p, j) => {
      if (!isConvex(part, j)) return;
      const hit = nearest(shape.loop, p);
      if (hit.corner < 0) add('VE', `VE ${j} ${component} ${hit.edge}`, p, outward(shape.loop, hit.edge), hit.gap);
    });
    shape.loop.forEach((b, i) => {
      if (!isConvex(shape.loop, i)) return;
      const hit = nearest(loop, b);
      const n = outward(loop, hit.edge);
      if (hit.corner < 0) add('EV', `EV ${hit.edge} ${component} ${i}`, b, [-n[0], -n[1]], hit.gap);
    });
  });
  return found;
}

export function isFree(part, fixed, q) {
  const loop = placed(part, q);
  const crosses = (a, b, c, d) => {
    const side = (p, r, s) => cross(minus(r, p), minus(s, p));
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
  };
  return fixed.every((shape) => {
    if (shape.radius) return nearest(loop, shape.centre).gap >= shape.radius;
    if (loop.some((p) => contains(shape.loop, p)) || shape.loop.some((p) => contains(loop, p))) return false;
    return loop.every((a, i) =>
      shape.loop.every((c, k) => !crosses(a, loop[(i + 1) % loop.length], c, shape.loop[(k + 1) % shape.loop.length])),
    );
  });
}

// The velocity under a force of size 1 with friction, and which contacts carry.
function velocity(contacts, force, friction, gyration) {
  const v = [force[0], force[1], 0];
  const rows = contacts.map((c) => {
    const tangent = [-c.normal[1], c.normal[0]];
    const row = (d) => ({ g: [d[0], d[1], cross(c.lever, d)], sum: 0 });
    return {
      normal: row(c.normal),
      tangent: row(tangent),
      wanted: c.gap < 0 ? Math.min(1, -c.gap) : -c.gap / kStep_mm,
    };
  });
  const mobility = [1, 1, 1 / gyration ** 2];
  const push = (row, wanted, low, high) => {
    const speed = row.g.reduce((sum, g, k) => sum + g * v[k], 0);
    const inverse = row.g.reduce((sum, g, k) => sum + g * g * mobility[k], 0);
    const next = Math.max(low, Math.min(high, row.sum + (wanted - speed) / inverse));
    row.g.forEach((g, k) => (v[k] += mobility[k] * g * (next - row.sum)));
    row.sum = next;
  };
  for (let i = 0; i < 80; ++i) {
    for (const { normal, tangent, wanted } of rows) {
      push(normal, wanted, 0, Infinity);
      push(tangent, 0, -friction * normal.sum, friction * normal.sum);
    }
  }
  const carrying = contacts
    .map((c, i) => ({
      ...c,
      load: rows[i].normal.sum,
      slip: rows[i].tangent.g.reduce((sum, g, k) => sum + g * v[k], 0),
    }))
    .filter((c) => c.load > 1e-3);
  return { v, carrying };
}

// scene: {part, fixed, force, friction, gyration, xEnd, ends(q) -> null or {outcome, reason}}.
export function travel(scene, start) {
  let q = start;
  const points = [];
  const legs = [];
  let slow = 0;
  let pending = 0;
  for (let step = 0; step < 1500; ++step) {
    const { v, carrying } = velocity(
      contactsAt(scene.part, scene.fixed, q, 0.6),
      scene.force,
      scene.friction,
      scene.gyration,
    );
    const key = carrying.map((c) => c.id + (Math.abs(c.slip) < 1e-3 ? ' sticks' : '')).join();
    const last = legs[legs.length - 1];
    pending = last && key !== last.key ? pending + 1 : 0;
    if (!last || pending > 2) {
      const turns = Math.abs(v[2]) > 1e-4;
      const sticks = carrying.some((c) => Math.abs(c.slip) < 1e-3);
      const motion = !carrying.length
        ? 'free'
        : !turns
          ? 'translation'
          : carrying.length > 1
            ? 'curve'
            : sticks
              ? 'pivot'
              : 'slide';
      const event = !last
        ? 'start'
        : carrying.length > last.contacts.length
          ? 'touches'
          : carrying.length < last.contacts.length
            ? 'lifts off'
            : 'corner';
      const contacts = carrying.map((c) => ({
        kind: c.kind,
        point_mm: c.point,
        normal: c.normal,
        sticks: Math.abs(c.slip) < 1e-3,
      }));
      legs.push({ key, motion, event, from: points.length, contacts });
      pending = 0;
    }
    points.push(q);
    const end = scene.ends(q);
    const speed = Math.hypot(v[0], v[1], v[2] * scene.gyration);
    slow = speed < 0.02 ? slow + 1 : 0;
    if (end || slow > 8) return { points, legs, ...(end ?? { outcome: 'jammed', reason: 'comes to rest' }) };
    q = q.map((value, k) => value + (kStep_mm * v[k]) / Math.max(1, speed));
  }
  return { points, legs, outcome: 'undecided', reason: 'more than 1500 steps' };
}
