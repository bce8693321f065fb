// Uses the pages of a pallet and of a fixture: rests and ways out, the map of starts, the landscape, the table.
// Arguments: the page without data (page.html), where to write the reports. Exits with 1 if anything is wrong.
import { readFileSync, writeFileSync } from 'node:fs';

import { contourPath, levels } from '../../web/src/contours.js';
import { check, checked, checkNoOverflow, failures, settled, withReport } from './browser.mjs';
import { fillPage, makeReport } from './nest_fixture.mjs';

const [pagePath, path] = process.argv.slice(2);
if (!path) throw new Error('usage: nest.mjs page.html report.html');

const template = readFileSync(pagePath, 'utf8');
const near = (a, b, within = 1e-3) => Math.abs(a - b) < within;
const attribute = async (page, name) =>
  Number(await page.locator(`#readout [data-${name}]`).getAttribute(`data-${name}`));
const textOf = async (page, selector) => (await page.locator(selector).textContent()).replaceAll('\u2212', '-');
// A text names a number, however its last digit is rounded.
const names = (text, value, digits = 2) =>
  (text.match(/-?\d+(\.\d+)?/g) ?? []).some((word) => Math.abs(Number(word) - value) <= 0.501 * 10 ** -digits);

async function open(page, url, design) {
  await page.goto(`${url}#${design.id}`);
  await page.reload();
  await settled(page);
  await settled(page);
}

async function cards(page, { nest }) {
  const wrong = nest.wrong ?? [];
  check((await page.locator('#rests .card').count()) === nest.rests.length + wrong.length, 'every rest has a card');
  check((await page.locator('#rests .card.seat').count()) === 1, 'one of them is the seat');
  const pressed = page.locator('#rests .card[aria-pressed="true"]');
  check((await pressed.count()) === 1 && /the seat/.test(await pressed.innerText()), 'the seat is chosen at first');
  for (const [i, rest] of nest.rests.entries()) {
    const words = await textOf(page, `[data-choice="${i}"]`);
    check(names(words, 100 * rest.drop_share, 1), `rest ${i + 1} says its share of drops`);
    for (const bound of rest.escape_height_mm ?? [])
      check(names(words, bound), `rest ${i + 1} says ${bound}: ${words}`);
  }
  for (const [i, set] of wrong.entries()) {
    const words = await textOf(page, `[data-choice="${nest.rests.length + i}"]`);
    check(words.includes(set.verdict), `wrong equilibrium ${i + 1} is ${set.verdict}`);
    check(words.includes(set.size_mm > 0 ? `${set.size_mm.toFixed(2)} mm` : 'a single place'), 'and says its size');
  }
}

// The way out of every rest: it plays, goes over its highest point and ends outside.
async function waysOut(page, { nest }) {
  for (const [i, rest] of nest.rests.entries()) {
    if (i % 3 !== 1) continue;
    const card = page.locator(`[data-choice="${i}"]`);
    if (i === 1) {
      await card.focus();
      await page.keyboard.press('Enter');
    } else {
      await card.click();
    }
    check((await card.getAttribute('aria-pressed')) === 'true', `card ${i} is marked`);
    check((await textOf(page, '#play')).includes('Pause'), 'its way out plays');
    const before = await attribute(page, 'at');
    await page.waitForFunction(
      (at) => Number(document.querySelector('#readout [data-at]').dataset.at) > at + 0.01,
      before,
    );
    await page.locator('#jump').click();
    check(near(await attribute(page, 'rise'), rest.escape_height_mm[1], 2e-3), `the highest point of rest ${i + 1}`);
    check(names(await textOf(page, '.highest-words'), rest.escape_height_mm[1]), 'its rise is drawn');
    const high = await page.locator('#animation g.part').getAttribute('transform');
    await page.locator('#scrub').press('Home');
    check(
      near(await attribute(page, 'rise'), 0) && near(await attribute(page, 'x'), rest.x_mm),
      'it begins in the rest',
    );
    check((await page.locator('#animation g.part').getAttribute('transform')) !== high, 'the part moves');
    await page.locator('#scrub').press('End');
    const last = rest.way_out.at(-1);
    check(
      near(await attribute(page, 'x'), last.x_mm) && near(await attribute(page, 'y'), last.y_mm),
      'and ends outside',
    );
    check((await page.locator('.height-chart .bound').count()) === 1, 'the lower bound is drawn');
  }
}

