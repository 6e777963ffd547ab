// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/cavity_scattering.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "sim/cavity/cavity_aperture.h"
#include "sim/cavity/wall_currents.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/scattering/observation/observation.h"

namespace seaglint {
namespace {

// The aperture is divided more finely than the walls, to which its cells are as close as half a patch.
constexpr double kCellsPerPatch = 2;
// Batch limits: number of directions, and directions times aperture cells (several hundred MB).
constexpr std::size_t kMaxViewsPerBatch = 128, kViewsTimesCells = 400'000;
// Minimum distances in patch sizes: below the first, point currents do not approximate opposite walls; the second
// applies to the aperture.
constexpr double kMinWallGap = 0.5, kMinApertureGap = 0.2;
// RMS error over directions of the aperture fields in the basis; new fields are solved only where the error of the
// known basis exceeds ten times this.
constexpr double kMaxFieldError = 1e-4;

// Orders patches from the aperture inwards, adjacent ones consecutively.
void sort_by_depth(const std::vector<ApertureCell>& aperture, std::vector<WallPatch>& walls) {
  Vec3 middle = Vec3::Zero();
  double area = 0;
  for (const ApertureCell& cell : aperture) {
    middle += cell.area * cell.centre;
    area += cell.area;
  }
  middle /= area;
  const auto depth2 = [&](const WallPatch& patch) { return (patch.centre - middle).squaredNorm(); };
  std::stable_sort(walls.begin(), walls.end(),
                   [&](const WallPatch& a, const WallPatch& b) { return depth2(a) < depth2(b); });
}

struct FieldBasis {
  ApertureFields fields;     // orthonormal
  Eigen::VectorXd strength;  // root of the sum of squares over all directions
};

// Basis vectors that, with those of `basis`, represent every column of `fields`.
FieldBasis extend_basis(const ApertureFields& basis, const ApertureFields& fields) {
  ApertureFields rest = fields;
  for (int pass = 0; pass < 2; ++pass) rest -= basis * (basis.adjoint() * rest);
  const double negligible = kMaxFieldError * kMaxFieldError * fields.squaredNorm();
  if (basis.cols() > 0 && rest.squaredNorm() < 100 * negligible) return {ApertureFields(fields.rows(), 0), {}};
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> modes(rest.adjoint() * rest);
  double dropped = 0;
  Eigen::Index first = 0;
  while (first < rest.cols() && dropped + std::max(modes.eigenvalues()(first), 0.0) <= negligible)
    dropped += std::max(modes.eigenvalues()(first++), 0.0);
  const Eigen::Index count = rest.cols() - first;
  const Eigen::VectorXd strength = modes.eigenvalues().tail(count).cwiseSqrt();
  return {rest * modes.eigenvectors().rightCols(count) * strength.cwiseInverse().asDiagonal(), strength};
}

// Each batch is spread over all views, so that the basis of the first serves the others.
std::vector<std::vector<std::size_t>> view_batches(std::size_t views, std::size_t cells) {
  const std::size_t together = std::clamp<std::size_t>(kViewsTimesCells / cells, 1, kMaxViewsPerBatch);
  std::vector<std::vector<std::size_t>> result((views + together - 1) / together);
  for (std::size_t view = 0; view < views; ++view) result[view % result.size()].push_back(view);
  return result;
}

// Columns of a followed by those of b.
template <typename Columns>
void append(Columns& a, const Columns& b) {
  const Eigen::Index before = a.cols();
  a.conservativeResize(b.rows(), before + b.cols());
  a.rightCols(b.cols()) = b;
}

}  // namespace

Cavity::Cavity(const TriangleMesh& mesh, std::size_t part, const Scatterer& whole, double patches_per_wavelength)
    : centre_(whole.centre()),
      walls_(transformed(welded(part_of(mesh, part)), Mat3::Identity(), -centre_)),
      scene_(whole.facets()),
      radius_(whole.radius()),
      patches_per_wavelength_(patches_per_wavelength) {}

struct Cavity::Discretisation {
  std::vector<ApertureCell> aperture;
  std::vector<WallPatch> walls;
};

Cavity::Discretisation Cavity::shape(double k) const {
  const double wavelength = 2 * kPi / k, patch = wavelength / patches_per_wavelength_;
  Discretisation shape{aperture_cells(walls_, patch / kCellsPerPatch), wall_patches(walls_, patch)};
  double mouth = 0;
  for (const ApertureCell& cell : shape.aperture) mouth += cell.area;
  if (std::sqrt(mouth) < wavelength / 2)
    throw InputError(
        fmt::format("cavity aperture of {:.3g} m^2 is narrower than half a wavelength: below cut-off", mouth));
  const auto refuse_nearer = [&](const Vec3& a, const Vec3& b, double least, const char* what) {
    if ((a - b).squaredNorm() >= least * least * patch * patch) return;
    const Vec3 place = a + centre_;
    throw InputError(fmt::format("{} nearer than {:.3g} m at ({:.4g}, {:.4g}, {:.4g}) m: too near at this wavelength",
                                 what, least * patch, place.x(), place.y(), place.z()));
  };
  for (std::size_t i = 0; i < shape.walls.size(); ++i) {
    const WallPatch& wall = shape.walls[i];
    for (const ApertureCell& cell : shape.aperture)
      refuse_nearer(wall.centre, cell.centre, kMinApertureGap, "the cavity's walls and aperture come");
    for (std::size_t j = 0; j < i; ++j) {
      if (wall.normal.dot(shape.walls[j].normal) < -0.5)
        refuse_nearer(wall.centre, shape.walls[j].centre, kMinWallGap,
                      "two walls of the cavity, or both faces of one, come");
    }
  }
  return shape;
}

CavitySize Cavity::size(double k) const {
  const Discretisation shape = this->shape(k);
  CavitySize result{0, surface_area(walls_), shape.walls.size()};
  for (const ApertureCell& cell : shape.aperture) result.aperture_m2 += cell.area;
  return result;
}

std::vector<std::array<Complex, 4>> Cavity::scattering_matrices(double k, std::span<const BistaticGeometry> views,
                                                                int threads, const StopFlag* stop) const {
  auto [aperture, walls] = shape(k);
  sort_by_depth(aperture, walls);
  const WallCurrents currents(walls, k, threads, stop);

  // Reaction of the basis fields: reaction(m, n) = -jk/(4 pi) integral over the walls of E_m . eta J_n.
  ApertureFields basis(4 * static_cast<Eigen::Index>(aperture.size()), 0);
  WallMatrix electric(2 * static_cast<Eigen::Index>(walls.size()), 0), solution = electric;
  Eigen::MatrixXcd reaction;
  Eigen::VectorXd area(electric.rows());
  for (std::size_t i = 0; i < walls.size(); ++i)
    area.segment(2 * static_cast<Eigen::Index>(i), 2).setConstant(walls[i].area);

  std::vector<std::array<Complex, 4>> result(views.size(), std::array<Complex, 4>{});
  for (const std::vector<std::size_t>& batch : view_batches(views.size(), aperture.size())) {
    if (stop != nullptr && *stop) throw Interrupted();
    std::vector<BistaticGeometry> together;
    for (const std::size_t view : batch) together.push_back(views[view]);
    const ApertureFields sent =
        incident_aperture_fields(aperture, k, together, &BistaticGeometry::transmit, scene_, radius_);
    const bool one_antenna =
        std::all_of(together.begin(), together.end(), [](const BistaticGeometry& a) { return a.monostatic; });
    ApertureFields back, both;
    if (!one_antenna) {
      back = incident_aperture_fields(aperture, k, together, &BistaticGeometry::receive, scene_, radius_);
      both = sent;
      append(both, back);
    }
    const ApertureFields& received = one_antenna ? sent : back;
    if (sent.squaredNorm() == 0 || received.squaredNorm() == 0) continue;
    const FieldBasis fresh = extend_basis(basis, one_antenna ? sent : both);
    if (fresh.fields.cols() > 0) {
      const WallFields fields_on_walls = wall_fields(aperture, walls, k, fresh.fields, threads, stop);
      SEAGLINT_CHECK(fields_on_walls.incident_electric.allFinite() && fields_on_walls.mfie_excitation.allFinite(),
                     "a wall of a cavity meets its aperture");
      append(basis, fresh.fields);
      append(electric, fields_on_walls.incident_electric);
      append(solution, currents.solve(fields_on_walls.mfie_excitation, fresh.strength, threads, stop));
      reaction = Complex(0, -k / (4 * kPi)) *
                 (electric.cast<Complex>().transpose() * area.asDiagonal() * solution.cast<Complex>());
      // Symmetric by reciprocity; the numerical asymmetry is a few percent where walls end at the aperture (README.md).
      reaction = 0.5 * (reaction + reaction.transpose().eval());
    }
    const Eigen::MatrixXcd s = basis.adjoint() * sent, r = basis.adjoint() * received;
    for (std::size_t i = 0; i < together.size(); ++i) {
      const auto at = 2 * static_cast<Eigen::Index>(i);
      const Eigen::Matrix2cd S = r.middleCols(at, 2).transpose() * reaction * s.middleCols(at, 2);
      const Complex phase = std::polar(1.0, k * centre_.dot(together[i].transmit.r + together[i].receive.r));
      result[batch[i]] = {phase * S(0, 0), phase * S(0, 1), phase * S(1, 0), phase * S(1, 1)};
    }
  }
  return result;
}

}  // namespace seaglint
