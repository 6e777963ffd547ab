// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Scattering amplitudes or the radar cross section over direction and frequency, from a measurement or another solver,
// in the signs of CONVENTIONS.md but about the file's own phase origin and in its own azimuths.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/scenario/radar_spec.h"

namespace seaglint {

inline constexpr const char* kPolarisationNames[] = {"hh", "hv", "vh", "vv"};

constexpr bool transmits_v(Polarisation element) {
  return element == Polarisation::kHv || element == Polarisation::kVv;
}
constexpr bool receives_v(Polarisation element) { return element == Polarisation::kVh || element == Polarisation::kVv; }
constexpr bool is_cross(Polarisation element) { return transmits_v(element) != receives_v(element); }
// The element of this receiver and transmitter.
constexpr Polarisation element_of(bool received_v, bool transmitted_v) {
  return static_cast<Polarisation>(2 * static_cast<int>(received_v) + static_cast<int>(transmitted_v));
}

// What a cut can hold: an element of the scattering matrix, or for one polarisation transmitted the level of the sum
// over both received, |S_hq|^2 + |S_vq|^2 (the total cross section of HFSS and CST).
inline constexpr std::size_t kQuantities = 6;
inline constexpr const char* kQuantityNames[kQuantities] = {"hh", "hv", "vh", "vv", "total_h", "total_v"};

// `element` of a total: that of its co-polar part, hh or vv.
constexpr std::size_t quantity_of(Polarisation element, bool is_total) {
  return is_total ? 4 + static_cast<std::size_t>(transmits_v(element)) : static_cast<std::size_t>(element);
}
constexpr bool is_total(std::size_t quantity) { return quantity >= 4; }
constexpr Polarisation element_of_quantity(std::size_t quantity) {
  return quantity < 4 ? static_cast<Polarisation>(quantity) : element_of(quantity == 5, quantity == 5);
}

struct FieldValue {
  double frequency_hz = 0;
  double theta_deg = 0;  // of the receiver, 0..180
  double phi_deg = 0;    // 0 <= x < 360
  double level_dbsm = 0;
  std::optional<Complex> amplitude_m;  // absent without a phase
  int line = 0;                        // of the file, from 1; 0: it has no lines
};

inline constexpr double kMinLevel_dbsm = -1000;  // of an exact zero

// Transmitter of a file, in its angles.
struct DeclaredTransmitter {
  bool is_monostatic = true;  // at the receiver; the angles are then unused
  double theta_deg = 0, phi_deg = 0;

  bool operator==(const DeclaredTransmitter& other) const {
    return is_monostatic == other.is_monostatic &&
           (is_monostatic || (theta_deg == other.theta_deg && phi_deg == other.phi_deg));
  }
};

// Direction of a transmitter that does not move with the receiver, in the angles of `seaglint rcs`.
struct FixedTransmitter {
  double azimuth_deg = 0, elevation_deg = 0;
  bool operator==(const FixedTransmitter&) const = default;
};

// The head line of a fixed transmitter in a table of `seaglint rcs`, `# transmitter_azimuth_deg=20
// transmitter_elevation_deg=3`; without one that of the monostatic case, `# transmitter=monostatic`. No line break.
std::string transmitter_line(const std::optional<FixedTransmitter>& transmitter);

// Properties that a file does not state itself, and the relation of its angles to those of the body.
struct FieldTableSettings {
  std::vector<Polarisation> elements;              // wanted ones; empty: all that the file or its name states
  std::optional<double> frequency_hz;              // of a file without frequencies
  std::optional<DeclaredTransmitter> transmitter;  // of a file without one
  std::optional<double> elevation_deg;             // of a table by azimuth without elevations; absent: 0
  double phi_scale = 1;                            // phi of the file = phi_scale * azimuth + phi_offset_deg
  double phi_offset_deg = 0;
  std::optional<Vec3> origin_m;  // the file's phase origin, body frame; absent: the file's own, else 0
};

// One element of the scattering matrix, or a total.
struct RcsCut {
  std::string name;  // file name without its folder
  Polarisation element = Polarisation::kHh;
  bool total = false;  // levels of the sum over both received polarisations; `element` is then hh or vv
  std::vector<FieldValue> values;
  std::optional<DeclaredTransmitter> transmitter;  // absent if neither file nor settings state it
  double phi_scale = 1, phi_offset_deg = 0;        // of the settings
  Vec3 origin_m = Vec3::Zero();                    // phase origin, body frame
  bool has_phase() const { return !values.empty() && values.front().amplitude_m.has_value(); }
  std::size_t quantity() const { return quantity_of(element, total); }
};

// A mesh of the model that an export was computed for, in a unit of read_mesh().
struct GeometryFile {
  std::filesystem::path file;
  std::string unit;

  bool operator==(const GeometryFile&) const = default;
};

// What one file holds.
struct FieldTable {
  std::string name;                    // file name without its folder
  std::string reader;                  // "a CST farfield table"
  std::vector<std::string> notes;      // how it was taken: conventions, and what is assumed or from its name
  std::vector<RcsCut> cuts;            // by quantity and transmitter; not empty, none without values
  std::vector<GeometryFile> geometry;  // that the file names and that exist; empty: none
};

// Reads a file whose format is recognised by its content (README.md). What neither the file nor its name states comes
// from the settings; a setting that contradicts the file is an error. Throws InputError naming the file, the line, what
// is missing and the format that was recognised, or why each format was not.
FieldTable read_field_table(const std::filesystem::path& file, const FieldTableSettings& settings);

// Whether read_field_table() recognises a file: HDF5 not, which the JSON of its pair reads, nor results of `seaglint
// compare`. False too where it cannot be read.
bool is_field_table(const std::filesystem::path& file);

// The cut of this quantity and transmitter, made where it is missing. It stays in place until another one is made.
RcsCut& cut_for(FieldTable& table, std::size_t quantity, const std::optional<DeclaredTransmitter>& transmitter);

// "NAME: read as READER; NOTE; ..." on one line.
std::string reading_of(const FieldTable& table);

// Throws InputError if no element is wanted, of a format that does not say which polarisation was transmitted.
void require_elements(const FieldTableSettings& settings, const std::string& file, const char* format);

// Whether v is transmitted, for a file that holds totals alone. Throws InputError unless the settings want both
// elements of one polarisation transmitted.
bool total_transmits_v(const FieldTableSettings& settings, const std::string& file, const char* format);
std::string total_note(bool transmitted_v);  // "total of both received polarisations, v transmitted"

// Maps a direction to theta 0..180, phi 0..360; true if theta was below 0 or above 180, on the other half of the great
// circle, where theta^ and phi^ both have the opposite sign.
bool fold_direction(double& theta_deg, double& phi_deg);

// A level at this direction of the file, without a phase.
FieldValue level_value(double frequency_hz, double theta_deg, double phi_deg, double level_dbsm, int line);

// A value at this direction of the file from the spherical component, theta^ or phi^, of the scattered field at 1 m
// (V/m; sigma = 4 pi |E|^2) for a field of 1 V/m transmitted along theta^ or phi^. theta^ = -v and phi^ = h, so that
// cross-polar elements change sign.
FieldValue field_value(Polarisation element, double frequency_hz, double theta_deg, double phi_deg, Complex component_m,
                       int line);

}  // namespace seaglint
