// Puts the page together: news in, one picture per frame out, and only when something has changed.
import {Cell} from './cell.js';
import {Charts} from './charts.js';
import {History, kMacrostep} from './history.js';
import {Messages, Segments, show_empty, show_header, show_legend, show_readout} from './panels.js';
import {Pictures} from './pictures.js';
import {kSpeeds, Player} from './player.js';
import {listen} from './stream.js';
import {on_theme} from './theme.js';
import {Timeline} from './timeline.js';

const kFrame = 1000 / 30;
const by_id = (id) => document.getElementById(id);
const history = new History(), player = new Player(history);
const cell = new Cell(by_id('cell')), charts = new Charts(by_id('charts'));
const timeline = new Timeline(by_id('timeline'), history, player, seek);
const messages = new Messages(by_id('messages'), seek), pictures = new Pictures(by_id('cameras'), by_id('zoom'));
const arms = new Segments(by_id('arms'), (name) => { arm = name; changed = true; });
const spans = new Segments(by_id('spans'), (span) => { charts.span = Number(span); changed = true; });
const views = new Segments(by_id('views'), (view) => cell.look(view));
const descriptions = {};
let arm = '', changed = true, connected = true, drawn = 0, offered = '';

const icons = {play: '<svg viewBox="0 0 14 14"><path d="M3 1.5v11l9-5.5z"/></svg>', pause: '<svg viewBox="0 0 14 14"><path d="M3 1.5h3v11H3zM8 1.5h3v11H8z"/></svg>'};

function seek(t) { player.seek(t); changed = true; }

async function begin(scene) {
  history.begin(scene);
  player.reset(scene.source !== 'run');
  messages.reset();
  pictures.reset();
  offered = '';
  changed = true;
  const models = [...new Set([...scene.arms, ...scene.platforms].map((e) => e.model))].filter((model) => !descriptions[model]);
  await Promise.all(models.map(async (model) => {
    const answer = await fetch(`api/robot/${model}.urdf`);
    if (answer.ok) descriptions[model] = await answer.text();
  }));
  if (history.scene !== scene) return;
  cell.build(scene, descriptions);
  show_legend(scene);
  by_id('sheets').replaceChildren(...[...cell.arms.values()].filter((e) => e.arm.gripper === 'none' && !e.arm.belt).map(sheet_figure));
  changed = true;
}

/** A sheet from above, beside the cell; hidden while nothing is on it. */
function sheet_figure({arm: {name}, sheet}) {
  const figure = document.createElement('figure'), caption = document.createElement('figcaption');
  figure.className = 'card';
  caption.textContent = `sheet of ${name}`;
  figure.title = 'from above; a square is 50 mm';
  sheet.canvas.onclick = () => by_id('sheets').classList.toggle('large');
  figure.append(sheet.canvas, caption);
  return figure;
}

function offer_arms() {
  const names = history.effectors.length ? history.effectors : history.scene.arms.map((a) => a.name);
  if (offered === names.join()) return;
  offered = names.join();
  if (!names.includes(arm)) arm = names[0] || '';
  arms.offer(names.map((name, k) => [name, name, `charts of ${name} (${k + 1})`]), arm);
  const {scene} = history;
  const places = [...scene.arms.filter((a) => !a.belt).map((a) => [a.name, a.name, `the sheet of ${a.name}`]), ...scene.platforms.map((p) => [p.name, p.name, `the platform ${p.name}`])];
  views.offer(places.length ? [scene.arms.length ? ['cell', 'cell', 'the whole cell'] : ['cell', 'room', 'the whole room'], ...places, ...(scene.cube.held_by ? [['cube', 'cube', 'the cube']] : []), ['top', 'top', 'from above']] : [], 'cell');
}

function show_controls() {
  const play = by_id('play'), goes = player.playing || (player.live && history.scene.source === 'live');
  const icon = goes ? 'pause' : 'play';
  if (play.dataset.icon !== icon) { play.dataset.icon = icon; play.innerHTML = icons[icon]; play.setAttribute('aria-label', icon); }
  const live = by_id('live');
  live.disabled = history.scene.source === 'run';
  live.setAttribute('aria-pressed', player.live && !live.disabled);
  const clock = by_id('clock'), time = document.createElement('b');
  time.textContent = `${player.t.toFixed(2)} s`;
  clock.replaceChildren(time, ` of ${history.end_time.toFixed(2)} s`);
  Object.assign(clock.dataset, {t: player.t, rows: history.rows, playing: player.playing, live: player.live, arm});
}

function draw(now) {
  requestAnimationFrame(draw);
  if (now - drawn < kFrame - 4) return;
  drawn = now;
  changed = player.advance(now) || changed;
  if (changed) {
    changed = false;
    offer_arms();
    show_header(history, connected, arm, player.t);
    show_controls();
    show_empty(history, connected);
    show_readout(history, player.t);
    messages.show(history, player.live ? Infinity : player.t);
    cell.show(history, player.t);
    charts.draw(history, player, arm);
    timeline.draw();
    const marked = [...cell.arms.values()].some((e) => e.sheet.marks > 1);
    by_id('sheets').hidden = !marked;
  }
  pictures.show(history, now);
  cell.render();
}

by_id('play').onclick = () => { player.toggle(); changed = true; };
by_id('live').onclick = () => { player.follow(); changed = true; };
by_id('speed').append(...kSpeeds.map((s) => new Option(`${s} x`, s, s === 1, s === 1)));
by_id('speed').onchange = (event) => { player.speed = Number(event.target.value); };
spans.offer([[5, '5 s'], [20, '20 s'], [60, '60 s'], [0, 'all']], 20);
addEventListener('keydown', (event) => {
  const keys = {
    ' ': () => player.toggle(), l: () => player.follow(),
    ArrowLeft: () => player.seek(player.t - (event.shiftKey ? 1 : kMacrostep)), ArrowRight: () => player.seek(player.t + (event.shiftKey ? 1 : kMacrostep)),
    Home: () => player.seek(0), End: () => player.seek(history.end_time),
  };
  if (event.target.tagName === 'SELECT' || event.ctrlKey || event.metaKey || event.altKey) return;
  const key = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (key) { key(); event.preventDefault(); } else if (history.effectors[Number(event.key) - 1]) { arm = history.effectors[Number(event.key) - 1]; arms.press(arm); } else return;
  changed = true;
});
new ResizeObserver(() => { changed = true; }).observe(by_id('charts'));
addEventListener('resize', () => { changed = true; });
on_theme(() => { cell.recolour(); changed = true; });
listen(begin, (news) => { history.take(news); changed = true; }, (link) => { connected = link; changed = true; });
requestAnimationFrame(draw);
