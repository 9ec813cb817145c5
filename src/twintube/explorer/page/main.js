// The page: state, computation, play.

const content = JSON.parse(document.getElementById("content").textContent);
content.road.profile = new Float32Array(bytesOf(content.road.heights).buffer);
const find = (id) => document.getElementById(id);
const SAID_EVERY = 4; // frames: figures that change faster cannot be read
const NO_BREAK = "\u00a0";
const HASH_DELAY = 250; // [ms] between changes of the address

const module = await Module.opened(
  bytesOf(find("module").textContent.trim()),
  content.names,
  content.integers,
);
const state = new State(content);
const tube = new Tube(find("tube"), find("volumes"));
const charts = new Charts(find("charts"));
const compute = (changes) => computed(module, { ...state.values, ...changes }, content);
let result = null;
let now = 0; // [s] in the record
let playing = false;
let lastFrame = 0;
let frames = 0;
let waiting = 0;

function kept() {
  clearTimeout(waiting);
  waiting = setTimeout(() => history.replaceState(null, "", state.hash()), HASH_DELAY);
}

// The picture of a time, with its figures where `said`.
function at(t, said = true) {
  now = Math.min(Math.max(t, 0), result.end);
  const { worn } = result.records;
  const i = Math.min(sampleAt(result.time, now), worn.done - 1);
  tube.at(worn, i);
  charts.to(i);
  if (!said) return;
  tube.say(worn, i);
  const scrub = find("scrub");
  scrub.value = result.end > 0 ? now / result.end : 0;
  const mark = Math.max(
    1,
    result.marks.filter((sample) => sample <= i && sample < result.time.length - 1).length,
  );
  const place = `${now.toFixed(3)} s of ${result.end.toFixed(3)} s, ${result.excitation.window} ${mark}`;
  scrub.setAttribute("aria-valuetext", place);
  find("place").textContent = place;
  const moment = [
    `s = ${(1e3 * worn.stroke[i]).toFixed(1)} mm`,
    `v = ${worn.velocity[i].toFixed(3)} m/s`,
    `F = ${worn.force[i].toFixed(0)} N`,
    `fluid force ${percent(worn.k_degr[i])} of intact`,
  ];
  find("moment").textContent = moment.map((text) => text.replaceAll(" ", NO_BREAK)).join(", ");
}

// A sentence on the result, which screen readers announce.
function summary() {
  const { damper, work, load, records, excitation } = result;
  const { oil, preload, temperature } = state.values;
  const warm = temperature === null ? "" : `, ${temperature} °C`;
  const head = `${damper.name}, ${oil} % oil, preload ${preload ? "present" : "lost"}${warm}`;
  if (records.worn.refusal)
    return `${head}. The unit stopped at ${result.end.toFixed(2)} s: ${records.worn.refusal}`;
  if (excitation.drive) {
    const total = (name) => records[name].work.at(-1) - records[name].work[0];
    return (
      `${head}: dynamic wheel load coefficient ${load.worn.toFixed(3)}, intact ${load.intact.toFixed(3)} ` +
      `(${load.worn < load.intact ? "−" : "+"}${Math.abs(100 * (load.worn / load.intact - 1)).toFixed(0)} %); damper work ${percent(total("worn") / total("intact"))} of intact.`
    );
  }
  const [first, last] = [0, -1].map((i) => percent(share(work.worn, work.intact, i)));
  return (
    `${head}: oscillation 1 does ${joule(work.worn[0])}, ${first} of the intact work; ` +
    `oscillation ${work.worn.length} does ${joule(work.worn.at(-1))}, ${last}.`
  );
}

function fillTable() {
  const { work, excitation } = result;
  find("work-window").textContent = excitation.window;
  const rows = work.worn.map((value, i) => {
    const row = document.createElement("tr");
    const cells = [i + 1, value.toFixed(2), work.intact[i].toFixed(2), percent(value / work.intact[i])];
    row.append(...cells.map((text) => Object.assign(document.createElement("td"), { textContent: text })));
    return row;
  });
  find("work-rows").replaceChildren(...rows);
}

