# SPDX-License-Identifier: BSD-3-Clause
"""Sea clutter beside measurements, a section of the page of tools/validation: statistics of I/Q of scenarios/clutter.yaml by the definitions of
tests/reference/sea_clutter/SOURCE.md, and its power over range and time beside the waves."""
import csv
import html
import json
import math

import numpy as np

import validation_page
import validation_plot
from validation_run import seaglint

C = 299792458.0  # m/s
BLOCK = 128      # pulses
WIDTH_S = 4e-6   # of the pulses of SCENARIO
SEEDS = range(1, 11)
SCENARIO = "scenarios/clutter.yaml"
# With Hann's taper a band of 7.5 MHz has cells as wide as those of 200 ns, 30 m.
RECORD = {"radar.pulses": 131072, "radar.bandwidth_mhz": 7.5, "radar.hop_step_mhz": 7.5, "radar.sampling_mhz": 7.5, "radar.range_km": 2.6, "map.range_span_m": 230}
HIGH = {"sea.significant_wave_height_m": 2.2, "sea.peak_period_s": 6.5, "clutter.texture_shape": 1.741}
LOW = {"sea.significant_wave_height_m": 0.3, "sea.peak_period_s": 6, "clutter.texture_shape": 32.3}
INDEPENDENT = {**HIGH, "clutter.texture": "independent", "clutter.doppler_spread_mps": 0.13}
# 61 s with the cells of wave radars.
WIDE = {"radar.pulses": 30720, "radar.pri_us": 2000, "radar.bandwidth_mhz": 20, "radar.hop_step_mhz": 20, "radar.sampling_mhz": 20, "map.range_span_m": 600}
WIDE_BLOCK = 64  # pulses, 0.128 s
LAGS = range(79)  # blocks, 10 s
SHOWN_S = 60      # of a cell
PHASE_MPS = 9.81 * 6.5 / (2 * math.pi)  # of waves of the peak period
RANGES_M = np.arange(-290, 291, 5.0)

ABOUT = """I/Q of one range cell of 30 m over 131 s, 1,000 pulses a second at 9.39 GHz: two records of the IPIX radar of 1993, a high and a low sea (<code>tests/reference/sea_clutter</code>), beside <code>seaglint echo scenarios/clutter.yaml</code> with noise, mean and standard deviation of ten seeds.
All statistics are of blocks of 128 pulses and by the same definitions. Velocity is that of approach in this section."""
CHOSEN = """Height and period of the measured seas are not known. They are chosen so that the simulated velocities have the measured spread and the power of the high sea has the measured period: Hs 2.2 m, Tp 6.5 s; Hs 0.3 m, Tp 6 s. The shape of the texture is that of the measured second moment.
Neither polarisation nor direction of view are known; simulated are vv, grazing angle 0.6 deg, waves towards the radar with a spread of s = 10."""
LIMITS = """The simulated widths of the high sea are larger than measured and follow the power less; those of the low sea fall with rising power, measured ones hardly do. The measured low sea recedes by 0.37 m/s, presumably seen downwind; the simulated one approaches. In the measured low sea the power changes more slowly than speckle, and its third and fourth moment are lower than those of a K distribution, the fourth lower than that of Rayleigh clutter. These are signs of a steady echo, which the model has not.
A record of 131 s has 20 waves, so that its correlations are as uncertain as the deviations in the table. With <code>texture: independent</code> the power has a correlation time of 3 s and no period."""
WAVES = """Power of the same high sea (seed 42, texture by the defaults) in cells of 7.5 m over 580 m and 61 s, mean of 0.128 s; below it the elevation of the same sea realisation in the middle of the beam by <code>seaglint sea --at</code>. Both have the bands that travel towards the radar with the phase speed of the waves (dashed: 10 m/s, that of the peak period), in groups that travel half as fast. {correlation}
Right: spectra of both over wavenumber and frequency; energy lies on the dispersion relation of deep water, &omega;<sup>2</sup> = gk (dashed), on the side of approaching waves only, as in the images of wave radars. The power is no linear function of the waves; it has their second harmonic above and their groups below the relation in addition."""
CELL = """Doppler spectrogram of the 30 m cell, high sea, seed 1: spectra of 256 pulses with Hann's taper over a minute. The velocities follow the waves, and bright moments are faster and broader; below, power, velocity and width of its blocks."""


def record(scenario, settings, file):
    """The samples of every pulse, target, clutter and noise together, and the times and the wavelength that belong to them."""
    words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    seaglint("echo", scenario, *words, "-o", file)
    with np.load(file) as echo:
        made = {"samples": echo["clutter"] + echo["noise"], "time_s": echo["time_s"], "pri_s": float(echo["pulse_time_s"][1] - echo["pulse_time_s"][0]), "wavelength_m": C / float(echo["carrier_hz"][0]),
                "bandwidth_hz": 1e6 * settings["radar.bandwidth_mhz"], "start_s": json.loads(bytes(echo["description.json"]))["columns"]["start_s"] if "description.json" in echo else 0.0}
    file.unlink()
    return made


