// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Curves of the chosen cut, and images over an angle and frequency of its polarisation. Colours are those of the figures.
(async () => {
  const place = document.getElementById("comparison");
  if (!place || !seaglint.able) return;
  const set = JSON.parse(place.querySelector("script").textContent);
  const { element } = seaglint;
  const EXPORT = "#000000", COMPUTED = "#0072b2", KNOWN = "#009e73", DIFFERENCE = "#d55e00";
  const short = (value, digits = 6) => String(Number(value.toPrecision(digits)));
  const unit = { azimuth: "deg", elevation: "deg", frequency: "GHz" };
  // What a cut is chosen by, in the order of the controls.
  const KEYS = [
    { title: "Export", of: (cut) => cut.name }, { title: "Polarisation", of: (cut) => cut.pol }, { title: "Along", of: (cut) => cut.along },
    { title: "Frequency", of: (cut) => (cut.ghz === null ? "" : short(cut.ghz, 9) + " GHz") },
    { title: "Elevation", of: (cut) => (cut.el === null ? "" : short(cut.el) + " deg") },
    { title: "Azimuth", of: (cut) => (cut.az === null ? "" : short(cut.az) + " deg") }];

  const box = element("div", { className: "interactive" });
  place.prepend(box);
  for (const key of KEYS) {
    key.select = element("select", { id: "comparison-" + key.title.toLowerCase() });
    key.label = element("label", {}, key.title + " ", key.select);
    key.select.addEventListener("input", () => show().catch((error) => console.error(error)));
  }
  const controls = element("div", { className: "controls" }, ...KEYS.map((key) => key.label));
  const curves = element("div", { role: "img" }), caption = element("p", { className: "caption" });
  caption.setAttribute("aria-live", "polite");
  const images = ["export", "compared", "difference"].map(() => element("div", { role: "img" }));
  const maps = element("div", { className: "maps three", hidden: true }, ...images);
  box.append(controls, curves, caption, maps);

  const unpacked = new Map();
  async function levels(cut) {
    if (!unpacked.has(cut)) {
      const view = new DataView(await seaglint.inflate(cut.levels)), x = set.x[cut.x], n = x.length;
      const part = (k) => Array.from({ length: n }, (_, i) => { const steps = view.getUint16(2 * (k * n + i), true); return steps === 65535 ? null : cut.bottom + steps * cut.step; });
      const made = { x, reference: part(0), compared: part(1), known: cut.known ? part(2) : null };
      made.difference = made.compared.map((level, i) => level - made.reference[i]);
      unpacked.set(cut, made);
    }
    return unpacked.get(cut);
  }

  // The chosen cut. The options of a control are those of the cuts that the controls before it leave.
  function choose() {
    let left = set.cuts;
    for (const { of, select, label } of KEYS) {
      const options = [...new Set(left.map(of))], wanted = select.value;
      if (options.join("\n") !== [...select.options].map((o) => o.value).join("\n"))
        select.replaceChildren(...options.map((value) => element("option", { value, textContent: value })));
      select.value = options.includes(wanted) ? wanted : options[0];
      label.hidden = options.length < 2;
      left = left.filter((cut) => of(cut) === select.value);
    }
    controls.hidden = KEYS.every(({ label }) => label.hidden);
    return left[0];
  }

  const quantile = (values, p) => { const sorted = [...values].sort((a, b) => a - b); return sorted.length ? sorted[Math.max(0, Math.ceil(p * sorted.length) - 1)] : 0; };
  const extent = (values) => values.reduce(([low, high], v) => (v === null ? [low, high] : [Math.min(low, v), Math.max(high, v)]), [Infinity, -Infinity]);

  function plotOf(cut, values) {
    const label = `${cut.along} (${unit[cut.along]})`, line = (name, y, colour, width) => ({ name, style: "lines", x: values.x, y, colour, width });
    const series = [line(cut.name, values.reference, EXPORT, 3), line(cut.compared, values.compared, COMPUTED, 1.5)];  // the later one on top
    const differences = [line(`${cut.compared} - ${cut.name}`, values.difference, DIFFERENCE, 1.6)];
    if (values.known) {
      series.unshift(line(cut.known, values.known, KNOWN, 6));
      differences.unshift({ ...line(`${cut.known} - ${cut.name}`, values.known.map((level, i) => (level === null ? null : level - values.reference[i])), KNOWN, 4) });
    }
    const [low] = extent(values.reference), [least, most] = extent([...values.reference, ...values.compared]);
    const largestOf = (ys) => Math.max(...ys.map((v) => Math.abs(v ?? 0)));
    // Deep nulls of one curve alone do not set the scale.
    const limit = Math.max(20, 1.2 * quantile(values.difference.map(Math.abs), 0.9));
    const widest = Math.min(limit, Math.max(0.2, 1.05 * Math.max(...differences.map((d) => largestOf(d.y)))));
    const range = extent(values.x), title = KEYS.slice(1).filter((key) => key.title !== "Along" && key.of(cut)).map((key) => (key.title === "Polarisation" ? "" : key.title.toLowerCase() + " ") + key.of(cut)).join(", ");
    return { title, columns: 1, panels: [
      { title, x: { label, log: false, range }, y: { label: "radar cross section (dBsm)", log: false, range: [Math.max(cut.bottom, low - 12, least - 3), most + 3] }, series },
      { title: "compared - export", x: { label, log: false, range }, y: { label: "difference (dB)", log: false, range: [-widest, widest] }, series: differences }] };
  }

  // Levels over an angle and frequency of the cuts with the chosen export and polarisation at one other angle; null below
  // three of either.
  async function grid(cut) {
    const angles = cut.along === "frequency" ? ["azimuth", "elevation"] : [cut.along];
    for (const angle of angles) {
      const other = angle === "azimuth" ? "el" : "az", own = angle === "azimuth" ? "az" : "el";
      const cuts = set.cuts.filter((one) => one.name === cut.name && one.export === cut.export && one.pol === cut.pol && one.along === cut.along && one[other] === cut[other]);
      const points = new Map(), degrees = new Set(), frequencies = new Set();
      for (const one of cuts) {
        const values = await levels(one);
        values.x.forEach((x, i) => {
          const deg = one[own] ?? x, ghz = one.ghz ?? x;
          degrees.add(deg);
          frequencies.add(ghz);
          points.set(deg + "," + ghz, [values.reference[i], values.compared[i], values.difference[i]]);
        });
      }
      if (degrees.size < 3 || frequencies.size < 3) continue;
      const x = [...degrees].sort((a, b) => a - b), y = [...frequencies].sort((a, b) => a - b);
      const z = [0, 1, 2].map((k) => y.map((ghz) => x.map((deg) => points.get(deg + "," + ghz)?.[k] ?? null)));
      return { angle, x, y, z };
    }
    return null;
  }

  async function drawImages(cut, of, plotly) {
    maps.hidden = of === null;
    if (of === null) return;
    const high = extent(of.z[0].flat())[1], widest = Math.min(20, Math.max(0.2, quantile(of.z[2].flat().filter((v) => v !== null).map(Math.abs), 0.98)));
    const bottom = Math.max(cut.bottom, high - 50, quantile(of.z[0].flat().filter((v) => v !== null), 0.02) - 1);
    const at = cut.along === "frequency" ? { type: "line", x0: cut[of.angle === "azimuth" ? "az" : "el"], x1: cut[of.angle === "azimuth" ? "az" : "el"], yref: "paper", y0: 0, y1: 1 } : { type: "line", xref: "paper", x0: 0, x1: 1, y0: cut.ghz, y1: cut.ghz };
    for (const [k, title] of [`${cut.name} (dBsm)`, `${cut.compared} (dBsm)`, "compared - export (dB)"].entries()) {
      const scale = k < 2 ? { zmin: bottom, zmax: high, colorscale: "Viridis" } : { zmin: -widest, zmax: widest, colorscale: [[0, "#2166ac"], [0.25, "#92c5de"], [0.5, "#ffffff"], [0.75, "#f4a582"], [1, "#b2182b"]] };
      const heat = { type: "heatmap", x: of.x, y: of.y, z: of.z[k], ...scale, colorbar: { thickness: 12 }, hovertemplate: `${of.angle} %{x:.6g} deg<br>%{y:.6g} GHz<br>%{z:.2f} ${k < 2 ? "dBsm" : "dB"}<extra></extra>` };
      const layout = { template: "none", height: 320, margin: { l: 58, r: 8, t: 32, b: 44 }, title: { text: title, font: { size: 13 }, x: 0.02 }, xaxis: seaglint.axis({ label: of.angle + " (deg)" }), yaxis: seaglint.axis({ label: "frequency (GHz)" }), shapes: [{ ...at, line: { color: k < 2 ? "#fff" : "#000", width: 1, dash: "dot" } }] };
      await plotly.react(images[k], [heat], layout, seaglint.CONFIG);
      plotly.Plots.resize(images[k]);
      images[k].setAttribute("aria-label", `${title}: ${cut.pol} over ${of.angle} and frequency`);
    }
  }

  let latest = 0;
  async function show() {
    const cut = choose(), turn = ++latest, values = await levels(cut), of = await grid(cut), plotly = await seaglint.plotly();
    if (turn !== latest) return;  // another cut was chosen meanwhile
    const plot = plotOf(cut, values), { data, layout } = seaglint.figure(plot);
    await plotly.react(curves, data, { ...layout, height: 660 }, seaglint.CONFIG);
    const sizes = values.difference.map(Math.abs), largest = sizes.indexOf(Math.max(...sizes));
    caption.textContent = `${plot.title}: 90 % of ${sizes.length} values within ${quantile(sizes, 0.9).toFixed(2)} dB, mean ${(values.difference.reduce((a, b) => a + b, 0) / sizes.length).toFixed(2)} dB, largest ${values.difference[largest].toFixed(2)} dB at ${short(values.x[largest])} ${unit[cut.along]}.`;
    curves.setAttribute("aria-label", "Levels and differences. " + caption.textContent);
    await drawImages(cut, of, plotly);
    box.dataset.shown = plot.title;
  }
  choose();
  seaglint.whenSeen(place, () => seaglint.takePlace(place, show));
})().catch((error) => console.error(error));
