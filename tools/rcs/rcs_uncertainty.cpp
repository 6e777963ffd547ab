// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_uncertainty.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/random.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/solver/solve.h"
#include "sim/scattering/tracing/tracing_settings.h"
#include "tools/figure/figure.h"
#include "tools/rcs/rcs_target.h"
#include "tools/rcs/rcs_views.h"

namespace seaglint {

namespace {

constexpr double kLargeDifference_db = 1;
constexpr double kLargeShare = 0.25;  // of the echo: 2 dB
constexpr double kNegligible_db = 30;
constexpr double kLargestPrinted_db = 60, kLargestPrintedShare = 1000;

Complex echo(const RcsSweep& sweep, std::size_t view, std::size_t element) {
  return sweep.models.back().matrices[view][sweep.estimated][kCoPolar[element]];
}

double ratio_db(const Complex& flat, const Complex& smooth) {
  if (flat == smooth) return 0;
  const double ratio = std::abs(flat) / std::max(std::abs(smooth), 1e-300);
  return std::clamp(20 * std::log10(std::max(ratio, 1e-300)), -kLargestPrinted_db, kLargestPrinted_db);
}

double share(double part, const Complex& whole) {
  return part > 0 && std::abs(whole) > 0 ? std::min(part / std::abs(whole), kLargestPrintedShare) : 0;
}

// The views in which the magnitude of a quantity exceeds a limit in hh or vv, and the place of its largest magnitude.
struct Exceeded {
  std::size_t views = 0, worst_view = 0, worst_element = 0;
  double worst = 0;
};

Exceeded exceeding(const RcsSweep& sweep, double limit, const std::function<double(std::size_t, std::size_t)>& value) {
  std::array<double, 2> floor{};
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    for (const std::size_t e : {0u, 1u})
      floor[e] = std::max(floor[e], std::abs(echo(sweep, view, e)) * std::pow(10.0, -kNegligible_db / 20));
  }
  Exceeded found;
  for (std::size_t view = 0; view < sweep.views(); ++view) {
    bool exceeds = false;
    for (const std::size_t e : {0u, 1u}) {
      const double size = std::abs(echo(sweep, view, e));
      if (size == 0 || size < floor[e]) continue;
      const double of_view = value(view, e);
      exceeds = exceeds || std::abs(of_view) > limit;
      if (std::abs(of_view) > std::abs(found.worst)) found = {found.views, view, e, of_view};
    }
    if (exceeds) ++found.views;
  }
  return found;
}

std::string place_of(const RcsSweep& sweep, const Exceeded& found) {
  return fmt::format("azimuth {:.6g}, elevation {:.6g} deg, {}", sweep.azimuth_of(found.worst_view),
                     sweep.elevation_of(found.worst_view), kCoPolarNames[found.worst_element]);
}

std::string count_of(const RcsSweep& sweep, const Exceeded& found) {
  return fmt::format("{} of {} view{}", found.views, sweep.views(), sweep.views() == 1 ? "" : "s");
}

}  // namespace

double flat_over_smooth_db(const RcsSweep& sweep, std::size_t view, std::size_t element) {
  const Complex smooth = echo(sweep, view, element);
  return ratio_db(smooth + Complex(sweep.uncertainty[view].flat_less_smooth[element]), smooth);
}

double vertex_change(const RcsSweep& sweep, std::size_t view, std::size_t element) {
  return share(sweep.uncertainty[view].displaced[element], echo(sweep, view, element));
}

void EchoChange::add(const Complex& reference_m, const Complex& other_m) {
  reference_m2 += std::norm(reference_m);
  other_m2 += std::norm(other_m);
  difference_m2 += std::norm(other_m - reference_m);
}

double EchoChange::relative() const { return reference_m2 > 0 ? std::sqrt(difference_m2 / reference_m2) : 0; }

double EchoChange::relative_db() const {
  if (difference_m2 == 0) return -kMostRelativeDb;
  if (reference_m2 == 0) return kMostRelativeDb;
  return std::clamp(10 * std::log10(difference_m2 / reference_m2), -kMostRelativeDb, kMostRelativeDb);
}

