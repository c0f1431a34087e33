// The run as the page holds it: integers unpacked from what packed_numbers.cpp wrote, and positions between frames.

async function unpack(text, sections) {
  if (typeof DecompressionStream === 'undefined')
    throw new Error('This browser is too old: it needs DecompressionStream (Chrome 80, Firefox 113, Safari 16.4).');
  const letters = atob(text.trim());
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const lists = {};
  for (const [name, section] of Object.entries(sections)) lists[name] = unpackList(bytes, section);
  return lists;
}

function unpackList(bytes, {offset, count, stride}) {
  const list = new Int32Array(count);
  for (let i = 0; i < count; ++i) {
    const code = bytes[offset + i] | bytes[offset + count + i] << 8 | bytes[offset + 2 * count + i] << 16 |
                 bytes[offset + 3 * count + i] << 24;
    const difference = code >>> 1 ^ -(code & 1);
    list[i] = stride > 0 && i >= stride ? list[i - stride] + difference : difference;
  }
  return list;
}

function startsOf(counts) {
  const starts = new Int32Array(counts.length + 1);
  for (let i = 0; i < counts.length; ++i) starts[i + 1] = starts[i] + counts[i];
  return starts;
}

class Run {
  constructor(description, lists) {
    Object.assign(this, description);
    this.lists = lists;
    this.frames = this.times.length;
    this.cells = this.first_vertex.length - 1;
    this.vertices = this.first_vertex[this.cells];
    this.duration = this.times[this.frames - 1];
    this.ringStart = startsOf(lists.ring_count);
    this.woundStart = startsOf(lists.wound_count);
    this.x = new Float32Array(this.vertices);
    this.y = new Float32Array(this.vertices);
  }

  // Frame number with a fraction: 3.25 is a quarter of the way from frame 3 to frame 4.
  frameAt(time) {
    let low = 0, high = this.frames - 1;
    if (time >= this.times[high]) return high;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.times[middle] <= time) low = middle; else high = middle;
    }
    return low + Math.max(0, time - this.times[low]) / (this.times[high] - this.times[low] || 1);
  }

  // Fills x, y (um, y upwards).
  place(frame) {
    const i = Math.floor(frame), w = frame - i, n = this.vertices;
    const from = i * n, to = Math.min(i + 1, this.frames - 1) * n, {x, y} = this.lists;
    for (let v = 0; v < n; ++v) {
      this.x[v] = this.step_um * (x[from + v] + w * (x[to + v] - x[from + v]));
      this.y[v] = this.step_um * (y[from + v] + w * (y[to + v] - y[from + v]));
    }
  }

  // Purse string after place(frame): [{x, y, vertex}]. A point keeps to its vertex between frames.
  ring(frame) {
    const i = Math.floor(frame), w = frame - i, {ring_vertex, ring_x, ring_y} = this.lists;
    const later = new Map();
    if (w > 0) for (let k = this.ringStart[i + 1]; k < this.ringStart[i + 2]; ++k) later.set(ring_vertex[k], k);
    const points = [];
    for (let k = this.ringStart[i]; k < this.ringStart[i + 1]; ++k) {
      const vertex = ring_vertex[k], next = later.get(vertex) ?? k;
      points.push({vertex,
                   x: this.x[vertex] + this.step_um * (ring_x[k] + w * (ring_x[next] - ring_x[k])),
                   y: this.y[vertex] + this.step_um * (ring_y[k] + w * (ring_y[next] - ring_y[k]))});
    }
    return points;
  }

  wound(frame) {
    const i = Math.round(frame), points = [];
    for (let k = this.woundStart[i]; k < this.woundStart[i + 1]; ++k)
      points.push([this.step_um * this.lists.wound_x[k], this.step_um * this.lists.wound_y[k]]);
    return points;
  }

  count(field) { return field.place === 'cell' ? this.cells : this.vertices; }

  value(field, frame, index) {
    const list = this.lists[field.name], n = this.count(field), i = Math.floor(frame), w = frame - i;
    const from = list[i * n + index], to = list[Math.min(i + 1, this.frames - 1) * n + index];
    // A count of neighbours has nothing in between.
    const between = field.name === 'contacts' ? (w < 0.5 ? from : to) : from + w * (to - from);
    return field.low + field.step * between;
  }

  history(field, cell) {
    return Array.from({length: this.frames}, (_, frame) => this.value(field, frame, cell));
  }
}
