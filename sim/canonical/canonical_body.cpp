// SPDX-License-Identifier: BSD-3-Clause
#include "sim/canonical/canonical_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"
#include "sim/geometry/mesh/topology.h"

namespace seaglint {
namespace {

constexpr double kRightAngle = 2e-3;  // largest cosine between faces that are normal to each other
constexpr double kSameLength = 2e-3;  // relative difference of equal sides
constexpr double kCovered = 4e-3;     // relative difference of the facets' area and that of their face

bool same(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * std::max(a, b); }

// Coplanar facets.
struct PlaneFace {
  Vec3 normal;
  double offset = 0;  // normal . x
  double area = 0;
  Vec3 centroid = Vec3::Zero();
  std::vector<Vec3> corners;  // of its facets
};

// The planes of all facets; empty if there are more than three.
std::vector<PlaneFace> plane_faces(const TriangleMesh& mesh, double size) {
  constexpr double kFlat = 1e-3;  // of the size, and of the normals
  std::vector<PlaneFace> faces;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(mesh, t);
    if (area.norm() <= 1e-12 * size * size) continue;
    const Vec3 normal = area.normalized();
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = mesh.vertices[mesh.triangles[t][i]];
    const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3;
    const auto face = std::ranges::find_if(faces, [&](const PlaneFace& f) {
      return f.normal.cross(normal).norm() < kFlat && std::abs(f.normal.dot(centroid) - f.offset) < kFlat * size;
    });
    if (face == faces.end()) {
      if (faces.size() == 3) return {};
      faces.push_back({normal, normal.dot(centroid), area.norm(), area.norm() * centroid, {}});
      faces.back().corners.assign(corners.begin(), corners.end());
      continue;
    }
    face->area += area.norm();
    face->centroid += area.norm() * centroid;
    face->corners.insert(face->corners.end(), corners.begin(), corners.end());
  }
  for (PlaneFace& face : faces) face.centroid /= face.area;
  return faces;
}

std::optional<CanonicalBody> plate(const PlaneFace& face) {
  // The diagonals of a rectangle are equal: its corners are the points farthest from its centre.
  Vec3 first = Vec3::Zero();
  for (const Vec3& p : face.corners) {
    if ((p - face.centroid).norm() > first.norm()) first = p - face.centroid;
  }
  Vec3 second = Vec3::Zero();
  double widest = 0;
  for (const Vec3& p : face.corners) {
    const Vec3 corner = p - face.centroid;
    const double width = first.cross(corner).norm();
    if (!same(corner.norm(), first.norm(), kSameLength) || width <= widest) continue;
    widest = width;
    second = corner;
  }
  if (widest == 0) return std::nullopt;
  Vec3 along_a = first - second, along_b = first + second;
  if (along_b.norm() > along_a.norm()) std::swap(along_a, along_b);
  CanonicalBody body{CanonicalShape::kPlate, face.centroid, along_a.norm(), along_b.norm(), Mat3::Identity()};
  if (!same(face.area, body.a_m * body.b_m, kCovered)) return std::nullopt;
  along_a.normalize();
  along_b.normalize();
  for (const Vec3& p : face.corners) {
    const Vec3 corner = p - face.centroid;
    if (std::abs(corner.dot(along_a)) > 0.5 * body.a_m * (1 + kSameLength) ||
        std::abs(corner.dot(along_b)) > 0.5 * body.b_m * (1 + kSameLength))
      return std::nullopt;
  }
  body.axes.col(0) = along_a;
  body.axes.col(1) = along_b;
  body.axes.col(2) = along_a.cross(along_b).normalized();
  return body;
}

// Smallest and largest coordinate of the corners along a direction.
struct Extent {
  double lowest = 1e300, highest = -1e300;
};

Extent extent_along(const PlaneFace& face, const Vec3& origin, const Vec3& direction) {
  Extent extent;
  for (const Vec3& p : face.corners) {
    const double x = (p - origin).dot(direction);
    extent.lowest = std::min(extent.lowest, x);
    extent.highest = std::max(extent.highest, x);
  }
  return extent;
}

std::optional<CanonicalBody> dihedral(const PlaneFace& first, const PlaneFace& second) {
  if (std::abs(first.normal.dot(second.normal)) > kRightAngle) return std::nullopt;
  const Vec3 seam = first.normal.cross(second.normal).normalized();
  const Vec3 on_seam = first.offset * first.normal + second.offset * second.normal;
  std::array<Extent, 2> along, depth;
  std::array<Vec3, 2> into;
  for (std::size_t i = 0; i < 2; ++i) {
    const PlaneFace& face = i == 0 ? first : second;
    into[i] = face.normal.cross(seam).normalized();
    if (into[i].dot(face.centroid - on_seam) < 0) into[i] = -into[i];
    along[i] = extent_along(face, on_seam, seam);
    depth[i] = extent_along(face, on_seam, into[i]);
    const double length = along[i].highest - along[i].lowest;
    if (std::abs(depth[i].lowest) > kSameLength * depth[i].highest ||
        !same(face.area, length * depth[i].highest, kCovered))
      return std::nullopt;
  }
  const double length = along[0].highest - along[0].lowest;
  if (!same(depth[0].highest, depth[1].highest, kSameLength) ||
      std::abs(along[0].lowest - along[1].lowest) > kSameLength * length ||
      std::abs(along[0].highest - along[1].highest) > kSameLength * length)
    return std::nullopt;
  CanonicalBody body{CanonicalShape::kDihedral, on_seam + 0.5 * (along[0].lowest + along[0].highest) * seam,
                     depth[0].highest, length, Mat3::Identity()};
  body.axes.col(0) = into[0];
  body.axes.col(1) = into[1];
  body.axes.col(2) = seam;
  return body;
}

std::optional<CanonicalBody> trihedral(const std::vector<PlaneFace>& faces) {
  const std::array<Vec3, 3> normal{faces[0].normal, faces[1].normal, faces[2].normal};
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(normal[i].dot(normal[(i + 1) % 3])) > kRightAngle) return std::nullopt;
  }
  const Vec3 apex = Mat3(Mat3(normal[0], normal[1], normal[2]).transpose()).inverse() *
                    Vec3(faces[0].offset, faces[1].offset, faces[2].offset);
  const Vec3 middle = (faces[0].centroid + faces[1].centroid + faces[2].centroid) / 3;
  CanonicalBody body{CanonicalShape::kTriangularTrihedral, apex, 0, 0, Mat3::Identity()};
  for (int i = 0; i < 3; ++i) {
    const Vec3 leg = normal[(i + 1) % 3].cross(normal[(i + 2) % 3]).normalized();
    body.axes.col(i) = leg.dot(middle - apex) < 0 ? Vec3(-leg) : leg;
  }
  std::array<bool, 3> triangular{};
  for (int i = 0; i < 3; ++i) {
    const PlaneFace& face = faces[static_cast<std::size_t>(i)];
    const Vec3 u = body.axes.col((i + 1) % 3), v = body.axes.col((i + 2) % 3);
    const Extent along_u = extent_along(face, apex, u), along_v = extent_along(face, apex, v);
    const double leg = along_u.highest;
    if (body.a_m == 0) body.a_m = leg;
    if (!same(leg, body.a_m, kSameLength) || !same(along_v.highest, body.a_m, kSameLength) ||
        std::max(std::abs(along_u.lowest), std::abs(along_v.lowest)) > kSameLength * leg)
      return std::nullopt;
    triangular[static_cast<std::size_t>(i)] = same(face.area, 0.5 * leg * leg, kCovered);
    const double sum = extent_along(face, apex, u + v).highest;  // leg on the hypotenuse of a triangle
    const bool fits =
        triangular[static_cast<std::size_t>(i)] ? same(sum, leg, kSameLength) : same(face.area, leg * leg, kCovered);
    if (!fits) return std::nullopt;
  }
  if (triangular[0] != triangular[1] || triangular[0] != triangular[2]) return std::nullopt;
  if (!triangular[0]) body.shape = CanonicalShape::kSquareTrihedral;
  return body;
}

