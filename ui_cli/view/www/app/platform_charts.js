// What the charts of a platform show: tracking error, estimation error, slip, torques.
import {ellipse} from './platform.js';

const at = (name, scale = 1) => ({track, column}) => (row, k) => scale * track.at(row, column[name] + k);
const kNowhere = [NaN, NaN];

/** @return where it really was [m], if that is told */
const true_place = ({track, truth}, row) => truth?.mix(track.time(row), 1, 2, [0, 0]) || kNowhere;

const seen_place = ({track, column}, row) => [0, 1].map((k) => track.at(row, column.x + k));

/** @return where it was to be [m] */
function wanted_place({track, column, telemetry}, row) {
  const sent = track.at(row, column.sent), found = telemetry ? telemetry.find(sent) : -1;
  return found >= 0 && telemetry.time(found) === sent ? [0, 1].map((k) => telemetry.at(found, 1 + k)) : kNowhere;
}

const distance_mm = ([ax, ay], [bx, by]) => 1000 * Math.hypot(ax - bx, ay - by);

const tracking = (source) => (row, k) => distance_mm(k ? seen_place(source, row) : true_place(source, row), wanted_place(source, row));

function estimation(source) {
  const {track, column} = source;
  return (row, k) => k ? 1000 * ellipse(...[0, 1, 2].map((n) => track.at(row, column.xx + n))).a : distance_mm(seen_place(source, row), true_place(source, row));
}

const true_slip = ({track, truth}) => (row, k) => truth?.mix(track.time(row), 4 + k, 1, [0])?.[0] ?? NaN;

export const kPlatformCharts = [
  {title: 'Tracking error', hint: 'distance from the reference: of where the platform is, and of where it is estimated to be', unit: 'mm', series: ['true', 'seen'], wide: 76, least: 10, places: 1, value: tracking},
  {title: 'Estimation error', hint: 'distance of the estimate from the truth, and the longer half axis of its 95 % ellipse', unit: 'mm', series: ['error', '95 %'], wide: 76, least: 10, places: 1, value: estimation},
  {title: 'Slip', hint: 'friction along and across the wheels and its split left and right, as estimated with 2 standard deviations; dashed: what is true', unit: '-', series: ['along', 'across', 'split'], wide: 84, least: 0.2, places: 2, value: at('mu_x'), spread: at('sd_mu_x', 2), truth: true_slip},
  {title: 'Torque', hint: 'commanded, of the wheels front left, front right, rear left, rear right', unit: 'N m', series: ['FL', 'FR', 'RL', 'RR'], least: 1, places: 1, value: at('tau0')},
];
