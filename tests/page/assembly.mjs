// Uses the page of an assembly: the map of starts, the insertion, forces, the configuration space, the wrong ways.
// Arguments: the page without data (page.html), where to write the report. Exits with 1 if anything is wrong.
import { readFileSync, writeFileSync } from 'node:fs';

import { fillPage, makeReport } from './assembly_fixture.mjs';
import { check, checked, checkNoOverflow, failures, settled, withReport } from './browser.mjs';

const [pagePath, path] = process.argv.slice(2);
if (!path) throw new Error('usage: assembly.mjs page.html report.html');
writeFileSync(path, fillPage(readFileSync(pagePath, 'utf8'), makeReport()));

// The numbers beside the animation; its first frame, which a busy machine may draw late, writes them.
async function shown(page) {
  await page.locator('#readout:has([data-at])').waitFor();
  return page.locator('#readout').evaluate((node) => {
    const of = (name) => Number(node.querySelector(`[data-${name}]`).getAttribute(`data-${name}`));
    return { at: of('at'), depth: of('depth'), axial: of('axial'), lateral: of('lateral'), theta: of('theta') };
  });
}
const pickedStart = async (page) => Number(await page.locator('.start-picked .rim').getAttribute('data-picked'));
const near = (a, b) => Math.abs(a - b) < 1e-3;

async function region(page, { joint }) {
  const { insertions, region: map } = joint;
  const outcomes = new Set(map.rows.flatMap((row) => row.intervals.map(([, , name]) => name)));
  for (const name of outcomes) {
    check((await page.locator(`.region.${name}`).count()) > 0, `${name} starts are drawn`);
    check((await page.locator(`[data-share="${name}"]`).textContent()).includes(name), `${name} has its share`);
  }
  check((await page.locator('.region-map .capture').count()) === 1, 'the captured box is outlined');
  check((await page.locator('.region-map .start').count()) === insertions.length, 'every start is marked');
  const box = await page.locator('.region-map .capture').boundingBox();
  const start = await page.locator('.region-map .start').first().boundingBox();
  const end = await page.locator('.region-map .start').last().boundingBox();
  const share = box.width / (end.x - start.x);
  check(Math.abs(share - (2 * joint.capture.mm) / 4) < 0.01, `the box is to scale: ${share}`);
  // A click near a start of each outcome picks it and plays it.
  for (const name of outcomes) {
    const index = insertions.findIndex((one) => one.outcome === name);
    await page.locator('.region-map').scrollIntoViewIfNeeded();
    const dot = await page.locator(`.start[data-start="${index}"]`).boundingBox();
    await page.mouse.click(dot.x + dot.width / 2 + 4, dot.y + dot.height / 2 + 3);
    check((await pickedStart(page)) === index, `a click picks the nearest start, ${index}`);
    check((await page.locator('#animation .verdict').textContent()).includes(name), `its insertion is ${name}`);
    check((await page.locator('#animation .verdict').textContent()).includes(insertions[index].why), 'and says why');
    check((await page.locator('#play').textContent()).includes('Pause'), 'and it plays');
    const before = await shown(page);
    await page.waitForFunction(
      (at) => Number(document.querySelector('#readout [data-at]').dataset.at) > at,
      before.at + 0.2,
    );
    await page.locator('#play').click();
  }
  await page.locator('.region-map').focus();
  const here = await pickedStart(page);
  const [dx, key] = insertions[here].x_mm < 1 ? [1, 'ArrowRight'] : [-1, 'ArrowLeft'];
  await page.keyboard.press(key);
  const next = insertions[await pickedStart(page)];
  check(
    (next.x_mm - insertions[here].x_mm) * dx > 0 && next.theta_deg === insertions[here].theta_deg,
    'an arrow goes on to the next start',
  );
  await page.locator('#play').click();
}

