// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/scattering/tracing/tracing_settings.h"

namespace seaglint {
namespace {

constexpr std::array<std::size_t, 2> kElements{0, 3};  // hh, vv of a matrix
constexpr const char* kElementNames[2] = {"hh", "vv"};
constexpr double kFloorDb = 60;  // of levels below the highest of their element
constexpr double kMostDb = 60;   // printed

double level(const RcsSweep::Model& model, std::size_t view, std::size_t frequency, std::size_t element) {
  return dbsm(model.matrices[view][frequency][kElements[element]], kMinPrinted_m2);
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
      traced, change.mean_db, change.largest_db, kElementNames[change.element],
      1e-9 * sweep.frequency_hz[change.frequency], sweep.azimuth_of(change.view), sweep.elevation_of(change.view));
}

}  // namespace

LevelChange level_change(const RcsSweep& sweep, const RcsSweep::Model& fine, const RcsSweep::Model& coarse) {
  LevelChange change;
  const std::size_t frequencies = sweep.frequency_hz.size();
  for (std::size_t element = 0; element < kElements.size(); ++element) {
    double highest = -1e300;
    for (std::size_t row = 0; row < sweep.rows(); ++row)
      highest = std::max(highest, level(fine, row / frequencies, row % frequencies, element));
    const double floor = highest - kFloorDb;
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
      const std::size_t view = row / frequencies, q = row % frequencies;
      const double difference =
          std::max(level(fine, view, q, element), floor) - std::max(level(coarse, view, q, element), floor);
      change.mean_db += std::abs(difference) / static_cast<double>(kElements.size() * sweep.rows());
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
  for (std::size_t element = 0; element < kElements.size(); ++element) {
    const double difference =
        level(sweep.models.back(), view, frequency, element) - level(*sweep.coarser, view, frequency, element);
    cells += fmt::format(",{:.4f}", std::clamp(difference, -kMostDb, kMostDb));
  }
  return cells;
}

}  // namespace seaglint
