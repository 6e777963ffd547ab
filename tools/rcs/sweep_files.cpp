// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/sweep_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "classify/dataset/format/npz.h"
#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/field_export/write_cst.h"
#include "sim/field_export/write_feko.h"
#include "sim/field_export/write_pyaedt.h"

namespace seaglint {

namespace {

NpzArray doubles(const char* name, const std::vector<double>& values) {
  return npz_array(name, "<f8", {values.size()}, bytes_of_values(std::span<const double>(values)));
}

// The cuts of all four elements, by transmitter.
std::vector<std::span<const RcsCut>> by_transmitter(const std::vector<RcsCut>& cuts) {
  std::vector<std::span<const RcsCut>> groups;
  for (std::size_t first = 0; first < cuts.size(); first += 4) groups.emplace_back(cuts.data() + first, 4);
  return groups;
}

void write_matrices(const std::vector<RcsCut>& cuts, const std::filesystem::path& file) {
  std::vector<double> frequency, azimuth, elevation, transmit_azimuth, transmit_elevation;
  std::vector<Complex> matrices;
  for (const std::span<const RcsCut> group : by_transmitter(cuts)) {
    const DeclaredTransmitter& transmitter = *group[0].transmitter;
    for (std::size_t i = 0; i < group[0].values.size(); ++i) {
      const FieldValue& place = group[0].values[i];
      frequency.push_back(place.frequency_hz);
      azimuth.push_back(place.phi_deg);
      elevation.push_back(90 - place.theta_deg);
      transmit_azimuth.push_back(transmitter.is_monostatic ? azimuth.back() : transmitter.phi_deg);
      transmit_elevation.push_back(transmitter.is_monostatic ? elevation.back() : 90 - transmitter.theta_deg);
      for (const RcsCut& element : group) matrices.push_back(*element.values[i].amplitude_m);
    }
  }
  const nlohmann::ordered_json description{
      {"program", fmt::format("seaglint {}", kVersion)},
      {"S", "m, [value][received h, v][transmitted h, v]; e^{+jwt}, phase origin at the body's origin"},
      {"frequency_hz", "Hz"},
      {"azimuth_deg, elevation_deg", "deg, of the receiver in the body's frame"},
      {"transmit_azimuth_deg, transmit_elevation_deg", "deg, of the transmitter"}};
  write_npz(file,
            {doubles("frequency_hz", frequency), doubles("azimuth_deg", azimuth), doubles("elevation_deg", elevation),
             doubles("transmit_azimuth_deg", transmit_azimuth), doubles("transmit_elevation_deg", transmit_elevation),
             npz_array("S", "<c16", {frequency.size(), 2, 2}, bytes_of_values(std::span<const Complex>(matrices)))},
            {{"description.json", description.dump(2) + "\n"}});
}

DeclaredTransmitter transmitter_of(const RcsSweep& sweep) {
  if (!sweep.transmitter) return {};
  const Vec3& t = *sweep.transmitter;
  DeclaredTransmitter transmitter{false, degrees(std::acos(std::clamp(t.z(), -1.0, 1.0))),
                                  degrees(std::atan2(t.y(), t.x()))};
  fold_direction(transmitter.theta_deg, transmitter.phi_deg);
  return transmitter;
}

}  // namespace

void require_export_formats(const std::vector<std::string>& formats, bool is_bistatic) {
  if (is_bistatic && std::find(formats.begin(), formats.end(), "pyaedt") != formats.end())
    throw InputError("--export-as pyaedt: these files hold monostatic values only");
}

void append_cuts(const RcsSweep& sweep, std::vector<RcsCut>& cuts) {
  const DeclaredTransmitter transmitter = transmitter_of(sweep);
  auto group =
      std::find_if(cuts.begin(), cuts.end(), [&](const RcsCut& cut) { return cut.transmitter == transmitter; });
  if (group == cuts.end()) {
    group = cuts.insert(cuts.end(), 4, RcsCut{});
    for (std::ptrdiff_t element = 0; element < 4; ++element) {
      group[element].element = static_cast<Polarisation>(element);
      group[element].transmitter = transmitter;
    }
  }
  for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
    for (std::size_t view = 0; view < sweep.views(); ++view) {
      FieldValue value{sweep.frequency_hz[q], 90 - sweep.elevation_of(view), sweep.azimuth_of(view), 0, {}, 0};
      fold_direction(value.theta_deg, value.phi_deg);
      for (std::size_t element = 0; element < 4; ++element) {
        const Complex s = sweep.models.back().matrices[view][q][element];
        value.level_dbsm = std::max(dbsm(s), kMinLevel_dbsm);
        value.amplitude_m = s;
        group[static_cast<std::ptrdiff_t>(element)].values.push_back(value);
      }
    }
  }
}

std::vector<std::filesystem::path> write_cuts_as(const std::string& format, const std::vector<RcsCut>& cuts,
                                                 const std::filesystem::path& folder, const std::string& stem) {
  std::vector<std::filesystem::path> files;
  const auto write = [&](const std::string& name, const std::string& bytes) {
    files.push_back(folder / name);
    write_file(files.back(), bytes);
  };
  for (const bool transmitted_v : {true, false}) {
    if (format == "feko") write(stem + (transmitted_v ? "_v.ffe" : "_h.ffe"), feko_text(cuts, transmitted_v));
    if (format != "cst") continue;
    for (const NamedFile& file : cst_texts(cuts, transmitted_v, stem)) write(file.name, file.text);
  }
  if (format == "npz") {
    files.push_back(folder / (stem + ".npz"));
    write_matrices(cuts, files.back());
  }
  for (const RcsCut& cut : cuts) {
    if (format != "pyaedt") break;
    std::string element = kPolarisationNames[static_cast<std::size_t>(cut.element)];
    for (char& c : element) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    const std::string name = fmt::format("{} {}", stem, element);
    const PyaedtPair pair = pyaedt_pair(cut, name);
    write(name + ".h5", pair.table);
    write(name + ".json", pair.json);
  }
  return files;
}

}  // namespace seaglint
