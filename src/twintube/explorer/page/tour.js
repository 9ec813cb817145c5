// A guided tour of five findings of the paper: each a state, what the paper says, and the module's figures for it.

const WORN = {
  preload: false,
  excitation: "block",
  foam: true,
  cavitation: true,
  gas: "stays",
  factor: false,
  effects: [],
};

const lastOf = (result, name) => share(result.work[name ?? "worn"], result.work.intact, -1);
const firstOf = (result, name) => share(result.work[name ?? "worn"], result.work.intact, 0);

const TOUR = [
  {
    title: "Slow strokes: all oscillations are alike",
    state: { damper: "SA1", oil: 35, velocity: 0.05 },
    text:
      "Up to 0.05 m/s the oil does not foam and nothing cavitates (Figure 8). Gas passes the valves first, with little " +
      "force. Where oil arrives, the force rises sharply. The 19 loops lie on each other. The paper's 40 % of SA1 are 112 of 321 mL.",
    figures: (result) => {
      const { work } = result;
      return (
        `Here oscillation 19 does ${percent(work.worn.at(-1) / work.worn[0])} of the work of oscillation 1, and ` +
        `${percent(lastOf(result))} of that of the intact damper.`
      );
    },
    claims: "C1, C2 (the sharp rise is not found in every stroke of every damper)",
  },
  {
    title: "Fast strokes: less work from oscillation to oscillation",
    state: { damper: "SA1", oil: 35, velocity: 1.572 },
    text:
      "Sustained motion above 1 m/s makes foam and frees gas from the oil (Figures 9 to 11). The rise of the force comes " +
      "later in every stroke, and the work falls from oscillation to oscillation.",
    figures: ({ work }) =>
      `Here the work falls from ${joule(work.worn[0])} in oscillation 1 to ${joule(work.worn.at(-1))} in oscillation 19; ` +
      `the intact damper does ${joule(work.intact.at(-1))}.`,
    claims: "C3 (SA8 at its lowest level is an exception)",
  },
  {
    title: "Between 60 and 40 % of the oil the damper fails",
    state: { damper: "SA8", oil: 40, velocity: 0.524 },
    text:
      "Without preload, below the velocity at which the oil cavitates, 60 % of the oil are nearly enough, and with 40 % next to nothing is " +
      "left (Figure 34, Discussion). Move the oil level and see.",
    figures: (result, other) =>
      `Oscillation 19 does ${percent(lastOf(other({ oil: 60 })))} of the intact work with 60 % of the oil, ` +
      `${percent(lastOf(other({ oil: 50 })))} with 50 % and ${percent(lastOf(result))} with 40 %.`,
    claims: "C9",
  },
  {
    title: "Fast and sustained: only cavitation explains the loss",
    state: { damper: "SA8", oil: 56, velocity: 1.572 },
    text:
      "Of the paper's model variants only the one with cavitation shows the drop of the work over a fast block (Figure 33; its 60 % are " +
      "153 of 273 mL). Switch cavitation off and compare.",
    figures: (result, other) =>
      `Oscillation 19 does ${percent(lastOf(result))} of the intact work; without cavitation it would be ` +
      `${percent(lastOf(other({ cavitation: false })))}.`,
    claims: "C6",
  },
  {
    title: "A scalar factor misleads twice",
    state: { damper: "SA8", oil: 56, velocity: 1.572, factor: true },
    text:
      "The usual shortcut multiplies the force by a factor, here the oil level (dashed). It overstates the loss in a single " +
      "event, as in an inspection, and understates it where fast motion lasts, as on an uneven road (Section 3.4).",
    figures: (result) =>
      `Oscillation 1: ${percent(firstOf(result))} of the intact work, by the factor ${percent(firstOf(result, "factor"))}. ` +
      `Oscillation 19: ${percent(lastOf(result))}, by the factor ${percent(lastOf(result, "factor"))}.`,
    claims: "C5, C14 (the measured works are unpublished: the full model stands for them)",
  },
];

class Tour {
  // `go` shows a step (0: none); `compute` gives the result of a state with changes.
  constructor(host, go, compute) {
    Object.assign(this, { host, go, compute, said: new Map() });
    const list = host.querySelector("ol");
    TOUR.forEach(({ title }, i) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = title;
      button.addEventListener("click", () => go(i + 1));
      const item = document.createElement("li");
      item.append(button);
      list.append(item);
    });
    this.buttons = [...list.querySelectorAll("button")];
    this.step = host.querySelector("#tour-step");
    host.querySelector("#tour-back").addEventListener("click", () => go(this.shown - 1));
    host.querySelector("#tour-on").addEventListener("click", () => go((this.shown % TOUR.length) + 1));
    host.querySelector("#tour-end").addEventListener("click", () => go(0));
  }

  // Values of a step of the tour.
  static state(step) {
    return { ...WORN, ...TOUR[step - 1].state };
  }

  // The figures of a step, whose state is its own: a change by the reader ends the tour.
  figures(step) {
    if (!this.said.has(step)) {
      const other = (changes) => this.compute({ ...Tour.state(step), ...changes });
      this.said.set(step, TOUR[step - 1].figures(other({}), other));
    }
    return this.said.get(step);
  }

  show(step) {
    this.shown = step;
    this.step.hidden = step === 0;
    this.buttons.forEach((button, i) => {
      if (i + 1 === step) button.setAttribute("aria-current", "step");
      else button.removeAttribute("aria-current");
    });
    if (step === 0) return;
    const { title, text, claims } = TOUR[step - 1];
    const parts = { title: `${step} of ${TOUR.length}: ${title}`, text, figures: this.figures(step), claims };
    for (const [name, value] of Object.entries(parts))
      this.host.querySelector(`#tour-${name}`).textContent = value;
    this.host.querySelector("#tour-back").disabled = step === 1;
    this.host.querySelector("#tour-on").textContent = step === TOUR.length ? "Begin again" : "Next";
  }
}