async function equilibria(page, { nest }) {
  const [set] = nest.wrong;
  await page.locator(`[data-choice="${nest.rests.length}"]`).click();
  await page.locator('#scrub').press('End');
  check(near(await attribute(page, 'theta'), set.samples.at(-1).orientation_deg), 'a set is gone through to its end');
  check((await page.locator('.height-chart').count()) === 0, 'and has no way out');
  await page.locator(`[data-choice="${nest.rests.length + 1}"]`).click();
  check((await page.locator('#scrub').count()) === 0, 'a single place does not move');
  await page.locator('#travel g.part').waitFor();
  check((await page.locator('#travel g.part').count()) === 1, 'but it is shown');
  check((await page.locator('.rest-mark.chosen').count()) === 0, 'no rest is marked then');
}

async function starts(page, { nest }) {
  const { region } = nest;
  const shown = nest.starts.filter((one) => one.y_mm === region.y_mm);
  check(
    (await page.locator('.region-map .start').count()) === shown.length,
    'starts at the height of the map are marked',
  );
  for (const [name, share] of Object.entries(region.shares)) {
    check((await page.locator(`.region.${name}`).count()) > 0, `${name} starts are drawn`);
    check(names(await textOf(page, `[data-share="${name}"]`), 100 * share, 1), `${name} has its share`);
    const index = shown.findIndex((one) => one.outcome === name);
    if (index < 0) continue;
    await page.locator('.region-map').scrollIntoViewIfNeeded();
    const dot = await page.locator(`.start[data-start="${index}"]`).boundingBox();
    await page.mouse.click(dot.x + dot.width / 2, dot.y + dot.height / 2);
    await settled(page);
    check((await textOf(page, '#start-picture .verdict')).includes(name), `a click shows a start that is ${name}`);
    check((await page.locator('#start-picture .nest-start').count()) === 1, 'where it starts');
    check((await page.locator(`#start-picture g.part.${name}`).count()) === 1, 'and where it ends');
    check((await textOf(page, '#region-words')).includes(name), 'in words, too');
  }
  const before = await page.locator('.start-picked .rim').getAttribute('data-picked');
  await page.locator('.region-map').focus();
  await page.keyboard.press(shown[Number(before)].x_mm < region.x_mm[1] ? 'ArrowRight' : 'ArrowLeft');
  check(
    (await page.locator('.start-picked .rim').getAttribute('data-picked')) !== before,
    'an arrow picks another start',
  );
}

async function landscape(page, { nest }) {
  check((await page.locator('.landscape-figure').count()) === nest.landscape.length, 'a map for every aspect');
  for (const land of nest.landscape) {
    const map = page.locator(`.landscape-figure[data-aspect="${land.aspect}"]`);
    const { symmetry } = nest.aspects.find(({ name }) => name === land.aspect);
    const own = nest.rests.map((rest, i) => ({ ...rest, i })).filter((rest) => rest.aspect === land.aspect);
    check((await map.locator('.rest-mark').count()) === own.length * symmetry, 'every rest is marked, once a turn');
    const passes = nest.passes.filter((pass) => pass.aspect === land.aspect);
    check(
      (await map.locator('.pass').count()) === passes.filter((pass) => 'x_mm' in pass).length,
      'every pass is marked',
    );
    for (const [i, pass] of passes.entries())
      check(
        names(await map.locator('.pass text').nth(i).textContent(), pass.upper_mm ?? pass.lower_mm),
        `the height of pass ${i}`,
      );
    const listed = passes.length ? await map.locator('.pass-list').textContent() : '';
    for (const pass of passes) check(names(listed, pass.upper_mm ?? pass.lower_mm), 'passes are listed in words');
    check(
      (await map.locator('.rest-mark.hidden').count()) === land.hidden.length * symmetry,
      'hidden rests are marked',
    );
    check((await map.locator('.contour').count()) > 3, 'heights have contour lines');
    check((await map.locator('image').getAttribute('href')).startsWith('data:image/png'), 'cells are a picture');
    // Colours differ where basins do.
    const colours = await map.locator('image').evaluate(async (node) => {
      const image = new Image();
      image.src = node.getAttribute('href');
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      return {
        size: [image.width, image.height],
        data: [...context.getImageData(0, 0, image.width, image.height).data],
      };
    });
    const [rows, columns] = [land.heights_mm.length, land.heights_mm[0].length];
    check(colours.size[0] === columns && colours.size[1] === rows + 1, 'a pixel a cell, the first row twice');
    const at = (r, c) => colours.data.slice(4 * ((rows - r) * columns + c), 4 * ((rows - r) * columns + c) + 3);
    const hueOf = (r, c) => {
      const [red, green, blue] = at(r, c).map((v) => 255 - v);
      return Math.round((360 * Math.atan2(Math.sqrt(3) * (green - blue), 2 * red - green - blue)) / (2 * Math.PI));
    };
    const hues = new Map();
    land.basin.forEach((row, r) =>
      row.forEach((basin, c) => {
        if (land.heights_mm[r][c] === null || basin < 0) return;
        if (!hues.has(basin)) hues.set(basin, []);
        hues.get(basin).push(hueOf(r, c));
      }),
    );
    for (const [basin, list] of hues) {
      const middle = list[Math.floor(list.length / 2)];
      const off = list.filter((hue) => Math.abs(((hue - middle + 540) % 360) - 180) > 12);
      check(off.length === 0, `all cells of basin ${basin + 1} have one hue`);
      check((await map.locator(`[data-basin="${basin}"]`).count()) === 1, `the legend names basin ${basin + 1}`);
    }
    // A click says the height of the cell that is clicked.
    const [r, c] = [Math.floor(rows / 3), Math.floor(columns / 4)];
    const box = await map.locator('.landscape-none').boundingBox();
    await page.mouse.move(0, 0);
    await map.locator('.landscape-map').scrollIntoViewIfNeeded();
    const place = await map.locator('.landscape-none').boundingBox();
    await page.mouse.click(place.x + (place.width * c) / (columns - 1), place.y + place.height * (1 - r / rows));
    check(box.width > 200, 'the map is large enough to be used');
    const words = (await map.locator('.landscape-words').textContent()).replaceAll('\u2212', '-');
    check(names(words, land.heights_mm[r][c]), `the height there: ${words}`);
    await map.locator('.landscape-map').focus();
    await page.keyboard.press('ArrowUp');
    const above = (await map.locator('.landscape-words').textContent()).replaceAll('\u2212', '-');
    check(names(above, land.heights_mm[r + 1][c]), `an arrow goes on by a row: ${above}`);
    // A rest on the map chooses its card.
    const mark = map.locator(`.rest-mark[data-rest="${own[own.length - 1].i}"]`).first();
    await mark.focus();
    await page.keyboard.press('Enter');
    check(
      (await page.locator(`[data-choice="${own[own.length - 1].i}"]`).getAttribute('aria-pressed')) === 'true',
      'a rest of the map chooses its card',
    );
    check((await map.locator('.rest-mark.chosen').count()) === symmetry, 'and is marked');
  }
}