std::optional<CanonicalBody> sphere(const TriangleMesh& mesh) {
  constexpr std::size_t kLeastFacets = 100;
  constexpr double kRound = 2e-3, kLeastArea = 0.97, kLeastVolume = 0.94;
  if (mesh.triangles.size() < kLeastFacets) return std::nullopt;
  std::vector<Vec3> points;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) points.push_back(mesh.vertices[vertex]);
  }
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  // Least squares of |p|^2 = 2 c . p + const about the mean.
  Mat3 matrix = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Vec3& p : points) {
    const Vec3 x = p - mean;
    matrix += outer_product(x, x);
    right += 0.5 * x.squaredNorm() * x;
  }
  if (std::abs(matrix.determinant()) < 1e-9 * std::pow(matrix.trace(), 3)) return std::nullopt;
  const Vec3 centre = mean + matrix.inverse() * right;
  double lowest = 1e300, highest = 0;
  for (const Vec3& p : points) {
    lowest = std::min(lowest, (p - centre).norm());
    highest = std::max(highest, (p - centre).norm());
  }
  const double radius = 0.5 * (lowest + highest);
  if (highest - lowest > 2 * kRound * radius) return std::nullopt;
  const double area = 4 * kPi * radius * radius;
  const double volume = std::abs(enclosed_volume(transformed(mesh, Mat3::Identity(), -centre)));
  if (surface_area(mesh) < kLeastArea * area || surface_area(mesh) > (1 + kCovered) * area ||
      volume < kLeastVolume * area * radius / 3)
    return std::nullopt;
  return CanonicalBody{CanonicalShape::kSphere, centre, radius, 0, Mat3::Identity()};
}

