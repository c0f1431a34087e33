// Small line plots with a time cursor.

function roundTicks(low, high, count) {
  if (!(high > low)) return [low];
  const smallest = (high - low) / count, power = 10 ** Math.floor(Math.log10(smallest));
  const step = power * ([1, 2, 2.5, 5, 10].find(factor => factor * power >= smallest * (1 - 1e-9)) ?? 10);
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  return ticks;
}

function numberText(value, digits = 3) {
  if (value === 0) return '0';
  const magnitude = Math.floor(Math.log10(Math.abs(value)));
  if (magnitude < -3) return value.toExponential(digits - 1);
  return value.toFixed(Math.max(0, Math.min(6, digits - 1 - magnitude))).replace('-', '\u2212');
}
function tickText(value) { return String(Number(value.toPrecision(6))).replace('-', '\u2212'); }

// Setting the size of a canvas clears and reallocates it, so it is done only when the size has changed.
function fitCanvas(canvas, width = canvas.clientWidth, height = canvas.clientHeight) {
  const ratio = window.devicePixelRatio || 1, pixels = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== pixels[0] || canvas.height !== pixels[1]) [canvas.width, canvas.height] = pixels;
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return {context, width, height};
}

const colours = {};
function readThemeColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['ink', 'muted', 'line', 'accent', 'card', 'ring']) colours[name] = style.getPropertyValue('--' + name).trim();
}

const FONT = '11px Inter, "SF Pro Text", "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif';

// A pointer held down on the element seeks to the time below it.
function seekByPointer(element, timeAt, seek) {
  element.addEventListener('pointerdown', event => {
    element.setPointerCapture(event.pointerId);
    seek(timeAt(event.offsetX));
  });
  element.addEventListener('pointermove', event => { if (event.buttons & 1) seek(timeAt(event.offsetX)); });
}

class Plot {
  // output: element that shows the value at the cursor.
  constructor(canvas, output, duration, seek) {
    Object.assign(this, {canvas, output, duration, left: 46, right: 8, top: 8, bottom: 18});
    seekByPointer(canvas, px => this.duration * Math.min(1, Math.max(0,
      (px - this.left) / (canvas.clientWidth - this.left - this.right))), seek);
  }

  show(times, values, unit, fromZero) {
    Object.assign(this, {times, values, unit});
    let low = Infinity, high = -Infinity;
    for (const value of values) { low = Math.min(low, value); high = Math.max(high, value); }
    if (fromZero) low = 0;
    if (!(high > low)) high = low + 1;
    const margin = 0.06 * (high - low);
    this.low = fromZero ? 0 : low - margin, this.high = high + margin;
    this.prepared = null;
  }

  valueAt(time) {
    const {times, values} = this;
    let low = 0, high = times.length - 1;
    if (time <= times[0] || high < 1) return values[0];
    if (time >= times[high]) return values[high];
    while (high - low > 1) { const middle = (low + high) >> 1; if (times[middle] <= time) low = middle; else high = middle; }
    return values[low] + (time - times[low]) / (times[high] - times[low] || 1) * (values[high] - values[low]);
  }

  // Everything but the cursor, twice: the whole curve pale, and as it is up to the cursor.
  prepare() {
    const {width, height} = this.area;
    this.pale = this.layer((c, line) => { c.globalAlpha = 0.28; c.stroke(line); });
    this.bold = this.layer((c, line) => { this.fillBelow(c, height, line); c.stroke(line); });
    this.prepared = `${width} ${height} ${colours.accent}`;
  }

  layer(drawCurve) {
    const {width, height} = this.area, canvas = document.createElement('canvas');
    const {context: c} = fitCanvas(canvas, width, height), line = new Path2D();
    this.drawAxes(c, width, height);
    this.times.forEach((t, k) => line.lineTo(this.X(t), this.Y(this.values[k])));
    c.lineJoin = 'round';
    c.lineWidth = 1.6;
    c.strokeStyle = colours.accent;
    drawCurve(c, line);
    return canvas;
  }

  X(time) { return this.left + time / (this.duration || 1) * (this.area.width - this.left - this.right); }
  Y(value) {
    const height = this.area.height - this.top - this.bottom;
    return this.area.height - this.bottom - (value - this.low) / (this.high - this.low) * height;
  }

  draw(time) {
    const {context: c, width, height} = fitCanvas(this.canvas);
    if (width === 0 || height === 0) return;
    this.area = {width, height};
    if (this.prepared !== `${width} ${height} ${colours.accent}`) this.prepare();
    const x = this.X(time), value = this.valueAt(time), ratio = this.pale.width / width;
    c.drawImage(this.pale, 0, 0, width, height);
    c.clearRect(0, 0, x, height);
    c.drawImage(this.bold, 0, 0, x * ratio, this.bold.height, 0, 0, x, height);
    c.strokeStyle = colours.muted;
    c.lineWidth = 1;
    c.beginPath();
    c.moveTo(x, this.top - 4);
    c.lineTo(x, height - this.bottom);
    c.stroke();
    c.beginPath();
    c.arc(x, this.Y(value), 4, 0, FULL_TURN);
    c.fillStyle = colours.accent;
    c.strokeStyle = colours.card;
    c.lineWidth = 2;
    c.fill();
    c.stroke();
    this.output.textContent = numberText(value) + (this.unit ? ' ' + this.unit : '');
  }

  drawAxes(c, width, height) {
    c.font = FONT;
    c.fillStyle = colours.muted;
    c.strokeStyle = colours.line;
    c.lineWidth = 1;
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const tick of roundTicks(this.low, this.high, Math.max(4, height / 36))) {
      c.beginPath();
      c.moveTo(this.left, Math.round(this.Y(tick)) + 0.5);
      c.lineTo(width - this.right, Math.round(this.Y(tick)) + 0.5);
      c.stroke();
      c.fillText(tickText(tick), this.left - 7, this.Y(tick));
    }
    c.textAlign = 'center';
    c.textBaseline = 'alphabetic';
    const ticks = roundTicks(0, this.duration, 5);
    for (const tick of ticks) if (this.X(tick) < width - 40) c.fillText(tickText(tick), this.X(tick), height - 3);
    c.textAlign = 'right';
    c.fillText('min', width - this.right, height - 3);
  }

  fillBelow(c, height, line) {
    const area = new Path2D(line);
    area.lineTo(this.X(this.times[this.times.length - 1]), height - this.bottom);
    area.lineTo(this.X(this.times[0]), height - this.bottom);
    c.globalAlpha = 0.12;
    c.fillStyle = colours.accent;
    c.fill(area);
    c.globalAlpha = 1;
  }
}
