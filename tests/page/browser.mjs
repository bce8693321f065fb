// A headless browser on a report, and checks that gather instead of stopping at the first.
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

// FORMOTION_PAGE_MODULES: the node_modules that the page was bundled with.
const require = createRequire(join(resolve(process.env.FORMOTION_PAGE_MODULES ?? 'node_modules'), 'page.cjs'));
const { chromium } = require('playwright-core');

// What the driver says when a test, or the printer, reads a canvas.
const kReadBack = /GL Driver Message .*GPU stall due to ReadPixels/;

export const failures = [];
let done = 0;
export function check(condition, text) {
  ++done;
  if (condition) return;
  failures.push(text);
  console.error(`FAILED: ${text}`);
}
export const checked = () => done;

// Opens the report and calls visit(page, report data); errors of the page and requests elsewhere are failures.
export async function withReport(path, visit) {
  const url = pathToFileURL(resolve(path)).href;
  const browser = await chromium.launch({
    executablePath: process.env.FORMOTION_CHROMIUM ?? '/usr/bin/chromium',
    headless: true,
    args: [
      '--no-sandbox',
      '--disable-gpu',
      '--use-angle=swiftshader', // WebGL without a graphics card
      '--enable-unsafe-swiftshader',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
    ],
  });
  try {
    const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
    page.on('pageerror', (error) => check(false, `error of the page: ${error.stack}`));
    page.on('console', (message) =>
      check(
        !['error', 'warning'].includes(message.type()) || kReadBack.test(message.text()),
        `console: ${message.text()}`,
      ),
    );
    page.on('request', (request) => {
      const to = request.url();
      check(to.split('#')[0] === url || to.startsWith('data:'), `the page asks for ${to}`);
    });
    await page.goto(url);
    await settled(page);
    const report = JSON.parse(await page.locator('#report-data').textContent());
    await visit(page, report, url);
  } finally {
    await browser.close();
  }
}

// Two frames: pictures are drawn in the one after a change.
export const settled = (page) =>
  page.evaluate(() => new Promise((next) => requestAnimationFrame(() => requestAnimationFrame(next))));

export async function checkNoOverflow(page, width) {
  await page.setViewportSize({ width, height: 900 });
  await settled(page);
  await settled(page);
  const [content, window] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
  check(content <= window, `at ${width} px the page is ${content} px wide`);
}

export const number = (text) => Number(text.replace(/[^0-9.\u2212-]/g, '').replace('\u2212', '-'));
