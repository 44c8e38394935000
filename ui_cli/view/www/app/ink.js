// The sheet in front of an arm, with the ink that its pen has left up to an instant.

const kPixels = 1024, kLine = 9;

export class Sheet {
  /** @param paper  {place: six numbers, size [m]} */
  constructor(paper) {
    this.canvas = document.createElement('canvas');
    this.canvas.width = this.canvas.height = kPixels;
    this.c = this.canvas.getContext('2d', {willReadFrequently: true});
    this.paper = paper;
    this.clear();
  }
  clear() {
    const c = this.c;
    c.fillStyle = '#fdfdfa';
    c.fillRect(0, 0, kPixels, kPixels);
    c.strokeStyle = '#e3e6ea';
    c.lineWidth = 1.5;
    for (let k = 1; k < 6; ++k) {  // every 50 mm
      const at = (k * kPixels) / 6;
      c.beginPath(); c.moveTo(at, 0); c.lineTo(at, kPixels); c.moveTo(0, at); c.lineTo(kPixels, at); c.stroke();
    }
    this.drawn = -1;
    this.marks = 0;
  }
  /** @return pixel of a point in the arm's base; the sheet's x is to the right, -y of the base, its y away from it */
  pixel(x, y) {
    const [px, py] = this.paper.place, scale = kPixels / this.paper.size;
    return [kPixels / 2 - (y - py) * scale, kPixels / 2 - (x - px) * scale];
  }
  take_pen() {
    Object.assign(this.c, {strokeStyle: '#16233a', lineWidth: kLine, lineCap: 'round', lineJoin: 'round'});
    this.c.beginPath();
  }
  /** Draws up to the instant. @param belt  track of the belt that carries the sheet along y, may be missing @return whether anything has changed */
  show(track, column, t, belt) {
    const until = track ? track.find(t) : -1;
    if (until === this.drawn) return false;
    const c = this.c, marks = this.marks, way = [0];
    let writing = false, cleared = until < this.drawn;
    if (cleared) this.clear();
    this.take_pen();
    for (let row = Math.max(0, this.drawn); row <= until; ++row) {
      const ink = track.at(row, column.ink);
      if (ink < 0 && row > this.drawn) { this.clear(); this.take_pen(); cleared = true; }
      if (ink > 0) {
        belt?.mix(track.time(row), column.q0, 1, way);
        const at = this.pixel(track.at(row, column.x), track.at(row, column.y) - way[0]);
        if (writing) c.lineTo(...at); else c.moveTo(...at);
        ++this.marks;
      }
      writing = ink > 0;
    }
    c.stroke();
    this.drawn = until;
    return cleared || this.marks !== marks;
  }
}
