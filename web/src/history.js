// The front's hypervolume and the best value of every objective against the evaluations spent.

import { extent } from 'd3-array';
import { axisBottom, axisLeft } from 'd3-axis';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { h, onWidth, s } from './dom.js';
import { measure, titled, whole, withUnit } from './format.js';

const kHeight = 150;
const kMargin = { left: 48, right: 26, top: 10, bottom: 24 };

// What is drawn: a value of every step, and of the compared run's steps.
const kVolume = {
  name: 'hypervolume',
  says: 'share of the box between the worst and the best values of the front that some design dominates',
  of: (step) => step.hypervolume,
};

export function history(report) {
  const steps = report.history.filter((step) => step.best.length > 0);
  if (steps.length === 0) {
    return h('p', { class: 'empty' }, 'No feasible design was found, so there is no course of best values.');
  }
  const curves = [
    ...(steps[0].hypervolume === undefined || steps[0].hypervolume === null ? [] : [kVolume]),
    ...report.problem.objectives.map((o, k) => ({
      name: o.name,
      says: measure(o.name).says,
      of: (step) => step.best[k],
    })),
  ];
  const others = (report.compared?.history ?? []).filter((step) => step.best.length > 0);
  const last = steps[steps.length - 1];
  return h(
    'div',
    null,
    h(
      'div',
      { class: 'charts', id: 'history' },
      curves.map((curve) => {
        const plot = h('div', { class: 'plot' });
        onWidth(
          plot,
          (px) => plot.replaceChildren(chart(report, steps, others, curve, px)),
          Math.min(3, curves.length),
        );
        return h(
          'figure',
          { title: curve.says },
          h(
            'figcaption',
            null,
            curve === kVolume
              ? 'Dominated hypervolume'
              : `Best ${titled(curve.name).replace(/^./, (c) => c.toLowerCase())}`,
            h('b', null, ` ${withUnit(curve.name, curve.of(last))}`),
          ),
          plot,
        );
      }),
    ),
    others.length > 0
      ? h('p', { class: 'small' }, `Dashed: ${report.compared.name}. Both hypervolumes are shares of one box.`)
      : null,
  );
}

function chart(report, steps, others, curve, px) {
  const { name } = curve;
  const [low, high] = extent([...steps, ...others], curve.of);
  const spare = high > low ? 0.1 * (high - low) : Math.abs(high) * 0.1 || 1;
  const until = Math.max(report.run.evaluations, ...others.map((step) => step.evaluations));
  const x = scaleLinear([0, until], [kMargin.left, px - kMargin.right]);
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
  const stairs = (list) =>
    list
      .map((step, i) => `${i === 0 ? 'M' : 'H'}${x(step.evaluations)}${i === 0 ? ',' : 'V'}${y(curve.of(step))}`)
      .join('');
  return s(
    'svg',
    { viewBox: `0 0 ${px} ${kHeight}`, role: 'img', 'aria-label': `${titled(name)} against evaluations` },
    bottom,
    left,
    others.length > 0 ? s('path', { class: 'curve other', d: stairs(others) }) : null,
    s('path', { class: 'curve', d: `${stairs(steps)}H${x(report.run.evaluations)}` }),
    steps.length === 1
      ? s('circle', { class: 'here', cx: x(steps[0].evaluations), cy: y(curve.of(steps[0])), r: 3 })
      : null,
  );
}
