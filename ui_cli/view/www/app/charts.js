// The charts of the chosen arm: force, moment, and how far E has moved and turned in what is shown; or those of a platform.
import {Quaternion, Vector3} from '../vendor/three.js';
import {Chart} from './chart.js';
import {kPlatformCharts} from './platform_charts.js';

const at = (name, scale = 1) => ({track, column}) => (row, k) => scale * track.at(row, column[name] + k);

function moved({track, column}, first) {
  const from = [0, 1, 2].map((k) => track.at(first, column.x + k));
  return (row, k) => 1000 * (track.at(row, column.x + k) - from[k]);
}

function turned({track, column}, first) {
  const orientation = (row) => {
    const v = new Vector3(...[0, 1, 2].map((k) => track.at(row, column.ax + k))), angle = v.length();
    return new Quaternion().setFromAxisAngle(angle > 0 ? v.divideScalar(angle) : new Vector3(0, 0, 1), angle);
  };
  const back = orientation(first).invert();
  let known = -1, angles = [0, 0, 0];
  return (row, k) => {
    if (row !== known) {
      const q = back.clone().multiply(orientation(row));
      if (q.w < 0) q.set(-q.x, -q.y, -q.z, -q.w);
      const sine = Math.hypot(q.x, q.y, q.z), scale = sine > 1e-9 ? (2 * Math.atan2(sine, q.w)) / sine : 2;
      angles = [q.x, q.y, q.z].map((part) => (part * scale * 180) / Math.PI);
      known = row;
    }
    return angles[k];
  };
}

const kArmCharts = [
  {title: 'Force F_a', hint: 'adjusted force in E', unit: 'N', series: ['x', 'y', 'z'], least: 2, places: 2, biased: true, value: at('Fx')},
  {title: 'Moment N_a', hint: 'adjusted moment in E', unit: 'N m', series: ['x', 'y', 'z'], least: 0.1, places: 3, biased: true, value: at('Nx')},
  {title: 'Position, change', hint: 'of E in the base of the arm, since the left edge of the chart', unit: 'mm', series: ['x', 'y', 'z'], least: 1, places: 1, value: moved},
  {title: 'Orientation, change', hint: 'of E, angle times axis, since the left edge of the chart', unit: 'deg', series: ['x', 'y', 'z'], least: 0.2, places: 2, value: turned},
];

export class Charts {
  constructor(place) {
    [this.arm, this.platform] = [kArmCharts, kPlatformCharts].map((all) => all.map((about) => new Chart(about)));
    place.append(...[...this.arm, ...this.platform].map((c) => c.element));
    this.span = 20;
  }
  /** @return {begin, end, now}: what is shown around an instant */
  window(history, player) {
    const first = Number.isFinite(history.begin_time) ? history.begin_time : 0, last = Math.max(history.end_time, first + 1);
    if (!this.span) return {begin: first, end: last, now: player.t};
    const share = player.live ? 1 : 0.5;
    const end = Math.min(Math.max(player.t + (1 - share) * this.span, first + this.span), Math.max(last, first + this.span));
    return {begin: end - this.span, end, now: player.t};
  }
  /** @param name  of an arm or a platform */
  draw(history, player, name) {
    const window = this.window(history, player), bands = history.bands.get(name)?.list || [];
    const [shown, others] = history.platforms.has(name) ? [this.platform, this.arm] : [this.arm, this.platform];
    others.forEach((chart) => { chart.element.hidden = true; });
    shown.forEach((chart) => { chart.element.hidden = false; });
    const source = {track: history.tracks.get(name), column: history.columns_of(name), telemetry: history.tracks.get(`telemetry:${name}`), truth: history.tracks.get(`truth:${name}`)};
    shown.forEach((chart, k) => chart.draw(source, bands, window, k === shown.length - 1));
  }
}
