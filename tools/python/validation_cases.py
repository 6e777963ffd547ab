# SPDX-License-Identifier: BSD-3-Clause
"""The bodies of tools/validation: mesh, sweep, reference, where they come from and what limits the agreement."""
import dataclasses
import pathlib

import validation_meshes as meshes

REFERENCE = pathlib.Path("tests/reference/rcs")
AUSTIN = REFERENCE / "austin"
SUITE = "Austin RCS Benchmark Suite, set {}: {}."
WAVELENGTH_1M = "0.299792458"  # GHz


@dataclasses.dataclass
class Case:
    """A sweep of `seaglint rcs` with its references. Files of `made` are written before it."""
    name: str
    about: str  # in the table
    title: str
    geometry: str
    source: str
    mesh: str
    sweep: list
    references: list  # (file, polarisation or "" where the file says it)
    goal: str = "-"
    note: str = ""
    against: str = "ref_,full_wave,mie,closed_form,moments"  # starts of the names of references that count as true
    floor_db: int = 80
    made: dict = dataclasses.field(default_factory=dict)  # name in the output folder -> function that gives the text
    make: list = None  # `seaglint mesh make ...` of the mesh
    view: tuple = (40, 20)  # azimuth and elevation of the picture, deg
    every: int = 1  # of the azimuths (or frequencies) in the solutions with other numerical parameters
    changes: dict = dataclasses.field(default_factory=dict)  # of numerical parameters, in place of CHANGES
    rays: bool = True  # solved by shooting and bouncing rays too; not with --cavity, which ends beams alone


def austin(*names):
    return [(str(AUSTIN / name), "") for name in names]


def suite(which, kinds, bands):
    """Measured and computed files of a problem set, the computed ones last."""
    return austin(*(f"{kind}.{which}.{band}.{pol}.txt" for kind in kinds for band in bands for pol in "HV"))


def plates():
    plate = ["mesh", "make", "plate", "--length-m", "0.2667", "--width-m", "0.1524"]
    both, bands = ("meas.m1_rcs", "ref_rcs"), ("f10", "f11")
    low, high = "5.12:10.24:5.12", "10.24"
    cut = ["--azimuth-deg", "0:60:0.5"]

    def case(name, about, title, geometry, which, truth, sweep, references, goal, mesh="plate.glb", **more):
        return Case(name, about, title, geometry, SUITE.format(which, truth), mesh, sweep + cut, references, goal,
                    make=plate if mesh == "plate.glb" else None, **more)

    two = "measured, and by an integral equation"
    return [
        case("plate", "plate 6 x 10.5 in, 64 mil thick, 0-60 deg", "Plate of 6 x 10.5 inch", "Conductor, 1.6256 mm thick, meshed as a sheet at its front. Azimuth 0 is its normal.", "IIB", two,
             ["--frequency-ghz", low, "--sheet-thickness-mm", "1.6256"], suite("II.B.sx1", both, bands), "below 1.5 mean, aim 0.5"),
        case("sheet", "the same as a sheet without thickness", "The plate without its thickness", "What the thickness, 0.03 and 0.06 wavelengths, changes.", "IIB", two,
             ["--frequency-ghz", low], suite("II.B.sx1", both, bands), "below 1.5 mean"),
        case("dielectric", "dielectric plate, 1.5 mm, 0-60 deg", "Dielectric plate of the same size", "1.5 mm of a dielectric.", "IIC", two,
             ["--material", str(AUSTIN / "dielectric_sheet.yaml"), "--frequency-ghz", low], suite("II.C.sx1", both, bands), "below 2.5 mean"),
        case("absorber", "absorber plate, 1.5 mm, 0-60 deg", "Absorber plate of the same size", "1.5 mm of a magnetic absorber.", "IID", two,
             ["--material", str(AUSTIN / "magram_sheet.yaml"), "--frequency-ghz", high], suite("II.D.sx1", both, bands[1:]), "below 2.5 mean"),
        case("coated", "coated plate against its measurement, 0-60 deg", "The plate with the absorber on its front", "1.5 mm of the absorber on a conductor.", "IIE", "measured only",
             ["--material", f"front={AUSTIN}/magram_coating.yaml", "--frequency-ghz", low], suite("II.E.sx1", both[:1], bands), "below 2 mean",
             mesh=str(AUSTIN / "coated_plate.obj"), against="meas"),
    ]


