// A tube about a polyline, its corners kept.

import { BufferAttribute, BufferGeometry, Vector3 } from 'three';

const kMost = 500; // points

export function tube(line, radius, sides) {
  const points = thinned(line, radius / 4);
  if (points.length < 2) return null;
  const positions = [];
  const normals = [];
  const index = [];
  let across = null;
  points.forEach((p, i) => {
    const along = points[Math.min(i + 1, points.length - 1)].clone().sub(points[Math.max(i - 1, 0)]);
    if (along.lengthSq() < 1e-18) along.set(0, 0, 1);
    along.normalize();
    // The frame turns with the line as little as it can.
    if (!across) across = Math.abs(along.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
    across = across.clone().addScaledVector(along, -across.dot(along)).normalize();
    const other = along.clone().cross(across);
    for (let k = 0; k < sides; ++k) {
      const phi = (2 * Math.PI * k) / sides;
      const out = across.clone().multiplyScalar(Math.cos(phi)).addScaledVector(other, Math.sin(phi));
      normals.push(...out.toArray());
      positions.push(...out.multiplyScalar(radius).add(p).toArray());
      if (i === 0) continue;
      const [a, b] = [sides * i + k, sides * i + ((k + 1) % sides)];
      index.push(a, a - sides, b, b, a - sides, b - sides);
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  geometry.setIndex(index);
  return geometry;
}

// Without points that stand closer than `least`, and at most kMost of them.
function thinned(line, least) {
  const kept = [];
  line.forEach((p, i) => {
    if (!kept.length || i === line.length - 1 || p.distanceTo(kept[kept.length - 1]) > least) kept.push(p);
  });
  const every = Math.ceil(kept.length / kMost);
  return kept.filter((_, i) => i % every === 0 || i === kept.length - 1);
}
