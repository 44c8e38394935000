// A robot from its URDF: the boxes and cylinders of its links, moved by its joints.
import {BoxGeometry, CylinderGeometry, Group, Mesh, MeshStandardMaterial, Quaternion, RoundedBoxGeometry, Vector3} from '../vendor/three.js';

const kDark = new Set(['base', 'track', 'carriage', 'wrist', 'tool', 'wrist_body', 'mast']);
const kWheel = /^(front|rear)_(left|right)$/;
export const paint = {
  orange: new MeshStandardMaterial({color: 0xe8702a, roughness: 0.45, metalness: 0.08}),
  dark: new MeshStandardMaterial({color: 0x4b535e, roughness: 0.6}),
  steel: new MeshStandardMaterial({color: 0xb9c0ca, roughness: 0.35, metalness: 0.15}),
};

const numbers = (text, fallback) => (text || fallback).trim().split(/\s+/).map(Number);

/** Rolls, pitches, yaws about fixed axes, as URDF has them. */
function place(object, origin) {
  if (!origin) return;
  object.position.set(...numbers(origin.getAttribute('xyz'), '0 0 0'));
  const [r, p, y] = numbers(origin.getAttribute('rpy'), '0 0 0');
  object.rotation.set(r, p, y, 'ZYX');
}

function solid(geometry) {
  const box = geometry.querySelector('box'), cylinder = geometry.querySelector('cylinder');
  if (box) {
    const size = numbers(box.getAttribute('size'));
    return new RoundedBoxGeometry(...size, 4, 0.22 * Math.min(...size, 0.16));
  }
  if (!cylinder) return new BoxGeometry(0.01, 0.01, 0.01);
  const radius = Number(cylinder.getAttribute('radius'));
  return new CylinderGeometry(radius, radius, Number(cylinder.getAttribute('length')), 40).rotateX(Math.PI / 2);
}

function link_group(element) {
  const group = new Group();
  group.name = element.getAttribute('name');
  for (const visual of element.querySelectorAll(':scope > visual')) {
    const tyre = kWheel.test(group.name) && visual.querySelector('cylinder');
    const mesh = new Mesh(solid(visual.querySelector('geometry')), tyre || kDark.has(group.name) ? paint.dark : paint.orange);
    place(mesh, visual.querySelector('origin'));
    mesh.castShadow = mesh.receiveShadow = true;
    group.add(mesh);
  }
  return group;
}

/** The drum of a joint between two links: shows where an arm bends. */
function drum(joint, axis, child) {
  const box = child.querySelector('visual box');
  if (!box || Math.abs(axis.z) > 0.5) return;
  const [, width, height] = numbers(box.getAttribute('size'));
  const mesh = new Mesh(new CylinderGeometry(0.62 * height, 0.62 * height, 1.16 * width, 40), paint.dark);
  mesh.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), axis);
  mesh.castShadow = true;
  joint.add(mesh);
}

export class Robot {
  /** @param urdf  its text */
  constructor(urdf) {
    const xml = new DOMParser().parseFromString(urdf, 'application/xml').documentElement;
    this.links = new Map();
    this.joints = [];
    const elements = new Map();
    for (const link of xml.querySelectorAll(':scope > link')) {
      this.links.set(link.getAttribute('name'), link_group(link));
      elements.set(link.getAttribute('name'), link);
    }
    const children = new Set();
    for (const element of xml.querySelectorAll(':scope > joint')) {
      const [parent, child] = ['parent', 'child'].map((n) => element.querySelector(n).getAttribute('link'));
      const joint = new Group(), moved = this.links.get(child);
      place(joint, element.querySelector('origin'));
      joint.add(moved);
      this.links.get(parent).add(joint);
      children.add(child);
      const type = element.getAttribute('type');
      if (type === 'fixed') continue;
      const axis = new Vector3(...numbers(element.querySelector('axis')?.getAttribute('xyz'), '1 0 0')).normalize();
      if (type === 'revolute') drum(joint, axis, elements.get(child));
      this.joints.push({moved, axis, slides: type === 'prismatic'});
    }
    this.root = [...this.links.entries()].find(([name]) => !children.has(name))[1];
  }
  /** @param q  joints [rad], of a slide [m], in the order of the description */
  set(q) {
    const turn = new Quaternion();
    this.joints.forEach(({moved, axis, slides}, k) => {
      if (slides) moved.position.copy(axis).multiplyScalar(q[k]);
      else moved.quaternion.copy(turn.setFromAxisAngle(axis, q[k]));
    });
  }
}