std::vector<std::string> uncertainty_warnings(const RcsSweep& sweep, std::span<const std::string> part_names) {
  std::vector<std::string> found;
  if (sweep.uncertainty.empty()) return found;
  const double ghz = 1e-9 * sweep.frequency_hz[sweep.estimated];
  const Exceeded flat = exceeding(sweep, kLargeDifference_db,
                                  [&](std::size_t view, std::size_t e) { return flat_over_smooth_db(sweep, view, e); });
  if (flat.views > 0) {
    found.push_back(fmt::format(
        "part '{}': with flat facets in place of smooth surfaces {} would differ by more than {:g} dB at {:.6g} GHz, "
        "most by {:+.1f} dB at {}{}",
        part_names[sweep.uncertainty[flat.worst_view].flat_part], count_of(sweep, flat), kLargeDifference_db, ghz,
        flat.worst, place_of(sweep, flat), sweep.flat ? "" : "; --uncertainty computes both"));
  }
  const Exceeded moved =
      exceeding(sweep, kLargeShare, [&](std::size_t view, std::size_t e) { return vertex_change(sweep, view, e); });
  if (moved.views > 0) {
    found.push_back(fmt::format(
        "part '{}': facets narrower than a Fresnel zone reflect to others far away, so that vertices displaced by "
        "{:.2g} mm would change {} by more than {:g} of the echo at {:.6g} GHz, most by {:.2g} at {}",
        part_names[sweep.uncertainty[moved.worst_view].displaced_part],
        1e3 * kVertexNoise * kSpeedOfLight / (1e9 * ghz), count_of(sweep, moved), kLargeShare, ghz, moved.worst,
        place_of(sweep, moved)));
  }
  const Exceeded cavity = exceeding(sweep, kLargeShare, [&](std::size_t view, std::size_t e) {
    return share(std::abs(sweep.uncertainty[view].in_cavity[e]), echo(sweep, view, e));
  });
  if (cavity.views > 0) {
    const std::string& name = part_names[sweep.uncertainty[cavity.worst_view].cavity_part];
    found.push_back(fmt::format(
        "part '{0}': {1} or more reflections by its own walls, within {2:g} wavelengths of each other, carry more than "
        "{3:g} of the echo of {4} at {5:.6g} GHz, most {6:.2g} at {7}: rays are doubtful in cavities; --cavity PART "
        "solves an open one that is a part of its own",
        name, kCavityReflections, kCavityWavelengths, kLargeShare, count_of(sweep, cavity), ghz, cavity.worst,
        place_of(sweep, cavity)));
  }
  if (sweep.transmitter) return found;
  const Exceeded reciprocal = exceeding(sweep, kLargeShare, [&](std::size_t view, std::size_t e) {
    return share(sweep.uncertainty[view].non_reciprocal, echo(sweep, view, e));
  });
  if (reciprocal.views > 0) {
    found.push_back(
        fmt::format("part '{}': hv and vh of {} differ by the order of the reflections; half of the difference is more "
                    "than {:g} of "
                    "hh or vv at {:.6g} GHz, most {:.2g} at {}: their mean is given",
                    part_names[sweep.uncertainty[reciprocal.worst_view].non_reciprocal_part],
                    count_of(sweep, reciprocal), kLargeShare, ghz, reciprocal.worst, place_of(sweep, reciprocal)));
  }
  return found;
}

std::string uncertainty_header() {
  return ",hh_flat_over_smooth_db,vv_flat_over_smooth_db,hh_vertex_change,vv_vertex_change";
}

std::string uncertainty_cells(const RcsSweep& sweep, std::size_t view, std::size_t frequency) {
  const auto& flat = sweep.flat->matrices[view][frequency];
  const auto& smooth = sweep.models.back().matrices[view][frequency];
  return fmt::format(",{:.4f},{:.4f},{:.4f},{:.4f}", ratio_db(flat[0], smooth[0]), ratio_db(flat[3], smooth[3]),
                     vertex_change(sweep, view, 0), vertex_change(sweep, view, 1));
}

namespace {

// Values of the sweep along its only axis with several values: views and frequencies, and x.
struct Cut {
  std::string label;
  std::vector<double> x;
  std::vector<std::pair<std::size_t, std::size_t>> places;  // view, frequency
};

std::optional<Cut> cut_of(const RcsSweep& sweep) {
  Cut cut;
  if (sweep.views() == 1) {
    cut.label = "frequency (GHz)";
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      cut.x.push_back(1e-9 * sweep.frequency_hz[q]);
      cut.places.emplace_back(0, q);
    }
  } else if (sweep.elevation_deg.size() == 1 || sweep.azimuth_deg.size() == 1) {
    const bool azimuth = sweep.elevation_deg.size() == 1;
    cut.label = azimuth ? "azimuth (deg)" : "elevation (deg)";
    cut.x = azimuth ? sweep.azimuth_deg : sweep.elevation_deg;
    for (std::size_t view = 0; view < sweep.views(); ++view) cut.places.emplace_back(view, sweep.estimated);
  }
  return cut.x.size() > 1 ? std::optional(cut) : std::nullopt;
}

