// From a state to records of the worn damper, the intact one and the scalar factor, all from the module.

// Parameters of the unit by name: a damper with the parts of the model and the effects that a state asks for.
function valuesOf(state, damper, content) {
  const values = Object.fromEntries(content.parameters.map((name, i) => [name, damper.values[i]]));
  if (!state.foam) Object.assign(values, content.noFoam);
  if (!state.cavitation) Object.assign(values, content.noCavitation);
  if (!damper.ownGas) Object.assign(values, content.ways[state.gas].parameters);
  if (state.temperature !== null) values.temperature = state.temperature + content.kelvin;
  state.effects.forEach((name) => Object.assign(values, content.effects[name].parameters));
  return values;
}

// Work [J] between the marks, as far as the record goes.
function workBetween(record, marks) {
  const ends = marks.slice(1).filter((mark) => mark < record.done);
  return ends.map((mark, i) => record.work[mark] - record.work[marks[i]]);
}

// Standard deviation of the wheel load over the static one, without the first seconds.
function dynamicLoad(record, road) {
  const load = record.wheelLoad.subarray(Math.round(road.settled / road.step));
  const mean = load.reduce((sum, value) => sum + value, 0) / load.length;
  return (
    Math.sqrt(load.reduce((sum, value) => sum + (value - mean) ** 2, 0) / load.length) / record.staticLoad
  );
}

const INTACT = { oil_level: 1, gas_preload: 1 };

function computed(module, state, content) {
  const began = performance.now();
  const damper = content.dampers.find((item) => item.name === state.damper);
  const excitation = excitationOf(state, damper, content);
  const values = valuesOf(state, damper, content);
  const share = state.oil / 100;
  const [re, co] = content.wear;
  const states = {
    worn: { oil_level: share, gas_preload: Number(state.preload) },
    intact: INTACT,
    ...(state.factor && { factor: { oil_level: 1, gas_preload: 0, [re]: share - 1, [co]: share - 1 } }),
  };
  const result = { damper, excitation, marks: excitation.marks, records: {}, work: {}, load: {} };
  for (const [name, changes] of Object.entries(states)) {
    const record = module.simulated({ ...values, ...changes }, excitation);
    if (!excitation.drive)
      Object.assign(record, { stroke: excitation.run.stroke, velocity: excitation.run.velocity });
    result.records[name] = record;
    result.work[name] = workBetween(record, excitation.marks);
    if (excitation.drive) result.load[name] = dynamicLoad(record, content.road);
  }
  result.time = excitation.run.time;
  result.end = result.time[Math.max(0, result.records.worn.done - 1)];
  result.milliseconds = performance.now() - began;
  result.steps = Object.keys(states).length * (excitation.before.time.length + excitation.run.time.length);
  return result;
}

// The last sample at or before a time.
function sampleAt(time, t) {
  let low = 0;
  let high = time.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

const percent = (share) => `${(100 * share).toFixed(share < 0.0995 ? 1 : 0)} %`;
const joule = (work) => `${work.toFixed(work < 9.95 ? 1 : 0)} J`;
const share = (work, intact, i) => work.at(i) / intact.at(i);
