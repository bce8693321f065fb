// The potential landscape: how low the part can be lowered from above, over where it is across gravity and how far it is
// turned. Colours say into which rest it sinks from there.

import { axisBottom, axisLeft } from 'd3-axis';
import { scaleLinear } from 'd3-scale';
import { select } from 'd3-selection';

import { contourPath, levels } from './contours.js';
import { freshId, h, onWidth, s } from './dom.js';
import { degrees, fixed, mm, short } from './format.js';
import { frameAround, gravityFrame, partLoops, sameTurns } from './nest_frame.js';
import { stillPicture } from './nest_picture.js';
import { cellsPicture } from './nest_cells.js';
import { kOfOutside, restColour, restName } from './nest_rests.js';

const kHeight = 440;
const kMargin = { left: 52, right: 14, top: 12, bottom: 42 };
const kBeside = 1.7; // of a paper's width, the picture of the part stands beside it
const kHidden_px = 17;

// Rests of an aspect as places of the map: all orientations that look the same.
function restMarks(nest, frame, aspect) {
  return nest.rests.flatMap((rest, index) =>
    rest.aspect !== aspect.name
      ? []
      : sameTurns(rest.orientation_deg, aspect.symmetry ?? 1).map((deg) => ({
          index,
          across: frame.across([rest.x_mm, rest.y_mm]),
          deg,
        })),
  );
}

const passWords = ({ lower_mm: low, upper_mm: high }) => (high === null ? `\u2265 ${fixed(low, 2)}` : fixed(high, 2));

