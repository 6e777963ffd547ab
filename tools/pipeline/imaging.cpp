// SPDX-License-Identifier: BSD-3-Clause
#include "tools/pipeline/imaging.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "sim/core/numbers/constants.h"
#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/solver/solve.h"

namespace seaglint {

FullBandInterval full_band_interval(const Pipeline& pipeline, const SampleLook& of, const FullBandSampling& sampling) {
  const SampleAddress at = pipeline.address(of);
  const Scenario scenario = pipeline.scenario_of(at);
  // One carrier with the bandwidth of all; the hop step is the whole band, so that the unambiguous range window is
  // unchanged.
  RadarSpec radar = scenario.radar;
  const double lowest_mhz = 1e3 * radar.carrier_ghz - 0.5 * radar.bandwidth_mhz;
  radar.bandwidth_mhz += (radar.carrier_count - 1) * radar.hop_step_mhz;
  radar.hop_step_mhz = radar.bandwidth_mhz;
  radar.carrier_count = 1;
  radar.hop_code = HopCode::kStepped;
  radar.carrier_ghz = 1e-3 * (lowest_mhz + 0.5 * radar.bandwidth_mhz);
  radar.sampling_mhz = std::max(radar.sampling_mhz, 2 * radar.bandwidth_mhz);
  if (sampling.pulses > 0) radar.pulses = sampling.pulses;

  FullBandInterval band;
  band.train = make_pulse_train(radar, pipeline.window_m(), scenario.seed,
                                pipeline.plan().look_key(pipeline.plan().first_of_interval(of.sample), of.look));
  PulseTrain later = band.train;
  for (double& t : later.time_s) t += sampling.offset_s;
  ClutterSpec none;
  none.enabled = false;
  band.echo = pipeline.echo(of, band.train, pipeline.response(at, later), none).target;
  band.image = form_rv_map(band.echo, band.train, sampling.map.value_or(scenario.map), radar.intra_pulse_motion);
  return band;
}

RangeProfiles range_profiles(const FullBandInterval& band, const MapSpec& spec) {
  RangeProfiles profiles;
  const std::size_t frequencies = band.train.frequencies();
  MapSpec row = spec;
  row.velocity_span_mps = 1e-6;  // one velocity, 0
  for (std::size_t n = 0; n < band.train.pulses(); ++n) {
    PulseTrain pulse = band.train;
    pulse.code = {band.train.code[n]};
    pulse.carrier_hz = {band.train.carrier_hz[n]};
    pulse.time_s = {0};
    const RvMap map = form_rv_map({&band.echo[n * frequencies], frequencies}, pulse, row, pulse.intra_pulse_motion);
    profiles.time_s.push_back(band.train.time_s[n]);
    profiles.range_m = map.range_m;
    for (const Complex& value : map.values) profiles.magnitude_m.push_back(std::abs(value));
  }
  return profiles;
}

RangeProfiles profiles_over(const Pipeline& pipeline, const SampleLook& of, const ProfileTimes& times) {
  std::vector<RangeProfiles> single(static_cast<std::size_t>(times.count));
  parallel_for(single.size(), thread_count(times.threads), [&](std::size_t i) {
    const double offset_s = times.duration_s * static_cast<double>(i) / static_cast<double>(single.size());
    single[i] = range_profiles(full_band_interval(pipeline, of, {.offset_s = offset_s, .pulses = 1, .map = times.map}),
                               times.map);
    single[i].time_s = {offset_s};
  });
  RangeProfiles all;
  all.range_m = single.front().range_m;
  for (const RangeProfiles& profile : single) {
    all.time_s.push_back(profile.time_s.front());
    all.magnitude_m.insert(all.magnitude_m.end(), profile.magnitude_m.begin(), profile.magnitude_m.end());
  }
  return all;
}

namespace {

// A body of the target or of a companion: corners of its bounding box in its own axes, and its motion in the target
// frame. An ideal point is a body of one corner.
struct MovingBody {
  std::string name;
  std::vector<Vec3> corners;
  Trajectory trajectory;
  Vec3 velocity = Vec3::Zero();              // in addition
  const PreparedTarget* prepared = nullptr;  // null: a point
  double amplitude_m = 0;                    // of a point

  Vec3 at(const Vec3& corner, double since_s, double start_s) const {
    return trajectory.pose(start_s + since_s) * corner + since_s * velocity;
  }
};

// What a sample's radar looks at, times from the start of the sample's interval.
struct Observed {
  std::shared_ptr<const Scene> scene;
  Scenario scenario;
  std::vector<MovingBody> bodies;
  bool rigid = false;  // one body, or a raft
  double start_s = 0;
  Vec3 r_hat, r_rate = Vec3::Zero();
  double wavelength_m = 0, range_cell_m = 0;

