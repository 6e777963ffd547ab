// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_export/field_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

const char* name_of(Polarisation element) { return kPolarisationNames[static_cast<int>(element)]; }

// Both elements of one transmitted polarisation.
struct ReceivedPair {
  const RcsCut* v = nullptr;
  const RcsCut* h = nullptr;

  const DeclaredTransmitter& transmitter() const { return *v->transmitter; }
  const std::vector<FieldValue>& places() const { return v->values; }
  // S in metres of a value, about the phase origin and in the directions of the cut.
  Complex s_v(std::size_t n) const { return *v->values[n].amplitude_m; }
  Complex s_h(std::size_t n) const { return *h->values[n].amplitude_m; }
};

bool same_place(const FieldValue& a, const FieldValue& b) {
  return a.frequency_hz == b.frequency_hz && a.theta_deg == b.theta_deg && a.phi_deg == b.phi_deg;
}

// Throws InputError "FORMAT needs phases" etc. unless the cut has values, phases and a transmitter.
void require_complete(const RcsCut& cut, const char* format) {
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("{} needs {}: {} has none", format, what, name_of(cut.element)));
  };
  if (cut.values.empty()) fail("values");
  if (!cut.transmitter) fail("a transmitter");
  if (!std::all_of(cut.values.begin(), cut.values.end(), [](const FieldValue& value) { return value.amplitude_m; }))
    fail("phases");
}

// The pairs of the cuts with this transmitted polarisation, one per transmitter. Throws InputError "FORMAT needs ..."
// if there is none, an element is missing or has other directions and frequencies, no phase or no transmitter.
std::vector<ReceivedPair> received_pairs(std::span<const RcsCut> cuts, bool transmitted_v, const char* format) {
  const Polarisation of_v = element_of(true, transmitted_v), of_h = element_of(false, transmitted_v);
  std::vector<ReceivedPair> pairs;
  for (const RcsCut& v : cuts) {
    if (v.element != of_v) continue;
    require_complete(v, format);
    const auto h = std::find_if(cuts.begin(), cuts.end(), [&](const RcsCut& other) {
      return other.element == of_h && other.transmitter && *other.transmitter == *v.transmitter;
    });
    if (h == cuts.end()) break;
    require_complete(*h, format);
    if (!std::equal(v.values.begin(), v.values.end(), h->values.begin(), h->values.end(), same_place)) {
      throw InputError(fmt::format("{} needs {} and {} at the same directions and frequencies", format, name_of(of_v),
                                   name_of(of_h)));
    }
    pairs.push_back({&v, &*h});
  }
  const auto of = [&](Polarisation element) {
    return std::count_if(cuts.begin(), cuts.end(), [&](const RcsCut& cut) { return cut.element == element; });
  };
  const auto count = static_cast<std::ptrdiff_t>(pairs.size());
  if (count == 0 || of(of_v) != count || of(of_h) != count)
    throw InputError(fmt::format("{} needs both {} and {}", format, name_of(of_v), name_of(of_h)));
  return pairs;
}

using Indices = std::vector<std::size_t>;  // values of one block

// Theta fastest.
void sort_by_direction(const std::vector<FieldValue>& values, Indices& block) {
  std::stable_sort(block.begin(), block.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(values[a].phi_deg, values[a].theta_deg) < std::pair(values[b].phi_deg, values[b].theta_deg);
  });
}

// The values by frequency, in the order of the frequencies' first values.
std::vector<Indices> blocks_by_frequency(const std::vector<FieldValue>& values) {
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

std::string feko_head(double frequency_hz, double theta_deg, double phi_deg, const Samples& samples) {
  return fmt::format(
      "\n#Configuration Name: StandardConfiguration1\n#Request Name: FarField1\n#Frequency:   {:.8E}\n"
      "#Coordinate System: Spherical\n#No. of Theta Samples: {}\n#No. of Phi Samples: {}\n#Result Type: RCS\n"
      "#Incident Wave Direction: (  {:.8E},  {:.8E})\n#No. of Header Lines: 1\n"
      "#       \"Theta\"             \"Phi\"           \"Re(Etheta)\"       \"Im(Etheta)\"        \"Re(Ephi)\"      "
      "   \"Im(Ephi)\"        \"RCS(Theta)\"        \"RCS(Phi)\"        \"RCS(Total)\"  \n",
      frequency_hz, samples.theta, samples.phi, theta_deg, phi_deg);
}

std::string feko_row(const ReceivedPair& pair, std::size_t n) {
  const Complex theta = -pair.s_v(n), phi = pair.s_h(n);
  const double theta_m2 = 4 * kPi * std::norm(theta), phi_m2 = 4 * kPi * std::norm(phi);
  std::string text;
  for (const double x : {pair.places()[n].theta_deg, pair.places()[n].phi_deg, theta.real(), theta.imag(), phi.real(),
                         phi.imag(), theta_m2, phi_m2, theta_m2 + phi_m2})
    text += fmt::format("{:19.8E}", x);
  return text + "\n";
}

// A block of one receiver with this transmitter.
std::string feko_block_of_one(const ReceivedPair& pair, std::size_t n, double theta_deg, double phi_deg) {
  return feko_head(pair.places()[n].frequency_hz, theta_deg, phi_deg, {}) + feko_row(pair, n);
}

}  // namespace

