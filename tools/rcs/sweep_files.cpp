// SPDX-License-Identifier: BSD-3-Clause
#include "tools/rcs/sweep_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/file.h"
#include "sim/field_export/write_cst.h"
#include "sim/field_export/write_feko.h"
#include "sim/field_export/write_pyaedt.h"

namespace seaglint {

std::vector<RcsCut> cuts_of_sweep(const RcsSweep& sweep) {
  DeclaredTransmitter transmitter;
  if (sweep.transmitter) {
    const Vec3& t = *sweep.transmitter;
    transmitter = {false, degrees(std::acos(std::clamp(t.z(), -1.0, 1.0))), degrees(std::atan2(t.y(), t.x()))};
    fold_direction(transmitter.theta_deg, transmitter.phi_deg);
  }
  std::vector<RcsCut> cuts;
  for (std::size_t element = 0; element < 4; ++element) {
    RcsCut& cut = cuts.emplace_back();
    cut.element = static_cast<Polarisation>(element);
    cut.transmitter = transmitter;
    for (std::size_t q = 0; q < sweep.frequency_hz.size(); ++q) {
      for (std::size_t view = 0; view < sweep.views(); ++view) {
        const Complex s = sweep.models.back().matrices[view][q][element];
        FieldValue value{sweep.frequency_hz[q],
                         90 - sweep.elevation_of(view),
                         sweep.azimuth_of(view),
                         std::max(dbsm(s), kMinLevel_dbsm),
                         s,
                         0};
        fold_direction(value.theta_deg, value.phi_deg);
        cut.values.push_back(value);
      }
    }
  }
  return cuts;
}

std::vector<std::filesystem::path> write_sweep_as(const std::string& format, const RcsSweep& sweep,
                                                  const std::filesystem::path& table) {
  const std::vector<RcsCut> cuts = cuts_of_sweep(sweep);
  const std::filesystem::path folder = table.parent_path();
  const std::string stem = table.stem().string();
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