  Vec3 sight(double since_s) const { return (r_hat + since_s * r_rate).normalized(); }
  double range_m(const MovingBody& body, const Vec3& corner, double since_s) const {
    return -sight(since_s).dot(body.at(corner, since_s, start_s));
  }
  // The look direction in the axes of the first body.
  Vec3 look(double since_s) const {
    return bodies.front().trajectory.pose(start_s + since_s).R.transpose() * sight(since_s);
  }
};

std::vector<Vec3> corners_of(const Bounds& box) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back(i & 1 ? box.upper.x() : box.lower.x(), i & 2 ? box.upper.y() : box.lower.y(),
                         i & 4 ? box.upper.z() : box.lower.z());
  }
  return corners;
}

// at_least_s: from the start of the sample's interval.
Observed observed(const Pipeline& pipeline, const SampleLook& of, double at_least_s) {
  const SamplePlan& plan = pipeline.plan();
  const SampleAddress at = pipeline.address(of);
  Observed seen;
  seen.scenario = pipeline.scenario_of(at);
  seen.start_s = plan.start_s(at);
  seen.scene = pipeline.scene(at, at_least_s > 0 ? seen.start_s + at_least_s : 0);
  const View view = plan.view(at);
  const RadarSpec& radar = seen.scenario.radar;
  seen.r_hat = direction_to_radar(view.azimuth_rad, view.elevation_rad);
  seen.r_rate = Vec3(radar.platform.velocity_mps) / (radar.range_km * 1e3);
  const double band_hz = 1e6 * (radar.bandwidth_mhz + (radar.carrier_count - 1) * radar.hop_step_mhz);
  seen.range_cell_m = kSpeedOfLight / (2 * band_hz);
  seen.wavelength_m = kSpeedOfLight / (0.5e9 * (lowest_ghz(radar) + highest_ghz(radar)));
  const std::vector<Target>& targets = *seen.scene->targets;
  const auto add = [&](std::size_t index) {
    const Target& target = targets[index];
    for (std::size_t i = 0; i < target.models.size(); ++i) {
      const bool alone = target.models.size() == 1;
      seen.bodies.push_back({alone ? target.spec.name : fmt::format("{} {}", target.spec.name, i + 1),
                             corners_of(target.models[i]->box), seen.scene->bodies[index][i],
                             seen.scene->velocities_mps[index][i], target.models[i]->prepared.get(), 0});
    }
    for (std::size_t i = 0; i < target.spec.points.size() && target.models.empty(); ++i) {
      const PointSpec& point = target.spec.points[i];
      seen.bodies.push_back({fmt::format("point {}", i + 1),
                             {Vec3(point.position_m)},
                             Trajectory(),
                             Vec3(point.velocity_mps),
                             nullptr,
                             std::abs(point.amplitude_m)});
    }
  };
  const auto index = static_cast<std::size_t>(at.target);
  add(index);
  seen.rigid =
      !targets[index].models.empty() && (targets[index].models.size() == 1 || is_raft(targets[index].spec.layout));
  for (const std::size_t companion : targets[index].companions) add(companion);
  return seen;
}

// Largest departure of a corner's range from its straight line over [first, last], m.
double departure_m(const Observed& seen, double first_s, double last_s) {
  constexpr int kSteps = 12;
  double largest = 0;
  for (const MovingBody& body : seen.bodies) {
    for (const Vec3& corner : body.corners) {
      double sum = 0, moment = 0, squares = 0, r[kSteps + 1];
      for (int i = 0; i <= kSteps; ++i) {
        const double u = static_cast<double>(i) / kSteps - 0.5;
        r[i] = seen.range_m(body, corner, first_s + (u + 0.5) * (last_s - first_s));
        sum += r[i];
        moment += u * r[i];
        squares += u * u;
      }
      for (int i = 0; i <= kSteps; ++i) {
        const double u = static_cast<double>(i) / kSteps - 0.5;
        largest = std::max(largest, std::abs(r[i] - sum / (kSteps + 1) - u * moment / squares));
      }
    }
  }
  return largest;
}

double aspect_change(const Observed& seen, double first_s, double last_s) {
  return seen.rigid ? std::acos(std::clamp(seen.look(first_s).dot(seen.look(last_s)), -1.0, 1.0)) : 0;
}

