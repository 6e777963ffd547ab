// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

#include "sim/geometry/shapes/generators.h"
#include "tests/measured.h"
#include "tests/sim/scattering/solve_calls.h"
#include "tests/sim/scattering/solver_fixtures.h"

namespace seaglint {
namespace {

using namespace testing_echoes;

// Corner reflectors against the apertures of geometrical optics.

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

TEST(Trihedral, FollowsItsApertureOver25Degrees) {
  for (const bool square : {false, true}) {
    const char* const name = square ? "square" : "triangular";
    double largest = 0;
    const double mean = mean_difference_db(square ? make_square_trihedral(0.8) : make_triangular_trihedral(0.8), 0.8,
                                           square ? square_aperture : triangular_aperture, largest);
    fmt::print("{} trihedral, +-25 deg: mean {:.4f} dB, largest {:.4f} dB\n", name, mean, largest);
    record_figure(mean, 4, "trihedral_{}_mean_db", name);
    EXPECT_LT(mean, 0.3);
  }
}

// A body on a deck against image theory: a body of twice the height in free space, illuminated by the wave and by its
// image.

void add_quad(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& p : {a, b, c, d}) mesh.vertices.push_back(p);
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.triangle_part.resize(mesh.triangles.size(), 0);
  mesh.triangle_material.resize(mesh.triangles.size(), 0);
}

// One part, one material.
TriangleMesh without_triangles() {
  TriangleMesh mesh = make_plate(1, 1);
  mesh.vertices.clear();
  mesh.triangles.clear();
  mesh.triangle_part.clear();
  mesh.triangle_material.clear();
  return mesh;
}

// 2 x by 2 y; a plate where x is 0.
TriangleMesh block(double x, double y, double bottom, double top, bool open_below = false) {
  TriangleMesh mesh = without_triangles();
  const std::array<Vec3, 4> low{Vec3(-x, -y, bottom), Vec3(x, -y, bottom), Vec3(x, y, bottom), Vec3(-x, y, bottom)};
  const auto up = [&](int i) { return Vec3(low[i].x(), low[i].y(), top); };
  if (x == 0) {
    add_quad(mesh, low[1], low[2], up(2), up(1));
    return mesh;
  }
  for (int i = 0; i < 4; ++i) add_quad(mesh, low[i], low[(i + 1) % 4], up((i + 1) % 4), up(i));
  add_quad(mesh, up(0), up(1), up(2), up(3));
  if (!open_below) add_quad(mesh, low[3], low[2], low[1], low[0]);
  return mesh;
}

// A plate whose top leans back by `lean` per metre.
TriangleMesh leaning_plate(double half_width, double height, double lean) {
  TriangleMesh mesh = block(0, half_width, 0, height);
  for (Vec3& p : mesh.vertices) p.x() -= lean * p.z();
  return mesh;
}

// The mesh with its image in the deck.
TriangleMesh with_image(TriangleMesh mesh) {
  TriangleMesh image = mesh;
  for (Vec3& p : image.vertices) p.z() *= -1;
  for (auto& triangle : image.triangles) std::swap(triangle[1], triangle[2]);
  mesh.append(image);
  return mesh;
}

struct Elevations {
  double first_deg, last_deg;
};

struct Deviation {
  double hh = 0, vv = 0, hv = 0;  // over directions in L2: of hh and vv relative, of hv relative to hh
};

void expect_below(const Deviation& deviation, const Deviation& bound) {
  EXPECT_LT(deviation.hh, bound.hh);
  EXPECT_LT(deviation.vv, bound.vv);
  EXPECT_LT(deviation.hv, bound.hv);
}

// The same; `largest` becomes the largest of what was compared with it.
void expect_below(const Deviation& deviation, const Deviation& bound, Deviation& largest) {
  expect_below(deviation, bound);
  largest = {std::max(largest.hh, deviation.hh), std::max(largest.vv, deviation.vv),
             std::max(largest.hv, deviation.hv)};
}

// Two walls of equal width that meet at a right angle, open towards x.
TriangleMesh inner_corner(double width, double bottom, double top) {
  TriangleMesh mesh = without_triangles();
  const double a = width * std::sqrt(0.5);
  add_quad(mesh, {0, 0, bottom}, {a, -a, bottom}, {a, -a, top}, {0, 0, top});
  add_quad(mesh, {a, a, bottom}, {0, 0, bottom}, {0, 0, top}, {a, a, top});
  return mesh;
}

// At 10 GHz, on a square deck whose own echo is subtracted.
Deviation against_image_theory(const TriangleMesh& body, const TriangleMesh& doubled_body, double half_deck,
                               double azimuth_deg, const Elevations& elevations) {
  const double k = wavenumber(10e9);
  const TriangleMesh deck = block(half_deck, half_deck, -1, 0);
  TriangleMesh both = deck;
  both.append(body);
  const Scatterer alone(deck), on_deck(both), doubled(doubled_body, {}, 0);
  const TracingSettings settings{1.4e-5, 8, true};
  std::array<double, 3> error{}, power{};
  for (double elevation = elevations.first_deg; elevation <= elevations.last_deg; elevation += 0.5) {
    const RadarBasis radar = radar_basis(direction(azimuth_deg, elevation)),
                     image = radar_basis(direction(azimuth_deg, -elevation));
    const auto echo_of = [&](const Scatterer& target, const BistaticGeometry& geometry) {
      return scattering_matrices(target, geometry, std::array{k}, settings)[0];
    };
    const auto with = echo_of(on_deck, monostatic(radar)), without = echo_of(alone, monostatic(radar));
    // the image's h has the other sign
    const auto direct = echo_of(doubled, monostatic(radar)), mirrored = echo_of(doubled, bistatic(image, radar));
    const std::array<Complex, 4> exact{
        direct[kHhChannel] - mirrored[kHhChannel], direct[kHvChannel] + mirrored[kHvChannel],
        direct[kVhChannel] - mirrored[kVhChannel], direct[kVvChannel] + mirrored[kVvChannel]};
    const auto add = [&](std::size_t i, Complex difference, Complex reference) {
      error[i] += std::norm(difference);
      power[i] += std::norm(reference);
    };
    add(0, with[kHhChannel] - without[kHhChannel] - exact[kHhChannel], exact[kHhChannel]);
    add(1, with[kVvChannel] - without[kVvChannel] - exact[kVvChannel], exact[kVvChannel]);
    for (const Channel c : {kHvChannel, kVhChannel}) add(2, 0.5 * (with[c] - without[c] - exact[c]), 0);
  }
  const Deviation deviation{std::sqrt(error[0] / power[0]), std::sqrt(error[1] / power[1]),
                            std::sqrt(error[2] / power[0])};
  std::printf("azimuth %g deg, elevation %g to %g deg: hh %.3f, vv %.3f, hv %.4f of hh\n", azimuth_deg,
              elevations.first_deg, elevations.last_deg, deviation.hh, deviation.vv, deviation.hv);
  return deviation;
}

// The body is 10 wavelengths wide and 6.7 high.
constexpr double kHalfWidth = 0.15, kHeight = 0.2;

Deviation of_block(double half_depth, double half_deck, double azimuth_deg, const Elevations& elevations) {
  return against_image_theory(block(half_depth, kHalfWidth, 0, kHeight, true),
                              block(half_depth, kHalfWidth, -kHeight, kHeight), half_deck, azimuth_deg, elevations);
}

Deviation of_leaning_plate(double lean_deg, double half_deck, double azimuth_deg, const Elevations& elevations) {
  const TriangleMesh plate = leaning_plate(kHalfWidth, kHeight, std::tan(radians(lean_deg)));
  return against_image_theory(plate, with_image(plate), half_deck, azimuth_deg, elevations);
}

// Bounds are measured, a tenth above the maximum: the residual of subtracting the end-point contributions of physical
// optics on the deck, the last reflector, and adding the edges' fields via the deck, for an echo that decreases from
// 3.6 m to 0.08 m (30 to 45 deg off, where the error is that of the end points of the upper edge, off Keller's cone).
// With Gordon's end-point contributions at the edges, one face's of two, and the mean of a path and its reciprocal, hh
// and vv had errors of up to 0.31 and 0.20, hv 0.25; without edges 0.5, since the deck's half of the echo is missing.
TEST(BodyOnDeck, FollowsImageTheory) {
  for (const auto& [half_depth, hh, vv, hv] :
       {std::array{0.0, 0.2, 0.06, 0.015}, {0.05, 0.17, 0.07, 0.07}, {0.15, 0.11, 0.075, 0.012}}) {
    for (const double azimuth : {0.0, 5.0, 10.0, 20.0, 30.0, 45.0}) {
      SCOPED_TRACE(testing::Message() << 2 * half_depth << " m deep, azimuth " << azimuth);
      const Deviation found = of_block(half_depth, 2, azimuth, {10, 40});
      expect_below(found, {hh, vv, hv});
      record_figure(found.hh, 3, "deck_{:.0f}cm_{}_deg_hh", 200 * half_depth, azimuth);
      record_figure(found.vv, 3, "deck_{:.0f}cm_{}_deg_vv", 200 * half_depth, azimuth);
      record_figure(found.hv, 3, "deck_{:.0f}cm_{}_deg_hv", 200 * half_depth, azimuth);
    }
  }
}

// A deck of 30 x 30 m, so that all of the wave that the wall reflects downwards is incident on it. Bounds are measured,
// a tenth above the maximum: below 5 deg the paths via the deck are images (image_weight()), from 6 deg on they
// end on the deck and its edges. With the deck as the last reflector at every elevation hh and vv had errors of up to
// 0.57 and 0.53 from 1 to 3 deg, 0.29 and 0.21 from 3 to 5 deg.
TEST(BodyOnDeck, FollowsImageTheoryAtLowElevations) {
  Deviation first{}, second{}, third{};
  for (const auto& [half_depth, hh] : {std::pair{0.0, 0.12}, {0.15, 0.135}}) {
    for (const double azimuth : {0.0, 5.0, 10.0}) {
      SCOPED_TRACE(testing::Message() << 2 * half_depth << " m deep, azimuth " << azimuth);
      expect_below(of_block(half_depth, 15, azimuth, {1, 3}), {0.085, 0.05, 0.006}, first);
      expect_below(of_block(half_depth, 15, azimuth, {3, 5}), {0.075, 0.05, 0.015}, second);
      expect_below(of_block(half_depth, 15, azimuth, {5, 8}), {hh, 0.11, 0.02}, third);
    }
  }
  record_figure(first.hh, 2, "deck_1_to_3_deg_hh");
  record_figure(first.vv, 2, "deck_1_to_3_deg_vv");
  record_figure(second.hh, 2, "deck_3_to_5_deg_hh");
  record_figure(second.vv, 2, "deck_3_to_5_deg_vv");
  record_figure(third.hh, 2, "deck_5_to_8_deg_hh");
  record_figure(third.vv, 2, "deck_5_to_8_deg_vv");
}

// The path deck - one wall - the other - deck is also represented by the image. The residual of vv is present at 20 deg
// of elevation too (0.1): the walls' edges behind two reflectors. With the deck as the last reflector it was 0.33 to
// 0.37 and 0.37 to 0.38 from 1 to 3 deg.
TEST(BodyOnDeck, ConcaveWallsFollowImageTheory) {
  Deviation first{}, second{};
  for (const double azimuth : {0.0, 5.0, 20.0}) {
    SCOPED_TRACE(testing::Message() << "azimuth " << azimuth);
    const auto deviation = [&](const Elevations& elevations) {
      return against_image_theory(inner_corner(0.2, 0, kHeight), inner_corner(0.2, -kHeight, kHeight), 15, azimuth,
                                  elevations);
    };
    expect_below(deviation({1, 3}), {0.23, 0.19, 0.03}, first);
    expect_below(deviation({3, 5}), {0.085, 0.24, 0.015}, second);
  }
  record_figure(first.hh, 2, "deck_corner_1_to_3_deg_hh");
  record_figure(first.vv, 2, "deck_corner_1_to_3_deg_vv");
  record_figure(second.hh, 2, "deck_corner_3_to_5_deg_hh");
  record_figure(second.vv, 2, "deck_corner_3_to_5_deg_vv");
}

// Walls that lean back, as those of deckhouses, and forward. Their images are illuminated and visible as the walls
// themselves, though geometrical optics has no path deck - wall - deck, and from a wall that leans back by more than
// half of the elevation none to the deck either. Bounds as above; with the deck as the last reflector 0.26 to 2.
TEST(BodyOnDeck, LeaningPlatesFollowImageTheory) {
  for (const auto& [lean_deg, hh, vv, hv] : {std::array{-5.0, 0.26, 0.115, 0.11},
                                             {-1.0, 0.12, 0.115, 0.005},
                                             {1.0, 0.12, 0.09, 0.02},
                                             {5.0, 0.065, 0.085, 0.005},
                                             {10.0, 0.16, 0.155, 0.005}}) {
    Deviation largest{};
    for (const double azimuth : {0.0, 5.0, 10.0}) {
      SCOPED_TRACE(testing::Message() << "leans " << lean_deg << " deg, azimuth " << azimuth);
      expect_below(of_leaning_plate(lean_deg, 15, azimuth, {1, 4}), {hh, vv, hv}, largest);
    }
    const char* direction_of_lean = lean_deg < 0 ? "forward" : "back";
    record_figure(largest.hh, 2, "deck_plate_leans_{}_{:.0f}_deg_hh", direction_of_lean, std::abs(lean_deg));
    record_figure(largest.vv, 2, "deck_plate_leans_{}_{:.0f}_deg_vv", direction_of_lean, std::abs(lean_deg));
  }
}

// Prisms of several cross-sections against integral equations of the infinitely long ones: wedges of any angle,
// monostatic and bistatic.

struct SoftHard {
  double soft = 0, hard = 0;  // relative, of the field in L2
};

void expect_below(const SoftHard& found, const SoftHard& bound) {
  EXPECT_LT(found.soft, bound.soft);
  EXPECT_LT(found.hard, bound.hard);
}

struct Echoes {
  Complex soft, hard;
};

// P of sections.py, from the difference of a prism of twice the height and the prism. S per metre is j P / pi, of the
// hard wave with H opposite to the axis.
Echoes echoes_per_metre(const Scatterer& one, const Scatterer& two, double height, const BistaticGeometry& geometry,
                        double k) {
  const auto echo_of = [&](const Scatterer& target) {
    return scattering_matrices(target, geometry, std::array{k}, {7e-5, 8, true})[0];
  };
  const auto long_one = echo_of(two), short_one = echo_of(one);
  const Complex per_metre = kPi / (height * Complex(0, 1));
  return {per_metre * (long_one[kVvChannel] - short_one[kVvChannel]),
          -per_metre * (long_one[kHhChannel] - short_one[kHhChannel])};
}

// Relative error of the echo of 2 m of a prism against the integral equations, over all pairs of directions between
// these angles apart, the receiver's within `about_deg` of azimuth 0. On the cone of an elevation (transmitter above,
// receiver as far below) a prism scatters as at elevation 0 with the wavenumber normal to its axis.
SoftHard against_integral_equations(const std::string& section, double min_deg, double max_deg, double elevation_deg,
                                    double about_deg = 180) {
  const double k = wavenumber(10.24e9) / std::cos(radians(elevation_deg)), height = 2;
  const Scatterer one(prism(sections().at(section), height)), two(prism(sections().at(section), 2 * height));
  RelativeError of_soft, of_hard;
  for (const auto& row : read_csv("sections.csv")) {
    if (row[6] != section) continue;
    const double transmit = std::stod(row[0]), receive = std::stod(row[1]);
    const double bistatic_angle = std::abs(std::remainder(transmit - receive, 360));
    if (bistatic_angle < min_deg || bistatic_angle > max_deg || std::abs(std::remainder(receive, 360)) > about_deg)
      continue;
    const auto geometry = bistatic_angle == 0 && elevation_deg == 0
                              ? monostatic(radar_basis(direction(receive, 0)))
                              : bistatic(radar_basis(direction(transmit, elevation_deg)),
                                         radar_basis(direction(receive, -elevation_deg)));
    const auto [soft_P, hard_P] = echoes_per_metre(one, two, height, geometry, k);
    of_soft.add(soft_P, {std::stod(row[2]), std::stod(row[3])});
    of_hard.add(hard_P, {std::stod(row[4]), std::stod(row[5])});
  }
  const SoftHard deviation{of_soft.value(), of_hard.value()};
  std::printf("%s, %g to %g deg apart, elevation %g deg: soft %.4f, hard %.4f\n", section.c_str(), min_deg, max_deg,
              elevation_deg, deviation.soft, deviation.hard);
  return deviation;
}

SoftHard larger(const SoftHard& a, const SoftHard& b) { return {std::max(a.soft, b.soft), std::max(a.hard, b.hard)}; }

// The errors are due to higher diffraction orders and, for the hard field, to the largest elements of the integral
// equations.
TEST(InfinitePrism, BackscatterMatchesIntegralEquation) {
  SoftHard worst;
  for (const std::string section : {"box", "knife", "triangle"}) {
    const SoftHard back = against_integral_equations(section, 0, 0, 0);
    worst = larger(worst, back);
    SCOPED_TRACE(section);
    expect_below(back, {0.0015, 0.003});
  }
  record_figure(worst.soft, 4, "prism_back_soft");
  record_figure(worst.hard, 4, "prism_back_hard");
}

// The concave edge of a chevron diffracts; without it the error of the soft field is 0.04 and, without the waves that
// it launches along its walls, that of the hard one 0.09.
TEST(InfinitePrism, WithAConcaveEdgeMatchesIntegralEquation) {
  const SoftHard back = against_integral_equations("chevron", 0, 0, 0);
  expect_below(back, {0.02, 0.08});
  record_figure(back.soft, 3, "chevron_soft");
  record_figure(back.hard, 3, "chevron_hard");
}

// The free edge of either arm bounds the beam that it reflects to the other, whose edge coincides with the shadow
// boundary, so that half of the field in the transition region is lost: with a sharp shadow boundary the error is 0.09
// within 8 deg of the axis. Farther off, where the beam leaves an arm at a small angle, the edge radiates along it
// Keller's field less the end-point contribution of physical optics on the other arm (endpoint_correction()); with that
// on its own arm the error is 0.023 within 20 deg and 0.06 within 38. The remaining error, of arms of 5 wavelengths, is
// due to waves along them, most of the hard field.
TEST(InfinitePrism, DihedralMatchesIntegralEquation) {
  for (const double elevation : {0.0, 40.0}) {
    const SoftHard axis = against_integral_equations("dihedral", 0, 0, elevation, 8),
                   back = against_integral_equations("dihedral", 0, 0, elevation, 20);
    const SoftHard grazing = against_integral_equations("dihedral", 0, 0, elevation, 38);
    expect_below(axis, {0.006, 0.02});
    expect_below(back, {0.01, 0.02});
    expect_below(grazing, {0.03, 0.03});  // soft 0.012 except for the bistatic geometry
    record_figure(axis.soft, 3, "dihedral_8_deg_cone_{}_soft", elevation);
    record_figure(axis.hard, 3, "dihedral_8_deg_cone_{}_hard", elevation);
    record_figure(back.soft, 3, "dihedral_20_deg_cone_{}_soft", elevation);
    record_figure(back.hard, 3, "dihedral_20_deg_cone_{}_hard", elevation);
    record_figure(grazing.soft, 3, "dihedral_38_deg_cone_{}_soft", elevation);
    record_figure(grazing.hard, 3, "dihedral_38_deg_cone_{}_hard", elevation);
  }
}

// At directions along one arm and beyond, the other arm is in the penumbra of the edge (multiple_diffraction.h): with
// full illumination by physical optics the errors are 0.10 (soft) and 0.055 (hard) for arms of 5 wavelengths, 0.042 and
// 0.023 for arms of 20.
TEST(InfinitePrism, DihedralAlongItsArmsMatchesIntegralEquation) {
  const SoftHard near = against_integral_equations("dihedral", 0, 0, 0, 70),
                 far = against_integral_equations("dihedral90long", 0, 0, 0, 70);
  expect_below(near, {0.015, 0.03});
  expect_below(far, {0.003, 0.01});
  record_figure(near.soft, 3, "dihedral_70_deg_soft");
  record_figure(near.hard, 3, "dihedral_70_deg_hard");
  record_figure(far.soft, 3, "dihedral_long_70_deg_soft");
  record_figure(far.hard, 3, "dihedral_long_70_deg_hard");
}

// For other opening angles than 90 deg the exit paths of edges differ from the beams that they bound: with end-point
// contributions of physical optics on shadow-boundary lines the error is 0.14 to 0.20 (beam_boundary.h).
TEST(InfinitePrism, DihedralOffTheRightAngleMatchesIntegralEquation) {
  for (const std::string section : {"dihedral85", "dihedral95"}) {
    const SoftHard axis = against_integral_equations(section, 0, 0, 0, 8),
                   back = against_integral_equations(section, 0, 0, 0, 20);
    SCOPED_TRACE(section);
    expect_below(axis, {0.03, 0.05});
    expect_below(back, {0.03, 0.08});
    record_figure(axis.soft, 3, "{}_8_deg_soft", section);
    record_figure(axis.hard, 3, "{}_8_deg_hard", section);
    record_figure(back.soft, 3, "{}_20_deg_soft", section);
    record_figure(back.hard, 3, "{}_20_deg_hard", section);
  }
}

// A beam that one arm reflects nearly along the other has a penumbra there, within some 13 deg over 5 wavelengths,
// which physical optics neglects; the concave edge launches it as a wave along the arm (multiple_diffraction.h).
// Without that the errors of the hard field are 0.21 and 0.28, of arms of 20 wavelengths 0.22. The remaining error is
// that of return paths, of which only half is separable from the beams' end-point contributions there, and below a
// right angle of the edges' own fields, which return as rays.
TEST(InfinitePrism, DihedralHasWavesFromItsConcaveEdge) {
  for (const double elevation : {0.0, 40.0}) {
    const double wide = against_integral_equations("dihedral95", 0, 0, elevation, 47).hard;
    EXPECT_LT(wide, 0.12) << elevation;
    record_figure(wide, 3, "dihedral95_47_deg_cone_{}_hard", elevation);
  }
  const double narrow = against_integral_equations("dihedral85", 0, 0, 0, 42).hard,
               long_one = against_integral_equations("dihedral95long", 0, 0, 0, 46).hard;
  EXPECT_LT(narrow, 0.2);
  EXPECT_LT(long_one, 0.16);
  record_figure(narrow, 3, "dihedral85_42_deg_hard");
  record_figure(long_one, 3, "dihedral95_long_46_deg_hard");
}

// At 37.5 deg the wave that one arm of the 95 deg dihedral reflects passes along the other, which it illuminates on one
// side of that direction only. Without waves from the concave edge the echo has a step of 5.5 there; the remaining
// step, 1.2, is due to the edges' paths via the other arm, which are tapered near the forward direction.
TEST(InfinitePrism, DihedralHasASmallStepWhereABeamGrazesAnArm) {
  const double k = wavenumber(10.24e9), height = 2;
  const Scatterer one(prism(sections().at("dihedral95"), height)), two(prism(sections().at("dihedral95"), 2 * height));
  const auto hard_at = [&](double azimuth) {
    return echoes_per_metre(one, two, height, monostatic(radar_basis(direction(azimuth, 0))), k).hard;
  };
  const Complex before = hard_at(37.48), after = hard_at(37.52);
  EXPECT_GT(std::abs(before), 3);
  EXPECT_LT(std::abs(after - before), 1.5);
}

// Illuminated faces that are not visible to the receiver do not radiate to it: without their contribution to the edges'
// field its error is 0.03 to 0.1. Behind the target the error is that of soft waves at grazing incidence on a face
// (slope diffraction); up to 20 deg from the forward direction.
TEST(InfinitePrism, BistaticEchoMatchesIntegralEquation) {
  SoftHard worst_before, worst_behind;
  for (const std::string section : {"box", "knife", "triangle"}) {
    for (const double elevation : {0.0, 40.0}) {
      const SoftHard before = against_integral_equations(section, 1, 90, elevation),
                     behind = against_integral_equations(section, 90, 160, elevation);
      SCOPED_TRACE(section);
      expect_below(before, {0.005, 0.004});
      expect_below(behind, {0.09, 0.01});
      worst_before = larger(worst_before, before);
      worst_behind = larger(worst_behind, behind);
    }
  }
  record_figure(worst_before.soft, 4, "prism_90_deg_soft");
  record_figure(worst_before.hard, 4, "prism_90_deg_hard");
  record_figure(worst_behind.soft, 3, "prism_160_deg_soft");
  record_figure(worst_behind.hard, 3, "prism_160_deg_hard");
}

// A hull with a house on its deck, six wavelengths long, against integral equations: walls on decks, concave edges,
// free edges and multiple diffraction together, in three dimensions.

// Over azimuth 0 to 90 deg.
Deviation of_ship(const Scatterer& ship, double elevation_deg) {
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
    SCOPED_TRACE(elevation);
    const Deviation deviation = of_ship(ship, elevation);
    expect_below(deviation, {hh, vv, 0.25});
    record_figure(deviation.hh, 3, "block_ship_{}_deg_hh", elevation);
    record_figure(deviation.vv, 3, "block_ship_{}_deg_vv", elevation);
    record_figure(deviation.hv, 2, "block_ship_{}_deg_hv", elevation);
  }
}

}  // namespace
}  // namespace seaglint
