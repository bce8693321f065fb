// Uses the page of a design that turns its parts: rings, the path, the configuration space; and one of a design that
// does not. Arguments: the page without data (page.html), where to write the report. Exits with 1 if anything is wrong.
import { readFileSync, writeFileSync } from 'node:fs';

import { check, checked, checkNoOverflow, failures, settled, withReport } from './browser.mjs';
import { fillPage, makeReport } from './turning_fixture.mjs';

const [pagePath, path] = process.argv.slice(2);
if (!path) throw new Error('usage: turning.mjs page.html report.html');
writeFileSync(path, fillPage(readFileSync(pagePath, 'utf8'), makeReport()));

const kRad = Math.PI / 180;
const turned = (deg) => ((deg % 360) + 360) % 360;

const readout = (page) =>
  page.locator('#readout').evaluate((node) => ({
    x: Number(node.querySelector('[data-x]').dataset.x),
    at: Number(node.querySelector('[data-at]').dataset.at),
    theta: Number(node.querySelector('[data-theta]').dataset.theta),
  }));

// Where a ring has an orientation, in pixels of the window.
async function onRing(page, aspect, deg) {
  const svg = page.locator(`.ring-box[data-aspect="${aspect}"] svg`);
  await svg.scrollIntoViewIfNeeded();
  const box = await svg.boundingBox();
  const radius = (124 / 400) * box.width;
  return [
    box.x + box.width / 2 + radius * Math.cos(deg * kRad),
    box.y + box.height / 2 - radius * Math.sin(deg * kRad),
  ];
}

// Colours of the canvas, how many of its pixels are not white, and how many have the full colour of an edge's contact.
async function painted(page) {
  await page.locator('.space-frame canvas').scrollIntoViewIfNeeded(); // out of sight it is not drawn
  await settled(page);
  await settled(page);
  return page.locator('.space-frame canvas').evaluate((canvas) => {
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    const colours = new Set();
    let filled = 0;
    let golden = 0;
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      if (data[i] + data[i + 1] + data[i + 2] < 750) ++filled;
      if (data[i] - data[i + 2] > 70 && data[i + 1] - data[i + 2] > 50) ++golden;
      colours.add(`${data[i] >> 4} ${data[i + 1] >> 4} ${data[i + 2] >> 4}`);
      sum = (sum * 31 + data[i] + 3 * data[i + 1] + 7 * data[i + 2]) % 1000003;
    }
    return { share: filled / (data.length / 4), golden: golden / (data.length / 4), colours: colours.size, sum };
  });
}

