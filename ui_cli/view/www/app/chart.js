// One strip chart: a few quantities of an arm or a platform over time, on the colours of its behaviours.
import {colour_of, fixed, label, nice_step, prepare, theme, ticks} from './theme.js';

const kColours = ['x', 'y', 'z', 'accent'];  // of the series
const kLeft = 46, kRight = 8, kTop = 20, kBottom = 16;

/**
 * @param value  value(row, k) of series k
 * @param since  values before it do not count for low and high, where there are others
 * @return rows to draw with their values, at most a few per pixel
 */
function thinned(track, begin, end, width, value, count, since) {
  const first = Math.max(0, track.find(begin)), last = Math.min(track.rows - 1, track.find(end) + 1);
  const stride = Math.max(1, Math.floor((last - first) / (1.5 * width)));
  const lines = Array.from({length: count}, () => []);
  const from = since > begin && since < track.time(last) ? since : begin;
  let low = Infinity, high = -Infinity;
  const keep = (k, row, v) => {
    if (!Number.isFinite(v)) return;
    lines[k].push([track.time(row), v]);
    if (track.time(row) < from || track.time(row) > end) return;
    low = Math.min(low, v);
    high = Math.max(high, v);
  };
  for (let row = first; row <= last; row += stride)
    for (let k = 0; k < count; ++k) {
      if (stride === 1) { keep(k, row, value(row, k)); continue; }
      let least = row, most = row;  // of a group both extremes stay: no peak gets lost
      for (let r = row; r < Math.min(row + stride, last + 1); ++r) {
        if (value(r, k) < value(least, k)) least = r;
        if (value(r, k) > value(most, k)) most = r;
      }
      for (const r of least <= most ? [least, most] : [most, least]) keep(k, r, value(r, k));
    }
  return {lines, low, high};
}

