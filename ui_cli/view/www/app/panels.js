// The words around the pictures: title, state, readings, messages.
import {kMacrostep} from './history.js';
import {kLegend} from './platform.js';
import {ground_colour} from './room.js';
import {colour_of, fixed} from './theme.js';

const by_id = (id) => document.getElementById(id);

function element(tag, text, kind) {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (kind) e.className = kind;
  return e;
}

/** A row of buttons of which one is pressed. */
export class Segments {
  constructor(place, chosen) { Object.assign(this, {place, chosen}); }
  /** @param entries  [[value, text, hint]] */
  offer(entries, value) {
    this.place.replaceChildren(...entries.map(([v, text, hint]) => {
      const button = element('button', text);
      button.dataset.value = v;
      if (hint) button.title = hint;
      button.onclick = () => { this.press(v); this.chosen(v); };
      return button;
    }));
    this.press(value);
  }
  press(value) { for (const b of this.place.children) b.setAttribute('aria-pressed', b.dataset.value === String(value)); }
}

/** What goes on, in the pill at the top: [words, kind]. */
export function state_of(history, connected) {
  if (!connected) return ['viewer has ended', 'bad'];
  const {source} = history.scene, {state, status, summary} = history.values;
  const outcome = summary ? summary.outcome + (summary.fault ? `: ${summary.fault.code}` : '') : 'ended';
  const bad = summary && summary.outcome === 'fault' ? 'bad' : '';
  if (source === 'run') return [`recorded, ${outcome}`, bad];
  if (source === 'none') return ['waiting for a task', ''];
  if (state?.name === 'ended') return [outcome, bad];
  return [status?.state || 'live', 'live'];
}

export function show_header(history, connected, arm, t) {
  const {scene} = history, folder = scene.folder.split('/').filter(Boolean).pop();
  by_id('title').textContent = scene.task ? scene.task.replaceAll('_', ' ') : 'MRROC++ viewer';
  by_id('subtitle').textContent = [scene.session && `session ${scene.session}`, folder && `run folder ${folder}`, scene.note].filter(Boolean).join('  ·  ');
  const [words, kind] = state_of(history, connected), pill = by_id('state'), chip = by_id('behaviour');
  pill.textContent = words;
  pill.className = `pill ${kind}`;
  const m = history.behaviour(arm, t), name = history.name_of(arm, m);
  const agent = history.values.status?.agents?.find((a) => a.name === arm);
  chip.hidden = !m;
  chip.title = agent?.m === m && agent.ended_because ? `after ${agent.ended_because}` : '';
  const dot = element('i');
  dot.style.background = colour_of(m);
  chip.replaceChildren(dot, name.startsWith('m =') ? name : `m = ${m}  ${name}`);
  document.title = scene.task ? `${scene.task} - viewer` : 'viewer';
}

const kDegrees = 180 / Math.PI;

/** @return rows of a table, [[what, numbers as text, unit]], or nothing where a track does not tell yet */
function arm_readings(history, name, t) {
  const n = history.tracks.get(name).mix(t, history.column.x, 12, new Float64Array(12));
  return n && [['E', [0, 1, 2].map((k) => fixed(1000 * n[k], 1)), 'mm'], ['F', [6, 7, 8].map((k) => fixed(n[k], 2)), 'N']];
}

/** Which fragment a platform drives, of how many that it was handed, and how long they last. */
function fragment_readings(history, name, t) {
  const column = history.platform_column, track = history.tracks.get(name), handed = history.tracks.get(`fragment:${name}`);
  const row = track.find(t), [driven, remaining] = ['fragment', 'remaining'].map((key) => (row < 0 ? 0 : track.at(row, column[key]))), last = handed ? handed.find(t) : -1;
  if (!driven) return [];
  return [['fragment', [`${driven}`, last < 0 ? '' : `of ${handed.at(last, 1)}`], ''], ['to its end', ['', fixed(kMacrostep * remaining, 1)], 's']];
}

