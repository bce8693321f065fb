// The best value of every objective against the evaluations spent.

import { extent } from 'd3-array';
import { axisBottom, axisLeft } from 'd3-axis';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { h, onWidth, s } from './dom.js';
import { measure, titled, whole, withUnit } from './format.js';

const kHeight = 150;
const kMargin = { left: 48, right: 26, top: 10, bottom: 24 };

export function history(report) {
  const steps = report.history.filter((step) => step.best.length > 0);
  if (steps.length === 0) {
    return h('p', { class: 'empty' }, 'No feasible design was found, so there is no course of best values.');
  }
  return h(
    'div',
    { class: 'charts', id: 'history' },
    report.problem.objectives.map((objective, k) => {
      const plot = h('div', { class: 'plot' });
      onWidth(
        plot,
        (px) => plot.replaceChildren(chart(report, steps, k, px)),
        Math.min(3, report.problem.objectives.length),
      );
      const last = steps[steps.length - 1].best[k];
      return h(
        'figure',
        null,
        h(
          'figcaption',
          null,
          `Best ${titled(objective.name).replace(/^./, (c) => c.toLowerCase())}`,
          h('b', null, ` ${withUnit(objective.name, last)}`),
        ),
        plot,
      );
    }),
  );
}

function chart(report, steps, k, px) {
  const name = report.problem.objectives[k].name;
  const [low, high] = extent(steps, (step) => step.best[k]);
  const spare = high > low ? 0.1 * (high - low) : Math.abs(high) * 0.1 || 1;
  const x = scaleLinear([0, report.run.evaluations], [kMargin.left, px - kMargin.right]);
  const y = scaleLinear([low - spare, high + spare], [kHeight - kMargin.bottom, kMargin.top]);
  const factor = measure(name).unit === '%' ? 100 : 1;
  const bottom = s('g', { class: 'axis', transform: `translate(0,${kHeight - kMargin.bottom})` });
  const left = s('g', { class: 'axis', transform: `translate(${kMargin.left},0)` });
  select(bottom).call(
    axisBottom(x)
      .ticks(Math.max(2, px / 90))
      .tickFormat(whole),
  );
  select(left).call(
    axisLeft(y)
      .ticks(4)
      .tickFormat((v) => (factor * v).toLocaleString('en-US', { maximumFractionDigits: 3 })),
  );
  let d = '';
  steps.forEach((step, i) => {
    d += i === 0 ? `M${x(step.evaluations)},${y(step.best[k])}` : `H${x(step.evaluations)}V${y(step.best[k])}`;
  });
  d += `H${x(report.run.evaluations)}`;
  return s(
    'svg',
    { viewBox: `0 0 ${px} ${kHeight}`, role: 'img', 'aria-label': `Best ${titled(name)} against evaluations` },
    bottom,
    left,
    s('path', { class: 'curve', d }),
    steps.length === 1
      ? s('circle', { class: 'here', cx: x(steps[0].evaluations), cy: y(steps[0].best[k]), r: 3 })
      : null,
  );
}
