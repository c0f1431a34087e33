// The time line: milestones above, a track, one row of marks per kind of event below.

// In this order; colours of Okabe and Ito (2008), which the colour-blind can tell apart.
const EVENT_KINDS = [
  {kind: 'capture', colour: '#0072b2', text: 'capture'}, {kind: 'yield', colour: '#d55e00', text: 'yield'},
  {kind: 'slip', colour: '#e69f00', text: 'slip'}, {kind: 'kink', colour: '#cc79a7', text: 'kink'},
  {kind: 'exchange', colour: '#009e73', text: 'exchange'}];

class Timeline {
  constructor(canvas, run, seek) {
    Object.assign(this, {canvas, run, left: 74, right: 12, track: 30});
    this.rows = EVENT_KINDS.map(style => ({...style, ...run.events.find(e => e.kind === style.kind)}))
                           .filter(row => row.count > 0);
    seekByPointer(canvas, px => this.run.duration * Math.min(1, Math.max(0,
      (px - this.left) / (canvas.clientWidth - this.left - this.right))), seek);
  }

  draw(time) {
    const {context: c, width} = fitCanvas(this.canvas), colours = themeColours();
    const length = width - this.left - this.right, X = t => this.left + t / (this.run.duration || 1) * length;
    c.font = FONT;
    this.drawMilestones(c, X, colours);
    c.fillStyle = colours.line;
    c.beginPath();
    c.roundRect(this.left, this.track - 3, length, 6, 3);
    c.fill();
    c.fillStyle = colours.accent;
    c.beginPath();
    c.roundRect(this.left, this.track - 3, Math.max(X(time) - this.left, 0.1), 6, 3);
    c.fill();
    this.drawEvents(c, length, colours);
    c.fillStyle = colours.accent;
    c.strokeStyle = colours.card;
    c.lineWidth = 2.5;
    c.beginPath();
    c.arc(X(time), this.track, 8, 0, FULL_TURN);
    c.fill();
    c.stroke();
  }

  drawMilestones(c, X, colours) {
    c.textAlign = 'center';
    c.textBaseline = 'alphabetic';
    let free = -Infinity;
    for (const {time, label} of this.run.milestones) {
      const x = X(time), half = 0.5 * c.measureText(label).width;
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

  drawEvents(c, length, colours) {
    const height = Math.min(10, 30 / Math.max(this.rows.length, 1));
    this.rows.forEach((row, k) => {
      const y = this.track + 12 + k * height;
      c.fillStyle = colours.muted;
      c.fillText(row.text, this.left - 12, y + 0.5 * height - 0.5);
      c.fillStyle = row.colour;
      c.globalAlpha = 0.75;
      for (const moment of row.moments) c.fillRect(this.left + moment * length - 0.5, y, 1.2, height - 2.5);
      c.globalAlpha = 1;
    });
  }
}
