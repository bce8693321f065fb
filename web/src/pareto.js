// The scatter of evaluated designs: choose axes, brush, click a design of the front.

import { extent } from 'd3-array';
import { axisBottom, axisLeft } from 'd3-axis';
import { brush } from 'd3-brush';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { h, onWidth, s } from './dom.js';
import { bare, counted, measure, titled, whole, withUnit } from './format.js';

const kHeight = 400;
const kMargin = { left: 66, right: 18, top: 18, bottom: 52 };

// What can be an axis; violation only where something is infeasible.
export function axisNames(report) {
  const names = report.problem.objectives.map((o) => o.name);
  if (report.run.feasible < report.run.evaluations) names.push('violation');
  return [...names, 'number'];
}

// Of infeasible runs the violation and an objective. Else two objectives in which the front's designs differ, else all evaluations do; with fewer, the run's course.
export function startingAxes(report) {
  const names = report.problem.objectives.map((o) => o.name);
  const varies = (rows) => names.filter((_, k) => new Set(rows.map((r) => r[k])).size > 1);
  const chosen = [
    ...new Set([...varies(report.designs.map((d) => d.objectives)), ...varies(report.sample.map((r) => r[4]))]),
  ];
  if (report.run.feasible === 0 && report.sample.length > 1) return [chosen[0] ?? names[0], 'violation'];
  if (chosen.length > 1) return chosen.slice(0, 2);
  return ['number', chosen[0] ?? names[0]];
}

function valueOf(report, axis) {
  if (axis === 'number') return (p) => p.number;
  if (axis === 'violation') return (p) => p.violation;
  const k = report.problem.objectives.findIndex((o) => o.name === axis);
  return (p) => p.objectives[k];
}

