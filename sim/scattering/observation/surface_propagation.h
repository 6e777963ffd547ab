// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Propagation over the profile of the sea between radar and body: one-way field of a plane wave at low grazing angles,
// with shadowing, diffraction and multipath by the waves themselves.
//
// u is the component of the field normal to the plane of incidence: E of h, H of v, e^{+jwt}, x horizontal along the
// propagation, z up. Green's identity over the surface z = h(x) (upward normal n, G = -(j/4) H0(kR), H0 the Hankel
// function of the second kind) with Leontovich's condition du/dn = jk Z u gives for every point above the surface
//     u(r) = u_inc(r) + integral of u(r') (dG/dn' - jk Z G) ds'.
// Forward-going waves alone are kept: a point of the surface depends on those in front of it. That makes the equation
// on the surface one of Volterra, solved by one sweep over the profile; it is exact for the forward scattering of a
// surface (method of ordered multiple interactions, D. A. Kapp and G. S. Brown, IEEE Trans. AP 44 (1996)
// 711-722; D. Holliday, L. L. DeRaad and G. J. St-Cyr, ibid. 722-729; with the paraxial kernel it solves the parabolic
// equation exactly, E. I. Thorsos, J. Acoust. Soc. Am. 83 (1988) 78-92). The method needs no grid over height, no
// absorbing layer and no paraxial angles. The plane in front of the profile is a closed form (Fresnel integrals).

#include <array>
#include <functional>
#include <vector>

#include "sim/core/process/parallel.h"
#include "sim/scattering/observation/frequency_response.h"
#include "sim/scattering/observation/sea_reflection.h"

namespace seaglint {

// Elevation and slope at x = i step, i = 0..N, N > 24; the last sample is below the body. For x < 0 the surface is the
// plane z = 0, and at x = 0 elevation and slope are 0.
struct SurfaceProfile {
  double step_m = 0;
  std::vector<double> elevation_m, slope;  // along x
};

// Waves from the surface to the body fade between these slopes, which are steeper than the reflection by any wave that
// does not break.
inline constexpr std::array<double, 2> kSteepestRay{0.3, 0.5};

// Field of one plane wave over a profile.
class SurfaceField {
 public:
  // k: rad/m; sin_grazing: of the incident wave against z = 0, 0 < s < 0.25. `ripples` gives the local reflection
  // coefficient, with the roughness below the resolution of the profile; from it follows the surface impedance at the
  // local grazing angle, but not below that of the mean plane. `mean_plane`: reflection of the plane in front of the
  // profile. Cost: N^2/2 kernels.
  SurfaceField(SurfaceProfile profile, double k, double sin_grazing, const SeaReflection& ripples,
               const SeaReflectionCoefficients& mean_plane);

  // Total field above the last sample at height z over z = 0, relative to the incident wave at z = 0 there: without a
  // surface e^{jk z sin_grazing}. 0 below the surface.
  SeaReflectionCoefficients at(double height_m) const;

 private:
  struct Sources {  // of one polarisation: jk p = (du/dn) sqrt(1 + h'^2) and q = u at every sample, both parts
    std::vector<double> p_re, p_im, q_re, q_im;

    void append(const Complex& p, const Complex& q);
    Complex p(std::size_t i) const { return {p_re[i], p_im[i]}; }
    Complex q(std::size_t i) const { return {q_re[i], q_im[i]}; }
  };
  struct Stretch {  // samples with their sources
    SurfaceProfile profile;
    Sources h, v;
  };
  // Integral of the sources of the first `end` samples at height z, `gap` steps behind the last of them; with a gap of
  // more than 1 it ends at that sample, else it goes on to the point. limited: kSteepestRay applies.
  SeaReflectionCoefficients integral(const Stretch& stretch, std::size_t end, std::size_t gap, double height_m,
                                     bool limited) const;
  // Incident wave and field of the plane in front of the profile, at height z over sample i >= 1.
  SeaReflectionCoefficients incident(std::size_t i, double height_m) const;
  SeaReflectionCoefficients above_surface(double height_m) const;

  double k_, sin_grazing_, excess_;  // excess: 1 - cos(grazing)
  SeaReflectionCoefficients mean_plane_;
  std::vector<double> weight_, first_weight_;  // product integration of 1/sqrt(x), by distance in steps
  Stretch whole_, fine_;                       // fine: the end of the profile before the body in smaller steps
};

// A body over the waves of an interval.
struct BodyOverWaves {
  std::function<Vec3(double time_s)> centre;  // phase centre, target frame
  double half_height_m = 0;                   // of the heights over which it scatters, about its centre
  double range_m = 0;                         // of the radar from the origin of the target frame; 0: far field
};

// One-way amplitudes of the direct wave and of the wave from the radar's image at a body, in the place of 1 and rho:
// the field about the body's centre is direct e^{jk r.x} + image e^{jk r'.x}. Both are fitted to the field over the
// waves at two heights, half of half_height_m above and below the centre; S(a, b) of four paths then includes the
// vertical variation of the field over the body.
class OneWayAmplitudes {
 public:
  // Fields are computed at times at most kNodeInterval_s apart and at frequencies at most kNodeInterval_hz apart, and
  // interpolated by cubic polynomials. sea.waves() must not be null. Equal bits for any number of threads. Throws
  // Interrupted when *stop becomes true.
  OneWayAmplitudes(const SeaReflection& sea, const BodyOverWaves& body, const IntervalSampling& sampling,
                   const Vec3& r_hat, int threads = 1, const StopFlag* stop = nullptr);
  static constexpr double kNodeInterval_s = 0.025;
  static constexpr double kNodeInterval_hz = 300e6;

  OneWayPaths at(int pulse, int b) const;

 private:
  struct Place {  // of a time or frequency: weights of the nodes from `first` on
    std::size_t first = 0;
    std::vector<double> weights;
  };
  // On the cubic polynomial through the four nearest of the ascending nodes; through all of fewer.
  static Place place_of(const std::vector<double>& nodes, double x);
  static constexpr double kLeastFit_m = 0.02;  // half of the distance of the two heights

  std::size_t frequencies_ = 1;     // nodes
  std::vector<Place> in_time_;      // [pulse]
  std::vector<Place> in_band_;      // [frequency of the grid]
  std::vector<int> pulse_first_;    // [pulse]
  std::vector<OneWayPaths> nodes_;  // [time][frequency]
};

// Length of the profile in front of a body whose top is top_m above z = 0: 1.5 times the distance over which a crest
// of the significant height can shadow it or reflect to it, and 50 m; within 100 and 600 m.
double profile_length_m(double significant_wave_height_m, double top_m, double sin_grazing);

// Step of a profile, m: six wavelengths, at most 0.2 m.
double profile_step_m(double k);

}  // namespace seaglint
