// A chosen joint: what becomes of every start, one insertion, the configuration space, and the wrong ways.

import { h } from './dom.js';
import { insertionTravel } from './insertion_travel.js';
import { jointSpace } from './joint_space.js';
import { regionMap } from './region_map.js';
import { middleStart, wrongWays } from './wrong_ways.js';

const title = (id, text) => h('h3', { id }, text);

// Answers {node, pause}.
export function assemblySection(design, asked) {
  const { joint } = design;
  if (!joint) return { node: h('p', { class: 'empty' }, 'This report holds no pictures of this design.'), pause() {} };
  let running = null;
  const travel = h('div', { id: 'travel' });
  const space = jointSpace(joint, (placement) => running?.pick(placement));
  const map = joint.region
    ? regionMap({ region: joint.region, capture: joint.capture, starts: joint.insertions }, (index) => {
        choose(index);
        running?.run();
      })
    : null;

  function choose(index) {
    running?.pause();
    const insertion = joint.insertions[index];
    running = insertionTravel(insertion, joint, asked, (q) => space.view?.follow(q, { outcome: insertion.outcome }));
    space.show?.(insertion);
    map?.mark(index);
    travel.replaceChildren(running.node);
  }

  const node = h(
    'div',
    { class: 'assembly-section' },
    title('region-title', 'What becomes of every start'),
    h(
      'p',
      { class: 'small' },
      'Every point is a start of the insertion; dots are starts that this report can show. ',
      h('span', { class: 'screen' }, 'Click, or use the arrow keys, to see the insertion from the nearest one.'),
    ),
    map ? map.node : h('p', { class: 'empty' }, 'There is no map of the starts.'),
    title('travel-title', 'The insertion'),
    travel,
    title('ways-title', 'Right and wrong'),
    wrongWays(joint, asked.goal),
    title('space-title', 'All placements at once: the configuration space'),
    h('div', { id: 'space' }, space.node),
  );
  if (joint.insertions.length) choose(middleStart(joint));
  else travel.append(h('p', { class: 'empty' }, 'This report holds no insertion of this design.'));
  return {
    node,
    pause() {
      running?.pause();
    },
    release: () => space.view?.release(),
  };
}
