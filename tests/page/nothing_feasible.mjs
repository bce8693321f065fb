// A report without a feasible design: it must say so, show the nearest designs and what is wrong with each.
// Argument: such a report.html. Exits with 1 if anything is not as it should be.
import { check, checked, checkNoOverflow, failures, settled, withReport } from './browser.mjs';

const path = process.argv[2];
if (!path) throw new Error('usage: nothing_feasible.mjs report.html');

await withReport(path, async (page, report) => {
  if (report.run.feasible !== 0 || report.designs.length === 0)
    throw new Error('needs a report with infeasible designs alone');
  check(
    (await page.locator('#verdict').textContent()).startsWith('No feasible design'),
    'the verdict says that nothing is feasible',
  );
  check((await page.locator('#pareto .mark:not(.infeasible)').count()) === 0, 'no mark looks feasible');
  check((await page.locator('.knee').count()) === 0, 'there is no knee');
  check(
    (await page.locator('#designs-table tbody tr').count()) === report.designs.length,
    'the nearest designs are listed',
  );
  for (const design of report.designs.slice(0, 5)) {
    await page.locator(`#designs-table tr[data-id="${design.id}"]`).click();
    await settled(page);
    check(
      (await page.locator('.pill.infeasible').first().textContent()).includes('not feasible'),
      `${design.id} is called infeasible`,
    );
    const listed = await page.locator('#violations li').allTextContents();
    check(listed.length === design.violations.length && listed.length > 0, `${design.id} lists what is wrong`);
    design.violations.forEach((v, i) => check(listed[i].includes(v.what), `${design.id}: ${v.what}`));
    check((await page.locator('#cautions').textContent()).includes('Do not build'), `${design.id} is not to be built`);
    if (design.metrics.tolerance_mm === null) {
      check(
        (await page.locator('[data-measure="tolerance_mm"]').textContent()) === '\u2013',
        'no tolerance is shown as none',
      );
    }
  }
  const text = await page.locator('body').innerText();
  check(!/NaN|undefined|Infinity|\[object/.test(text), 'no number is broken');
  for (const width of [1200, 800]) await checkNoOverflow(page, width);
});

console.log(`${checked()} checks, ${failures.length} failed`);
process.exitCode = failures.length ? 1 : 0;
