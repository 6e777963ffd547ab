// SPDX-License-Identifier: BSD-3-Clause
"use strict";
// Unpacks plotly and draws the plots of a page in place of their pictures when they come into view. A browser without
// DecompressionStream, print and a page without scripts show the pictures.
const seaglint = (() => {
  // Okabe and Ito's colours, told apart by colour-blind readers, and a symbol for each.
  const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];
  const SYMBOLS = ["circle", "diamond-open", "square", "x", "triangle-up", "cross", "star"];

  async function inflate(base64, format = "deflate") {
    const text = atob(base64), bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream(format))).arrayBuffer();
  }

  let loading = null;
  function plotly() {
    loading ??= (async () => {
      const source = new TextDecoder().decode(await inflate(document.getElementById("plotly").textContent, "gzip"));
      const script = document.createElement("script");
      script.textContent = source;
      document.head.append(script);
      return window.Plotly;
    })();
    return loading;
  }

  function axis(of, extra = {}) {
    const settings = { title: { text: of.label, standoff: 6 }, type: of.log ? "log" : "linear", zeroline: false, exponentformat: "power", gridcolor: "#dde3e9", automargin: true, ...extra };
    if (of.range) settings.range = of.log ? of.range.map(Math.log10) : of.range;
    return settings;
  }

  // `names`: of the series so far; a name has one colour, and one entry in the legend, in all panels.
  function traces(panel, suffix, names) {
    return panel.series.flatMap((series) => {
      const first = !names.includes(series.name);
      if (first) names.push(series.name);
      const i = names.indexOf(series.name);
      const colour = series.colour ?? COLOURS[i % COLOURS.length];
      const trace = { x: series.x, y: series.y, name: series.name, legendgroup: series.name, showlegend: first && series.name !== "", type: series.x.length > 2000 ? "scattergl" : "scatter",
        xaxis: "x" + suffix, yaxis: "y" + suffix, mode: { lines: "lines", points: "markers", linespoints: "lines+markers", band: "lines" }[series.style],
        line: { color: colour, width: series.width ?? 1.6, dash: series.colour ? "solid" : ["solid", "dash", "dot"][i % 3] }, marker: { color: colour, symbol: SYMBOLS[i % SYMBOLS.length], size: 6, opacity: 0.75 } };
      if (!series.low) return [trace];
      if (series.style === "band") {
        const edge = { ...trace, showlegend: false, line: { width: 0 }, mode: "lines", hoverinfo: "skip" };
        return [{ ...edge, y: series.low }, { ...edge, y: series.high, fill: "tonexty", showlegend: trace.showlegend }];
      }
      trace.error_y = { type: "data", symmetric: false, color: colour, thickness: 1, array: series.high.map((high, k) => high - series.y[k]), arrayminus: series.low.map((low, k) => series.y[k] - low) };
      return [trace];
    });
  }

  // The figure of a plot_json(): panels in rows of `columns`.
  function figure(plot) {
    const rows = Math.ceil(plot.panels.length / plot.columns);
    const layout = { template: "none", font: { size: 12 }, margin: { l: 64, r: 16, t: 34, b: 52 }, hovermode: "closest", legend: { orientation: "h", yanchor: "top", y: -50 / (400 * rows - 86) }, annotations: [], height: 400 * rows };
    const data = [], names = [];
    plot.panels.forEach((panel, i) => {
      const suffix = i === 0 ? "" : String(i + 1), column = i % plot.columns, row = Math.floor(i / plot.columns);
      const across = [(column + (column ? 0.2 : 0)) / plot.columns, (column + 1) / plot.columns];
      const upward = [(rows - row - 1 + (rows > 1 ? 0.14 : 0)) / rows, (rows - row - (rows > 1 ? 0.08 : 0)) / rows];
      layout["xaxis" + suffix] = axis(panel.x, { domain: across, anchor: "y" + suffix });
      layout["yaxis" + suffix] = axis(panel.y, { domain: upward, anchor: "x" + suffix, ...(panel.equal ? { scaleanchor: "x" + suffix } : {}) });
      layout.annotations.push({ text: panel.title, showarrow: false, xref: "paper", yref: "paper", x: across[0], y: upward[1], xanchor: "left", yanchor: "bottom", font: { size: 13 } });
      for (const [x, y, text] of panel.marks ?? []) layout.annotations.push({ text, textangle: -60, showarrow: false, xref: "x" + suffix, yref: "y" + suffix, x, y, xanchor: "left", yanchor: "bottom", font: { size: 11 } });
      data.push(...traces(panel, suffix, names));
    });
    return { data, layout };
  }

  const CONFIG = { responsive: true, displaylogo: false, modeBarButtonsToRemove: ["lasso2d", "select2d"] };

  async function draw(element) {
    const plot = JSON.parse(element.querySelector("script").textContent);
    if (element.clientWidth < 700) plot.columns = 1;
    const { data, layout } = figure(plot);
    const place = document.createElement("div");
    place.className = "interactive";
    place.setAttribute("role", "img");
    place.setAttribute("aria-label", element.querySelector("img").alt);
    const library = await plotly();
    element.prepend(place);
    element.classList.add("drawn");  // before the plot, which takes the width of its place
    await library.newPlot(place, data, layout, CONFIG);
  }

  function element(tag, properties = {}, ...children) {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  }

  // Calls `action` once, when the element comes near the window.
  function whenSeen(element, action) {
    const observer = new IntersectionObserver((entries) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      action(element).catch((error) => console.error(error));
    }, { rootMargin: "300px" });
    observer.observe(element);
  }

  // Pictures stay until plotly is there; then what is drawn takes their place, and so has a width.
  async function takePlace(element, show) {
    await plotly();
    element.classList.add("drawn");
    return show();
  }

  const able = "DecompressionStream" in window;
  if (able) document.querySelectorAll("figure.plot").forEach((element) => whenSeen(element, draw));
  return { able, inflate, plotly, whenSeen, takePlace, element, axis, figure, COLOURS, SYMBOLS, CONFIG };
})();
