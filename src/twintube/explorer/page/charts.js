// Which diagrams there are, and what a result shows in them.

const FACTOR_DASH = [6, 4];
const LEAF = 5; // [s] of a drive that a diagram over time shows at most
const scaled = (array, factor) => Float64Array.from(array, (value) => factor * value);

// The worn damper's share of a record that others are drawn beside; an intact bench loop repeats, so its last one is enough.
function loopOf(record, marks, drive) {
  const from = drive ? 0 : marks.at(-2);
  const part = (array, factor) => scaled(array.subarray(from), factor);
  return { s: part(record.stroke, 1e3), v: part(record.velocity, 1), F: part(record.force, 1) };
}

class Charts {
  constructor(host) {
    const chart = (id, x, y, whole) => new Chart(host.querySelector(`#${id} .plot`), x, y, whole);
    this.loopS = chart("chart-s", "stroke s [mm], rebound +", "force F [N]");
    this.loopV = chart("chart-v", "velocity v [m/s], rebound +", "force F [N]");
    this.work = chart("chart-work", "oscillation", "work [J]", true);
    this.degradation = chart("chart-k", "time t [s]", "fluid force over intact [1]");
    this.load = chart("chart-load", "time t [s]", "wheel load [N]");
    this.loadHost = host.querySelector("#chart-load");
  }

  get all() {
    return [this.loopS, this.loopV, this.work, this.degradation, this.load];
  }

  // All diagrams for a result, empty of the live trace.
  show(result) {
    const { records, marks, time, excitation } = result;
    const drive = Boolean(excitation.drive);
    const { worn, intact, factor } = records;
    const others = [[intact, "--intact"], ...(factor ? [[factor, "--factor", FACTOR_DASH]] : [])];
    const alpha = drive ? FADED : 1; // the loops of a drive cover each other
    const loops = others.map(([record, colour, dash]) => ({ ...loopOf(record, marks, drive), colour, dash, alpha }));
    const stroke = scaled(worn.stroke, 1e3).subarray(0, worn.done);
    const velocity = worn.velocity.subarray(0, worn.done);
    const forces = bounds([worn.force, ...loops.map((loop) => loop.F)]);
    const curve =
      (x) =>
      ({ F, colour, dash, alpha, [x]: values }) => ({ x: values, y: F, colour, dash, alpha });
    this.loopS.show(
      { x: bounds([stroke, ...loops.map((loop) => loop.s)]), y: forces },
      loops.map(curve("s")),
      {
        x: stroke,
        y: worn.force,
        marks,
      },
    );
    this.loopV.show(
      { x: bounds([velocity, ...loops.map((loop) => loop.v)]), y: forces },
      loops.map(curve("v")),
      {
        x: velocity,
        y: worn.force,
        marks,
      },
    );
    this.showWork(result, others);
    const t = time.subarray(0, worn.done);
    this.time = time;
    this.leaves = drive ? Math.ceil(time.at(-1) / LEAF) : 1;
    const span = this.leafAt(0);
    const level = [{ x: [time[0], time.at(-1)], y: [1, 1], colour: "--intact" }];
    this.degradation.show({ x: span, y: [-0.04, Math.max(1.1, bounds([worn.k_degr])[1])] }, level, {
      x: t,
      y: worn.k_degr,
    });
    this.loadHost.hidden = !drive;
    if (drive) this.showLoad(result, others, t, span);
    else this.load.live = null;
  }

  showWork({ work, marks, records, excitation }, others) {
    const label = excitation.window === "second" ? "second of the drive" : "oscillation";
    this.work.plot.axes[0].label = label;
    const highest = Math.max(...Object.values(work).flat(), 1e-9);
    const steps = others.map(([record, colour, dash]) => {
      const done = work[Object.keys(records).find((name) => records[name] === record)];
      return {
        x: done.flatMap((_, i) => [i + 0.55, i + 1.45]),
        y: done.flatMap((value) => [value, value]),
        colour,
        dash,
      };
    });
    const ranges = { x: [0.4, marks.length - 0.4], y: [0, 1.08 * highest] };
    this.work.show(ranges, steps, { work: records.worn.work, marks });
  }

  showLoad({ records, time }, others, t, span) {
    const { worn } = records;
    const level = { x: [time[0], time.at(-1)], y: [worn.staticLoad, worn.staticLoad], colour: "--line" };
    const curves = others.map(([record, colour, dash]) => ({
      x: time.subarray(0, record.done),
      y: record.wheelLoad,
      colour,
      dash,
    }));
    this.load.show(
      { x: span, y: bounds([worn.wheelLoad, ...curves.map((curve) => curve.y), [0]]) },
      [level, ...curves],
      {
        x: t,
        y: worn.wheelLoad,
      },
    );
  }

  // The times that the diagrams over time show around a sample.
  leafAt(i) {
    const length = this.time.at(-1) / this.leaves;
    const leaf = Math.min(this.leaves - 1, Math.floor(this.time[i] / length));
    return [leaf * length, (leaf + 1) * length];
  }

  // The diagrams up to a sample.
  to(i) {
    const x = this.leafAt(i);
    for (const chart of [this.degradation, this.load]) {
      if (chart.ranges.x[0] === x[0]) continue;
      chart.ranges = { ...chart.ranges, x };
      chart.refresh();
    }
    this.all.filter((chart) => chart.live).forEach((chart) => chart.to(i));
  }

  refresh() {
    this.all.forEach((chart) => chart.refresh());
  }
}
