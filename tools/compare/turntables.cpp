// SPDX-License-Identifier: BSD-3-Clause
#include "tools/compare/turntables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "tools/compare/differences.h"

namespace seaglint {

std::optional<ComparedTurntable> compared_turntable(const std::vector<PairedCut>& cuts) {
  const PairedCut* strongest = nullptr;
  const PairedCut::Place* highest = nullptr;
  double level = -1e300;
  for (const PairedCut& cut : cuts) {
    if (cut.models.empty() || !cut.has_phases()) continue;
    const auto at = std::ranges::max_element(cut.level_dbsm) - cut.level_dbsm.begin();
    if (cut.level_dbsm[static_cast<std::size_t>(at)] <= level) continue;
    level = cut.level_dbsm[static_cast<std::size_t>(at)];
    strongest = &cut;
    highest = &cut.places[static_cast<std::size_t>(at)];
  }
  if (strongest == nullptr || std::abs(highest->elevation_deg) > kSteepestTurntable_deg) return std::nullopt;
  std::map<std::pair<double, double>, std::pair<Complex, Complex>> values;  // by azimuth and frequency
  std::set<double> azimuths, frequencies;
  for (const PairedCut& cut : cuts) {
    if (cut.models.empty() || !cut.has_phases() || cut.reference != strongest->reference ||
        cut.quantity() != strongest->quantity())
      continue;
    for (std::size_t i = 0; i < cut.places.size(); ++i) {
      const PairedCut::Place& place = cut.places[i];
      if (place.elevation_deg != highest->elevation_deg) continue;
      if (!is_monostatic(place)) return std::nullopt;
      values[{place.azimuth_deg, place.frequency_hz}] = {cut.amplitude_m[i], cut.models[0].amplitude_m[i]};
      azimuths.insert(place.azimuth_deg);
      frequencies.insert(place.frequency_hz);
    }
  }
  if (azimuths.size() < kFewestOfTurntable || frequencies.size() < kFewestOfTurntable ||
      values.size() != azimuths.size() * frequencies.size())
    return std::nullopt;
  TurntableEcho echo{{frequencies.begin(), frequencies.end()},
                     {azimuths.begin(), azimuths.end()},
                     highest->elevation_deg,
                     {},
                     static_cast<std::size_t>(strongest->element)};
  if (!are_uniform(echo.frequency_hz) || !are_uniform(echo.azimuth_deg)) return std::nullopt;
  ComparedTurntable turntable{strongest->reference, strongest->models[0].name, echo, echo};
  for (const auto& [place, both] : values) {
    turntable.reference.amplitude_m.push_back(both.first);
    turntable.compared.amplitude_m.push_back(both.second);
  }
  return turntable;
}

std::vector<Heatmap> turntable_pictures(const ComparedTurntable& turntable, const TurntableTarget& target) {
  constexpr std::size_t kMostNames = 10;
  const TurntableEcho& any = turntable.reference;
  const TurntableSampling sampling = turntable_sampling(any.frequency_hz, any.azimuth_deg, any.elevation_deg);
  std::optional<TurntableExtent> extent;
  if (target.mesh != nullptr) extent = turntable_extent(*target.mesh, any.azimuth_deg, any.elevation_deg);
  const TurntableExtent* known = extent ? &*extent : nullptr;
  const TurntableArea area = turntable_area(sampling, known);
  const Interval range = profiles_range(sampling, known);
  std::vector<std::string> notes;
  if (extent &&
      (extent->longest_range_m > sampling.range_window_m || extent->longest_cross_m > sampling.cross_window_m))
    notes.push_back(
        fmt::format("folded: the target is {:.4g} m by {:.4g} m", extent->longest_range_m, extent->longest_cross_m));
  notes.insert(notes.end(), target.notes.begin(), target.notes.end());

  struct Side {
    const TurntableEcho& echo;
    std::string name;
    const char* colour;
    TurntableImage image;
    TurntableProfiles profiles;
  };
  std::vector<Side> sides;
  double image_dbsm = kMinLevel_dbsm, profile_dbsm = kMinLevel_dbsm;
  for (const bool of_export : {true, false}) {
    const TurntableEcho& echo = of_export ? turntable.reference : turntable.compared;
    sides.push_back({echo, of_export ? turntable.reference_name : turntable.compared_name,
                     of_export ? kReferenceColour : kComputedColour, turntable_image(echo, area, target.threads),
                     turntable_profiles(echo, range)});
    image_dbsm = std::max(image_dbsm, std::ranges::max(sides.back().image.level_dbsm));
    profile_dbsm = std::max(profile_dbsm, std::ranges::max(sides.back().profiles.level_dbsm));
  }
  std::vector<Heatmap> pictures;
  for (const Side& side : sides) {
    const std::string title = fmt::format("{}: {}", side.name, kPolarisationNames[side.echo.element]);
    const bool is_computed = &side == &sides.back();
    pictures.push_back(turntable_figure(side.echo, side.image, target.mesh, {title, notes, image_dbsm}));
    pictures.push_back(profiles_figure(side.echo, side.profiles, {title, notes, profile_dbsm, side.colour},
                                       is_computed ? target.names : PeakNames(), kMostNames));
  }
  return pictures;
}

}  // namespace seaglint
