// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/aperture_field.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/core/numbers/constants.h"

namespace seaglint {
namespace {

constexpr std::size_t kTile = 32;  // patches that one thread takes at a time

// Cells of the aperture with an unobstructed path to the antenna.
std::vector<bool> visible_cells(std::span<const ApertureCell> aperture, const Vec3& r_hat, const RayScene& scene,
                                double radius) {
  std::vector<Ray> rays;
  // Rays start off the plane of the aperture, so that they do not hit its rim (Embree is single precision).
  for (const ApertureCell& cell : aperture) {
    const double off = 1e-2 * std::sqrt(cell.area) + 1e-6 * radius;
    rays.push_back({cell.centre + off * (r_hat - cell.inward), r_hat});
  }
  std::vector<int> hit(rays.size());
  scene.first_hits(rays, hit);
  std::vector<bool> visible(aperture.size());
  for (std::size_t i = 0; i < aperture.size(); ++i)
    visible[i] = aperture[i].inward.dot(r_hat) < 0 && hit[i] == kNoFacet;
  return visible;
}

}  // namespace

ApertureFields incident_aperture_fields(std::span<const ApertureCell> aperture, double k,
                                        std::span<const BistaticGeometry> views, RadarBasis BistaticGeometry::*antenna,
                                        const RayScene& scene, double radius) {
  ApertureFields fields =
      ApertureFields::Zero(4 * static_cast<Eigen::Index>(aperture.size()), 2 * static_cast<Eigen::Index>(views.size()));
  for (std::size_t view = 0; view < views.size(); ++view) {
    const RadarBasis& from = views[view].*antenna;
    const std::vector<bool> visible = visible_cells(aperture, from.r, scene, radius);
    for (std::size_t i = 0; i < aperture.size(); ++i) {
      if (!visible[i]) continue;
      const ApertureCell& cell = aperture[i];
      const Complex wave = std::polar(std::sqrt(cell.area), k * from.r.dot(cell.centre));
      for (int p = 0; p < 2; ++p) {
        const Vec3 E = p == 0 ? from.h : from.v, H = -from.r.cross(E);  // of a wave propagating along -r^
        const Vec3 J = cell.inward.cross(H), M = -cell.inward.cross(E);
        fields.block(4 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(view) + p, 4, 1) =
            wave *
            Eigen::Vector4d(cell.across.dot(J), cell.up.dot(J), cell.across.dot(M), cell.up.dot(M)).cast<Complex>();
      }
    }
  }
  return fields;
}

// A current element at a distance R (Harrington, Time-Harmonic Electromagnetic Fields, sec. 2-9), and by duality (3-2)
// a magnetic one, with G = e^{-jkR}/(4 pi R):
//   eta H = grad G x eta J - jk G [a M - b R^ (R^ . M)],   E = -grad G x M - jk G [a eta J - b R^ (R^ . eta J)]
//   grad G = -(1 + jkR) G R^ / R,   a = 1 - j/kR - 1/(kR)^2,   b = 1 - 3j/kR - 3/(kR)^2
WallFields wall_fields(std::span<const ApertureCell> aperture, std::span<const WallPatch> walls, double k,
                       const ApertureFields& fields, int threads, const StopFlag* stop) {
  const WallMatrix sources = fields.cast<std::complex<float>>();
  const auto rows = 2 * static_cast<Eigen::Index>(walls.size());
  WallFields result{WallMatrix(rows, fields.cols()), WallMatrix(rows, fields.cols())};
  const auto fill = [&](std::size_t tile) {
    const std::size_t first = tile * kTile, last = std::min(walls.size(), first + kTile);
    const auto count = 2 * static_cast<Eigen::Index>(last - first);
    // Transposed: one column per patch tangent, with its excitation by every source.
    WallMatrix to_E(sources.rows(), count), to_J(sources.rows(), count);
    for (std::size_t i = first; i < last; ++i) {
      const WallPatch& patch = walls[i];
      for (std::size_t j = 0; j < aperture.size(); ++j) {
        const ApertureCell& cell = aperture[j];
        const Vec3 R = patch.centre - cell.centre;
        const double r = R.norm(), kr = k * r;
        const Vec3 towards = R / r;
        const Complex G = std::sqrt(cell.area) / (4 * kPi * r) * Complex(std::cos(kr), -std::sin(kr));
        const Complex slope = -Complex(1, kr) * G / r;
        const Complex a = Complex(1 - 1 / (kr * kr), -1 / kr), b = Complex(1 - 3 / (kr * kr), -3 / kr),
                      radiated = Complex(0, -k) * G;
        for (int t = 0; t < 2; ++t) {
          const Vec3& tangent = patch.tangent[t];
          const Vec3 rotated_tangent = tangent.cross(patch.normal);  // tangent . (n x H) = rotated_tangent . H
          const auto column = 2 * static_cast<Eigen::Index>(i - first) + t;
          for (int s = 0; s < 2; ++s) {
            const Vec3& along = s == 0 ? cell.across : cell.up;
            const Vec3 around = towards.cross(along);
            const auto direct = [&](const Vec3& of) {
              return radiated * (a * of.dot(along) - b * of.dot(towards) * towards.dot(along));
            };
            const auto J = 4 * static_cast<Eigen::Index>(j) + s, M = J + 2;
            to_E(J, column) = std::complex<float>(direct(tangent));
            to_E(M, column) = std::complex<float>(-slope * tangent.dot(around));
            to_J(J, column) = std::complex<float>(2.0 * slope * rotated_tangent.dot(around));
            to_J(M, column) = std::complex<float>(2.0 * direct(rotated_tangent));
          }
        }
      }
    }
    const auto start = 2 * static_cast<Eigen::Index>(first);
    result.incident_electric.middleRows(start, count).noalias() = to_E.transpose() * sources;
    result.mfie_excitation.middleRows(start, count).noalias() = to_J.transpose() * sources;
  };
  parallel_for((walls.size() + kTile - 1) / kTile, threads, fill, stop);
  return result;
}

}  // namespace seaglint
