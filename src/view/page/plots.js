// Small line plots with a time cursor.

function roundTicks(low, high, count) {
  if (!(high > low)) return [low];
  const smallest = (high - low) / count, power = 10 ** Math.floor(Math.log10(smallest));
  const step = power * ([1, 2, 5, 10].find(factor => factor * power >= smallest * (1 - 1e-9)) ?? 10);
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

function fitCanvas(canvas) {
  const box = canvas.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(box.width * ratio), canvas.height = Math.round(box.height * ratio);
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, box.width, box.height);
  return {context, width: box.width, height: box.height};
}

function themeColours() {
  const style = getComputedStyle(document.documentElement);
  const get = name => style.getPropertyValue('--' + name).trim();
  return {ink: get('ink'), muted: get('muted'), line: get('line'), accent: get('accent'), card: get('card'), ring: get('ring')};
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
    Object.assign(this, {canvas, output, duration, left: 38, right: 8, top: 8, bottom: 18});
    this.background = document.createElement('canvas');
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
  }

  valueAt(time) {
    const {times, values} = this;
    let low = 0, high = times.length - 1;
    if (time <= times[0] || high < 1) return values[0];
    if (time >= times[high]) return values[high];
    while (high - low > 1) { const middle = (low + high) >> 1; if (times[middle] <= time) low = middle; else high = middle; }
    return values[low] + (time - times[low]) / (times[high] - times[low] || 1) * (values[high] - values[low]);
  }

  draw(time) {
    const {context: c, width, height} = fitCanvas(this.canvas), colours = themeColours();
    const X = t => this.left + t / (this.duration || 1) * (width - this.left - this.right);
    const Y = v => height - this.bottom - (v - this.low) / (this.high - this.low) * (height - this.top - this.bottom);
    this.drawAxes(c, width, height, X, Y, colours);
    const line = new Path2D();
    this.times.forEach((t, k) => line.lineTo(X(t), Y(this.values[k])));
    c.lineJoin = 'round';
    c.lineWidth = 1.6;
    c.strokeStyle = colours.accent;
    c.globalAlpha = 0.28;
    c.stroke(line);
    c.globalAlpha = 1;
    c.save();
    c.beginPath();
    c.rect(0, 0, X(time), height);
    c.clip();
    this.fillBelow(c, X, height, line, colours);
    c.stroke(line);
    c.restore();
    const value = this.valueAt(time);
    c.strokeStyle = colours.muted;
    c.lineWidth = 1;
    c.beginPath();
    c.moveTo(X(time), this.top - 4);
    c.lineTo(X(time), height - this.bottom);
    c.stroke();
    c.beginPath();
    c.arc(X(time), Y(value), 4, 0, FULL_TURN);
    c.fillStyle = colours.accent;
    c.strokeStyle = colours.card;
    c.lineWidth = 2;
    c.fill();
    c.stroke();
    this.output.textContent = numberText(value) + (this.unit ? ' ' + this.unit : '');
  }

  drawAxes(c, width, height, X, Y, colours) {
    c.font = FONT;
    c.fillStyle = colours.muted;
    c.strokeStyle = colours.line;
    c.lineWidth = 1;
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    for (const tick of roundTicks(this.low, this.high, Math.max(2, height / 45))) {
      c.beginPath();
      c.moveTo(this.left, Math.round(Y(tick)) + 0.5);
      c.lineTo(width - this.right, Math.round(Y(tick)) + 0.5);
      c.stroke();
      c.fillText(tickText(tick), this.left - 7, Y(tick));
    }
    c.textAlign = 'center';
    c.textBaseline = 'alphabetic';
    const ticks = roundTicks(0, this.duration, 5);
    for (const tick of ticks) if (X(tick) < width - 34) c.fillText(tickText(tick), X(tick), height - 3);
    c.textAlign = 'right';
    c.fillText('min', width - this.right, height - 3);
  }

  fillBelow(c, X, height, line, colours) {
    const area = new Path2D(line);
    area.lineTo(X(this.times[this.times.length - 1]), height - this.bottom);
    area.lineTo(X(this.times[0]), height - this.bottom);
    c.globalAlpha = 0.12;
    c.fillStyle = colours.accent;
    c.fill(area);
    c.globalAlpha = 1;
  }
}