std::string feko_text(std::span<const RcsCut> cuts, bool transmitted_v) {
  const std::vector<ReceivedPair> pairs = received_pairs(cuts, transmitted_v, "a .ffe");
  std::string text = "##File Type: Far field\n##File Format: 4\n##Source: seaglint\n** File exported by seaglint\n\n";
  for (const ReceivedPair& pair : pairs) {
    const std::vector<FieldValue>& values = pair.places();
    const DeclaredTransmitter& transmitter = pair.transmitter();
    for (Indices& block : blocks_by_frequency(values)) {
      if (transmitter.is_monostatic) {
        for (const std::size_t n : block) text += feko_block_of_one(pair, n, values[n].theta_deg, values[n].phi_deg);
        continue;
      }
      const Samples samples = samples_of(values, block);
      if (samples.theta * samples.phi != block.size()) {
        for (const std::size_t n : block)
          text += feko_block_of_one(pair, n, transmitter.theta_deg, transmitter.phi_deg);
        continue;
      }
      sort_by_direction(values, block);
      text += feko_head(values[block[0]].frequency_hz, transmitter.theta_deg, transmitter.phi_deg, samples);
      for (const std::size_t n : block) text += feko_row(pair, n);
    }
  }
  return text;
}

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
std::string cst_row(const ReceivedPair& pair, std::size_t n, bool transmitted_v) {
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

// Phis within [0, 360) as a sweep across 0 where the step from the last to the first is like the others: those beyond
// the widest step less 360.
std::set<double> across_zero(const std::set<double>& phis) {
  const double closing = *phis.begin() + 360 - *phis.rbegin();
  double narrowest = 360, widest = closing, from = 360;
  for (auto next = std::next(phis.begin()); next != phis.end(); ++next) {
    const double step = *next - *std::prev(next);
    narrowest = std::min(narrowest, step);
    if (step > widest) {
      widest = step;
      from = *next;
    }
  }
  if (closing > 1.5 * narrowest) return phis;
  std::set<double> swept;
  for (const double phi : phis) swept.insert(phi < from ? phi : phi - 360);
  return swept;
}

std::string incidence(const DeclaredTransmitter& transmitter, const std::set<double>& thetas,
                      const std::set<double>& phis) {
  if (transmitter.is_monostatic) return fmt::format("theta = {}, phi = {}", range(thetas), range(across_zero(phis)));
  return fmt::format("theta = {:.9g}, phi = {:.9g}", transmitter.theta_deg, transmitter.phi_deg);
}

}  // namespace

std::vector<NamedFile> cst_texts(std::span<const RcsCut> cuts, bool transmitted_v, const std::string& stem) {
  std::vector<NamedFile> texts;
  for (const ReceivedPair& pair : received_pairs(cuts, transmitted_v, "a table of CST")) {
    const std::vector<FieldValue>& values = pair.places();
    std::map<double, Indices> by_frequency;
    for (std::size_t n = 0; n < values.size(); ++n) by_frequency[values[n].frequency_hz].push_back(n);
    for (auto& [frequency_hz, places] : by_frequency) {
      sort_by_direction(values, places);
      std::set<double> thetas, phis;
      std::string text =
          "Theta [deg.]  Phi   [deg.]  Abs(RCS )[dB(m^2)]   Abs(Theta)[dB(m^2)]  Phase(Theta)[deg.]  "
          "Abs(Phi  )[dB(m^2)]  Phase(Phi  )[deg.]  Ax.Ratio[dB    ]    \r\n" +
          std::string(150, '-') + "\r\n";
      for (const std::size_t n : places) {
        thetas.insert(values[n].theta_deg);
        phis.insert(values[n].phi_deg);
        text += cst_row(pair, n, transmitted_v);
      }
      texts.push_back({fmt::format("{} (f = {:.12g}), {}, {}.txt", stem, frequency_hz * 1e-9,
                                   incidence(pair.transmitter(), thetas, phis), transmitted_v ? "VP" : "HP"),
                       std::move(text)});
    }
  }
  return texts;
}

}  // namespace seaglint
