// The page of a run over designs whose parts turn, as the program has made it: rings, paths to scale, the space.
// Argument: the report. Exits with 1 if anything is wrong.
import { check, checked, checkNoOverflow, failures, settled, withReport } from './browser.mjs';

const turned = (deg) => ((deg % 360) + 360) % 360;
const apart = (a, b) => Math.min(turned(a - b), turned(b - a));

await withReport(process.argv[2], async (page, report, url) => {
  const design = report.designs.find((d) => d.turning?.space);
  check(Boolean(design), 'a design has its configuration space');
  if (!design) return;
  const { turning } = design;
  await page.goto(`${url}#${design.id}`);
  await page.reload();
  await settled(page);
  for (const aspect of Object.keys(turning.parts)) {
    const own = turning.outcome_map.filter((o) => o.aspect === aspect);
    own.forEach((o, i) => check(own.length === 1 || o.to_deg === own[(i + 1) % own.length].from_deg, 'intervals join'));
    check(
      (await page.locator(`.ring-box[data-aspect="${aspect}"] .sector`).count()) === own.length,
      `${aspect}: every interval is in the ring`,
    );
  }
  // Every pose's card shows its own path, which ends as the pose does.
  for (const [i, pose] of design.poses.entries()) {
    await page.locator('#poses .card').nth(i).click();
    const words = await page.locator('#animation .verdict').textContent();
    check(words.includes(pose.outcome), `pose ${i} is ${pose.outcome}: ${words}`);
    const path = turning.paths.find(
      (p) => p.aspect === pose.aspect && apart(p.start_deg, pose.orientation_deg) < 2e-3,
    );
    check(Boolean(path), `pose ${i} has a path`);
    const last = path?.points[path.points.length - 1];
    if (last && pose.exit_orientation_deg !== null)
      check(apart(last[2], pose.exit_orientation_deg) < 2e-3, `it leaves at ${last[2]}`);
  }
  // The drawn contacts lie on what is drawn.
  const legs = await page.locator('.step').count();
  check(legs > 2, `the path has ${legs} events`);
  await page.locator('.step').nth(1).click();
  await settled(page);
  check((await page.locator('.contacts .contact').count()) > 0, 'its first event is a contact');
  check((await page.locator('.obstacles').first().locator('title').count()) === turning.obstacles.length, 'obstacles');
  await page.locator('.space-frame canvas').scrollIntoViewIfNeeded();
  await settled(page);
  await settled(page);
  const triangles = Number(await page.locator('.space-frame').getAttribute('data-triangles'));
  check(triangles > 1000, `the space has ${triangles} triangles`);
  const labels = await page.locator('#facet option').allTextContents();
  check(new Set(labels).size === labels.length, 'each surface has a name of its own');
  check(labels.includes('corner 0 on the wall'), `one is of the wall, of ${labels}`);
  check(
    (await page.locator('#transitions table').count()) === design.track.length,
    'every feature has its transitions',
  );
  check((await page.locator('#sensitivity').count()) === 1, 'and sensitivity is told');
  for (const width of [1200, 800]) await checkNoOverflow(page, width);
  const text = await page.locator('body').innerText();
  check(!/NaN|undefined|Infinity|\[object/.test(text), 'no number is broken');
});

console.log(`${checked()} checks, ${failures.length} failed`);
process.exitCode = failures.length ? 1 : 0;
