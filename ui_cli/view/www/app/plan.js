// What a platform is to do, on the floor: the points of its plans with their orientations, and the fragments it was handed.
import {BufferAttribute, BufferGeometry, Group, Mesh, MeshBasicMaterial} from '../vendor/three.js';
import {Ribbon} from './ribbon.js';

const kMostMarks = 1000, kMostFragments = 2000;  // that are drawn
const kKnots = 33, kFirstKnot = 4;               // of a fragment, and its column
const kSamePlace = 0.02;                         // of a point and the end of a fragment [m]

/** A disc with a nose along x. */
function drop(radius) {
  const corners = [0, 0, 0], index = [], rim = 32, nose = Math.acos(1 / 2);
  for (let k = 0; k < rim; ++k) {
    const u = nose + (k * 2 * (Math.PI - nose)) / (rim - 1);
    corners.push(radius * Math.cos(u), radius * Math.sin(u), 0);
  }
  corners.push(2 * radius, 0, 0);
  for (let k = 1; k <= rim + 1; ++k) index.push(0, k, k > rim ? 1 : k + 1);
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(corners), 3));
  geometry.setIndex(index);
  return geometry;
}

/** The points of all plans; those of the plan at an instant stand out. */
class Marks {
  constructor({plan, other}) {
    this.group = new Group();
    this.shape = drop(0.045);
    [this.now, this.other] = [plan, other].map((color) => new MeshBasicMaterial({color, toneMapped: false}));
    this.list = [];  // {mesh, number, phi: between its neighbours, ends: [row of a fragment that ends there, its orientation]}
  }
  extend(plan) {
    const from = this.list.length, until = plan ? Math.min(plan.rows, kMostMarks) : 0;
    for (let row = from; row < until; ++row) {
      const mesh = new Mesh(this.shape, this.other), [x, y] = [2, 3].map((k) => plan.at(row, k));
      mesh.position.set(x, y, 0.005);
      this.group.add(mesh);
      this.list.push({mesh, x, y, number: plan.at(row, 1), phi: 0, ends: []});
    }
    for (let k = Math.max(0, from - 1); from < until && k < until; ++k) this.list[k].phi = this.direction(k);
  }
  direction(k) {
    const [a, b] = [this.list[Math.max(0, k - 1)], this.list[Math.min(k + 1, this.list.length - 1)]];
    return Math.atan2(b.y - a.y, b.x - a.x);
  }
  /** Notes where a fragment ends. @param row  of the fragment */
  end(row, [x, y, phi]) {
    for (const mark of this.list) if (Math.hypot(mark.x - x, mark.y - y) < kSamePlace) mark.ends.push([row, phi]);
  }
  /** @param number  of the plan that is driven  @param row  of the fragment handed over last, -1 for none */
  show(number, row) {
    for (const mark of this.list) {
      const now = mark.number === number;
      mark.mesh.material = now ? this.now : this.other;
      mark.mesh.position.z = now ? 0.0055 : 0.005;
      mark.mesh.rotation.z = mark.ends.findLast(([ended]) => ended <= row)?.[1] ?? mark.phi;
    }
  }
}

/** The fragments, one after the other in two shades. */
class Fragments {
  constructor(colours) {
    this.ribbons = colours.map((colour) => new Ribbon({colour, width: 0.034, z: 0.0025}));
    this.points = [];  // in each ribbon after a fragment
  }
  /** @param ended  called with each new fragment's row and the pose at its end */
  extend(track, ended) {
    for (let row = this.points.length; track && row < Math.min(track.rows, kMostFragments); ++row) {
      const knot = (k) => [0, 1, 2].map((n) => track.at(row, kFirstKnot + 3 * k + n)), ribbon = this.ribbons[row % 2];
      ribbon.lift(...knot(0).slice(0, 2));
      for (let k = 0; k < kKnots; ++k) ribbon.add(...knot(k));
      this.points.push(this.ribbons.map((r) => r.count));
      ended(row, knot(kKnots - 1));
    }
  }
  show(row) { this.ribbons.forEach((ribbon, k) => ribbon.show(row < 0 ? 0 : this.points[Math.min(row, this.points.length - 1)][k])); }
}

export class Plan {
  /** @param colours  {plan, other: of points, fragments: two} */
  constructor(colours) {
    this.marks = new Marks(colours);
    this.fragments = new Fragments(colours.fragments);
    this.root = new Group();
    this.root.add(this.marks.group, ...this.fragments.ribbons.map((r) => r.mesh));
  }
  /** @param plan, fragment  tracks, may be missing */
  show(plan, fragment, t) {
    this.marks.extend(plan);
    this.fragments.extend(fragment, (row, pose) => this.marks.end(row, pose));
    const now = plan ? plan.find(t) : -1, handed = fragment ? fragment.find(t) : -1;
    this.marks.show(now < 0 ? 0 : plan.at(now, 1), handed);
    this.fragments.show(handed);
  }
}
