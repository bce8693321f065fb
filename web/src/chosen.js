// The chosen design: what it scores, what to mind, its drawing, poses, travel, numbers and how to reproduce it.

import { h } from './dom.js';
import { fixed, kWeak_mm, measure, mm, short, whole, withUnit } from './format.js';
import { kindOf } from './kinds.js';
import { stampDetails, stampPill } from './stamp.js';
import { poseTravel } from './pose_travel.js';
import { poseCards } from './poses.js';
import { featureTable, trackDrawing } from './track_drawing.js';
import { turningSection } from './turning.js';

export function chosenDesign(report, state, section) {
  let running = null;

  function draw() {
    running?.pause();
    running?.release?.();
    running = null;
    const design = report.designs.find((d) => d.id === state.get('design'));
    if (!design) {
      section.replaceChildren(
        h('h2', { id: 'chosen-title' }, 'The chosen design'),
        h('p', { class: 'empty' }, 'No design has been evaluated.'),
      );
      return;
    }
    if (kindOf(report).section) return drawShapes(design);
    const part = report.parts[design.part];
    const { environment, manufacture } = report.problem;
    const cards = poseCards(design, part, environment.track_width_mm, state);
    const turning = design.turning ? turningSection(design, part, environment.track_width_mm) : null;
    const travel = turning ? null : h('div', { id: 'travel' });
    section.replaceChildren(
      heading(report, design),
      figures(report, design),
      ...[uncertainties(report, design), stampDetails(design)].filter(Boolean),
      cautions(report, design),
      h('h3', null, 'The track, seen from above'),
      h(
        'p',
        { class: 'small' },
        'To scale, dimensions in mm. Cut what is white; hatched is the wall, its face is y = 0. ',
        turning ? 'What is dark stands on the track. ' : '',
        links(design),
      ),
      trackDrawing(design, environment.track_width_mm),
      featureTable(design, environment.track_width_mm, manufacture.cutter_radius_mm),
      h('h3', null, 'What becomes of every pose'),
      h(
        'p',
        { class: 'small' },
        turning
          ? 'Each as it arrives, all to one scale; the wall is below, parts move to the right. Choose one to see its path.'
          : 'Each at the instant that decides it, all to one scale; the wall is below, parts move to the right. Choose one to see its travel.',
      ),
      cards.node,
      ...(turning ? [turning.node] : [h('h3', { id: 'travel-title' }, 'Its travel over the track'), travel]),
      numbers(report, design),
    );
    cards.mark();
    section.refreshPose = () => {
      cards.mark();
      if (turning) {
        running = turning;
        const pose = design.poses[state.get('pose')];
        turning.select(pose?.aspect, pose?.orientation_deg ?? 0);
        return;
      }
      running?.pause();
      running = design.poses.length ? poseTravel(design, state.get('pose'), part, environment) : null;
      travel.replaceChildren(
        running?.node ?? h('p', { class: 'empty' }, 'The part rests in no pose, so nothing travels.'),
      );
    };
    section.refreshPose();
  }

  function drawShapes(design) {
    running = kindOf(report).section(design, report.problem);
    section.replaceChildren(
      heading(report, design),
      figures(report, design),
      ...[uncertainties(report, design), stampDetails(design)].filter(Boolean),
      shapeCautions(design, kindOf(report).limits),
      h('p', { class: 'small' }, links(design)),
      running.node,
      numbers(report, design),
    );
  }

  // The goal's pose first, else the first one that counts against the design.
  function choose() {
    const design = report.designs.find((d) => d.id === state.get('design'));
    if (design?.poses)
      state.set(
        'pose',
        design.goal_pose ??
          Math.max(
            0,
            design.poses.findIndex((p) => p.outcome !== 'rejected'),
          ),
      );
    draw();
  }
  state.on('design', choose);
  state.on('pose', () => section.refreshPose?.());
  choose();
}

function numbers(report, design) {
  return h(
    'div',
    { class: 'columns' },
    h('div', null, h('h3', null, 'Variables'), variables(report, design)),
    h('div', null, h('h3', null, 'Reproduce it'), reproduce(report, design)),
  );
}

function heading(report, design) {
  const knee = design.id === report.knee?.id;
  return h(
    'div',
    { class: 'heading' },
    h('h2', { id: 'chosen-title' }, `Design ${design.id}`),
    h(
      'span',
      { class: design.feasible ? 'pill feasible' : 'pill infeasible' },
      design.feasible ? '\u2713 feasible' : '\u2715 not feasible',
    ),
    stampPill(design),
    knee ? h('span', { class: 'pill', title: report.knee.how }, '\u25c6 knee of the front') : null,
    h(
      'span',
      { class: 'faint' },
      `${design.label} \u00b7 evaluation ${whole(design.number)}${design.provenance ? ` \u00b7 proposed by ${design.provenance}` : ''}`,
    ),
  );
}