async function rings(page, { turning }) {
  for (const aspect of ['up', 'down']) {
    const here = turning.outcome_map.filter((o) => o.aspect === aspect);
    const sectors = page.locator(`.ring-box[data-aspect="${aspect}"] .sector`);
    check((await sectors.count()) === here.length, `${aspect}: every interval is in the ring`);
    const goals = here.filter((o) => turning.paths[o.path].is_goal).length;
    check(
      (await page.locator(`.ring-box[data-aspect="${aspect}"] .rim`).count()) === goals,
      `${aspect}: goal exits are marked`,
    );
  }
  check((await page.locator('#intervals tbody tr').count()) === turning.outcome_map.length, 'every interval is listed');
  check((await page.locator('.sector.is-goal').count()) > 0, 'some interval ends in the goal');
  // The widest of each outcome: the mouse shows its boundaries and the part as it points, a click plays its path.
  const widest = new Map();
  for (const interval of turning.outcome_map) {
    const width = turned(interval.to_deg - interval.from_deg);
    if (width > (widest.get(interval.outcome)?.width ?? 5)) widest.set(interval.outcome, { interval, width });
  }
  check(widest.size >= 2, 'the fixture has several outcomes');
  for (const { interval } of widest.values()) {
    const { aspect } = interval;
    const deg = turned(interval.from_deg + 0.85 * (turned(interval.to_deg - interval.from_deg) || 360));
    const ring = page.locator(`.ring-box[data-aspect="${aspect}"]`);
    await page.mouse.move(...(await onRing(page, aspect, deg)));
    const texts = await ring.locator('.ends text').allTextContents();
    for (const boundary of [interval.from_deg, interval.to_deg]) {
      check(texts.includes(`${boundary.toFixed(2)}\u00b0`), `boundary ${boundary} is shown, of ${texts}`);
    }
    const drawn = await ring.locator('.arrives').getAttribute('transform');
    const shown = turned(-Number(/rotate\((.*)\)/.exec(drawn)[1]));
    check(Math.abs(shown - deg) < 0.9, `the part is drawn at ${shown}, the mouse is at ${deg}`);
    check((await ring.locator('.ring-words').textContent()).includes(interval.outcome), 'its outcome is said');
    await page.mouse.click(...(await onRing(page, aspect, deg)));
    const run = turning.paths[interval.path];
    check(
      (await page.locator('#animation .verdict').textContent()).includes(run.outcome),
      `the ${run.outcome} path is chosen`,
    );
    check((await page.locator('#play').textContent()).includes('Pause'), 'a click plays it');
    const before = await readout(page);
    await page.waitForFunction(
      (at) => Number(document.querySelector('#readout [data-at]').dataset.at) > at,
      before.at + 1,
    );
    await page.locator('#play').click();
    check(
      (await page.locator('.sector.chosen').getAttribute('data-interval')) ===
        String(turning.outcome_map.indexOf(interval)),
      'it is marked in the ring',
    );
    check(
      (await page.locator('#space-caption').textContent()).includes(aspect),
      'the configuration space is that of its aspect',
    );
  }
}

async function keyboard(page, { turning }) {
  const sectors = page.locator('.ring-box[data-aspect="up"] .sector');
  await sectors.first().focus();
  await page.keyboard.press('ArrowRight');
  const focused = await page.evaluate(() => document.activeElement.dataset.interval);
  check(focused === (await sectors.nth(1).getAttribute('data-interval')), 'an arrow goes on to the next interval');
  const interval = turning.outcome_map[Number(focused)];
  check(
    (await page.locator('.ring-box[data-aspect="up"] .ring-words').textContent()).includes(
      `${interval.from_deg.toFixed(2)}\u00b0`,
    ),
    'focus shows its boundary',
  );
  await page.keyboard.press('Enter');
  check((await page.locator('#play').textContent()).includes('Pause'), 'Enter plays it');
  await page.locator('#play').click();
  check((await page.locator('.sector.chosen').getAttribute('data-interval')) === focused, 'and chooses it');
  const canvas = page.locator('.space-frame canvas');
  await canvas.focus();
  await settled(page);
  const before = await painted(page);
  await page.keyboard.press('ArrowLeft');
  await settled(page);
  check((await painted(page)).sum !== before.sum, 'arrow keys turn the configuration space');
}

