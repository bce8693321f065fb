// Uses a report as its reader would: chooses axes, brushes, sorts, clicks designs and poses, scrubs and plays, prints.
// Argument: a report.html with at least three feasible designs. Exits with 1 if anything is not as it should be.
import { check, checked, checkNoOverflow, failures, number, settled, withReport } from './browser.mjs';

const path = process.argv[2];
if (!path) throw new Error('usage: click_through.mjs report.html');

const title = (page) => page.locator('#chosen-title').textContent();
const shownIds = (page) => page.locator('#designs-table tbody tr').evaluateAll((rows) => rows.map((r) => r.dataset.id));
const marks = (page) =>
  page
    .locator('#pareto .mark')
    .evaluateAll((all) => all.map((m) => ({ id: m.dataset.id, x: Number(m.dataset.cx), y: Number(m.dataset.cy) })));

async function axes(page, report) {
  const before = await marks(page);
  check(before.length === report.designs.length, 'every design of the front has a mark');
  check((await page.locator('#pareto .cloud > *').count()) > 100, 'the other evaluations are shown');
  const infeasible = page.locator('#pareto .cloud .infeasible');
  check((await infeasible.count()) > 0, 'infeasible evaluations are shown apart');
  await page.locator('#show-infeasible').uncheck();
  check((await infeasible.count()) === 0, 'infeasible evaluations can be hidden');
  check((await page.locator('#pareto .cloud .dominated').count()) > 0, 'dominated ones stay');
  await page.locator('#show-infeasible').check();
  check((await page.locator('#pareto .mark.knee').count()) === (report.knee ? 1 : 0), 'the knee is marked');
  await page.locator('#axis-x').selectOption('number');
  await settled(page);
  const after = await marks(page);
  const byNumber = [...after].sort((a, b) => a.x - b.x).map((m) => Number(m.id.slice(1)));
  check(
    byNumber.every((n, i) => i === 0 || n >= byNumber[i - 1]),
    'with evaluations across, marks stand in their order',
  );
  check(
    after.some((m) => Math.abs(m.x - before.find((b) => b.id === m.id).x) > 1),
    'marks move when an axis changes',
  );
  await page.locator('#axis-y').selectOption('violation');
  await settled(page);
  const heights = new Set((await marks(page)).map((m) => m.y));
  check(heights.size === 1, 'feasible designs have violation 0');
  await page.locator('#axis-x').selectOption('tolerance_mm');
  await page.locator('#axis-y').selectOption('length_mm');
  await settled(page);
}

async function brush(page, report) {
  await page.locator('#pareto svg').scrollIntoViewIfNeeded();
  const box = await page.locator('#pareto svg').boundingBox();
  const all = (await marks(page)).sort((a, b) => a.x - b.x);
  const cut = (all[0].x + all[all.length - 1].x) / 2;
  await page.mouse.move(box.x + cut, box.y + 22);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width - 60, box.y + 200, { steps: 4 });
  await page.mouse.move(box.x + box.width - 20, box.y + 345, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  const expected = all
    .filter((m) => m.x > cut)
    .map((m) => m.id)
    .sort();
  check(expected.length > 0 && expected.length < all.length, 'the brush takes some designs and not others');
  check(
    JSON.stringify((await shownIds(page)).sort()) === JSON.stringify(expected),
    'the table shows the designs inside the brush',
  );
  check((await page.locator('#pareto .mark.aside').count()) === all.length - expected.length, 'marks outside fade');
  check(
    (await page.locator('#table-status').textContent()).includes(`${expected.length} of`),
    'the status says how many',
  );
  await page.locator('#clear-brush').click();
  check((await shownIds(page)).length === report.designs.length, 'without the brush all rows are back');
}

async function sorting(page, report) {
  for (const name of ['tolerance_mm', 'length_mm']) {
    for (const wanted of [null, 'other way']) {
      await page.locator(`#designs-table [data-sort="${name}"]`).click();
      const order = await page.locator(`#designs-table th:has([data-sort="${name}"])`).getAttribute('aria-sort');
      const values = (await shownIds(page)).map((id) => report.designs.find((d) => d.id === id).metrics[name]);
      const sign = order === 'ascending' ? 1 : -1;
      check(order !== 'none', `a click sorts by ${name}${wanted ? `, the ${wanted}` : ''}`);
      check(
        values.every((v, i) => i === 0 || sign * (v - values[i - 1]) >= 0),
        `rows are ${order} by ${name}`,
      );
    }
  }
}

