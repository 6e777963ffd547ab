#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The formulas and statistics of the fleet in tools/validation. Argument: source folder."""
import math
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "tools/python"))
import validation_decoys as decoys
import validation_fleet as fleet


class ShipLevels(unittest.TestCase):
    def test_skolniks_formula_has_its_closed_form(self):
        self.assertAlmostEqual(fleet.dbsm(fleet.skolnik_m2(9400, 4)), 46.1, delta=0.05)  # 40,300 m^2, printed digits
        self.assertAlmostEqual(fleet.skolnik_m2(9400, 1), 52 * math.sqrt(9400))

    def test_statistic_is_the_mean_of_four_medians_without_broadside_and_ends(self):
        medians = {45: 1.0, 135: 10.0, 225: 100.0, 315: 1000.0}
        areas = {float(azimuth): [1e9] for azimuth in range(0, 360, 5)}
        for centre, median in medians.items():
            for azimuth in range(centre - 30, centre + 31, 5):
                areas[float(azimuth)] = [median / 100, median, median * 100]
        self.assertAlmostEqual(fleet.skolnik_statistic(areas), 1111 / 4)

    def test_sectors_have_the_bow_in_the_middle_of_the_first(self):
        medians = fleet.sector_medians({345.0: [2.0], 0.0: [1.0], 14.0: [3.0], 15.0: [7.0], 180.0: [5.0]})
        self.assertEqual(medians, {0: 2.0, 30: 7.0, 180: 5.0})

    def test_place_and_distance_are_those_against_a_range(self):
        self.assertEqual(fleet.place(1, 30, (20, 800)), "below to within")
        self.assertEqual(fleet.place(30, 300, (20, 800)), "within")
        self.assertAlmostEqual(fleet.outside_db(2, (20, 800)), -10)
        self.assertEqual(fleet.outside_db(200, (20, 800)), 0)

    def test_leaving_out_azimuths_does_not_change_levels_without_lobes(self):
        self.assertEqual(fleet.step_change_db({float(azimuth): [4.0] for azimuth in range(0, 360, 3)}), 0)

    def test_hydrostatics_are_the_printed_lines(self):
        text = "size  1\nafloat     1000 m^3 below z = 0 (1025 t of sea water)\n           KB 1 m\nscenario   targets"
        lines, displacement_kt = fleet.hydrostatics(text)
        self.assertEqual(lines, "1000 m^3 below z = 0 (1025 t of sea water)\nKB 1 m")
        self.assertAlmostEqual(displacement_kt, 1.025)


class DecoyLevels(unittest.TestCase):
    def test_factors_of_trihedra_are_those_of_their_apertures_on_the_axis(self):
        third = 1 / math.sqrt(3)
        self.assertAlmostEqual(4 * math.pi * decoys.triangular_aperture([third] * 3) ** 2, decoys.TRIANGULAR)
        # Projected along the axis, a quadrant reaches sqrt((2 - sin 2t) / 3) at the angle t from a leg; the aperture is what it shares with its reflection in the apex. Midpoints, 1e-4; printed digits of 15.6, 0.05.
        count, area = 20000, 0.0

        def reach(angle):
            angle %= 2 * math.pi / 3  # from a leg to the next one
            t = math.atan2(math.sin(angle), math.sin(2 * math.pi / 3 - angle))  # cos t, sin t: components along both legs
            return math.sqrt((2 - math.sin(2 * t)) / 3)
        for i in range(count):
            angle = 2 * math.pi * (i + 0.5) / count
            area += min(reach(angle), reach(angle + math.pi)) ** 2 / 2 * 2 * math.pi / count
        self.assertAlmostEqual(4 * math.pi * area**2, decoys.CIRCULAR, delta=0.06)

    def test_rain_catcher_has_six_lobes_of_half_the_power_on_the_horizon(self):
        for azimuth in range(0, 360, 60):
            # (3 cos e - 2 / cos e)^2 at the elevation e of the cells, cos^2 e = 8/9: half
            self.assertAlmostEqual(decoys.octahedral_db(azimuth, 0), 10 * math.log10(0.5), places=9)
            self.assertAlmostEqual(decoys.octahedral_db(azimuth, decoys.CELL_ELEVATION_DEG * (1 if azimuth % 120 == 0 else -1)), 0, places=9)
            self.assertLess(decoys.octahedral_db(azimuth + 30, 0), -60)

    def test_coverage_counts_degrees_and_the_widest_gap_over_the_ends_of_the_cut(self):
        cut = [-10.0] * 10 + [0.0] * 300 + [-10.0] * 5 + [0.0] * 25 + [-10.0] * 20
        self.assertEqual(decoys.coverage(cut, -6), (325, 30))
        self.assertEqual(decoys.coverage([-10.0] * 360, -6), (0, 360))

    def test_median_weighs_directions(self):
        self.assertEqual(decoys.weighted_median([3.0, 1.0, 2.0], [5.0, 1.0, 1.0]), 3.0)


if __name__ == "__main__":
    unittest.main()
