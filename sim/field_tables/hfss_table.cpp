// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/hfss_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/dbsm.h"
#include "sim/core/process/error.h"
#include "sim/core/text/shown.h"
#include "sim/core/text/text_rows.h"
#include "sim/core/text/text_table.h"
#include "sim/core/text/words.h"
#include "sim/field_tables/export_name.h"

namespace seaglint {
namespace {

constexpr std::string_view kResult = "MonostaticRCS";

// The direction and frequency in the name of a result, as far as they stand there.
struct NamedPlace {
  std::optional<double> frequency_hz, theta_deg, phi_deg;

  auto key() const { return std::tuple(frequency_hz, theta_deg, phi_deg); }
};

// Columns of one component at one named place.
struct Result {
  NamedPlace place;
  bool theta = true;  // the component received
  std::optional<std::size_t> decibel, area, re, im;
};

std::optional<std::string_view> quoted_value(std::string_view name, std::string_view word) {
  std::optional<std::string_view> text = value_in_name(name, word);
  if (!text || !text->starts_with('\'')) return std::nullopt;
  text->remove_prefix(1);
  return text->substr(0, text->find('\''));
}

NamedPlace place_in(std::string_view name) {
  NamedPlace place;
  if (const auto text = quoted_value(name, "Freq")) place.frequency_hz = frequency_in_name(*text);
  if (const auto text = quoted_value(name, "IWaveTheta")) place.theta_deg = leading_number(*text);
  if (const auto text = quoted_value(name, "IWavePhi")) place.phi_deg = leading_number(*text);
  return place;
}

// The names of a report in one of the first lines, and the text below.
struct Head {
  std::string_view line;
  std::vector<std::string> names;
  char separator = ',';
  std::string_view rows;
};

std::optional<Head> head_of(const TextSource& source) {
  constexpr int kMaxLines = 20;
  std::string_view rest = source.text();
  for (int n = 0; n < kMaxLines && !rest.empty(); ++n) {
    const std::string_view text = rest, line = next_line(rest);
    if (line.find(kResult) == std::string_view::npos) continue;
    for (const char separator : {',', ';', '\t'}) {
      std::string_view below = text;
      const TextRow row = next_row(below, separator);
      if (row.cells.size() < 2) continue;
      return Head{line, {row.cells.begin(), row.cells.end()}, separator, below};
    }
  }
  return std::nullopt;
}

class HfssTable {
 public:
  HfssTable(const TextSource& source, Head head)
      : source_(source),
        head_(std::move(head)),
        rows_(TextTable::below(source, head_.rows, head_.names, head_.separator)) {
    for (std::size_t k = 0; k < head_.names.size(); ++k) place_column(k);
    if (results_.empty()) source_.fail(head_.line, "no column of MonostaticRCSTheta or MonostaticRCSPhi");
  }

  const std::vector<Result>& results() const { return results_; }
  std::size_t rows() const { return rows_.rows(); }

  FieldValue value(const Result& result, Polarisation element, std::size_t row,
                   std::optional<double> given_frequency_hz) const {
    const double theta = result.place.theta_deg ? *result.place.theta_deg : number(row, theta_, "IWaveTheta");
    const double phi = result.place.phi_deg ? *result.place.phi_deg : number(row, phi_, "IWavePhi");
    const double frequency_hz = frequency(result, row, given_frequency_hz);
    if (result.re && result.im) {
      const Complex root_area(rows_.number(row, *result.re), rows_.number(row, *result.im));
      return field_value(element, frequency_hz, theta, phi, root_area / std::sqrt(4 * kPi), rows_.line(row));
    }
    FieldValue value{frequency_hz, theta, phi, 0, {}, rows_.line(row)};
    fold_direction(value.theta_deg, value.phi_deg);
    value.level_dbsm =
        std::max(result.decibel ? rows_.level(row, *result.decibel) : dbsm_of_area(rows_.number(row, *result.area, 0)),
                 kMinLevel_dbsm);
    return value;
  }

