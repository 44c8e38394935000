// A line on the floor that is wide enough to be seen from afar.
import {BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshBasicMaterial} from '../vendor/three.js';

export class Ribbon {
  /** @param look  {colour, width [m], z: height [m], over: whether nothing hides it} */
  constructor({colour, width, z, over = false}) {
    Object.assign(this, {half: width / 2, z, count: 0});
    const material = new MeshBasicMaterial({color: colour, side: DoubleSide, toneMapped: false, depthTest: !over, transparent: over});
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;  // it grows
    this.mesh.renderOrder = over ? 1 : 0;
    this.reserve(64);
  }
  reserve(count) {
    const corners = new Float32Array(6 * count), index = new Uint32Array(6 * (count - 1));
    if (this.corners) corners.set(this.corners);
    for (let k = 0; k + 1 < count; ++k) index.set([2 * k, 2 * k + 1, 2 * k + 2, 2 * k + 1, 2 * k + 3, 2 * k + 2], 6 * k);
    this.corners = corners;
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute('position', new BufferAttribute(corners, 3));
    this.mesh.geometry.setIndex(new BufferAttribute(index, 1));
  }
  clear() { this.count = 0; this.last = null; }
  /** Goes on. @param phi  direction of the line there [rad] */
  add(x, y, phi) {
    if (6 * this.count >= this.corners.length) this.reserve(2 * this.count);
    const across = [-this.half * Math.sin(phi), this.half * Math.cos(phi)];
    this.corners.set([x + across[0], y + across[1], this.z, x - across[0], y - across[1], this.z], 6 * this.count++);
    this.last = [x, y];
    this.mesh.geometry.attributes.position.needsUpdate = true;
  }
  /** Ends the line. @param x, y  where another one begins */
  lift(x, y) {
    const width = this.half;
    this.half = 0;
    for (const [at_x, at_y] of [this.last || [x, y], [x, y]]) this.add(at_x, at_y, 0);
    this.half = width;
  }
  /** @param points  that are visible, the first ones */
  show(points) { this.mesh.geometry.setDrawRange(0, 6 * Math.max(0, Math.min(points, this.count) - 1)); }
}
