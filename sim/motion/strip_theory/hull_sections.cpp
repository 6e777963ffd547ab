// SPDX-License-Identifier: BSD-3-Clause
#include "sim/motion/strip_theory/hull_sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "sim/core/process/error.h"
#include "sim/core/text/text_table.h"

namespace seaglint {

double HullSections::beam() const {
  double largest = 0;
  for (const HullSection& section : sections) largest = std::max(largest, section.breadth);
  return largest;
}

double HullSections::draught() const {
  double largest = 0;
  for (const HullSection& section : sections) largest = std::max(largest, section.draught);
  return largest;
}

namespace {

// Exponents n of 1 - |u|^n, u from -1 to 1, aft and forward of amidships. One half has coefficient C = n/(n + 1) and
// moment int u (1 - u^n) du = C / (2 (2 - C)); the coefficients of the halves are C -+ d.
struct Fullness {
  double aft, forward;  // coefficients of the halves

  // `centre` per length, forward positive.
  static Fullness meeting(double coefficient, double centre, const char* what) {
    const auto moment = [](double c) { return 0.5 * c / (2 - c); };
    // Centroid in u is (moment(forward) - moment(aft)) / (2 coefficient), u = 2 x / L.
    const auto centre_of = [&](double d) {
      return 0.5 * (moment(coefficient + d) - moment(coefficient - d)) / (2 * coefficient);
    };
    const double limit = std::min(coefficient, 1 - coefficient) * 0.999;
    if (!(coefficient > 0 && coefficient < 1) || std::abs(centre) > centre_of(limit)) {
      throw InputError(fmt::format("hull form: {} coefficient {} with its centre at {} of the length: no hull has it",
                                   what, coefficient, centre));
    }
    double low = -limit, high = limit;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (centre_of(middle) < centre ? low : high) = middle;
    }
    return {coefficient - low, coefficient + low};
  }

  double at(double u) const {
    const double c = u < 0 ? aft : forward;
    return 1 - std::pow(std::abs(u), c / (1 - c));
  }
};

double strip_x(double length, int i, int count) { return length * ((i + 0.5) / count - 0.5); }

}  // namespace

HullSections sections_of_form(double length, double beam, double draught, const HullCoefficients& form, int count) {
  const Fullness breadth = Fullness::meeting(form.waterplane_coefficient, form.lcf, "waterplane");
  const Fullness area = Fullness::meeting(form.block_coefficient / form.midship_coefficient, form.lcb, "prismatic");
  HullSections hull{length, {}};
  for (int i = 0; i < count; ++i) {
    const double x = strip_x(length, i, count);
    const double u = 2 * x / length;
    hull.sections.push_back({x, beam * breadth.at(u), draught, form.midship_coefficient * beam * draught * area.at(u)});
  }
  return hull;
}

namespace {

// Intersection of the mesh with a plane x = const: segments from (y, z) to (y, z).
std::vector<std::array<Vec2, 2>> cut_across(const TriangleMesh& mesh, double x) {
  std::vector<std::array<Vec2, 2>> lines;
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec2, 3> ends;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = mesh.vertices[triangle[i]];
      const Vec3& b = mesh.vertices[triangle[(i + 1) % 3]];
      if ((a.x() < x) == (b.x() < x)) continue;
      const Vec3 p = a + (x - a.x()) / (b.x() - a.x()) * (b - a);
      ends[count++] = {p.y(), p.z()};
    }
    if (count == 2) lines.push_back({ends[0], ends[1]});
  }
  return lines;
}