async function table(page, { nest }) {
  const { window } = nest;
  const said = async (key) => textOf(page, `[data-window="${key}"]`);
  check(
    (await said('keeps')).startsWith(window.keeps_up_to_amplitude_mm.toFixed(3)),
    'the amplitude that the seat bears',
  );
  check(
    (await said('loses')).startsWith(window.loses_from_amplitude_mm.toFixed(3)),
    'that from which wrong rests lose',
  );
  check((await said('throws')).startsWith(window.throws_mm.toFixed(2)), 'how high it throws');
  check((await said('drops')).startsWith(window.drops_per_part.toFixed(2)), 'drops for each part');
  check((await said('right')).startsWith((100 * window.right_share).toFixed(1)), 'the share of right parts');
  // The bar is to scale.
  const bars = page.locator('.window-bar');
  const [keeps, both] = [await bars.locator('.keeps').boundingBox(), await bars.locator('.both').boundingBox()];
  const share = both.width / keeps.width;
  const wanted = 1 - window.loses_from_amplitude_mm / window.keeps_up_to_amplitude_mm;
  check(near(share, wanted, 0.01), `the window is to scale: ${share} of ${wanted}`);
  const honest = await textOf(page, '#window-honest');
  check(/point masses/.test(honest) && /heuristic/.test(honest), 'what the keeping side is worth');
  check(/how fast/.test(honest) && /simulates/.test(honest), 'what the losing side does not say');
  check((await textOf(page, '.shaken')).includes('40 of 40'), 'what was simulated');
}

