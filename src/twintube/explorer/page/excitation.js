// Excitations as the package makes them (rig/signals.py, vehicle/ride.py): the preconditioning `before`, which ends at
// time 0, and the `run`, whose oscillations begin at the samples `marks`.

const SAMPLES = 400; // of an oscillation
const SINES = 10;
const RAMPS = 3;
const LONGEST = 30; // [s] of a drive
const BOTTOM = 0.75; // cycles from the middle into rebound

// `count` oscillations of `samples` samples from the phase [cycles] on; time [s] from 0.
function oscillations(speed, amplitude, count, samples, phase) {
  const n = count * samples + 1;
  const [time, stroke, velocity] = [new Float64Array(n), new Float64Array(n), new Float64Array(n)];
  for (let i = 0; i < n; i++) {
    const angle = (2 * Math.PI * i) / samples;
    time[i] = (angle * amplitude) / speed;
    stroke[i] = amplitude * Math.sin(angle + 2 * Math.PI * phase);
    velocity[i] = speed * Math.cos(angle + 2 * Math.PI * phase);
  }
  return { time, stroke, velocity };
}

// Strokes of constant speed from the lower end up and down.
function triangles(speed, amplitude, count) {
  const n = count * SAMPLES + 1;
  const [time, stroke, velocity] = [new Float64Array(n), new Float64Array(n), new Float64Array(n)];
  for (let i = 0; i < n; i++) {
    const share = ((i % SAMPLES) * 2) / SAMPLES; // 0 to 1 up, 1 to 2 down
    time[i] = (i * 4 * amplitude) / speed / SAMPLES;
    stroke[i] = amplitude * (share <= 1 ? 2 * share - 1 : 3 - 2 * share);
    velocity[i] = i > 0 && share > 0 && share <= 1 ? speed : -speed; // of the step that leads to the sample
  }
  velocity[0] = speed;
  return { time, stroke, velocity };
}

// The paper's preconditioning with the first sample of the run behind it, a rest of `rest` [s] between them.
function preconditioned(rig, amplitude, run, rest) {
  const slow = oscillations(rig.slow, amplitude, rig.preconditioning, SAMPLES, BOTTOM);
  const end = slow.time.at(-1) + rest;
  return {
    time: Float64Array.of(...slow.time.map((t) => t - end), 0),
    stroke: Float64Array.of(...slow.stroke, run.stroke[0]),
    velocity: Float64Array.of(...slow.velocity, 0),
  };
}

const everyOscillation = (count) => Array.from({ length: count + 1 }, (_, i) => i * SAMPLES);

function bench(rig, amplitude, run, count, held) {
  const before = preconditioned(rig, amplitude, run, run.time[1]);
  return { before, run, held, marks: everyOscillation(count), window: "oscillation" };
}

// The road under the wheel at a speed [km/h]: heights and rates every `step` [s], faded in, as `ride.track` makes them.
function track(road, factor, kmh) {
  const speed = kmh / 3.6;
  const profile = road.profile;
  const seconds = Math.floor(Math.min(LONGEST, ((profile.length - 1) * road.spacing - 1) / speed));
  const n = Math.round(seconds / road.step);
  const at = (i) => {
    const time = i * road.step;
    const place = (time * speed) / road.spacing;
    const left = Math.floor(place);
    const height = profile[left] + (place - left) * (profile[left + 1] - profile[left]);
    return factor * (height - profile[0]) * Math.min(time / road.fade, 1);
  };
  const heights = Float64Array.from({ length: n }, (_, i) => at(i));
  const rates = Float64Array.from({ length: n }, (_, i) =>
    i ? (0.5 * (at(i + 1) - at(i - 1))) / road.step : 0,
  );
  return { heights, rates, seconds };
}

function driven(rig, road, damper, state) {
  const { heights, rates, seconds } = track(road, road.classes[state.road], state.speed);
  const samples = Math.round((2 * Math.PI * rig.amplitude) / rig.slow / road.conditioningStep);
  const slow = oscillations(rig.slow, rig.amplitude, rig.preconditioning, samples, 0);
  const before = {
    time: Float64Array.from(slow.time, (_, i) => (i + 1 - slow.time.length) * road.conditioningStep),
    stroke: slow.stroke,
  };
  const run = { time: Float64Array.from(heights, (_, i) => i * road.step) };
  const marks = Array.from({ length: seconds }, (_, i) => Math.round(i / road.step)).concat(
    heights.length - 1,
  );
  return {
    before,
    run,
    drive: { heights, rates, corner: damper.corner, step: road.step },
    marks,
    window: "second",
  };
}

// The excitation of a state: `block`, `sine`, `ramp` or `drive`.
function excitationOf(state, damper, content) {
  const { rig, road } = content;
  if (state.excitation === "drive") return driven(rig, road, damper, state);
  const reach =
    state.excitation === "block" ? damper.amplitude : Math.min(state.amplitude / 1e3, 0.999 * damper.limit);
  if (state.excitation === "ramp") return bench(rig, reach, triangles(state.ramp, reach, RAMPS), RAMPS, true);
  const count = state.excitation === "block" ? rig.oscillations : SINES;
  return bench(rig, reach, oscillations(state.velocity, reach, count, SAMPLES, BOTTOM), count, false);
}
