// Everything that the viewer has told so far: the page can go back to any instant of it.

/** A table of numbers that grows; its first column is the time [s]. */
export class Track {
  constructor(width) {
    this.width = width;
    this.rows = 0;
    this.data = new Float32Array(width * 1024);
  }
  append(numbers) {
    if (numbers.length % this.width) return;  // of something else that has this name
    const needed = this.rows * this.width + numbers.length;
    if (needed > this.data.length) {
      const larger = new Float32Array(Math.max(needed, 2 * this.data.length));
      larger.set(this.data);
      this.data = larger;
    }
    this.data.set(numbers, this.rows * this.width);
    this.rows += numbers.length / this.width;
  }
  at(row, column) { return this.data[row * this.width + column]; }
  time(row) { return this.data[row * this.width]; }
  get first() { return this.rows ? this.time(0) : 0; }
  get last() { return this.rows ? this.time(this.rows - 1) : 0; }
  /** @return the last row at or before t, -1 when there is none */
  find(t) {
    let low = 0, high = this.rows;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time(middle) <= t) low = middle + 1; else high = middle;
    }
    return low - 1;
  }
  /** Mixes the rows around t. @return columns from..from+count-1 at that instant, or null before the first row */
  mix(t, from, count, into) {
    const row = this.find(t);
    if (row < 0) return null;
    const next = Math.min(row + 1, this.rows - 1);
    const span = this.time(next) - this.time(row);
    const share = span > 0 ? Math.min(1, (t - this.time(row)) / span) : 0;
    for (let k = 0; k < count; ++k) {
      const a = this.at(row, from + k);
      into[k] = a + share * (this.at(next, from + k) - a);
    }
    return into;
  }
  /** @return x, y, phi of columns from.. at that instant, turned the shorter way, or null before the first row */
  pose(t, from) {
    const pose = this.mix(t, from, 3, [0, 0, 0]), row = this.find(t);
    if (!pose) return null;
    const next = Math.min(row + 1, this.rows - 1), span = this.time(next) - this.time(row);
    const phi = this.at(row, from + 2), turn = this.at(next, from + 2) - phi;
    pose[2] = phi + (span > 0 ? Math.min(1, (t - this.time(row)) / span) : 0) * Math.atan2(Math.sin(turn), Math.cos(turn));
    return pose;
  }
}

/** Stretches of time in which an agent had one behaviour. */
class Bands {
  constructor() { this.list = []; this.read = 0; }
  extend(track, column) {
    for (; this.read < track.rows; ++this.read) {
      const m = track.at(this.read, column), t = track.time(this.read);
      const last = this.list[this.list.length - 1];
      if (last) last.end = t;
      if (!last || last.m !== m) this.list.push({m, begin: t, end: t});
    }
  }
}

function floats(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return new Float32Array(bytes.buffer);
}

// Columns of the tracks that are no arm's.
const kWidths = {object: 15, cube: 22, body: 13};
// Columns of the tracks that a platform has besides its own, which are named KIND:PLATFORM.
const kPlatformWidths = {telemetry: 127, truth: 7, plan: 4, fragment: 103, box: 4, agent: 2};
const kPlatform = 'platform:';
// Tracks of agents without an effector, and of the coordinator among them, which tell their behaviour alone.
const kAgent = 'agent:', kAgentColumn = {t: 0, m: 1}, kCoordinator = 'mp';

/** Duration of a macrostep, and of an iteration of a platform's driver [s]. */
export const kMacrostep = 0.02;

const kNothing = {
  source: 'none', task: '', session: '', folder: '', note: '', pictures: [], columns: [], platform_columns: [], arms: [], platforms: [], cameras: [], cube: {held_by: ''}, object: {kind: 'none'}, body: {shape: 'none'},
};

const is_effector = (name) => !(name in kWidths) && !name.includes(':');
const is_agent = (name) => name.startsWith(kAgent);
/** @return name of what a track tells of, for people */
export const title_of = (name) => (is_agent(name) ? name.slice(kAgent.length) : name);

export class History {
  constructor() { this.begin(kNothing); }
  begin(scene) {
    this.scene = scene;
    this.tracks = new Map();
    this.bands = new Map();
    this.lines = [];
    this.values = {};
    this.platforms = new Set();  // names of those that have told something
    [this.column, this.platform_column] = [scene.columns, scene.platform_columns].map((names) => Object.fromEntries((names || []).map((name, k) => [name, k])));
  }
  width(name) {
    if (name.startsWith(kPlatform)) return this.scene.platform_columns.length;
    return kWidths[name] || kPlatformWidths[name.split(':')[0]] || this.scene.columns.length;
  }
  /** @param news  what the stream brings */
  take(news) {
    for (const [full, text] of Object.entries(news.tracks || {})) {
      const is_platform = full.startsWith(kPlatform), name = is_platform ? full.slice(kPlatform.length) : full;
      if (this.tracks.has(name) && this.platforms.has(name) !== is_platform) continue;  // arm and platform of one name
      if (is_platform) this.platforms.add(name);
      if (!this.tracks.has(name)) this.tracks.set(name, new Track(this.width(full)));
      const track = this.tracks.get(name);
      track.append(floats(text));
      if (!is_effector(name) && !is_agent(name)) continue;
      if (!this.bands.has(name)) this.bands.set(name, new Bands());
      this.bands.get(name).extend(track, this.columns_of(name).m);
    }
    this.lines.push(...(news.lines || []));
    Object.assign(this.values, news.values || {});
  }
  /** Names of the arms and platforms that have told something. */
  get effectors() { return [...this.tracks.keys()].filter(is_effector); }
  /** Tracks of agents without an effector that have told something. */
  get agents() { return [...this.tracks.keys()].filter(is_agent); }
  columns_of(name) { return is_agent(name) ? kAgentColumn : this.platforms.has(name) ? this.platform_column : this.column; }
  get rows() { return this.effectors.reduce((sum, name) => sum + this.tracks.get(name).rows, 0); }
  get begin_time() { return Math.min(...this.effectors.map((a) => this.tracks.get(a).first), this.end_time); }
  get end_time() { return Math.max(0, ...this.effectors.map((a) => this.tracks.get(a).last)); }
  /** @param name  of a track @return behaviour of that agent at t, 0 when there is none */
  behaviour(name, t) {
    const track = this.tracks.get(name);
    const row = track ? track.find(t) : -1;
    return row < 0 ? 0 : track.at(row, this.columns_of(name).m);
  }
  /** @return what the agent calls it, or else the coordinator, whose orders one with an effector copies */
  name_of(name, m) {
    const names = this.values.behaviours || {}, copies = !is_agent(name) || title_of(name) === kCoordinator;
    return names[title_of(name)]?.[m] || (copies && names['']?.[m]) || (m ? `m = ${m}` : '');
  }
}
