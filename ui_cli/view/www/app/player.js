// Which instant is shown: the newest one, one that was chosen, or one after the other.

export const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20];

export class Player {
  constructor(history) {
    this.history = history;
    this.t = 0;
    this.live = true;
    this.playing = false;
    this.speed = 1;
    this.last = 0;
  }
  reset(live) { this.live = live; this.playing = false; this.t = 0; }
  follow() { this.live = true; this.playing = false; }
  seek(t) {
    this.live = false;
    this.t = Math.min(Math.max(t, this.history.begin_time), this.history.end_time);
  }
  toggle() {
    if (this.live) { this.live = false; this.playing = false; return; }
    if (!this.playing && this.t >= this.history.end_time - 1e-3) this.t = this.history.begin_time;
    this.playing = !this.playing;
    this.last = 0;
  }
  /** @param now  [ms]  @return whether the instant has changed */
  advance(now) {
    const before = this.t;
    if (this.live) this.t = this.history.end_time;
    else if (this.t < this.history.begin_time) this.t = this.history.begin_time;
    if (this.playing) {
      if (this.last) this.t += Math.min(0.5, (now - this.last) / 1000) * this.speed;
      this.last = now;
      if (this.t >= this.history.end_time) { this.t = this.history.end_time; this.playing = false; }
    }
    return this.t !== before;
  }
}