// Distance between the outermost walls at depth z; 0 for fewer than two.
double breadth_at(const std::vector<std::array<Vec2, 2>>& lines, double z) {
  double low = 0, high = 0;
  int walls = 0;
  for (const auto& [a, b] : lines) {
    if ((a.y() < z) == (b.y() < z)) continue;
    const double y = a.x() + (z - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    low = walls == 0 ? y : std::min(low, y);
    high = walls == 0 ? y : std::max(high, y);
    ++walls;
  }
  return walls < 2 ? 0 : high - low;
}

HullSection section_at(const TriangleMesh& mesh, double x) {
  constexpr int kLevels = 64;
  const std::vector<std::array<Vec2, 2>> lines = cut_across(mesh, x);
  HullSection section{x, 0, 0, 0};
  double keel = 0;
  for (const auto& [a, b] : lines) keel = std::min({keel, a.y(), b.y()});
  section.draught = -keel;
  if (!(section.draught > 0)) return section;
  // Evaluated just below the waterline, so that a lid at z = 0 does not count as a wall.
  section.breadth = breadth_at(lines, 1e-6 * keel);
  for (int i = 0; i < kLevels; ++i) section.area += breadth_at(lines, keel * (i + 0.5) / kLevels) * -keel / kLevels;
  return section;
}

}  // namespace

HullSections sections_of_mesh(const TriangleMesh& mesh, int count) {
  constexpr double kMinDraught = 0.02;  // per breadth: a mesh cut at the waterline reaches below it by rounding only
  double aft = 0, forward = 0;
  const Bounds box = bounds(mesh);
  if (box.lower.z() > -kMinDraught * (box.upper.y() - box.lower.y())) return {};
  // Ends of the waterline: triangles that cross z = 0.
  bool crosses = false;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = mesh.vertices[triangle[i]];
      const Vec3& b = mesh.vertices[triangle[(i + 1) % 3]];
      if ((a.z() < 0) == (b.z() < 0)) continue;
      const double x = a.x() + a.z() / (a.z() - b.z()) * (b.x() - a.x());
      aft = crosses ? std::min(aft, x) : x;
      forward = crosses ? std::max(forward, x) : x;
      crosses = true;
    }
  }
  if (!crosses || !(forward > aft)) return {};
  HullSections hull{forward - aft, {}};
  for (int i = 0; i < count; ++i) {
    hull.sections.push_back(section_at(mesh, 0.5 * (aft + forward) + strip_x(hull.length, i, count)));
  }
  return hull;
}

HullSections read_sections(const std::filesystem::path& file, int count) {
  constexpr double kLargest = 1e5;
  const TextTable table(TextSource::read(file), {"x_m", "breadth_m", "draught_m", "area_m2"});
  table.check_ascending(0);
  std::vector<HullSection> given;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const HullSection section{table.number(row, 0), table.number(row, 1, 0, kLargest),
                              table.number(row, 2, 0, kLargest), table.number(row, 3, 0, kLargest)};
    const double box = section.breadth * section.draught;
    if (section.area > box) table.fail(row, 3, fmt::format("must be at most breadth times draught, {:.6g}", box));
    given.push_back(section);
  }
  HullSections hull{given.back().x - given.front().x, {}};
  const double middle = 0.5 * (given.back().x + given.front().x);
  std::size_t row = 0;
  for (int i = 0; i < count; ++i) {
    const double x = middle + strip_x(hull.length, i, count);
    while (row + 2 < given.size() && given[row + 1].x < x) ++row;
    const double u = (x - given[row].x) / (given[row + 1].x - given[row].x);
    const auto between = [&](double HullSection::*value) {
      return (1 - u) * (given[row].*value) + u * (given[row + 1].*value);
    };
    hull.sections.push_back(
        {x, between(&HullSection::breadth), between(&HullSection::draught), between(&HullSection::area)});
  }
  return hull;
}

HullSections scaled_to(HullSections hull, double length, double beam, double draught) {
  const auto factor = [](double prescribed, double actual) { return prescribed > 0 ? prescribed / actual : 1.0; };
  const double along = factor(length, hull.length);
  const double across = factor(beam, hull.beam());
  const double down = factor(draught, hull.draught());
  hull.length *= along;
  for (HullSection& section : hull.sections) {
    section.x *= along;
    section.breadth *= across;
    section.draught *= down;
    section.area *= across * down;
  }
  return hull;
}

}  // namespace seaglint
