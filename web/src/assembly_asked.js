// What was asked of an assembly, in words.

import { degrees, short } from './format.js';

const range = ([a, b], unit) => (a === b ? `${short(a)}${unit}` : `${short(a)} to ${short(b)}${unit}`);

// [title, words] of every fact.
export function assemblyFacts({ friction, damper, stiffness, approach, goal }) {
  const per = damper ? ' N s/mm' : ' N/mm';
  const never = goal.never.map((n) => `${n.aspect} ${degrees(n.orientation_deg)}`).join(', ');
  return [
    [
      'Goal',
      `${short(goal.depth_mm)} mm deep, within ${short(goal.lateral_mm)} mm and ${degrees(goal.tilt_deg)} of the drawn pose`,
    ],
    [
      'Starts',
      [
        `x ${range(goal.starts.x_mm, ' mm')}`,
        `y ${range(goal.starts.y_mm, ' mm')}`,
        `\u03b8 ${range(goal.starts.theta_deg, '\u00b0')}`,
      ].join(', '),
    ],
    ['Never', never || 'nothing named'],
    [
      damper ? 'Damper' : 'Spring',
      `${short(stiffness.kx_n_per_mm)} and ${short(stiffness.ky_n_per_mm)}${per} along x and y, ${short(stiffness.ktheta_nmm_per_rad)} ${damper ? 'N mm s' : 'N mm'}/rad`,
    ],
    [
      'Approach',
      `${short(approach.distance_mm)} mm towards ${degrees(approach.direction_deg)}${approach.max_force_n === null ? '' : `, with ${short(approach.max_force_n)} N at most`}`,
    ],
    ['Friction', short(friction)],
  ];
}
