// Puts the parts together: playing, choosing, keys, theme.

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8];
const SECONDS_AT_SPEED_ONE = 20;
const PLAY_SHAPE = 'M8 5.2v13.6L19 12z', PAUSE_SHAPE = 'M7 5.5h3.6v13H7zM13.4 5.5H17v13h-3.6z';
const SHORT_NAMES = {shape_parameter: 'Shape', area_strain: 'Area strain', contacts: 'Neighbours', area: 'Area',
                     perimeter: 'Perimeter', membrane_tension: 'Tension', rest_length_strain: 'Rest length'};

const $ = id => document.getElementById(id);

class App {
  constructor(run) {
    this.run = run;
    this.fields = run.fields.filter(f => f.name !== 'area' && f.name !== 'perimeter');
    Object.assign(this, {time: 0, field: this.fields[0], selected: null, playing: false, speed: 3, loop: false,
                         dirty: true, drawn: 0});
    readThemeColours();
    this.stage = new Stage($('stage'), run);
    this.timeline = new Timeline($('timeline'), run, time => this.seek(time));
    this.plots = run.curves.map(curve => this.addCurve(curve));
    this.cellPlots = ['shape_parameter', 'area'].map(name => this.addCellPlot(name));
    if (run.curves.length === 0) this.selected = 0;
    $('facts').textContent = run.facts.map(([name, value]) => `${name} ${value}`).join('  ·  ');
    this.addFieldButtons();
    this.listen();
    this.chooseField(this.field);
    this.resize();
    requestAnimationFrame(now => this.tick(now));
  }

  addCurve(curve) {
    const card = document.createElement('section');
    card.className = 'card';
    card.innerHTML = '<header><h2></h2><output></output></header><div class="plot"><canvas></canvas></div>';
    card.querySelector('h2').textContent = curve.label;
    $('curves').append(card);
    const plot = new Plot(card.querySelector('canvas'), card.querySelector('output'), this.run.duration, t => this.seek(t));
    plot.show(curve.times, curve.values, curve.unit, curve.name === 'wound_area');
    return plot;
  }

  addCellPlot(name) {
    const field = this.run.fields.find(f => f.name === name), row = document.createElement('div');
    row.className = 'row';
    row.innerHTML = '<header><h3></h3><output></output></header><div class="plot"><canvas></canvas></div>';
    row.querySelector('h3').textContent = field.description;
    $('cell-plots').append(row);
    const plot = new Plot(row.querySelector('canvas'), row.querySelector('output'), this.run.duration, t => this.seek(t));
    plot.field = field;
    return plot;
  }

  addFieldButtons() {
    for (const field of this.fields) {
      const button = document.createElement('button');
      button.type = 'button';
      button.setAttribute('role', 'radio');
      button.textContent = SHORT_NAMES[field.name] ?? field.name;
      button.title = field.label;
      button.addEventListener('click', () => this.chooseField(field));
      $('fields').append(button);
    }
  }

  chooseField(field) {
    this.field = field;
    [...$('fields').children].forEach((button, k) => button.setAttribute('aria-checked', this.fields[k] === field));
    const stops = [];
    for (let i = 0; i <= 16; ++i) {
      const at = Math.round(i * 255 / 16), colour = this.run.colours.slice(3 * at, 3 * at + 3);
      stops.push(`${cssColour(colour)} ${100 * i / 16}%`);
    }
    $('ramp').style.background = `linear-gradient(to top, ${stops.join(', ')})`;
    $('colour-ticks').replaceChildren(...roundTicks(field.low, field.high, 6).map(tick => {
      const mark = document.createElement('span');
      mark.textContent = tickText(tick);
      mark.style.top = `${100 * (1 - (tick - field.low) / (field.high - field.low))}%`;
      return mark;
    }));
    $('colour-label').textContent = field.label;
    this.dirty = true;
  }

  select(cell) {
    this.selected = cell;
    this.showSelection();
    this.dirty = true;
  }

