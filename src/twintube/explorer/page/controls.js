// The form: every control named as its key of the state.

const ROUNDING = 1e-6; // [K] of degrees Celsius

class Controls {
  constructor(form, content, changed) {
    Object.assign(this, { form, content });
    const fields = form.elements;
    this.filled(
      fields.damper,
      content.dampers.map(({ name, title }) => [name, `${name}: ${title}`]),
    );
    this.filled(
      fields.gas,
      Object.keys(content.ways).map((name) => [name, name.replaceAll("_", " ")]),
    );
    this.filled(
      fields.road,
      Object.keys(content.road.classes).map((name) => [name, `class ${name}`]),
    );
    const box = form.querySelector("#effects");
    for (const [name, { title, strength }] of Object.entries(content.effects)) {
      const label = document.createElement("label");
      const input = Object.assign(document.createElement("input"), {
        type: "checkbox",
        name: "effects",
        value: name,
      });
      const said = Object.assign(document.createElement("small"), { textContent: `${strength}, assumed` });
      label.append(input, `${title} `, said);
      box.append(label);
    }
    this.lists = { velocity: content.rig.velocities, ramp: content.rig.ramps };
    for (const [name, values] of Object.entries(this.lists)) fields[name].max = values.length - 1;
    form.addEventListener("input", () => changed(this.values()));
    form.addEventListener("submit", (event) => event.preventDefault());
  }

  filled(select, options) {
    options.forEach(([value, text]) => select.append(new Option(text, value)));
  }

  values() {
    const fields = this.form.elements;
    const effects = [...this.form.querySelectorAll("[name=effects]:checked")].map((input) => input.value);
    return {
      damper: fields.damper.value,
      oil: Number(fields.oil.value),
      preload: fields.preload.checked,
      temperature: this.temperature(),
      excitation: this.form.querySelector("[name=excitation]:checked").value,
      velocity: this.lists.velocity[fields.velocity.value],
      ramp: this.lists.ramp[fields.ramp.value],
      amplitude: Number(fields.amplitude.value),
      speed: Number(fields.speed.value),
      road: fields.road.value,
      foam: fields.foam.checked,
      cavitation: fields.cavitation.checked,
      gas: fields.gas.value,
      factor: fields.factor.checked,
      effects,
    };
  }

  // What the slider says [°C]; null where it stands as near as it can at the temperature of the parameters.
  temperature() {
    const fields = this.form.elements;
    const [, own] = this.damper(fields.damper.value).temperatures;
    const chosen = Number(fields.temperature.value);
    return chosen === Math.round(own) ? null : chosen;
  }

  damper(name) {
    return this.content.dampers.find((item) => item.name === name);
  }

  // The controls as a state says, with what belongs to its damper and excitation.
  show(state) {
    const fields = this.form.elements;
    const damper = this.damper(state.damper);
    const [cold, own, hot] = damper.temperatures;
    fields.temperature.min = Math.ceil(cold - ROUNDING);
    fields.temperature.max = Math.floor(hot + ROUNDING);
    fields.temperature.value = state.temperature ?? Math.round(own);
    fields.amplitude.max = Math.floor(900 * damper.limit);
    for (const name of ["damper", "oil", "amplitude", "speed", "road", "gas"])
      fields[name].value = state[name];
    for (const name of ["preload", "foam", "cavitation", "factor"]) fields[name].checked = state[name];
    for (const [name, values] of Object.entries(this.lists)) fields[name].value = values.indexOf(state[name]);
    this.form.querySelector(`[name=excitation][value=${state.excitation}]`).checked = true;
    this.form
      .querySelectorAll("[name=effects]")
      .forEach((input) => (input.checked = state.effects.includes(input.value)));
    this.form.querySelectorAll("[data-for]").forEach((part) => {
      part.hidden = !part.dataset.for.split(" ").includes(state.excitation);
    });
    const levels = damper.levels.map((level) => `${Math.round(100 * level)} %`).join(" and ");
    this.form.querySelector("#levels").textContent =
      levels && `The paper measured ${levels}, without preload.`;
    fields.gas.disabled = damper.ownGas;
    this.form.querySelector("#gas-says").textContent = damper.ownGas
      ? "The parameter file says what freed gas does."
      : this.content.ways[state.gas].says;
    const reach = Math.min(state.amplitude, fields.amplitude.max);
    const said = {
      oil: `${state.oil} %`,
      temperature: `${state.temperature ?? own.toFixed(0)} °C`,
      velocity: `${state.velocity} m/s`,
      ramp: `${state.ramp} m/s`,
      amplitude: `${reach} mm`,
      speed: `${state.speed} km/h`,
    };
    for (const [name, text] of Object.entries(said)) {
      this.form.querySelector(`output[for=${name}]`).textContent = text;
      fields[name].setAttribute("aria-valuetext", text);
    }
  }
}