// Interval of an image, s from the start of the sample's: IsarPlan.
std::pair<double, double> imaging_interval(const Observed& seen, double search_s, double longest_s) {
  constexpr int kPlaces = 60;
  constexpr double kLongest_s = 1, kGrowth = 1.1;
  const double shortest_s = 1e-6 * seen.scenario.radar.pri_us * seen.scenario.radar.pulses;
  const double enough = seen.rigid ? seen.wavelength_m / (2 * seen.range_cell_m) : 1e300;
  const double limit_s = seen.rigid ? longest_s : std::min(longest_s, kLongest_s);
  std::tuple<double, double> best{-1, 0};  // angle (or duration) up to `enough`, minus the departure
  std::pair<double, double> interval{0, shortest_s};
  for (int place = 0; place < kPlaces; ++place) {
    const double first_s = search_s * place / kPlaces;
    for (double length_s = std::min(shortest_s, limit_s); length_s <= limit_s; length_s *= kGrowth) {
      const double last_s = first_s + length_s, off_m = departure_m(seen, first_s, last_s);
      if (off_m > seen.wavelength_m / 8) break;
      const double reached = seen.rigid ? aspect_change(seen, first_s, last_s) : length_s;
      const std::tuple found{std::min(reached, enough), -off_m};
      if (found > best) {
        best = found;
        interval = {first_s, last_s};
      }
      if (reached >= enough) break;
    }
    if (!seen.rigid) break;
  }
  return interval;
}

bool has_series(const Scenario& scenario) {
  return std::ranges::any_of(scenario.targets,
                             [](const TargetSpec& target) { return target.motion.model == MotionModel::kSeries; });
}

}  // namespace

IsarPlan isar_plan(const Pipeline& pipeline, const SampleLook& of) {
  if (is_sea_alone(pipeline.scenario())) {
    throw InputError(fmt::format("{}: the sea alone: an image and a range profile need a target",
                                 place_of(pipeline.scenario(), "targets")));
  }
  constexpr int kMostPulses = 65536;
  constexpr double kCalm_s = 4, kCells = 4, kLeastCells = 8;
  const SampleAddress at = pipeline.address(of);
  const double pri_s = 1e-6 * pipeline.scenario_of(at).radar.pri_us;
  const double period_s = pipeline.plan().sea_state(at).significant_wave_height_m > 0
                              ? pipeline.plan().sea_state(at).peak_period_s
                              : kCalm_s;
  const double own_s = pri_s * pipeline.scenario_of(at).radar.pulses;
  // A recorded motion need not last longer than the sample's interval.
  const bool bounded = has_series(pipeline.scenario());
  const double search_s = bounded ? 0 : period_s,
               longest_s = bounded ? own_s : std::max(own_s, std::min(period_s, pri_s * kMostPulses));
  const Observed seen = observed(pipeline, of, bounded ? 0 : search_s + longest_s);
  const auto [first_s, last_s] = imaging_interval(seen, search_s, longest_s);

  IsarPlan plan;
  plan.duration_s = last_s - first_s;
  plan.sampling.offset_s = first_s;
  plan.sampling.pulses = std::clamp(static_cast<int>(std::lround(plan.duration_s / pri_s)), 2, kMostPulses);
  std::pair<double, double> range{1e300, -1e300}, velocity = range;
  for (const MovingBody& body : seen.bodies) {
    for (const Vec3& corner : body.corners) {
      const double start_m = seen.range_m(body, corner, first_s), end_m = seen.range_m(body, corner, last_s);
      const double rate = (end_m - start_m) / plan.duration_s;
      range = {std::min(range.first, start_m), std::max(range.second, start_m)};
      velocity = {std::min(velocity.first, rate), std::max(velocity.second, rate)};
    }
  }
  const double velocity_cell = seen.wavelength_m / (2 * plan.duration_s);
  const auto widened = [](std::pair<double, double> of, double cell) {
    const double more = std::max(3 * cell, 0.05 * (of.second - of.first));
    return std::pair{of.first - more, of.second + more};
  };
  plan.range_m = widened(range, seen.range_cell_m);
  plan.velocity_mps = widened(velocity, velocity_cell);
  const auto span = [](const std::pair<double, double>& of) {
    return 2 * std::max(std::abs(of.first), std::abs(of.second));
  };
  MapSpec& map = plan.sampling.map.emplace(seen.scenario.map);
  map.range_span_m = span(plan.range_m);
  map.velocity_span_mps = span(plan.velocity_mps);
  map.range_oversampling = map.velocity_oversampling = kCells;
  map.range_taper = map.velocity_taper = Taper::kHamming;

  if (!seen.rigid) {
    plan.no_cross_range = "several bodies move independently";
    return plan;
  }
  IsarPlan::CrossRange cross;
  cross.angle_rad = aspect_change(seen, first_s, last_s);
  plan.no_cross_range = "too little rotation";
  if (cross.angle_rad <= 0) return plan;
  cross.rate_rad_s = cross.angle_rad / plan.duration_s;
  cross.cell_m = seen.wavelength_m / (2 * cross.angle_rad);
  const MovingBody& body = seen.bodies.front();
  cross.origin_mps =
      (seen.range_m(body, Vec3::Zero(), last_s) - seen.range_m(body, Vec3::Zero(), first_s)) / plan.duration_s;
  // range of x = -look . x: its rate is that of the look direction in body axes, reversed.
  const Vec3 u_body = (seen.look(first_s) - seen.look(last_s)).normalized();
  cross.up = (body.trajectory.pose(seen.start_s + 0.5 * (first_s + last_s)).R * u_body).z();
  double lowest = 1e300, highest = -1e300;
  for (const Vec3& corner : body.corners) {
    lowest = std::min(lowest, corner.dot(u_body));
    highest = std::max(highest, corner.dot(u_body));
  }
  if (highest - lowest > kLeastCells * cross.cell_m) {
    plan.cross_range = cross;
    plan.no_cross_range.clear();
  }
  return plan;
}

