// SPDX-License-Identifier: BSD-3-Clause
// Coated, dielectric and absorbing plates of the Austin RCS benchmark suite, with and without the diffraction of their
// edges.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>

#include "sim/geometry/files/mesh_io.h"
#include "sim/geometry/placement/target_mesh.h"
#include "sim/scenario/material_file.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

const std::string kAustin = SEAGLINT_SOURCE_DIR "/tests/reference/rcs/austin/";

MaterialSpec material(const std::string& name) { return read_material(kAustin + name + ".yaml"); }

Scatterer sheet_of(const std::string& name) {
  TriangleMesh mesh = make_plate(10.5 * 0.0254, 6 * 0.0254);
  const auto materials = assign_materials(mesh, material(name), {});
  return Scatterer(mesh, materials);
}

Scatterer coated_plate() {
  TriangleMesh mesh = read_mesh(kAustin + "coated_plate.obj", "m");
  const std::vector<PartMaterial> parts{{"front", material("magram_coating")}};
  const auto materials = assign_materials(mesh, MaterialSpec{}, parts);
  return Scatterer(mesh, materials);
}

// Mean difference from the file's cut within 60 deg of the normal, dB, both sides clipped at 80 dB below its maximum.
double mean_difference(const Scatterer& target, const std::string& file, bool edges) {
  std::ifstream in(kAustin + file);
  EXPECT_TRUE(in) << file;
  std::map<double, double> cut;
  double hz = 0, largest = -1e9;
  for (double theta, phi, value; in >> hz >> theta >> phi >> value;) {
    if (phi <= 60) cut[phi] = value;
    largest = std::max(largest, value);
  }
  const double frequency = file.find(".f10.") != std::string::npos ? 5.12e9 : 10.24e9;
  const int channel = file.find(".H.") != std::string::npos ? kHhChannel : kVvChannel;
  double sum = 0;
  for (const auto& [phi, level] : cut) {
    const auto s = echo(target, radar_basis(direction(phi, 0)), wavenumber(frequency), 0, 8, edges);
    sum += std::abs(std::max(dbsm(s[channel]), largest - 80) - std::max(level, largest - 80));
  }
  return sum / static_cast<double>(cut.size());
}

struct Cut {
  const char* file;
  double bound;  // dB
};

void expect_better_with_edges(const Scatterer& target, std::initializer_list<Cut> cuts) {
  for (const Cut& cut : cuts) {
    const double with = mean_difference(target, cut.file, true), without = mean_difference(target, cut.file, false);
    EXPECT_LT(with, cut.bound) << cut.file;
    EXPECT_LT(with, without) << cut.file;
  }
}

// Against moments, to which an exact two-dimensional solution comes within 0.3 dB. What remains: the square end of the
// sheet, 0.03 and 0.05 wavelengths thick, and multiple diffraction.
TEST(MaterialPlates, OfADielectricMatchTheMethodOfMoments) {
  expect_better_with_edges(sheet_of("dielectric_sheet"), {{"ref_rcs.II.C.sx1.f10.H.txt", 0.8},
                                                          {"ref_rcs.II.C.sx1.f10.V.txt", 0.5},
                                                          {"ref_rcs.II.C.sx1.f11.H.txt", 1},
                                                          {"ref_rcs.II.C.sx1.f11.V.txt", 2}});
}

TEST(MaterialPlates, OfAnAbsorberMatchTheMethodOfMoments) {
  expect_better_with_edges(sheet_of("magram_sheet"),
                           {{"ref_rcs.II.D.sx1.f11.H.txt", 1.4}, {"ref_rcs.II.D.sx1.f11.V.txt", 1.4}});
}

// Measured only. The plate is 3.1 mm thick with its coating, 0.05 and 0.11 wavelengths; a half-plane is not: an exact
// two-dimensional solution of the section differs from the measurement by 0.4 to 1.7 dB, of the half-plane's by 1.1 to
// 2.4 dB.
TEST(MaterialPlates, WithACoatingMatchTheMeasurement) {
  expect_better_with_edges(coated_plate(), {{"meas.m1_rcs.II.E.sx1.f10.H.txt", 2.5},
                                            {"meas.m1_rcs.II.E.sx1.f10.V.txt", 2},
                                            {"meas.m1_rcs.II.E.sx1.f11.H.txt", 2.5},
                                            {"meas.m1_rcs.II.E.sx1.f11.V.txt", 2}});
}

TEST(MaterialPlates, ScatterNothingAsASheetOfVacuum) {
  MaterialSpec vacuum;
  vacuum.kind = SurfaceKind::kLayers;
  vacuum.backing = Backing::kAir;
  vacuum.layers.resize(1);
  TriangleMesh mesh = make_plate(0.3, 0.2);
  const auto materials = assign_materials(mesh, vacuum, {});
  const Scatterer target(mesh, materials);
  for (const double azimuth : {0.0, 20.0, 65.0, 110.0})
    EXPECT_LT(largest(echo(target, radar_basis(direction(azimuth, 12)), wavenumber(10e9), 0, 8, true)), 1e-7);
}

TEST(MaterialPlates, AreReciprocalAndTheSameFromBehind) {
  const Scatterer target = sheet_of("magram_sheet");
  for (const double azimuth : {17.0, 52.0}) {
    const auto front = echo(target, radar_basis(direction(azimuth, 23)), wavenumber(7e9), 0, 8, true);
    EXPECT_LT(std::abs(front[kHvChannel] - front[kVhChannel]), 1e-9);
    const auto behind = echo(target, radar_basis(direction(180 - azimuth, 23)), wavenumber(7e9), 0, 8, true);
    EXPECT_LT(std::abs(front[kHhChannel] - behind[kHhChannel]), 1e-7);
    EXPECT_LT(std::abs(front[kVvChannel] - behind[kVvChannel]), 1e-7);
  }
}

// A frequency within a sweep has the edges of that frequency.
TEST(MaterialPlates, HaveTheSameEchoAloneAndInASweep) {
  const Scatterer target = coated_plate();
  const BistaticGeometry pair = monostatic(radar_basis(direction(33, 5)));
  const std::array ks{wavenumber(5e9), wavenumber(7e9), wavenumber(10e9)};
  const TracingSettings settings{0, 8, true};
  const auto sweep = scattering_matrices(target, pair, ks, settings);
  for (std::size_t q = 0; q < ks.size(); ++q) {
    const auto alone = scattering_matrices(target, pair, std::array{ks[q]}, settings)[0];
    for (int i = 0; i < 4; ++i) EXPECT_LT(std::abs(sweep[q][i] - alone[i]), 1e-9);
  }
}

}  // namespace
}  // namespace seaglint
