// The front as a table: sort by any measure, choose a row with mouse or keyboard.

import { h } from './dom.js';
import { bare, counted, kWeak_mm, measure, whole } from './format.js';
import { kindOf } from './kinds.js';
import { topologiesShown, topologyKey } from './topology_colours.js';
import { stampSign } from './stamp.js';

function columnsOf(report) {
  const objectives = report.problem.objectives.map((o) => o.name);
  const { columns: own, columnsOfInfeasible = own } = kindOf(report);
  const others = report.run.feasible > 0 ? own : columnsOfInfeasible;
  const rest = others.filter((n) => !objectives.includes(n));
  const measures = [...objectives, ...rest];
  const columns = measures.map((name) => ({ name, objective: objectives.includes(name), of: (d) => d.metrics[name] }));
  if (report.run.feasible === 0) columns.unshift({ name: 'violation', objective: true, of: (d) => d.violation });
  return columns;
}

export function designsTable(report, state) {
  const columns = columnsOf(report);
  const topologies = topologiesShown(report);
  const several = topologies.length > 1;
  const first = columns[0];
  const objective = report.problem.objectives.find((o) => o.name === first.name);
  let sort = { by: first.name, of: first.of, down: objective ? objective.maximise : false };

  const rows = new Map(report.designs.map((design) => [design.id, rowOf(design)]));
  const body = h('tbody');
  const heads = columns.map((c) => ({
    column: c,
    node: head(c.name, `${measure(c.name).title}`, measure(c.name).unit, c.of, measure(c.name).says),
  }));
  const idHead = {
    column: { name: 'id' },
    node: head('id', 'Design', '', (d) => d.number, 'the number of its evaluation'),
  };
  const status = h('p', { class: 'small', id: 'table-status', role: 'status' });

  function head(name, title, unit, of, says) {
    const cell = h(
      'th',
      { scope: 'col', class: name === 'id' ? null : 'num' },
      h(
        'button',
        {
          type: 'button',
          title: says,
          'data-sort': name,
          onclick: () => {
            sort = {
              by: name,
              of,
              down:
                sort.by === name
                  ? !sort.down
                  : name !== 'id' && !(report.problem.objectives.find((o) => o.name === name)?.maximise === false),
            };
            arrange();
          },
        },
        title,
        unit ? h('span', { class: 'unit' }, ` ${unit}`) : null,
        h('span', { class: 'arrow', 'aria-hidden': 'true' }),
      ),
    );
    return cell;
  }

  function rowOf(design) {
    const knee = design.id === report.knee?.id;
    const row = h(
      'tr',
      {
        'data-id': design.id,
        onclick: () => state.set('design', design.id),
        onkeydown: (event) => onKey(event, design.id),
      },
      h(
        'th',
        { scope: 'row' },
        design.id,
        knee ? h('span', { class: 'tag', title: report.knee.how }, 'knee') : null,
        stampSign(design),
        several
          ? h(
              'span',
              { class: 'label' },
              topologyKey(topologies.find((t) => t.topology === design.topology)),
              design.label,
            )
          : null,
      ),
      columns.map((c) =>
        h(
          'td',
          { class: c.objective ? 'num objective' : 'num' },
          weak(c.name, c.of(design)),
          bare(c.name, c.of(design)),
          atWorst(c.name, c.of(design), design.worst_case),
        ),
      ),
    );
    return row;
  }

  function weak(name, value) {
    if (name !== 'tolerance_mm' || value === null || value >= kWeak_mm) return null;
    return h('span', { class: 'weak', title: `below ${kWeak_mm} mm: means little under vibration` }, '\u26a0 ');
  }

  function atWorst(name, nominal, worst) {
    if (!worst || worst[name] === undefined || worst[name] === null || worst[name] === nominal) return null;
    return h(
      'span',
      { class: 'worst', title: 'at the worst of the uncertain values' },
      ` / ${bare(name, worst[name])}`,
    );
  }

  function onKey(event, id) {
    if (event.key === 'Enter' || event.key === ' ') {
      event.preventDefault();
      state.set('design', id);
    }
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const list = [...body.children];
    const next = list[list.indexOf(rows.get(id)) + step];
    if (next) {
      next.focus();
      state.set('design', next.dataset.id);
    }
  }

  function arrange() {
    const brushed = state.get('brushed');
    const shown = report.designs.filter((d) => brushed === null || brushed.has(d.id));
    const sign = sort.down ? -1 : 1;
    shown.sort((a, b) => {
      const [va, vb] = [sort.of(a), sort.of(b)];
      if (va === null || vb === null) return Number(va === null) - Number(vb === null) || a.number - b.number;
      return sign * (va - vb) || a.number - b.number;
    });
    body.replaceChildren(...shown.map((d) => rows.get(d.id)));
    for (const { column, node } of [idHead, ...heads]) {
      const active = column.name === sort.by;
      node.setAttribute('aria-sort', active ? (sort.down ? 'descending' : 'ascending') : 'none');
      node.querySelector('.arrow').textContent = active ? (sort.down ? ' \u25bc' : ' \u25b2') : '';
    }
    status.textContent =
      brushed === null
        ? counted(report.designs.length, 'design', 'designs')
        : `${whole(shown.length)} of ${counted(report.designs.length, 'design', 'designs')} inside the brush`;
    refresh();
  }

  // One row at a time is in the tab order; the arrows move between them.
  function refresh() {
    const chosen = state.get('design');
    let reachable = false;
    for (const row of body.children) {
      const selected = row.dataset.id === chosen;
      row.setAttribute('aria-selected', String(selected));
      row.tabIndex = selected ? 0 : -1;
      reachable ||= selected;
    }
    if (!reachable && body.firstElementChild) body.firstElementChild.tabIndex = 0;
  }

  state.on('design', refresh);
  state.on('brushed', arrange);
  arrange();
  return h(
    'div',
    { class: 'table-box' },
    status,
    h(
      'div',
      { class: 'scroll', tabindex: -1 },
      h(
        'table',
        { class: 'designs', id: 'designs-table', role: 'grid' },
        h(
          'thead',
          null,
          h(
            'tr',
            null,
            idHead.node,
            heads.map((x) => x.node),
          ),
        ),
        body,
      ),
    ),
  );
}
