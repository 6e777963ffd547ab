// SPDX-License-Identifier: BSD-3-Clause
// A hull with a house on its deck, six wavelengths long, against integral equations: walls on decks, concave edges,
// free edges and multiple diffraction together, in three dimensions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "tests/measured.h"
#include "tests/sim/scattering/solver_fixtures.h"
#include "tests/sim/scattering/validation/reference_bodies.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

struct Deviation {
  double hh = 0, vv = 0, hv = 0;  // in L2 over azimuth 0 to 90 deg: of hh and vv relative, of hv relative to hh
};

Deviation against_integral_equations(const Scatterer& ship, double elevation_deg) {
  std::array<double, 3> error{}, power{};
  std::array<double, 2> of_beams{};  // hv and vh of the beams
  std::size_t count = 0;
  for (const auto& row : read_csv("block_ship.csv")) {
    if (std::stod(row[1]) != elevation_deg) continue;
    const std::array view{monostatic(radar_basis(direction(std::stod(row[0]), elevation_deg)))};
    const auto s = one_way_matrices(ship, view, std::array{2 * kPi}, {7e-5, 8, true})[0][0];
    const std::array<Complex, 3> ours{s[kHhChannel], 0.5 * (s[kHvChannel] + s[kVhChannel]), s[kVvChannel]};
    for (std::size_t i = 0; i < 3; ++i) {
      const Complex exact(std::stod(row[2 + 2 * i]), std::stod(row[3 + 2 * i]));
      error[i] += std::norm(ours[i] - exact);
      power[i] += std::norm(exact);
      if (i == 1) {
        of_beams[0] += std::norm(s[kHvChannel] - exact);
        of_beams[1] += std::norm(s[kVhChannel] - exact);
      }
    }
    ++count;
  }
  const Deviation deviation{std::sqrt(error[0] / power[0]), std::sqrt(error[2] / power[2]),
                            std::sqrt(error[1] / power[0])};
  std::printf("block ship, elevation %g deg: hh %.3f, vv %.3f, hv %.3f of hh (hv itself %.3f)\n", elevation_deg,
              deviation.hh, deviation.vv, deviation.hv, std::sqrt(power[1] / power[0]));
  const auto rms = [&](double sum) { return std::sqrt(sum / static_cast<double>(count)); };
  std::printf("  hv of the beams %.3f, vh %.3f, their mean %.3f wavelengths\n", rms(of_beams[0]), rms(of_beams[1]),
              rms(error[1]));
  return deviation;
}

// Measured, with a margin of about a tenth: no error budget is known for a body whose deck next to the house is 0.3
// wavelengths wide and whose house is 1 wide, with multiple interactions that the model neglects. Without edges the
// errors of hh and vv are 0.27 and 0.16 at 2 deg, 0.20 and 0.19 at 10, 0.48 and 0.61 at 25, 0.38 and 0.52 at 50. hv of
// such a body is not predicted: its error equals its magnitude.
TEST(BlockShip, MatchesIntegralEquations) {
  const Scatterer ship(block_ship());
  for (const auto& [elevation, hh, vv] :
       {std::array{2.0, 0.13, 0.08}, {10.0, 0.18, 0.14}, {25.0, 0.225, 0.245}, {50.0, 0.14, 0.43}}) {
    const Deviation deviation = against_integral_equations(ship, elevation);
    EXPECT_LT(deviation.hh, hh) << elevation;
    EXPECT_LT(deviation.vv, vv) << elevation;
    EXPECT_LT(deviation.hv, 0.25) << elevation;
    record_figure(deviation.hh, 3, "block_ship_{}_deg_hh", elevation);
    record_figure(deviation.vv, 3, "block_ship_{}_deg_vv", elevation);
    record_figure(deviation.hv, 2, "block_ship_{}_deg_hv", elevation);
  }
}

}  // namespace
}  // namespace seaglint
