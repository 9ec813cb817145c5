// The damper: the module's FMI functions and loops, compiled from the C sources of the native FMU.

const OUTPUTS = [
  "force",
  "k_degr",
  "V1.oil",
  "V1.gas",
  "V1.foam",
  "V2.oil",
  "V2.gas",
  "V2.foam",
  "V3.oil",
  "V3.gas",
  "V3.foam",
  "force_fluid",
  "force_friction",
  "force_gas",
  "work",
];
const MOTION = ["stroke", "velocity", "wheelLoad"]; // what a drive adds

const bytesOf = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

class Module {
  constructor(instance, names, integers) {
    this.c = instance.exports;
    this.c._initialize();
    this.reference = new Map(names.map((name, i) => [name, i]));
    this.integers = new Set(integers);
    this.memory = [];
  }

  static async opened(bytes, names, integers) {
    return new Module((await WebAssembly.instantiate(bytes, {})).instance, names, integers);
  }

  // Memory of the module for an array, released by `cleared`.
  place(array) {
    const at = this.c.reserve_memory(array.byteLength);
    if (at === 0) throw new Error("no memory");
    this.memory.push(at);
    new array.constructor(this.c.memory.buffer, at, array.length).set(array);
    return at;
  }

  cleared() {
    this.memory.forEach((at) => this.c.release_memory(at));
    this.memory = [];
  }

  said() {
    const bytes = new Uint8Array(this.c.memory.buffer, this.c.said());
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  set(unit, values) {
    const groups = [
      [this.c.fmi2SetReal, Float64Array, false],
      [this.c.fmi2SetInteger, Int32Array, true],
    ];
    for (const [set, Kind, integer] of groups) {
      const names = Object.keys(values).filter((name) => this.integers.has(name) === integer);
      const references = this.place(Uint32Array.from(names, (name) => this.reference.get(name)));
      const given = this.place(Kind.from(names, (name) => values[name]));
      if (set(unit, references, names.length, given) > 1) throw new Error(this.said());
    }
  }

  // Samples of a column each; `done` is less than their number where the unit refused to go on.
  columns(names, at, n, done) {
    const result = { done, refusal: done < n ? this.said() : "" };
    names.forEach((name, k) => {
      result[name] = new Float64Array(this.c.memory.buffer, at + 8 * k * n, done).slice();
    });
    return result;
  }

  record({ time, stroke, velocity }, unit, wanted, out) {
    const speeds = velocity ? this.place(velocity) : 0;
    return this.c.run_record(
      unit,
      time.length,
      this.place(time),
      this.place(stroke),
      speeds,
      wanted,
      OUTPUTS.length,
      out,
    );
  }

  // The damper with its parameters by name over an excitation, after its preconditioning.
  simulated(values, excitation) {
    const unit = this.c.open_unit();
    try {
      this.set(unit, values);
      const { before, run, drive, held } = excitation;
      if (!this.c.start_unit(unit, before.time[0], before.stroke[0])) throw new Error(this.said());
      if (this.record(before, unit, 0, 0) < before.time.length) throw new Error(this.said());
      const wanted = this.place(Uint32Array.from(OUTPUTS, (name) => this.reference.get(name)));
      const n = run.time.length;
      const names = drive ? [...OUTPUTS, ...MOTION] : OUTPUTS;
      const out = this.place(new Float64Array(names.length * n));
      if (!drive) {
        const fed = held ? { time: run.time, stroke: run.stroke } : run;
        return this.columns(names, out, n, this.record(fed, unit, wanted, out));
      }
      const roads = [this.place(drive.heights), this.place(drive.rates)];
      const car = this.place(Float64Array.from(drive.corner));
      const done = this.c.run_drive(unit, car, n, 0, drive.step, ...roads, wanted, OUTPUTS.length, out);
      return { ...this.columns(names, out, n, done), staticLoad: this.c.static_load(car) };
    } finally {
      this.c.fmi2FreeInstance(unit);
      this.cleared();
    }
  }
}