function figures(report, design) {
  return h(
    'dl',
    { class: 'figures', id: 'figures' },
    kindOf(report).figures.map((name) =>
      h(
        'div',
        { title: measure(name).says },
        h('dt', null, measure(name).title),
        h('dd', { 'data-measure': name }, withUnit(name, design.metrics[name])),
        report.problem.uncertainty && design.worst_case && name in design.worst_case
          ? h('dd', { class: 'worst', 'data-worst': name }, `${withUnit(name, design.worst_case[name])} at worst`)
          : null,
      ),
    ),
  );
}

// The uncertain values as asked for, which of them bites, and how large they could be.
function uncertainties(report, design) {
  const asked = report.problem.uncertainty;
  if (!asked) return null;
  const bearable = design.uncertainty;
  const rows = Object.entries(asked.intervals ?? {}).concat(
    ['outline_mm', 'com_mm', 'feature_mm'].filter((name) => asked[name] > 0).map((name) => [name, asked[name]]),
  );
  const text = (value) =>
    Array.isArray(value) ? value.map((v) => short(v, 4)).join(' to ') : `\u00b1 ${short(value, 4)}`;
  return h(
    'div',
    { id: 'uncertainty' },
    h('h3', null, 'What is uncertain'),
    h(
      'table',
      { class: 'plain' },
      h(
        'thead',
        null,
        h(
          'tr',
          null,
          ['Value', 'asked for', 'bearable alone', ''].map((t) => h('th', { scope: 'col' }, t)),
        ),
      ),
      h(
        'tbody',
        null,
        rows.map(([name, value]) =>
          h(
            'tr',
            null,
            h('th', { scope: 'row' }, name),
            h('td', null, text(value)),
            h(
              'td',
              null,
              bearable?.alone?.[name] === undefined || bearable.alone[name] === null
                ? '\u2013'
                : text(bearable.alone[name]),
            ),
            h('td', { class: 'small' }, design.worst_case?.bites === name ? 'bites first' : ''),
          ),
        ),
      ),
    ),
    bearable?.scale === undefined || bearable.scale === null
      ? null
      : h(
          'p',
          { class: 'small' },
          `All of them together may be ${short(bearable.scale, 3)} times as large before the design is no longer feasible.`,
        ),
  );
}

function whatIsWrong(design) {
  if (!design.violations.length) return null;
  const wrong = design.violations.map((v) =>
    h('li', { class: 'bad' }, h('b', null, v.what), ` (${v.where}${v.by > 0 ? `, by ${short(v.by, 4)}` : ''})`),
  );
  return [h('h3', null, 'Why it is not feasible'), h('ul', { id: 'violations' }, wrong)];
}

function shapeCautions(design, limits) {
  return h(
    'div',
    { class: 'cautions' },
    whatIsWrong(design),
    h('h3', null, 'Before you cut metal'),
    h(
      'ul',
      { id: 'cautions' },
      design.feasible ? null : h('li', { class: 'bad' }, 'Do not build this design: it does not meet the goal.'),
      (design.warnings ?? []).map((text) => h('li', { class: 'warn' }, `${text}.`)),
      limits.map((text) => h('li', null, text)),
    ),
  );
}

function cautions(report, design) {
  const { tolerance_mm: tolerance } = design.metrics;
  const own = [
    design.feasible ? null : h('li', { class: 'bad' }, 'Do not build this design: it does not meet the goal.'),
    tolerance === null
      ? h('li', { class: 'bad' }, 'It has no tolerance: a shape is impossible as asked, or no pose arrives.')
      : tolerance < kWeak_mm
        ? h(
            'li',
            { class: 'warn' },
            `Its tolerance of ${mm(tolerance)} is below ${kWeak_mm} mm: cutting errors and vibration may change an outcome.`,
          )
        : null,
    ...groupedWarnings(design.warnings).map((text) => h('li', { class: 'warn' }, text)),
  ].filter(Boolean);
  return h(
    'div',
    { class: 'cautions' },
    whatIsWrong(design),
    h('h3', null, 'Before you cut metal'),
    h(
      'ul',
      { id: 'cautions' },
      own,
      h(
        'li',
        null,
        'Outcomes are static: a part that loses its support anywhere counts as lost. Vibration, hopping and speed are not simulated; ',
        'predictions within 0.3 to 0.5 mm of critical mean little under vibration.',
      ),
      design.turning
        ? h(
            'li',
            null,
            'How parts turn is computed for one part alone that moves slowly, held back by the track: speed, bouncing and parts that push each other are not simulated.',
          )
        : null,
      h(
        'li',
        null,
        'A lost part may catch with its nose on the far edge of a void instead of falling, most of all at gaps across the whole track. Try a first part by hand.',
      ),
      report.problem.uncertainty && !design.worst_case
        ? h(
            'li',
            null,
            'The worst case over the stated uncertainties is not computed for this design; compare them with the tolerance.',
          )
        : null,
    ),
  );
}

