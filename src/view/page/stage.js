// Draws the tissue.

const FULL_TURN = 2 * Math.PI;

function blend(a, b, weight) {
  return a.map((part, k) => Math.round(part + weight * (b[k] - part)));
}
function cssColour(colour) { return `rgb(${colour[0]} ${colour[1]} ${colour[2]})`; }
function parseColour(text) { return [1, 3, 5].map(k => parseInt(text.trim().slice(k, k + 2), 16)); }

class Stage {
  constructor(canvas, run) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.run = run;
    this.zoom = {factor: 1, x: 0, y: 0};
    this.allCells = Array.from({length: run.cells}, (_, cell) => cell);
    this.tangentX = new Float32Array(run.vertices);
    this.tangentY = new Float32Array(run.vertices);
    this.readTheme();
  }

  readTheme() {
    const style = getComputedStyle(document.documentElement), get = name => style.getPropertyValue(name);
    this.theme = {rim: parseColour(get('--rim')), pale: parseColour(get('--pale')), ring: get('--ring').trim(),
                  card: get('--card').trim(), wound: get('--wound').trim(), ink: get('--ink').trim()};
    const lift = Number(get('--lift'));
    this.shades = [];
    for (let i = 0; i < 256; ++i) {
      const body = this.run.colours.slice(3 * i, 3 * i + 3);
      this.shades.push(this.shade(body, lift));
    }
    this.pale = this.shade(this.theme.pale, 0);
  }

  shade(body, lift) {
    return {body: cssColour(body), membrane: cssColour(blend(body, [255, 255, 255], lift)),
            edge: cssColour(blend(body, this.theme.rim, 0.85))};
  }

  resize() {
    const box = this.canvas.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
    this.width = box.width, this.height = box.height, this.ratio = ratio;
    this.canvas.width = Math.round(box.width * ratio), this.canvas.height = Math.round(box.height * ratio);
    const {width_um, height_um, membrane_um} = this.run;
    // Clock, scale bar and colour bar keep the corners.
    const free_x = Math.max(this.width - 190, 120), free_y = Math.max(this.height - 84, 120);
    this.fit = Math.min(free_x / (width_um + 2 * membrane_um), free_y / (height_um + 2 * membrane_um));
  }

  get scale() { return this.fit * this.zoom.factor; }
  toPixel(x, y) {
    return [0.5 * this.width - 14 + this.zoom.x + this.scale * (x - 0.5 * this.run.width_um),
            0.5 * this.height + this.zoom.y - this.scale * (y - 0.5 * this.run.height_um)];
  }
  toTissue(px, py) {
    return [(px - 0.5 * this.width + 14 - this.zoom.x) / this.scale + 0.5 * this.run.width_um,
            -(py - 0.5 * this.height - this.zoom.y) / this.scale + 0.5 * this.run.height_um];
  }

  magnify(factor, px, py) {
    const [x, y] = this.toTissue(px, py);
    this.zoom.factor = Math.min(Math.max(this.zoom.factor * factor, 1), 30);
    if (this.zoom.factor === 1) this.zoom.x = this.zoom.y = 0;
    const [qx, qy] = this.toPixel(x, y);
    if (this.zoom.factor > 1) this.zoom.x += px - qx, this.zoom.y += py - qy;
  }

  // Unit tangents along the chords of the neighbours, as in the still pictures.
  measureTangents() {
    const {x, y, first_vertex} = this.run;
    for (let cell = 0; cell < this.run.cells; ++cell) {
      const first = first_vertex[cell], end = first_vertex[cell + 1];
      for (let v = first; v < end; ++v) {
        const next = v + 1 === end ? first : v + 1, last = v === first ? end - 1 : v - 1;
        const dx = x[next] - x[last], dy = y[next] - y[last], length = Math.hypot(dx, dy) || 1;
        this.tangentX[v] = dx / length, this.tangentY[v] = dy / length;
      }
    }
  }

  curve(path, v, next) {
    const {x, y} = this.run, third = Math.hypot(x[next] - x[v], y[next] - y[v]) / 3;
    path.bezierCurveTo(x[v] + third * this.tangentX[v], y[v] + third * this.tangentY[v],
                       x[next] - third * this.tangentX[next], y[next] - third * this.tangentY[next], x[next], y[next]);
  }

  outline(cell) {
    const first = this.run.first_vertex[cell], end = this.run.first_vertex[cell + 1], path = new Path2D();
    path.moveTo(this.run.x[first], this.run.y[first]);
    for (let v = first; v < end; ++v) this.curve(path, v, v + 1 === end ? first : v + 1);
    path.closePath();
    return path;
  }

  shadeIndex(field, frame, index) {
    const fraction = (this.run.value(field, frame, index) - field.low) / (field.high - field.low);
    return Math.min(255, Math.max(0, Math.round(255 * fraction)));
  }

  draw(frame, field, selected) {
    const c = this.context, run = this.run;
    run.place(frame);
    this.measureTangents();
    this.paths = this.allCells.map(cell => this.outline(cell));
    c.setTransform(1, 0, 0, 1, 0, 0);
    c.clearRect(0, 0, this.canvas.width, this.canvas.height);
    // From here on coordinates are um, y upwards.
    const s = this.scale * this.ratio, [x0, y0] = this.toPixel(0, 0);
    c.setTransform(s, 0, 0, -s, x0 * this.ratio, y0 * this.ratio);
    c.lineJoin = c.lineCap = 'round';
    const pixel = 1 / this.scale, width = run.membrane_um, edge = Math.max(0.22 * width, 1.1 * pixel);
    this.drawWound(frame);
    this.drawCells(frame, field, width, edge, pixel);
    const inner = Math.max(width - edge, 2 * pixel);
    if (field.place === 'segment') this.drawSegments(frame, field, inner, this.allCells);
    if (selected !== null) this.drawSelected(selected, frame, field, width, inner, pixel);
    this.drawRing(run.ring(frame), width, pixel);
  }

  drawWound(frame) {
    const c = this.context;
    c.beginPath();
    for (const [x, y] of this.run.wound(frame)) c.lineTo(x, y);
    c.closePath();
    c.fillStyle = this.theme.wound;
    c.fill();
  }

  // All dark edges first, then all bodies: a thin dark line remains between neighbours.
  drawCells(frame, field, width, edge, pixel) {
    const c = this.context, of_cells = field.place === 'cell';
    const shades = this.paths.map((_, cell) => of_cells ? this.shades[this.shadeIndex(field, frame, cell)] : this.pale);
    c.lineWidth = width;
    this.paths.forEach((path, cell) => { c.strokeStyle = shades[cell].edge; c.stroke(path); });
    c.lineWidth = Math.max(width - edge, pixel);
    this.paths.forEach((path, cell) => {
      c.fillStyle = shades[cell].body;
      c.fill(path);
      c.strokeStyle = shades[cell].membrane;
      c.stroke(path);
    });
  }

  drawSegments(frame, field, width, cells) {
    const c = this.context, {first_vertex, x, y} = this.run, buckets = new Map();
    for (const cell of cells) {
      const first = first_vertex[cell], end = first_vertex[cell + 1];
      for (let v = first; v < end; ++v) {
        const index = this.shadeIndex(field, frame, v);
        if (!buckets.has(index)) buckets.set(index, new Path2D());
        const path = buckets.get(index);
        path.moveTo(x[v], y[v]);
        this.curve(path, v, v + 1 === end ? first : v + 1);
      }
    }
    c.lineWidth = width;
    for (const [index, path] of buckets) { c.strokeStyle = this.shades[index].body; c.stroke(path); }
  }

  // Once more, above its neighbours and with a rim.
  drawSelected(cell, frame, field, width, inner, pixel) {
    const c = this.context, path = this.paths[cell], of_cells = field.place === 'cell';
    const shade = of_cells ? this.shades[this.shadeIndex(field, frame, cell)] : this.pale;
    c.strokeStyle = this.theme.ink;
    c.lineWidth = width + 5 * pixel;
    c.stroke(path);
    c.fillStyle = shade.body;
    c.fill(path);
    c.strokeStyle = shade.membrane;
    c.lineWidth = width;
    c.stroke(path);
    if (!of_cells) this.drawSegments(frame, field, inner, [cell]);
  }

  drawRing(points, width, pixel) {
    if (points.length === 0) return;
    const c = this.context, line = Math.max(0.45 * width, 1.6 * pixel);
    c.strokeStyle = this.theme.ring;
    c.lineWidth = 0.4 * line;
    c.beginPath();
    for (const {x, y, vertex} of points) { c.moveTo(x, y); c.lineTo(this.run.x[vertex], this.run.y[vertex]); }
    c.stroke();
    c.lineWidth = line;
    c.beginPath();
    for (const {x, y} of points) c.lineTo(x, y);
    c.closePath();
    c.stroke();
    c.fillStyle = this.theme.card;
    c.lineWidth = 0.45 * line;
    c.beginPath();
    for (const {x, y} of points) { c.moveTo(x + 0.62 * line, y); c.arc(x, y, 0.62 * line, 0, FULL_TURN); }
    c.fill();
    c.stroke();
  }

  // The cell drawn at a pixel of the canvas, or null.
  pick(px, py) {
    if (!this.paths) return null;
    const c = this.context;
    c.lineWidth = this.run.membrane_um;
    for (let cell = this.run.cells - 1; cell >= 0; --cell)
      if (c.isPointInPath(this.paths[cell], px * this.ratio, py * this.ratio) ||
          c.isPointInStroke(this.paths[cell], px * this.ratio, py * this.ratio)) return cell;
    return null;
  }
}
