// The scatter of evaluated designs: choose axes, brush, click a design of the front.

import { extent } from 'd3-array';
import { axisBottom, axisLeft } from 'd3-axis';
import { brush } from 'd3-brush';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { h, onWidth, s } from './dom.js';
import { bare, counted, designsEvaluated, measure, titled, whole, withUnit } from './format.js';
import { markShape, topologiesShown, topologyKey } from './topology_colours.js';

const kHeight = 400;
const kClear = 0.05; // of the larger value: what the eye tells apart
const kMargin = { left: 66, right: 18, top: 18, bottom: 52 };

// What can be an axis; violation only where something is infeasible.
export function axisNames(report) {
  const names = report.problem.objectives.map((o) => o.name);
  if (report.run.feasible < designsEvaluated(report)) names.push('violation');
  return [...names, 'number'];
}

// Of infeasible runs the violation and an objective. Else two objectives in which the front's designs differ clearly, else
// a little, else all evaluations do; with fewer, the run's course.
export function startingAxes(report) {
  const names = report.problem.objectives.map((o) => o.name);
  const varies = (rows, least = 0) =>
    names.filter((_, k) => {
      const [low, high] = extent(rows, (r) => r[k]);
      return high - low > least * Math.max(Math.abs(low), Math.abs(high));
    });
  const chosen = [
    ...new Set([
      ...varies(
        report.designs.map((d) => d.objectives),
        kClear,
      ),
      ...varies(report.designs.map((d) => d.objectives)),
      ...varies(report.sample.map((r) => r[4])),
    ]),
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

// The same at the worst of the uncertain values; what is no objective does not change.
function worstOf(report, axis) {
  const k = report.problem.objectives.findIndex((o) => o.name === axis);
  return k < 0 ? valueOf(report, axis) : (d) => d.worst[k];
}

export function pareto(report, state) {
  const topologies = topologiesShown(report);
  const looks = new Map(topologies.map((t) => [t.topology, t]));
  const hiddenTopologies = new Set();
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
  const showInfeasible = toggle('show-infeasible', report.run.feasible < designsEvaluated(report));
  const showDominated = toggle('show-dominated', true);
  const showWorst = toggle('show-worst', true);
  const showOther = toggle('show-other', true);
  const hasWorst = report.designs.some((d) => d.worst);
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
    const visible = report.designs.filter((d) => !hiddenTopologies.has(d.topology));
    const banded = hasWorst && showWorst.checked ? visible.filter((d) => d.worst) : [];
    const [worstX, worstY] = [worstOf(report, axisX.value), worstOf(report, axisY.value)];
    const others =
      report.compared && showOther.checked && axisX.value !== 'number' && axisY.value !== 'number'
        ? report.compared.designs
        : [];
    const extra = (of, worst) => [...banded.map(worst), ...others.map(of)];
    const scaleX = scaleOf(
      [...[...shown, ...report.designs].map(x), ...extra(x, worstX)],
      [kMargin.left, px - kMargin.right],
    );
    const scaleY = scaleOf(
      [...[...shown, ...report.designs].map(y), ...extra(y, worstY)],
      [kHeight - kMargin.bottom, kMargin.top],
    );
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
    const bands = s('g', { class: 'bands' });
    for (const d of banded) bands.append(band(d, [scaleX(x(d)), scaleY(y(d))], [scaleX(worstX(d)), scaleY(worstY(d))]));
    const rivals = s('g', { class: 'rivals' });
    for (const d of others) rivals.append(rival(d, scaleX(x(d)), scaleY(y(d))));
    for (const design of visible) marks.append(mark(design, scaleX(x(design)), scaleY(y(design))));
    svg.append(cloud, bands, rivals, overlay, marks);
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

  // From the nominal values to those at the worst case.
  function band(design, [x0, y0], [x1, y1]) {
    return s(
      'g',
      { class: 'band', 'data-id': design.id, style: `color:${looks.get(design.topology).colour}` },
      s('rect', { x: Math.min(x0, x1), y: Math.min(y0, y1), width: Math.abs(x1 - x0), height: Math.abs(y1 - y0) }),
      s('path', { d: `M${x0},${y0}L${x1},${y1}` }),
      s('path', { class: 'end', d: `M${x1 - 3},${y1}h6M${x1},${y1 - 3}v6` }),
    );
  }

  function rival(design, cx, cy) {
    return s(
      'rect',
      { class: 'rival', x: cx - 4, y: cy - 4, width: 8, height: 8 },
      s('title', null, `${report.compared.name}: ${design.id} ${design.label}`),
    );
  }

  function mark(design, cx, cy) {
    const knee = design.id === report.knee?.id;
    const r = 5.5;
    const shape = !design.feasible
      ? s('path', { d: `M${cx},${cy - r}l${r},${1.8 * r}h${-2 * r}z` })
      : knee
        ? s('path', { d: `M${cx},${cy - r - 3}l${r + 3},${r + 3}l${-r - 3},${r + 3}l${-r - 3},${-r - 3}z` })
        : markShape(looks.get(design.topology).shape, cx, cy, r, looks.get(design.topology).colour);
    if (knee && design.feasible) shape.setAttribute('fill', looks.get(design.topology).colour);
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
      design.worst
        ? h(
            'div',
            { class: 'small' },
            `at worst: ${report.problem.objectives.map((o, k) => withUnit(o.name, design.worst[k])).join(', ')}`,
          )
        : '',
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

  // Which topology has which mark; a click hides its designs.
  function topologyLegend() {
    return h(
      'div',
      { class: 'legend', id: 'topologies' },
      topologies.map((t) =>
        h(
          'label',
          { 'data-topology': t.topology },
          h('input', {
            type: 'checkbox',
            checked: true,
            onchange: ({ target }) => {
              if (target.checked) hiddenTopologies.delete(t.topology);
              else hiddenTopologies.add(t.topology);
              draw();
            },
          }),
          topologyKey(t),
          `${t.label} (${whole(t.count)})`,
        ),
      ),
    );
  }

  const anyInfeasible = report.run.feasible < designsEvaluated(report);
  return h(
    'div',
    null,
    h('div', { class: 'controls' }, h('label', null, 'Across ', axisX), h('label', null, 'Up ', axisY), clear),
    frame,
    topologies.length > 1 ? topologyLegend() : null,
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
      hasWorst
        ? h(
            'label',
            { title: 'from the nominal values to those at the worst of the uncertain values' },
            showWorst,
            h('i', { class: 'key band' }),
            'worst case',
          )
        : null,
      report.compared
        ? h('label', null, showOther, h('i', { class: 'key rival' }), `compared: ${report.compared.name}`)
        : null,
      h(
        'span',
        { class: 'faint' },
        sample.length + report.designs.length < designsEvaluated(report)
          ? `${counted(sample.length, 'other evaluation', 'others')} shown, a sample of ${whole(designsEvaluated(report))}`
          : `all ${whole(designsEvaluated(report))} evaluations shown`,
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
