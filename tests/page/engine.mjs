// Uses what the page says of a search: topologies by colour, worst cases, stamps, findings, a compared run. Arguments: a
// report.html with at least three feasible designs, where to write the same report with all of these put in.
import { readFileSync, writeFileSync } from 'node:fs';

import { check, checked, checkNoOverflow, failures, number, settled, withReport } from './browser.mjs';

const [source, path] = process.argv.slice(2);
if (!path) throw new Error('usage: engine.mjs report.html changed.html');

const kData = /(<script id="report-data" type="application\/json">)([\s\S]*?)(<\/script>)/;

// Every second design in a second topology, the first one verified and failing, the others verified; the worst case
// costs a tenth of everything that is maximised.
function changed(report) {
  const { objectives } = report.problem;
  report.designs.forEach((design, i) => {
    design.topology = i % 2;
    design.label = i % 2 ? 'gap + slot' : 'balcony';
    design.worst = design.objectives.map((v, k) => (objectives[k].maximise ? 0.9 * v : v));
    design.worst_case = { ...design.metrics, tolerance_mm: 0.9 * design.metrics.tolerance_mm, bites: 'com_mm' };
    design.uncertainty = { scale: 1.75, alone: { com_mm: 0.21, wall_friction: [0.1, 0.31] } };
    design.stamp = { holds: i > 0, checks: [{ name: 'perturbed', holds: i > 0, says: '64 of 64 shapes' }] };
  });
  report.problem.uncertainty = {
    outline_mm: 0,
    com_mm: 0.1,
    feature_mm: 0,
    intervals: { wall_friction: [0.15, 0.25] },
  };
  report.findings = [
    ...Array.from({ length: 15 }, (_, i) => ({ topic: 'pruned', subject: `pattern ${i}`, text: 'cannot hold.' })),
    { topic: 'proved', subject: 'tolerance', text: 'above 2 mm is impossible.' },
  ];
  report.run.failures = { crash: 2 };
  report.compared = {
    name: 'yesterday',
    evaluations: 2 * report.run.evaluations,
    seed: 4,
    complete: true,
    designs: report.designs.map((d) => ({ ...d, objectives: d.objectives.map((v) => 0.8 * v) })),
    history: report.history.map((step) => ({ ...step, evaluations: 2 * step.evaluations })),
  };
  return report;
}

const html = readFileSync(source, 'utf8');
writeFileSync(
  path,
  html.replace(
    kData,
    (_, head, data, tail) => head + JSON.stringify(changed(JSON.parse(data))).replaceAll('<', '\\u003c') + tail,
  ),
);

await withReport(path, async (page, report) => {
  const marks = page.locator('#pareto .mark');
  check((await marks.count()) === report.designs.length, 'every design has a mark');
  const colours = await page
    .locator('#pareto .mark:not(.knee) > :first-child')
    .evaluateAll((all) => new Set(all.map((n) => n.getAttribute('fill'))).size);
  check(colours === 2, `two topologies have ${colours} colours`);
  const keys = page.locator('#topologies label');
  check((await keys.count()) === 2, 'the legend names both');
  await keys.nth(1).locator('input').uncheck();

  const hidden = Number(await keys.nth(1).getAttribute('data-topology'));
  check(
    (await marks.count()) === report.designs.filter((d) => d.topology !== hidden).length,
    'a topology can be hidden',
  );
  await keys.nth(1).locator('input').check();

  check((await page.locator('#pareto .band').count()) === report.designs.length, 'every design has its worst case');
  await page.locator('#show-worst').uncheck();
  check((await page.locator('#pareto .band').count()) === 0, 'worst cases can be hidden');
  check((await page.locator('#pareto .rival').count()) === report.designs.length, 'the other run is shown');
  await page.locator('#show-other').uncheck();
  check((await page.locator('#pareto .rival').count()) === 0, 'the other run can be hidden');

  const failing = report.designs[0];
  await page.locator(`#designs-table tr[data-id="${failing.id}"]`).click();
  await settled(page);
  check((await page.locator('#stamp').textContent()).includes('fails'), 'a failed check is said at the design');
  check(await page.locator('#verified table').isVisible(), 'which check fails is shown without asking');
  await page.locator(`#designs-table tr[data-id="${report.designs[1].id}"]`).click();
  await settled(page);
  check((await page.locator('#stamp').textContent()).includes('verified'), 'a stamp is shown');
  const worst = number(await page.locator('#figures [data-worst="tolerance_mm"]').textContent());
  check(Math.abs(worst - 0.9 * report.designs[1].metrics.tolerance_mm) < 6e-4, 'nominal and worst stand side by side');
  const rows = await page.locator('#uncertainty tbody tr').allTextContents();
  check(
    rows.some((t) => t.includes('com_mm') && t.includes('0.21') && t.includes('bites')),
    'what bites is named',
  );
  check((await page.locator('#uncertainty').textContent()).includes('1.75 times'), 'how much more it bears is said');

  check((await page.locator('#findings [data-topic="pruned"] li').count()) === 15, 'all that was left out is listed');
  check((await page.locator('#findings [data-topic="pruned"] > ul li').count()) === 12, 'a dozen of them at once');
  check((await page.locator('#findings [data-topic="proved"]').textContent()).includes('impossible'), 'proofs too');
  check((await page.locator('#failures').textContent()).includes('2 by crash'), 'failures are counted');
  check((await page.locator('#history .curve.other').count()) > 0, 'the other course is drawn');
  check((await page.locator('#history figcaption').first().textContent()).includes('hypervolume'), 'hypervolume first');
  check((await page.locator('#comparison').textContent()).includes('yesterday'), 'the comparison names the other run');
  for (const width of [1200, 800]) await checkNoOverflow(page, width);
});

console.log(`${checked()} checks, ${failures.length} failed`);
process.exitCode = failures.length ? 1 : 0;
