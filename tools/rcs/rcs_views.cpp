// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/rcs_views.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <complex>
#include <cstdint>
#include <map>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/progress.h"
#include "sim/scattering/observation/observation.h"
#include "sim/scattering/observation/sea_reflection.h"
#include "sim/scattering/solver/solve.h"

namespace seaglint {

namespace {

double largest(const std::array<double, 2>& values) { return std::max(values[0], values[1]); }

ViewUncertainty summary_of(const ViewEstimate& estimate) {
  using Sums = ViewEstimate::Sums;
  const auto in_cavity = [](const Sums& sums) {
    return std::max(std::abs(sums.in_cavity[0]), std::abs(sums.in_cavity[1]));
  };
  ViewUncertainty view;
  const std::size_t cavity = estimate.largest_part(in_cavity);
  view.cavity_part = static_cast<std::uint16_t>(cavity);
  view.flat_part =
      static_cast<std::uint16_t>(estimate.largest_part([](const Sums& sums) { return largest(sums.flat_change); }));
  view.displaced_part =
      static_cast<std::uint16_t>(estimate.largest_part([](const Sums& sums) { return largest(sums.displaced_power); }));
  view.non_reciprocal_part =
      static_cast<std::uint16_t>(estimate.largest_part([](const Sums& sums) { return sums.non_reciprocal_size; }));
  const Sums all = estimate.all();
  view.non_reciprocal = static_cast<float>(std::abs(all.non_reciprocal));
  for (const std::size_t e : {0u, 1u}) {
    view.flat_less_smooth[e] = std::complex<float>(all.flat_less_smooth[e]);
    view.displaced[e] = static_cast<float>(std::sqrt(all.displaced_power[e]));
    if (cavity < estimate.parts().size())
      view.in_cavity[e] = std::complex<float>(estimate.parts()[cavity].in_cavity[e]);
  }
  return view;
}

BistaticGeometry antennas_of(const RcsRequest& request, const RadarBasis& swept) {
  if (!request.transmitter) return monostatic(swept);
  return bistatic(basis_at(request.transmitter->azimuth_deg, request.transmitter->elevation_deg), swept);
}

SeaReflection reflection_of(const SeaUnderTarget& sea) {
  SeaReflectionSpec spec;
  spec.surface = sea.surface;
  spec.paths = sea.paths;
  return SeaReflection(spec, sea.wave_height_m);
}

// Number of views computed from one trace of a fixed transmitter; 1 for one antenna. Every view needs memory for its
// visible surface and edge illuminations (18 MB for a ship of 144 m) and for its sums (at most 132 kB per frequency).
std::size_t views_per_trace(const RcsRequest& request) {
  constexpr std::size_t kMaxViews = 8, kMaxMatrices = 512;
  if (!request.transmitter) return 1;
  return std::clamp<std::size_t>(kMaxMatrices / request.frequency_hz.size(), 1, kMaxViews);
}

// Largest number of groups of views computed at the same time, each of which needs the memory of a trace.
constexpr std::size_t kMaxSideBySide = 8;

// Computes the views of a sweep by the request's method, several at a time. A view's matrices do not depend on the
// others.
class SweepTracer {
 public:
  SweepTracer(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop)
      : request_(request), target_(target), threads_(threads), stop_(stop) {
    for (const double hz : request.frequency_hz) wavenumbers_.push_back(2 * kPi * hz / kSpeedOfLight);
  }

  // Views in parallel before panels in parallel, which needs more synchronisation.
  void run(RcsResult& result, const std::function<void(const std::string&)>& say) const {
    const std::size_t views = result.sweep.views(), together = views_per_trace(request_),
                      groups = (views + together - 1) / together;
    const int side_by_side = static_cast<int>(std::min({groups, static_cast<std::size_t>(threads_), kMaxSideBySide}));
    std::atomic<std::size_t> done{0}, segments{0};
    Progress progress("rcs", views, "views");
    progress.announce(static_cast<std::size_t>(side_by_side) * together, threads_, say);
    try {
      parallel_for(
          groups, side_by_side,
          [&](std::size_t group) {
            const std::size_t first = group * together, count = std::min(together, views - first);
            std::size_t of_group = 0;
            for (RcsSweep::Model& model : result.sweep.models)
              trace(first, count, model, result, std::max(1, threads_ / side_by_side), of_group);
            segments += of_group;
            done += count;
            progress.advance(count);
          },
          stop_);
    } catch (const Interrupted&) {
      throw WorkError(fmt::format("interrupted after {} of {} views", done.load(), views));
    }
    result.segments += segments;
  }