// The connected components, joined where vertices coincide.
std::vector<TriangleMesh> components_of(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = first_at_position(mesh.vertices);
  DisjointSets sets(mesh.vertices.size());
  for (const auto& triangle : mesh.triangles) {
    sets.unite(first[triangle[0]], first[triangle[1]]);
    sets.unite(first[triangle[0]], first[triangle[2]]);
  }
  std::map<std::uint32_t, TriangleMesh> components;  // by the representative vertex, in its order
  for (const auto& triangle : mesh.triangles) {
    TriangleMesh& component = components[sets.find(first[triangle[0]])];
    const auto next = static_cast<std::uint32_t>(component.vertices.size());
    for (const std::uint32_t vertex : triangle) component.vertices.push_back(mesh.vertices[vertex]);
    component.triangles.push_back({next, next + 1, next + 2});
  }
  std::vector<TriangleMesh> meshes;
  for (auto& [vertex, component] : components) meshes.push_back(std::move(component));
  return meshes;
}

}  // namespace

std::string text_of(const CanonicalBody& body) {
  switch (body.shape) {
    case CanonicalShape::kSphere: return fmt::format("sphere of radius {:.4g} m", body.a_m);
    case CanonicalShape::kPlate: return fmt::format("plate of {:.4g} x {:.4g} m", body.a_m, body.b_m);
    case CanonicalShape::kDihedral: return fmt::format("dihedral of faces {:.4g} x {:.4g} m", body.a_m, body.b_m);
    case CanonicalShape::kTriangularTrihedral: return fmt::format("triangular trihedral of legs {:.4g} m", body.a_m);
    case CanonicalShape::kSquareTrihedral: return fmt::format("square trihedral of legs {:.4g} m", body.a_m);
  }
  return "";
}

std::optional<CanonicalBody> canonical_body(const TriangleMesh& mesh) {
  const Bounds box = bounds(mesh);
  const std::vector<PlaneFace> faces = plane_faces(mesh, (box.upper - box.lower).norm());
  if (faces.size() == 1) return plate(faces[0]);
  if (faces.size() == 2) return dihedral(faces[0], faces[1]);
  if (faces.size() == 3) return trihedral(faces);
  return sphere(mesh);
}

std::vector<CanonicalBody> canonical_bodies(const TriangleMesh& mesh) {
  constexpr std::size_t kMost = 100;
  if (const std::optional<CanonicalBody> body = canonical_body(mesh)) return {*body};
  const std::vector<TriangleMesh> components = components_of(mesh);
  if (components.size() > kMost) return {};
  std::vector<CanonicalBody> bodies;
  for (const TriangleMesh& component : components) {
    const std::optional<CanonicalBody> body = sphere(component);
    if (!body) return {};
    bodies.push_back(*body);
  }
  return bodies;
}

