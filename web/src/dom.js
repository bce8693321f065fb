// Elements from code: h for HTML, s for SVG. Texts are never parsed as markup.

const kSvg = 'http://www.w3.org/2000/svg';

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child !== null && child !== undefined && child !== false) element.append(child);
  }
  return element;
}

export const h = (tag, attributes, ...children) => fill(document.createElement(tag), attributes, children);
export const s = (tag, attributes, ...children) => fill(document.createElementNS(kSvg, tag), attributes, children);

let count = 0;
// An id for clip paths and patterns: the page holds many pictures.
export const freshId = (prefix) => `${prefix}-${++count}`;

// Paper is narrower than most screens: pictures are drawn anew for it, so that their texts stay readable.
const kPaper_px = 700;
const drawings = [];
addEventListener('beforeprint', () => drawings.forEach((d) => d.last > 0 && d.draw(Math.min(d.last, d.paper()))));
addEventListener('afterprint', () => drawings.forEach((d) => d.last > 0 && d.draw(d.last)));

// Draws again whenever the element's width changes, at most once a frame, and for paper. columns: how many such
// elements stand side by side there.
export function onWidth(element, draw, columns = 1) {
  const drawing = { last: 0, draw, paper: () => (element.isConnected ? kPaper_px / columns : Infinity) };
  let asked = false;
  drawings.push(drawing);
  new ResizeObserver(() => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      const width = Math.floor(element.clientWidth);
      if (width > 0 && width !== drawing.last) draw((drawing.last = width));
    });
  }).observe(element);
}