async function wholePage(page) {
  const text = await page.locator('body').innerText();
  check(!/NaN|undefined|Infinity|\[object/.test(text), 'no number is broken');
  for (const width of [1200, 800, 420]) await checkNoOverflow(page, width);
  await page.setViewportSize({ width: 1200, height: 900 });
  await settled(page);
  const ids = await page.evaluate(() => [...document.querySelectorAll('[id]')].map((node) => node.id));
  check(new Set(ids).size === ids.length, 'no id is there twice');
}

const kFacts = {
  pallet: ['tilted by 5', 'shakes along gravity by 0.5 mm at 30 Hz', 'seated within 1 mm', 'y 12 mm'],
  fixture: ['towards', 'y 10 to 14 mm', 'turned 45'],
};

async function others(page, report) {
  const [design, plain, invalid] = report.designs;
  await page.locator(`#designs-table tr[data-id="${plain.id}"]`).click();
  await settled(page);
  check((await page.locator('.landscape-figure').count()) === 0, 'a landscape that is left out is not drawn');
  check(/leaves out/.test(await textOf(page, '#chosen')), 'and that is said');
  if (plain.nest.window) {
    check((await textOf(page, '[data-window="loses"]')) === 'not known', 'a losing side that is not known');
    check((await page.locator('.window-bar .both').count()) === 0, 'then no window is drawn');
    check(/Nothing has been simulated/.test(await textOf(page, '#window')), 'nothing simulated is said');
  }
  await page.locator(`#designs-table tr[data-id="${invalid.id}"]`).click();
  await settled(page);
  check(/crosses itself/.test(await textOf(page, '#violations')), 'what is wrong with a design that cannot be judged');
  check(/rests nowhere/.test(await textOf(page, '#chosen')), 'it has no rests');
  await wholePage(page);
  await page.locator(`#designs-table tr[data-id="${design.id}"]`).click();
  await settled(page);
}

// Ends of a contour's pieces lie on its level, and it leaves the grid or closes: every other end is met twice.
function contours() {
  const height = (r, c) => Math.sin(0.9 * r) * Math.cos(1.3 * c) + 0.1 * r;
  const values = Array.from({ length: 12 }, (_, r) => Array.from({ length: 15 }, (__, c) => height(r, c)));
  values[4][7] = null;
  const { step, list } = levels(-1, 2, 12);
  check(step === 0.5 || step === 0.25 || step === 0.2, `levels are round: ${step}`);
  check(
    list.every((level) => level >= -1 && level < 2 && near(level / step, Math.round(level / step), 1e-9)),
    'all',
  );
  for (const level of list) {
    const found = new Map();
    const at = (r, c) => {
      const [r0, c0] = [Math.floor(r + 1e-12), Math.floor(c + 1e-12)];
      const [r1, c1] = [Math.min(r0 + 1, 11), Math.min(c0 + 1, 14)];
      const [u, v] = [r - r0, c - c0];
      const [a, b] = [values[r0][c0], u > 1e-9 ? values[r1][c0] : values[r0][c1]];
      const height = u > 1e-9 ? a + u * (b - a) : v > 1e-9 ? a + v * (b - a) : a;
      check(near(height, level, 1e-9), `a contour of ${level} is at ${height}`);
      const key = `${r.toFixed(6)},${c.toFixed(6)}`;
      found.set(key, { count: (found.get(key)?.count ?? 0) + 1, r, c });
      return [c, r];
    };
    contourPath(values, level, at);
    const nearGap = ({ r, c }) => Math.abs(r - 4) <= 1 && Math.abs(c - 7) <= 1;
    for (const one of found.values()) {
      const atRim = one.r === 0 || one.r === 11 || one.c === 0 || one.c === 14;
      check(one.count === 2 || atRim || nearGap(one), `a contour of ${level} ends at ${one.r}, ${one.c}`);
    }
  }
}
contours();

for (const kind of ['pallet', 'fixture']) {
  const report = path.replace(/(\.html)?$/, `_${kind}.html`);
  writeFileSync(report, fillPage(template, makeReport(kind)));
  await withReport(report, async (page, data, url) => {
    const [design] = data.designs;
    await open(page, url, design);
    check((await textOf(page, '.kind')).includes(kind), 'the kind is named');
    const asked = await textOf(page, '#asked');
    for (const fact of kFacts[kind]) check(asked.includes(fact), `asked: ${fact}`);
    check((await page.locator('#asked .nest-picture g.part').count()) === 1, 'the part in its seat is drawn');
    for (const id of ['#poses', '#rings', '#features'])
      check((await page.locator(id).count()) === 0, `there is no ${id}`);
    for (const [name, value] of Object.entries(design.metrics)) {
      const shown = await textOf(page, `#figures [data-measure="${name}"]`);
      const factor = name.endsWith('_fraction') ? 100 : 1;
      check(near(Number.parseFloat(shown), factor * value, 0.06), `${name} is ${shown}`);
    }
    await cards(page, design);
    await (kind === 'pallet' ? waysOut : equilibria)(page, design);
    await starts(page, design);
    await landscape(page, design);
    if (kind === 'pallet') await table(page, design);
    else check((await page.locator('#window').count()) === 0, 'a fixture is not shaken');
    await wholePage(page);
    await others(page, data);
    if (process.env.SHOT) await page.screenshot({ path: `${process.env.SHOT}_${kind}.png`, fullPage: true });
  });
}

console.log(`${checked()} checks, ${failures.length} failed`);
process.exitCode = failures.length ? 1 : 0;