namespace {

double cosine_of_deg(double angle) { return std::cos(radians(angle)); }

// Dyad of a polarisation-dependent scatterer in the basis of one antenna: p . D . q.
std::array<Complex, 4> in_basis(const Mat3& dyad, const RadarBasis& basis) {
  return {basis.h.dot(dyad * basis.h), basis.h.dot(dyad * basis.v), basis.v.dot(dyad * basis.h),
          basis.v.dot(dyad * basis.v)};
}

// Effective aperture of a triangular trihedral of unit legs for ascending direction cosines l <= m <= n.
double triangular_aperture(double l, double m, double n) {
  const double sum = l + m + n;
  return l + m <= n ? 4 * l * m / sum : sum - 2 / sum;
}

}  // namespace

MieSeries::MieSeries(double ka) {
  SEAGLINT_CHECK(ka > 0, "a sphere has a size");
  // Beyond order ka the coefficients fall as those of an Airy function of (n - ka) / cbrt(ka): below rounding here.
  constexpr double kLargest = 1e200;  // of xi, whose coefficients are then 0
  const auto count = static_cast<std::size_t>(ka + 8 * std::cbrt(ka) + 12);
  // Riccati-Bessel functions psi_n, chi_n by upward recurrence. Where psi_n < chi_n its error is rounding of chi_n, to
  // which the coefficients relate it.
  double psi_before = std::cos(ka), psi = std::sin(ka), chi_before = -std::sin(ka), chi = std::cos(ka);
  for (std::size_t n = 1; n <= count; ++n) {
    const double order = static_cast<double>(n), factor = (2 * order - 1) / ka;
    const double psi_n = factor * psi - psi_before, chi_n = factor * chi - chi_before;
    // psi_n' = psi_{n-1} - n psi_n / x, xi = psi - i chi. Infinite refractive index of eqs. (4.56), (4.57).
    const Complex xi(psi_n, -chi_n), xi_before(psi, -chi);
    if (std::abs(chi_n) > kLargest) break;
    a_.push_back((psi - order * psi_n / ka) / (xi_before - order * xi / ka));
    b_.push_back(psi_n / xi);
    psi_before = psi;
    psi = psi_n;
    chi_before = chi;
    chi = chi_n;
  }
}

std::pair<Complex, Complex> MieSeries::amplitudes(double cosine) const {
  Complex normal = 0, parallel = 0;
  double pi_before = 0, pi = 1;  // angle functions of order n - 1, n; eq. (4.47)
  for (std::size_t i = 0; i < a_.size(); ++i) {
    const double n = static_cast<double>(i) + 1;
    const double tau = n * cosine * pi - (n + 1) * pi_before, factor = (2 * n + 1) / (n * (n + 1));
    normal += factor * (a_[i] * pi + b_[i] * tau);
    parallel += factor * (a_[i] * tau + b_[i] * pi);
    const double next = ((2 * n + 1) * cosine * pi - (n + 1) * pi_before) / n;
    pi_before = pi;
    pi = next;
  }
  return {normal, parallel};
}

CanonicalSolution::CanonicalSolution(const CanonicalBody& body, double frequency_hz)
    : body_(body), wavenumber_(2 * kPi * frequency_hz / kSpeedOfLight) {
  if (body.shape == CanonicalShape::kSphere) mie_.emplace(wavenumber_ * body.a_m);
}

std::optional<CanonicalEcho> CanonicalSolution::at(const BistaticGeometry& geometry) const {
  if (mie_) return of_sphere(geometry);
  if (!geometry.monostatic) return std::nullopt;
  return of_reflector(geometry.receive);
}

