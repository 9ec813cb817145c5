// The tube in section: the piston at its stroke, oil, foam and gas of each chamber from the bottom up.

const SVG = "http://www.w3.org/2000/svg";
const PHASES = ["oil", "foam", "gas"];
const HEIGHT = 400; // of the inner tube in the picture
const CHAMBERS = [
  ["V1", "rebound"],
  ["V2", "compression"],
  ["V3", "reserve"],
];

function drawn(kind, attributes, parent) {
  const node = document.createElementNS(SVG, kind);
  Object.entries(attributes).forEach(([name, value]) => node.setAttribute(name, value));
  parent.append(node);
  return node;
}

class Tube {
  constructor(svg, table) {
    this.svg = svg;
    this.cells = Object.fromEntries(
      CHAMBERS.map(([id]) => [id, PHASES.map((phase) => table.querySelector(`#${id}-${phase}`))]),
    );
    this.group = drawn("g", {}, svg);
  }

  // Tubes and rod of a damper, widths to each other as in it; the height is another scale.
  of(damper, names) {
    const value = (name) => damper.values[names.indexOf(name)];
    const [outer, between, inner, rod] = ["D_a", "D_la", "D_li", "D_PR"].map((name) =>
      value(`geometry.${name}`),
    );
    const length = value("geometry.h_l");
    const dead = value("geometry.dead_length");
    this.scale = HEIGHT / length; // per metre of stroke
    this.half = (length - dead) / 2;
    this.dead = dead * this.scale;
    const wide = 150 / outer;
    const middle = 120;
    const top = 50;
    this.group.replaceChildren();
    const rect = (name, x, width, y = top, height = HEIGHT) =>
      drawn("rect", { class: name, x: x.toFixed(1), width: width.toFixed(1), y, height }, this.group);
    const across = (diameter) => [middle - (diameter * wide) / 2, diameter * wide];
    rect("wall", ...across(outer + 0.003), top - 6, HEIGHT + 12);
    this.rects = { V1: {}, V2: {}, V3: {} };
    for (const phase of PHASES) this.rects.V3[phase] = [rect(phase, ...across(outer))];
    rect("wall", ...across(between), top - 6, HEIGHT + 12);
    for (const chamber of ["V1", "V2"])
      for (const phase of PHASES) this.rects[chamber][phase] = [rect(phase, ...across(inner))];
    this.rod = rect("steel", ...across(rod), 0, 0);
    this.piston = rect("steel", ...across(inner), 0, this.dead * 0.7);
    rect("steel", ...across(inner), top + HEIGHT - this.dead * 0.3, this.dead * 0.3);
    rect("wall", ...across(outer + 0.003), top - 14, 14);
    this.group.append(this.rod);
    this.top = top;
    this.labels = CHAMBERS.map(([id]) =>
      drawn("text", { class: "chamber", "text-anchor": "middle", x: middle }, this.group),
    );
    this.labels.forEach((label, i) => (label.textContent = CHAMBERS[i][0]));
    this.labels[0].setAttribute("x", (middle - ((inner + rod) * wide) / 4).toFixed(1));
    this.labels[2].setAttribute("x", (middle + ((outer + between) * wide) / 4).toFixed(1));
    this.labels[2].setAttribute("y", top + HEIGHT - 8);
  }

  // Layers of a chamber between two heights of the picture.
  layers(chamber, volumes, from, to) {
    const whole = volumes[0] + volumes[1] + volumes[2];
    let below = to;
    PHASES.forEach((phase, i) => {
      const height = whole > 0 ? ((to - from) * volumes[i]) / whole : 0;
      below -= height;
      for (const rect of this.rects[chamber][phase]) {
        rect.setAttribute("y", below.toFixed(2));
        rect.setAttribute("height", Math.max(0, height).toFixed(2));
      }
    });
  }

  at(record, i) {
    const stroke = record.stroke[i];
    const piston = this.top + (this.half - stroke) * this.scale;
    const base = this.top + HEIGHT - this.dead * 0.3;
    for (const [id] of CHAMBERS) {
      const volumes = PHASES.map((phase) => record[`${id}.${phase}`][i]);
      if (id === "V1") this.layers(id, volumes, this.top, piston);
      if (id === "V2") this.layers(id, volumes, piston + this.dead * 0.7, base);
      if (id === "V3") this.layers(id, volumes, this.top, this.top + HEIGHT);
    }
    this.piston.setAttribute("y", piston.toFixed(2));
    this.rod.setAttribute("height", piston.toFixed(2));
    this.labels[0].setAttribute("y", (piston - 8).toFixed(1));
    this.labels[1].setAttribute("y", (base - 8).toFixed(1));
  }

  // The volumes as figures.
  say(record, i) {
    for (const [id] of CHAMBERS) {
      PHASES.forEach(
        (phase, k) => (this.cells[id][k].textContent = (1e6 * record[`${id}.${phase}`][i]).toFixed(1)),
      );
    }
  }
}