 private:
  // Fills in the matrices of a model for the views first, first + 1, ..., first + count - 1, and the contributions of
  // an exported view; adds the number of beam segments.
  void trace(std::size_t first, std::size_t count, RcsSweep::Model& model, RcsResult& result, int threads,
             std::size_t& segments) const {
    const Scatterer& scatterer = *target_.prepared.scatterer;
    const TracingSettings settings = settings_of(request_, target_, model.edge_diffraction);
    std::vector<BistaticGeometry> pairs;
    for (std::size_t view = first; view < first + count; ++view)
      pairs.push_back(antennas_of(request_, basis_at(result.sweep.azimuth_of(view), result.sweep.elevation_of(view))));
    const bool requested = &model == &result.sweep.models.back();
    if (request_.exports.wanted() && requested) {
      SolveResult solved = view_contributions(
          request_, target_,
          {result.sweep.azimuth_of(first), result.sweep.elevation_of(first), request_.frequency_hz.front()}, threads,
          stop_);
      ViewResult& view = solved.views.front();
      model.matrices[first] = std::move(view.matrices);
      set_uncertainty(first, *view.estimate, result.sweep);
      set_parts(first, view.parts, result.sweep);
      result.points = std::move(view.points);
      segments += solved.segments;
      return;
    }
    SolveRequest solver{.scatterer = scatterer,
                        .views = std::move(pairs),
                        .wavenumbers = wavenumbers_,
                        .settings = settings,
                        .radar = {request_.range_m},
                        .estimates = requested,
                        .by_part = requested && request_.by_part,
                        .threads = threads,
                        .stop = stop_};
    if (request_.sea.reflection) solver.sea = {reflection_of(request_.sea), request_.sea.height_m};
    SolveResult solved = solve(solver);
    segments += solved.segments;
    for (std::size_t i = 0; i < count; ++i) {
      model.matrices[first + i] = std::move(solved.views[i].matrices);
      if (!requested) continue;
      set_uncertainty(first + i, *solved.views[i].estimate, result.sweep);
      set_parts(first + i, solved.views[i].parts, result.sweep);
    }
  }

  // All views of a sweep are estimated at the same frequency.
  void set_uncertainty(std::size_t view, const ViewEstimate& estimate, RcsSweep& sweep) const {
    sweep.uncertainty[view] = summary_of(estimate);
    if (view == 0) {
      const auto at = std::ranges::find(wavenumbers_, estimate.wavenumber());
      sweep.estimated = static_cast<std::size_t>(at - wavenumbers_.begin());
    }
  }

  void set_parts(std::size_t view, const std::map<std::uint16_t, Matrices>& parts, RcsSweep& sweep) const {
    for (const auto& [part, matrices] : parts) {
      auto& of_part = sweep.parts[view][part];
      for (const ScatteringMatrix& matrix : matrices) {
        auto& values = of_part.emplace_back();
        for (std::size_t i = 0; i < 4; ++i) values[i] = std::complex<float>(matrix[i]);
      }
    }
  }

  const RcsRequest& request_;
  const RcsTarget& target_;
  int threads_;
  const StopFlag* stop_;
  std::vector<double> wavenumbers_;
};

// Adds the scattering matrices of cavities to every model of the sweep.
void add_cavities(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop,
                  RcsSweep& sweep, const std::function<void(const std::string&)>& say) {
  std::vector<BistaticGeometry> views;
  for (std::size_t view = 0; view < sweep.views(); ++view)
    views.push_back(antennas_of(request, basis_at(sweep.azimuth_of(view), sweep.elevation_of(view))));
  Progress progress("cavity", target.cavities.size() * sweep.frequency_hz.size(), "frequencies");
  progress.announce(1, threads, say);
  for (const NamedCavity& named : target.cavities) {
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      std::vector<std::array<Complex, 4>> echo(sweep.views());
      try {
        if (target.filter.accepts_cavity(named.part))
          echo =
              named.cavity.scattering_matrices(2 * kPi * sweep.frequency_hz[q] / kSpeedOfLight, views, threads, stop);
      } catch (const WorkError& error) {
        throw WorkError(
            fmt::format("cavity {} at {:.6g} GHz: {}", named.name, 1e-9 * sweep.frequency_hz[q], error.what()));
      }
      const auto add_to = [&](RcsSweep::Model& model) {
        for (std::size_t view = 0; view < sweep.views(); ++view) {
          for (int i = 0; i < 4; ++i) model.matrices[view][q][i] += echo[view][i];
        }
      };
      for (std::size_t view = 0; !request.transmitter && view < sweep.views(); ++view)
        echo[view] = reciprocal_mean(echo[view], echo[view]);
      for (RcsSweep::Model& model : sweep.models) add_to(model);
      if (sweep.flat) add_to(*sweep.flat);
      for (std::size_t view = 0; view < sweep.parts.size(); ++view) {
        auto& of_part = sweep.parts[view].try_emplace(static_cast<std::uint16_t>(named.part)).first->second;
        of_part.resize(sweep.frequency_hz.size());
        for (std::size_t i = 0; i < 4; ++i) of_part[q][i] += std::complex<float>(echo[view][i]);
      }
      progress.advance();
    }
  }
}

// The requested model of the target with all facets flat, without the echoes of cavities.
RcsSweep::Model flat_model(RcsRequest request, int threads, const StopFlag* stop,
                           const std::function<void(const std::string&)>& say) {
  request.crease_deg = 0;
  request.uncertainty = request.physical_optics_too = request.by_part = false;
  request.exports = {};
  RcsTarget target = prepare_rcs_target(request);
  target.cavities.clear();
  RcsSweep::Model model = compute_rcs(request, target, threads, stop, say).sweep.models.back();
  model.name += ", flat facets";
  return model;
}

}  // namespace

