// SPDX-License-Identifier: BSD-3-Clause
// Worth of the mechanisms of edge diffraction: the error against references, and the echo of ship and decoy, without
// each of them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "sim/geometry/files/mesh_io.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/reference_bodies.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// The scattering matrix in closed form, and its parts by mechanism, from one trace.
struct ByMechanism {
  std::array<Complex, 4> matrix{};
  std::array<std::array<Complex, 4>, kMechanisms> parts{};
};
ByMechanism parts_of(const Scatterer& target, const BistaticGeometry& geometry, double k,
                     const TracingSettings& settings) {
  const ViewResult all = points_of(target, geometry, k, 0, settings, 2);
  ByMechanism result{all.matrices[0], {}};
  for (const Point& point : all.points) {
    const Complex phase = std::polar(1.0, k * point.psi);
    for (std::size_t i = 0; i < 4; ++i)
      result.parts[static_cast<std::size_t>(point.source.mechanism)][i] += phase * point.matrix(0)[i];
  }
  return result;
}

// Echo of one polarisation at one aspect, in parts, and its reference value.
struct Sample {
  std::array<Complex, kMechanisms> parts{};
  Complex reference;
};

// Relative error in L2 without the mechanisms for which `omitted` is true.
double error_without(const std::vector<Sample>& samples, const std::function<bool(Mechanism)>& omitted) {
  double error = 0, power = 0;
  for (const Sample& sample : samples) {
    Complex sum = 0;
    for (std::size_t m = 0; m < kMechanisms; ++m) {
      if (!omitted(static_cast<Mechanism>(m))) sum += sample.parts[m];
    }
    error += std::norm(sum - sample.reference);
    power += std::norm(sample.reference);
  }
  return std::sqrt(error / power);
}

double error_without(const std::vector<Sample>& samples, Mechanism mechanism) {
  return error_without(samples, [&](Mechanism m) { return m == mechanism; });
}

double error_with_all(const std::vector<Sample>& samples) {
  return error_without(samples, [](Mechanism) { return false; });
}

// Backscatter of a prism per metre of its length, soft or hard, within `about_deg` of azimuth 0.
std::vector<Sample> prism_samples(const std::string& section, bool hard, double about_deg) {
  const double k = wavenumber(10.24e9), height = 2;
  const Scatterer one(prism(sections().at(section), height)), two(prism(sections().at(section), 2 * height));
  const Complex per_metre = (hard ? -1.0 : 1.0) * kPi / (height * Complex(0, 1));
  const auto channel = static_cast<std::size_t>(hard ? kHhChannel : kVvChannel);
  std::vector<Sample> samples;
  for (const auto& row : read_csv("sections.csv")) {
    const double transmit = std::stod(row[0]), receive = std::stod(row[1]);
    if (row[6] != section || transmit != receive || std::abs(std::remainder(receive, 360)) > about_deg) continue;
    const BistaticGeometry geometry = monostatic(radar_basis(direction(receive, 0)));
    const ByMechanism with_two = parts_of(two, geometry, k, {7e-5, 8, true}),
                      with_one = parts_of(one, geometry, k, {7e-5, 8, true});
    Sample& sample = samples.emplace_back();
    for (std::size_t m = 0; m < kMechanisms; ++m)
      sample.parts[m] = per_metre * (with_two.parts[m][channel] - with_one.parts[m][channel]);
    sample.reference = {std::stod(row[hard ? 4 : 2]), std::stod(row[hard ? 5 : 3])};
  }
  return samples;
}

std::vector<Sample> block_ship_samples(double elevation_deg, Channel channel) {
  const Scatterer ship(block_ship());
  const std::size_t column = channel == kHhChannel ? 2 : 6;
  std::vector<Sample> samples;
  for (const auto& row : read_csv("block_ship.csv")) {
    if (std::stod(row[1]) != elevation_deg) continue;
    const RadarBasis radar = radar_basis(direction(std::stod(row[0]), elevation_deg));
    const ByMechanism echo = parts_of(ship, monostatic(radar), 2 * kPi, {7e-5, 8, true});
    Sample& sample = samples.emplace_back();
    for (std::size_t m = 0; m < kMechanisms; ++m) sample.parts[m] = echo.parts[m][channel];
    sample.reference = {std::stod(row[column]), std::stod(row[column + 1])};
  }
  return samples;
}