def compressed(echo, ranges_m, width_s=WIDTH_S):
    """X [pulse, range]: matched filter with Hann's taper over the band."""
    time_s, band = echo["time_s"], echo["bandwidth_hz"]
    f = np.fft.fftfreq(len(time_s), time_s[1] - time_s[0])
    taper = np.where(abs(f) <= band / 2, 1 + np.cos(2 * np.pi * f / band), 0)
    filter_ = taper * np.exp(1j * np.pi * f**2 * width_s / band)
    weights = np.exp(-2j * np.pi * np.outer(time_s, f)) @ (filter_[:, None] * np.exp(4j * np.pi * np.outer(f, ranges_m) / C))
    return (echo["samples"] @ weights.astype(np.complex64)).astype(complex)


def over_lags(x, lags):
    """Autocorrelation of a series."""
    x = x - x.mean()
    return np.array([np.mean(x[lag:] * x[:len(x) - lag]) * (len(x) - lag) / len(x) for lag in lags]) / np.mean(x**2)


def block_series(cell, pri_s, wavelength_m):
    """Power, velocity of approach and width (m/s) of blocks of pulses."""
    blocks = cell[:len(cell) // BLOCK * BLOCK].reshape(-1, BLOCK)
    per_rad = wavelength_m / (4 * np.pi * pri_s)
    r1, r2 = (np.mean(blocks[:, lag:] * np.conj(blocks[:, :-lag]), axis=1) for lag in (1, 2))
    width = np.sqrt(-2 * np.log(np.clip(abs(r2) / abs(r1), 1e-6, 1)) / 3) * per_rad
    return np.mean(abs(blocks) ** 2, axis=1), np.angle(r1) * per_rad, width


def statistics(cell, pri_s, wavelength_m):
    """The statistics of ipix.csv by name."""
    intensity = abs(cell) ** 2 / np.mean(abs(cell) ** 2)
    second = np.mean(intensity**2)
    shape = 2 / max(second - 2, 1e-3)
    power, velocity, width = block_series(cell, pri_s, wavelength_m)
    made = {"second moment": second}
    for name, n in (("third", 3), ("fourth", 4)):
        of_k = math.exp(math.lgamma(n + 1) + math.lgamma(shape + n) - math.lgamma(shape) - n * math.log(shape))
        made[f"{name} moment over K's"] = np.mean(intensity**n) / of_k
    made["power and velocity, correlation"] = np.corrcoef(power, velocity)[0, 1]
    made["log power and width, correlation"] = np.corrcoef(np.log(power), width)[0, 1]
    made["velocity weighted with power (m/s)"] = np.mean(power * velocity) / np.mean(power)
    made.update({"velocity, deviation (m/s)": velocity.std(), "width, mean (m/s)": width.mean(), "width, deviation over mean": width.std() / width.mean()})
    for seconds, lag in (("0.5", 4), ("1", 8), ("2", 16), ("3.1", 24), ("6.1", 48)):
        made[f"power over {seconds} s, correlation"] = over_lags(power, [lag])[0]
    for seconds, lag in (("1", 8), ("6.1", 48)):
        made[f"velocity over {seconds} s, correlation"] = over_lags(velocity, [lag])[0]
    return made


def seeds_of(sea, out):
    """Statistics of every seed, autocorrelations of its power, and the cell of the first."""
    found, lags, first = [], [], None
    for seed in SEEDS:
        echo = record(SCENARIO, {**RECORD, **sea, "seed": seed}, out / "clutter.npz")
        cell = compressed(echo, [0.0])[:, 0]
        first = first or (cell, echo["pri_s"], echo["wavelength_m"])
        found.append(statistics(cell, echo["pri_s"], echo["wavelength_m"]))
        lags.append(over_lags(block_series(cell, echo["pri_s"], echo["wavelength_m"])[0], LAGS))
    return {name: np.array([one[name] for one in found]) for name in found[0]}, np.array(lags), first


def measured():
    with open("tests/reference/sea_clutter/ipix.csv", encoding="utf-8") as stream:
        return {row["statistic"]: (float(row["high sea"]), float(row["low sea"])) for row in csv.DictReader(stream, delimiter=";")}


def row(name, measured_ones, columns):
    """Cells of the table: measured and simulated of the high sea, simulated with the independent texture, measured and simulated of the low sea."""
    digits = 3 if "m/s" in name else 2
    simulated = [f"{values[name].mean():.{digits}f}&nbsp;&plusmn;&nbsp;{values[name].std():.{digits}f}" for values in columns]
    return [name, f"{measured_ones[0]:.{digits}f}", simulated[0], simulated[1], f"{measured_ones[1]:.{digits}f}", simulated[2]]


def lag_panel(title, lags, column):
    points = [(float(name.split()[2]), values[column]) for name, values in measured().items() if name.startswith("power over")]
    seconds = [lag * BLOCK * 1e-3 for lag in LAGS]
    mean, deviation = lags.mean(axis=0), lags.std(axis=0)
    colour = "#0072b2"
    return validation_plot.panel(title, "time apart (s)", "correlation of power", (-0.6, 1), [
        validation_plot.series("simulated, deviation of one record", "band", colour, list(zip(seconds, mean)), mean - deviation, mean + deviation),
        validation_plot.series("simulated, mean", "lines", colour, list(zip(seconds, mean))), validation_plot.series("measured", "points", "#d55e00", points)])


def cell_panels(first):
    made, (power, velocity, width) = [], block_series(*first)
    count = int(SHOWN_S / (BLOCK * first[1]))
    seconds = [(i + 0.5) * BLOCK * first[1] for i in range(count)]
    for title, label, values in (("power", "power over its mean (dB)", 10 * np.log10(power / power.mean())), ("velocity of approach", "velocity (m/s)", velocity), ("width", "width (m/s)", width)):
        values = values[:count]
        made.append(validation_plot.panel(f"{title}, high sea, seed 1", "time (s)", label, (float(values.min()), float(values.max())), [validation_plot.series("", "lines", "#0072b2", list(zip(seconds, values)))]))
    return made


VIRIDIS = "set palette defined (0 '#440154', 1 '#414487', 2 '#2a788e', 3 '#22a884', 4 '#7ad151', 5 '#fde725')"
DIVERGING = "set palette defined (-1 '#2166ac', 0 '#f7f7f7', 1 '#b2182b')"


def image(values, x, y, file):
    """values [y, x] in a file, and the words with which gnuplot draws it."""
    values.astype("<f4").tofile(file)
    return f"'{file}' binary array=({len(x)},{len(y)}) format='%float32' origin=({x[0]},{y[0]}) dx={x[1] - x[0]} dy={y[1] - y[0]} with image notitle"


def spectrogram(first, out):
    """Doppler spectra of the cell over its first minute."""
    cell, pri_s, wavelength_m = first
    size, step = 256, 32
    starts = np.arange(0, int(SHOWN_S / pri_s) - size, step)
    parts = np.array([cell[n:n + size] for n in starts]) * np.hanning(size)
    level = 20 * np.log10(abs(np.fft.fftshift(np.fft.fft(parts), axes=1)).T + 1e-12)
    level -= np.percentile(level, 99.8)
    velocity = np.fft.fftshift(np.fft.fftfreq(size, pri_s)) * wavelength_m / 2
    drawn = image(level, (starts + size / 2) * pri_s, velocity, out / "clutter_spectrogram.bin")
    file = out / "clutter_spectrogram.png"
    validation_plot.gnuplot([f'set terminal pngcairo size 1400,480 font "sans,13"; set output "{file}"', VIRIDIS, f"set cbrange [-45:0]; set cblabel 'dB'; set xlabel 'time (s)'; set ylabel 'velocity of approach (m/s)'; set xrange [0:{SHOWN_S}]; set yrange [-5:8]", f"plot {drawn}"], file)
    return file


def power_map(out):
    """Power over its mean and elevation, [time, range], of the scenario, and their times."""
    echo = record(SCENARIO, WIDE, out / "clutter.npz")
    X = compressed(echo, RANGES_M)
    power = np.mean((abs(X) ** 2).reshape(-1, WIDE_BLOCK, len(RANGES_M)), axis=1)
    step_s = WIDE_BLOCK * echo["pri_s"]
    seconds = (np.arange(len(power)) + 0.5) * step_s
    elevation = np.empty_like(power)
    for i, range_m in enumerate(RANGES_M):
        file = out / "clutter_sea.csv"
        seaglint("sea", SCENARIO, "--at", f"{-range_m:g},0", "--duration-s", 80, "--step-s", step_s / 2, "-o", file)
        with open(file, encoding="utf-8") as stream:
            rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
        elevation[:, i] = np.interp(echo["start_s"] + seconds, *([float(row[name]) for row in rows] for name in ("time_s", "elevation_m")))
    file.unlink()
    return power / power.mean(), elevation, seconds


def spectrum(values, step_s):
    """Level (dB) over frequency and wavenumber of waves that approach, positive, and recede, negative."""
    values = (values - values.mean(axis=0)) * np.hanning(len(values))[:, None] * np.hanning(values.shape[1])
    size = (len(values), 4 * values.shape[1])
    # e^{j(w t + k R)} approaches: a positive wavenumber at a positive frequency.
    level = 20 * np.log10(abs(np.fft.fftshift(np.fft.fft2(values, size))) + 1e-12)
    omega = 2 * np.pi * np.fft.fftshift(np.fft.fftfreq(size[0], step_s))
    k = 2 * np.pi * np.fft.fftshift(np.fft.fftfreq(size[1], RANGES_M[1] - RANGES_M[0]))
    return level[omega >= 0], omega[omega >= 0], k


def draw_waves(power, elevation, seconds, out):
    file = out / "clutter_waves.png"
    script = [f'set terminal pngcairo size 1500,980 font "sans,13"; set output "{file}"', "set multiplot"]
    for values, top, palette, colour, bounds, label, unit, name in ((10 * np.log10(power), 1, VIRIDIS, "white", (-18, 10), "power over its mean", "dB", "power"), (elevation, 0.5, DIVERGING, "black", (-1.8, 1.8), "elevation", "m", "elevation")):
        level, omega, k = spectrum(power if name == "power" else elevation, seconds[1] - seconds[0])
        script += [f"set origin 0,{top - 0.5}; set size 0.64,0.5", palette, f"set title '{label}'; set cbrange [{bounds[0]}:{bounds[1]}]; set cblabel '{unit}'; set xlabel 'time (s)'; set ylabel 'range from the reference point (m)'; set xrange [0:60]; set yrange [-290:290]",
                   f"set arrow 1 from 4,270 to 54,{270 - 50 * PHASE_MPS:.1f} nohead front dt 2 lw 1.5 lc rgb '{colour}'",
                   "plot " + image(values.T, seconds, RANGES_M, out / f"clutter_{name}.bin"), "unset arrow 1",
                   f"set origin 0.64,{top - 0.5}; set size 0.36,0.5", VIRIDIS, f"set title 'spectrum of {name}'; set cbrange [-30:0]; set cblabel 'dB'; set xlabel 'wavenumber (rad/m), positive = approaching'; set ylabel 'frequency (rad/s)'; set xrange [-0.3:0.3]; set yrange [0:2.5]",
                   "plot " + image(level - level.max(), k, omega, out / f"clutter_{name}_spectrum.bin") + ", sqrt(9.81*abs(x)) with lines dt 2 lw 1.5 lc rgb 'white' notitle"]
    validation_plot.gnuplot(script, file)
    return file


def compare(out):
    """The section of the page, and its figures for validation.json."""
    references = measured()
    print("ten records of each of three seas ...", flush=True)
    high, high_lags, first = seeds_of(HIGH, out)
    low, low_lags, _ = seeds_of(LOW, out)
    independent, independent_lags, _ = seeds_of(INDEPENDENT, out)
    rows = [row(name, values, (high, independent, low)) for name, values in references.items()]
    print(html.unescape("\n".join(" | ".join(cells) for cells in rows)), flush=True)
    power, elevation, seconds = power_map(out)
    correlation = np.corrcoef(np.log(power).ravel(), elevation.ravel())[0, 1]
    print(f"log power and elevation, correlation {correlation:.2f}", flush=True)
    figure = validation_plot.figure([*cell_panels(first), lag_panel("correlation of power, high sea", high_lags, 0), lag_panel("the same, texture: independent", independent_lags, 0), lag_panel("correlation of power, low sea", low_lags, 1)],
                                    out / "clutter.png", "power, velocity and width over time; correlation of power, measured and simulated", (1400, 1400))
    section = f"""<section id="clutter"><h2>Sea clutter beside measurements</h2>
<p>{ABOUT}</p>
<p>{CHOSEN}</p>
{validation_page.table(["statistic", "high sea, measured", "simulated", "simulated, texture: independent", "low sea, measured", "simulated"], rows)}
<p><b>Limits.</b> {LIMITS}</p>
<p>{WAVES.format(correlation=f"The correlation of log power and elevation is {correlation:.2f}.")}</p>
<figure><img alt="power and elevation over range and time, and their spectra with the dispersion relation" src="{validation_page.picture(draw_waves(power, elevation, seconds, out))}"></figure>
<p>{CELL}</p>
<figure><img alt="Doppler spectrogram of a range cell" src="{validation_page.picture(spectrogram(first, out))}"></figure>
{figure}</section>"""
    for file in out.glob("clutter_*.bin"):
        file.unlink()
    simulated = {"high": (high, 0), "low": (low, 1), "high, texture: independent": (independent, 0)}
    figures = [{"sea": sea, "statistic": name, "measured": references[name][column], "simulated": float(values[name].mean()), "deviation": float(values[name].std())} for sea, (values, column) in simulated.items() for name in references]
    return section, figures
