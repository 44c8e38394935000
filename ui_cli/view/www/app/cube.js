// The cube of 57 mm with its layers: 27 small ones, of which those of a layer turn together.
import {Group, Matrix4, Mesh, MeshStandardMaterial, RoundedBoxGeometry, Vector3} from '../vendor/three.js';

const kSize = 0.057, kCell = kSize / 3;

// Columns of the cube's track.
const kAxis = 1, kAngle = 2, kPlace = 4, kFaces = 16;

// U R F D L B: colour, and the directions out of the face, to the right and up as its stickers are written, in the cube's frame (x out of R,
// y out of B, z out of U).
const faces = [
  [0xf4f4f2, [0, 0, 1], [1, 0, 0], [0, 1, 0]], [0xc41e3a, [1, 0, 0], [0, 1, 0], [0, 0, 1]], [0x009b48, [0, -1, 0], [1, 0, 0], [0, 0, 1]],
  [0xffd500, [0, 0, -1], [1, 0, 0], [0, -1, 0]], [0xff6a13, [-1, 0, 0], [0, -1, 0], [0, 0, 1]], [0x0051ba, [0, 1, 0], [-1, 0, 0], [0, 0, 1]],
].map(([colour, out, right, up]) => ({
  paint: new MeshStandardMaterial({color: colour, roughness: 0.35}), out: new Vector3(...out), right: new Vector3(...right), up: new Vector3(...up),
}));
const body = new MeshStandardMaterial({color: 0x15181c, roughness: 0.4});
const axes = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];

/** @return nine numbers of faces, of a number to the base 6 */
function unpacked(number) {
  const stickers = [];
  for (let k = 0; k < 9; ++k, number = Math.floor(number / 6)) stickers.unshift(number % 6);
  return stickers;
}

export class Cube {
  constructor() {
    this.group = new Group();
    this.parts = new Map();
    this.stickers = [];
    this.row = -1;
    const block = new RoundedBoxGeometry(0.985 * kCell, 0.985 * kCell, 0.985 * kCell, 2, 0.0012);
    for (const x of [-1, 0, 1]) for (const y of [-1, 0, 1]) for (const z of [-1, 0, 1]) this.add_part([x, y, z], block);
    const sticker = new RoundedBoxGeometry(0.86 * kCell, 0.86 * kCell, 0.001, 2, 0.0004);
    for (const face of faces) for (let k = 0; k < 9; ++k) this.stickers.push(this.add_sticker(face, k, sticker));
  }
  add_part(seat, block) {
    const part = new Group(), mesh = new Mesh(block, body);
    mesh.castShadow = mesh.receiveShadow = true;
    part.add(mesh);
    part.matrixAutoUpdate = false;
    part.matrix.makeTranslation(...seat.map((s) => s * kCell));
    this.group.add(part);
    this.parts.set(seat.join(), {seat, part});
  }
  add_sticker({paint, out, right, up}, number, shape) {
    const at = out.clone().addScaledVector(right, (number % 3) - 1).addScaledVector(up, 1 - Math.floor(number / 3));
    const mesh = new Mesh(shape, paint);
    mesh.position.copy(out).multiplyScalar(kCell / 2 + 0.0002);
    mesh.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(right, up, out));
    this.parts.get([at.x, at.y, at.z].map(Math.round).join()).part.add(mesh);
    return mesh;
  }
  /** Where it is while nobody tells: in a hand. */
  rest_in(entry) {
    if (!entry?.robot) return;
    this.group.position.z = entry.arm.fingers === 'two_layers' ? 0.0095 : 0.019;
    entry.tool.group.add(this.group);
  }
  /** @return where it is in the world */
  place() { this.group.updateWorldMatrix(true, false); return new Vector3().setFromMatrixPosition(this.group.matrixWorld); }
  /** @param world  in whose frame it is told where the cube is */
  show(track, t, world) {
    const row = track ? track.find(t) : -1;
    if (row < 0) return;
    if (this.group.parent !== world) {
      world.add(this.group);
      this.group.matrixAutoUpdate = false;
    }
    const n = track.mix(t, kPlace, 12, new Float64Array(12));
    this.group.matrix.set(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], 0, 0, 0, 1);
    if (row === this.row) return;
    this.row = row;
    // A turn beyond 45 degrees is one of another state: angles are never mixed.
    this.turn(track.at(row, kAxis), [track.at(row, kAngle), track.at(row, kAngle + 1)]);
    faces.forEach((_, face) => unpacked(track.at(row, kFaces + face)).forEach((colour, k) => {
      this.stickers[9 * face + k].material = faces[colour].paint;
    }));
  }
  turn(axis, [positive, negative]) {
    const turned = {1: new Matrix4().makeRotationAxis(axes[axis], positive), '-1': new Matrix4().makeRotationAxis(axes[axis], -negative)};
    for (const {seat, part} of this.parts.values()) {
      part.matrix.makeTranslation(...seat.map((s) => s * kCell));
      const layer = turned[seat[axis]];
      if (layer) part.matrix.premultiply(layer);
    }
  }
}