// E_parallel,s = e^{ikr} / (-ikr) S_2 E_parallel,i and likewise S_1 (eq. 3.12), with e_parallel x e_normal = d: in the
// conjugate time factor the amplitude in metres is -j conj(S) / k.
CanonicalEcho CanonicalSolution::of_sphere(const BistaticGeometry& geometry) const {
  const Vec3 incident = -geometry.transmit.r, scattered = geometry.receive.r;
  const double cosine = std::clamp(incident.dot(scattered), -1.0, 1.0);
  const auto [normal, parallel] = mie_->amplitudes(cosine);
  constexpr double kInLine = 1e-9;  // sine of an angle whose plane is any
  const Vec3 across = scattered.cross(incident);
  const Vec3 e_normal = across.norm() > kInLine ? Vec3(across.normalized()) : geometry.transmit.h;
  const Vec3 e_in = incident.cross(e_normal), e_out = scattered.cross(e_normal);
  const Complex turn =
      std::polar(1 / wavenumber_, wavenumber_ * body_.centre_m.dot(geometry.transmit.r + geometry.receive.r));
  const Complex s_normal = Complex(0, -1) * std::conj(normal) * turn,
                s_parallel = Complex(0, -1) * std::conj(parallel) * turn;
  const auto element = [&](const Vec3& received, const Vec3& transmitted) {
    return s_normal * received.dot(e_normal) * transmitted.dot(e_normal) +
           s_parallel * received.dot(e_out) * transmitted.dot(e_in);
  };
  const RadarBasis &t = geometry.transmit, &r = geometry.receive;
  return {{element(r.h, t.h), element(r.h, t.v), element(r.v, t.h), element(r.v, t.v)}, 0};
}

std::optional<CanonicalEcho> CanonicalSolution::of_reflector(const RadarBasis& basis) const {
  constexpr double kLeastSide = 20, kEdges = 3;  // k a, and times 1 / (k a)
  const double side = wavenumber_ * (body_.b_m > 0 ? std::min(body_.a_m, body_.b_m) : body_.a_m);
  if (side < kLeastSide) return std::nullopt;
  const Vec3 r = body_.axes.transpose() * basis.r;  // along the axes
  double aperture = 0;
  Complex factor(0, 1);
  Mat3 dyad = Mat3::Identity();
  if (body_.shape == CanonicalShape::kPlate) {
    constexpr double kMainLobe = 0.708;  // 3 dB
    const double pattern = half_argument_sinc(2 * wavenumber_ * body_.a_m * r.x()) *
                           half_argument_sinc(2 * wavenumber_ * body_.b_m * r.y());
    if (std::abs(r.z()) < 0.5 || pattern < kMainLobe) return std::nullopt;
    aperture = body_.a_m * body_.b_m * std::abs(r.z()) * pattern;
    factor = -factor;
  } else if (body_.shape == CanonicalShape::kDihedral) {
    constexpr double kOffBisector_deg = 0.5, kAlongSeam = 0.966;
    const double off = std::abs(std::atan2(r.y(), r.x()) - kPi / 4);
    const double pattern = half_argument_sinc(2 * wavenumber_ * body_.b_m * r.z());
    if (off > radians(kOffBisector_deg) || std::abs(r.z()) > 0.5 || pattern < kAlongSeam) return std::nullopt;
    aperture = 2 * body_.a_m * body_.b_m * std::sin(kPi / 4 - off) * pattern;
    const Vec3 seam = body_.axes.col(2);
    dyad = outer_product(2 * seam, seam) - Mat3::Identity();
  } else {
    const bool triangular = body_.shape == CanonicalShape::kTriangularTrihedral;
    if (r.sum() / std::sqrt(3.0) < cosine_of_deg(triangular ? 5 : 1)) return std::nullopt;
    std::array<double, 3> cosines{r.x(), r.y(), r.z()};
    std::ranges::sort(cosines);
    aperture =
        body_.a_m * body_.a_m * (triangular ? triangular_aperture(cosines[0], cosines[1], cosines[2]) : std::sqrt(3.0));
  }
  CanonicalEcho echo{in_basis(dyad, basis), kEdges / side};
  const Complex amplitude =
      factor * std::polar(aperture * wavenumber_ / (2 * kPi), 2 * wavenumber_ * body_.centre_m.dot(basis.r));
  for (Complex& element : echo.matrix_m) element *= amplitude;
  return echo;
}

}  // namespace seaglint