// hh and vv of a target at 16 GHz, elevation 2 deg; the reference is the sum of all parts. It is the scattering matrix
// but for double knife edges, which enter by their end points where the matrix has the integral along the interval.
std::vector<Sample> target_samples(const std::string& mesh, int aspects) {
  const Scatterer target(read_mesh(SEAGLINT_SOURCE_DIR "/assets/" + mesh));
  std::vector<Sample> samples;
  double difference = 0, power = 0;
  for (int i = 0; i < aspects; ++i) {
    const RadarBasis radar = radar_basis(direction(3.7 + 360.0 * i / aspects, 2));
    const ByMechanism echo = parts_of(target, monostatic(radar), wavenumber(16e9), {0, kDefaultBounces, true});
    for (const Channel channel : {kHhChannel, kVvChannel}) {
      Sample& sample = samples.emplace_back();
      for (std::size_t m = 0; m < kMechanisms; ++m) {
        sample.parts[m] = echo.parts[m][channel];
        sample.reference += echo.parts[m][channel];
      }
      difference += std::norm(sample.reference - echo.matrix[channel]);
      power += std::norm(echo.matrix[channel]);
    }
  }
  EXPECT_LT(std::sqrt(difference / power), 2e-3) << mesh;  // 1.2e-3 of the ship
  return samples;
}

// A mechanism, and the prism by which its worth is largest: backscatter within `about_deg` of azimuth 0.
struct Case {
  Mechanism mechanism;
  const char* name;
  const char* section;
  bool hard;
  double about_deg;
};

constexpr std::array<Case, kMechanisms - 1> kCases{
    {{Mechanism::kSingleDiffraction, "single", "box", false, 180},
     {Mechanism::kMultipleDiffraction, "multiple", "box", true, 180},
     {Mechanism::kReflectedEdge, "reflected_edge", "dihedral", false, 38},
     {Mechanism::kShadowBoundary, "shadow_boundary", "dihedral", false, 8},
     {Mechanism::kWallPenumbra, "penumbra", "dihedral", false, 70},
     {Mechanism::kConcaveEdge, "concave", "dihedral95", false, 47}}};

// The bound is below the smallest ratio measured, 1.7: a mechanism that does not reach it is not worth its code.
TEST(MechanismWorth, EveryMechanismReducesTheErrorAgainstIntegralEquations) {
  for (const Case& of : kCases) {
    const std::vector<Sample> samples = prism_samples(of.section, of.hard, of.about_deg);
    const double with = error_with_all(samples), without = error_without(samples, of.mechanism);
    EXPECT_GT(without, 1.5 * with) << of.name;
    record_figure(with, 4, "worth_{}_with", of.name);
    record_figure(without, 4, "worth_{}_without", of.name);
  }
}

// Relative change of the echo without a mechanism, at 16 GHz, elevation 2 deg.
TEST(MechanismWorth, ShipAndDecoyChangeWithoutAMechanism) {
  const std::vector<Sample> ship = target_samples("combatant_144m.glb", 12),
                            decoy = target_samples("icosahedral_reflector.glb", 36);
  for (const Case& of : kCases) {
    const double of_ship = error_without(ship, of.mechanism), of_decoy = error_without(decoy, of.mechanism);
    record_figure(of_ship, 3, "worth_{}_ship", of.name);
    record_figure(of_decoy, 3, "worth_{}_decoy", of.name);
  }
  const auto is_edge = [](Mechanism m) { return m != Mechanism::kPhysicalOptics; };
  record_figure(error_without(ship, is_edge), 3, "worth_edge_ship");
  record_figure(error_without(decoy, is_edge), 3, "worth_edge_decoy");
}

// The hull with a house, on which every mechanism but the concave edge occurs: without all of them the error is larger
// at every elevation, by a fifth at least.
TEST(MechanismWorth, EdgesTogetherReduceTheErrorOnAHullWithAHouse) {
  const auto is_edge = [](Mechanism m) { return m != Mechanism::kPhysicalOptics; };
  for (const double elevation : {2.0, 10.0, 25.0, 50.0}) {
    for (const Channel channel : {kHhChannel, kVvChannel}) {
      const std::vector<Sample> samples = block_ship_samples(elevation, channel);
      EXPECT_GT(error_without(samples, is_edge), 1.2 * error_with_all(samples)) << elevation << ' ' << channel;
    }
  }
}

}  // namespace
}  // namespace seaglint
