// A body that belongs to no robot, and the pedestal on which it stands at the beginning.
import {BoxGeometry, CanvasTexture, Group, Mesh, MeshStandardMaterial, SphereGeometry, SRGBColorSpace} from '../vendor/three.js';
import {block} from './furniture.js';

const kThick = 0.03, kEdge = 0.12, kPost = 0.08;
const wood = new MeshStandardMaterial({color: 0x8a9099, roughness: 0.8});

/** Stripes by which one sees it turn. */
function stripes() {
  const canvas = document.createElement('canvas');
  canvas.width = 256;
  canvas.height = 128;
  const c = canvas.getContext('2d');
  c.fillStyle = '#d9722e';
  c.fillRect(0, 0, 256, 128);
  c.fillStyle = '#f3e2c7';
  for (let k = 0; k < 4; ++k) c.fillRect(64 * k, 0, 18, 128);
  c.fillRect(0, 56, 256, 16);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

export class Body {
  /** @param description  {shape, size, pedestal: middle of its upper side in the world} */
  constructor({shape, size, pedestal: [x, y, z]}) {
    this.root = new Group();
    const geometry = shape === 'ball' ? new SphereGeometry(size / 2, 48, 32) : new BoxGeometry(size, size, size);
    this.mesh = new Mesh(geometry, new MeshStandardMaterial({map: stripes(), roughness: 0.6}));
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.mesh.position.set(x, y, z + size / 2);
    const post = z - kThick;
    this.root.add(this.mesh, block([kEdge, kEdge, kThick], [x, y, z - kThick / 2], wood), block([kPost, kPost, post], [x, y, post / 2], wood));
  }
  show(track, t) {
    if (!track || track.find(t) < 0) return;
    this.mesh.matrixAutoUpdate = false;
    const n = track.mix(t, 1, 12, new Float64Array(12));
    this.mesh.matrix.set(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], 0, 0, 0, 1);
  }
}
