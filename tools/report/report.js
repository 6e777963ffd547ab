// SPDX-License-Identifier: BSD-3-Clause
'use strict';
// Maps and features of a report. The samples' columns and some maps lie packed in the page; classes, columns and their
// units are those of the file.
(async () => {
  const explorer = document.getElementById('explorer');
  if (!explorer || !seaglint.able) return;
  const set = JSON.parse(explorer.querySelector('script').textContent);
  const columns = {};
  for (const column of set.columns) columns[column.name] = new Float32Array(await seaglint.inflate(column.packed));
  const rows = columns.sample.length;
  const name = (row) => set.targets[columns.target[row]];
  const mapOf = new Map(set.maps.map((map) => [map.row, map]));
  const unique = (values) => [...new Set(values)].sort((a, b) => a - b);
  const short = (value) => String(Number(value.toPrecision(4)));
  // A quantity in bins: numbers and texts of these, and the bin of every row.
  async function choice({texts, bins, first}) {
    return {numbers: texts.map((_, i) => i), texts, first, of: new Uint8Array(await seaglint.inflate(bins))};
  }
  const label = (target) => columns.label[columns.target.indexOf(target)];
  const targets = unique(columns.target).sort((a, b) => label(a) - label(b) || a - b),  // colours as in the other plots
      heights = await choice(set.heights), azimuths = await choice(set.azimuths);

  const {element} = seaglint;
  function boxes(title, values, text) {
    const set = element(
        'fieldset', {}, element('legend', {textContent: title, style: 'float:left;margin-right:8px;font-weight:600'}));
    const inputs = values.map((value) => {
      const input = element('input', {type: 'checkbox', checked: true, value});
      set.append(element('label', {style: 'margin-right:10px'}, input, ' ' + text(value)));
      return input;
    });
    return {set, chosen: () => new Set(inputs.filter((input) => input.checked).map((input) => Number(input.value)))};
  }
  function select(title, values, text) {
    const input = element('select', {}, ...values.map((value) => element('option', {value, textContent: text(value)})));
    return {set: element('label', {}, title + ' ', input), input};
  }

  // A map with its scattering centres; the readout is in the units of the axes.
  async function drawMap(place, row) {
    place.dataset.wanted = row;  // by the last of several choices, which may arrive while an earlier one is unpacked
    const {range, velocity} = set;
    const levels = new Uint8Array(await seaglint.inflate(mapOf.get(row).packed));
    if (place.dataset.wanted !== String(row)) return;
    const at = (axis, i) => axis.first + axis.step * i;
    const z = [];
    for (let v = 0; v < velocity.count; ++v)
      z.push(Array.from(
          levels.subarray(v * range.count, (v + 1) * range.count), (level) => set.floor_db + level * set.step_db));
    const centres = mapOf.get(row).centres;
    const heat = {
      type: 'heatmap',
      z,
      x: Array.from({length: range.count}, (_, i) => at(range, i)),
      y: Array.from({length: velocity.count}, (_, i) => at(velocity, i)),
      zmin: set.floor_db,
      zmax: 0,
      colorscale: 'Viridis',
      colorbar: {title: {text: 'dB', side: 'right'}, thickness: 12},
      hovertemplate: 'range %{x:.2f} m<br>velocity %{y:.3f} m/s<br>%{z:.0f} dB<extra></extra>'
    };
    const points = {
      type: 'scatter',
      mode: 'markers',
      name: 'scattering centres',
      x: centres.map((c) => c[0]),
      y: centres.map((c) => c[1]),
      text: centres.map((c) => short(c[2])),
      marker: {symbol: 'circle-open', size: 9, color: '#fff', line: {width: 1.5}},
      hovertemplate:
          'centre: range %{x:.2f} m<br>velocity %{y:.3f} m/s<br>%{text} dB relative to the strongest cell<extra></extra>'
    };
    const layout = {
      template: 'none',
      title: {text: title(row), font: {size: 13}, x: 0.02},
      margin: {l: 58, r: 8, t: 32, b: 44},
      height: 370,
      showlegend: false,
      xaxis: seaglint.axis({label: 'range relative to the reference (m)'}),
      yaxis: seaglint.axis({label: 'velocity, positive = receding (m/s)'})
    };
    const plotly = await seaglint.plotly();
    await plotly.react(place, [heat, points], layout, seaglint.CONFIG);
    plotly.Plots.resize(place);  // maps beside it may have come or gone
    place.setAttribute(
        'aria-label', 'Range-velocity map of ' + title(row) + ', ' + centres.length + ' scattering centres');
    place.dataset.sample = columns.sample[row];
  }
  const title = (row) => `${name(row)}, azimuth ${short(columns.azimuth_deg[row])} deg, Hs ${
      short(columns.significant_wave_height_m[row])} m, sample ${columns.sample[row]}`;
  const elsewhere = (row) =>
      `The page does not contain this map: seaglint map scenario.yaml --sample ${columns.sample[row]} -o map.png`;
  const features = (row) =>
      set.columns.filter((column) => column.feature)
          .map(
              (column) =>
                  `${column.name} ${short(columns[column.name][row])}${column.unit === '1' ? '' : ' ' + column.unit}`)
          .join(', ');

  // Maps of all chosen targets at one aspect and wave height.
  const view = element('div', {className: 'interactive'});
  explorer.prepend(view);
  const ofTargets = boxes('Targets', targets, (t) => set.targets[t]),
        ofHeight = select('Hs (m)', heights.numbers, (i) => heights.texts[i]);
  ofHeight.input.id = 'height';
  const slider = element(
      'input', {type: 'range', min: 0, max: azimuths.texts.length - 1, step: 1, value: azimuths.first, id: 'aspect'});
  const output = element('output', {htmlFor: 'aspect'});
  const maps = element('div', {className: 'maps'});
  view.append(
      element(
          'div', {className: 'controls'}, ofTargets.set, ofHeight.set,
          element('label', {}, 'Azimuth ', slider, ' ', output)),
      maps, element('p', {
        textContent: `Maps of this page: whole decibels; each cell has the strongest of ${set.velocity.cells} by ${
            set.range.cells} cells (velocity, range) of the data set.`,
        style: 'font-size:13.5px'
      }));
  async function showMaps() {
    const azimuth = Number(slider.value), height = Number(ofHeight.input.value);
    output.textContent = azimuths.texts[azimuth] + ' deg';
    slider.setAttribute('aria-valuetext', output.textContent);
    const shown = ofTargets.chosen(), wanted = [];
    for (const target of shown) {
      const of = (row) => columns.target[row] === target && azimuths.of[row] === azimuth && heights.of[row] === height;
      const row = set.maps.map((map) => map.row).find(of) ?? columns.target.findIndex((_, row) => of(row));
      wanted.push(row);
    }
    while (maps.children.length > wanted.length) maps.lastChild.remove();
    while (maps.children.length < wanted.length)
      maps.append(element('div', {}, element('div', {role: 'img'}), element('p')));
    for (const [i, row] of wanted.entries()) {
      const [place, text] = maps.children[i].children;
      place.hidden = !mapOf.has(row);
      text.textContent = row < 0 ? 'The data set has no map of this aspect and wave height.' :
          mapOf.has(row)         ? features(row) :
                                   elsewhere(row);
      if (mapOf.has(row)) await drawMap(place, row);
    }
  }
  for (const input of [slider, ofHeight.input, ofTargets.set]) input.addEventListener('input', showMaps);
  slider.value = azimuths.first;
  ofHeight.input.value = heights.first;
  seaglint.whenSeen(explorer, () => seaglint.takePlace(explorer, showMaps));

  // Scatter of two columns; a click or the numbered field opens the map of a sample.
  const scatter = document.getElementById('scatter'), plain = element('div', {className: 'interactive'});
  scatter.prepend(plain);
  const names = set.columns.filter((column) => column.varies).map((column) => column.name);
  const ofX = select('x', names, String), ofY = select('y', names, String),
        byTarget = boxes('Targets', targets, (t) => set.targets[t]),
        byHeight = boxes('Hs (m)', heights.numbers, (i) => heights.texts[i]);
  const log = element('input', {type: 'checkbox', checked: true});
  const number = element('input', {type: 'number', min: 0, step: 1, id: 'sample', style: 'width:7em'});
  ofX.input.id = 'x-column';
  ofY.input.id = 'y-column';
  ofX.input.value = names.includes('mwr') ? 'mwr' : names[0];
  ofY.input.value = names.includes('ccf') ? 'ccf' : names[1];
  const points = element('div', {role: 'img'}),
        chosen = element(
            'div', {className: 'chosen'},
            element('p', {textContent: 'A point, or the number of a sample, opens its map.'}),
            element('div', {role: 'img'}));
  chosen.firstChild.setAttribute('aria-live', 'polite');
  plain.append(
      element(
          'div', {className: 'controls'}, ofX.set, element('label', {}, log, ' log x'), ofY.set, byTarget.set,
          byHeight.set, element('label', {}, 'Sample ', number)),
      element('div', {className: 'maps'}, points, chosen));
  const unit = (of) => {
    const column = set.columns.find((c) => c.name === of);
    return column.unit === '1' ? of : `${of} (${column.unit})`;
  };
  const FLOOR = 1e-6;  // where zeros of a logarithmic axis stand
  async function showPoints() {
    const x = columns[ofX.input.value], y = columns[ofY.input.value], shown = byTarget.chosen(),
          heightsShown = byHeight.chosen();
    const data = targets.filter((t) => shown.has(t)).map((t) => {
      const style = targets.indexOf(t) % 7;
      const picked = [];
      for (let row = 0; row < rows; ++row)
        if (columns.target[row] === t && heightsShown.has(heights.of[row])) picked.push(row);
      return {
        type: 'scattergl',
        mode: 'markers',
        name: set.targets[t],
        x: picked.map((row) => (log.checked ? Math.max(x[row], FLOOR) : x[row])),
        y: picked.map((row) => y[row]),
        customdata: picked,
        text: picked.map(title),
        hovertemplate: '%{x:.4g}, %{y:.4g}<br>%{text}<extra></extra>',
        marker: {color: seaglint.COLOURS[style], symbol: seaglint.SYMBOLS[style], size: 6, opacity: 0.7}
      };
    });
    const layout = {
      template: 'none',
      margin: {l: 60, r: 12, t: 12, b: 48},
      height: 400,
      hovermode: 'closest',
      legend: {orientation: 'h', y: 1.08},
      xaxis: seaglint.axis({label: unit(ofX.input.value), log: log.checked}),
      yaxis: seaglint.axis({label: unit(ofY.input.value)})
    };
    await (await seaglint.plotly()).react(points, data, layout, seaglint.CONFIG);
    points.dataset.points = data.reduce((sum, trace) => sum + trace.x.length, 0);
    points.setAttribute(
        'aria-label', `${unit(ofY.input.value)} against ${unit(ofX.input.value)}, ${points.dataset.points} samples`);
    points.removeAllListeners('plotly_click');
    points.on('plotly_click', (event) => open(event.points[0].customdata));
  }
  async function open(row) {
    const [text, place] = chosen.children;
    number.value = columns.sample[row];
    place.hidden = !mapOf.has(row);
    text.textContent = title(row) + ': ' + features(row) + (place.hidden ? '. ' + elsewhere(row) : '');
    if (!place.hidden) await drawMap(place, row);
  }
  number.addEventListener('change', () => {
    if (number.value === '') return;
    const row = columns.sample.indexOf(Number(number.value));
    if (row >= 0)
      open(row);
    else {
      chosen.firstChild.textContent = `The data set has no sample ${number.value}.`;
      chosen.lastChild.hidden = true;  // the map of the sample before
    }
  });
  for (const input of [ofX.input, ofY.input, log, byTarget.set, byHeight.set])
    input.addEventListener('input', showPoints);
  seaglint.whenSeen(scatter, () => seaglint.takePlace(scatter, showPoints));
})().catch((error) => console.error(error));