export class Chart {
  /** @param about  {title, hint, unit, places, series: [names], least: smallest height of the axis, biased: before the first behaviour it says nothing, value(source, first_row) -> (row, k), and where there are such: spread(source) -> half the height of a band around it, truth(source) -> what is dashed, wide: room of a name in the legend} */
  constructor(about) {
    this.about = about;
    this.canvas = document.createElement('canvas');
    this.canvas.setAttribute('role', 'img');
    this.canvas.title = `${about.title} [${about.unit}], ${about.hint}`;
    this.element = document.createElement('div');
    this.element.className = 'chart';
    this.element.append(this.canvas);
  }
  /** @param source  {track, column: numbers of its columns by name, and of a platform telemetry and truth}  @param window  {begin, end, now}  @param with_time  whether the numbers of the time stand below */
  draw(source, bands, window, with_time) {
    const {track} = source;
    const {c, width, height} = prepare(this.canvas);
    const {begin, end, now} = window, bottom = height - (with_time ? kBottom : 4);
    const plot = {x: kLeft, y: kTop, w: width - kLeft - kRight, h: bottom - kTop};
    if (plot.h < 12 || plot.w < 20) return;
    const x = (t) => plot.x + (plot.w * (t - begin)) / (end - begin);
    const value = track && track.rows ? this.about.value(source, Math.max(0, track.find(begin))) : null;
    const since = this.about.biased ? bands.find((band) => band.m)?.begin : undefined;
    const lines_of = (what) => (value ? thinned(track, begin, end, plot.w, what, this.about.series.length, since) : {lines: [], low: 0, high: 0});
    const drawn = lines_of(value), band = this.band(source, value, lines_of), truth = this.about.truth ? lines_of(this.about.truth(source)) : {lines: []};
    const range = this.range([drawn, truth]);
    const y = (v) => plot.y + plot.h * (1 - (v - range.low) / (range.high - range.low));
    this.tint(c, plot, x, bands, begin, end);
    this.axes(c, plot, {begin, end, x, y, range}, with_time ? bottom : 0);
    c.save();
    c.beginPath(); c.rect(plot.x, plot.y - 1, plot.w, plot.h + 2); c.clip();
    const path = (line) => { c.beginPath(); line.forEach(([t, v], i) => (i ? c.lineTo(x(t), y(v)) : c.moveTo(x(t), y(v)))); };
    c.globalAlpha = 0.15;
    band.forEach((line, k) => { c.fillStyle = theme[kColours[k]]; path(line); c.fill(); });
    c.globalAlpha = 1;
    c.lineJoin = 'round';
    for (const [lines, width, dash] of [[drawn.lines, 1.5, []], [truth.lines, 1, [4, 3]]]) {
      c.lineWidth = width;
      c.setLineDash(dash);
      lines.forEach((line, k) => { c.strokeStyle = theme[kColours[k]]; path(line); c.stroke(); });
    }
    c.setLineDash([]);
    c.restore();
    if (now >= begin && now <= end) {
      c.strokeStyle = theme.cursor; c.lineWidth = 1; c.globalAlpha = 0.6;
      c.beginPath(); c.moveTo(x(now), plot.y); c.lineTo(x(now), plot.y + plot.h); c.stroke();
      c.globalAlpha = 1;
    }
    this.legend(c, width, value, track ? track.find(now) : -1);
  }
  /** @return of each series the outline of what it may be */
  band(source, value, lines_of) {
    if (!this.about.spread || !value) return [];
    const spread = this.about.spread(source);
    const [upper, lower] = [1, -1].map((side) => lines_of((row, k) => value(row, k) + side * spread(row, k)).lines);
    return upper.map((line, k) => [...line, ...lower[k].reverse()]);
  }
  /** @param all  what has to fit, [{low, high}] */
  range(all) {
    let [low, high] = [Math.min(...all.map((each) => each.low ?? Infinity)), Math.max(...all.map((each) => each.high ?? -Infinity))];
    if (!(low <= high)) [low, high] = [0, 0];
    const middle = (low + high) / 2, half = Math.max((high - low) / 2, this.about.least / 2) * 1.12;
    return {low: middle - half, high: middle + half};
  }
  tint(c, plot, x, bands, begin, end) {
    c.globalAlpha = theme.dark ? 0.16 : 0.11;
    for (const band of bands) {
      if (band.end < begin || band.begin > end || !band.m) continue;
      const from = Math.max(plot.x, x(band.begin)), to = Math.min(plot.x + plot.w, x(band.end));
      c.fillStyle = colour_of(band.m);
      c.fillRect(from, plot.y, Math.max(0.5, to - from), plot.h);
    }
    c.globalAlpha = 1;
  }
  axes(c, plot, {begin, end, x, y, range}, time_at) {
    c.strokeStyle = theme.grid; c.fillStyle = theme.dim; c.lineWidth = 1;
    const step = nice_step(range.high - range.low, Math.max(3, plot.h / 24));
    c.textAlign = 'right'; c.textBaseline = 'middle';
    for (const v of ticks(range.low, range.high, step)) {
      const at = Math.round(y(v)) + 0.5;
      c.beginPath(); c.moveTo(plot.x, at); c.lineTo(plot.x + plot.w, at); c.stroke();
      c.fillText(label(v, step), plot.x - 6, at);
    }
    const seconds = nice_step(end - begin, plot.w / 70);
    c.textAlign = 'center'; c.textBaseline = 'top';
    for (const t of ticks(begin, end, seconds)) {
      const at = Math.round(x(t)) + 0.5;
      c.beginPath(); c.moveTo(at, plot.y); c.lineTo(at, plot.y + plot.h); c.stroke();
      if (!time_at) continue;
      c.textAlign = at > plot.x + plot.w - 14 ? 'right' : 'center';
      c.fillText(`${label(t, seconds)} s`, c.textAlign === 'right' ? plot.x + plot.w + kRight : at, time_at + 3);
    }
  }
  legend(c, width, value, row) {
    c.textBaseline = 'middle'; c.textAlign = 'left';
    c.fillStyle = theme.text; c.font = '600 11px system-ui, "DejaVu Sans", sans-serif';
    c.fillText(this.about.title, 2, 9);
    const title = c.measureText(this.about.title).width;
    c.font = '11px system-ui, "DejaVu Sans", sans-serif';
    c.fillStyle = theme.dim;
    c.fillText(`[${this.about.unit}]`, 6 + title, 9);
    const column = this.about.wide || 66;
    this.about.series.forEach((name, k) => {
      const at = width - kRight - column * (this.about.series.length - k);
      c.textAlign = 'left'; c.fillStyle = theme[kColours[k]];
      c.fillRect(at + 8, 8, 8, 3);
      c.fillText(name, at + 20, 9);
      c.textAlign = 'right'; c.fillStyle = theme.text;
      c.fillText(value && row >= 0 && Number.isFinite(value(row, k)) ? fixed(value(row, k), this.about.places) : '-', at + column, 9);
    });
  }
}
