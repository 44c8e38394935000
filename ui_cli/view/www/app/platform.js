// A platform in its room: where it is estimated to be and where it is, the ways of both, its plan, and what its driver
// means to do.
import {Group, MeshStandardMaterial} from '../vendor/three.js';
import {block} from './furniture.js';
import {Plan} from './plan.js';
import {Ribbon} from './ribbon.js';
import {paint, Robot} from './robot.js';

const kPoints = 21;                     // of reference and horizon
const kEllipse = Math.sqrt(5.991);      // standard deviations within which 95 % of two normal numbers are
const kColours = {estimate: 0xe8702a, truth: 0x2f6fdb, plan: 0x2f9e5b, horizon: 0xb03a9c, other: 0x8f98a4, fragments: [0xd8b04c, 0xb98c22]};
/** What the lines on the floor are, [[colour, words]]. */
export const kLegend = [
  [kColours.estimate, 'estimate; its 95 % ellipse, and ten times that'], [kColours.truth, 'truth'], [kColours.fragments[1], 'fragments handed over'],
  [kColours.plan, 'plan, and reference of the next second'], [kColours.horizon, 'where the tracker expects it then'],
];
/** Paint of the body where it really is: on the one where it is estimated to be. */
const ghost = new MeshStandardMaterial({color: kColours.truth, transparent: true, opacity: 0.14, depthWrite: false});

/** The way that a track tells, up to an instant. */
class Way {
  /** @param from  column of x, y, phi */
  constructor(look, from) { Object.assign(this, {ribbon: new Ribbon(look), from}); }
  show(track, t) {
    if (track) for (let row = this.ribbon.count; row < track.rows; ++row) this.ribbon.add(...[0, 1, 2].map((k) => track.at(row, this.from + k)));
    this.ribbon.show(track ? track.find(t) + 1 : 0);
  }
}

/** A box where there is no description. */
function body(urdf) {
  if (urdf) return new Robot(urdf);
  const root = new Group();
  root.add(block([0.72, 0.48, 0.3], [0, 0, 0.2], paint.orange, 0.03));
  return {root, set() {}};
}

function as_ghost(robot) {
  robot.root.scale.setScalar(1.01);  // not in the surfaces of the other one
  robot.root.traverse((part) => { if (part.isMesh) { part.material = ghost; part.castShadow = false; } });
  return robot;
}

/** Half axes and direction of the ellipse within which the platform is with 95 %. */
export function ellipse(xx, xy, yy) {
  const middle = (xx + yy) / 2, spread = Math.hypot((xx - yy) / 2, xy);
  return {a: kEllipse * Math.sqrt(Math.max(0, middle + spread)), b: kEllipse * Math.sqrt(Math.max(0, middle - spread)), angle: Math.atan2(2 * xy, xx - yy) / 2};
}

export class Platform {
  /** @param urdf  of its model, may be missing */
  constructor(description, urdf) {
    this.name = description.name;
    this.root = new Group();
    this.robot = body(urdf);
    this.truth = as_ghost(body(urdf));
    this.ways = {
      estimate: null,  // its columns are known with the first row
      truth: new Way({colour: kColours.truth, width: 0.012, z: 0.004}, 1),
    };
    this.reference = new Ribbon({colour: kColours.plan, width: 0.03, z: 0.006});
    this.horizon = new Ribbon({colour: kColours.horizon, width: 0.014, z: 0.007});
    this.ellipses = [1, 10].map((times) => ({times, ribbon: new Ribbon({colour: kColours.estimate, width: 0.002 * times ** 0.6, z: 0.01, over: true})}));
    this.plan = new Plan(kColours);
    this.root.add(this.robot.root, this.truth.root, this.plan.root, ...[this.ways.truth.ribbon, this.reference, this.horizon, ...this.ellipses.map((e) => e.ribbon)].map((r) => r.mesh));
    this.robot.root.visible = this.truth.root.visible = false;
  }
  get place() { return this.robot.root; }
  show(history, t) {
    const column = history.platform_column, track = history.tracks.get(this.name), [truth, telemetry, plan, fragment] = ['truth', 'telemetry', 'plan', 'fragment'].map((kind) => history.tracks.get(`${kind}:${this.name}`));
    const q = new Float64Array(4);
    if (track && !this.ways.estimate) {
      this.ways.estimate = new Way({colour: kColours.estimate, width: 0.02, z: 0.003}, column.x);
      this.root.add(this.ways.estimate.ribbon.mesh);
    }
    if (track?.mix(t, column.th0, 4, q)) { this.robot.set(q); this.truth.set(q); }
    const row = track ? track.find(t) : -1;
    this.stand(this.robot.root, track, t, column.x);
    this.stand(this.truth.root, truth, t, 1);
    this.ways.estimate?.show(track, t);
    this.ways.truth.show(truth, t);
    this.show_intent(telemetry, row < 0 ? -1 : telemetry?.find(track.at(row, column.sent)) ?? -1);
    this.show_ellipses(track, row, column);
    this.plan.show(plan, fragment, t);
  }
  stand(root, track, t, from) {
    const p = track?.pose(t, from);
    root.visible = Boolean(p);
    if (!p) return;
    root.position.set(p[0], p[1], 0);
    root.rotation.z = p[2];
  }
  show_intent(telemetry, row) {
    [this.reference, this.horizon].forEach((ribbon, which) => {
      ribbon.clear();
      for (let k = 0; row >= 0 && k < kPoints; ++k) ribbon.add(...[0, 1, 2].map((n) => telemetry.at(row, 1 + 3 * (which * kPoints + k) + n)));
      ribbon.show(kPoints);
    });
  }
  show_ellipses(track, row, column) {
    for (const {times, ribbon} of this.ellipses) {
      ribbon.clear();
      if (row < 0) { ribbon.show(0); continue; }
      const {a, b, angle} = ellipse(...[0, 1, 2].map((k) => track.at(row, column.xx + k))), {x, y} = this.robot.root.position;
      for (let k = 0; k <= 48; ++k) {
        const u = (k * Math.PI) / 24, along = times * a * Math.cos(u), across = times * b * Math.sin(u);
        ribbon.add(x + along * Math.cos(angle) - across * Math.sin(angle), y + along * Math.sin(angle) + across * Math.cos(angle), angle + Math.atan2(b * Math.cos(u), -a * Math.sin(u)));
      }
      ribbon.show(49);
    }
  }
}