async function path_(page, { turning }) {
  const index = turning.paths.findIndex((p) => p.is_goal);
  const goal = turning.paths[index];
  await page.locator(`#intervals tr[data-interval="${index}"]`).click();
  await page.locator('#play').click();
  const slider = page.locator('#scrub');
  await slider.press('Home');
  const first = await readout(page);
  check(
    Math.abs(first.x - goal.points[0][0]) < 1e-3 && Math.abs(first.theta - goal.points[0][2]) < 1e-3,
    'the slider starts at the path\u2019s first point',
  );
  const seen = [];
  for (const [i, leg] of goal.legs.entries()) {
    await page.locator('.step').nth(i).click();
    await settled(page);
    const { x, theta } = await readout(page);
    const expected = goal.points[leg.from];
    check(
      Math.abs(x - expected[0]) < 1e-3 && Math.abs(theta - expected[2]) < 1e-2,
      `event ${i}: x ${x} and theta ${theta} of ${expected}`,
    );
    check(
      (await page.locator('#readout .event').textContent()).startsWith(leg.event),
      `event ${i} is named ${leg.event}`,
    );
    check(
      (await page.locator('.contacts .contact').count()) === leg.contacts.length,
      `event ${i}: every contact is drawn`,
    );
    check(
      (await page.locator('.contacts .cone').count()) === leg.contacts.length,
      `event ${i}: with its friction cone`,
    );
    seen.push(await page.locator('#animation .part').first().getAttribute('transform'));
  }
  check(new Set(seen).size === goal.legs.length, 'the part moves from event to event');
  await slider.press('Home');
  await page.locator('#jump').click();
  check(
    Math.abs((await readout(page)).x - goal.points[goal.legs[1].from][0]) < 1e-3,
    'the next event is one click away',
  );
  await slider.press('End');
  const last = goal.points[goal.points.length - 1];
  check(Math.abs((await readout(page)).x - last[0]) < 1e-2, 'the slider ends at its last point');
  check(
    (await page.locator('.obstacles').first().locator('path, circle').count()) === turning.obstacles.length,
    'obstacles are drawn',
  );
}

async function space(page) {
  const canvas = page.locator('.space-frame canvas');
  await page.locator('#space-reset').click();
  await canvas.scrollIntoViewIfNeeded();
  await settled(page);
  const whole = await painted(page);
  check(
    whole.share > 0.08 && whole.colours > 20 && whole.golden > 0.02,
    `the canvas is painted: ${JSON.stringify(whole)}`,
  );
  await page.locator('#colour-by').selectOption('support');
  await settled(page);
  check((await painted(page)).golden < 0.5 * whole.golden, 'colours change with support');
  await page.locator('#colour-by').selectOption('kind');
  await page.locator('#scrub').press('Home');
  await settled(page);
  const atStart = await painted(page);
  await page.locator('#scrub').press('End');
  await settled(page);
  check((await painted(page)).sum !== atStart.sum, 'the marker follows the animation');
  const high = page.locator('#theta-to');
  const most = Number(await high.inputValue());
  await high.fill(String(Number(await page.locator('#theta-from').inputValue()) + 60));
  await settled(page);
  const clipped = await painted(page);
  check(clipped.share < 0.8 * whole.share, `clipping takes surfaces away: ${clipped.share} of ${whole.share}`);
  await high.fill(String(most));
  // Picks wherever there is a surface.
  const box = await canvas.boundingBox();
  let hit = null;
  for (const [u, v] of [
    [0.6, 0.5],
    [0.55, 0.5],
    [0.65, 0.45],
    [0.5, 0.6],
    [0.62, 0.62],
  ]) {
    await page.mouse.click(box.x + u * box.width, box.y + v * box.height);
    await settled(page);
    if ((await page.locator('#facet-words').textContent()) !== '') {
      hit = await page.locator('#facet-words b').textContent();
      break;
    }
  }
  check(hit !== null, 'a click picks a surface');
  check(/^(edge|corner) \d/.test(hit ?? ''), `it is named: ${hit}`);
  check((await page.locator('.picked .picked-part').count()) === 1, 'the placement is drawn on the track');
  check((await page.locator('.picked .picked-point').count()) === 1, 'with its contact');
  check((await page.locator('#picked-words').textContent()).includes(hit), 'and named there');
  // The contact drawn lies on what is touched: on the pin or on the fence, within the steps of theta.
  await page.locator('#facet').selectOption({ label: 'edge 0 on feature 1 (pin)' });
  await settled(page);
  const off = await page.evaluate(() => {
    const point = document.querySelector('.picked .picked-point');
    const pin = document.querySelector('#animation .obstacles circle');
    const get = (node, name) => Number(node.getAttribute(name));
    return Math.abs(Math.hypot(get(point, 'cx') - get(pin, 'cx'), get(point, 'cy') - get(pin, 'cy')) - get(pin, 'r'));
  });
  check(off < 2, `the contact is ${off} px off the pin`);
  const before = await painted(page);
  await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.5 * box.height);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.4 * box.height, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  check((await painted(page)).sum !== before.sum, 'dragging turns it');
  await page.locator('#space-reset').click();
}

