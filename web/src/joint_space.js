// The configuration space of a joint, with the paths of insertions.

import { h } from './dom.js';
import { spacePanel } from './space_panel.js';
import { spaceView } from './space.js';

const kMostPaths = 40;

const kWords = {
  views: [
    ['From below', -90],
    ['From the side', -180],
  ],
  below: null,
  caption: [
    'A point of this space is a placement of the part: where its compliance centre is (x, y) and how far it is turned from the drawn pose (\u03b8, upwards, drawn larger). ',
    'A surface is where a feature of the part touches a feature of the fixed shapes, seen from its free side (from behind it is faint): an insertion runs along surfaces, or through the free space between them. Shown near the insertions only.',
  ],
  click: 'click a surface to see that placement dotted above.',
  dotted: '; dotted above.',
};

const empty = (text, id = null) => ({ node: h('p', { class: 'empty', id }, text), view: null });

// picked(placement or null). Answers {node, view or null}.
export function jointSpace(joint, picked) {
  const { space, insertions } = joint;
  if (!space?.slices?.length || !insertions.length)
    return empty('This report leaves the configuration space of this design out, to stay small.');
  const paths = insertions
    .slice(0, kMostPaths)
    .concat(
      insertions
        .slice(kMostPaths)
        .filter((one) => one.outcome !== 'assembled')
        .slice(0, kMostPaths),
    )
    .map(pathOfInsertion);
  const ys = paths.flatMap((p) => p.points.map(([, y]) => y));
  const xs = paths.flatMap((p) => p.points.map(([x]) => x));
  const wide = Math.max(...xs) - Math.min(...xs);
  const thetas = paths.flatMap((p) => p.points.map(([, , theta]) => theta));
  const slices = space.slices;
  const margin = Math.max(1, 0.5 * wide);
  let panel = null;
  const view = spaceView({
    space,
    outline: { outline_mm: [] },
    reach: 1,
    turning: { wall_y: Math.min(...ys) - margin, track_width_mm: Math.max(...ys), obstacles: [] },
    paths,
    part: {
      from: Math.min(slices[0].theta_deg, ...thetas),
      to: Math.max(slices[slices.length - 1].theta_deg, ...thetas),
      margin,
    },
    titles: { x: 'x (mm)', y: 'y (mm)' },
    picked: (facet, placement) => {
      picked(facet ? placement : null);
      panel?.picked(facet, placement);
    },
  });
  if (!view)
    return empty(
      'This picture needs WebGL 2, which this browser does not offer. The figures above show the same insertions.',
      'no-webgl',
    );
  panel = spacePanel(view, space, 'up', kWords);
  return {
    node: panel.node,
    view,
    show: (insertion) => view.show(paths.find((p) => p.insertion === insertion) ?? null),
  };
}

const pathOfInsertion = (insertion) => ({
  insertion,
  outcome: insertion.outcome,
  points: insertion.moments.map((m) => m.q),
});
