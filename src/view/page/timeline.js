// The time line: milestones above, a track, one row of marks per kind of event below.

// In this order. A floor: a spring of the purse string has shrunk to its shortest. Colours after Okabe and Ito (2008), which the colour-blind can tell apart.
const EVENT_KINDS = [
  {kind: 'capture', colour: '#2f86c8', text: 'captures'}, {kind: 'yield', colour: '#d55e00', text: 'yields'},
  {kind: 'slip', colour: '#e69f00', text: 'slips'}, {kind: 'kink', colour: '#cc79a7', text: 'floors'},
  {kind: 'exchange', colour: '#009e73', text: 'exchanges'}];

const ROW = 13;  // pixels

class Timeline {
  constructor(canvas, run, seek) {
    Object.assign(this, {canvas, run, left: 74, right: 12, track: 30});
    this.rows = EVENT_KINDS.map(style => ({...style, ...run.events.kinds.find(e => e.kind === style.kind)}))
                           .filter(row => row.counts);
    canvas.parentElement.style.height = `${this.track + 18 + ROW * this.rows.length}px`;
    seekByPointer(canvas, px => this.run.duration * Math.min(1, Math.max(0,
      (px - this.left) / (canvas.clientWidth - this.left - this.right))), seek);
  }

  X(time) { return this.left + time / (this.run.duration || 1) * (this.canvas.clientWidth - this.left - this.right); }

  // All that does not depend on the time shown.
  prepare(width, height) {
    this.still = document.createElement('canvas');
    const {context: c} = fitCanvas(this.still, width, height);
    c.font = FONT;
    this.drawMilestones(c);
    c.fillStyle = colours.line;
    c.beginPath();
    c.roundRect(this.left, this.track - 3, width - this.left - this.right, 6, 3);
    c.fill();
    this.drawEvents(c, width - this.left - this.right);
    this.prepared = `${width} ${height} ${colours.accent}`;
  }

  draw(time) {
    const {context: c, width, height} = fitCanvas(this.canvas);
    if (this.prepared !== `${width} ${height} ${colours.accent}`) this.prepare(width, height);
    c.drawImage(this.still, 0, 0, width, height);
    const x = this.X(time);
    c.fillStyle = colours.accent;
    c.beginPath();
    c.roundRect(this.left, this.track - 3, Math.max(x - this.left, 0.1), 6, 3);
    c.fill();
    c.strokeStyle = colours.card;
    c.lineWidth = 2.5;
    c.beginPath();
    c.arc(x, this.track, 8, 0, FULL_TURN);
    c.fill();
    c.stroke();
  }

  drawMilestones(c) {
    c.textAlign = 'center';
    c.textBaseline = 'alphabetic';
    let free = -Infinity;
    const shown = this.run.milestones.filter(({time}) => time <= 1.001 * this.run.duration);
    for (const {time, label} of shown) {
      const x = this.X(time), half = 0.5 * c.measureText(label).width;
      c.strokeStyle = colours.muted;
      c.lineWidth = 1;
      c.beginPath();
      c.moveTo(x, this.track - 14);
      c.lineTo(x, this.track - 4);
      c.stroke();
      if (x - half < free) continue;  // its label would cover the one before
      c.fillStyle = colours.muted;
      c.fillText(label, Math.min(x, this.canvas.clientWidth - half), this.track - 18);
      free = x + half + 8;
    }
    c.fillStyle = colours.muted;
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    c.fillText('time', this.left - 12, this.track);
  }

  // The more events in a part of the run, the stronger its mark.
  drawEvents(c, length) {
    const part = length / this.run.events.parts;
    this.rows.forEach((row, k) => {
      const y = this.track + 14 + k * ROW, most = Math.max(...row.counts);
      c.fillStyle = colours.muted;
      c.fillText(row.text, this.left - 12, y + 4.5);
      c.fillStyle = row.colour;
      row.parts.forEach((at, i) => {
        c.globalAlpha = 0.4 + 0.6 * Math.sqrt(row.counts[i] / most);
        c.fillRect(this.left + at * part, y, Math.max(part, 1.5), 9);
      });
      c.globalAlpha = 1;
    });
  }
}