function platform_readings(history, name, t) {
  const column = history.platform_column, track = history.tracks.get(name), p = track.pose(t, column.x);
  const v = track.mix(t, column.vx, 3, new Float64Array(3));
  return p && [
    ['x y', [fixed(1000 * p[0], 0), fixed(1000 * p[1], 0)], 'mm'], ['phi', ['', fixed(kDegrees * Math.atan2(Math.sin(p[2]), Math.cos(p[2])), 1)], 'deg'],
    ['v', ['', fixed(v[0], 2)], 'm/s'], ['w', ['', fixed(v[2], 2)], 'rad/s'], ...fragment_readings(history, name, t),
  ];
}

/** Position and force of every arm, place and speed of every platform, over the picture. */
export function show_readout(history, t) {
  by_id('readout').replaceChildren(...history.effectors.map((name) => {
    const card = element('div', undefined, 'card'), table = element('table');
    const rows = (history.platforms.has(name) ? platform_readings : arm_readings)(history, name, t);
    card.append(element('b', name), table);
    for (const [what, values, unit] of rows || []) {
      const row = element('tr');
      row.append(element('td', what), ...values.map((v) => element('td', v)), element('td', unit, 'unit'));
      table.append(row);
    }
    return card;
  }));
}

/** What the lines on the floor are, where a platform drives. */
export function show_legend(scene) {
  const place = by_id('legend');
  place.hidden = !scene.platforms.length;
  const scales = [...new Set((scene.room?.ground || []).map((area) => area.scale))].sort().slice(0, 4);
  const entries = [...kLegend, ...scales.map((scale) => [ground_colour(scale)[0], `friction of the floor x ${Number(Number(scale).toPrecision(3))}`])];
  place.replaceChildren(...entries.map(([colour, words]) => {
    const line = element('div'), mark = element('i');
    mark.style.background = `#${colour.toString(16).padStart(6, '0')}`;
    line.append(mark, words);
    return line;
  }));
}

export class Messages {
  constructor(place, seek) { Object.assign(this, {place, seek}); this.reset(); }
  reset() {
    this.shown = 0;
    this.place.replaceChildren(element('li', 'nothing was said yet', 'none'));
  }
  show(history, t) {
    if (!this.shown && history.lines.length) this.place.replaceChildren();
    for (; this.shown < history.lines.length; ++this.shown) {
      const line = history.lines[this.shown], item = element('li', undefined, line.fault ? 'fault' : '');
      item.append(element('span', `${line.t.toFixed(2)} s`), element('span', line.process), element('span', line.text));
      item.title = line.code ? `${line.code}: ui_cli explain ${line.code}` : '';
      item.onclick = () => this.seek(line.t);
      this.place.append(item);
      this.place.scrollTop = this.place.scrollHeight;
    }
    [...this.place.children].forEach((item, k) => item.classList.toggle('later', k < history.lines.length && history.lines[k].t > t + 1e-3));
    const {count} = history.values;
    const told = count ? [[count.messages, 'heard'], [count.lost, 'lost'], [count.refused, 'without room']] : [];
    by_id('count').textContent = told.filter(([n], k) => n || !k).map(([n, what]) => `${n.toLocaleString('en')} ${what}`).join(', ');
  }
}

/** What stands in the place of a picture when there is nothing to draw. */
export function show_empty(history, connected) {
  const place = by_id('empty'), {scene, values} = history;
  place.hidden = scene.arms.length > 0 || scene.platforms.length > 0 || history.rows > 0;
  if (place.hidden) return;
  const line = (...parts) => { const p = element('div', undefined, 'dim'); p.append(...parts); return p; };
  if (!connected) {
    place.replaceChildren(element('strong', 'The viewer has ended'), line('Start it again with ', element('code', 'ui_cli view')));
  } else if (scene.source === 'none') {
    const why = values.state?.text || '', special = /tasks run|under the name/.test(why);
    place.replaceChildren(
      element('strong', /tasks run/.test(why) ? 'Several tasks run' : 'No session'),
      special ? line(why) : line('Start a task in another terminal, for example ', element('code', './run drawing --speed 1')),
      line('A run that is over: ', element('code', 'ui_cli view runs/FOLDER')));
  } else {
    place.replaceChildren(element('strong', 'The cell is not known'), line(scene.note || 'The configuration names no arm and no platform.'));
  }
}
