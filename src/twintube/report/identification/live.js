// Records of a report: which one, over what, which curves; values at the point under the pointer or of the slider.
(() => {
  const data = JSON.parse(document.getElementById("look-data").textContent);
  const decode = (text) => new Float32Array(Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer);
  const OVER = [
    { name: "stroke", key: "s", label: "stroke s [mm], rebound positive" },
    { name: "velocity", key: "v", label: "velocity v [m/s], rebound positive" },
    { name: "time", key: "t", label: "time t [s]" },
    { name: "time, difference to the measurement", key: "t", label: "time t [s]", less: true },
  ];
  const at = (id) => document.getElementById(`look-${id}`);
  const [record, over, part, point] = ["record", "over", "part", "point"].map(at);
  const host = document.querySelector("#look .plot");
  const options = (select, names) => select.replaceChildren(...names.map((name, i) => new Option(name, i)));
  const number = (value, digits) => (Number.isFinite(value) ? value.toFixed(digits) : "–");

  options(record, data.records.map((some) => some.label));
  options(over, OVER.map((some) => some.name));
  const boxes = data.curves.map((curve) => {
    const label = document.createElement("label");
    const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: curve.shown });
    const key = Object.assign(document.createElement("span"), { className: "key" });
    key.dataset.curve = curve.name;
    label.append(box, key, curve.label);
    at("curves").append(label);
    box.addEventListener("change", draw);
    return box;
  });
  const chart = new Chart(host, OVER[0].label, "force F [N]");
  let shown = { x: [], curves: [] };

  function chosen() {
    const some = data.records[record.value];
    some.decoded ??= {
      ...Object.fromEntries(["t", "s", "v"].map((key) => [key, decode(some[key])])),
      forces: Object.fromEntries(Object.entries(some.forces).map(([name, text]) => [name, decode(text)])),
    };
    return some;
  }

  function choose() {
    const { marks, remark } = chosen();
    const parts = marks.slice(1).map((_, i) => `oscillation ${i + 1}`);
    options(part, ["all", ...parts]);
    part.value = Math.min(2, parts.length); // the rig comes from another velocity in the first
    at("remark").textContent = remark;
    draw();
  }

  function draw() {
    const { decoded, marks } = chosen();
    const way = OVER[over.value];
    const range = part.value > 0 ? [marks[part.value - 1], marks[part.value] + 1] : [0, decoded.t.length];
    const cut = (values) => values.subarray(...range);
    const measured = decoded.forces.measured;
    const curves = data.curves
      .filter((curve, i) => boxes[i].checked && decoded.forces[curve.name] && !(way.less && curve.name === "measured"))
      .map((curve) => {
        const force = decoded.forces[curve.name];
        const values = way.less ? measured.map((value, i) => value - force[i]) : force;
        return { x: cut(decoded[way.key]), y: cut(values), colour: `--look-${curve.name}`, dash: curve.dash, label: curve.label };
      });
    shown = { x: cut(decoded[way.key]), t: cut(decoded.t), s: cut(decoded.s), v: cut(decoded.v), curves, less: way.less };
    point.max = Math.max(0, shown.x.length - 1);
    chart.plot.axes[0].label = way.label;
    chart.plot.axes[1].label = way.less ? "measured less simulated [N]" : "force F [N]";
    chart.show({ x: bounds([shown.x]), y: bounds(curves.length ? curves.map((curve) => curve.y) : [[0, 1]]) }, curves, null);
    tell(Math.min(point.value, point.max));
  }

  function tell(i) {
    point.value = i;
    const values = shown.curves.map((curve) => `${curve.label} ${number(curve.y[i], 1)} N`);
    at("values").textContent =
      `t = ${number(shown.t[i], 3)} s, s = ${number(shown.s[i], 1)} mm, v = ${number(shown.v[i], 3)} m/s: ${values.join(", ") || "no curve is chosen"}`;
    const y = shown.curves[0]?.y[i];
    requestAnimationFrame(() => {
      chart.dot.hidden = !Number.isFinite(y) || !chart.px;
      if (!chart.dot.hidden) chart.dot.style.transform = `translate(${chart.px(shown.x[i])}px, ${chart.py(y)}px)`;
    });
  }

  // The sample nearest to the pointer on any curve.
  host.addEventListener("pointermove", (event) => {
    const { left, top } = chart.plot.over.getBoundingClientRect();
    const [x, y] = [event.clientX - left, event.clientY - top];
    let [best, nearest] = [-1, Infinity];
    for (const curve of shown.curves) {
      for (let i = 0; i < curve.x.length; i++) {
        const distance = Math.hypot(chart.px(curve.x[i]) - x, chart.py(curve.y[i]) - y);
        if (distance < nearest) [best, nearest] = [i, distance];
      }
    }
    if (best >= 0) tell(best);
  });
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => chart.refresh());
  record.addEventListener("change", choose);
  over.addEventListener("change", draw);
  part.addEventListener("change", draw);
  point.addEventListener("input", () => tell(Number(point.value)));
  choose();
})();
