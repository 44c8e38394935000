// The room in which platforms drive: its walls and what stands in it.
import {BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshStandardMaterial} from '../vendor/three.js';
import {block} from './furniture.js';

const kWall = 0.25, kThick = 0.06, kObstacle = 0.5;
const plaster = new MeshStandardMaterial({color: 0xc3c8cf, roughness: 0.9});
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