async function tables(page, { turning }) {
  check(
    (await page.locator('#transitions table').count()) === turning.transitions.features.length,
    'every feature has its matrix',
  );
  const cells = await page
    .locator('#transitions table')
    .first()
    .locator('tbody tr')
    .first()
    .locator('td')
    .allTextContents();
  const row = turning.transitions.features[0].matrix[0];
  check(
    row.every((p, i) => (p > 0 ? Math.abs(Number(cells[i]) - p) < 6e-3 : cells[i] === '\u00b7')),
    `its first row is ${cells}`,
  );
  check(
    (await page.locator('#sensitivity .changed').count()) ===
      turning.sensitivity.filter((r) => !r.same_outcomes).length,
    'sensitivity says where outcomes change',
  );
}

async function printing(page) {
  await page.emulateMedia({ media: 'print' });
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await settled(page);
  for (const id of ['#play', '#scrub', '#theta-from', '#colour-by', '.steps']) {
    check(!(await page.locator(id).isVisible()), `${id} is not printed`);
  }
  for (const id of ['#rings svg', '#animation svg', '.space-frame canvas', '#transitions', '#space-caption']) {
    check(await page.locator(id).first().isVisible(), `${id} is printed`);
  }
  check((await painted(page)).share > 0.08, 'the configuration space is printed');
  const paper = await page.pdf({ format: 'A4' });
  check(paper.length > 60000, `the printed report has ${paper.length} bytes`);
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  await page.emulateMedia({ media: 'screen' });
}

await withReport(path, async (page, report, url) => {
  const design = report.designs.find((d) => d.turning);
  const plain = report.designs.find((d) => !d.turning);
  await page.goto(`${url}#${design.id}`);
  await page.reload();
  await settled(page);
  await rings(page, design);
  await keyboard(page, design);
  await path_(page, design);
  await space(page);
  await tables(page, design);
  const text = await page.locator('body').innerText();
  check(!/NaN|undefined|Infinity|\[object/.test(text), 'no number is broken');
  for (const width of [1200, 800]) await checkNoOverflow(page, width);
  await page.setViewportSize({ width: 1200, height: 900 });
  await settled(page);
  await printing(page);
  // A pose's card leads to the interval that it starts in.
  await page.locator('#poses .card').first().click();
  const pose = design.poses[0];
  check(
    (await page.locator('#animation .verdict').textContent()).includes(pose.outcome),
    'a card shows its pose\u2019s path',
  );
  // To a design that turns nothing, and back: one canvas serves all.
  await page.locator(`#designs-table tr[data-id="${plain.id}"]`).click();
  await settled(page);
  for (const id of ['#rings', '.space-frame', '#transitions'])
    check((await page.locator(id).count()) === 0, `without turning there is no ${id}`);
  check(await page.locator('#travel-title').isVisible(), 'its travel is shown as ever');
  await page.locator(`#designs-table tr[data-id="${design.id}"]`).click();
  await settled(page);
  check((await painted(page)).share > 0.08, 'the configuration space comes back');
  // Without WebGL a sentence stands in its place.
  await page.addInitScript(() => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith('webgl') ? null : get.call(this, kind, ...rest);
    };
  });
  await page.reload();
  await settled(page);
  check((await page.locator('#no-webgl').count()) === 1, 'without WebGL the page says so');
  check(await page.locator('#animation svg').isVisible(), 'and shows the path all the same');
});

console.log(`${checked()} checks, ${failures.length} failed`);
process.exitCode = failures.length ? 1 : 0;
