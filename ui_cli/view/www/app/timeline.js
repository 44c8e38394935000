// The time-line: behaviours of every agent as coloured bands, messages as ticks, and the instant that is shown.
import {title_of} from './history.js';
import {colour_of, label, nice_step, prepare, theme, ticks} from './theme.js';

const kLeft = 64, kRight = 14, kTop = 14, kBottom = 20;

export class Timeline {
  /** @param seek  called with the instant that was chosen */
  constructor(canvas, history, player, seek) {
    Object.assign(this, {canvas, history, player, seek});
    const choose = (event) => {
      const box = canvas.getBoundingClientRect();
      this.seek(this.time(event.clientX - box.left));
    };
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.dragging = true;
      choose(event);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (this.dragging) choose(event);
      else this.hover(event);
    });
    canvas.addEventListener('pointerup', () => { this.dragging = false; });
    canvas.addEventListener('pointercancel', () => { this.dragging = false; });
  }
  get range() {
    const begin = Math.min(this.history.begin_time, this.history.end_time);
    return {begin, end: Math.max(this.history.end_time, begin + 1)};
  }
  x(t) {
    const {begin, end} = this.range;
    return kLeft + ((this.canvas.clientWidth - kLeft - kRight) * (t - begin)) / (end - begin);
  }
  time(x) {
    const {begin, end} = this.range;
    return begin + ((x - kLeft) / (this.canvas.clientWidth - kLeft - kRight)) * (end - begin);
  }
  lanes(height) {
    const {scene, bands, effectors} = this.history;
    const known = [...scene.arms, ...scene.platforms].map((e) => e.name).filter((name) => bands.has(name));
    const names = [...(known.length ? known : effectors), ...this.history.agents];
    const room = (height - kTop - kBottom) / Math.max(1, names.length), thick = Math.min(26, room - 4);
    return names.map((name, k) => ({name, y: kTop + k * room + (room - thick) / 2, h: thick}));
  }
  hover(event) {
    const box = this.canvas.getBoundingClientRect(), y = event.clientY - box.top, t = this.time(event.clientX - box.left);
    const lane = this.lanes(this.canvas.clientHeight).find((l) => y >= l.y && y <= l.y + l.h);
    const m = lane ? this.history.behaviour(lane.name, t) : 0;
    this.canvas.title = m ? `${title_of(lane.name)}, ${t.toFixed(2)} s: m = ${m}, ${this.history.name_of(lane.name, m)}` : '';
  }
  draw() {
    const {c, width, height} = prepare(this.canvas), {begin, end} = this.range;
    const right = width - kRight, bottom = height - kBottom;
    c.strokeStyle = theme.grid; c.fillStyle = theme.dim; c.textAlign = 'center'; c.textBaseline = 'top';
    const step = nice_step(end - begin, (right - kLeft) / 90);
    for (const t of ticks(begin, end, step)) {
      const at = Math.round(this.x(t)) + 0.5;
      c.beginPath(); c.moveTo(at, kTop - 4); c.lineTo(at, bottom + 2); c.stroke();
      c.fillText(`${label(t, step)} s`, at, bottom + 5);
    }
    for (const lane of this.lanes(height)) this.draw_lane(c, lane);
    for (const line of this.history.lines) {
      const at = this.x(line.t);
      c.fillStyle = line.fault ? theme.bad : theme.dim;
      c.beginPath(); c.moveTo(at - 3.5, 4); c.lineTo(at + 3.5, 4); c.lineTo(at, 10); c.fill();
    }
    this.draw_cursor(c, bottom);
    this.canvas.setAttribute('aria-valuemax', end.toFixed(2));
    this.canvas.setAttribute('aria-valuenow', this.player.t.toFixed(2));
  }
  draw_lane(c, {name, y, h}) {
    c.textAlign = 'right'; c.textBaseline = 'middle'; c.fillStyle = theme.text;
    c.fillText(title_of(name), kLeft - 10, y + h / 2);
    c.textAlign = 'left';
    for (const band of this.history.bands.get(name)?.list || []) {
      // Agents without an effector tell of a time before that which is shown.
      const from = Math.max(kLeft, this.x(band.begin)), wide = Math.max(0.7, this.x(band.end) - from);
      if (this.x(band.end) < kLeft) continue;
      c.fillStyle = colour_of(band.m);
      c.fillRect(from, y, wide, h);
      if (!band.m || wide < 16) continue;
      c.save();
      c.beginPath(); c.rect(from, y, wide - 3, h); c.clip();
      c.fillStyle = theme.dark ? '#0e1116' : '#ffffff';
      const name_of = this.history.name_of(name, band.m), full = `${band.m}  ${name_of}`;
      c.fillText(c.measureText(full).width + 10 < wide && !name_of.startsWith('m =') ? full : `${band.m}`, from + 5, y + h / 2 + 0.5);
      c.restore();
    }
  }
  draw_cursor(c, bottom) {
    const at = this.x(this.player.t);
    if (!Number.isFinite(at)) return;
    c.strokeStyle = c.fillStyle = theme.accent;
    c.lineWidth = 2;
    c.beginPath(); c.moveTo(at, 8); c.lineTo(at, bottom + 3); c.stroke();
    c.beginPath(); c.arc(at, 8, 5, 0, 7); c.fill();
    c.lineWidth = 1;
  }
}
