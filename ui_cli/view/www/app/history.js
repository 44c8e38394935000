// Everything that the viewer has told so far: the page can go back to any instant of it.

/** A table of numbers that grows; its first column is the time [s]. */
export class Track {
  constructor(width) {
    this.width = width;
    this.rows = 0;
    this.data = new Float32Array(width * 1024);
  }
  append(numbers) {
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
}

/** Stretches of time in which an arm had one behaviour. */
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
const kWidths = {object: 15, cube: 22};

const kNothing = {
  source: 'none', task: '', session: '', folder: '', note: '', pictures: [], columns: [], arms: [], cameras: [], cube: {held_by: ''}, object: {kind: 'none'},
};

export class History {
  constructor() { this.begin(kNothing); }
  begin(scene) {
    this.scene = scene;
    this.tracks = new Map();
    this.bands = new Map();
    this.lines = [];
    this.values = {};
    this.column = Object.fromEntries((scene.columns || []).map((name, k) => [name, k]));
  }
  /** @param news  what the stream brings */
  take(news) {
    for (const [name, text] of Object.entries(news.tracks || {})) {
      const is_arm = !(name in kWidths);
      if (!this.tracks.has(name)) this.tracks.set(name, new Track(kWidths[name] || this.scene.columns.length));
      const track = this.tracks.get(name);
      track.append(floats(text));
      if (!is_arm) continue;
      if (!this.bands.has(name)) this.bands.set(name, new Bands());
      this.bands.get(name).extend(track, this.column.m);
    }
    this.lines.push(...(news.lines || []));
    Object.assign(this.values, news.values || {});
  }
  get arms() { return [...this.tracks.keys()].filter((name) => !(name in kWidths)); }
  get rows() { return this.arms.reduce((sum, name) => sum + this.tracks.get(name).rows, 0); }
  get begin_time() { return Math.min(...this.arms.map((a) => this.tracks.get(a).first), this.end_time); }
  get end_time() { return Math.max(0, ...this.arms.map((a) => this.tracks.get(a).last)); }
  /** @return behaviour of an arm at t, 0 when there is none */
  behaviour(arm, t) {
    const track = this.tracks.get(arm);
    const row = track ? track.find(t) : -1;
    return row < 0 ? 0 : track.at(row, this.column.m);
  }
  /** @return what the arm calls it, or else the coordinator, whose orders it copies */
  name_of(arm, m) {
    const names = this.values.behaviours || {};
    return names[arm]?.[m] || names['']?.[m] || (m ? `m = ${m}` : '');
  }
}
