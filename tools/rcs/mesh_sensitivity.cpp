// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/mesh_sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/geometry/mesh/mesh_changes.h"
#include "sim/scattering/solver/solve.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {
namespace {

constexpr double kNoiseOfAWavelength = 1.0 / 1900, kShiftOfTheRadius = 50;

// A mesh and the motion by which it differs from the request's.
struct ChangedMesh {
  TriangleMesh mesh;
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
};

ChangedMesh changed(const TriangleMesh& mesh, MeshChange change, const MeshSensitivity& by) {
  Random random({1, Stream::kMeshChange, 0});
  switch (change) {
    case MeshChange::kCut: return {cut_in_four(mesh)};
    case MeshChange::kCutFloat: return {cut_in_four(mesh, true)};
    case MeshChange::kRenumbered: return {renumbered(mesh, random)};
    case MeshChange::kTurned: {
      const Mat3 turn = axis_rotation(1.1, Vec3(1, -2, 0.5).normalized());
      return {transformed(mesh, turn, Vec3::Zero()), turn};
    }
    case MeshChange::kMoved: {
      const Vec3 shift = by.shift_m * Vec3(0.9, 0.4, -0.17).normalized();
      return {transformed(mesh, Mat3::Identity(), shift), Mat3::Identity(), shift};
    }
    case MeshChange::kNoise: return {with_noise(mesh, by.noise_m, random)};
    case MeshChange::kFlatFacets: break;
  }
  return {mesh};
}

// The request's views, computed on one mesh after another.
class Views {
 public:
  Views(const RcsRequest& request, const PreparedTarget& target, int threads, const StopFlag* stop)
      : request_(request),
        target_(target),
        threads_(threads),
        stop_(stop),
        progress_("sensitivity", (kMeshChanges + 1) * count(), "views") {
    for (const double hz : request.frequency_hz) wavenumbers_.push_back(2 * kPi * hz / kSpeedOfLight);
  }

  // Matrices per view, elevation slowest, in the axes and about the origin of the request's mesh.
  std::vector<Matrices> matrices(const ChangedMesh& of, std::optional<double> crease_deg) {
    const std::optional<double> crease = crease_deg ? std::optional(radians(*crease_deg)) : std::nullopt;
    const Scatterer scatterer(of.mesh, target_.materials, crease, 1e-3 * request_.sheet_thickness_mm,
                              merging_tolerance(*std::ranges::max_element(request_.frequency_hz)));
    const TracingSettings settings = settings_of(request_, request_.edges);
    std::vector<Matrices> all(count());
    const int side_by_side = static_cast<int>(std::min(all.size(), static_cast<std::size_t>(threads_)));
    parallel_for(
        all.size(), side_by_side,
        [&](std::size_t view) {
          RadarBasis basis = basis_at(azimuth_of(view), elevation_of(view));
          for (Vec3* axis : {&basis.r, &basis.h, &basis.v}) *axis = of.turn * *axis;
          all[view] = solve({.scatterer = scatterer,
                             .views = {monostatic(basis)},
                             .wavenumbers = wavenumbers_,
                             .settings = settings,
                             .threads = std::max(1, threads_ / side_by_side),
                             .stop = stop_})
                          .views[0]
                          .matrices;
          for (std::size_t q = 0; q < wavenumbers_.size(); ++q) {
            for (Complex& s : all[view][q]) s *= std::polar(1.0, -2 * wavenumbers_[q] * basis.r.dot(of.shift));
          }
          progress_.advance();
        },
        stop_);
    return all;
  }

  std::size_t count() const { return request_.azimuth_deg.size() * request_.elevation_deg.size(); }
  double azimuth_of(std::size_t view) const { return request_.azimuth_deg[view % request_.azimuth_deg.size()]; }
  double elevation_of(std::size_t view) const { return request_.elevation_deg[view / request_.azimuth_deg.size()]; }

 private:
  const RcsRequest& request_;
  const PreparedTarget& target_;
  int threads_;
  const StopFlag* stop_;
  Progress progress_;
  std::vector<double> wavenumbers_;
};

double relative_change(const Matrices& from, const Matrices& to) {
  double change = 0, power = 0;
  for (std::size_t q = 0; q < from.size(); ++q) {
    for (const std::size_t channel : {0u, 3u}) {
      change += std::norm(to[q][channel] - from[q][channel]);
      power += std::norm(from[q][channel]);
    }
  }
  return power > 0 ? std::sqrt(change / power) : 0;
}

double mean_dbsm(const Matrices& matrices, std::size_t channel) {
  double power = 0;
  for (const auto& matrix : matrices) power += std::norm(matrix[channel]);
  return dbsm_of_area(4 * kPi * power / static_cast<double>(matrices.size()));
}

}  // namespace

MeshSensitivity mesh_sensitivity(const RcsRequest& request, double noise_m, int threads, const StopFlag* stop) {
  const PreparedTarget target = prepare_mesh(request);
  const double highest_hz = *std::ranges::max_element(request.frequency_hz);
  MeshSensitivity result;
  result.warnings = target.warnings;
  result.noise_m = noise_m > 0 ? noise_m : kNoiseOfAWavelength * kSpeedOfLight / highest_hz;
  result.shift_m = kShiftOfTheRadius * target.scatterer->radius();
  Views views(request, target, thread_count(threads), stop);
  try {
    const std::vector<Matrices> own = views.matrices({target.mesh}, request.crease_deg);
    for (std::size_t view = 0; view < views.count(); ++view) {
      result.views.push_back(
          {views.azimuth_of(view), views.elevation_of(view), mean_dbsm(own[view], 0), mean_dbsm(own[view], 3), {}});
    }
    for (std::size_t i = 0; i < kMeshChanges; ++i) {
      const auto change = static_cast<MeshChange>(i);
      const std::vector<Matrices> other =
          views.matrices(changed(target.mesh, change, result),
                         change == MeshChange::kFlatFacets ? std::optional(0.0) : request.crease_deg);
      for (std::size_t view = 0; view < views.count(); ++view)
        result.views[view].change[i] = relative_change(own[view], other[view]);
    }
  } catch (const Interrupted&) {
    throw WorkError("interrupted");
  }
  return result;
}

std::string sensitivity_table(const MeshSensitivity& sensitivity) {
  std::string text = fmt::format(
      "# Relative change of the complex echo, hh and vv, over all frequencies\n"
      "# cut: every triangle in four at its midpoints; cut_float32: the midpoints rounded to float32\n"
      "# renumbered: other order of vertices and triangles; turned: with the radar; moved: by {:.4g} m\n"
      "# noise: on every vertex, standard deviation {:.3g} um; flat: all facets flat (--crease-deg 0)\n"
      "{:>11} {:>13} {:>8} {:>8}",
      sensitivity.shift_m, 1e6 * sensitivity.noise_m, "azimuth_deg", "elevation_deg", "hh_dbsm", "vv_dbsm");
  for (const char* name : kMeshChangeNames) text += fmt::format(" {:>11}", name);
  for (const ViewSensitivity& view : sensitivity.views) {
    text += fmt::format("\n{:>11g} {:>13g} {:>8.2f} {:>8.2f}", view.azimuth_deg, view.elevation_deg, view.hh_dbsm,
                        view.vv_dbsm);
    for (const double change : view.change) text += fmt::format(" {:>11.4f}", change);
  }
  return text + "\n";
}

}  // namespace seaglint
