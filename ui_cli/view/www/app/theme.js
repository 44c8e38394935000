// Colours: those of the style sheet, which follow the system's preference, and those of behaviours.

const names = ['page', 'panel', 'line', 'text', 'dim', 'soft', 'accent', 'good', 'bad', 'x', 'y', 'z', 'grid', 'cursor', 'sky', 'floor'];
const dark = matchMedia('(prefers-color-scheme: dark)');
export const theme = {dark: false};

function read() {
  const style = getComputedStyle(document.documentElement);
  for (const name of names) theme[name] = style.getPropertyValue(`--${name}`).trim();
  theme.dark = dark.matches;
}
read();

/** Calls back whenever the colours have changed. */
export function on_theme(call) { dark.addEventListener('change', () => { read(); call(); }); }

const kHues = [214, 28, 152, 272, 346, 188, 48, 102, 312, 240];
/** @return colour of a behaviour, grey for none */
export function colour_of(m) {
  if (!m) return theme.dark ? '#39424f' : '#d3d8df';
  const hue = kHues[(m - 1) % kHues.length];
  return theme.dark ? `hsl(${hue} 48% 52%)` : `hsl(${hue} 62% 55%)`;
}

/** Fits a canvas to its place. @return its context, in CSS pixels, with width and height */
export function prepare(canvas) {
  const ratio = Math.min(devicePixelRatio || 1, 2);
  const width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const c = canvas.getContext('2d');
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, width, height);
  c.font = '11px system-ui, "DejaVu Sans", sans-serif';
  return {c, width, height};
}

/** @return a round step that divides span into about count parts */
export function nice_step(span, count) {
  const raw = Math.max(span, 1e-9) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find((f) => f * power >= raw - 1e-12);
}

/** @return the multiples of step from begin to end, a hundred at most: numbers can be so large that a step changes nothing */
export function ticks(begin, end, step) {
  const first = Math.ceil(begin / step), count = Math.floor(end / step) - first + 1;
  return Array.from({length: Math.min(Math.max(count, 0), 100) || 0}, (_, k) => (first + k) * step);
}

/** @return a number with as many places as its step needs */
export function label(value, step) {
  const places = Math.max(0, Math.min(4, -Math.floor(Math.log10(step) + 1e-9)));
  return (Math.abs(value) < step / 2 ? 0 : value).toFixed(places);
}

/** @return a number with so many places, and no minus before a zero */
export function fixed(value, places) {
  const text = value.toFixed(places);
  return Number(text) === 0 ? text.replace('-', '') : text;
}
