// What is shown, as plain values; the address holds them, so that a view can be shared.

const EFFECT_MARK = ",";

// Every key: its start value, and what becomes of a text from the address; null refuses it.
function stateRules(content) {
  const { rig } = content;
  const oneOf = (values) => (text) => values.find((value) => String(value) === text) ?? null;
  const within = (low, high) => (text) => {
    const number = Number(text);
    return text !== "" && number >= low && number <= high ? number : null;
  };
  const flag = (text) => ({ yes: true, no: false })[text] ?? null;
  const names = content.dampers.map((damper) => damper.name);
  const effects = (text) => text.split(EFFECT_MARK).filter((name) => name in content.effects);
  return {
    damper: [content.shown, oneOf(names)],
    oil: [60, within(20, 100)],
    preload: [false, flag],
    temperature: [null, within(-100, 200)], // [°C]; null: where the parameters hold
    excitation: ["block", oneOf(["block", "sine", "ramp", "drive"])],
    velocity: [1.048, oneOf(rig.velocities)],
    ramp: [0.1, oneOf(rig.ramps)],
    amplitude: [45, within(5, 100)],
    speed: [50, within(10, 80)],
    road: ["D", oneOf(Object.keys(content.road.classes))],
    foam: [true, flag],
    cavitation: [true, flag],
    gas: [content.freedGas, oneOf(Object.keys(content.ways))],
    factor: [false, flag],
    effects: [[], effects],
    slow: [0.25, oneOf([0.02, 0.05, 0.1, 0.25, 0.5, 1, 4])],
    tour: [0, within(0, 5)],
    time: [null, within(0, 1e4)],
  };
}

const written = (value) => (typeof value === "boolean" ? (value ? "yes" : "no") : String(value));

class State {
  constructor(content) {
    this.rules = stateRules(content);
    this.values = Object.fromEntries(Object.entries(this.rules).map(([key, [start]]) => [key, start]));
  }

  // The values with those of an address; what it does not say, or says wrongly, is as at the start.
  read(hash) {
    const given = new URLSearchParams(hash.replace(/^#/, ""));
    for (const [key, [start, parse]] of Object.entries(this.rules)) {
      this.values[key] = given.has(key) ? (parse(given.get(key)) ?? start) : start;
    }
  }

  // The address: everything that is not as at the start.
  hash() {
    const said = new URLSearchParams();
    for (const [key, [start]] of Object.entries(this.rules)) {
      const text = written(this.values[key] ?? "");
      if (text !== written(start ?? "")) said.set(key, text);
    }
    return `#${said}`;
  }
}
