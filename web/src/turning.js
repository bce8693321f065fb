// Designs whose parts turn: every starting orientation, the path of one, and the configuration space with its paths.

import { h } from './dom.js';
import { contains, ring, widthOf } from './ring.js';
import { degrees } from './format.js';
import { intervalTable, ringLegend } from './intervals.js';
import { pathTravel } from './path_travel.js';
import { reachOf, turned } from './path.js';
import { spaceView } from './space.js';
import { spacePanel } from './space_panel.js';
import { sensitivityWords, transitionTables } from './transitions.js';

// Answers {node, pause, select(aspect, deg)}; select: the interval that a start is in, without playing.
export function turningSection(design, part, width) {
  const { turning } = design;
  const outlineOf = (aspect) => turning.parts?.[aspect] ?? footprint(part, aspect);
  const paths = turning.paths ?? [];
  const intervals = turning.outcome_map.map((o, index) => ({ ...o, index, goal: isGoal(o, design, paths) }));
  const aspects = [...new Set(intervals.map((i) => i.aspect))];
  let chosen = null;
  let running = null;
  let space = null;

  const travel = h('div', { id: 'travel' });
  const spaceBox = h('div', { id: 'space' });
  const rings = aspects.map((aspect) =>
    ring(
      aspect,
      intervals.filter((i) => i.aspect === aspect),
      outlineOf(aspect),
      (index) => {
        choose(intervals[index]);
        running?.run();
        if (running) travel.scrollIntoView({ block: 'nearest' });
      },
    ),
  );
  const table = intervalTable(intervals, (interval) => {
    choose(interval);
    running?.run();
  });

  function choose(interval) {
    const aspectBefore = chosen?.aspect;
    chosen = interval;
    running?.pause();
    running = null;
    const path = interval.path === null || interval.path === undefined ? null : paths[interval.path];
    rings.forEach((r) => r.mark(interval.index, turned(path?.start_deg ?? interval.from_deg + widthOf(interval) / 2)));
    table.mark(interval.index);
    if (aspectBefore !== interval.aspect) drawSpace(interval.aspect);
    else space?.view.facet(null);
    if (!path || !path.points.length) {
      travel.replaceChildren(
        h(
          'p',
          { class: 'empty' },
          `This report holds no path for ${degrees(interval.from_deg)} to ${degrees(interval.to_deg)}.`,
        ),
      );
      space?.view.show(null);
      return;
    }
    const outline = outlineOf(path.aspect);
    running = pathTravel(path, design, outline, reachOf(outline.outline_mm), width, (placement) =>
      space?.view.follow(placement, path),
    );
    space?.view.show(path);
    travel.replaceChildren(running.node);
  }

  function drawSpace(aspect) {
    const data = turning.space?.[aspect];
    space?.view.release();
    space = null;
    if (!data?.slices?.length) {
      spaceBox.replaceChildren(
        h('p', { class: 'empty' }, 'This report holds the configuration space of other designs only, to stay small.'),
      );
      return;
    }
    const outline = outlineOf(aspect);
    const view = spaceView({
      space: data,
      outline,
      reach: reachOf(outline.outline_mm),
      turning,
      paths: paths.filter((p) => p.aspect === aspect && p.points.length > 1),
      picked: (facet, placement) => {
        running?.pick(facet, placement);
        space?.picked(facet, placement);
      },
    });
    if (!view) {
      spaceBox.replaceChildren(
        h(
          'p',
          { class: 'empty', id: 'no-webgl' },
          'This picture needs WebGL 2, which this browser does not offer. All numbers of it are in the report file; the figures above show the same paths.',
        ),
      );
      return;
    }
    space = spacePanel(view, data, aspect);
    spaceBox.replaceChildren(space.node);
  }

  const node = h(
    'div',
    { class: 'turning-section' },
    h('h3', { id: 'ring-title' }, 'Every starting orientation'),
    h(
      'p',
      { class: 'small' },
      'Round the ring: how the part is turned when it arrives, counter-clockwise. In the middle: the part as it arrives (filled) and as it leaves (dashed). ',
      h(
        'span',
        { class: 'screen' },
        'Move over the ring to turn the part; click an interval, or press Enter on it, to see its path.',
      ),
    ),
    h(
      'div',
      { class: 'rings', id: 'rings' },
      rings.map((r) => r.node),
      table.node,
    ),
    ringLegend(intervals),
    turning.sensitivity?.length ? sensitivityWords(turning.sensitivity) : null,
    h('h3', { id: 'travel-title' }, 'Its path over the track'),
    travel,
    h('h3', { id: 'space-title' }, 'All placements at once: the configuration space'),
    spaceBox,
    turning.transitions?.features?.length
      ? [
          h('h3', null, 'From pose to pose, feature by feature'),
          h(
            'p',
            { class: 'small' },
            'Rows: the pose in which a part comes to a feature; columns: the pose in which it leaves; numbers are shares of that row.',
          ),
          transitionTables(turning.transitions),
        ]
      : null,
  );
  return {
    node,
    pause: () => running?.pause(),
    select(aspect, deg) {
      const hit = intervals.find((i) => i.aspect === aspect && contains(i, deg)) ?? intervals[0];
      if (hit && hit !== chosen) choose(hit);
    },
  };
}

function footprint(part, aspect) {
  const { outer_mm, holes_mm } = (part.aspects.find((a) => a.name === aspect) ?? part.aspects[0]).footprint;
  return { outline_mm: outer_mm, holes_mm };
}

// A path says it; without one the exit is compared with the goal's pose.
function isGoal(interval, design, paths) {
  if (interval.outcome !== 'delivered') return false;
  const path = paths[interval.path];
  if (path) return path.is_goal;
  const goal = design.poses[design.goal_pose];
  if (!goal || interval.exit_orientation_deg === null) return false;
  const off = turned(interval.exit_orientation_deg - goal.orientation_deg);
  return goal.aspect === interval.aspect && Math.min(off, 360 - off) < 0.01;
}