async function motion(page, { joint }) {
  const index = joint.insertions.findIndex((one) => one.outcome === 'assembled' && one.moments.length > 3);
  const insertion = joint.insertions[index];
  const dot = await page.locator(`.start[data-start="${index}"]`).boundingBox();
  await page.mouse.click(dot.x + dot.width / 2, dot.y + dot.height / 2);
  await page.locator('#play').click();
  await page.locator('#scrub').press('Home');
  const places = [];
  for (const [i, moment] of insertion.moments.entries()) {
    if (i > 0) await page.locator('#jump').click();
    const now = await shown(page);
    check(near(now.at, moment.travel_mm), `moment ${i} is at ${now.at}`);
    check(near(now.depth, moment.depth_mm) && near(now.axial, moment.axial_n), `moment ${i}: depth and force`);
    check((await page.locator('#readout .event').textContent()) === moment.event, `moment ${i}: its event`);
    check((await page.locator('#animation svg .contact').count()) === moment.contacts.length, `moment ${i}: contacts`);
    check((await page.locator('.contacts .cone').count()) === moment.contacts.length, `moment ${i}: cones`);
    const forces = moment.contacts.filter((c) => Math.hypot(...c.force) > 0).length;
    check((await page.locator('.contacts .force').count()) === forces, `moment ${i}: forces`);
    places.push(await page.locator('#animation svg .part').getAttribute('transform'));
    const dots = await page.locator('.force-dot').evaluateAll((list) => list.map((d) => Number(d.getAttribute('cx'))));
    check(dots[0] === dots[1], 'both forces are marked at one depth');
  }
  check(new Set(places).size === places.length, 'the part moves');
  // Half-way between two moments the part is half-way.
  await page.locator('#scrub').evaluate((node, at) => {
    node.value = String(at);
    node.dispatchEvent(new Event('input'));
  }, insertion.moments[1].travel_mm / 2);
  check(near((await shown(page)).depth, insertion.moments[1].depth_mm / 2), 'between moments it is interpolated');
  check((await page.locator('#animation svg .carrier').count()) === 1, 'the carrier is drawn');
  const peak = await page.locator('#insertion-figures [data-of="axial"]').textContent();
  check(near(Number.parseFloat(peak), Number(insertion.peak_axial_n.toFixed(2))), `its peak is ${peak}`);
}

async function painted(page) {
  await page.locator('.space-frame canvas').scrollIntoViewIfNeeded();
  await settled(page);
  await settled(page);
  return page.locator('.space-frame canvas').evaluate((canvas) => {
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let filled = 0;
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i] + data[i + 1] + data[i + 2] < 750) ++filled;
      sum = (sum * 31 + data[i] + 3 * data[i + 1] + 7 * data[i + 2]) % 1000003;
    }
    return { share: filled / (data.length / 4), sum };
  });
}

await withReport(path, async (page, report, url) => {
  const [design, plain] = report.designs;
  await page.goto(`${url}#${design.id}`);
  await page.reload();
  await settled(page);
  check((await page.locator('.kind').textContent()).includes('assembly'), 'the kind is named');
  check((await page.locator('#asked').textContent()).includes('14 mm deep'), 'the goal is said');
  for (const id of ['#poses', '#rings', '#features'])
    check((await page.locator(id).count()) === 0, `there is no ${id}`);
  await region(page, design);
  await motion(page, design);
  const success = await page.locator('#figures [data-measure="success_fraction"]').textContent();
  check(success.startsWith('62.0'), `its success is ${success}`);
  const first = await painted(page);
  check(first.share > 0.03, `the configuration space is painted: ${first.share}`);
  await page.locator('#scrub').press('End');
  check((await painted(page)).sum !== first.sum, 'its marker follows the insertion');
  check((await page.locator('#wrong-ways .way').count()) === 3, 'the right way and both wrong ones');
  const ways = await page.locator('#wrong-ways').textContent();
  check(/proved: no start/.test(ways) && /6\.50 mm/.test(ways), 'what is proved');
  check(/does not hold/.test(ways) && /nothing proved/.test(ways), 'what is only projected');
  const text = await page.locator('body').innerText();
  check(!/NaN|undefined|Infinity|\[object/.test(text), 'no number is broken');
  for (const width of [1200, 800, 420]) await checkNoOverflow(page, width);
  await page.setViewportSize({ width: 1200, height: 900 });
  await page.locator(`#designs-table tr[data-id="${plain.id}"]`).click();
  await settled(page);
  check((await page.locator('.space-frame').count()) === 0, 'a space that is left out is not drawn');
  check((await page.locator('#space .empty').textContent()).includes('leaves'), 'and that is said');
  await page.locator(`#designs-table tr[data-id="${design.id}"]`).click();
  await settled(page);
  check((await painted(page)).share > 0.03, 'the configuration space comes back');
  if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT, fullPage: true });
});

console.log(`${checked()} checks, ${failures.length} failed`);
process.exitCode = failures.length ? 1 : 0;
