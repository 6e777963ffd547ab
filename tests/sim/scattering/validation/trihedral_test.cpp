// SPDX-License-Identifier: BSD-3-Clause
// Corner reflectors against the apertures of geometrical optics.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "sim/geometry/shapes/generators.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Area normal to the direction that returns after three bounces, for edges of length 1 and direction cosines l <= m <=
// n (R. C. Spencer, Optical Theory of the Corner Reflector, MIT Radiation Laboratory report 433, 1944; J. W. Crispin
// and K. M. Siegel, Methods of Radar Cross-Section Analysis, 1968, ch. 2).
double triangular_aperture(double l, double m, double n) {
  const double sum = l + m + n;
  return l + m >= n ? sum - 2 / sum : 4 * l * m / sum;
}
double square_aperture(double l, double m, double n) { return m >= n / 2 ? l * (4 - n / m) : 4 * l * m / n; }

// Mean over +-25 deg in azimuth and in elevation about the axis of the solver's level less the aperture's 4 pi A^2 /
// lambda^2. One- and two-bounce echoes interfere with the three-bounce one: power is averaged over a tenth of the
// frequency at each direction, which leaves their own power, below 1e-3 dB on average.
double mean_difference_db(const TriangleMesh& mesh, double b,
                          const std::function<double(double, double, double)>& aperture, double& largest) {
  const Scatterer trihedral(mesh);
  std::vector<double> wavenumbers;
  for (int i = 0; i < 16; ++i) wavenumbers.push_back(400 / b * (1 + 0.1 * (i / 15.0 - 0.5)));
  double sum = 0;
  int count = 0;
  largest = 0;
  for (const bool in_azimuth : {true, false}) {
    for (double off = -25; off <= 25; off += 2.5) {
      const Vec3 r = direction(45 + (in_azimuth ? off : 0), 35.264389682754654 + (in_azimuth ? 0 : off));
      std::array<double, 3> cosine{r.x(), r.y(), r.z()};
      std::sort(cosine.begin(), cosine.end());
      const double area = b * b * aperture(cosine[0], cosine[1], cosine[2]);
      double ours = 0, expected = 0;
      const auto s = scattering_matrices(trihedral, monostatic(radar_basis(r)), wavenumbers, {0, 8, false});
      for (std::size_t q = 0; q < wavenumbers.size(); ++q) {
        ours += std::norm(s[q][kVvChannel]);
        expected += std::pow(area * wavenumbers[q] / (2 * kPi), 2);
      }
      const double difference = 10 * std::log10(ours / expected);
      sum += std::abs(difference);
      largest = std::max(largest, std::abs(difference));
      ++count;
    }
  }
  return sum / count;
}

TEST(Trihedral, TriangularFollowsItsApertureOver25Degrees) {
  double largest = 0;
  const double mean = mean_difference_db(make_triangular_trihedral(0.8), 0.8, triangular_aperture, largest);
  fmt::print("triangular trihedral, +-25 deg: mean {:.4f} dB, largest {:.4f} dB\n", mean, largest);
  record_figure(mean, 4, "trihedral_triangular_mean_db");
  EXPECT_LT(mean, 0.3);
}

TEST(Trihedral, SquareFollowsItsApertureOver25Degrees) {
  double largest = 0;
  const double mean = mean_difference_db(make_square_trihedral(0.8), 0.8, square_aperture, largest);
  fmt::print("square trihedral, +-25 deg: mean {:.4f} dB, largest {:.4f} dB\n", mean, largest);
  record_figure(mean, 4, "trihedral_square_mean_db");
  EXPECT_LT(mean, 0.3);
}

}  // namespace
}  // namespace seaglint