// "pose A: text" and "pose B: text" of the same text become one line.
function groupedWarnings(warnings) {
  const texts = new Map();
  for (const warning of warnings) {
    const split = /^pose (.+? deg): (.*)$/.exec(warning);
    const [who, text] = split ? [split[1], split[2]] : ['', warning];
    texts.set(text, [...(texts.get(text) ?? []), who]);
  }
  return [...texts].map(([text, who]) =>
    who[0]
      ? `Pose ${who.map((w) => w.replace(' deg', '\u00b0')).join(', ')}: ${text}.`
      : `${text.replace(/^./, (c) => c.toUpperCase())}.`,
  );
}

function links(design) {
  const file = (kind, title) => h('a', { href: `designs/${design.id}.${kind}` }, title);
  return h(
    'span',
    { class: 'links' },
    file('svg', 'drawing (SVG)'),
    ' \u00b7 ',
    file('dxf', 'contours (DXF)'),
    ' \u00b7 ',
    file('json', 'numbers (JSON)'),
  );
}

function variables(report, design) {
  const rows = report.problem.variables
    .filter((v) => v.name in design.values)
    .map((v) => {
      const value = design.values[v.name];
      const share = v.max > v.min ? (value - v.min) / (v.max - v.min) : 0.5;
      const bound = share < 1e-6 ? 'at its least' : share > 1 - 1e-6 ? 'at its most' : '';
      return h(
        'tr',
        null,
        h('th', { scope: 'row' }, v.name),
        h('td', { class: 'num' }, fixed(value, 4)),
        h('td', { class: 'num faint' }, short(v.min, 4)),
        h(
          'td',
          null,
          h(
            'span',
            { class: 'range', title: `${short(v.min, 4)} to ${short(v.max, 4)}` },
            h('i', { style: `left:${(100 * Math.max(0, Math.min(1, share))).toFixed(1)}%` }),
          ),
        ),
        h('td', { class: 'num faint' }, short(v.max, 4)),
        h('td', { class: 'small' }, v.max > v.min ? bound : 'fixed'),
      );
    });
  if (!rows.length) return h('p', { class: 'empty' }, 'This choice of features has no variables.');
  return h(
    'table',
    { class: 'plain variables', id: 'variables' },
    h(
      'thead',
      null,
      h(
        'tr',
        null,
        h('th', { scope: 'col' }, 'Name'),
        h('th', { scope: 'col', class: 'num' }, 'Value'),
        h('th', { scope: 'col', class: 'num' }, 'least'),
        h('th', null),
        h('th', { scope: 'col', class: 'num' }, 'most'),
        h('th', null),
      ),
    ),
    h('tbody', null, rows),
  );
}

function reproduce(report, design) {
  const line = (command) => h('div', { class: 'command' }, h('code', null, command), copyButton(command));
  return h(
    'div',
    { id: 'reproduce' },
    h('p', { class: 'small' }, 'Scores this design again, from its exact numbers:'),
    line(design.commands.evaluate),
    h('p', { class: 'small' }, 'Prints its file again, should it be missing:'),
    line(design.commands.export),
    h('p', { class: 'small faint' }, `Run folder as by default; the search itself had seed ${report.run.seed}.`),
  );
}

function copyButton(text) {
  const button = h(
    'button',
    {
      type: 'button',
      class: 'copy',
      onclick: async () => {
        try {
          await navigator.clipboard.writeText(text);
          button.textContent = 'Copied';
        } catch {
          getSelection().selectAllChildren(button.previousElementSibling);
          button.textContent = 'Selected';
        }
        setTimeout(() => {
          button.textContent = 'Copy';
        }, 1500);
      },
    },
    'Copy',
  );
  return button;
}