// One aspect. chosen(index): a rest is picked. Answers {node, mark(index)}.
export function landscapeMap(land, nest, shapes, chosen) {
  const frame = gravityFrame(nest.gravity_deg);
  const aspect = nest.aspects.find(({ name }) => name === land.aspect);
  const [rows, columns] = [land.heights_mm.length, land.heights_mm[0].length];
  const step = { across: (land.across_mm[1] - land.across_mm[0]) / (columns - 1), deg: 360 / rows };
  const heights = land.heights_mm.flat().filter((v) => v !== null);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const contours = levels(low, high, 12);
  const marks = restMarks(nest, frame, aspect);
  const { seat } = nest;
  const zero = frame.height([seat.x_mm, seat.y_mm]);
  const around = frameAround(
    shapes,
    partLoops(nest, land.aspect),
    land.across_mm.flatMap((across) =>
      [low, high].flatMap((height) => [0, 90, 180, 270].map((deg) => [...frame.point(across, height + zero), deg])),
    ),
  );
  const passes = (nest.passes ?? []).filter((pass) => pass.aspect === land.aspect && (pass.x_mm ?? null) !== null);
  const wrapped = [...land.heights_mm, land.heights_mm[0]];
  const isHidden = (index) => (land.hidden ?? []).includes(index);
  const picture = cellsPicture(land, nest, low, high);
  let cursor = opening();
  let marked = -1;
  let redraw = () => {};

  const plot = h('div', { class: 'plot landscape' });
  const words = h('p', { class: 'small landscape-words', 'aria-live': 'polite' });
  const shown = h('div', { class: 'landscape-part' });

  onWidth(
    plot,
    (px) => {
      const x = scaleLinear(land.across_mm, [kMargin.left, px - kMargin.right]);
      const y = scaleLinear([0, 360], [kHeight - kMargin.bottom, kMargin.top]);
      const [bottom, left] = [
        s('g', { class: 'axis', transform: `translate(0,${kHeight - kMargin.bottom})` }),
        s('g', { class: 'axis', transform: `translate(${kMargin.left},0)` }),
      ];
      select(bottom).call(axisBottom(x).ticks(8));
      select(left).call(axisLeft(y).tickValues([0, 45, 90, 135, 180, 225, 270, 315, 360]));
      const clip = freshId('landscape');
      const [x0, x1, y0, y1] = [x(land.across_mm[0]), x(land.across_mm[1]), y(360), y(0)];
      const node = (row, column) => [x(land.across_mm[0] + column * step.across), y(row * step.deg)];
      const hand = s('g', { class: 'landscape-hand' });
      const svg = s(
        'svg',
        {
          viewBox: `0 0 ${px} ${kHeight}`,
          class: 'landscape-map',
          tabindex: 0,
          role: 'group',
          'aria-label': `Heights over placements, aspect ${land.aspect}; arrow keys move the placement that is shown`,
          onclick: (event) => {
            const area = svg.getBoundingClientRect();
            const scale = px / area.width;
            const column = (x.invert((event.clientX - area.left) * scale) - land.across_mm[0]) / step.across;
            place(atNode(column, y.invert((event.clientY - area.top) * scale) / step.deg));
          },
          onkeydown: onKey,
        },
        s('clipPath', { id: clip }, s('rect', { x: x0, y: y0, width: x1 - x0, height: y1 - y0 })),
        s('rect', { class: 'landscape-none', x: x0, y: y0, width: x1 - x0, height: y1 - y0 }),
        s(
          'g',
          { 'clip-path': `url(#${clip})` },
          // Cells are about their nodes: the picture reaches half a cell further on every side.
          s('image', {
            href: picture,
            x: x(land.across_mm[0] - step.across / 2),
            y: y(360 + step.deg / 2),
            width: x(step.across * columns) - x(0),
            height: y(0) - y(step.deg * (rows + 1)),
            preserveAspectRatio: 'none',
            class: 'landscape-cells',
          }),
          contours.list.map((level) =>
            s('path', {
              class: level === 0 ? 'contour seat-level' : 'contour',
              'data-level': short(level, 6),
              d: contourPath(wrapped, level, node),
            }),
          ),
        ),
        bottom,
        left,
        s(
          'text',
          { class: 'axis-title', x: (x0 + x1) / 2, y: kHeight - 6, 'text-anchor': 'middle' },
          'centre of mass across gravity (mm)',
        ),
        s(
          'text',
          { class: 'axis-title', 'text-anchor': 'middle', transform: `translate(13,${(y0 + y1) / 2}) rotate(-90)` },
          'orientation of the part (\u00b0)',
        ),
        passes.map((pass) => passMark(pass, x, y)),
        hand,
        marks.map((mark) => restMark(mark, x, y)),
      );
      redraw = () => {
        const [cx, cy] = [x(cursor.across), y(cursor.deg)];
        hand.replaceChildren(
          s('path', { class: 'halo', d: `M${cx - 9},${cy}h18M${cx},${cy - 9}v18` }),
          s('path', { class: 'cross', d: `M${cx - 9},${cy}h18M${cx},${cy - 9}v18` }),
        );
        for (const mark of svg.querySelectorAll('.rest-mark'))
          mark.classList.toggle('chosen', Number(mark.dataset.rest) === marked);
      };
      plot.replaceChildren(svg);
      redraw();
    },
    kBeside,
  );

  function restMark(mark, x, y) {
    const { index, across, deg } = mark;
    if (across < land.across_mm[0] || across > land.across_mm[1]) return null;
    return s(
      'g',
      {
        class: `rest-mark${nest.rests[index].is_seat ? ' seat' : ''}${isHidden(index) ? ' hidden' : ''}`,
        'data-rest': index,
        transform: `translate(${x(across)},${y(deg)})`,
        role: 'button',
        tabindex: 0,
        'aria-label': `${restName(nest, index)} at ${degrees(deg)}`,
        onclick: (event) => {
          event.stopPropagation();
          go(mark);
        },
        onkeydown: (event) => {
          if (event.key !== 'Enter' && event.key !== ' ') return;
          event.preventDefault();
          event.stopPropagation();
          go(mark);
        },
      },
      s('title', null, restName(nest, index)),
      s('circle', { r: 9, style: `fill: ${restColour(nest, index)}` }),
      s('text', { y: 4, 'text-anchor': 'middle' }, String(index + 1)),
    );
  }

  // Beside the rest that it would be hidden under.
  function passMark(pass, x, y) {
    const across = frame.across([pass.x_mm, pass.y_mm]);
    const deg = ((pass.orientation_deg % 360) + 360) % 360;
    if (across < land.across_mm[0] || across > land.across_mm[1]) return null;
    const at = (mark) => [x(mark.across), y(mark.deg)];
    const over = marks.find((m) => Math.hypot(at(m)[0] - x(across), at(m)[1] - y(deg)) < kHidden_px);
    const [cx, cy] = over ? [at(over)[0] + kHidden_px, at(over)[1]] : [x(across), y(deg)];
    // Its words go where they hide no rest.
    const wide = 7 * passWords(pass).length;
    const places = [
      [cx + 9, cy + 4],
      [cx - 9 - wide, cy + 4],
      [cx - wide / 2, cy - 9],
      [cx - wide / 2, cy + 19],
    ];
    const [left, base] =
      places.find(
        ([px, py]) =>
          px + wide < x.range()[1] &&
          marks.every((m) => at(m)[0] + 9 < px || at(m)[0] - 9 > px + wide || Math.abs(at(m)[1] - py + 4) > 15),
      ) ?? places[2];
    return s(
      'g',
      { class: 'pass', 'data-first': pass.first, 'data-second': pass.second },
      s(
        'title',
        null,
        `${restName(nest, pass.first)} to ${restName(nest, pass.second)}: height ${passWords(pass)} mm over the seat`,
      ),
      s('path', { d: `M${cx},${cy - 6}L${cx + 6},${cy}L${cx},${cy + 6}L${cx - 6},${cy}Z` }),
      s('text', { x: left, y: base }, passWords(pass)),
    );
  }

  function go(mark) {
    place(atRest(mark));
    chosen(mark.index);
  }

  // The placement that is shown: a node of the grid, or a rest itself.
  function atRest({ index, across, deg }) {
    return { across, deg, height: nest.rests[index].height_mm, basin: index, rest: index };
  }

  function atNode(column, row) {
    const c = Math.max(0, Math.min(columns - 1, Math.round(column)));
    const r = ((Math.round(row) % rows) + rows) % rows;
    return {
      across: land.across_mm[0] + c * step.across,
      deg: r * step.deg,
      height: land.heights_mm[r][c],
      basin: land.basin[r][c],
    };
  }

  function opening() {
    const seat = marks.find(({ index }) => nest.rests[index].is_seat) ?? marks[0];
    return seat ? atRest(seat) : atNode(columns / 2, 0);
  }

  function place(where) {
    cursor = where;
    redraw();
    const { across, deg, height, basin, rest = -1 } = cursor;
    const named = `${short(across, 2)} mm across, turned ${degrees(deg)}`;
    if (height === null) {
      words.textContent = `${named}: nothing is below the part.`;
      shown.replaceChildren(h('p', { class: 'empty' }, 'Nothing is below the part here.'));
      return;
    }
    const downhill =
      basin < 0 ? 'downhill from there lies none of the rests' : `downhill from there lies ${restName(nest, basin)}`;
    words.textContent =
      rest >= 0
        ? `${named}: ${restName(nest, rest)}, ${mm(height, 2)} over the seat${isHidden(rest) ? '; under an overhang, so a part that is lowered from above does not get there' : ''}.`
        : `${named}: the part first touches at ${mm(height, 2)} over the seat; ${downhill}.`;
    const [px, py] = frame.point(across, height + zero);
    shown.replaceChildren(
      stillPicture(nest, shapes, land.aspect, [{ q: [px, py, deg], cls: 'part' }], {
        tall: 330,
        frame: around,
        columns: 2,
        label:
          rest >= 0 ? `The part in ${restName(nest, rest)}` : 'The part where it first touches, lowered from above',
        scaled: true,
      }),
    );
  }

  function onKey(event) {
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!way) return;
    event.preventDefault();
    const [column, row] = [(cursor.across - land.across_mm[0]) / step.across, cursor.deg / step.deg];
    place(atNode(column + way[0], row + way[1]));
  }

  place(cursor);
  const basins = [...new Set(land.basin.flat())].filter((basin) => basin >= 0).sort((a, b) => a - b);
  const node = h(
    'figure',
    { class: 'landscape-figure', 'data-aspect': land.aspect },
    nest.aspects.length > 1 ? h('h4', null, `Aspect \u201c${land.aspect}\u201d`) : null,
    h('div', { class: 'landscape-views' }, plot, shown),
    words,
    passList(nest, land),
    h(
      'p',
      { class: 'legend' },
      basins.map((index) =>
        h(
          'span',
          { 'data-basin': index },
          h(
            'i',
            { class: 'rest-number', style: `--of: ${restColour(nest, index)}`, 'aria-hidden': 'true' },
            String(index + 1),
          ),
          `sinks into ${restName(nest, index)}`,
        ),
      ),
      marks.some(({ index }) => isHidden(index))
        ? h('span', null, h('i', { class: 'key hidden-key', 'aria-hidden': 'true' }), 'rest under an overhang')
        : null,
      land.basin.flat().includes(-1)
        ? h(
            'span',
            null,
            h('i', { class: 'key', style: `background: ${kOfOutside}`, 'aria-hidden': 'true' }),
            'into none of them',
          )
        : null,
      h('span', null, h('i', { class: 'key pass-key', 'aria-hidden': 'true' }), 'lowest pass, with its height (mm)'),
      h(
        'span',
        null,
        h('i', { class: 'key contour-key', 'aria-hidden': 'true' }),
        `height, every ${short(contours.step)} mm; darker is lower`,
      ),
      heights.length < rows * columns
        ? h('span', null, h('i', { class: 'key none-key', 'aria-hidden': 'true' }), 'nothing below')
        : null,
    ),
  );
  return {
    node,
    mark(index) {
      marked = index;
      redraw();
    },
  };
}

// In words, too: some passes lie beside the map.
function passList(nest, land) {
  const passes = (nest.passes ?? []).filter((pass) => pass.aspect === land.aspect);
  if (!passes.length) return null;
  const one = (pass) =>
    `${restName(nest, pass.first)} to ${restName(nest, pass.second)} at ${passWords(pass)} mm`.replaceAll(
      ', the seat',
      ' (the seat)',
    );
  return h(
    'p',
    { class: 'small pass-list' },
    `Passes, lowest first, heights over the seat; a group of rests has the name of its lowest: ${passes.map(one).join('; ')}.`,
  );
}
