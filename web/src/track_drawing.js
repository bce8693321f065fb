// The chosen design's track, to scale and dimensioned.

import { h, onWidth, s } from './dom.js';
import { across, chain, chainAbove } from './dimensions.js';
import { fixed, short } from './format.js';
import { boxOf } from './geometry.js';
import { dimensionOf, drawObstacles, drawTrack, isBlade, makeView, openings, scaleBar } from './scene.js';

const kSame_mm = 5e-3;
const kMostLabelled = 12; // corners of a cut-out that are numbered
const kMostHeights = 5; // of corners, dimensioned at the side; the table has them all
const kMostTall = 420; // px, so that a short track does not fill the page

const number = (v) => fixed(v, 2);

// Corners of a cut-out as designed, in the track's coordinates; of other features none.
export function cornersOf(feature, start) {
  return (feature.polygon_mm ?? feature.profile_mm ?? []).map(([x, y]) => [x + start, y]);
}

function extentOf(feature) {
  const box = boxOf(feature.voids.map((v) => v.outer_mm));
  return feature.voids.length ? [box.xMin, box.xMax] : [feature.start_mm, feature.end_mm];
}

function distinct(values) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted.filter((v, i) => i === 0 || v - sorted[i - 1] > kSame_mm);
}

export function trackDrawing(design, width) {
  const box = h('div', { class: 'drawing', id: 'drawing' });
  onWidth(box, (px) => box.replaceChildren(picture(design, width, px)));
  return box;
}

function picture(design, width, px) {
  const extents = design.track.map(extentOf);
  const xMin = Math.min(0, ...extents.map((e) => e[0]));
  const xMax = Math.max(extents.length ? 0 : 50, ...extents.map((e) => e[1]));
  const pad = Math.max(8, Math.min(25, 0.12 * (xMax - xMin)));
  const [from, to] = [xMin - pad, xMax + pad];
  // Where cut-outs cross the free edge: dimensioned there unless the chain below has the same places.
  const ends = distinct(openings(design.track, width).flat());
  const xs = distinct([0, ...extents.flat()]);
  const above = ends.some((x) => !xs.some((other) => Math.abs(other - x) <= kSame_mm));
  const heights = cornerHeights(design, width);
  const [left, right] = [heights.length ? 96 : 58, 16];
  const scale = Math.min((px - left - right) / (to - from), kMostTall / width);
  const inset = left + Math.max(0, (px - left - right - scale * (to - from)) / 2);
  const labels = placedLabels(design, extents, (x) => inset + (x - from) * scale, px);
  const rows = 1 + Math.max(0, ...labels.map((l) => l.row));
  const bottom = 14 * rows + 8;
  const top = bottom + (above ? 44 : 6);
  const view = makeView(from, width, scale, inset, top);
  const floor = view.y(0);
  const height = floor + (xs.length > 2 ? 116 : 82);
  const svg = s('svg', {
    viewBox: `0 0 ${px} ${height}`,
    role: 'img',
    class: 'plan',
    'aria-label': `Track of design ${design.id} seen from above, to scale, dimensions in mm`,
  });
  svg.append(drawTrack(design.track, width, from, to, view).group);
  if (design.turning) svg.append(drawObstacles(design.turning.obstacles, view));
  svg.append(across(0, width, view, view.x(from) - (heights.length ? 54 : 16), number(width), -1));
  svg.append(...ordinates(heights, from, view));
  design.track.forEach((feature, i) => {
    svg.append(label(labels[i], bottom));
    svg.append(...crossings(feature, extents[i], width, view));
    const corners = cornersOf(design.features[i], feature.start_mm);
    if (corners.length && corners.length <= kMostLabelled) svg.append(numbered(corners, width, view));
  });
  if (above) {
    const first = ends[0] > xs[0] + kSame_mm ? [xs[0], ...ends] : ends;
    svg.append(chainAbove(first, view, view.y(width) - 8, view.y(width) - 24, number));
  }
  if (xs.length > 1) svg.append(chain(xs, view, floor + 12, floor + 36, number));
  if (xs.length > 2) svg.append(chain([xs[0], xs[xs.length - 1]], view, floor + 36, floor + 84, number));
  if (from < 0 && to > 0) {
    svg.append(
      s(
        'g',
        { class: 'datum' },
        s('path', { d: `M${view.x(0)},${floor + 12}v8l-4,7h8l-4,-7` }),
        s('text', { x: view.x(0) - 7, y: floor + 25, 'text-anchor': 'end' }, 'x = 0'),
      ),
    );
  }
  svg.append(
    s('text', { class: 'note', x: view.x(from) + 2, y: view.y(width) + 14 }, 'free edge'),
    s('path', { class: 'feed', d: `M${inset},${height - 14}h34m-7,-4l7,4l-7,4` }),
    s('text', { class: 'note', x: inset + 42, y: height - 10 }, 'feed'),
    scaleBar(view, inset + 96, height - 12),
  );
  return svg;
}

// Corners of cut-outs within the plate, one a height: [x, y] of the one nearest to the drawing's left end.
function cornerHeights(design, width) {
  const corners = design.track
    .flatMap((feature, i) => cornersOf(design.features[i], feature.start_mm))
    .filter(([, y]) => y > kSame_mm && y < width - kSame_mm)
    .sort((a, b) => a[1] - b[1] || a[0] - b[0]);
  const distinctOnes = corners.filter((p, i) => i === 0 || p[1] - corners[i - 1][1] > kSame_mm);
  const close = distinctOnes.some((p, i) => p[1] - (i === 0 ? 0 : distinctOnes[i - 1][1]) < width / 25);
  return distinctOnes.length <= kMostHeights && !close ? distinctOnes : [];
}

