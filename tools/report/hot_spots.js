// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// The targets of a report in three dimensions, coloured by the levels of hot_spots.h at the chosen view.
(async () => {
  const place = document.getElementById("hot-spots");
  if (!place || !seaglint.able) return;
  const set = JSON.parse(place.querySelector("script").textContent);
  const { element } = seaglint;
  const short = (x) => Number(x.toPrecision(6)).toString();
  const box = element("div", { className: "interactive" });
  place.prepend(box);

  const target = element("select", { id: "hot-spot-target" }, ...set.targets.map((t, i) => element("option", { value: i, textContent: t.name })));
  const slider = element("input", { type: "range", min: 0, step: 1, value: 0, id: "hot-spot-view" });
  const output = element("output", { htmlFor: "hot-spot-view" });
  const plot = element("div", { role: "img" });
  box.append(element("div", { className: "controls" }, element("label", {}, "Target ", target), element("label", {}, "View ", slider, " ", output)), plot);

  const meshes = new Map();
  async function mesh(of) {
    if (meshes.has(of)) return meshes.get(of);
    const xyz = new Float32Array(await seaglint.inflate(of.vertices)), corners = new Uint32Array(await seaglint.inflate(of.triangles));
    for (let i = 1; i < corners.length; ++i) corners[i] += corners[i - 1];  // modulo 2^32
    const every = (values, n, first) => Array.from({ length: values.length / n }, (_, i) => values[n * i + first]);
    const made = { x: every(xyz, 3, 0), y: every(xyz, 3, 1), z: every(xyz, 3, 2), i: every(corners, 3, 0), j: every(corners, 3, 1), k: every(corners, 3, 2) };
    const extent = (values) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
    made.centre = [made.x, made.y, made.z].map((values) => extent(values).reduce((a, b) => a + b) / 2);
    made.size = Math.max(...[made.x, made.y, made.z].map((values) => { const [low, high] = extent(values); return high - low; }));
    meshes.set(of, made);
    return made;
  }

  async function show() {
    const of = set.targets[target.value];
    slider.max = of.views.length - 1;
    const view = of.views[slider.value];
    output.textContent = `azimuth ${short(view.azimuth_deg)} deg, elevation ${short(view.elevation_deg)} deg`;
    slider.setAttribute("aria-valuetext", output.textContent);
    plot.dataset.wanted = target.value + "," + slider.value;
    const wanted = plot.dataset.wanted;
    const { centre, size, ...geometry } = await mesh(of);
    const steps = new Uint8Array(await seaglint.inflate(view.levels)), plotly = await seaglint.plotly();
    if (plot.dataset.wanted !== wanted) return;  // another view was chosen meanwhile
    const bottom = of.top_dbsm - set.range_db;
    const intensity = Array.from(steps, (step) => bottom + step * set.step_db);
    const [azimuth, elevation] = [view.azimuth_deg, view.elevation_deg].map((deg) => (deg * Math.PI) / 180);
    const r = [Math.cos(elevation) * Math.cos(azimuth), Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation)];
    const towards = (c) => [0.52, 0.6].map((share) => centre[c] + share * size * r[c]);
    const surface = { type: "mesh3d", ...geometry, intensity, intensitymode: "cell", cmin: bottom, cmax: of.top_dbsm, colorscale: "Cividis", flatshading: true, lighting: { ambient: 0.75, diffuse: 0.5, specular: 0.05 },
      colorbar: { title: { text: "dBsm", side: "right" }, thickness: 12 }, hovertemplate: "x %{x:.2f} m, y %{y:.2f} m, z %{z:.2f} m<extra></extra>" };
    const radar = { type: "scatter3d", mode: "lines+text", x: towards(0), y: towards(1), z: towards(2), text: ["", "to the radar"], line: { color: "#d55e00", width: 6 }, textfont: { color: "#d55e00" }, hoverinfo: "skip", showlegend: false };
    const axis = (title) => ({ title: { text: title } });
    const layout = { template: "none", height: 480, margin: { l: 0, r: 0, t: 32, b: 0 }, uirevision: target.value, title: { text: `${of.name}: ${short(view.total_dbsm)} dBsm in all at this frequency and view`, font: { size: 13 }, x: 0.02 },
      scene: { aspectmode: "data", xaxis: axis("x, forward (m)"), yaxis: axis("y, to port (m)"), zaxis: axis("z, up (m)"), camera: { eye: { x: 1.1, y: 1.25, z: 0.7 } } } };
    await plotly.react(plot, [surface, radar], layout, seaglint.CONFIG);
    plot.dataset.shown = wanted;
    plot.dataset.strongest = Math.max(...intensity);
    plot.setAttribute("aria-label", `Facets of ${of.name} coloured by their echo, ${output.textContent}`);
  }
  target.addEventListener("input", show);
  slider.addEventListener("input", show);
  seaglint.whenSeen(place, () => seaglint.takePlace(place, show));
})().catch((error) => console.error(error));
