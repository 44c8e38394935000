// The work cell in three dimensions.
import {
  AxesHelper, Color, DirectionalLight, Fog, GridHelper, Group, HemisphereLight, Mesh, MeshStandardMaterial, NeutralToneMapping, Object3D,
  OrbitControls, PCFShadowMap, PerspectiveCamera, PlaneGeometry, Scene, Vector3, WebGLRenderer,
} from '../vendor/three.js';
import {Body} from './body.js';
import {Cube} from './cube.js';
import {object, put, table, tool} from './furniture.js';
import {Sheet} from './ink.js';
import {Platform} from './platform.js';
import {Robot} from './robot.js';
import {Boxes, Ground, room} from './room.js';
import {theme} from './theme.js';

Object3D.DEFAULT_UP.set(0, 0, 1);

/** @return whether this browser draws without a graphics card: what is dear is left out then */
function draws_in_software() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** Takes the graphics memory of everything below back. */
function dispose(root) {
  root.traverse((part) => {
    part.geometry?.dispose();
    part.material?.map?.dispose();
  });
}

export class Cell {
  constructor(canvas) {
    this.canvas = canvas;
    this.slow = draws_in_software();
    this.renderer = new WebGLRenderer({canvas, antialias: !this.slow});
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.toneMapping = NeutralToneMapping;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(38, 1, 0.05, 60);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.maxPolarAngle = 0.53 * Math.PI;
    this.orbit.minDistance = 0.15;
    this.orbit.addEventListener('change', () => { this.dirty = true; });
    this.light();
    this.reach_out(1);
    this.things = new Group();
    this.scene.add(this.things);
    this.arms = new Map();
    this.platforms = new Map();
    this.dirty = true;
    this.recolour();
  }
  light() {
    this.sky = new HemisphereLight(0xffffff, 0x8f959e, 1.5);
    this.sun = new DirectionalLight(0xffffff, 2.4);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(...(this.slow ? [1024, 1024] : [2048, 2048]));
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.normalBias = 0.01;
    this.floor = new Mesh(new PlaneGeometry(60, 60), new MeshStandardMaterial({roughness: 0.95}));
    this.floor.receiveShadow = true;
    this.scene.add(this.sky, this.sun, this.sun.target, this.floor);
  }
  /** @param times  how much farther than over the usual cell light and sight go */
  reach_out(times) {
    this.reach = times;
    const half = 2.6 * times;
    Object.assign(this.sun.shadow.camera, {left: -half, right: half, top: half, bottom: -half, near: 0.5, far: 12 * times});
    this.sun.shadow.camera.updateProjectionMatrix();
    this.orbit.maxDistance = 14 * times;
    this.camera.far = 60 * times;
    this.camera.updateProjectionMatrix();
    this.floor.scale.set(times, times, 1);
  }
  recolour() {
    this.scene.background = new Color(theme.sky);
    this.scene.fog = new Fog(theme.sky, 7 * this.reach, 18 * this.reach);
    this.floor.material.color.set(theme.floor);
    this.sky.intensity = theme.dark ? 0.9 : 1.5;
    if (this.grid) { this.scene.remove(this.grid); dispose(this.grid); }
    this.grid = new GridHelper(20, 40, theme.line, theme.line);
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = 0.001;
    this.scene.add(this.grid);
    this.dirty = true;
  }
  /** Builds another cell. @param descriptions  URDF texts by model */
  build(scene, descriptions) {
    this.scene.remove(this.things);
    dispose(this.things);
    this.things = new Group();
    this.scene.add(this.things);
    this.arms.clear();
    this.belt = scene.arms.find((arm) => arm.belt);
    for (const arm of scene.arms) this.add_arm(arm, scene, descriptions);
    this.add_platforms(scene, descriptions);
    const home = this.arms.get(scene.object.arm);
    this.object = scene.object.kind === 'none' || !home ? null : object(scene.object);
    if (this.object) home.base.add(this.object);
    this.cube = scene.cube.held_by ? new Cube() : null;
    if (this.cube) this.cube.rest_in(this.arms.get(scene.cube.held_by));
    this.body = scene.body.shape === 'none' ? null : new Body(scene.body);
    if (this.body) this.things.add(this.body.root);
    this.look('cell');
  }
  add_platforms(scene, descriptions) {
    this.platforms.clear();
    this.followed = null;
    this.room = scene.room;
    this.ground = this.room ? new Ground(this.room) : null;
    this.boxes = this.room ? new Boxes(this.room.boxes) : null;
    if (this.room) this.things.add(room(this.room), this.ground.root, this.boxes.root);
    this.reach_out(this.room ? Math.max(1, this.room_size() / 5) : 1);
    this.recolour();
    for (const description of scene.platforms) {
      const platform = new Platform(description, descriptions[description.model]);
      this.platforms.set(description.name, platform);
      this.things.add(platform.root);
    }
  }
  room_size() { return Math.hypot(...[0, 1].map((k) => this.room.upper[k] - this.room.lower[k])); }
  add_arm(arm, scene, descriptions) {
    const base = put(new Group(), arm.place), sheet = new Sheet(arm.paper);
    const {group, texture} = table(arm, sheet, -arm.place[2], this.belt);
    if (!arm.belt) base.add(group);
    const entry = {arm, base, sheet, texture, group, mark: new AxesHelper(0.08)};
    entry.tool = tool(arm);
    if (descriptions[arm.model]) {
      entry.robot = new Robot(descriptions[arm.model]);
      base.add(entry.robot.root);
      entry.robot.links.get('tool').add(entry.tool.group);
      entry.robot.root.visible = false;  // until it has told where it is
    }
    entry.tool.group.add(entry.mark);
    this.things.add(base);
    this.arms.set(arm.name, entry);
  }
  /** Moves everything to an instant. */
  show(history, t) {
    const q = new Float64Array(8), gap = [0], column = history.column;
    const belt = this.belt && history.tracks.get(this.belt.name), way = [0];
    for (const [name, entry] of this.arms) {
      const track = history.tracks.get(name);
      const known = track && track.mix(t, column.q0, 8, q);
      if (entry.robot) entry.robot.root.visible = Boolean(known);
      if (known && entry.robot) entry.robot.set(q);
      if (known) entry.tool.open(track.mix(t, column.gap, 1, gap)[0]);
      if (entry.arm.belt) continue;
      if (belt?.mix(t, column.q0, 1, way)) entry.group.position.y = entry.arm.paper.place[1] + way[0];  // bases stand as the world
      if (entry.sheet.show(track, column, t, belt)) entry.texture.needsUpdate = true;
    }
    for (const platform of this.platforms.values()) platform.show(history, t);
    this.ground?.show(t);
    this.boxes?.show(history, t);
    this.show_object(history.tracks.get('object'), t);
    this.cube?.show(history.tracks.get('cube'), t, this.things);
    this.body?.show(history.tracks.get('body'), t);
    this.follow();
    this.dirty = true;
  }
  show_object(track, t) {
    const row = track ? track.find(t) : -1;
    if (!this.object) return;
    this.object.visible = row >= 0 && track.at(row, 1) > 0;
    if (!this.object.visible) return;
    const n = track.mix(t, 3, 12, new Float64Array(12));
    this.object.matrix.set(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9], n[10], n[11], 0, 0, 0, 1);
  }
  /** @param view  'cell', 'cube', 'top', or the name of an arm, or of a platform, with which the view goes from then on */
  look(view) {
    this.followed = this.platforms.get(view)?.place;
    if (view === 'cube' && this.cube) return this.look_at(this.cube.place(), new Vector3(0.3, -0.14, 0.16));
    if (this.followed) return this.look_after(this.followed);
    if (this.room && !this.arms.size) return this.look_into_room(view === 'top');
    const bases = [...this.arms.values()].filter((e) => !e.arm.belt).map((e) => e.base.position);
    const middle = bases.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(bases.length || 1);
    const spread = bases.length > 1 ? bases[0].distanceTo(bases[bases.length - 1]) : 0;
    const at = this.arms.get(view);
    const [target, from] = at
      ? [at.base.localToWorld(new Vector3(at.arm.paper.place[0] - 0.02, 0, at.arm.paper.place[2] + 0.06)), new Vector3(0.62, -0.62, 0.5)]
      : view === 'top' ? [middle.clone().add(new Vector3(0.5, 0, 0.6)), new Vector3(0.01, 0, 3.4 + spread)]
        : [middle.clone().add(new Vector3(0.42, 0, 0.82)), new Vector3(2.5, -1.35, 1.15).multiplyScalar(1 + 0.42 * spread / 2.1)];
    this.look_at(target, from);
    this.sun.target.position.copy(middle).setX(middle.x + 0.4);
    this.sun.position.copy(this.sun.target.position).add(new Vector3(1.8, -2.2, 4.5));
    this.dirty = true;
  }
  /** From behind a platform, to the left. */
  look_after(place) {
    const phi = place.rotation.z + Math.PI - 0.5;
    this.look_at(place.position.clone().setZ(0.2), new Vector3(2 * Math.cos(phi), 2 * Math.sin(phi), 1.2));
  }
  /** Goes with the platform that is looked after. */
  follow() {
    if (!this.followed) return;
    const way = this.followed.position.clone().setZ(this.orbit.target.z).sub(this.orbit.target);
    this.orbit.target.add(way);
    this.camera.position.add(way);
    this.orbit.update();
  }
  look_into_room(from_above) {
    const {lower, upper} = this.room, size = this.room_size();
    const middle = new Vector3((lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, 0);
    this.look_at(middle, from_above ? new Vector3(0, -0.01, size) : new Vector3(-0.2, -0.86, 0.76).multiplyScalar(size));
    this.sun.target.position.copy(middle);
    this.sun.position.copy(middle).add(new Vector3(1.8, -2.2, 4.5).multiplyScalar(this.reach));
  }
  look_at(target, from) {
    this.orbit.target.copy(target);
    this.camera.position.copy(target).add(from);
    this.orbit.update();
    this.dirty = true;
  }
  render() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width !== this.width || height !== this.height) {
      [this.width, this.height] = [width, height];
      this.renderer.setPixelRatio(this.slow ? 1 : Math.min(devicePixelRatio || 1, 2));
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / Math.max(1, height);
      this.camera.updateProjectionMatrix();
      this.dirty = true;
    }
    if (!this.dirty) return;
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
  }
}