  showSelection() {
    const chosen = this.selected !== null;
    $('cell-name').textContent = chosen ? `Cell ${this.selected}` : 'Cell';
    $('cell-hint').hidden = chosen, $('cell-plots').hidden = !chosen, $('forget').hidden = !chosen;
    if (!chosen) return;
    for (const plot of this.cellPlots)
      plot.show(this.run.times, this.run.history(plot.field, this.selected), plot.field.unit.replace('um^2', '\u00b5m\u00b2'), false);
  }

  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.run.duration);
    this.dirty = true;
  }

  step(frames) {
    this.pause();
    const frame = this.run.frameAt(this.time), near = Math.round(frame);
    const target = Math.min(Math.max(near + frames, 0), this.run.frames - 1);
    this.seek(this.run.times[target]);
  }

  play() {
    if (this.time >= this.run.duration) this.time = 0;
    this.playing = true;
    this.last = undefined;
    this.showTransport();
  }
  pause() { this.playing = false; this.showTransport(); }
  toggle() { if (this.playing) this.pause(); else this.play(); }
  changeSpeed(by) { this.speed = Math.min(Math.max(this.speed + by, 0), SPEEDS.length - 1); this.showTransport(); }
  repeat() { this.loop = !this.loop; this.showTransport(); }

  showTransport() {
    $('play-shape').setAttribute('d', this.playing ? PAUSE_SHAPE : PLAY_SHAPE);
    const rate = SPEEDS[this.speed] * this.run.duration / SECONDS_AT_SPEED_ONE;
    $('speed').textContent = `${numberText(rate, 2)} min/s`;
    $('loop').setAttribute('aria-pressed', this.loop);
  }

  tick(now) {
    if (this.playing) {
      const seconds = this.last === undefined ? 0 : Math.min((now - this.last) / 1000, 0.25);
      this.last = now;
      this.seek(this.time + seconds * SPEEDS[this.speed] * this.run.duration / SECONDS_AT_SPEED_ONE);
      if (this.time >= this.run.duration) { if (this.loop) this.seek(0); else this.pause(); }
    }
    if (this.dirty) this.draw();
    requestAnimationFrame(later => this.tick(later));
  }

  draw() {
    this.dirty = false;
    ++this.drawn;
    const frame = this.run.frameAt(this.time);
    this.stage.draw(frame, this.field, this.selected);
    for (const plot of this.plots) plot.draw(this.time);
    if (this.selected !== null) for (const plot of this.cellPlots) plot.draw(this.time);
    this.timeline.draw(this.time);
    this.writeLabels();
  }

  writeLabels() {
    $('minutes').textContent = `${this.time.toFixed(1)} min`;
    $('model-time').textContent = `t = ${(this.time / this.run.time_unit_min).toFixed(1)}`;
    const area = this.plots.find((_, k) => this.run.curves[k].name === 'wound_area');
    if (area) {
      const share = area.valueAt(this.time) / (this.largestWound ??= Math.max(...area.values) || 1);
      $('healing').innerHTML = `${(100 * share).toFixed(0)}\u2009%<small>of the wound open</small>`;
    }
    const um = [200, 100, 50, 20, 10, 5, 2, 1, 0.5, 0.2, 0.1].find(length => length * this.stage.scale <= 120) ?? 0.1;
    $('scale-bar').style.width = `${um * this.stage.scale}px`;
    $('scale-text').textContent = `${um} \u00b5m`;
    $('timeline').setAttribute('aria-valuetext', `${this.time.toFixed(1)} min`);
  }

  resize() {
    this.stage.resize();
    this.showSelection();
    this.showTransport();
    const ring = this.run.lists.ring_vertex.length > 0, wound = this.run.lists.wound_x.length > 0;
    $('key').innerHTML = (ring ? '<span><i style="background:var(--ring)"></i>purse string</span>' : '') +
                         (wound ? '<span><i style="background:var(--wound);height:10px;vertical-align:-1px"></i>wound</span>' : '');
    this.dirty = true;
  }

  setTheme(theme) {
    document.documentElement.dataset.theme = theme;
    readThemeColours();
    this.stage.readTheme();
    this.dirty = true;
  }

  listen() {
    new ResizeObserver(() => this.resize()).observe($('stage'));
    $('play').addEventListener('click', () => this.toggle());
    $('slower').addEventListener('click', () => this.changeSpeed(-1));
    $('faster').addEventListener('click', () => this.changeSpeed(1));
    $('loop').addEventListener('click', () => this.repeat());
    $('forget').addEventListener('click', () => this.select(null));
    $('help').addEventListener('click', () => $('keys').showModal());
    $('theme').addEventListener('click', () => this.otherTheme());
    document.addEventListener('keydown', event => this.onKey(event));
    this.listenToStage();
  }

  otherTheme() { this.setTheme(document.documentElement.dataset.theme === 'dark' ? 'light' : 'dark'); }

  listenToStage() {
    const canvas = $('stage');
    let pressed = null;
    canvas.addEventListener('pointerdown', event => {
      pressed = {x: event.offsetX, y: event.offsetY, moved: false, zoom: {...this.stage.zoom}};
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', event => {
      if (!pressed) return this.hover(event);
      const dx = event.offsetX - pressed.x, dy = event.offsetY - pressed.y;
      pressed.moved ||= Math.hypot(dx, dy) > 4;
      if (!pressed.moved || this.stage.zoom.factor === 1) return;
      this.stage.zoom.x = pressed.zoom.x + dx, this.stage.zoom.y = pressed.zoom.y + dy;
      this.dirty = true;
    });
    canvas.addEventListener('pointerup', event => {
      if (pressed && !pressed.moved) this.select(this.stage.pick(event.offsetX, event.offsetY));
      pressed = null;
    });
    canvas.addEventListener('pointerleave', () => { $('tip').hidden = true; });
    canvas.addEventListener('dblclick', () => { this.stage.zoom = {factor: 1, x: 0, y: 0}; this.dirty = true; });
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.stage.magnify(Math.exp(-0.0015 * event.deltaY), event.offsetX, event.offsetY);
      this.dirty = true;
    }, {passive: false});
  }

  hover(event) {
    const cell = this.stage.pick(event.offsetX, event.offsetY), tip = $('tip');
    $('stage').style.cursor = cell === null ? 'default' : 'pointer';
    tip.hidden = cell === null;
    if (cell === null) return;
    const shown = this.field.place === 'cell' ? this.field : this.run.fields[0];
    const value = this.run.value(shown, this.run.frameAt(this.time), cell);
    tip.textContent = `cell ${cell} · ${(SHORT_NAMES[shown.name] ?? shown.name).toLowerCase()} ${numberText(value)}`;
    tip.style.left = `${event.offsetX}px`, tip.style.top = `${event.offsetY}px`;
  }

  onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || $('keys').open) return;
    const actions = {
      ' ': () => this.toggle(), ArrowLeft: () => this.step(event.shiftKey ? -10 : -1),
      ArrowRight: () => this.step(event.shiftKey ? 10 : 1), Home: () => this.seek(0), End: () => this.seek(this.run.duration),
      '+': () => this.changeSpeed(1), '=': () => this.changeSpeed(1), '-': () => this.changeSpeed(-1),
      l: () => this.repeat(), t: () => this.otherTheme(), Escape: () => this.select(null), '?': () => $('keys').showModal()};
    const field = this.fields[Number(event.key) - 1];
    const action = field ? () => this.chooseField(field) : actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    // A focused button answers the space bar itself.
    if (!action || (event.key === ' ' && event.target instanceof HTMLButtonElement)) return;
    event.preventDefault();
    action();
  }
}