LinePlot plot_of(const RcsSweep& sweep, const Cut& cut, std::size_t element) {
  Series line{sweep.models.back().name, cut.x, {}, {}, SeriesStyle::kLines}, band = line;
  band.name = "to flat facets";
  band.style = SeriesStyle::kBand;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& [view, q] : cut.places) {
    const double smooth = dbsm(sweep.models.back().matrices[view][q][kCoPolar[element]]),
                 flat = dbsm(sweep.flat->matrices[view][q][kCoPolar[element]]);
    line.y.push_back(smooth);
    band.interval.push_back({std::min(smooth, flat), std::max(smooth, flat)});
    low = std::min(low, band.interval.back()[0]);
    high = std::max(high, band.interval.back()[1]);
  }
  band.y = line.y;
  constexpr double kMargin_db = 3, kHighest_db = 60;
  LinePlot plot;
  plot.title = kCoPolarNames[element];
  if (sweep.views() > 1) plot.title += fmt::format(", {:g} GHz", 1e-9 * sweep.frequency_hz[sweep.estimated]);
  const auto [first, last] = std::ranges::minmax(cut.x);
  plot.x = {cut.label, AxisRange{first, last}, false};
  plot.y = {"radar cross section (dBsm)", AxisRange{std::max(low, high - kHighest_db) - kMargin_db, high + kMargin_db},
            false};
  plot.series = {std::move(line), std::move(band)};
  return plot;
}

}  // namespace

PlotPanels uncertainty_plots(const RcsSweep& sweep) {
  const std::optional<Cut> cut = cut_of(sweep);
  if (!cut) return {};
  return {.plots = {plot_of(sweep, *cut, 0), plot_of(sweep, *cut, 1)}, .columns = 2, .size = {1500, 480}};
}

namespace {

constexpr double kFloorDb = 60;  // of levels below the highest of their element

double level(const RcsSweep::Model& model, std::size_t view, std::size_t frequency, std::size_t element) {
  return dbsm(model.matrices[view][frequency][kCoPolar[element]], kMinPrinted_m2);
}

// What is halved for a method.
struct HalvedSize {
  double RcsRequest::*member;
  const char* quantity;  // in a sentence: halvings of ...
  const char* step;      // head of the line of a step; {} is the size
  const char* column;    // of the changes, after hh_ and vv_
};

const HalvedSize& halved_size(SolverMethod method) {
  static constexpr HalvedSize kPatches{&RcsRequest::min_patch_m, "the patches", "patches of {:.4g} m and more",
                                       "patch_change_db"};
  static constexpr HalvedSize kSpacing{&RcsRequest::ray_spacing_m, "the distance between rays", "rays {:.4g} m apart",
                                       "spacing_change_db"};
  return method == SolverMethod::kRays ? kSpacing : kPatches;
}

// Only what the comparison of two steps needs.
RcsRequest plain(RcsRequest request) {
  request.uncertainty = request.physical_optics_too = false;
  request.exports = {};
  return request;
}

bool is_plain(const RcsRequest& request) {
  return !request.uncertainty && !request.physical_optics_too && !request.exports.wanted();
}

std::string line_of(const ConvergenceStep& step, const RcsSweep& sweep, SolverMethod method, bool first) {
  const std::string traced =
      fmt::format("{}: {:.3g} M segments", fmt::format(fmt::runtime(halved_size(method).step), step.size_m),
                  1e-6 * static_cast<double>(step.segments));
  if (first) return traced + "\n";
  const LevelChange& change = step.change;
  return fmt::format(
      "{}, change of mean {:.4f} dB, largest {:+.4f} dB ({}, {:.6g} GHz, azimuth {:g} deg, elevation {:g} deg)\n",
      traced, change.mean_db, change.largest_db, kCoPolarNames[change.element],
      1e-9 * sweep.frequency_hz[change.frequency], sweep.azimuth_of(change.view), sweep.elevation_of(change.view));
}

}  // namespace

