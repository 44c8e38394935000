// The room in which platforms drive: its walls and what stands in it.
import {BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, PlaneGeometry} from '../vendor/three.js';
import {block} from './furniture.js';

const kWall = 0.25, kThick = 0.06, kObstacle = 0.5, kBox = 0.35;
const plaster = new MeshStandardMaterial({color: 0xc3c8cf, roughness: 0.9});
const carton = new MeshStandardMaterial({color: 0xc99b5f, roughness: 0.85});
const crate = new MeshStandardMaterial({color: 0xb59f7e, roughness: 0.8, side: DoubleSide, flatShading: true});

/** An upright prism. @param corners  of a convex polygon, [[x, y]] */
function prism(corners, height) {
  const points = [], n = corners.length;
  for (let k = 0; k < n; ++k) {
    const a = corners[k], b = corners[(k + 1) % n];
    points.push(...a, 0, ...b, 0, ...b, height, ...a, 0, ...b, height, ...a, height);
    if (k > 0 && k + 1 < n) points.push(...corners[0], height, ...a, height, ...b, height);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, crate);
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

const kSlippery = 0x4a90d9, kGripping = 0x9a6a3a;
/** @return colour of an area whose friction is so many times that of the floor, and how strong it is */
export function ground_colour(scale) { return [scale < 1 ? kSlippery : kGripping, 0.08 + 0.3 * Math.min(1, Math.abs(Math.log2(Math.max(scale, 1e-3))) / 2)]; }

/** A part of the floor with another friction, within the walls. */
function area({lower, upper, scale, from}, walls) {
  const [a, b] = [0, 1].map((k) => Math.max(lower[k], walls.lower[k])), [c, d] = [0, 1].map((k) => Math.min(upper[k], walls.upper[k]));
  const [color, opacity] = ground_colour(scale);
  const mesh = new Mesh(new PlaneGeometry(Math.max(0, c - a), Math.max(0, d - b)), new MeshBasicMaterial({color, opacity, transparent: true, toneMapped: false, depthWrite: false}));
  mesh.position.set((a + c) / 2, (b + d) / 2, 0.0008);
  mesh.userData.from = from;
  return mesh;
}

/** The areas of the floor with another friction. show(t) leaves those that there are at that instant. */
export class Ground {
  constructor(description) {
    this.root = new Group();
    this.root.add(...description.ground.map((each) => area(each, description)));
  }
  show(t) { for (const mesh of this.root.children) mesh.visible = t >= mesh.userData.from; }
}

/** The boxes that platforms push. */
export class Boxes {
  /** @param boxes  [{name, size: along its x and y}] */
  constructor(boxes) {
    this.root = new Group();
    this.all = boxes.map(({name, size}) => ({name, mesh: block([...size, kBox], [0, 0, kBox / 2], carton)}));
    this.root.add(...this.all.map(({mesh}) => mesh));
  }
  show(history, t) {
    for (const {name, mesh} of this.all) {
      const p = history.tracks.get(`box:${name}`)?.pose(t, 1);
      mesh.visible = Boolean(p);
      if (!p) continue;
      mesh.position.set(p[0], p[1], kBox / 2);
      mesh.rotation.z = p[2];
    }
  }
}

/** @param description  {lower, upper: corners of the walls, obstacles: [corners]} */
export function room({lower, upper, obstacles}) {
  const group = new Group(), [x, y] = [0, 1].map((k) => (lower[k] + upper[k]) / 2), [length, width] = [0, 1].map((k) => upper[k] - lower[k]);
  for (const side of [-1, 1]) {
    group.add(block([length + 2 * kThick, kThick, kWall], [x, y + (side * (width + kThick)) / 2, kWall / 2], plaster));
    group.add(block([kThick, width, kWall], [x + (side * (length + kThick)) / 2, y, kWall / 2], plaster));
  }
  group.add(...obstacles.map((corners) => prism(corners, kObstacle)));
  return group;
}