 private:
  void place_column(std::size_t k) {
    const std::string_view name = head_.names[k];
    const std::size_t result = name.find(kResult);
    if (result == std::string_view::npos) {
      if (name.starts_with("IWaveTheta")) place_angle(theta_, k, name);
      if (name.starts_with("IWavePhi")) place_angle(phi_, k, name);
      if (name.starts_with("Freq")) place_frequency(k, name);
      return;
    }
    const std::string_view component = name.substr(result + kResult.size());
    const bool theta = component.starts_with("Theta");
    if (!theta && !component.starts_with("Phi")) return;  // the total, which is no element
    Result& entry = result_at(place_in(name), theta);
    std::optional<std::size_t>& column = name.starts_with("dB(")   ? entry.decibel
                                         : name.starts_with("re(") ? entry.re
                                         : name.starts_with("im(") ? entry.im
                                                                   : entry.area;
    column = k;
  }
  void place_angle(std::optional<std::size_t>& place, std::size_t k, std::string_view name) {
    if (name.find("[deg") == std::string_view::npos)
      source_.fail(head_.line, fmt::format("{}: must be in [deg]", shown(name)));
    place = k;
  }
  void place_frequency(std::size_t k, std::string_view name) {
    const std::size_t open = name.find('[');
    const std::optional<double> hz =
        open == std::string_view::npos ? std::nullopt : frequency_in_name("1 " + std::string(name.substr(open + 1)));
    if (!hz || name.find("Hz") == std::string_view::npos)
      source_.fail(head_.line, fmt::format("{}: must be in [GHz], [MHz], [kHz] or [Hz]", shown(name)));
    frequency_ = k;
    to_hz_ = *hz;
  }
  Result& result_at(const NamedPlace& place, bool theta) {
    const auto found = std::find_if(results_.begin(), results_.end(), [&](const Result& other) {
      return other.theta == theta && other.place.key() == place.key();
    });
    if (found != results_.end()) return *found;
    results_.push_back({place, theta, {}, {}, {}, {}});
    return results_.back();
  }
  double number(std::size_t row, const std::optional<std::size_t>& column, const char* name) const {
    if (!column) source_.fail(head_.line, fmt::format("no column {} [deg], nor {} in a result's name", name, name));
    return rows_.number(row, *column);
  }
  double frequency(const Result& result, std::size_t row, std::optional<double> given) const {
    if (frequency_) return rows_.positive(row, *frequency_) * to_hz_;
    if (result.place.frequency_hz) return *result.place.frequency_hz;
    if (given) return *given;
    source_.fail(head_.line, "no column Freq, nor a frequency in the results' names: give --reference-frequency-ghz");
  }

  const TextSource& source_;
  Head head_;
  TextTable rows_;
  std::optional<std::size_t> theta_, phi_, frequency_;
  double to_hz_ = 1;
  std::vector<Result> results_;
};

}  // namespace

bool is_hfss_table(const TextSource& source) {
  const std::optional<Head> head = head_of(source);
  return head && std::any_of(head->names.begin(), head->names.end(),
                             [](const std::string& name) { return name.find("IWave") != std::string::npos; });
}

void read_hfss_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table) {
  table.notes.emplace_back("e^{+jwt}; theta^ = -v, phi^ = h; monostatic");
  const HfssTable hfss(source, *head_of(source));
  require_elements(settings, source.name(), "an HFSS table");
  for (const Polarisation element : settings.elements) {
    RcsCut cut;
    cut.element = element;
    cut.transmitter.emplace();
    for (const Result& result : hfss.results()) {
      if (result.theta != receives_v(element)) continue;
      if (!result.decibel && !result.area && !(result.re && result.im)) continue;
      for (std::size_t row = 0; row < hfss.rows(); ++row)
        cut.values.push_back(hfss.value(result, element, row, settings.frequency_hz));
    }
    table.cuts.push_back(std::move(cut));
  }
}

}  // namespace seaglint