LevelChange level_change(const RcsSweep& sweep, const RcsSweep::Model& fine, const RcsSweep::Model& coarse) {
  LevelChange change;
  const std::size_t frequencies = sweep.frequency_hz.size();
  for (std::size_t element = 0; element < kCoPolar.size(); ++element) {
    double highest = -1e300;
    for (std::size_t row = 0; row < sweep.rows(); ++row)
      highest = std::max(highest, level(fine, row / frequencies, row % frequencies, element));
    const double floor = highest - kFloorDb;
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
      const std::size_t view = row / frequencies, q = row % frequencies;
      const double difference =
          std::max(level(fine, view, q, element), floor) - std::max(level(coarse, view, q, element), floor);
      change.mean_db += std::abs(difference) / static_cast<double>(kCoPolar.size() * sweep.rows());
      if (std::abs(difference) <= std::abs(change.largest_db)) continue;
      change.largest_db = difference;
      change.view = view;
      change.frequency = q;
      change.element = element;
    }
  }
  return change;
}

ConvergedSweep converge_rcs(const RcsRequest& request, const RcsTarget& target, double tolerance_db, int threads,
                            const StopFlag* stop, const std::function<void(const std::string&)>& say) {
  if (!target.cavities.empty())
    throw InputError("--converge halves the patches of beams; cavities have --cavity-patches-per-wavelength");
  ConvergedSweep converged;
  RcsRequest step = plain(request);
  const auto forecast = [&](const std::string& line) { say(line + "\n"); };
  converged.result = compute_rcs(step, target, threads, stop, forecast);
  const TracingSettings settings = settings_of(request, target, request.edges);
  const Scatterer& scatterer = *target.prepared.scatterer;
  double& size_m = step.*halved_size(request.method).member;
  size_m = request.method == SolverMethod::kRays ? ray_spacing(scatterer, settings) : min_patch(scatterer, settings);
  converged.series.push_back({size_m, converged.result.segments, {}});
  say(line_of(converged.series.back(), converged.result.sweep, request.method, true));
  std::optional<RcsSweep::Model> coarser;
  while (!converged.converged && converged.series.size() <= kMostHalvings) {
    size_m /= 2;
    RcsResult finer;
    try {
      finer = compute_rcs(step, target, threads, stop, forecast);
    } catch (const InputError& error) {  // more rays than the method has
      if (!coarser) throw;
      converged.limit = error.what();
      break;
    }
    coarser = std::move(converged.result.sweep.models.back());
    converged.result = std::move(finer);
    const RcsSweep& sweep = converged.result.sweep;
    converged.series.push_back({size_m, converged.result.segments, level_change(sweep, sweep.models.back(), *coarser)});
    say(line_of(converged.series.back(), sweep, request.method, false));
    converged.converged = std::abs(converged.series.back().change.largest_db) <= tolerance_db;
  }
  if (!is_plain(request))
    converged.result = compute_rcs(at_step(request, converged.series.back()), target, threads, stop);
  converged.result.sweep.coarser = std::move(coarser);
  return converged;
}

RcsRequest at_step(RcsRequest request, const ConvergenceStep& step) {
  request.*halved_size(request.method).member = step.size_m;
  return request;
}

std::string convergence_warning(const RcsRequest& request, const ConvergedSweep& sweep) {
  const std::size_t halvings = sweep.series.size() - 1;
  return fmt::format("levels still change by {:.3g} dB after {} halving{} of {}{}{}",
                     std::abs(sweep.series.back().change.largest_db), halvings, halvings == 1 ? "" : "s",
                     halved_size(request.method).quantity, sweep.limit.empty() ? "" : "; ", sweep.limit);
}

std::string convergence_header(SolverMethod method) {
  return fmt::format(",hh_{0},vv_{0}", halved_size(method).column);
}

std::string convergence_cells(const RcsSweep& sweep, std::size_t view, std::size_t frequency) {
  std::string cells;
  for (std::size_t element = 0; element < kCoPolar.size(); ++element) {
    const double difference =
        level(sweep.models.back(), view, frequency, element) - level(*sweep.coarser, view, frequency, element);
    cells += fmt::format(",{:.4f}", std::clamp(difference, -kLargestPrinted_db, kLargestPrinted_db));
  }
  return cells;
}

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

// Of hh and vv together.
EchoChange change_of(const Matrices& from, const Matrices& to) {
  EchoChange change;
  for (std::size_t q = 0; q < from.size(); ++q) {
    for (const std::size_t channel : kCoPolar) change.add(from[q][channel], to[q][channel]);
  }
  return change;
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
  result.materials_note = target.materials_note;
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
        result.views[view].change[i] = change_of(own[view], other[view]).relative();
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