// Their heights over the wall, left of the plate, each from the one below.
function ordinates(corners, from, view) {
  const x = view.x(from) - 16;
  return corners.flatMap((corner, i) => {
    const below = i === 0 ? 0 : corners[i - 1][1];
    return [
      s('path', { class: 'lead', d: `M${view.x(corner[0])},${view.y(corner[1])}H${x - 4}` }),
      across(below, corner[1], view, x, number(corner[1] - below), -1),
    ];
  });
}

// Which feature is where, over the free edge: each label in the first row where it meets no other.
function placedLabels(design, extents, toX, px) {
  const rowEnds = [];
  return design.track.map((feature, i) => {
    const height = isBlade(feature) ? `, ${short(dimensionOf(feature, 'height_mm'))} mm over the track` : '';
    const text = `${i} ${feature.type}${height}`;
    const half = 3.6 * text.length + 4;
    const at = toX((extents[i][0] + extents[i][1]) / 2);
    const middle = Math.max(half, Math.min(px - half, at));
    let row = rowEnds.findIndex((end) => end < middle - half);
    if (row < 0) row = rowEnds.length;
    rowEnds[row] = middle + half;
    return { text, at, middle, row };
  });
}

function label({ text, at, middle, row }, bottom) {
  const y = 16 + 14 * row;
  return s(
    'g',
    { class: 'feature-label' },
    s('path', { d: `M${at},${y + 3}V${bottom}` }),
    s('text', { x: middle, y, 'text-anchor': 'middle' }, text),
  );
}

// Distances from the wall or the free edge that a type is defined by.
function crossings(feature, [a, b], width, view) {
  if (!feature.voids.length) return [];
  const box = boxOf(feature.voids.map((v) => v.outer_mm));
  const at = view.x(a + 0.5 * (b - a));
  const aside = view.x(a + 0.2 * (b - a));
  if (feature.type === 'balcony') return [across(0, box.yMin, view, at, number(box.yMin))];
  if (feature.type === 'canyon' || feature.type === 'slot') {
    return [across(0, box.yMin, view, at, number(box.yMin)), across(0, box.yMax, view, aside, number(box.yMax), -1)];
  }
  if (feature.type === 'dish-out' || feature.type === 'scallop') {
    return [across(box.yMin, width, view, at, number(width - box.yMin))];
  }
  return [];
}

// Corner numbers, pushed outwards from the middle of the corners.
function numbered(corners, width, view) {
  const group = s('g', { class: 'corner' });
  const middle = [0, 1].map((k) => corners.reduce((sum, p) => sum + p[k], 0) / corners.length);
  corners.forEach((corner, i) => {
    if (corner[1] < -kSame_mm || corner[1] > width + kSame_mm) return;
    const [x, y] = view.to(corner);
    const away = [corner[0] - middle[0], middle[1] - corner[1]];
    const length = Math.hypot(...away) || 1;
    const [lx, ly] = [x + (12 * away[0]) / length, y + (12 * away[1]) / length];
    group.append(
      s('circle', { cx: x, cy: y, r: 2 }),
      s('circle', { class: 'tag', cx: lx, cy: ly, r: 7 }),
      s('text', { x: lx, y: ly + 3.5, 'text-anchor': 'middle' }, String(i + 1)),
    );
  });
  return group;
}

// Every feature with the numbers that define it; cut-outs corner by corner.
export function featureTable(design, width, cutter) {
  const rows = design.track.map((feature, i) => {
    const literal = design.features[i];
    const corners = cornersOf(literal, feature.start_mm);
    const open = openings([feature], width).flat();
    const numbers = corners.length
      ? [
          h(
            'ol',
            { class: 'corners' },
            corners.map(([x, y]) =>
              h(
                'li',
                null,
                `(${fixed(x, 3)}, ${fixed(y, 3)})`,
                y < -kSame_mm ? ' below the wall\u2019s face' : y > width + kSame_mm ? ' beyond the free edge' : '',
              ),
            ),
          ),
          open.length
            ? h(
                'div',
                { class: 'small' },
                `crosses the free edge at x = ${distinct(open)
                  .map((x) => fixed(x, 3))
                  .join(', ')}`,
              )
            : null,
        ]
      : feature.dimensions.length
        ? feature.dimensions
            .map(([name, value]) => `${readable(name)} ${short(value, 4)}${name.endsWith('_deg') ? '\u00b0' : ' mm'}`)
            .join(', ')
        : literal.file
          ? `as drawn in ${literal.file}`
          : '';
    return h(
      'tr',
      null,
      h('th', { scope: 'row' }, `${i} ${feature.type}`),
      h('td', { class: 'num' }, fixed(feature.start_mm, 3)),
      h('td', { class: 'num' }, fixed(feature.end_mm, 3)),
      h('td', null, numbers),
    );
  });
  return h(
    'div',
    null,
    h(
      'table',
      { class: 'plain', id: 'features' },
      h(
        'thead',
        null,
        h(
          'tr',
          null,
          h('th', { scope: 'col' }, 'Feature'),
          h('th', { scope: 'col', class: 'num' }, 'from x (mm)'),
          h('th', { scope: 'col', class: 'num' }, 'to x (mm)'),
          h('th', { scope: 'col' }, design.turning ? 'what is cut or stands (mm)' : 'what is cut (mm)'),
        ),
      ),
      h('tbody', null, rows),
    ),
    cutter
      ? h(
          'p',
          { class: 'small' },
          `Inside corners sharper than the cutter (radius ${short(cutter)} mm) are rounded by it: `,
          'drawn and judged so. Corner coordinates are those before rounding.',
        )
      : null,
  );
}

const readable = (name) => name.replace(/_(mm|deg)$/, '').replaceAll('_', ' ');