async function shows(page, design) {
  check((await title(page)) === `Design ${design.id}`, `the chosen design is ${design.id}`);
  check(
    (await page.locator('#designs-table tr[aria-selected="true"]').getAttribute('data-id')) === design.id,
    'its row is marked',
  );
  check((await page.locator('#pareto .mark.selected').getAttribute('data-id')) === design.id, 'its mark is marked');
  const figure = async (name) => number(await page.locator(`#figures [data-measure="${name}"]`).textContent());
  check(Math.abs((await figure('tolerance_mm')) - design.metrics.tolerance_mm) < 6e-4, 'its tolerance is shown');
  check(Math.abs((await figure('length_mm')) - design.metrics.length_mm) < 6e-3, 'its length is shown');
  const values = await page
    .locator('#variables tbody tr')
    .evaluateAll((rows) => rows.map((r) => [r.cells[0].textContent, r.cells[1].textContent]));
  check(values.length === Object.keys(design.values).length, 'all its variables are listed');
  check(
    values.every(([name, text]) => Math.abs(number(text) - design.values[name]) < 6e-5),
    'with their values',
  );
  check((await page.locator('#reproduce').textContent()).includes(`designs/${design.id}.json`), 'the command names it');
  const links = await page.locator('#chosen .links a').evaluateAll((all) => all.map((a) => a.getAttribute('href')));
  for (const kind of ['svg', 'dxf']) check(links.includes(`designs/${design.id}.${kind}`), `it links its ${kind}`);
}

async function choosing(page, report) {
  const drawing = () => page.locator('#drawing').innerHTML();
  const seen = new Set();
  const all = await marks(page);
  for (const mark of [all[0], all[Math.floor(all.length / 2)], all[all.length - 1]]) {
    const before = await drawing();
    const now = await title(page);
    await page.locator('#pareto svg').scrollIntoViewIfNeeded();
    const box = await page.locator('#pareto svg').boundingBox();
    const [x, y] = [box.x + mark.x, box.y + mark.y];
    const top = await page.evaluate(
      ([px, py]) => document.elementFromPoint(px, py).closest('.mark')?.dataset.id,
      [x, y],
    );
    check(Boolean(top), 'a mark can be met by the mouse');
    await page.mouse.click(x, y);
    await settled(page);
    await shows(
      page,
      report.designs.find((d) => d.id === top),
    );
    if (now !== `Design ${top}`) check((await drawing()) !== before, 'another design has another drawing');
    check((await page.locator('#drawing svg .dimension text').count()) > 1, 'the drawing has dimensions');
    check((await page.locator('#drawing .scale-bar').count()) === 1, 'and a scale bar');
    seen.add(top);
  }
  check(seen.size > 1, 'different marks choose different designs');
  const first = page.locator('#designs-table tbody tr').first();
  await first.focus();
  await page.keyboard.press('Enter');
  const id = await first.getAttribute('data-id');
  check((await title(page)) === `Design ${id}`, 'Enter on a row chooses it');
  await page.keyboard.press('ArrowDown');
  check((await title(page)) !== `Design ${id}`, 'the arrow goes on to the next row');
}

// Where the page's own hull stands must be what the program judged by.
async function poses(page, design) {
  check((await page.locator('#poses .card').count()) === design.poses.length, 'every pose has a card');
  for (const [i, pose] of design.poses.entries()) {
    const card = page.locator(`#poses .card[data-pose="${i}"]`);
    const text = await card.textContent();
    check(text.includes(pose.outcome), `pose ${i} says that it is ${pose.outcome}`);
    check(text.includes(`${(100 * pose.prior).toFixed(1)} %`), `pose ${i} says how often it arrives`);
    check(text.includes(`${pose.margin_mm.toFixed(3)} mm`), `pose ${i} says its margin`);
    if (pose.decided_by)
      check(text.includes(`x = ${pose.decided_by.x_mm.toFixed(2)} mm`), `pose ${i} says where it is decided`);
    await card.click();
    await settled(page);
    check((await card.getAttribute('aria-pressed')) === 'true', `pose ${i} is chosen`);
    check((await page.locator('#animation .verdict').textContent()).includes(pose.reason), `pose ${i} says why`);
    const least = Number(await page.locator('#animation').getAttribute('data-least'));
    const expected = pose.outcome === 'delivered' ? pose.margin_mm : -pose.margin_mm;
    check(Math.abs(least - expected) < 0.02, `pose ${i}: least margin ${least} drawn, ${expected} judged`);
    if (pose.outcome === 'delivered' && pose.decided_by) {
      const at = Number(await page.locator('#readout [data-margin]').getAttribute('data-margin'));
      check(
        Math.abs(at - pose.margin_mm) < 2e-3,
        `pose ${i}: margin ${at} at the deciding instant, ${pose.margin_mm} judged`,
      );
    }
  }
}

