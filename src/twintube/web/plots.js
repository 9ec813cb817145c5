// Diagrams: uPlot draws axes, grid and what stays (the intact damper); a canvas above it takes the live trace, which is
// only added to while time goes on.

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const FONT = '13px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
const FADED = 0.4; // of earlier oscillations

// Bounds around values, with room to each side.
function bounds(arrays, floor = Infinity) {
  let [low, high] = [floor, -floor];
  for (const array of arrays) {
    for (const value of array) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (!(low <= high)) return [0, 1];
  const room = 0.05 * (high - low || 1);
  return [low - room, high + room];
}

class Chart {
  // `whole`: the axis counts, so that its ticks are whole numbers.
  constructor(host, xLabel, yLabel, whole = false) {
    this.host = host;
    this.ranges = { x: [0, 1], y: [0, 1] };
    this.still = [];
    this.live = null; // what `to` draws
    this.wanted = -1; // the sample up to which
    const axis = (label, size, counts) => ({
      space: 30, // [px] between ticks, as little as their numbers need
      ...(counts && { incrs: [1, 2, 5, 10, 20, 50] }),
      label,
      labelSize: 20,
      labelGap: 2,
      labelFont: FONT,
      font: FONT,
      size,
      gap: 4,
      stroke: () => css("--ink"),
      grid: { stroke: () => css("--line"), width: 1 },
      ticks: { show: false },
    });
    const options = {
      ...this.size(),
      scales: { x: { time: false, range: () => this.ranges.x }, y: { range: () => this.ranges.y } },
      axes: [axis(xLabel, 26, whole), axis(yLabel, 54)],
      series: [{}, { show: false }],
      legend: { show: false },
      cursor: { show: false },
      padding: [6, 12, 0, 0],
      hooks: { draw: [() => this.laidOut()] },
    };
    this.plot = new uPlot(
      options,
      [
        [0, 1],
        [null, null],
      ],
      host,
    );
    this.canvas = document.createElement("canvas");
    this.canvas.className = "live";
    this.dot = document.createElement("div");
    this.dot.className = "dot";
    this.plot.over.append(this.canvas, this.dot);
    this.pen = this.canvas.getContext("2d");
    new ResizeObserver(() => this.resize()).observe(host);
  }

  size() {
    return { width: Math.max(200, this.host.clientWidth), height: Math.max(160, this.host.clientHeight) };
  }

  resize() {
    const { width, height } = this.size();
    if (width !== this.plot.width || height !== this.plot.height) this.plot.setSize({ width, height });
  }

  // `still`: curves {x, y, colour, dash, alpha}; `live`: {x, y, marks} or {work, marks}, drawn by `to`.
  show(ranges, still, live) {
    Object.assign(this, { ranges, still, live, wanted: -1 });
    this.refresh();
  }

  // Axes and curves anew, in the colours of now; uPlot does it at the end of the task and calls `laidOut`.
  refresh() {
    this.ready = false;
    this.plot.setData([this.ranges.x, [null, null]]);
  }

  // The canvas of the live trace as large as the area that uPlot gives it.
  laidOut() {
    this.drawStill();
    const ratio = window.devicePixelRatio;
    const { clientWidth, clientHeight } = this.plot.over;
    this.canvas.width = Math.round(clientWidth * ratio);
    this.canvas.height = Math.round(clientHeight * ratio);
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const { x, y } = this.ranges;
    this.px = (value) => ((value - x[0]) / (x[1] - x[0])) * clientWidth;
    this.py = (value) => (1 - (value - y[0]) / (y[1] - y[0])) * clientHeight;
    this.drawnTo = -1;
    this.ready = true;
    if (this.wanted >= 0) this.to(this.wanted);
  }

  drawStill() {
    const { ctx } = this.plot;
    const { left, top, width, height } = this.plot.bbox;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    for (const { x, y, colour, dash, alpha } of this.still) {
      ctx.beginPath();
      let gap = true; // a value that is no number breaks a curve
      for (let i = 0; i < x.length; i++) {
        const at = [this.plot.valToPos(x[i], "x", true), this.plot.valToPos(y[i], "y", true)];
        if (!Number.isFinite(at[1])) gap = true;
        else if (gap) ctx.moveTo(...at);
        else ctx.lineTo(...at);
        gap &&= !Number.isFinite(at[1]);
      }
      ctx.globalAlpha = alpha ?? 1;
      ctx.strokeStyle = css(colour);
      ctx.lineWidth = 1.6 * window.devicePixelRatio;
      ctx.setLineDash((dash ?? []).map((length) => length * window.devicePixelRatio));
      ctx.stroke();
    }
    ctx.restore();
  }

  trace(from, to, alpha) {
    const { x, y } = this.live;
    this.pen.beginPath();
    for (let i = from; i <= to; i++) this.pen.lineTo(this.px(x[i]), this.py(y[i]));
    this.pen.globalAlpha = alpha;
    this.pen.strokeStyle = css("--worn");
    this.pen.lineWidth = 2;
    this.pen.stroke();
  }

  // The live trace up to a sample; earlier oscillations of a loop fade.
  to(i) {
    this.wanted = i;
    if (!this.ready || !this.live) return;
    if (this.live.work) {
      this.columns(i);
      return;
    }
    const { marks, x, y } = this.live;
    const latest = marks?.findLast((mark) => mark <= i && mark < x.length - 1) ?? 0;
    if (this.drawnTo < latest || this.drawnTo > i) {
      this.pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
      if (latest > 0) this.trace(0, latest, FADED);
      this.trace(latest, i, 1);
    } else if (i > this.drawnTo) this.trace(this.drawnTo, i, 1);
    this.drawnTo = i;
    this.dot.style.transform = `translate(${this.px(x[i])}px, ${this.py(y[i])}px)`;
  }

  // Columns of the works up to a sample, the last one growing.
  columns(i) {
    const { work, marks } = this.live;
    this.pen.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.pen.globalAlpha = 1;
    this.pen.fillStyle = css("--worn");
    for (let k = 0; k + 1 < marks.length && marks[k] < i; k++) {
      const height = this.py(0) - this.py(work[Math.min(i, marks[k + 1])] - work[marks[k]]);
      this.pen.fillRect(this.px(k + 0.7), this.py(0) - height, this.px(0.6) - this.px(0), height);
    }
  }
}
