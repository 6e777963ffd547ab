#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Spectra of wave slope and tilt of the two lidar buoys from their motion sensors (SOURCE.md).

    spectra.py FOLDER      reads FOLDER/buoy_z05_imu.csv.gz and buoy_z06_imu.csv.gz, writes spectra.csv and bands.csv here

The wave slope is that of linear waves on deep water with the vertical acceleration of the buoy: their spectra differ by
g^2. The tilt is that of the integrals of the gyroscopes' rates; the sensor's own roll and pitch are too small in swell.
Both are spectra of Welch's method with Hann windows of 204.8 s, half overlapping.
"""
import gzip
import pathlib
import sys

import numpy as np

G = 9.80665
RATE_HZ = 10.0
WINDOW = 2048
LOWEST_HZ, HIGHEST_HZ = 0.045, 0.55
BANDS_HZ = ((0.045, 0.07), (0.07, 0.10), (0.10, 0.13), (0.13, 0.17), (0.17, 0.22), (0.22, 0.27), (0.27, 0.32), (0.32, 0.38), (0.38, 0.45), (0.45, 0.55))
FREQUENCY = np.fft.rfftfreq(WINDOW, 1 / RATE_HZ)


def segments(x):
    """Power densities of the windows, per Hz, one row each."""
    taper = np.hanning(WINDOW)
    x = x - x.mean()
    starts = range(0, len(x) - WINDOW, WINDOW // 2)
    return np.array([np.abs(np.fft.rfft(x[i:i + WINDOW] * taper)) ** 2 for i in starts]) * 2 / (RATE_HZ * (taper**2).sum())


def integral(rate):
    """Integral of a rate without what is slower than 0.03 Hz."""
    f = np.fft.rfftfreq(len(rate), 1 / RATE_HZ)
    spectrum = np.fft.rfft(rate - rate.mean())
    spectrum[f < 0.03] = 0
    spectrum[f >= 0.03] /= 2j * np.pi * f[f >= 0.03]
    return np.fft.irfft(spectrum, len(rate))


def attitude(mean_roll, mean_pitch, gx, gy, gz):
    """Roll and pitch of R = Rz(yaw) Ry(pitch) Rx(roll) about their means from body rates, by iteration from small angles."""
    roll, pitch = mean_roll, mean_pitch
    for _ in range(4):
        about_z = gy * np.sin(roll) + gz * np.cos(roll)
        roll, pitch = mean_roll + integral(gx + np.tan(pitch) * about_z), mean_pitch + integral(gy * np.cos(roll) - gz * np.sin(roll))
    return roll, pitch


def accelerations(roll, pitch, ax, ay, az):
    """Of the buoy in g along its heading, across it and down; the sensor gives the acceleration less gravity."""
    forward = np.cos(pitch) * ax + np.sin(roll) * np.sin(pitch) * ay + np.cos(roll) * np.sin(pitch) * az
    across = np.cos(roll) * ay - np.sin(roll) * az
    down = -np.sin(pitch) * ax + np.sin(roll) * np.cos(pitch) * ay + np.cos(roll) * np.cos(pitch) * az
    return forward, across, down


def ratio(a, b):
    return np.sqrt(a.sum() / b.sum())


def jackknife_error(a, b):
    """Standard error of ratio(a, b), one value per window in both."""
    left_out = np.array([np.sqrt((a.sum() - a[i]) / (b.sum() - b[i])) for i in range(len(a))])
    return np.sqrt((len(a) - 1) / len(a) * ((left_out - left_out.mean()) ** 2).sum())


def main():
    here = pathlib.Path(__file__).resolve().parent
    spectra = ["# Wave slope and tilt of two buoys (SOURCE.md), power densities", "buoy,part,frequency_hz,slope_rad2_per_hz,tilt_rad2_per_hz"]
    bands = ["# Bands of the spectra (SOURCE.md): RMS, ratio and its standard error; horizontal over vertical acceleration; roll and pitch over the acceleration across and along in g",
             "buoy,part,low_hz,high_hz,slope_deg,tilt_deg,tilt_per_slope,standard_error,orbit,roll_per_orbit,pitch_per_orbit"]
    for buoy in ("z05", "z06"):
        with gzip.open(pathlib.Path(sys.argv[1]) / f"buoy_{buoy}_imu.csv.gz", "rt") as file:
            _, own_roll, own_pitch, _, gx, gy, gz, ax, ay, az = np.loadtxt(file, delimiter=",", skiprows=1).T
        roll, pitch = attitude(own_roll.mean(), own_pitch.mean(), gx, gy, gz)
        forward, across, down = accelerations(roll, pitch, ax, ay, az)
        half = len(down) // 2
        for part, rows in (("first", slice(0, half)), ("second", slice(half, None)), ("whole", slice(0, None))):
            slope, along, side = segments(down[rows]), segments(forward[rows]), segments(across[rows])
            rolled, pitched = segments(roll[rows]), segments(pitch[rows])
            tilt = rolled + pitched
            for i in np.flatnonzero((FREQUENCY >= LOWEST_HZ) & (FREQUENCY < HIGHEST_HZ)):
                spectra.append(f"{buoy},{part},{FREQUENCY[i]:.6f},{slope[:, i].mean():.4g},{tilt[:, i].mean():.4g}")
            for low, high in BANDS_HZ:
                s, t, a, c, r, p = (x[:, (FREQUENCY >= low) & (FREQUENCY < high)].sum(1) for x in (slope, tilt, along, side, rolled, pitched))
                degrees = [np.degrees(np.sqrt(x.mean() * FREQUENCY[1])) for x in (s, t)]
                bands.append(f"{buoy},{part},{low},{high},{degrees[0]:.3f},{degrees[1]:.3f},{ratio(t, s):.3f},{jackknife_error(t, s):.3f},{ratio(a + c, s):.2f},{ratio(r, c):.2f},{ratio(p, a):.2f}")
    (here / "spectra.csv").write_text("\n".join(spectra) + "\n", encoding="utf-8")
    (here / "bands.csv").write_text("\n".join(bands) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
