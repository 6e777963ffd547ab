#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the exports in this folder: one point scatterer as CST, FEKO, HFSS and PyAEDT would write it (no file of
theirs). The last needs python3-pandas and python3-tables.

    tests/cases/exports/write_exports.py
"""
import cmath
import json
import math
import pathlib

FOLDER = pathlib.Path(__file__).resolve().parent
C = 299792458.0
X0 = (0.31, -0.2, 0.05)
S = {"hh": 1 + 0j, "hv": 0.2j, "vh": 0.2j, "vv": -0.5 + 0.3j}  # m, received and transmitted


def unit(theta, phi):
    t, p = math.radians(theta), math.radians(phi)
    return (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t))


def amplitude(element, f, theta, phi, incident=None):
    """S in m for a receiver at theta, phi and a transmitter there or at `incident`."""
    k = 2 * math.pi * f / C
    receiver, transmitter = unit(theta, phi), unit(*(incident or (theta, phi)))
    return S[element] * cmath.exp(1j * k * sum((r + t) * x for r, t, x in zip(receiver, transmitter, X0)))


def spherical(f, theta, phi, transmitted, incident=None):
    """E_theta, E_phi at 1 m of a wave of 1 V/m along theta^ or phi^; theta^ = -v, phi^ = h."""
    s = {p: amplitude(p + transmitted, f, theta, phi, incident) for p in "hv"}
    return (s["v"], -s["h"]) if transmitted == "v" else (-s["v"], s["h"])


def phase(z):
    return math.degrees(cmath.phase(z)) % 360


def write(name, lines, end="\n"):
    (FOLDER / name).write_bytes((end.join(lines) + end).encode())


def cst_rcs():
    lines = ["Theta [deg.]  Phi   [deg.]  Abs(RCS )[dB(m^2)]   Abs(Theta)[dB(m^2)]  Phase(Theta)[deg.]  "
             "Abs(Phi  )[dB(m^2)]  Phase(Phi  )[deg.]  Ax.Ratio[dB    ]    ", "-" * 150]
    for phi in range(0, 40, 10):
        t, p = spherical(9.5e9, 85, phi, "v")
        area = [4 * math.pi * abs(x) ** 2 for x in (t, p)]
        lines.append(f"{85:8.3f}{phi:17.3f}{10 * math.log10(sum(area)):21.3e}{10 * math.log10(area[0]):20.3e}"
                     f"{phase(t):20.3f}{10 * math.log10(area[1]):20.3e}{phase(p):20.3f}{2.684e1:20.3e}     ")
    write("rcs (f = 9.5), theta = (85,85,1), phi = (0,30,10), VP (1) [pw].txt", lines, "\r\n")


def cst_field():
    """E-field mode, theta through 0, decimal commas, a byte order mark; one incident wave."""
    lines = ["\ufeffTheta [deg.]  Phi   [deg.]  Abs(E   )[V/m   ]   Abs(Theta)[V/m   ]  Phase(Theta)[deg.]  "
             "Abs(Phi  )[V/m   ]  Phase(Phi  )[deg.]  Ax.Ratio[dB    ]    ", "-" * 150]
    for theta in range(-90, 100, 30):
        # At theta below 0 the direction is |theta|, phi + 180, and the file's unit vectors are the opposite ones there.
        sign, direction = (-1, (-theta, 200)) if theta < 0 else (1, (theta, 20))
        t, p = (sign * x for x in spherical(10e9, *direction, "h", (90, 0)))
        cells = (f"{theta:8.3f}{20:17.3f}{math.hypot(abs(t), abs(p)):21.3e}{abs(t):20.4e}{phase(t):20.3f}{abs(p):20.4e}"
                 f"{phase(p):20.3f}{2.684e1:20.3e}     ")
        lines.append(cells.replace(".", ","))
    write("farfield (f=10) theta=90 phi=0 HP [pw].txt", lines, "\r\n")


def cst_ludwig():
    lines = ["Theta [deg.]  Phi   [deg.]  Abs(E   )[V/m   ]   Horiz(Abs)[V/m   ]  Horiz(Phase)[deg.]  "
             "Vert(Abs)[V/m   ]  Vert(Phase)[deg.]  Ax.Ratio[dB    ]    ", "-" * 150]
    for phi in range(0, 360, 60):
        t, p = spherical(10e9, 80, phi, "v")
        c, s = math.cos(math.radians(phi)), math.sin(math.radians(phi))
        h, v = c * t - s * p, s * t + c * p
        lines.append(f"{80:8.3f}{phi:17.3f}{math.hypot(abs(t), abs(p)):21.3e}{abs(h):20.6e}{phase(h):20.4f}{abs(v):20.6e}"
                     f"{phase(v):20.4f}{2.684e1:20.3e}     ")
    write("ludwig3.txt", lines)


def cst_curves():
    lines = []
    for theta in (80, 90):
        lines += ["#Parameters = {theta=%d; phi=30; sw=55}" % theta,
                  '#"Frequency / GHz"\t"E-field VV (%d) [Real Part] [V/m]"\t"E-field VV (%d) [Imaginary Part] [V/m]"' % (
                      theta, theta), "#" + "-" * 60]
        for n in range(3):
            s = amplitude("vv", 9e9 + 0.5e9 * n, theta, 30)
            lines.append(f"{9 + 0.5 * n:.14f}\t{s.real:.14f}\t{s.imag:.14f}")
    write("curves of two runs.txt", lines)
    lines = ["            Phi / deg.                RCS/abs,dBsm", "-" * 70]
    lines += [f"{phi:24}{10 * math.log10(4 * math.pi * abs(S['hh']) ** 2):32.8f}" for phi in range(0, 50, 10)]
    write("curve f=9.5 theta=90 HH.txt", lines + [""])


def cst_source():
    lines = ["// CST Farfield Source File", " ", "// Version:", "3.0 ", "", "// Data Type", "Farfield ", "",
             "// #Frequencies", "2 ", "", "// Position", "1.000000e-01 0.000000e+00 2.000000e-02 ", "", "// zAxis",
             "0.000000e+00 0.000000e+00 1.000000e+00 ", "", "// xAxis", "1.000000e+00 0.000000e+00 0.000000e+00 ", "",
             "// Radiated/Accepted/Stimulated Power , Frequency "]
    for f in (9e9, 10e9):
        lines += ["4.954413e-01 ", "4.977762e-01 ", "5.000000e-01 ", f"{f:e} ", ""]
    for f in (9e9, 10e9):
        lines += ["", "// >> Total #phi samples, total #theta samples", "3 2",
                  "// >> Phi, Theta, Re(E_Theta), Im(E_Theta), Re(E_Phi), Im(E_Phi): "]
        for phi in (0, 15, 30):
            for theta in (85, 90):
                k = 2 * math.pi * f / C
                # About the position (0.1, 0, 0.02) m instead of the origin.
                path = sum((r + t) * x for r, t, x in zip(unit(theta, phi), unit(90, 0), (0.1, 0, 0.02)))
                t, p = (x * cmath.exp(-1j * k * path) for x in spherical(f, theta, phi, "v", (90, 0)))
                lines.append(f"{phi:8.3f}{theta:10.3f}{t.real:17.8e}{t.imag:17.8e}{p.real:17.8e}{p.imag:17.8e}")
    write("source.ffs", lines)


def feko(name, directions):
    """directions: (incident wave, receivers) per block; E of a wave along -theta^ = v."""
    lines = ["##File Type: Far field", "##File Format: 4", "##Source: point", "##Date: 2024-01-01 00:00:00",
             "** File exported by FEKO kernel version 2017.1-403", ""]
    for f in (9.3e9, 9.4e9):
        for incident, receivers in directions:
            lines += ["", "#Configuration Name: StandardConfiguration1", "#Request Name: FarField1",
                      f"#Frequency:   {f:.8E}", "#Coordinate System: Spherical", "#No. of Theta Samples: 1",
                      f"#No. of Phi Samples: {len(receivers)}", "#Result Type: RCS",
                      f"#Incident Wave Direction: (  {incident[0]:.8E},  {incident[1]:.8E})", "#No. of Header Lines: 1",
                      '#       "Theta"             "Phi"           "Re(Etheta)"       "Im(Etheta)"        "Re(Ephi)"      '
                      '   "Im(Ephi)"        "RCS(Theta)"        "RCS(Phi)"        "RCS(Total)"  ']
            for theta, phi in receivers:
                t, p = (-x for x in spherical(f, theta, phi, "v", incident))
                area = [4 * math.pi * abs(x) ** 2 for x in (t, p)]
                lines.append("".join(f"{x:19.8E}" for x in (theta, phi, t.real, t.imag, p.real, p.imag, *area, sum(area))))
    write(name, lines)


def hfss():
    lines = ['"IWavePhi [deg]","IWaveTheta [deg]","Freq [GHz]","re(ComplexMonostaticRCSTheta) [meter]",'
             '"im(ComplexMonostaticRCSTheta) [meter]","dB(MonostaticRCSPhi) []"']
    for f in (9.5e9, 10e9):
        for phi in (0, 5, 10):
            t, p = (x * math.sqrt(4 * math.pi) for x in spherical(f, 85, phi, "v"))
            lines.append(f"{phi},85,{f / 1e9},{t.real:.15g},{t.imag:.15g},{20 * math.log10(abs(p)):.15g}")
    write("hfss VP.csv", lines)
    places = [(9.5e9, 85), (9.5e9, 90)]
    lines = ['"IWavePhi [deg]"' + "".join(f",\"dB(MonostaticRCSPhi) [] - Freq='{f / 1e9}GHz' IWaveTheta='{theta}deg'\""
                                          for f, theta in places)]
    for phi in (0, 5, 10):
        cells = [20 * math.log10(math.sqrt(4 * math.pi) * abs(spherical(f, theta, phi, "h")[1])) for f, theta in places]
        lines.append(",".join([str(phi)] + [f"{x:.15g}" for x in cells]))
    write("hfss families HP.csv", lines)


def pyaedt(element, unit, hz):
    """DataFrame.to_hdf() as PyAEDT calls it, in chunks of 16 rows instead of 1365 and without an index of its
    columns: both make the file small."""
    import pandas
    import tables

    tables.leaf.Leaf._calc_chunkshape = lambda self, *rest: (16,)
    places = [(f, phi, theta) for f in (9.5e9, 10e9) for phi in (0.0, 5.0, 200.0) for theta in (85.0, 90.0)]
    values = [math.sqrt(4 * math.pi) * spherical(f, theta, phi, element[1])["vh".index(element[0])]
              for f, phi, theta in places]
    index = pandas.MultiIndex.from_tuples([(f / hz, phi, theta) for f, phi, theta in places],
                                          names=["Freq", "IWavePhi", "IWaveTheta"])
    name = f"pyaedt_{element.upper()}"
    pandas.DataFrame({"data": values}, index=index).to_hdf(FOLDER / f"{name}.h5", key="df", mode="w", format="table",
                                                           index=False)
    write(f"{name}.json", [json.dumps({"solution": "Point", "monostatic_file": f"{name}.h5", "model_units": "mm",
                                       "frequency_units": unit, "model_info": {}}, indent=2)])


if __name__ == "__main__":
    cst_rcs()
    cst_field()
    cst_ludwig()
    cst_curves()
    cst_source()
    feko("monostatic.ffe", [((85, phi), [(85, phi)]) for phi in (0, 45, 90)])
    feko("bistatic.ffe", [((90, phi), [(90, p) for p in (0, 30, 60)]) for phi in (0, 40)])
    hfss()
    pyaedt("vv", "GHz", 1e9)
    pyaedt("vh", "MHz", 1e6)
