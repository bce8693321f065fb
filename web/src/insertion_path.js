// An insertion between its moments: the part, its contacts, the carrier. Travel is the carrier's, in mm; a placement is
// [x, y, theta_deg] of the compliance centre.

import { carried, placed } from './path.js';

const between = (a, b, t) => a + t * (b - a);
const sameContact = (a, b) =>
  a.kind === b.kind && a.moving === b.moving && a.fixed[0] === b.fixed[0] && a.fixed[1] === b.fixed[1];

// direction_deg: of the approach.
export function insertionPath(insertion, direction_deg) {
  const { moments } = insertion;
  const rad = (direction_deg * Math.PI) / 180;
  const along = [Math.cos(rad), Math.sin(rad)];
  const first = moments[0];

  function indexAt(travel) {
    let i = 0;
    while (i + 1 < moments.length && moments[i + 1].travel_mm <= travel + 1e-9) ++i;
    return i;
  }

  return {
    from: first.travel_mm,
    to: moments[moments.length - 1].travel_mm,
    indexAt,
    // What holds at a travel: numbers between two moments, the event and the contacts of the earlier one.
    at(travel) {
      const i = indexAt(travel);
      const [a, b] = [moments[i], moments[i + 1] ?? moments[i]];
      const span = b.travel_mm - a.travel_mm;
      const t = span > 0 ? Math.max(0, Math.min(1, (travel - a.travel_mm) / span)) : 0;
      const mixed = (name) => between(a[name], b[name], t);
      const q = a.q.map((v, k) => between(v, b.q[k], t));
      const moved = carried(
        a.contacts.map((c) => ({ ...c, point_mm: c.point })),
        a.q,
        q,
        [],
      );
      return {
        index: i,
        event: a.event,
        q,
        depth: mixed('depth_mm'),
        axial: mixed('axial_n'),
        lateral: mixed('lateral_n'),
        moment: mixed('moment_nmm'),
        contacts: moved.map(({ point, normal }, k) => {
          const contact = a.contacts[k];
          const later = b.contacts.find((c) => sameContact(c, contact));
          const [n, tangential] = contact.force.map((v, m) => between(v, later ? later.force[m] : v, t));
          return {
            point,
            normal,
            sticks: contact.mode === 'stick',
            force: [n * normal[0] - tangential * normal[1], n * normal[1] + tangential * normal[0]],
          };
        }),
        carrier: [
          first.q[0] + (travel - first.travel_mm) * along[0],
          first.q[1] + (travel - first.travel_mm) * along[1],
          first.q[2],
        ],
      };
    },
  };
}

// Loops of the part as it is held: mirrored about the line x = 0 through its compliance centre.
export const heldLoops = (part, mirrored) =>
  mirrored ? part.map((loop) => loop.map(([x, y]) => [-x, y]).reverse()) : part;

export const placedLoops = (loops, q) => loops.map((loop) => loop.map((p) => placed(p, q)));