std::vector<NamedPeak> strongest_peaks(std::span<const double> range_m, std::span<const double> magnitude_m,
                                       double range_cell_m, std::size_t most) {
  constexpr double kBelow = 0.0562;  // -25 dB
  std::vector<NamedPeak> maxima, peaks;
  if (magnitude_m.empty()) return peaks;
  const double strongest = std::ranges::max(magnitude_m);
  for (std::size_t i = 1; i + 1 < magnitude_m.size(); ++i) {
    const double here = magnitude_m[i];
    if (here > magnitude_m[i - 1] && here >= magnitude_m[i + 1] && here > kBelow * strongest)
      maxima.push_back({range_m[i], here, {}});
  }
  std::ranges::sort(maxima, std::greater{}, &NamedPeak::magnitude_m);
  for (const NamedPeak& maximum : maxima) {
    const auto near = [&](const NamedPeak& peak) {
      return std::abs(peak.range_m - maximum.range_m) < 2 * range_cell_m;
    };
    if (peaks.size() < most && std::ranges::none_of(peaks, near)) peaks.push_back(maximum);
  }
  return peaks;
}

void name_peaks(std::vector<NamedPeak>& peaks, std::span<const RangeContribution> contributions, double range_cell_m) {
  for (NamedPeak& peak : peaks) {
    std::map<std::string, Complex> sums;
    for (const RangeContribution& one : contributions) {
      if (std::abs(one.range_m - peak.range_m) <= 0.5 * range_cell_m) sums[one.name] += one.amplitude_m;
    }
    double largest = 0;
    for (const auto& [name, sum] : sums) {
      if (std::abs(sum) <= largest) continue;
      largest = std::abs(sum);
      peak.name = name;
    }
  }
}

void append_contributions(const PointContributions& of, std::vector<RangeContribution>& contributions) {
  for (const Point& point : of.points) {
    std::string name = of.name.empty() ? of.mesh.part_names[point.source.part] : of.name;
    std::ranges::replace(name, '_', ' ');
    contributions.push_back({of.origin_m - 0.5 * point.psi, std::move(name),
                             point.matrix(0)[of.element] * std::polar(1.0, of.k * point.psi)});
  }
}

std::vector<NamedPeak> named_peaks(const Pipeline& pipeline, const SampleLook& of, const RangeProfiles& profiles,
                                   std::size_t most) {
  const Observed seen = observed(pipeline, of, 0);
  std::vector<NamedPeak> peaks = strongest_peaks(
      profiles.range_m, {profiles.magnitude_m.data(), profiles.range_m.size()}, seen.range_cell_m, most);
  std::vector<RangeContribution> contributions;
  const double k = 2 * kPi / seen.wavelength_m;
  const bool parts = seen.bodies.size() == 1;
  for (const MovingBody& body : seen.bodies) {
    if (body.prepared == nullptr) {
      contributions.push_back({seen.range_m(body, body.corners.front(), 0), body.name, body.amplitude_m});
      continue;
    }
    const Scatterer& scatterer = *body.prepared->scatterer;
    const Vec3 look = body.trajectory.pose(seen.start_s).R.transpose() * seen.r_hat;
    const std::size_t target = static_cast<std::size_t>(pipeline.address(of).target);
    const SolveResult solved = solve({.scatterer = scatterer,
                                      .views = {monostatic(radar_basis(look))},
                                      .wavenumbers = {k},
                                      .settings = tracing_settings((*seen.scene->targets)[target].spec.solver),
                                      .points_for_rad = default_aspect_change(scatterer, seen.wavelength_m)});
    append_contributions({.points = solved.views[0].points,
                          .mesh = body.prepared->mesh,
                          .k = k,
                          .origin_m = seen.range_m(body, Vec3::Zero(), 0),
                          .element = static_cast<std::size_t>(seen.scenario.radar.polarisation),
                          .name = parts ? "" : body.name},
                         contributions);
  }
  name_peaks(peaks, contributions, seen.range_cell_m);
  return peaks;
}

}  // namespace seaglint
