// How numbers and names of the report read.

const kNone = '\u2013';
const kMinus = '\u2212';

const kMeasures = {
  efficiency: {
    title: 'Efficiency',
    unit: '%',
    digits: 1,
    says: 'share of arriving parts that leave in the goal pose',
  },
  purity: { title: 'Purity', unit: '%', digits: 1, says: 'share of leaving parts that are in the goal pose' },
  jam_probability: { title: 'Jams', unit: '%', digits: 1, says: 'share of arriving parts that stay on the track' },
  tolerance_mm: {
    title: 'Tolerance',
    unit: 'mm',
    digits: 3,
    says: 'how far all edges of the voids may be off before an outcome changes',
  },
  margin_mm: {
    title: 'Margin',
    unit: 'mm',
    digits: 3,
    says: 'the least over poses: distance to tipping if delivered, depth of the loss if rejected',
  },
  length_mm: {
    title: 'Length',
    unit: 'mm',
    digits: 2,
    says: 'from the first feature\u2019s start to the last one\u2019s end',
  },
  feature_count: { title: 'Features', unit: '', digits: 0, says: 'number of features' },
  feed_rate_per_min: { title: 'Feed rate', unit: '/min', digits: 1, says: 'parts a minute at the conveying speed' },
  success_fraction: {
    title: 'Success',
    unit: '%',
    digits: 1,
    says: 'share of the box of start errors from which the part assembles',
  },
  capture_mm: {
    title: 'Capture',
    unit: 'mm',
    digits: 3,
    says: 'lateral half side of the largest scaled box of starts that all assemble',
  },
  capture_deg: {
    title: 'Capture angle',
    unit: '\u00b0',
    digits: 2,
    says: 'angular half side of the largest scaled box of starts that all assemble',
  },
  peak_force_n: {
    title: 'Peak force',
    unit: 'N',
    digits: 2,
    says: 'the largest force along the approach over the starts looked at',
  },
  peak_lateral_force_n: {
    title: 'Peak side force',
    unit: 'N',
    digits: 2,
    says: 'the largest force across the approach over the starts looked at',
  },
  work_nmm: { title: 'Work', unit: 'N mm', digits: 1, says: 'the largest work of an insertion' },
  depth_margin_mm: {
    title: 'Depth margin',
    unit: 'mm',
    digits: 3,
    says: 'how much deeper the right insertion goes than the deepest wrong one',
  },
  chamfer_mm: { title: 'Chamfer', unit: 'mm', digits: 3, says: 'size of the chamfers' },
  seated_fraction: { title: 'Seated', unit: '%', digits: 1, says: 'share of the box of starts that end in the seat' },
  wrong_equilibria: {
    title: 'Wrong equilibria',
    unit: '',
    digits: 0,
    says: 'sets of places other than the seat at which friction can hold the part',
  },
  repeatability_mm: {
    title: 'Repeatability',
    unit: 'mm',
    digits: 3,
    says: 'how far a point of the part is apart in two seated ends at most',
  },
  resisted_weights: {
    title: 'Resisted force',
    unit: 'weights',
    digits: 2,
    says: 'the least force, over directions, that moves the part out of the seat, over its weight (or the push)',
  },
  resisted_moment_mm: {
    title: 'Resisted moment',
    unit: 'mm',
    digits: 2,
    says: 'the least moment that turns the part out of the seat, over its weight (or the push)',
  },
  goal_escape_height_mm: {
    title: 'Seat\u2019s escape height',
    unit: 'mm',
    digits: 2,
    says: 'no way out of the seat rises less',
  },
  worst_wrong_escape_height_mm: {
    title: 'Worst wrong escape',
    unit: 'mm',
    digits: 2,
    says: 'of every other rest a way out is known that rises no more',
  },
  selectivity_mm: {
    title: 'Selectivity',
    unit: 'mm',
    digits: 2,
    says: 'the seat\u2019s escape height less that of the worst wrong rest',
  },
  capture_fraction: {
    title: 'Captured',
    unit: '%',
    digits: 1,
    says: 'share of the box of starts that end in the seat when they are dropped',
  },
  hypervolume: {
    title: 'Hypervolume',
    unit: '%',
    digits: 1,
    says: 'share of the objectives\u2019 box that the front dominates',
  },
  violation: { title: 'Violation', unit: '', digits: 3, says: 'how far from feasible; 0 is feasible' },
  number: { title: 'Evaluation', unit: '', digits: 0, says: 'the evaluation\u2019s number in the run' },
};

export function measure(name) {
  return kMeasures[name] ?? { title: name, unit: '', digits: 3, says: name };
}

export function fixed(value, digits) {
  if (value === null || value === undefined) return kNone;
  const text = Math.abs(value).toLocaleString('en-US', {
    minimumFractionDigits: digits,
    maximumFractionDigits: digits,
  });
  return value < 0 && Number(text.replaceAll(',', '')) !== 0 ? kMinus + text : text;
}

// At most that many digits: 10, 7.5, 0.125.
export function short(value, digits = 3) {
  if (value === null || value === undefined) return kNone;
  const text = Math.abs(value).toLocaleString('en-US', { maximumFractionDigits: digits, useGrouping: false });
  return value < 0 && Number(text) !== 0 ? kMinus + text : text;
}

export const whole = (value) => fixed(value, 0);
export const mm = (value, digits = 3) => (value === null || value === undefined ? kNone : `${fixed(value, digits)} mm`);
export const percent = (value, digits = 1) =>
  value === null || value === undefined ? kNone : `${fixed(100 * value, digits)} %`;
export const degrees = (value) => `${short(value, 2)}\u00b0`;

// A measure's number without its unit, and with it.
export function bare(name, value) {
  const { unit, digits } = measure(name);
  return fixed(unit === '%' && value !== null && value !== undefined ? 100 * value : value, digits);
}
export function withUnit(name, value) {
  const { unit } = measure(name);
  if (value === null || value === undefined) return kNone;
  return unit === ''
    ? bare(name, value)
    : unit === '/min'
      ? `${bare(name, value)} ${unit}`
      : `${bare(name, value)} ${unit}`;
}
export function titled(name) {
  const { title, unit } = measure(name);
  return unit ? `${title} (${unit})` : title;
}

export const poseName = (pose) => `${pose.aspect} ${degrees(pose.orientation_deg)}`;

// Told apart by word and sign as well as by colour.
export const kOutcomes = {
  delivered: { word: 'delivered', sign: '\u2713' },
  rejected: { word: 'rejected', sign: '\u2193' },
  jammed: { word: 'jammed', sign: '\u2715' },
  assembled: { word: 'assembled', sign: '\u2713' },
  wedged: { word: 'wedged', sign: '\u25bc' },
  blocked: { word: 'blocked', sign: '\u25a0' },
  seated: { word: 'seated', sign: '\u2713' },
  misseated: { word: 'misseated', sign: '\u2715' },
  escaped: { word: 'escaped', sign: '\u2191' },
  ambiguous: { word: 'ambiguous', sign: '?' },
  undecided: { word: 'undecided', sign: '\u2026' },
};
export const outcome = (name) => kOutcomes[name] ?? { word: name, sign: '?' };

// Below it a static prediction means little under vibration (docs/validation.md).
export const kWeak_mm = 0.3;

export function counted(number, one, many) {
  return `${whole(number)} ${number === 1 ? one : many}`;
}

// Whole designs; the others of a run's evaluations are of single features.
export const designsEvaluated = (report) => report.run.evaluations - (report.run.stages ?? 0);