export function pareto(report, state) {
  const front = new Set(report.designs.map((d) => d.number));
  const sample = report.sample
    .map(([number, topology, feasible, violation, objectives]) => ({
      number,
      topology,
      feasible: feasible === 1,
      violation,
      objectives,
    }))
    .filter((p) => !front.has(p.number));
  const names = axisNames(report);
  const [firstX, firstY] = startingAxes(report);
  const chooser = (id, chosen) =>
    h(
      'select',
      { id, onchange: () => draw() },
      names.map((n) => h('option', { value: n, selected: n === chosen }, titled(n))),
    );
  const axisX = chooser('axis-x', firstX);
  const axisY = chooser('axis-y', firstY);
  const toggle = (id, on) => h('input', { type: 'checkbox', id, checked: on, onchange: () => draw() });
  const showInfeasible = toggle('show-infeasible', report.run.feasible < report.run.evaluations);
  const showDominated = toggle('show-dominated', true);
  const clear = h(
    'button',
    {
      type: 'button',
      id: 'clear-brush',
      onclick: () => {
        state.set('brushed', null);
        draw();
      },
    },
    'Clear brush',
  );
  const plot = h('div', { class: 'plot', id: 'pareto' });
  const tip = h('div', { class: 'tip', hidden: true });
  const frame = h('div', { class: 'plot-frame' }, plot, tip);
  let px = 0;

  function draw() {
    if (!px) return;
    state.set('brushed', null);
    const [x, y] = [valueOf(report, axisX.value), valueOf(report, axisY.value)];
    const shown = sample.filter((p) => (p.feasible ? showDominated.checked : showInfeasible.checked));
    const scaleX = scaleOf([...shown, ...report.designs].map(x), [kMargin.left, px - kMargin.right]);
    const scaleY = scaleOf([...shown, ...report.designs].map(y), [kHeight - kMargin.bottom, kMargin.top]);
    const svg = s('svg', {
      viewBox: `0 0 ${px} ${kHeight}`,
      role: 'img',
      'aria-label': `Designs by ${titled(axisX.value)} and ${titled(axisY.value)}`,
    });
    svg.append(axes(scaleX, scaleY, px));
    const cloud = s('g', { class: 'cloud' });
    for (const p of [...shown].sort((a, b) => Number(a.feasible) - Number(b.feasible))) {
      const [cx, cy] = [scaleX(x(p)), scaleY(y(p))];
      cloud.append(
        p.feasible
          ? s('circle', { class: 'dominated', cx, cy, r: 2.4 })
          : s('path', { class: 'infeasible', d: `M${cx - 2},${cy - 2}l4,4m0,-4l-4,4` }),
      );
    }
    const overlay = s('g', { class: 'brush' });
    const marks = s('g', { class: 'marks' });
    for (const design of report.designs) marks.append(mark(design, scaleX(x(design)), scaleY(y(design))));
    svg.append(cloud, overlay, marks);
    plot.replaceChildren(svg);
    select(overlay).call(
      brush()
        .extent([
          [kMargin.left, kMargin.top],
          [px - kMargin.right, kHeight - kMargin.bottom],
        ])
        .on('brush end', ({ selection }) => {
          if (!selection) return state.set('brushed', null);
          const [[x0, y0], [x1, y1]] = selection;
          const inside = report.designs.filter((d) => {
            const [cx, cy] = [scaleX(x(d)), scaleY(y(d))];
            return x0 <= cx && cx <= x1 && y0 <= cy && cy <= y1;
          });
          state.set('brushed', new Set(inside.map((d) => d.id)));
        }),
    );
    refresh();
  }

  function axes(scaleX, scaleY, width) {
    const bottom = s('g', { class: 'axis', transform: `translate(0,${kHeight - kMargin.bottom})` });
    const left = s('g', { class: 'axis', transform: `translate(${kMargin.left},0)` });
    select(bottom).call(
      axisBottom(scaleX)
        .ticks(Math.max(3, width / 110))
        .tickFormat(ticks(axisX.value))
        .tickSize(-(kHeight - kMargin.top - kMargin.bottom)),
    );
    select(left).call(
      axisLeft(scaleY)
        .ticks(6)
        .tickFormat(ticks(axisY.value))
        .tickSize(-(width - kMargin.left - kMargin.right)),
    );
    const middle = (kMargin.top + kHeight - kMargin.bottom) / 2;
    return s(
      'g',
      null,
      bottom,
      left,
      s(
        'text',
        {
          class: 'axis-title',
          x: (kMargin.left + width - kMargin.right) / 2,
          y: kHeight - 10,
          'text-anchor': 'middle',
        },
        axisTitle(report, axisX.value, ['\u2192', '\u2190']),
      ),
      s(
        'text',
        { class: 'axis-title', x: 16, y: middle, 'text-anchor': 'middle', transform: `rotate(-90 16 ${middle})` },
        axisTitle(report, axisY.value, ['\u2192', '\u2190']),
      ),
    );
  }

  function mark(design, cx, cy) {
    const knee = design.id === report.knee?.id;
    const r = 5.5;
    const shape = !design.feasible
      ? s('path', { d: `M${cx},${cy - r}l${r},${1.8 * r}h${-2 * r}z` })
      : knee
        ? s('path', { d: `M${cx},${cy - r - 3}l${r + 3},${r + 3}l${-r - 3},${r + 3}l${-r - 3},${-r - 3}z` })
        : s('circle', { cx, cy, r });
    const group = s(
      'g',
      {
        class: `mark${design.feasible ? '' : ' infeasible'}${knee ? ' knee' : ''}`,
        'data-id': design.id,
        onclick: () => state.set('design', design.id),
        onmouseenter: () => showTip(design, cx, cy),
        onmouseleave: () => {
          tip.hidden = true;
        },
      },
      shape,
      knee ? s('text', { x: cx + 12, y: cy - 8 }, 'knee') : null,
    );
    group.dataset.cx = cx;
    group.dataset.cy = cy;
    return group;
  }

  function showTip(design, cx, cy) {
    tip.replaceChildren(
      h('strong', null, design.id),
      ` ${design.label}`,
      ...report.problem.objectives.map((o, k) =>
        h('div', null, `${measure(o.name).title}: ${withUnit(o.name, design.objectives[k])}`),
      ),
      design.feasible ? '' : h('div', null, `violation ${bare('violation', design.violation)}`),
      design.id === report.knee?.id ? h('div', { class: 'small' }, `knee: ${report.knee.how}`) : '',
    );
    tip.hidden = false;
    const beside = cx > px / 2 ? cx - tip.offsetWidth - 14 : cx + 14;
    tip.style.left = `${Math.max(0, beside)}px`;
    tip.style.top = `${Math.max(0, Math.min(kHeight - tip.offsetHeight, cy - 20))}px`;
  }

  // Selection and brush change classes only.
  function refresh() {
    const brushed = state.get('brushed');
    for (const node of plot.querySelectorAll('.mark')) {
      node.classList.toggle('selected', node.dataset.id === state.get('design'));
      node.classList.toggle('aside', brushed !== null && !brushed.has(node.dataset.id));
    }
    const chosen = plot.querySelector('.mark.selected');
    if (chosen) chosen.parentNode.append(chosen);
    clear.disabled = brushed === null;
  }

  state.on('design', refresh);
  state.on('brushed', refresh);
  onWidth(plot, (width) => {
    px = width;
    draw();
  });

  const anyInfeasible = report.run.feasible < report.run.evaluations;
  return h(
    'div',
    null,
    h('div', { class: 'controls' }, h('label', null, 'Across ', axisX), h('label', null, 'Up ', axisY), clear),
    frame,
    h(
      'div',
      { class: 'legend' },
      report.run.feasible > 0
        ? [
            h('span', null, h('i', { class: 'key front' }), 'non-dominated'),
            report.knee ? h('span', { title: report.knee.how }, h('i', { class: 'key knee' }), 'knee') : null,
            h('label', null, showDominated, h('i', { class: 'key dominated' }), 'dominated'),
          ]
        : h('span', null, h('i', { class: 'key nearest' }), 'nearest to feasible'),
      anyInfeasible ? h('label', null, showInfeasible, h('i', { class: 'key infeasible' }), 'infeasible') : null,
      h(
        'span',
        { class: 'faint' },
        sample.length + report.designs.length < report.run.evaluations
          ? `${counted(sample.length, 'other evaluation', 'others')} shown, a sample of ${whole(report.run.evaluations)}`
          : `all ${whole(report.run.evaluations)} evaluations shown`,
      ),
    ),
  );
}

function scaleOf(values, range) {
  const [low, high] = extent(values);
  if (low === undefined) return scaleLinear([0, 1], range);
  const spare = high > low ? 0.05 * (high - low) : Math.abs(high) * 0.1 || 1;
  return scaleLinear([low - spare, high + spare], range);
}

const ticks = (name) => (value) => {
  const percent = measure(name).unit === '%';
  return (percent ? 100 * value : value).toLocaleString('en-US', { maximumFractionDigits: 3 }).replace('-', '\u2212');
};

function axisTitle(report, name, [more, less]) {
  const objective = report.problem.objectives.find((o) => o.name === name);
  if (!objective) return titled(name);
  return `${titled(name)}  \u00b7  ${objective.maximise ? `better ${more}` : `${less} better`}`;
}