async function travel(page, design) {
  await page.locator(`#poses .card[data-pose="${design.goal_pose ?? 0}"]`).click();
  await settled(page);
  const place = async () => Number(await page.locator('#readout [data-x]').getAttribute('data-x'));
  const picture = () => page.locator('#animation .part').first().locator('..').innerHTML();
  const hull = () => page.locator('#animation .travel .hull').getAttribute('d');
  const start = await place();
  const pose = design.poses[design.goal_pose ?? 0];
  if (pose.decided_by) check(Math.abs(start - pose.decided_by.x_mm) < 1e-3, 'the travel opens at the deciding instant');
  const slider = page.locator('#scrub');
  await slider.scrollIntoViewIfNeeded();
  const box = await slider.boundingBox();
  const before = [await picture(), await hull(), await page.locator('#readout').textContent()];
  await page.mouse.click(box.x + 0.15 * box.width, box.y + box.height / 2);
  await settled(page);
  const after = [await picture(), await hull(), await page.locator('#readout').textContent()];
  check(Math.abs((await place()) - start) > 5, 'the slider moves the part');
  ['the part', 'the hull', 'the numbers'].forEach((what, i) =>
    check(before[i] !== after[i], `${what} follow the slider`),
  );
  const here = await place();
  await slider.press('ArrowRight');
  check(Math.abs((await place()) - here - 0.1) < 1e-6, 'an arrow key is a tenth of a millimetre');
  await page.locator('#speed').selectOption('50');
  await page.locator('#play').click();
  await page.waitForFunction((x) => Number(document.querySelector('#readout [data-x]').dataset.x) > x + 1, here, {
    timeout: 5000,
  });
  await page.locator('#play').click();
  const stopped = await place();
  await page.waitForTimeout(150);
  check((await place()) === stopped, 'pause stops it');
  await page.locator('#jump').click();
  check(Math.abs((await place()) - start) < 1e-6, 'the deciding instant is one click away');
}

async function printing(page) {
  await page.emulateMedia({ media: 'print' });
  await settled(page);
  for (const id of ['#play', '#scrub', '#axis-x', '#clear-brush', '#speed']) {
    check(!(await page.locator(id).isVisible()), `${id} is not printed`);
  }
  for (const id of ['#drawing svg', '#poses', '#variables', '#reproduce', '#animation svg', '#verdict', '#cautions']) {
    check(await page.locator(id).isVisible(), `${id} is printed`);
  }
  const paper = await page.pdf({ format: 'A4' });
  check(paper.length > 20000, `the printed report has ${paper.length} bytes`);
  await page.emulateMedia({ media: 'screen' });
}

await withReport(path, async (page, report, url) => {
  if (report.designs.length < 3 || report.run.feasible === 0)
    throw new Error('needs a report with three feasible designs');
  check(
    (await page.locator('#verdict').textContent()).includes('non-dominated'),
    'the verdict does not claim more than is known',
  );
  check(!/optim(al|um)\b/i.test(await page.locator('body').innerText()), 'nothing is called optimal');
  await axes(page, report);
  await brush(page, report);
  await sorting(page, report);
  await choosing(page, report);
  const chosen = report.designs.find((d) => d.id === (report.knee?.id ?? report.designs[0].id));
  await page.goto(`${url}#${chosen.id}`);
  await page.reload();
  await settled(page);
  await shows(page, chosen);
  await poses(page, chosen);
  await travel(page, chosen);
  for (const width of [1200, 800]) await checkNoOverflow(page, width);
  await printing(page);
});

console.log(`${checked()} checks, ${failures.length} failed`);
process.exitCode = failures.length ? 1 : 0;
