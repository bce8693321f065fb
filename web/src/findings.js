// What the search found out besides designs: what it left out and why, what is proved, which topologies looked best.

import { h } from './dom.js';
import { counted } from './format.js';

const kTopics = [
  ['proved', 'What is proved'],
  ['ranked', 'Topologies by what their features promise'],
  ['pruned', 'What was left out, and why'],
];
const kShown = 12;

export function findings(report) {
  const groups = kTopics
    .map(([topic, title]) => [title, topic, (report.findings ?? []).filter((f) => f.topic === topic)])
    .filter(([, , list]) => list.length > 0);
  if (groups.length === 0) return null;
  return h(
    'div',
    { class: 'columns', id: 'findings' },
    groups.map(([title, topic, list]) =>
      h('div', { 'data-topic': topic }, h('h3', null, title), rows(list.slice(0, kShown)), rest(list.slice(kShown))),
    ),
  );
}

function rows(list) {
  return h(
    'ul',
    null,
    list.map((f) => h('li', null, h('b', null, f.subject), `: ${f.text}`)),
  );
}

function rest(list) {
  if (list.length === 0) return null;
  return h('details', null, h('summary', null, counted(list.length, 'more', 'more')), rows(list));
}
