// What the page shows of each kind of problem. Those with a section have designs of shapes; the others are tracks.

import { assemblySection } from './assembly.js';
import { assemblyFacts } from './assembly_asked.js';
import { drawnJoint } from './joint_picture.js';
import { nestSection } from './nest.js';
import { nestFacts } from './nest_asked.js';
import { drawnNest } from './nest_picture.js';

const kNest = {
  word: 'shapes',
  section: (design, problem) => nestSection(design, problem.nest),
  facts: (problem) => nestFacts(problem.nest),
  picture: drawnNest,
};

const kKinds = {
  feeder: {
    title: 'feeder track',
    word: 'features',
    figures: ['efficiency', 'tolerance_mm', 'margin_mm', 'feed_rate_per_min', 'length_mm', 'purity', 'jam_probability'],
    columns: ['efficiency', 'tolerance_mm', 'margin_mm', 'feed_rate_per_min', 'length_mm', 'feature_count'],
    columnsOfInfeasible: ['efficiency', 'purity', 'jam_probability'],
  },
  assembly: {
    title: 'assembly',
    word: 'shapes',
    figures: [
      'success_fraction',
      'capture_mm',
      'capture_deg',
      'depth_margin_mm',
      'peak_force_n',
      'work_nmm',
      'chamfer_mm',
    ],
    columns: ['success_fraction', 'capture_mm', 'capture_deg', 'peak_force_n', 'work_nmm', 'depth_margin_mm'],
    section: (design, problem) => assemblySection(design, problem.assembly),
    facts: (problem) => assemblyFacts(problem.assembly),
    picture: drawnJoint,
    limits: [
      'Insertions are slow: a rigid part on a linear support, Coulomb friction of one coefficient, no impacts and no bending.',
      'Friction of real surfaces spreads widely. Try the worst start by hand.',
    ],
  },
  fixture: {
    ...kNest,
    title: 'fixture',
    figures: ['seated_fraction', 'wrong_equilibria', 'repeatability_mm', 'resisted_weights', 'resisted_moment_mm'],
    columns: ['seated_fraction', 'wrong_equilibria', 'repeatability_mm', 'resisted_weights', 'resisted_moment_mm'],
    limits: [
      'Parts are let go at rest and sink slowly: a rigid part, Coulomb friction of one coefficient, no impacts.',
      'Friction of real surfaces spreads widely. Try the wrong equilibria by hand.',
    ],
  },
  pallet: {
    ...kNest,
    title: 'pallet',
    figures: ['selectivity_mm', 'goal_escape_height_mm', 'worst_wrong_escape_height_mm', 'capture_fraction'],
    columns: ['selectivity_mm', 'goal_escape_height_mm', 'worst_wrong_escape_height_mm', 'capture_fraction'],
    limits: [
      'Escape heights are of one rigid part in the plane: parts that lie on each other, or leave the plane, are not looked at.',
      'How fast wrong parts leave is not predicted here: verify simulates it. Try the table by hand.',
    ],
  },
};

export const kindOf = (report) => kKinds[report.problem.kind] ?? kKinds.feeder;
