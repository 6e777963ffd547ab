// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Targets in three dimensions, coloured by the levels of hot_spots.h at the chosen view and in the chosen element, with
// their scattering centres, seen from the radar until the reader turns them.
(async () => {
  const place = document.getElementById("hot-spots");
  if (!place || !seaglint.able) return;
  const set = JSON.parse(place.querySelector("script").textContent);
  const { element } = seaglint;
  const NAMED = 5, NARROW = 700, BALL = [3, 16], RED = "#ff4d4d", INK = "#1c2733", INCIDENCE = "#d55e00", WATER = "#0072b2";
  const short = (x) => Number(x.toPrecision(6)).toString();
  const radians = (deg) => (deg * Math.PI) / 180;
  const direction = (azimuth, elevation) => [Math.cos(radians(elevation)) * Math.cos(radians(azimuth)), Math.cos(radians(elevation)) * Math.sin(radians(azimuth)), Math.sin(radians(elevation))];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const along = (p, a, r) => p.map((x, i) => x + a * r[i]);

  const box = element("div", { className: "interactive" });
  place.prepend(box);
  const choice = (id, texts) => element("select", { id }, ...texts.map((text, i) => element("option", { value: i, textContent: text })));
  const slider = (id, min, max, value) => element("input", { type: "range", id, min, max, step: 1, value });
  const labelled = (text, control, ...more) => element("label", {}, text + " ", control, ...more);
  const target = choice("hot-spot-target", set.targets.map((t) => t.name)), kind = choice("hot-spot-element", set.elements);
  const aspect = slider("hot-spot-view", 0, 0, 0), output = element("output", { htmlFor: "hot-spot-view" });
  const turn = slider("hot-spot-azimuth", -180, 180, 0), tilt = slider("hot-spot-elevation", -89, 89, 0), seen = element("output", { htmlFor: "hot-spot-azimuth hot-spot-elevation" });
  const back = element("button", { type: "button", id: "hot-spot-radar", textContent: "From the radar" });
  const plot = element("div", { role: "img" }), list = element("p", { className: "caption" });
  list.setAttribute("aria-live", "polite");
  const controls = element("div", { className: "controls" });
  if (set.targets.length > 1) controls.append(labelled("Target", target));
  if (set.targets.some((t) => t.views.length > 1)) controls.append(labelled("View", aspect, " ", output));
  if (set.elements.length > 1) controls.append(labelled("Level", kind));
  controls.append(labelled("Seen from azimuth", turn), labelled("elevation", tilt), seen, back);
  box.append(controls, plot, list);

  const meshes = new Map();
  async function mesh(of) {
    if (meshes.has(of)) return meshes.get(of);
    const floats = async (packed) => new Float32Array(await seaglint.inflate(packed));
    const xyz = await floats(of.vertices), water = await floats(of.waterline), corners = new Uint32Array(await seaglint.inflate(of.triangles));
    for (let i = 1; i < corners.length; ++i) corners[i] += corners[i - 1];  // modulo 2^32
    const every = (values, n, first) => Array.from({ length: values.length / n }, (_, i) => values[n * i + first]);
    const geometry = { x: every(xyz, 3, 0), y: every(xyz, 3, 1), z: every(xyz, 3, 2), i: every(corners, 3, 0), j: every(corners, 3, 1), k: every(corners, 3, 2) };
    const extents = [geometry.x, geometry.y, geometry.z].map((values) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]));
    const sides = extents.map(([low, high]) => high - low);
    const made = { geometry, sides, centre: extents.map(([low, high]) => (low + high) / 2), size: Math.max(...sides) };
    made.part = new Uint16Array(await seaglint.inflate(of.triangle_parts));
    // Segments of the section, each followed by a gap.
    made.waterline = [0, 1, 2].map((c) => Array.from({ length: water.length / 2 }, (_, n) => (n % 3 === 2 ? null : water[6 * Math.floor(n / 3) + 3 * (n % 3) + c])));
    meshes.set(of, made);
    return made;
  }

  // Right and up of one who sees the target from there.
  const across = (azimuth) => [-Math.sin(radians(azimuth)), Math.cos(radians(azimuth)), 0];
  const upOf = (azimuth, elevation) => [-Math.sin(radians(elevation)) * Math.cos(radians(azimuth)), -Math.sin(radians(elevation)) * Math.sin(radians(azimuth)), Math.cos(radians(elevation))];

  let follows = true, shown = null, latest = 0;
  function look(azimuth, elevation) {
    turn.value = ((((azimuth + 180) % 360) + 360) % 360) - 180;
    tilt.value = elevation;
    say();
  }
  function say() {
    seen.textContent = `${turn.value} deg, ${tilt.value} deg`;
    turn.setAttribute("aria-valuetext", `seen from azimuth ${turn.value} deg`);
    tilt.setAttribute("aria-valuetext", `seen from elevation ${tilt.value} deg`);
  }
  // The direction from which the target is seen; the eye is outside the scene.
  const eye = () => (follows ? direction(shown.view.azimuth_deg, Math.max(-89.9, Math.min(89.9, shown.view.elevation_deg))) : direction(Number(turn.value), Number(tilt.value)));
  const camera = () => {
    const [x, y, z] = eye().map((v) => 12 * v);
    return { eye: { x, y, z }, up: { x: 0, y: 0, z: 1 }, center: { x: 0, y: 0, z: 0 }, projection: { type: "orthographic" } };
  };

  const source = (of, c) => `${of.parts[c[3]]}, ${set.mechanisms[c[5]]}, ${c[4]} bounce${c[4] === 1 ? "" : "s"}`;
  const brief = (c) => (c[5] === 0 ? `${c[4]} bounce${c[4] === 1 ? "" : "s"}` : set.mechanisms[c[5]]);

  // Balls stand before their places, so that the surface does not hide half of them: in this projection where they were.
  const BEFORE = 36;  // pixels
  function ballPlaces(some) {
    const places = some.map((c) => along(c, BEFORE / shown.pixels_per_m, eye()));
    return [0, 1, 2].map((c) => places.map((p) => p[c]));
  }
  const ballKinds = () => [(c) => c[5] === 0, (c) => c[5] !== 0].map((kind) => shown.within.filter(kind));
  function balls(some, name, colour) {
    const { of, level } = shown, [x, y, z] = ballPlaces(some);
    return { type: "scatter3d", mode: "markers", name, showlegend: some.length > 0, x, y, z,
      marker: { size: some.map((c) => ballSize(level(c), shown.strongest_dbsm)), color: colour, opacity: 1, line: { color: INK, width: 1 } }, customdata: some.map((c) => [source(of, c), level(c), c[0], c[1], c[2]]),
      hovertemplate: "%{customdata[0]}<br>%{customdata[1]:.1f} dBsm<br>x %{customdata[2]:.2f} m, y %{customdata[3]:.2f} m, z %{customdata[4]:.2f} m<extra></extra>" };
  }
  const ballSize = (level, top) => (plot.clientWidth < NARROW ? 0.6 : 1) * (BALL[0] + (BALL[1] - BALL[0]) * Math.min(1, Math.max(0, 1 + (level - top) / set.ball_range_db)));

  // Part, level and middle of every facet.
  function facetTexts(intensity, bottom) {
    const { of, made } = shown, { x, y, z, i, j, k } = made.geometry, middle = (values, n) => ((values[i[n]] + values[j[n]] + values[k[n]]) / 3).toFixed(2);
    return intensity.map((level, n) => `${of.parts[made.part[n]]}, ${level > bottom ? level : "below " + bottom} dBsm<br>x ${middle(x, n)} m, y ${middle(y, n)} m, z ${middle(z, n)} m`);
  }

  // Extents of the target in the view of the radar: half its width, its lowest point.
  function seenExtent(made, azimuth, elevation) {
    const right = across(azimuth), up = upOf(azimuth, elevation), { x, y, z } = made.geometry;
    let half = 0, lowest = 0;
    for (let i = 0; i < x.length; ++i) {
      const p = [x[i] - made.centre[0], y[i] - made.centre[1], z[i] - made.centre[2]];
      half = Math.max(half, Math.abs(dot(p, right)));
      lowest = Math.min(lowest, dot(p, up));
    }
    return { right, up, half, lowest };
  }

  // The axes of the target, of a round length, beside it.
  function axes(made, azimuth, elevation) {
    const { right, up, half, lowest } = seenExtent(made, azimuth, elevation), most = 0.12 * made.size, power = 10 ** Math.floor(Math.log10(most));
    const length = power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1), from = along(along(made.centre, -half - 0.1 * made.size, right), lowest, up);
    const points = [0, 1, 2].flatMap((c) => [from, from.map((v, i) => v + (i === c ? length : 0)), [null, null, null]]);
    return { type: "scatter3d", mode: "lines+text", name: `axes of ${short(length)} m: x forward, y to port, z up`, x: points.map((p) => p[0]), y: points.map((p) => p[1]), z: points.map((p) => p[2]), text: ["", "x", "", "", "y", "", "", "z", ""], textfont: { size: 12, color: INK }, line: { color: INK, width: 3 }, hoverinfo: "skip" };
  }

  // The direction of incidence, an arrow below the target.
  function incidence(made, azimuth, elevation) {
    const r = direction(azimuth, elevation), { up, lowest } = seenExtent(made, azimuth, elevation);
    const beside = along(made.centre, lowest - 0.04 * made.size, up), near = along(beside, 0.05 * made.size, r), far = along(beside, 0.3 * made.size, r);
    const line = { type: "scatter3d", mode: "lines+text", x: [near[0], far[0]], y: [near[1], far[1]], z: [near[2], far[2]], text: ["", "from the radar"], textposition: "bottom center", textfont: { color: INCIDENCE, size: 12 }, line: { color: INCIDENCE, width: 6 }, hoverinfo: "skip", showlegend: false };
    const head = { type: "cone", x: [near[0]], y: [near[1]], z: [near[2]], u: [-r[0]], v: [-r[1]], w: [-r[2]], anchor: "tip", sizemode: "absolute", sizeref: 0.05 * made.size, colorscale: [[0, INCIDENCE], [1, INCIDENCE]], showscale: false, hoverinfo: "skip" };
    return [line, head];
  }

  // Names of the strongest centres above the target, each as near above its point as the others leave; a narrow window has
  // their numbers. They keep their distances from their points while the target turns and are placed anew after it.
  function names() {
    const { of, strongest, level } = shown;
    const scene = plot._fullLayout?.scene?._scene, params = scene?.glplot?.cameraParams, narrow = plot.clientWidth < NARROW;
    const pixels = (c) => {
      const times = (m, v) => [0, 1, 2, 3].map((i) => m[i] * v[0] + m[4 + i] * v[1] + m[8 + i] * v[2] + m[12 + i] * v[3]);
      const v = times(params.projection, times(params.view, times(params.model, [c[0] * scene.dataScale[0], c[1] * scene.dataScale[1], c[2] * scene.dataScale[2], 1])));
      return [(0.5 + (0.5 * v[0]) / v[3]) * scene.container.clientWidth, (0.5 - (0.5 * v[1]) / v[3]) * scene.container.clientHeight];
    };
    let offsets = strongest.map((_, i) => [60 * (i - (strongest.length - 1) / 2), -60 - 26 * (i % 2)]);
    if (params?.projection && scene.container) {
      const at = strongest.map(pixels), order = at.map((_, i) => i).sort((a, b) => at[a][0] - at[b][0] || a - b), width = scene.container.clientWidth;
      const apart = narrow ? 36 : Math.min(170, width / strongest.length), columns = order.map((i) => at[i][0]);
      for (let i = 0; i < columns.length; ++i) columns[i] = Math.max(columns[i], i > 0 ? columns[i - 1] + apart : apart / 2);
      for (let i = columns.length; i-- > 0; ) columns[i] = Math.min(columns[i], i + 1 < columns.length ? columns[i + 1] - apart : width - apart / 2);
      order.forEach((i, slot) => { offsets[i] = [columns[slot] - at[i][0], 34 - at[i][1]]; });
    }
    const most = Math.floor(Math.min(170, plot.clientWidth / strongest.length) / 6) - 2, cut = (text) => (text.length > most ? text.slice(0, most - 1) + "…" : text);
    return strongest.map((c, i) => ({ x: c[0], y: c[1], z: c[2], ax: offsets[i][0], ay: offsets[i][1], text: narrow ? String(i + 1) : `<b>${i + 1}</b> ${cut(of.parts[c[3]])}<br>${cut(brief(c))}<br>${level(c).toFixed(1)} dBsm`,
      showarrow: true, arrowhead: 0, arrowwidth: 1, arrowcolor: INK, font: { size: 12, color: INK }, bgcolor: "rgba(255,255,255,0.85)", borderpad: 2 }));
  }

  async function show() {
    const of = set.targets[target.value], index = Number(kind.value);
    aspect.max = of.views.length - 1;
    const view = of.views[aspect.value], ours = ++latest, wanted = [target.value, aspect.value, ...(set.elements.length > 1 ? [kind.value] : [])].join(",");
    output.textContent = `azimuth ${short(view.azimuth_deg)} deg, elevation ${short(view.elevation_deg)} deg`;
    aspect.setAttribute("aria-valuetext", output.textContent);
    const made = await mesh(of), steps = new Uint8Array(await seaglint.inflate(view.levels[index])), plotly = await seaglint.plotly();
    if (ours !== latest) return;  // another view was chosen meanwhile
    const level = (c) => c[6 + index], centres = [...view.centres].sort((a, b) => level(b) - level(a)), strongest_dbsm = centres.length ? level(centres[0]) : 0;
    const within = centres.filter((c) => level(c) >= strongest_dbsm - set.ball_range_db), strongest = within.slice(0, NAMED);
    // Half of the scene's height is 1. Seen from the radar the target has room at its sides, and above for the names; from
    // elsewhere it is hardly wider than the window.
    const narrow = plot.clientWidth < NARROW, height = narrow ? 420 : 600, [dx, dy, dz] = made.sides, { half } = seenExtent(made, view.azimuth_deg, view.elevation_deg);
    const scale = Math.min((1.75 * (plot.clientWidth - 90)) / height / Math.max(2.35 * half, 0.75 * Math.hypot(dx, dy)), 1.3 / Math.max(dz, 0.01 * made.size));
    shown = { of, view, made, level, strongest_dbsm, within, strongest, pixels_per_m: (scale * (height - 50)) / 2 };
    if (follows) look(Math.round(view.azimuth_deg), Math.max(-89, Math.min(89, Math.round(view.elevation_deg))));
    const top = of.top_dbsm[index], bottom = top - set.range_db, grey = set.step_db / 2 / set.range_db;
    const intensity = Array.from(steps, (step) => bottom + step * set.step_db);
    const viridis = ["#440154", "#472c7a", "#3b518b", "#2c718e", "#21908d", "#27ad81", "#5cc863", "#aadc32", "#fde725"];
    const surface = { type: "mesh3d", ...made.geometry, intensity, intensitymode: "cell", cmin: bottom, cmax: top, colorscale: [[0, "#cdd0d4"], [grey, "#cdd0d4"], ...viridis.map((colour, i) => [grey + ((1 - grey) * i) / 8, colour])], flatshading: true,
      lighting: { ambient: 0.85, diffuse: 0.3, specular: 0.02 }, colorbar: { title: { text: "facets (dBsm)", side: "right" }, thickness: 12, len: 0.8 }, hovertext: facetTexts(intensity, bottom), hoverinfo: "text" };
    const [x, y, z] = made.waterline;
    const [reflections, diffraction] = ballKinds();
    const data = [surface, balls(reflections, "reflections", RED), balls(diffraction, "edge diffraction", "#ffffff"),
      { type: "scatter3d", mode: "lines", name: "z = 0", x, y, z, line: { color: WATER, width: 4 }, hoverinfo: "skip", showlegend: x.length > 0 }, axes(made, view.azimuth_deg, view.elevation_deg),
      ...incidence(made, view.azimuth_deg, view.elevation_deg)];
    const cube = 1.1 * made.size, ratio = 2 * cube * scale;  // with room for what stands beside the target
    const total = view.total_dbsm[index] > -300 ? `${short(view.total_dbsm[index])} dBsm in all` : "no echo";
    const axis = (c) => ({ visible: false, range: [made.centre[c] - cube, made.centre[c] + cube] });
    const layout = { template: "none", height, margin: { l: 0, r: 0, t: 32, b: 0 }, showlegend: !narrow, legend: { orientation: "h", x: 0, y: 0, font: { size: 11 } }, title: { text: narrow ? total : `${of.name}: ${total} (${set.elements[index]})`, font: { size: 13 }, x: 0.02 },
      scene: { aspectmode: "manual", aspectratio: { x: ratio, y: ratio, z: ratio }, dragmode: "turntable", xaxis: axis(0), yaxis: axis(1), zaxis: axis(2), camera: camera(), annotations: [] } };
    await plotly.react(plot, data, layout, seaglint.CONFIG);
    listen(plotly);
    place_names(plotly);
    list.textContent = strongest.length ? `Strongest: ${strongest.map((c, i) => `${i + 1} ${source(of, c)}, ${level(c).toFixed(1)} dBsm`).join("; ")}. ${within.length} balls (red: reflections, white: edge diffraction), the largest ${strongest_dbsm.toFixed(1)} dBsm, the smallest ${(strongest_dbsm - set.ball_range_db).toFixed(1)} dBsm.` : "No echo in this element.";
    plot.dataset.shown = wanted;
    plot.dataset.strongest = Math.max(...intensity);
    plot.dataset.centres = JSON.stringify(strongest.map((c) => [of.parts[c[3]], c[4], level(c)]));
    plot.setAttribute("aria-label", `Facets of ${of.name} coloured by their echo, ${output.textContent}. ${list.textContent}`);
  }

  // Balls and names by the present view.
  let placing = false;
  function place_names(plotly) {
    requestAnimationFrame(() => requestAnimationFrame(async () => {
      placing = true;
      const [x, y, z] = [0, 1, 2].map((c) => ballKinds().map((some) => ballPlaces(some)[c]));
      await plotly.update(plot, { x, y, z }, { "scene.annotations": names() }, [1, 2]);
      placing = false;
    }));
  }

  let listens = false;
  function listen(plotly) {
    if (listens) return;
    listens = true;
    plot.on("plotly_relayout", (change) => {
      if (placing) return;
      const now = change["scene.camera"]?.eye;
      if (now) {
        const length = Math.hypot(now.x, now.y, now.z);
        follows = false;
        look(Math.round((Math.atan2(now.y, now.x) * 180) / Math.PI), Math.round((Math.asin(now.z / length) * 180) / Math.PI));
      }
      place_names(plotly);
    });
  }

  async function turned() {
    follows = false;
    say();
    const plotly = await seaglint.plotly();
    await plotly.relayout(plot, { "scene.camera": camera() });
  }
  const run = (action) => () => action().catch((error) => console.error(error));
  for (const control of [target, aspect, kind]) control.addEventListener("input", run(show));
  for (const control of [turn, tilt]) control.addEventListener("input", run(turned));
  back.addEventListener("click", run(() => { follows = true; return show(); }));
  seaglint.whenSeen(place, () => seaglint.takePlace(place, show));
})().catch((error) => console.error(error));