function fillAssumed(damper) {
  const items = Object.entries(damper.assumed).map(([name, why]) => {
    const row = document.createElement("div");
    const parts = [
      ["dt", name],
      ["dd", why],
    ].map(([tag, text]) => Object.assign(document.createElement(tag), { textContent: text }));
    row.append(...parts);
    return row;
  });
  find("assumed-list").replaceChildren(...items);
  find("assumed").hidden = items.length === 0;
  find("curve-note").hidden = !("fv" in damper.assumed);
}

// Everything anew for the state; the time stays where it can, the end stays the end.
function update() {
  const ended = result === null || now >= result.end;
  controls.show(state.values);
  try {
    result = compute({});
  } catch (error) {
    find("summary").textContent = `Not computed: ${error.message}`;
    return;
  }
  tube.of(result.damper, content.parameters);
  charts.show(result);
  find("factor-key").hidden = !state.values.factor;
  find("summary").textContent = summary();
  find("cost").textContent =
    `Computed in ${result.milliseconds.toFixed(0)} ms: ${result.steps} steps of the module.`;
  fillTable();
  fillAssumed(result.damper);
  tour.show(state.values.tour);
  at(ended ? result.end : now);
  kept();
}

function play(wanted) {
  if (wanted === playing) return;
  playing = wanted;
  find("play").textContent = playing ? "Pause" : "Play";
  if (!playing) {
    at(now);
    state.values.time = now >= result.end ? null : Number(now.toFixed(4));
    kept();
    return;
  }
  if (now >= result.end) at(0);
  lastFrame = performance.now();
  requestAnimationFrame(frame);
}

function frame(time) {
  if (!playing) return;
  const passed = Math.min(0.1, Math.max(0, (time - lastFrame) / 1e3));
  lastFrame = time;
  frames += 1;
  const next = now + passed * state.values.slow;
  at(next, next >= result.end || frames % SAID_EVERY === 0);
  if (now >= result.end) play(false);
  else requestAnimationFrame(frame);
}

function moved(t) {
  play(false);
  at(t);
  state.values.time = now >= result.end ? null : Number(now.toFixed(4));
  kept();
}

// To the next mark of the record, or the one before.
function jump(direction) {
  const times = result.marks.map((sample) => result.time[Math.min(sample, result.time.length - 1)]);
  const next = direction > 0 ? times.find((t) => t > now + 1e-9) : times.findLast((t) => t < now - 1e-9);
  moved(next ?? (direction > 0 ? result.end : 0));
}

function step(direction) {
  const samples = result.excitation.drive ? 10 : SAMPLES / 40;
  const i = sampleAt(result.time, now) + direction * samples;
  moved(result.time[Math.min(Math.max(i, 0), result.records.worn.done - 1)]);
}

const controls = new Controls(find("controls"), content, (values) => {
  Object.assign(state.values, values, { tour: 0 });
  update();
});
const tour = new Tour(
  find("tour"),
  (shown) => {
    Object.assign(state.values, shown ? Tour.state(shown) : {}, { tour: shown, time: null });
    now = Infinity;
    play(false);
    update();
  },
  compute,
);

function restored() {
  state.read(location.hash);
  const { time, slow, tour } = state.values;
  if (tour) Object.assign(state.values, Tour.state(tour));
  find("slow").value = slow;
  update();
  at(time ?? result.end);
}

find("play").addEventListener("click", () => play(!playing));
find("back").addEventListener("click", () => step(-1));
find("on").addEventListener("click", () => step(1));
find("jump-back").addEventListener("click", () => jump(-1));
find("jump-on").addEventListener("click", () => jump(1));
find("scrub").addEventListener("input", (event) => moved(event.target.value * result.end));
find("slow").addEventListener("change", (event) => {
  state.values.slow = Number(event.target.value);
  kept();
});
document.addEventListener("keydown", (event) => {
  if (event.key !== " " || event.target.closest("button, input, select, summary, a")) return;
  event.preventDefault();
  play(!playing);
});
window.addEventListener("hashchange", restored);
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => charts.refresh());
restored();
document.documentElement.dataset.ready = performance.now().toFixed(0);
