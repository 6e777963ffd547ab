// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_export/write_feko.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/field_export/received_pair.h"

namespace seaglint {
namespace {

using Indices = std::vector<std::size_t>;  // values of one block

// The values by frequency, in the order of the frequencies' first values.
std::vector<Indices> by_frequency(const std::vector<FieldValue>& values) {
  std::vector<double> frequencies;
  std::vector<Indices> groups;
  for (std::size_t n = 0; n < values.size(); ++n) {
    const auto place = std::find(frequencies.begin(), frequencies.end(), values[n].frequency_hz);
    if (place == frequencies.end()) {
      frequencies.push_back(values[n].frequency_hz);
      groups.push_back({n});
    } else {
      groups[static_cast<std::size_t>(place - frequencies.begin())].push_back(n);
    }
  }
  return groups;
}

struct Samples {
  std::size_t theta = 1, phi = 1;
};

// The thetas and phis of the values; 1 and 1 unless every theta is with every phi once.
Samples samples_of(const std::vector<FieldValue>& values, const Indices& block) {
  std::set<double> thetas, phis;
  std::set<std::pair<double, double>> places;
  for (const std::size_t n : block) {
    thetas.insert(values[n].theta_deg);
    phis.insert(values[n].phi_deg);
    places.emplace(values[n].theta_deg, values[n].phi_deg);
  }
  const bool is_grid = places.size() == block.size() && thetas.size() * phis.size() == block.size();
  return is_grid ? Samples{thetas.size(), phis.size()} : Samples{};
}

std::string head(double frequency_hz, double theta_deg, double phi_deg, const Samples& samples) {
  return fmt::format(
      "\n#Configuration Name: StandardConfiguration1\n#Request Name: FarField1\n#Frequency:   {:.8E}\n"
      "#Coordinate System: Spherical\n#No. of Theta Samples: {}\n#No. of Phi Samples: {}\n#Result Type: RCS\n"
      "#Incident Wave Direction: (  {:.8E},  {:.8E})\n#No. of Header Lines: 1\n"
      "#       \"Theta\"             \"Phi\"           \"Re(Etheta)\"       \"Im(Etheta)\"        \"Re(Ephi)\"      "
      "   \"Im(Ephi)\"        \"RCS(Theta)\"        \"RCS(Phi)\"        \"RCS(Total)\"  \n",
      frequency_hz, samples.theta, samples.phi, theta_deg, phi_deg);
}

std::string row(const ReceivedPair& pair, std::size_t n) {
  const Complex theta = -pair.s_v(n), phi = pair.s_h(n);
  const double theta_m2 = 4 * kPi * std::norm(theta), phi_m2 = 4 * kPi * std::norm(phi);
  std::string text;
  for (const double x : {pair.places()[n].theta_deg, pair.places()[n].phi_deg, theta.real(), theta.imag(), phi.real(),
                         phi.imag(), theta_m2, phi_m2, theta_m2 + phi_m2})
    text += fmt::format("{:19.8E}", x);
  return text + "\n";
}

// A block of one receiver with this transmitter.
std::string single(const ReceivedPair& pair, std::size_t n, double theta_deg, double phi_deg) {
  return head(pair.places()[n].frequency_hz, theta_deg, phi_deg, {}) + row(pair, n);
}

}  // namespace

std::string feko_text(std::span<const RcsCut> cuts, bool transmitted_v) {
  const std::vector<ReceivedPair> pairs = received_pairs(cuts, transmitted_v, "a .ffe");
  std::string text = "##File Type: Far field\n##File Format: 4\n##Source: seaglint\n** File exported by seaglint\n\n";
  for (const ReceivedPair& pair : pairs) {
    const std::vector<FieldValue>& values = pair.places();
    const DeclaredTransmitter& transmitter = pair.transmitter();
    for (Indices& block : by_frequency(values)) {
      if (transmitter.is_monostatic) {
        for (const std::size_t n : block) text += single(pair, n, values[n].theta_deg, values[n].phi_deg);
        continue;
      }
      const Samples samples = samples_of(values, block);
      if (samples.theta * samples.phi != block.size()) {
        for (const std::size_t n : block) text += single(pair, n, transmitter.theta_deg, transmitter.phi_deg);
        continue;
      }
      std::stable_sort(block.begin(), block.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(values[a].phi_deg, values[a].theta_deg) < std::pair(values[b].phi_deg, values[b].theta_deg);
      });
      text += head(values[block[0]].frequency_hz, transmitter.theta_deg, transmitter.phi_deg, samples);
      for (const std::size_t n : block) text += row(pair, n);
    }
  }
  return text;
}

}  // namespace seaglint
