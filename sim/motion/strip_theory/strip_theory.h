// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Wave forces on a slender hull from the flow about its sections: strip theory of Salvesen, Tuck and Faltinsen (1970),
// without their terms for a submerged transom.

#include <array>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "sim/motion/strip_theory/section_radiation.h"

namespace seaglint {

// A wave eta = Re{e^{j(w t - k.x)}} of one metre, mu its direction of propagation in the frame of the ship. The
// wavenumber includes finite depth; pressure and radiated waves are those of deep water.
struct ShipWave {
  double omega = 0;       // rad/s, earth-fixed
  double wavenumber = 0;  // rad/m
  double mu = 0;          // rad
};

// Hydrostatic integrals about the origin (waterline amidships).
struct StripHydrostatics {
  double volume = 0;         // m^3
  double waterplane = 0;     // m^2
  double waterplane_x = 0;   // int x breadth dx, m^3
  double waterplane_xx = 0;  // int x^2 breadth dx, m^4
  double waterplane_yy = 0;  // int breadth^3/12 dx, m^4
  double buoyancy_x = 0;     // centre of the volume, m
  double buoyancy_z = 0;     // below 0
};

// Forces and moments about the origin, per metre of wave: N and N m.
struct ShipForces {
  Complex surge, sway, heave, roll, pitch, yaw;
};

class StripTheory {
 public:
  // Solves the radiation problem of every strip at kFrequencies up to K B/2 = kMaxHalfBeamNumber; about 0.2 s. Throws
  // InputError for a hull without breadth or draught.
  explicit StripTheory(const HullSections& hull);

  const StripHydrostatics& hydrostatics() const { return hydrostatics_; }

  // Force per displacement, w^2 A - j w B, at the encounter frequency w (rad/s, any sign) and speed (m/s): of (sway,
  // roll, yaw) and of (heave, pitch) about the origin, [force][displacement].
  struct Radiation {
    std::array<std::array<Complex, 3>, 3> lateral{};
    std::array<std::array<Complex, 2>, 2> vertical{};
  };
  Radiation radiation(double encounter, double speed) const;

  // Froude-Krylov plus diffraction force; zero for waves beyond the tabulated frequencies.
  ShipForces excitation(const ShipWave& wave, double speed) const;

  double highest_omega() const { return step_ * kFrequencies; }

  static constexpr int kFrequencies = 48;
  static constexpr double kMaxHalfBeamNumber = 12;

 private:
  struct Strip {
    double x = 0;
    double width = 0;
    Contour contour;                         // of the section
    Contour heave_contour, lateral_contour;  // of the Lewis forms used for the flow in heave, and in sway and roll
    // At each frequency: potentials of both flows, and int phi_k n_j dl for 22, 24, 44, 33.
    std::vector<SectionRadiation> radiation;
    std::vector<std::array<Complex, 4>> integrals;
  };
  static Strip solve(const HullSection& section, const LewisForm& form, double step);
  // Four neighbouring frequencies and their weights.
  struct Place {
    std::size_t first;
    std::array<double, 4> weight;
  };
  Place place(double omega) const;

  double step_ = 0;  // rad/s: the tables are at step_, 2 step_, ...
  StripHydrostatics hydrostatics_;
  std::vector<Strip> strips_;
};

}  // namespace seaglint
