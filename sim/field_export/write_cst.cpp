// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_export/write_cst.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/field_export/received_pair.h"

namespace seaglint {
namespace {

constexpr double kFloor_dbsm = -200;

double level(const Complex& s) { return std::max(dbsm(s), kFloor_dbsm); }

double phase_deg(const Complex& s) {
  const double phase = degrees(std::arg(s));
  return phase < 0 ? phase + 360 : phase;
}

// Ratio of the axes of the ellipse of polarisation, in dB; at most 40, as CST has it.
double axial_ratio_db(const Complex& theta, const Complex& phi) {
  const double sum = std::norm(theta) + std::norm(phi), difference = std::abs(theta * theta + phi * phi);
  constexpr double kMost_db = 40;
  if (sum <= difference) return kMost_db;
  return std::min(10 * std::log10((sum + difference) / (sum - difference)), kMost_db);
}

// Polarisation h or v is transmitted along phi^ or theta^ = -v.
std::string row(const ReceivedPair& pair, std::size_t n, bool transmitted_v) {
  const Complex theta = transmitted_v ? pair.s_v(n) : -pair.s_v(n);
  const Complex phi = transmitted_v ? -pair.s_h(n) : pair.s_h(n);
  const double total = std::max(dbsm_of_area(4 * kPi * (std::norm(theta) + std::norm(phi))), kFloor_dbsm);
  const FieldValue& place = pair.places()[n];
  return fmt::format("{:14.9f}{:17.9f}{:21.9e}{:20.9e}{:20.9f}{:20.9e}{:20.9f}{:20.3e}     \r\n", place.theta_deg,
                     place.phi_deg, total, level(theta), phase_deg(theta), level(phi), phase_deg(phi),
                     axial_ratio_db(theta, phi));
}

// `(first,last,step)` of the angles that a sweep has.
std::string range(const std::set<double>& angles) {
  const double first = *angles.begin(), last = *angles.rbegin();
  const double step = angles.size() > 1 ? (last - first) / static_cast<double>(angles.size() - 1) : 1;
  return fmt::format("({:.9g},{:.9g},{:.9g})", first, last, step);
}

std::string incidence(const DeclaredTransmitter& transmitter, const std::set<double>& thetas,
                      const std::set<double>& phis) {
  if (transmitter.is_monostatic) return fmt::format("theta = {}, phi = {}", range(thetas), range(phis));
  return fmt::format("theta = {:.9g}, phi = {:.9g}", transmitter.theta_deg, transmitter.phi_deg);
}

}  // namespace

std::vector<NamedFile> cst_texts(std::span<const RcsCut> cuts, bool transmitted_v, const std::string& stem) {
  std::vector<NamedFile> texts;
  for (const ReceivedPair& pair : received_pairs(cuts, transmitted_v, "a table of CST")) {
    const std::vector<FieldValue>& values = pair.places();
    std::map<double, std::vector<std::size_t>> by_frequency;
    for (std::size_t n = 0; n < values.size(); ++n) by_frequency[values[n].frequency_hz].push_back(n);
    for (auto& [frequency_hz, places] : by_frequency) {
      std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(values[a].phi_deg, values[a].theta_deg) < std::pair(values[b].phi_deg, values[b].theta_deg);
      });
      std::set<double> thetas, phis;
      std::string text =
          "Theta [deg.]  Phi   [deg.]  Abs(RCS )[dB(m^2)]   Abs(Theta)[dB(m^2)]  Phase(Theta)[deg.]  "
          "Abs(Phi  )[dB(m^2)]  Phase(Phi  )[deg.]  Ax.Ratio[dB    ]    \r\n" +
          std::string(150, '-') + "\r\n";
      for (const std::size_t n : places) {
        thetas.insert(values[n].theta_deg);
        phis.insert(values[n].phi_deg);
        text += row(pair, n, transmitted_v);
      }
      texts.push_back({fmt::format("{} (f = {:.12g}), {}, {}.txt", stem, frequency_hz * 1e-9,
                                   incidence(pair.transmitter(), thetas, phis), transmitted_v ? "VP" : "HP"),
                       std::move(text)});
    }
  }
  return texts;
}

}  // namespace seaglint
