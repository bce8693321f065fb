// Of every design and pose of a report: the margins that the page draws are those that the program judged by.
// Argument: a report.html. Needs no browser. Exits with 1 if any differs.
import { readFileSync } from 'node:fs';

import { marginCurve, supportAt, travelRange } from '../../web/src/travel.js';

const kRounded_mm = 2e-3; // corners are written to 1e-4 mm, and moving ones can turn a hull edge by more than that
const kShortest_mm = 1e-3;
const kBetweenSteps_mm = 0.02; // a curve's least value lies between its steps

const html = readFileSync(process.argv[2], 'utf8');
const report = JSON.parse(/<script id="report-data" type="application\/json">(.*?)<\/script>/s.exec(html)[1]);
let compared = 0;
let failed = 0;
function check(condition, text) {
  ++compared;
  if (condition) return;
  ++failed;
  console.error(`FAILED: ${text}`);
}

for (const design of report.designs) {
  if (design.track.some((f) => f.type === 'wiper' || f.type === 'hold-down')) continue; // blades have margins of their own
  const part = report.parts[design.part];
  check(
    design.travel !== null && design.travel.length === design.poses.length,
    `${design.id} has the travel of every pose`,
  );
  design.poses.forEach((result, i) => {
    const [pose, travel] = [part.poses[i], design.travel[i]];
    const name = `${design.id}, pose ${result.aspect} ${result.orientation_deg}`;
    check(
      pose.aspect === result.aspect && pose.orientation_deg - result.orientation_deg < 1e-3,
      `${name}: the same pose`,
    );
    const margins = marginCurve(pose, travel, ...travelRange(pose, design.track)).map((p) => p.margin);
    if (margins.includes(null)) return; // nothing under the part somewhere: no number to compare
    const least = Math.min(...margins);
    if (result.outcome === 'delivered') {
      check(
        least > result.margin_mm - kRounded_mm && least < result.margin_mm + kBetweenSteps_mm,
        `${name}: least margin ${least} drawn, ${result.margin_mm} judged`,
      );
      if (result.decided_by) {
        const at = supportAt(pose, travel, result.decided_by.x_mm).margin;
        check(
          Math.abs(at - result.margin_mm) < kRounded_mm,
          `${name}: ${at} drawn at the deciding instant, ${result.margin_mm} judged`,
        );
      }
    } else if (result.margin_mm < part.diameter_mm - 1e-6) {
      check(
        Math.abs(least + result.margin_mm) < kBetweenSteps_mm,
        `${name}: lost by ${-least} drawn, ${result.margin_mm} judged`,
      );
      // A loss may last less than the rounding: then nothing can be told from beside it.
      const step = Math.min(0.01, (result.unsupported_mm ?? 0) / 2);
      if (result.decided_by && step > kShortest_mm) {
        const before = supportAt(pose, travel, result.decided_by.x_mm - step).margin;
        const behind = supportAt(pose, travel, result.decided_by.x_mm + step).margin;
        check(
          before > -kRounded_mm && behind < 0,
          `${name}: margin ${before} just before the loss, ${behind} just behind it`,
        );
      }
    }
  });
}
if (compared === 0) throw new Error('nothing to compare');
console.log(`${compared} comparisons, ${failed} failed`);
process.exitCode = failed ? 1 : 0;
