// The picture of the configuration space with its controls, legend and words.

import { h } from './dom.js';
import { degrees, fixed } from './format.js';

// What the panel says of a track; aspect: of the part.
const trackWords = (aspect) => ({
  views: [
    ['From the wall', -90],
    ['Along the feed', -180],
  ],
  below: 'track and obstacles below',
  caption: [
    `Aspect \u201c${aspect}\u201d. A point of this space is a placement of the part: where its centre of mass is (x, y) and how it is turned (\u03b8, upwards; top and bottom are the same). `,
    'A surface is where a feature of the part touches a feature of the track, seen from its free side (from behind it is faint): the part\u2019s path runs along surfaces, or through the free space between them.',
  ],
  click: 'click a surface to see that contact on the track above.',
  dotted: '; dotted on the track above.',
});

// view: a spaceView of data, the space of one aspect. Answers {node, view, picked(facet, placement)}.
export function spacePanel(view, data, aspect, words = trackWords(aspect)) {
  const facets = data.facets
    .map((facet, i) => ({ ...facet, index: i }))
    .filter((f) => data.slices.some((slice) => slice.pieces.some((p) => p[0] === f.index)));
  const [least, most] = view.range;
  const range = (id, value, label) =>
    h('input', { type: 'range', id, min: least, max: most, step: data.theta_step_deg, value, 'aria-label': label });
  const low = range('theta-from', least, 'Least theta shown');
  const high = range('theta-to', most, 'Largest theta shown');
  const thetaWords = () => `${degrees(Number(low.value))} to ${degrees(Number(high.value))}`;
  const said = h('output', { class: 'theta-words' }, thetaWords());
  const clip = (moved) => {
    if (Number(low.value) > Number(high.value)) (moved === low ? high : low).value = moved.value;
    said.textContent = thetaWords();
    view.clipTo(Number(low.value), Number(high.value));
  };
  low.addEventListener('input', () => clip(low));
  high.addEventListener('input', () => clip(high));
  const hasSupport = data.slices.some((slice) => slice.pieces.some((p) => p[5] !== -1));
  const by = h(
    'select',
    { id: 'colour-by', onchange: () => paint(by.value) },
    h('option', { value: 'kind' }, 'kind of contact'),
    hasSupport ? h('option', { value: 'support' }, 'support') : null,
  );
  const keys = h('span', { class: 'surface-keys' });
  const item = (cls, text) => h('span', null, h('i', { class: `key ${cls}`, 'aria-hidden': 'true' }), text);
  function paint(what) {
    view.colourBy(what);
    keys.replaceChildren(
      ...(what === 'support'
        ? [item('surface-supported', 'the part is supported'), item('surface-unsupported', 'it is not')]
        : [item('surface-ve', 'a corner of the part touches'), item('surface-ev', 'an edge of the part touches')]),
    );
  }
  const list = h(
    'select',
    { id: 'facet', onchange: () => view.facet(list.value === '' ? null : Number(list.value)) },
    h('option', { value: '' }, 'none'),
    facets.map((f) => h('option', { value: f.index }, f.label)),
  );
  const button = (text, azimuth, elevation) =>
    h('button', { type: 'button', onclick: () => view.look(azimuth, elevation, { flat: true }) }, text);
  const label = h('p', { class: 'facet-words', id: 'facet-words', 'aria-live': 'polite' });
  paint('kind');
  view.node.append(label);
  const node = h(
    'figure',
    { class: 'space-figure' },
    h(
      'div',
      { class: 'controls' },
      h('button', { type: 'button', id: 'space-reset', onclick: () => view.reset() }, 'Reset view'),
      button('From above', -90, 89.9),
      words.views.map(([text, azimuth]) => button(text, azimuth, 0)),
      h('label', null, 'Colour ', by),
      h('label', null, 'Surface ', list),
    ),
    view.node,
    h('div', { class: 'controls theta-controls' }, h('span', null, 'Show \u03b8 '), low, high, said),
    h(
      'p',
      { class: 'legend' },
      keys,
      item('path-chosen', 'chosen path'),
      item('path-other', 'other paths'),
      item('marker', 'the part now'),
      words.below ? item('shadow', words.below) : null,
    ),
    h(
      'figcaption',
      { id: 'space-caption' },
      words.caption,
      h('span', { class: 'screen' }, ` Drag or use the arrow keys to turn it, + and \u2212 to zoom; ${words.click}`),
    ),
  );
  return {
    node,
    view,
    picked(facet, placement) {
      label.replaceChildren(
        ...(facet
          ? [
              h('b', null, facet.label),
              ` at x ${fixed(placement[0], 1)} mm, y ${fixed(placement[1], 1)} mm, \u03b8 ${fixed(placement[2], 1)}\u00b0${words.dotted}`,
            ]
          : []),
      );
      const index = facet ? data.facets.indexOf(facet) : -1;
      list.value = index < 0 ? '' : String(index);
    },
  };
}
