// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/export_name.h"

#include <fmt/format.h>

#include <cctype>
#include <string_view>
#include <utility>

#include "sim/core/text/number.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool equals_ignoring_case(std::string_view text, std::string_view word) {
  if (text.size() != word.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (lower(text[i]) != lower(word[i])) return false;
  }
  return true;
}

// Place of a word that stands by itself; npos if it does not.
std::size_t find_word(std::string_view text, std::string_view word) {
  for (std::size_t at = 0; at + word.size() <= text.size(); ++at) {
    const bool begins = at == 0 || !is_word_character(text[at - 1]);
    const bool ends = at + word.size() == text.size() || !is_word_character(text[at + word.size()]);
    if (begins && ends && equals_ignoring_case(text.substr(at, word.size()), word)) return at;
  }
  return std::string_view::npos;
}

}  // namespace

std::optional<std::string_view> value_in_name(std::string_view name, std::string_view word) {
  const std::size_t at = find_word(name, word);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = trimmed(name.substr(at + word.size()));
  if (!rest.starts_with('=')) return std::nullopt;
  return trimmed(rest.substr(1));
}

std::optional<double> leading_number(std::string_view text) {
  return parse_number(text.substr(0, std::min(text.find_first_not_of("+-.0123456789eE"), text.size())));
}

bool has_word(std::string_view name, std::string_view word) { return find_word(name, word) != std::string_view::npos; }

std::optional<double> frequency_in_name(std::string_view text) {
  const std::size_t digits = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
  const std::optional<double> value = parse_number(text.substr(0, digits));
  if (!value || *value <= 0) return std::nullopt;
  const std::string_view unit = trimmed(text.substr(digits));
  for (const auto& [name, hz] :
       {std::pair<std::string_view, double>{"ghz", 1e9}, {"mhz", 1e6}, {"khz", 1e3}, {"thz", 1e12}, {"hz", 1}}) {
    if (equals_ignoring_case(unit.substr(0, name.size()), name)) return *value * hz;
  }
  return *value * 1e9;
}

NameFacts facts_of_name(const std::string& name) {
  NameFacts facts;
  for (const char* word : {"f", "frequency", "freq"}) {
    const std::optional<std::string_view> text = value_in_name(name, word);
    if (text && !facts.frequency_hz) facts.frequency_hz = frequency_in_name(*text);
  }
  const bool horizontal = has_word(name, "HP"), vertical = has_word(name, "VP");
  if (horizontal != vertical) facts.transmits_v = vertical;
  const bool h = name.find(".H.") != std::string::npos, v = name.find(".V.") != std::string::npos;
  if (h != v) facts.element = v ? Polarisation::kVv : Polarisation::kHh;
  const std::optional<std::string_view> theta = value_in_name(name, "theta"), phi = value_in_name(name, "phi");
  if (theta && phi) {
    const std::optional<double> theta_deg = leading_number(*theta), phi_deg = leading_number(*phi);
    if (theta->starts_with('(') || phi->starts_with('(')) {
      facts.transmitter.emplace();
    } else if (theta_deg && phi_deg) {
      facts.transmitter = DeclaredTransmitter{false, *theta_deg, *phi_deg};
      fold_direction(facts.transmitter->theta_deg, facts.transmitter->phi_deg);
    }
  }
  return facts;
}

FieldTableSettings completed(FieldTableSettings settings, const NameFacts& facts, std::vector<std::string>& notes) {
  if (!settings.frequency_hz && facts.frequency_hz) {
    settings.frequency_hz = facts.frequency_hz;
    notes.push_back(fmt::format("frequency {:g} GHz by the file's name", *facts.frequency_hz * 1e-9));
  }
  if (!settings.transmitter && facts.transmitter) {
    settings.transmitter = facts.transmitter;
    notes.push_back(facts.transmitter->is_monostatic
                        ? "monostatic: the file's name has a sweep of the incident wave"
                        : fmt::format("incident wave from theta {:g} deg, phi {:g} deg by the file's name",
                                      facts.transmitter->theta_deg, facts.transmitter->phi_deg));
  }
  if (settings.elements.empty() && facts.element) {
    settings.elements = {*facts.element};
    notes.push_back(fmt::format("{} by the file's name", kPolarisationNames[static_cast<int>(*facts.element)]));
  } else if (settings.elements.empty() && facts.transmits_v) {
    settings.elements = {element_of(true, *facts.transmits_v), element_of(false, *facts.transmits_v)};
    notes.emplace_back(*facts.transmits_v ? "VP in the file's name: v transmitted"
                                          : "HP in the file's name: h transmitted");
  }
  return settings;
}

}  // namespace seaglint
