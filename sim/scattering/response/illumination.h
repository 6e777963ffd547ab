// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shooting and bouncing rays, with polygons in place of rays: a beam is a bundle of parallel rays, a tree finds the
// facets it may meet, and the polygons of those facets measure exactly what is lit and seen (sim/scattering/README.md).
// The result holds for every frequency.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/beams/contribution_filter.h"
#include "sim/scattering/beams/visible_surface.h"
#include "sim/scattering/edges/single_diffraction.h"
#include "sim/scattering/material/material.h"
#include "sim/scattering/surfaces/footprint.h"
#include "sim/scattering/target/scatterer.h"
#include "sim/scenario/target_spec.h"

namespace seaglint {

struct IlluminationSettings {
  // The detail that counts, as the spacing of rays that would find it: lit pieces with a side below a fourteenth are
  // left out, and beams below a quarter of it are not followed to further mirrors. 0 or coarser than
  // default_ray_spacing: that.
  double ray_spacing_m = 0;
  int max_bounces = kDefaultBounces;  // 1 <= x <= kMostBounces
  bool edges = false;                 // follow the waves that reach sharp edges too
  EchoFilter filter = {};             // which echoes are summed; all are followed but those into cavities
  // of the radar, 0 = far field; else beyond ten times the target's reach from where it is counted
  double range_m = 0;
  Vec3 origin = Vec3::Zero();  // where the target's frame stands from the point that range_m is counted from, m
};

// 1e-3 of the radius: 0.07 m on the 144 m ship, pieces of 5 mm (README.md).
double default_ray_spacing(const Scatterer& scatterer);

// The spacing whose detail counts: that of the settings, or the default one where that is finer.
double ray_spacing(const Scatterer& scatterer, const IlluminationSettings& settings);

// A tenth of what the smallest lit piece that counts returns, k area / 2 pi, m: ends of currents and edge waves below
// may be left out. Together they are -65 dB of the ship's echo.
double faintest_echo(const Scatterer& scatterer, const IlluminationSettings& settings, double k);

// What the beams that leave one facet, or several, meet.
struct Lit {
  std::vector<Footprint> footprints;
  std::vector<EdgeArrival> arrivals;     // only when the settings ask for edges, as are
  std::vector<EdgeFootprint> beam_ends;  // what physical optics lacks where beams end
};

// The same of one panel, as far as it is told at once: edges answer when all has reached them.
struct PanelEchoes {
  std::span<const Footprint> footprints;
  std::span<const EdgeFootprint> beam_ends;
};

struct BeamScene;

// The waves that reached sharp edges, and the number of legs followed, a beam's way from one mirror to the next.
struct Reached {
  ArrivalsByEdge arrivals;
  std::size_t legs = 0;
};

// What one direction lights and another (or the same) sees. The constructor finds what the radar sees of every facet;
// light() follows the beams that leave one facet. Facets are independent and may be lit in any order by any thread.
class Illumination {
 public:
  // wavenumbers: those at which materials are evaluated and what is faint is left out. A perfect conductor needs none,
  // and all of it counts then.
  Illumination(const Scatterer& scatterer, const AntennaPair& antennas, const IlluminationSettings& settings,
               int threads = 1, std::span<const double> wavenumbers = {});

  // Panels the transmitter sees, by the facets they go by, ascending.
  std::span<const int> seen() const { return seen_; }

  // Lights everything chunk by chunk of panels, on `threads` threads: visit(chunk, echoes) gets what each chunk lights,
  // panel by panel in order, from one thread or another, without what the settings' filter leaves out and the ends of
  // beams that are faint at the illumination's wavenumbers. Chunks do not depend on the number of threads. Throws
  // Interrupted when *stop becomes true.
  std::size_t chunk_count() const;
  Reached light_all(int threads, const std::function<void(std::size_t, const PanelEchoes&)>& visit,
                    const StopFlag* stop = nullptr) const;

  // Appends what all beams light whose first mirror is the panel of one of these facets, their own first bounce
  // included; returns the legs followed.
  std::size_t light(int facet, Lit& lit) const { return light({&facet, 1}, lit); }
  std::size_t light(std::span<const int> facets, Lit& lit) const;

 private:
  std::size_t panels_per_chunk() const;
  BeamScene scene() const;

  const Scatterer& scatterer_;
  AntennaPair antennas_;
  IlluminationSettings settings_;
  double min_area_;
  VisibleSurface lit_;                                // seen from the transmitter
  std::optional<VisibleSurface> seen_from_receiver_;  // where that is another direction
  std::vector<int> seen_;
  std::vector<std::vector<Surface>> surfaces_;  // [material][wavenumber]; none for a perfect conductor
  double lowest_ = 0, highest_ = 0;             // of the wavenumbers; 0: there are none
};

}  // namespace seaglint
