// The page: reads the report's data and builds the sections.

import { asked } from './asked.js';
import { chosenDesign } from './chosen.js';
import { comparison } from './comparison.js';
import { designsTable } from './designs_table.js';
import { h } from './dom.js';
import { counted, designsEvaluated, measure, short, whole } from './format.js';
import { findings } from './findings.js';
import { history } from './history.js';
import { kindOf } from './kinds.js';
import { pareto } from './pareto.js';
import { makeState } from './state.js';

const report = JSON.parse(document.getElementById('report-data').textContent);
const byId = (id) => document.getElementById(id);

// The address' fragment, the knee, else the design that is best in the first objective.
function firstDesign() {
  const named = location.hash.slice(1);
  if (report.designs.some((d) => d.id === named)) return named;
  if (report.knee) return report.knee.id;
  if (report.run.feasible === 0) return [...report.designs].sort((a, b) => a.violation - b.violation)[0]?.id ?? null;
  const sign = report.problem.objectives[0]?.maximise === false ? 1 : -1;
  return [...report.designs].sort((a, b) => sign * (a.objectives[0] - b.objectives[0]))[0]?.id ?? null;
}

const state = makeState({ design: firstDesign(), pose: 0, brushed: null });

function verdict() {
  const { feasible } = report.run;
  const evaluations = designsEvaluated(report);
  const among = `${whole(evaluations)} evaluated ${evaluations === 1 ? 'design' : 'designs'}`;
  if (evaluations === 0) return ['Nothing has been evaluated yet.', ''];
  if (feasible === 0) {
    const nearest =
      report.designs.length === 1
        ? 'Below is the nearest one'
        : `Below are the ${whole(report.designs.length)} nearest ones, each`;
    return ['No feasible design:', `among ${among} none met the goal. ${nearest} with what is wrong.`];
  }
  return [
    counted(report.designs.length, 'non-dominated design', 'non-dominated designs'),
    `among ${among}, of which ${whole(feasible)} ${feasible === 1 ? 'is' : 'are'} feasible. Better designs may exist: the search is not exhaustive.`,
  ];
}

function header() {
  const { run, problem } = report;
  const [title, rest] = verdict();
  document.title = `${problem.name} \u2013 Formotion report`;
  byId('head').append(
    h('p', { class: 'kind' }, `Formotion report \u00b7 ${kindOf(report).title}`),
    h('h1', null, problem.name),
    h(
      'p',
      { class: report.run.feasible ? 'verdict' : 'verdict bad', id: 'verdict' },
      h('strong', null, title),
      ' ',
      rest,
    ),
    h(
      'p',
      { class: 'small' },
      `${whole(run.evaluations)} of ${whole(run.budget)} evaluations${run.stages ? ` (${whole(run.stages)} of them of single features)` : ''}, seed ${run.seed}, ${report.program}`,
      run.complete
        ? ''
        : [' ', h('span', { class: 'pill infeasible' }, 'the search has not ended: resume it for the whole')],
    ),
  );
}

// Resolutions too fine to be seen are not worth a word.
function resolutionWords({ name, resolution }) {
  const { title, unit } = measure(name);
  const value = short(unit === '%' ? 100 * resolution : resolution, 3);
  return Number(value) > 0 ? `${value}${unit ? ` ${unit}` : ''} of ${title.toLowerCase()}` : null;
}

function designsSection() {
  const distinct = report.problem.objectives.map((o) => resolutionWords(o)).filter(Boolean);
  const found = report.run.feasible > 0;
  byId('designs').append(
    h('h2', { id: 'designs-title' }, found ? 'The front' : 'Nearest to the goal'),
    ...(report.designs.length === 0
      ? [h('p', { class: 'empty' }, 'No design has been evaluated.')]
      : [
          h(
            'p',
            { class: 'small' },
            found
              ? [
                  'Non-dominated: no other evaluated design is better in one of the objectives and worse in none',
                  distinct.length
                    ? `; of those that differ by less than ${distinct.join(', ')}, one stands for all`
                    : '',
                  '. ',
                ]
              : 'None of these may be built as it is; choose one to see what is wrong. ',
            h(
              'span',
              { class: 'screen' },
              'Drag over the figure to filter the table; click a mark or a row to see the design.',
            ),
            report.knee ? h('span', null, ` The knee is the design ${report.knee.how}.`) : '',
          ),
          h('div', { class: 'front-views' }, pareto(report, state), designsTable(report, state)),
        ]),
  );
}

// Candidates without a score, by what went wrong.
function failures(report) {
  const found = Object.entries(report.run.failures ?? {}).filter(([, count]) => count > 0);
  if (found.length === 0) return null;
  return h(
    'p',
    { class: 'small bad', id: 'failures' },
    `Without a score: ${found.map(([what, count]) => `${whole(count)} by ${what}`).join(', ')}; files that repeat them are in quarantine/ beside this page.`,
  );
}

function searchSection() {
  byId('search').append(
    h('h2', { id: 'search-title' }, 'How the search went'),
    h(
      'p',
      { class: 'small' },
      'Against evaluations: the hypervolume that the front dominates, and the best value of every objective among feasible designs; each alone, no one design has them all.',
    ),
    history(report),
    ...[comparison(report), findings(report), failures(report)].filter(Boolean),
  );
}

header();
byId('asked').append(...asked(report).flat().filter(Boolean));
designsSection();
chosenDesign(report, state, byId('chosen'));
searchSection();
byId('foot').append(
  h(
    'p',
    { class: 'small' },
    `Made by ${report.program} from ${report.problem.path}. This file is complete in itself; the links lead to designs/ beside it.`,
  ),
);
state.on('design', (id) => {
  try {
    window.history.replaceState(null, '', `#${id}`);
  } catch {
    // Some viewers of local files forbid it; the page works without.
  }
});
