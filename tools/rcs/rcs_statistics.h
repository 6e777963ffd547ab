// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Statistics of the radar cross section over the views and frequencies of sectors of azimuth: of the whole target and
// of each of its parts, as a table and as text.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "sim/scattering/scatterer/scatterer.h"
#include "tools/rcs/rcs_request.h"

namespace seaglint {

// Cross-sections of one group, m^2. Percentiles are those of quantile(), linear between the values in ascending order;
// the mean is that of the values.
struct AreaStatistics {
  std::size_t values = 0;
  double p5_m2 = 0, p25_m2 = 0, median_m2 = 0, p75_m2 = 0, p95_m2 = 0;
  double mean_m2 = 0, largest_m2 = 0;
};

AreaStatistics area_statistics(std::vector<double> areas_m2);  // NaN without values

// Sectors are centred on 0, sector_deg, 2 sector_deg, ... Each has its lower bound, not its upper one; bounds count as
// equal within 1e-9 of a sector. The default is 30: the bow has -15 <= azimuth < 15.
inline constexpr double kSector_deg = 30, kNarrowestSector_deg = 0.1;

// Number of sectors. Throws InputError unless the width is within 0.1 and 360 deg and divides 360.
std::size_t sector_count(double sector_deg);
// Number of the sector that has an azimuth of any turn.
std::size_t sector_of(double azimuth_deg, double sector_deg);

// One element of the matrix over one sector.
struct SectorStatistics {
  std::optional<std::uint16_t> part;     // of the mesh, its own coherent sum (RcsSweep::parts); absent: the whole
  std::size_t element = 0;               // of hh, hv, vh, vv
  std::optional<std::size_t> elevation;  // of the sweep's; absent: all together
  std::optional<std::size_t> sector;     // absent: all azimuths together
  std::size_t views = 0;
  AreaStatistics area;
};

struct RcsStatistics {
  std::vector<double> frequency_hz, elevation_deg;
  double sector_deg = kSector_deg;
  std::size_t azimuths = 0;  // different directions
  std::vector<SectorStatistics> rows;
};

// The whole target first, then the parts of sweep.parts; elevations and sectors in their order, then all. Sectors
// without views have no row. Every value has the same weight. Azimuths a turn apart (0 and 360 deg) are one view. A
// part has the value 0 where nothing of it contributes. Throws InputError as sector_count().
RcsStatistics rcs_statistics(const RcsSweep& sweep, double sector_deg = kSector_deg);

// Whether a sweep of the request has statistics by part: more than one part, and at most 8 million rows times parts
// (256 MB).
bool has_statistics_by_part(const RcsRequest& request, const TriangleMesh& mesh);

// Step of the azimuths beside the narrowest lobe, which is the distance of independent values.
struct AzimuthSampling {
  double step_deg = 0;  // the widest; 0: one azimuth
  double lobe_deg = 0;
  double extent_m = 0;       // D, the diagonal of the mesh's horizontal bounding box
  bool is_bistatic = false;  // one antenna is fixed
  double highest_hz = 0;
};

// Two scatterers D apart across the line of sight differ by the two-way phase 2 k D sin(azimuth), 2 pi per lambda / 2D;
// with one antenna fixed by k D sin(azimuth), 2 pi per lambda / D. The lobe is that of the highest frequency.
AzimuthSampling azimuth_sampling(const RcsRequest& request, const TriangleMesh& mesh);

// If the step is wider than the lobe: a sentence with the step that has two values per lobe. None below kFewestDrawn
// azimuths.
std::optional<std::string> lobe_warning(const RcsRequest& request, const TriangleMesh& mesh);

// Step, lobe, and how many values of a sector are independent: every view where the step is not finer than the lobe,
// else one per lobe.
std::string sampling_text(const RcsStatistics& statistics, const AzimuthSampling& sampling);

// Of a step more than ten lobes wide with less than kFewestViews views in a sector.
inline constexpr std::size_t kFewestViews = 30;
std::optional<std::string> sampling_warning(const RcsStatistics& statistics, const AzimuthSampling& sampling);

// CSV below rcs_heading(): a row per part, element, elevation and sector, levels in dBsm.
std::string statistics_csv(const RcsStatistics& statistics, const std::string& heading,
                           std::span<const std::string> part_names);

// hh and vv over all elevations: at most 24 sectors, and the ten parts of the highest mean.
std::string statistics_table(const RcsStatistics& statistics, std::span<const std::string> part_names);

}  // namespace seaglint
