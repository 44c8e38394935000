// What stands in the cell besides the arms: floor, tables, sheets, plates, what the cameras look for.
import {
  BoxGeometry, CanvasTexture, CylinderGeometry, Group, Mesh, MeshStandardMaterial, PlaneGeometry, RoundedBoxGeometry, SRGBColorSpace,
  Vector3,
} from '../vendor/three.js';
import {paint} from './robot.js';

const wood = new MeshStandardMaterial({color: 0xc8b79f, roughness: 0.7});
const leg = new MeshStandardMaterial({color: 0x7d8590, roughness: 0.6});

/** Position and angle times axis. */
export function put(object, [x, y, z, ax, ay, az]) {
  const axis = new Vector3(ax, ay, az), angle = axis.length();
  object.position.set(x, y, z);
  object.quaternion.setFromAxisAngle(angle > 0 ? axis.divideScalar(angle) : new Vector3(0, 0, 1), angle);
  return object;
}

export function block(size, at, material, radius = 0) {
  const mesh = new Mesh(radius ? new RoundedBoxGeometry(...size, 3, radius) : new BoxGeometry(...size), material);
  mesh.position.set(...at);
  mesh.castShadow = mesh.receiveShadow = true;
  return mesh;
}

/** Table, sheet and plate in front of an arm, in the arm's base. @param floor  height of the floor there @param belt  the sheet lies on it, and not on a table */
export function table(arm, sheet, floor, belt) {
  const group = put(new Group(), arm.paper.place);
  const edge = 0.6, thick = 0.05, tall = arm.paper.place[2] - floor - thick;
  if (!belt) {
    group.add(block([edge, edge, thick], [0, 0, -thick / 2 - 0.001], wood, 0.012));
    for (const x of [-0.25, 0.25])
      for (const y of [-0.25, 0.25]) group.add(block([0.05, 0.05, tall], [x, y, -thick - tall / 2], leg));
  }
  const texture = new CanvasTexture(sheet.canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 4;
  const paper = new Mesh(new PlaneGeometry(arm.paper.size, arm.paper.size), new MeshStandardMaterial({map: texture, roughness: 0.9}));
  paper.receiveShadow = true;
  if (belt) paper.position.z = 0.0005;  // above its board
  group.add(paper);
  if (arm.plate.shape !== 'none') {
    const [length, width, thickness] = arm.plate.size, at = [0, arm.plate.distance, thickness / 2];
    if (arm.plate.shape === 'ellipse') {
      const mesh = new Mesh(new CylinderGeometry(0.5, 0.5, 1, 64).rotateX(Math.PI / 2), paint.steel);
      mesh.scale.set(length, width, thickness);
      mesh.position.set(...at);
      mesh.castShadow = true;
      group.add(mesh);
    } else {
      group.add(block([length, width, thickness], at, paint.steel));
    }
  }
  return {group, texture};
}

/** A pen, a palm, or a hand with two jaws, in E. @return {group, open(gap)} */
export function tool(arm) {
  const group = put(new Group(), arm.tool);
  if (arm.belt) return {group, open() {}};
  if (arm.palm) {
    group.add(block([0.14, 0.14, 0.02], [0, 0, -0.01], paint.dark, 0.004));
    return {group, open() {}};
  }
  if (arm.gripper === 'none') {
    const tip = new Mesh(new CylinderGeometry(0.009, 0.0015, 0.03, 24).rotateX(Math.PI / 2), paint.steel);
    tip.position.z = -0.015;
    tip.castShadow = true;
    group.add(tip);
    return {group, open() {}};
  }
  group.add(block([0.05, 0.15, 0.03], [0, 0, -0.075], paint.dark, 0.006));
  const long = arm.fingers === 'two_layers' ? 0.07 : 0.06;
  const jaws = [-1, 1].map((side) => block([0.05, 0.012, long], [0, side * 0.05, 0.012 - long / 2], paint.steel, 0.003));
  group.add(...jaws);
  return {group, open(gap) { jaws.forEach((jaw, k) => { jaw.position.y = (k ? 0.5 : -0.5) * (gap + 0.012); }); }};
}

function board_texture({kind, size, square}) {
  const canvas = document.createElement('canvas'), scale = 40 / square;
  canvas.width = size[0] * scale;
  canvas.height = size[1] * scale;
  const c = canvas.getContext('2d');
  c.fillStyle = '#fafafa';
  c.fillRect(0, 0, canvas.width, canvas.height);
  c.fillStyle = '#14171b';
  if (kind === 'apriltag') {
    const edge = square * scale, at = (canvas.width - edge) / 2, part = edge / 8;
    c.fillRect(at, at, edge, edge);
    c.fillStyle = '#fafafa';
    for (let k = 0; k < 36; ++k)
      if ((k * 7919 + 13) % 5 < 2) c.fillRect(at + (1 + (k % 6)) * part, at + (1 + Math.floor(k / 6)) * part, part, part);
  } else {
    for (let x = 1; x + 1 < canvas.width / 40; ++x)
      for (let y = 1; y + 1 < canvas.height / 40; ++y) if ((x + y) % 2) c.fillRect(40 * x, 40 * y, 40, 40);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

/** What the cameras look for: its frame is in the middle of the plate's upper side. */
export function object(description) {
  const group = new Group(), [length, width, thick] = description.size;
  group.add(block([length, width, thick], [0, 0, -thick / 2 - 0.0005], leg));
  const face = new Mesh(new PlaneGeometry(length, width), new MeshStandardMaterial({map: board_texture(description), roughness: 0.8}));
  face.receiveShadow = true;
  group.add(face);
  group.visible = false;
  group.matrixAutoUpdate = false;
  return group;
}
