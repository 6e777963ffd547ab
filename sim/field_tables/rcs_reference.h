// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Radar cross-section cuts from measurements or other solvers, read from their files and converted to the conventions
// of CONVENTIONS.md.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/field_tables/reference_sample.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

// Properties that a file does not state itself, and the relation of its angles to those of the body.
struct ReferenceSettings {
  std::optional<Polarisation> element;  // absent: from the file name, `.H.` is hh and `.V.` is vv (Austin suite)
  std::optional<double> frequency_hz;   // of a file without frequencies
  double phi_scale = 1;                 // phi of the file = phi_scale * azimuth + phi_offset_deg
  double phi_offset_deg = 0;
  Vec3 origin_m = Vec3::Zero();  // the file's phase origin, body frame
};

// Transmitter direction that a file states, in the file's angles.
struct DeclaredTransmitter {
  bool is_monostatic = true;  // monostatic: transmitter at the receiver, angles unused
  double theta_deg = 0, phi_deg = 0;
};

struct RcsReference {
  std::string name;  // file name without its folder
  Polarisation element = Polarisation::kHh;
  ReferenceSettings settings;
  std::vector<ReferenceSample> samples;
  std::optional<DeclaredTransmitter> transmitter;  // absent if the file does not state it
  bool has_phase() const { return !samples.empty() && samples.front().amplitude_m.has_value(); }
};

// Reads one of these formats, recognised by the content (text tables: sim/core/text/text_table.h):
//   four columns without names: frequency in Hz, theta, phi in degrees, dBsm (Austin RCS Benchmark Suite), or named
//   frequency_hz (_ghz, _mhz), theta_deg, phi_deg, dbsm in any order; the table of `seaglint rcs` (columns by name;
//   xx_re and xx_im, or xx_dbsm alone; its head gives the transmitter);
//   a CST farfield table of the RCS: columns by their squeezed names, `Theta[deg.] Phi[deg.] Abs(Theta)[unit]
//   Phase(Theta)[deg.] ...`, v received = Theta, h received = Phi, units m^2, mm^2, lambda^2 or dB() of them; no
//   frequency inside. Theta below 0 is folded (|theta|, phi + 180, sign of both unit vectors changed). e^{+jwt}; theta^
//   = -v, phi^ = h, so cross-polar terms change sign.
// Throws InputError naming the file, the line, what is missing and the format that was recognised, the transmitter in
// the head of a table of `seaglint rcs` included, and where settings.frequency_hz differs from the file's frequency.
RcsReference read_reference(const std::filesystem::path& file, const ReferenceSettings& settings);

}  // namespace seaglint