RadarBasis basis_at(double azimuth_deg, double elevation_deg) {
  const Vec3 r = direction_to_radar(radians(azimuth_deg), radians(elevation_deg));
  if (std::abs(elevation_deg) != 90) return radar_basis(r);
  const Vec3 h = direction_to_radar(radians(azimuth_deg + 90), 0);
  return {r, h, r.cross(h)};
}

TracingSettings settings_of(const RcsRequest& request, bool edge_diffraction) {
  return {request.min_patch_m, request.max_bounces, edge_diffraction, {}, request.method, request.ray_spacing_m};
}

TracingSettings settings_of(const RcsRequest& request, const RcsTarget& target, bool edge_diffraction) {
  TracingSettings settings = settings_of(request, edge_diffraction);
  settings.filter = target.filter;
  return settings;
}

SolveResult view_contributions(const RcsRequest& request, const RcsTarget& target, const RcsView& view, int threads,
                               const StopFlag* stop) {
  const Scatterer& scatterer = *target.prepared.scatterer;
  const double k = 2 * kPi * view.frequency_hz / kSpeedOfLight;
  return solve({.scatterer = scatterer,
                .views = {antennas_of(request, basis_at(view.azimuth_deg, view.elevation_deg))},
                .wavenumbers = {k},
                .settings = settings_of(request, target, request.edges),
                .radar = {request.range_m},
                .estimates = true,
                .by_part = request.by_part,
                .points_for_rad = default_aspect_change(scatterer, 2 * kPi / k),
                .threads = threads,
                .stop = stop});
}

std::vector<double> averaged_azimuths(const RcsRequest& request) {
  if (request.average <= 1) return request.azimuth_deg;
  const double step =
      (request.azimuth_deg.back() - request.azimuth_deg.front()) / static_cast<double>(request.azimuth_deg.size() - 1);
  std::vector<double> azimuths;
  for (const double azimuth : request.azimuth_deg) {
    for (int i = 0; i < request.average; ++i) azimuths.push_back(azimuth + step * ((i + 0.5) / request.average - 0.5));
  }
  return azimuths;
}

namespace {

// The mean cross-sections of `average` neighbouring azimuths each.
RcsSweep averaged(const RcsSweep& fine, const RcsRequest& request) {
  RcsSweep sweep = requested_sweep(request);
  const auto average = static_cast<std::size_t>(request.average);
  for (const RcsSweep::Model& model : fine.models) {
    RcsSweep::Model& mean = sweep.models.emplace_back(RcsSweep::Model{model.name, model.edge_diffraction, {}});
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      // Azimuths are the fastest axis of the views.
      auto& values = mean.matrices.emplace_back(sweep.frequency_hz.size());
      for (std::size_t q = 0; q < values.size(); ++q) {
        for (std::size_t element = 0; element < 4; ++element) {
          double sum = 0;
          for (std::size_t i = 0; i < average; ++i) sum += std::norm(model.matrices[view * average + i][q][element]);
          values[q][element] = std::sqrt(sum / static_cast<double>(average));
        }
      }
    }
  }
  return sweep;
}

}  // namespace

RcsResult compute_rcs(const RcsRequest& request, const RcsTarget& target, int threads, const StopFlag* stop,
                      const std::function<void(const std::string&)>& say) {
  if (request.average > 1) {
    RcsRequest every = request;
    every.azimuth_deg = averaged_azimuths(request);
    every.average = 1;
    every.by_part = false;
    RcsResult result = compute_rcs(every, target, threads, stop, say);
    result.sweep = averaged(result.sweep, request);
    return result;
  }
  RcsResult result{requested_sweep(request), {}, 0};
  RcsSweep& sweep = result.sweep;
  const std::vector<std::vector<std::array<Complex, 4>>> empty(sweep.views());
  if (!request.edges || request.physical_optics_too) sweep.models.push_back({"po", false, empty});
  if (request.edges) sweep.models.push_back({"po+diffraction", true, empty});
  sweep.uncertainty.resize(sweep.views());
  if (request.by_part) sweep.parts.resize(sweep.views());
  const int count = thread_count(threads);
  SweepTracer(request, target, count, stop).run(result, say);
  if (request.uncertainty) sweep.flat = flat_model(request, threads, stop, say);
  if (!target.cavities.empty()) add_cavities(request, target, count, stop, sweep, say);
  return result;
}

}  // namespace seaglint