def boxes():
    both, bands = ("meas_rcs", "ref_rcs"), ("f10", "f11")
    sweep = ["--frequency-ghz", "5.12:10.24:5.12", "--azimuth-deg", "0:180:0.5", "--reference-phi=-1,180"]
    measured = "measured, and by an integral equation"
    duct = "Box of 0.4 m with an S-shaped duct whose open end faces azimuth 180 deg."
    return [
        Case("prism", "closed prism, 0-180 deg", "Closed prism", "The box below without its duct.", SUITE.format("IIIS-A", measured), str(AUSTIN / "closed_box.obj"), sweep,
             suite("IIIS.A.s1", both, bands), "below 0.8 mean", every=5, view=(150, 20)),
        Case("box", "duct box, 0-180 deg, 40 dB floor", "Box with an S-shaped duct", duct, SUITE.format("IIIS-B", measured), str(AUSTIN / "duct_box.glb"), sweep + ["--cavity", "duct"],
             suite("IIIS.B.s1", both, bands), "mean below 3 at 5.12, 2 at 10.24 GHz, aim 1",
             "The duct's echo from the currents on its walls. The measurement at 10.24 GHz was saturated around 90 deg.", floor_db=40, every=20, view=(150, 20), rays=False,
             changes={"patches": ["--frequency-ghz", "5.12", "--cavity-patches-per-wavelength", "8"], "bounces": None, "flat": ["--frequency-ghz", "5.12", "--crease-deg", "0"]}),
        Case("box_rays", "the same, the duct by 12 bounces of rays", "The same, the duct by rays", "Up to 12 bounces.", SUITE.format("IIIS-B", measured), str(AUSTIN / "duct_box.glb"),
             sweep + ["--max-bounces", "12"], suite("IIIS.B.s1", both, bands), "-", "A duct a few wavelengths wide has modes, not rays: more bounces do not help.", floor_db=40, every=20, view=(150, 20),
             changes={"bounces": ["--max-bounces", "24"]}),
    ]


def trihedra():
    cases = []
    for azimuth, title, about, place in ((0, "Triangular trihedron on its axis", "trihedral 4-5 wavelengths, axis", ""), (20, "The same, 20 deg off its axis", "trihedral 4-5 wavelengths, 20 deg off", " In azimuth.")):
        table = f"full_wave_az{azimuth}.csv"
        cases.append(Case(f"trihedral_az{azimuth}", about, title, "Legs of 4 wavelengths at the lowest frequency, 5 at the highest, over frequency." + place,
                          "Finite differences in time (openEMS), extrapolated from two meshes: about 0.3 dB and 10 deg.", "trihedral.glb",
                          ["--frequency-ghz", "0.299792458:0.3747405725:0.018737028625", "--azimuth-deg", str(45 + azimuth), "--elevation-deg", "35.264389682754654"],
                          [(table, "hh"), (table, "vv")], "0.35 rms over both cuts, correlation 0.98",
                          made={table: lambda a=azimuth: meshes.trihedral_table(REFERENCE / "trihedral_fdtd.csv", a)},
                          make=["mesh", "make", "trihedral", "--leg-m", "4"], view=(30, 25)))
    return cases


def spheres():
    radius = 0.047713451592369422  # c / (2 pi 1 GHz): ka is the frequency in GHz
    sweep = ["--edges", "off", "--frequency-ghz", "60:200:1", "--azimuth-deg", "23", "--elevation-deg", "11"]
    make = ["mesh", "make", "sphere", "--radius-m", f"{radius:.17g}", "--subdivisions"]
    mie = {"mie.csv": lambda: meshes.mie_table(REFERENCE / "mie_sphere_ka60_200.csv", radius)}
    return [
        Case("sphere", "sphere, ka 60-200", "Sphere", "20,480 facets with normals; ka is the frequency in GHz.", "Mie's series.", "sphere.glb", sweep, [("mie.csv", "vv")],
             "0.05 mean, 0.1 largest", made=mie, make=make + ["5"], every=10),
        Case("sphere_stl", "the same from STL, 1,280 facets", "The sphere from STL", "1,280 facets without normals.", "Mie's series.", "sphere.stl", sweep, [("mie.csv", "vv")],
             "0.05 mean, 0.1 largest", made=mie, make=make + ["3"], every=10),
        Case("sphere_bistatic", "sphere, ka 64, bistatic 0-120 deg", "Sphere, bistatic", "20,480 facets, the transmitter at azimuth 0.", SUITE.format("IA", "exact series"), "sphere_bistatic.glb",
             ["--edges", "off", "--frequency-ghz", "0.32", "--azimuth-deg", "0:120:0.5", "--transmit-azimuth-deg", "0"], austin("ref_rcs.I.A.s7.f6.H.txt", "ref_rcs.I.A.s7.f6.V.txt"),
             note="The field that creeps around the sphere is not modelled: the error grows beyond 90 deg.", make=["mesh", "make", "sphere", "--radius-m", "9.6", "--subdivisions", "5"], every=10),
        Case("almond", "almond of 6 to 9 wavelengths, 0-180 deg, 40 dB floor", "Almond", "9.936 inch, 15,168 triangles; azimuth 0 is the tip.", SUITE.format("IIIA", "measured, and by an integral equation"),
             "almond.obj", ["--frequency-ghz", "7:10.25:3.25", "--azimuth-deg", "0:180:0.5"], suite("III.A.s1", ("meas.m1_rcs", "ref_rcs"), ("fx3", "fx4")), floor_db=40, every=10,
             note="Within 2 dB where the flanks reflect, from 60 to 110 deg; beyond, travelling and creeping waves and the diffraction of the tip, none of them modelled, are the echo: 15 to 25 dB too low at the tip.",
             made={"almond.obj": meshes.almond}),
    ]


