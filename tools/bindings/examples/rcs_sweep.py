#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Radar cross section and range profiles of a mesh over azimuth, as a picture and as arrays.

    python3 rcs_sweep.py ship.stl --unit mm --centre-ghz 9.4 --bandwidth-ghz 0.6 --azimuth-deg 0 90 0.25 -o ship

writes ship.png and ship.npz (S [frequency, elevation, azimuth, received, transmitted] in metres, with its axes). Needs
python3-matplotlib.
"""
import argparse

import matplotlib
import numpy as np

import seaglint

matplotlib.use("Agg")  # a picture in a file, no window
import matplotlib.pyplot as plt  # noqa: E402

C = 299792458.0  # m/s
POLARISATIONS = {"hh": (0, 0), "vv": (1, 1), "hv": (0, 1)}  # received, transmitted: the last two indices of S


def frequencies(centre_hz, bandwidth_hz, reach_m):
    """Equally spaced frequencies (Hz), the middle one the centre, close enough for range profiles without ambiguity.

    A step df repeats the profile every c/(2 df). Paths of several bounces are longer than the body: three times its
    diameter, which is at most 2 reach_m, leaves room for them.
    """
    step_hz = C / (2 * 3 * 2 * reach_m)
    count = 2 * max(1, int(np.ceil(bandwidth_hz / step_hz / 2))) + 1
    return centre_hz + np.linspace(-bandwidth_hz / 2, bandwidth_hz / 2, count)


def range_profiles(S, frequency_hz, padding=4):
    """(range_m, profiles) of S [frequency, ...]; a point of amplitude a (m) has a peak of a at its range.

    With e^{+jwt} a point at range R (positive = farther than the mesh's origin) has S ~ e^{-j 4 pi f R / c}; the
    inverse FFT therefore puts it at +R. The Hann window lowers sidelobes to -31 dB; its first null is at 2 c/(2 B).
    """
    count, step_hz = len(frequency_hz), frequency_hz[1] - frequency_hz[0]
    window = np.hanning(count + 2)[1:-1]
    weighted = S * (window / window.sum()).reshape(-1, *[1] * (S.ndim - 1))
    bins = padding * count
    profiles = np.fft.fftshift(np.fft.ifft(weighted, bins, axis=0), axes=0) * bins
    return np.fft.fftshift(np.fft.fftfreq(bins, step_hz)) * C / 2, profiles


def draw(S, frequency_hz, azimuth_deg, reach_m, title, file):
    centre = len(frequency_hz) // 2
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(9, 9), sharex=True, layout="constrained")
    for name, (received, transmitted) in POLARISATIONS.items():
        sigma = 4 * np.pi * np.abs(S[centre, 0, :, received, transmitted]) ** 2  # m^2
        upper.plot(azimuth_deg, 10 * np.log10(np.maximum(sigma, 1e-12)), label=name.upper(), linewidth=0.8)
    upper.set_ylim(upper.get_ylim()[1] - 60, upper.get_ylim()[1])
    upper.set_ylabel(f"RCS at {frequency_hz[centre] / 1e9:.4g} GHz (dBsm)")
    upper.legend()
    upper.grid(alpha=0.3)
    upper.set_title(title)

    range_m, profiles = range_profiles(S[:, 0, :, 1, 1], frequency_hz)
    level = 20 * np.log10(np.maximum(np.abs(profiles), 1e-12))
    shown = lower.pcolormesh(azimuth_deg, range_m, level, vmin=level.max() - 50, vmax=level.max(), shading="nearest", rasterized=True)
    lower.set_ylim(1.5 * reach_m, -1.5 * reach_m)  # the radar is above the picture
    lower.set_ylabel("range from the mesh's origin (m)")
    lower.set_xlabel("azimuth (deg), 0 = radar ahead of the bow")
    figure.colorbar(shown, ax=lower, label="VV range profile (dB re 1 m)")
    figure.savefig(file, dpi=120)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("mesh")
    options.add_argument("--unit", default="m", help="of the mesh: m, cm, mm, km, in, ft")
    options.add_argument("--material", help="of the whole mesh, a name in assets/materials or a file; default: perfect conductor")
    options.add_argument("--centre-ghz", type=float, default=10.0)
    options.add_argument("--bandwidth-ghz", type=float, default=2.0)
    options.add_argument("--azimuth-deg", type=float, nargs=3, default=(0, 360, 0.5), metavar=("FROM", "TO", "STEP"))
    options.add_argument("--elevation-deg", type=float, default=0.0)
    options.add_argument("-o", "--output", default="sweep", help="name of the .png and .npz")
    given = options.parse_args()

    first, last, step = given.azimuth_deg
    azimuth_deg = np.arange(first, last + step / 2, step)
    try:
        mesh = seaglint.Mesh(given.mesh, given.unit)
        reach_m = np.linalg.norm(mesh.vertices, axis=1).max()  # of the farthest vertex from the origin
        frequency_hz = frequencies(given.centre_ghz * 1e9, given.bandwidth_ghz * 1e9, reach_m)
        # Lobes of a body 2 reach_m wide are lambda / (4 reach_m) rad wide; two samples in each show them all.
        lobe_deg = np.degrees(C / frequency_hz[-1] / (4 * reach_m))
        if step > lobe_deg / 2:
            print(f"note: a step of {step:g} deg misses lobes, which are {lobe_deg:.2g} deg wide")
        S = seaglint.rcs(mesh, frequency_hz, azimuth_deg, given.elevation_deg, materials=given.material)
    except seaglint.InputError as error:  # a file, a unit, a material, a bound
        raise SystemExit(f"rcs_sweep: {error}") from None

    np.savez(f"{given.output}.npz", S=S, frequency_hz=frequency_hz, azimuth_deg=azimuth_deg, elevation_deg=given.elevation_deg)
    draw(S, frequency_hz, azimuth_deg, reach_m, f"{given.mesh}, elevation {given.elevation_deg:g} deg", f"{given.output}.png")
    print(f"{given.output}.png, {given.output}.npz: {S.shape[0]} frequencies x {S.shape[2]} azimuths")


if __name__ == "__main__":
    main()
