// Time for pictures that move: play, pause, a slider with its keys, speeds. What moves is up to the stage.

import { h, onWidth } from './dom.js';

// from, to, start: of what the slider holds; speeds: [[a second, word]], the word of the chosen one is `speed`;
// steps: of an arrow key and of a page key; jump: {text, to(at)}; label: of the slider;
// makeStage(px): {svg, left, right (where the slider's ends stand), move(at)}; shown(at): called after every move.
export function animation({ from, to, start, speeds, speed, steps, jump, label, makeStage, shown }) {
  let at = start;
  let perSecond = speed;
  let timer = 0;
  let move = () => {};

  const stage = h('div', { class: 'stage' });
  const readout = h('output', { class: 'readout', id: 'readout', for: 'scrub' });
  const slider = h('input', {
    type: 'range',
    id: 'scrub',
    min: from.toFixed(3),
    max: to.toFixed(3),
    step: 'any',
    'aria-label': label,
    oninput: () => {
      pause();
      show(Number(slider.value));
    },
  });
  // Steps of the keyboard: a fine one, since much can change at once.
  slider.addEventListener('keydown', (event) => {
    const [fine, coarse] = steps;
    const step = {
      ArrowLeft: -fine,
      ArrowRight: fine,
      ArrowDown: -fine,
      ArrowUp: fine,
      PageDown: -coarse,
      PageUp: coarse,
    }[event.key];
    if (!step) return;
    event.preventDefault();
    pause();
    show(at + step);
  });
  const play = h('button', { type: 'button', id: 'play', onclick: () => (timer ? pause() : run()) }, '\u25b6 Play');
  const jumping = h(
    'button',
    {
      type: 'button',
      id: 'jump',
      onclick: () => {
        pause();
        show(jump.to(at));
      },
    },
    jump.text,
  );
  const choice = h(
    'select',
    {
      id: 'speed',
      onchange: () => {
        perSecond = Number(choice.value);
      },
    },
    speeds.map(([v, text]) => h('option', { value: v, selected: v === speed }, text)),
  );

  function pause() {
    cancelAnimationFrame(timer);
    timer = 0;
    play.textContent = '\u25b6 Play';
  }
  function run() {
    if (at >= to - 1e-6) at = from;
    play.textContent = '\u23f8 Pause';
    let last = null;
    const tick = (now) => {
      if (!stage.isConnected) return pause();
      if (last !== null) show(Math.min(to, at + (perSecond * Math.min(100, now - last)) / 1000));
      last = now;
      if (at >= to - 1e-6) return pause();
      timer = requestAnimationFrame(tick);
    };
    timer = requestAnimationFrame(tick);
  }
  function show(where) {
    at = Math.max(from, Math.min(to, where));
    slider.value = String(at);
    move(at);
    shown?.(at);
  }

  onWidth(stage, (px) => {
    const made = makeStage(px);
    stage.replaceChildren(made.svg);
    move = made.move;
    slider.style.marginLeft = `${made.left - 8}px`;
    slider.style.width = `${made.right - made.left + 16}px`;
    show(at);
  });

  const controls = h('div', { class: 'controls' }, play, jumping, h('label', null, 'Speed ', choice), readout);
  return { controls, stage, slider, readout, pause, run, show, now: () => at };
}
