// SPDX-License-Identifier: BSD-3-Clause
#include "sim/cavity/cavity_scattering.h"

#include <fmt/format.h>

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

double sum_of_squares(const ComplexMatrix& a) {
  double sum = 0;
  for (const Complex& value : a.values()) sum += std::norm(value);
  return sum;
}

struct FieldBasis {
  ApertureFields fields;         // orthonormal
  std::vector<double> strength;  // root of the sum of squares over all directions
};

// Basis vectors that, with those of `basis`, represent every column of `fields`.
FieldBasis extend_basis(const ApertureFields& basis, const ApertureFields& fields) {
  ApertureFields rest = fields;
  for (int pass = 0; pass < 2; ++pass) {
    const ComplexMatrix known = product(basis, adjoint_product(basis, rest));
    std::ranges::transform(rest.values(), known.values(), rest.values().begin(), std::minus());
  }
  const double negligible = kMaxFieldError * kMaxFieldError * sum_of_squares(fields);
  if (basis.columns() > 0 && sum_of_squares(rest) < 100 * negligible) return {ApertureFields(fields.rows(), 0), {}};
  const HermitianModes modes = hermitian_modes(adjoint_product(rest, rest));
  double dropped = 0;
  std::size_t first = 0;
  while (first < rest.columns() && dropped + std::max(modes.values[first], 0.0) <= negligible)
    dropped += std::max(modes.values[first++], 0.0);
  FieldBasis fresh;
  ComplexMatrix weights(rest.columns(), rest.columns() - first);
  for (std::size_t m = first; m < rest.columns(); ++m) {
    fresh.strength.push_back(std::sqrt(modes.values[m]));
    for (std::size_t i = 0; i < weights.rows(); ++i)
      weights(i, m - first) = modes.vectors(i, m) / fresh.strength.back();
  }
  fresh.fields = product(rest, weights);
  return fresh;
}

// Each batch is spread over all views, so that the basis of the first serves the others.
std::vector<std::vector<std::size_t>> view_batches(std::size_t views, std::size_t cells) {
  const std::size_t together = std::clamp<std::size_t>(kViewsTimesCells / cells, 1, kMaxViewsPerBatch);
  std::vector<std::vector<std::size_t>> result((views + together - 1) / together);
  for (std::size_t view = 0; view < views; ++view) result[view % result.size()].push_back(view);
  return result;
}

bool finite(const WallMatrix& a) {
  return std::ranges::all_of(a.values(),
                             [](ComplexFloat x) { return std::isfinite(x.real()) && std::isfinite(x.imag()); });
}

// reaction(m, n) = -jk/(4 pi) integral over the walls of E_m . eta J_n, which is symmetric by reciprocity; the
// numerical asymmetry is a few percent where walls end at the aperture (README.md).
ComplexMatrix reaction_of(const WallMatrix& electric, const WallMatrix& currents, std::span<const WallPatch> walls,
                          double k) {
  const std::size_t count = electric.columns();
  ComplexMatrix reaction(count, count);
  for (std::size_t m = 0; m < count; ++m) {
    for (std::size_t n = 0; n < count; ++n) {
      Complex sum = 0;
      for (std::size_t i = 0; i < electric.rows(); ++i)
        sum += walls[i / 2].area * Complex(electric(i, m)) * Complex(currents(i, n));
      reaction(m, n) = Complex(0, -k / (4 * kPi)) * sum;
    }
  }
  for (std::size_t m = 0; m < count; ++m) {
    for (std::size_t n = 0; n < m; ++n) reaction(m, n) = reaction(n, m) = 0.5 * (reaction(m, n) + reaction(n, m));
  }
  return reaction;
}

// Column i of a transposed, times the matrix, times column j of b.
Complex reaction_between(const ComplexMatrix& a, std::size_t i, const ComplexMatrix& matrix, const ComplexMatrix& b,
                         std::size_t j) {
  Complex sum = 0;
  for (std::size_t n = 0; n < matrix.columns(); ++n) {
    Complex row = 0;
    for (std::size_t m = 0; m < matrix.rows(); ++m) row += a(m, i) * matrix(m, n);
    sum += row * b(n, j);
  }
  return sum;
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

  ApertureFields basis(4 * aperture.size(), 0);
  WallMatrix electric(2 * walls.size(), 0), solution = electric;
  ComplexMatrix reaction;

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
      both.append(back);
    }
    const ApertureFields& received = one_antenna ? sent : back;
    if (sum_of_squares(sent) == 0 || sum_of_squares(received) == 0) continue;
    const FieldBasis fresh = extend_basis(basis, one_antenna ? sent : both);
    if (fresh.fields.columns() > 0) {
      const WallFields fields_on_walls = wall_fields(aperture, walls, k, fresh.fields, threads, stop);
      SEAGLINT_CHECK(finite(fields_on_walls.incident_electric) && finite(fields_on_walls.mfie_excitation),
                     "a wall of a cavity meets its aperture");
      basis.append(fresh.fields);
      electric.append(fields_on_walls.incident_electric);
      solution.append(currents.solve(fields_on_walls.mfie_excitation, fresh.strength, threads, stop));
      reaction = reaction_of(electric, solution, walls, k);
    }
    const ComplexMatrix s = adjoint_product(basis, sent), r = adjoint_product(basis, received);
    for (std::size_t i = 0; i < together.size(); ++i) {
      const Complex phase = std::polar(1.0, k * centre_.dot(together[i].transmit.r + together[i].receive.r));
      for (std::size_t p = 0; p < 4; ++p)
        result[batch[i]][p] = phase * reaction_between(r, 2 * i + p / 2, reaction, s, 2 * i + p % 2);
    }
  }
  return result;
}

}  // namespace seaglint