// "#time=12.5&field=area_strain&cell=3&theme=dark" opens the page like that.
function applyAddress(app) {
  const wish = new URLSearchParams(location.hash.slice(1)), field = app.fields.find(f => f.name === wish.get('field'));
  if (wish.has('time')) app.seek(Number(wish.get('time')) || 0);
  if (field) app.chooseField(field);
  if (wish.has('cell') && Number(wish.get('cell')) in app.stage.run.first_vertex.slice(1)) app.select(Number(wish.get('cell')));
  if (wish.has('play')) app.play();
}

function firstTheme() {
  const wish = new URLSearchParams(location.hash.slice(1)).get('theme');
  const dark = matchMedia('(prefers-color-scheme: dark)');
  document.documentElement.dataset.theme = wish ?? (dark.matches ? 'dark' : 'light');
  dark.addEventListener('change', () => window.suture?.setTheme(dark.matches ? 'dark' : 'light'));
}

async function main() {
  firstTheme();
  const description = JSON.parse($('description').textContent);
  try {
    const lists = await unpack($('numbers').textContent, description.sections);
    $('notice').hidden = true;
    window.suture = new App(new Run(description, lists));
    applyAddress(window.suture);
  } catch (error) {
    $('notice').hidden = false;
    $('notice').textContent = error.message;
    throw error;
  }
}

main();