def groove_note(angle, elevation):
    if angle == 25:
        return "Beams become narrower than a wavelength after five reflections."
    return "No surface reflects back: the echo, 15 dB lower than at 5 deg, is that of edges and corners, 7 dB too low." if elevation == 30 else ""


def moments():
    """Bodies solved by the method of moments (tests/reference/rcs/block_ship.py, grooves.py)."""
    columns = [f"{pq}_{part}" for pq in ("hh", "hv", "vv") for part in ("re", "im")]

    def case(name, about, title, geometry, file, mesh, make, azimuths, elevation, note, **equal):
        table = f"moments_{name}.csv"
        rows = lambda: meshes.rows_of(REFERENCE / file, elevation_deg=elevation, **equal)
        return Case(name, about, title, geometry, f"Integral equations of the combined field, method of moments (<code>tests/reference/rcs/{file.replace('csv', 'py')}</code>): to about 1 to 3 %.", mesh,
                    ["--frequency-ghz", WAVELENGTH_1M, "--azimuth-deg", azimuths, "--elevation-deg", str(elevation)], [(table, pq) for pq in ("hh", "hv", "vv")],
                    made={mesh: make, table: lambda: meshes.table(rows(), columns, 299792458)}, note=note, floor_db=40)

    cases = [case(f"block_ship_{el}deg", f"block ship of 6 wavelengths, elevation {el} deg", f"Block ship, elevation {el} deg",
                  "Hull of 6 x 1.6 x 1.2 wavelengths with a house on its deck; azimuth 0 is the bow." if el == 2 else "The same.", "block_ship.csv", "block_ship.obj", meshes.block_ship, "0:90:2", el,
                  "Edges one wavelength apart: diffraction of third and higher order is not modelled.") for el in (2, 10, 25, 50)]
    for angle in (25, 80):
        for el in (5, 15, 30):
            cases.append(case(f"groove_{angle}_{el}deg", f"groove of {angle} deg, elevation {el} deg", f"Upright groove of {angle} deg, elevation {el} deg", "Two arms of 3 wavelengths, 3 high, open towards azimuth 0.", "grooves.csv",
                              f"groove_{angle}.obj", lambda a=angle: meshes.groove(a), "0:32:1" if angle == 25 else "0:60:2", el,
                              groove_note(angle, el), angle_deg=angle))
    return cases


def top_hats():
    cases = []
    for radius, name, text in ((0.5, "50cm", "0.5 m"), (1, "100cm", "1 m")):
        table = f"closed_form_{name}.csv"
        cases.append(Case(f"top_hat_{name}", "cylinder of 48 strips on a plate, radius 0.5 m" if radius < 1 else "the same, 1 m", f"Cylinder on a plate, radius {text}",
                          "48 strips, 0.4 m high, on two triangles; the echo of two bounces.", "Closed form 2 h sqrt(k R cos(el) / 4 pi) of a cylinder on a plane.", f"top_hat_{name}.obj",
                          ["--edges", "off", "--only", "bounces=2", "--frequency-ghz", "8", "--azimuth-deg", "0:90:3", "--elevation-deg", "40"], [(table, "hh"), (table, "vv")], "1 largest",
                          made={f"top_hat_{name}.obj": lambda r=radius: meshes.top_hat(r), table: lambda r=radius: meshes.top_hat_table(r)},
                          changes={"bounces": None}))
    return cases


def all_cases():
    return plates() + boxes() + trihedra() + spheres() + moments() + top_hats()
