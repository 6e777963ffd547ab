// SPDX-License-Identifier: BSD-3-Clause
#include "tools/evaluate/classify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/npz.h"
#include "classify/model/saved_model.h"
#include "classify/model/scores.h"
#include "classify/model/study.h"
#include "radar/echo/echo.h"
#include "seaglint_version.h"
#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/process/progress.h"
#include "sim/core/text/json.h"
#include "sim/core/text/names.h"
#include "tools/pipeline/generate.h"
#include "tools/pipeline/pipeline.h"
#include "tools/pipeline/warnings.h"

namespace seaglint {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr const char* kScenario = "scenario.yaml";
constexpr const char* kDescription = "description.json";
constexpr double kRounding = 1e-6;  // of a decimal number, relative to the step that it is a multiple of

// The archive, with the names of what it contains.
struct Archive {
  fs::path file;
  std::vector<std::string> members;

  bool has(const std::string& name) const { return std::ranges::find(members, name) != members.end(); }
  bool has_array(const std::string& name) const { return has(name + ".npy"); }
  [[noreturn]] void fail(const std::string& text) const {
    throw InputError(fmt::format("{}: {}", file.string(), text));
  }

  // Values of an array with one or two dimensions.
  template <class Values>
  Values read(const std::string& name, const std::vector<std::uint64_t>& shape,
              Values (NpzValues::*convert)() const) const {
    const NpzValues values = read_npz_array(file, name);
    const NpzValues wanted{"", shape, ""};
    if (values.shape != shape)
      fail(fmt::format("array {}: shape {}, must be {}", name, values.shape_text(), wanted.shape_text()));
    return converted(name, values, convert);
  }
  std::vector<double> numbers(const std::string& name, std::uint64_t count) const {
    return read(name, {count}, &NpzValues::numbers);
  }
  // Values of an array of one dimension of any length.
  std::vector<double> numbers(const std::string& name) const {
    const NpzValues values = read_npz_array(file, name);
    if (values.shape.size() != 1)
      fail(fmt::format("array {}: shape {}, must have one dimension", name, values.shape_text()));
    return converted(name, values, &NpzValues::numbers);
  }

 private:
  template <class Values>
  Values converted(const std::string& name, const NpzValues& values, Values (NpzValues::*convert)() const) const {
    try {
      return (values.*convert)();
    } catch (const InputError& error) {
      fail(fmt::format("array {}: {}", name, error.what()));
    }
  }
};

// Throws InputError unless every value is within `tolerance` of the one that `radar` states.
void check_values(const Archive& archive, const std::string& name, const std::vector<double>& values,
                  const std::vector<double>& stated, double tolerance, const std::string& by) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i] - stated[i]) <= tolerance) continue;
    archive.fail(fmt::format("array {}: [{}] is {:.15g}, by {} {:.15g}", name, i, values[i], by, stated[i]));
  }
}

// Window in range, m, of the map's frequencies; without them that of map.range_span_m.
double window_of(const Archive& archive, const Scenario& scenario, const std::vector<double>& frequency_hz) {
  if (frequency_hz.empty()) return scenario.map.range_span_m;
  if (frequency_hz.size() == 1) return 0;
  const RadarSpec& radar = scenario.radar;
  const double step_hz = frequency_hz[1] - frequency_hz[0];
  const double per_hop = std::round(radar.hop_step_mhz * 1e6 / step_hz);
  const double count = std::floor(radar.bandwidth_mhz * per_hop / radar.hop_step_mhz + kRounding);
  if (!(step_hz > 0 && count == static_cast<double>(frequency_hz.size())))
    archive.fail(
        fmt::format("array frequency_hz: {} frequencies in steps of {:g} Hz, must be those of "
                    "radar.bandwidth_mhz, {:g} MHz, in whole fractions of radar.hop_step_mhz, {:g} MHz",
                    frequency_hz.size(), step_hz, radar.bandwidth_mhz, radar.hop_step_mhz));
  return per_hop * kSpeedOfLight / (2e6 * radar.hop_step_mhz);
}

// The pulses of the map with the archive's code, carriers and times.
PulseTrain read_train(const Archive& archive, const Scenario& scenario, bool is_measured) {
  const RadarSpec& radar = scenario.radar;
  const std::vector<double> time_s = archive.numbers("pulse_time_s");
  const std::size_t pulses = time_s.size();
  if (pulses != static_cast<std::uint64_t>(radar.pulses))
    archive.fail(fmt::format("array pulse_time_s: {} pulses, by radar.pulses {}", pulses, radar.pulses));
  std::vector<double> frequency_hz;
  if (!is_measured || archive.has_array("frequency_hz")) frequency_hz = archive.numbers("frequency_hz");
  if (!is_measured && frequency_hz.empty()) archive.fail("array frequency_hz: no frequency");

  PulseTrain train = make_pulse_train(radar, window_of(archive, scenario, frequency_hz), scenario.seed, 0);
  if (!frequency_hz.empty()) {
    if (frequency_hz.size() != train.frequencies())
      archive.fail(fmt::format("array frequency_hz: {} frequencies, by radar.bandwidth_mhz {}", frequency_hz.size(),
                               train.frequencies()));
    check_values(archive, "frequency_hz", frequency_hz, train.baseband_hz, kRounding * train.baseband_step_hz,
                 "radar.bandwidth_mhz");
  }
  const std::vector<double> code = archive.numbers("hop_code", pulses);
  for (std::size_t n = 0; n < code.size(); ++n) {
    if (!(code[n] >= 0 && code[n] < radar.carrier_count && code[n] == std::floor(code[n])))
      archive.fail(fmt::format("array hop_code: [{}] is {:g}, must be 0 to {} (radar.hop_count)", n, code[n],
                               radar.carrier_count - 1));
    train.code[n] = static_cast<int>(code[n]);
    train.carrier_hz[n] = train.first_carrier_hz + code[n] * train.hop_step_hz;
  }
  check_values(archive, "carrier_hz", archive.numbers("carrier_hz", pulses), train.carrier_hz,
               kRounding * train.hop_step_hz, "hop_code, radar.carrier_ghz and radar.hop_step_mhz");

  std::vector<double> regular_s;
  for (std::size_t n = 0; n < pulses; ++n) regular_s.push_back(static_cast<double>(n) * train.pri_s);
  // A drawn jitter has the bound of its distribution, below half the interval.
  const bool is_drawn = std::ranges::any_of(
      scenario.variations, [](const Variation& drawn) { return drawn.key_path == "radar.pri_jitter_us"; });
  const double jitter_s = is_drawn ? 0.5 * train.pri_s : radar.pri_jitter_us * 1e-6;
  check_values(archive, "pulse_time_s", time_s, regular_s, jitter_s + kRounding * train.pri_s,
               "radar.pri_us, within radar.pri_jitter_us,");
  train.time_s = time_s;
  return train;
}

// Times of the samples of each pulse.
std::vector<double> read_times(const Archive& archive, const Scenario& scenario, const PulseTrain& train) {
  const double sampling_hz = scenario.radar.sampling_mhz * 1e6;
  const std::vector<double> time_s = archive.numbers("time_s");
  const std::size_t samples = time_s.size();
  const double length = static_cast<double>(samples), per_step = sampling_hz / train.baseband_step_hz;
  const double steps = length / per_step, odd = 2 * std::round((steps - 1) / 2) + 1;
  if (length < scenario.radar.pulse_width_us * scenario.radar.sampling_mhz)
    archive.fail(
        fmt::format("array time_s: {} samples at radar.sampling_mhz, {:g} MHz, are shorter than "
                    "radar.pulse_width_us, {:g} us",
                    samples, scenario.radar.sampling_mhz, scenario.radar.pulse_width_us));
  if (std::abs(steps - odd) > 1e-9 * odd) {
    archive.fail(
        fmt::format("array time_s: {} samples of each pulse, must be an odd multiple of {:.10g}, as {:.10g} "
                    "are: add zeros on both sides",
                    samples, per_step, per_step * (2 * std::ceil((steps - 1) / 2) + 1)));
  }
  std::vector<double> stated(samples);
  for (std::size_t k = 0; k < samples; ++k) stated[k] = (static_cast<double>(k) - (length - 1) / 2) / sampling_hz;
  check_values(archive, "time_s", time_s, stated, 1e-3 / sampling_hz, "radar.sampling_mhz, centred on 0,");
  return stated;
}

// One part of the echo at the frequencies of the map, [pulse][frequency].
std::vector<Complex> read_part(const Archive& archive, const std::string& name, const std::vector<double>& time_s,
                               double sampling_hz, const PulseTrain& train) {
  SampledEcho sampled{sampling_hz, time_s, static_cast<int>(train.pulses()), {}};
  sampled.values = archive.read(name, {train.pulses(), time_s.size()}, &NpzValues::complex_numbers);
  const auto broken = std::ranges::find_if(
      sampled.values, [](const Complex& z) { return !(std::isfinite(z.real()) && std::isfinite(z.imag())); });
  if (broken != sampled.values.end()) {
    const auto place = static_cast<std::size_t>(broken - sampled.values.begin());
    archive.fail(fmt::format("array {}: [{}][{}] is not finite", name, place / time_s.size(), place % time_s.size()));
  }
  return spectrum_of(sampled, train);
}

// Sets a column of the record; false when the value is of another type.
bool set_column(const SampleColumn& column, const ordered_json& value, SampleRecord& record) {
  return std::visit(
      [&](auto member) {
        using Value = std::remove_cvref_t<decltype(record.*member)>;
        if constexpr (std::is_same_v<Value, std::string>) {
          if (!value.is_string()) return false;
          record.*member = value.get<std::string>();
        } else if constexpr (std::is_same_v<Value, double>) {
          if (!value.is_number()) return false;
          record.*member = value.get<double>();
        } else {
          if (!value.is_number_integer()) return false;
          record.*member = value.get<Value>();
        }
        return true;
      },
      column.member);
}

// The member `columns` of description.json; null values are undefined.
void read_columns(const Archive& archive, EchoFile& echo) {
  if (!archive.has(kDescription)) return;
  const std::string name = archive.file.string() + "/" + kDescription;
  const std::string text = read_npz_text(archive.file, kDescription);
  check_json(text, name, kMaxOrderedKeys);
  try {
    const ordered_json json = ordered_json::parse(text);
    if (!json.contains("columns")) return;
    for (const auto& [key, value] : json.at("columns").items()) {
      std::vector<std::string> names;
      const SampleColumn* found = nullptr;
      for (const SampleColumn& column : sample_columns()) {
        names.emplace_back(column.name);
        if (key == column.name) found = &column;
      }
      if (found == nullptr)
        throw InputError(
            fmt::format("{}: columns: {}: no column of a data set; {}", name, shown(key), suggestion(key, names)));
      if (value.is_null()) continue;
      if (!set_column(*found, value, echo.record))
        throw InputError(fmt::format("{}: columns: {}: {}: of another type", name, key, shown(value.dump())));
      echo.given.insert(key);
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", name, json_problem(error)));
  }
}

}  // namespace

EchoFile read_echo_file(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(fmt::format("{}: no such file", file.string()));
  const Archive archive{file, npz_members(file)};
  EchoFile echo;
  echo.is_measured = archive.has_array("echo");
  if (!archive.has(kScenario))
    archive.fail("no scenario.yaml inside, whose radar, map and features make the map of the samples");
  if (echo.is_measured) {
    for (const char* part : {"target", "clutter", "noise"})
      if (archive.has_array(part))
        archive.fail(fmt::format("array echo beside {}: echo is the sum, of a measured interval", part));
  } else if (!archive.has_array("target")) {
    archive.fail("no array target, of `seaglint echo`, or echo, of a measured interval, inside");
  }
  for (const char* name : {"time_s", "pulse_time_s", "carrier_hz", "hop_code"})
    if (!archive.has_array(name)) archive.fail(fmt::format("array {}: is missing", name));
  if (!echo.is_measured && !archive.has_array("frequency_hz")) archive.fail("array frequency_hz: is missing");

  echo.scenario = parse_scenario(read_npz_text(file, kScenario), file.string() + "/" + kScenario);
  read_columns(archive, echo);
  echo.train = read_train(archive, echo.scenario, echo.is_measured);
  const std::vector<double> time_s = read_times(archive, echo.scenario, echo.train);
  const auto read = [&](const char* name) {
    return read_part(archive, name, time_s, echo.scenario.radar.sampling_mhz * 1e6, echo.train);
  };
  echo.echo.pulses = static_cast<int>(echo.train.pulses());
  echo.echo.frequencies = static_cast<int>(echo.train.frequencies());
  echo.echo.target = read(echo.is_measured ? "echo" : "target");
  if (archive.has_array("clutter")) echo.echo.clutter = read("clutter");
  if (archive.has_array("noise")) {
    echo.echo.noise = read("noise");
    // The frequencies of the map alias all ranges of the samples to its window; a receiver gates the compressed pulse
    // to the window, which keeps this part of the power of white noise. Target and clutter are inside of the window.
    const double kept =
        echo.scenario.radar.sampling_mhz * 1e6 / (echo.train.baseband_step_hz * static_cast<double>(time_s.size()));
    for (Complex& value : echo.echo.noise) value *= std::sqrt(kept);
  }
  const double power = mean_power(echo.echo.total());
  if (!(power > 0 && std::isfinite(power))) archive.fail(fmt::format("samples without a power: {} m^2", power));
  return echo;
}

namespace fs = std::filesystem;

namespace {

// The maps that are classified.
struct Classified {
  AppliedRows applied;
  std::optional<std::set<std::string>> known;  // columns of the rows that have values; all unless given

  bool has(const std::string& column) const { return !known || known->contains(column); }
};

// Names of the features and conditions of a row outside the training range.
std::vector<std::string> outside(const ModelCard& card, const Classified& maps, std::size_t index) {
  const DataRow& row = maps.applied.rows[index];
  std::vector<std::string> names;
  for (const auto* ranges : {&card.feature_ranges, &card.condition_ranges})
    for (const ValueRange& range : *ranges)
      if (maps.has(range.name) && range.excludes(column_of({&row, 1}, range.name).numbers.front()))
        names.push_back(range.name);
  return names;
}

const std::string& decided(const ModelCard& card, std::span<const double> outputs) {
  return card.classes[static_cast<std::size_t>(decision_of(outputs))];
}

// The classes whose probabilities are shown: the second of two, or all.
std::vector<std::string> shown_classes(const ModelCard& card) {
  return card.classes.size() == 2 ? std::vector{card.classes[1]} : card.classes;
}

// Four digits, a dash for an undefined value.
std::string digits(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

// "sample 3: ship (truth: ship), Hs 1 m, azimuth 30 deg", without what is not known of the map.
std::string title(const SavedModel& model, const Classified& maps) {
  const SampleRecord& record = maps.applied.rows.front().record;
  std::string text = maps.has("sample") ? fmt::format("sample {}", record.sample) : "interval";
  if (maps.has("target_name")) text += fmt::format(": {}", shown(record.target_name));
  text += maps.has("label") ? fmt::format(" (truth: {})", model.card.classes[static_cast<std::size_t>(record.label)])
                            : " (truth not given)";
  if (maps.has("significant_wave_height_m")) text += fmt::format(", Hs {:g} m", record.significant_wave_height_m);
  if (maps.has("azimuth_deg")) text += fmt::format(", azimuth {:g} deg", record.azimuth_deg);
  return text + "\n";
}

std::string sample_text(const SavedModel& model, const Classified& maps) {
  const AppliedRows& applied = maps.applied;
  const DataRow& row = applied.rows.front();
  std::string text = title(model, maps);
  text += fmt::format("  {:<12}", "classifier");
  for (const std::string& name : shown_classes(model.card)) text += fmt::format("{:>24}", "P(" + name + ")");
  text += "  decision\n";
  for (std::size_t i = 0; i < kModelNames.size(); ++i) {
    text += fmt::format("  {:<12}", kModelNames[i]);
    for (const double probability : applied.outputs(i, 0)) text += fmt::format("{:>24.4f}", probability);
    text += fmt::format("  {}\n", decided(model.card, applied.outputs(i, 0)));
  }
  text += fmt::format("\n  {:<28}{:>12}{:>24}", "quantity", "value", "training range");
  for (const std::string& name : model.card.classes) text += fmt::format("{:>38}", name + ", 5 / 50 / 95 %");
  text += "\n";
  const auto add = [&](const ValueRange& range) {
    const bool known = maps.has(range.name);
    const double value = known ? column_of({&row, 1}, range.name).numbers.front() : std::nan("");
    text += fmt::format("  {:<28}{:>12}{:>24}", range.name, known ? digits(value) : "not given",
                        fmt::format("{} to {}", digits(range.lowest), digits(range.highest)));
    for (const ClassQuantiles& q : range.by_label)
      text += fmt::format("{:>38}", fmt::format("{} / {} / {}", digits(q[0]), digits(q[1]), digits(q[2])));
    text += known && range.excludes(value) ? "  outside\n" : "\n";
  };
  for (const ValueRange& range : model.card.feature_ranges) add(range);
  for (const ValueRange& range : model.card.condition_ranges) add(range);
  return text;
}

// Of two classes the probability of label 1; of more the decision with its probability.
std::string all_text(const SavedModel& model, const Classified& maps) {
  const AppliedRows& applied = maps.applied;
  const bool two = model.card.classes.size() == 2;
  const int width = two ? 12 : 24;
  std::string text = fmt::format("{:>8} {:<16}", "sample", "truth");
  for (const char* name : kModelNames) text += fmt::format("{:>{}}", name, width);
  text += two ? fmt::format("  P({}); outside the training range\n", model.card.classes[1])
              : "  decision, P(decision); outside the training range\n";
  for (std::size_t row = 0; row < applied.rows.size(); ++row) {
    const SampleRecord& record = applied.rows[row].record;
    text += fmt::format("{:>8} {:<16}", record.sample, model.card.classes[static_cast<std::size_t>(record.label)]);
    for (std::size_t i = 0; i < kModelNames.size(); ++i) {
      const std::span<const double> outputs = applied.outputs(i, row);
      text += two ? fmt::format("{:>12.4f}", outputs[0])
                  : fmt::format("{:>24}", fmt::format("{}, {:.4f}", decided(model.card, outputs),
                                                      outputs[static_cast<std::size_t>(decision_of(outputs))]));
    }
    text += fmt::format("  {}\n", fmt::join(outside(model.card, maps, row), " "));
  }
  return text;
}

// Sample and label are empty where they are not known.
std::string csv(const SavedModel& model, const Classified& maps) {
  const AppliedRows& applied = maps.applied;
  std::string text = "sample,label";
  for (const char* name : kModelNames)
    text += fmt::format(",{}", fmt::join(probability_columns(name, model.card.classes), ","));
  for (const std::string& feature : model.card.features) text += "," + feature;
  text += ",outside\n";
  for (std::size_t row = 0; row < applied.rows.size(); ++row) {
    const SampleRecord& record = applied.rows[row].record;
    text += fmt::format("{},{}", maps.has("sample") ? std::to_string(record.sample) : "",
                        maps.has("label") ? std::to_string(record.label) : "");
    for (std::size_t i = 0; i < kModelNames.size(); ++i)
      text += fmt::format(",{}", fmt::join(applied.outputs(i, row), ","));
    for (const float value : applied.features.row(row)) text += fmt::format(",{}", value);
    text += fmt::format(",{}\n", fmt::join(outside(model.card, maps, row), " "));
  }
  return text;
}

// Throws InputError for an output among the files of the data set or the model, WorkError where it cannot be written.
void require_table(const ClassifyRequest& request) {
  if (request.output.empty()) return;
  if (request.output.extension() != ".csv")
    throw InputError(fmt::format("{}: must end in .csv", request.output.string()));
  const fs::path folder = request.output.has_parent_path() ? request.output.parent_path() : fs::path(".");
  for (const fs::path& other : {request.model, request.data}) {
    if (fs::exists(folder) && fs::exists(other) && fs::equivalent(folder, other))
      throw InputError(fmt::format("{}: in the directory of the model or the data set", request.output.string()));
  }
  require_writable(request.output);
}

bool is_echo_file(const fs::path& data) { return data.extension() == ".npz" && !fs::is_directory(data); }

// Maps of a data set, one or all.
Classified classified_samples(const ClassifyRequest& request, const StopFlag* stop, const SavedModel& model,
                              const DatasetReader& reader) {
  const Scenario scenario = read_scenario(request.data / kScenarioFile);
  Classified maps;
  const auto apply = [&](const Shard& shard, const fs::path& file) {
    require_applicable(model.card, request.data, scenario, shard.axes);
    apply_model(model, shard, file, 0, maps.applied);
  };
  if (request.sample) {
    StoredSample stored = stored_sample(reader, *request.sample);
    apply({stored.origin, stored.axes, {std::move(stored.sample)}}, request.data);
  } else {
    Progress progress("classifying shards", reader.shards());
    for (std::size_t i = 0; i < reader.shards(); ++i) {
      if (stop && *stop) throw Interrupted();
      apply(reader.shard(i), reader.directory() / reader.manifest().shards[i].file);
      progress.advance();
    }
  }
  return maps;
}

// The map of an echo file. Its parts are at the levels that they were received with.
Classified classified_echo(const SavedModel& model, EchoFile file, const fs::path& path) {
  ClutterSpec as_received;
  as_received.level = ClutterLevel::kNrl;
  as_received.noise_level = NoiseLevel::kThermal;
  GeneratedSample made = sample_of_echo(file.echo, file.train, file.scenario, as_received, std::move(file.record));
  Classified maps;
  maps.known = std::move(file.given);
  maps.known->insert({"centres", "mwr", "ccf", "sigma_r_m", "sigma_v_mps"});
  const bool has_truth = maps.known->contains("label");
  for (const char* ratio : {"scr_per_pulse_db", "scr_peak_cell_db", "scr_extent_db", "snr_per_pulse_db"}) {
    if (file.is_measured) {
      maps.known->erase(ratio);
    } else {
      maps.known->insert(ratio);
    }
  }
  if (!has_truth) file.scenario.dataset.classes = model.card.classes;
  Shard shard;
  shard.axes = stored_axes(made.received.map);
  shard.samples.push_back(std::move(made.stored));
  require_applicable(model.card, path, file.scenario, shard.axes);
  apply_model(model, shard, path, 0, maps.applied);
  return maps;
}

}  // namespace

std::string classify_samples(const ClassifyRequest& request, const StopFlag* stop) {
  require_table(request);
  std::optional<SavedModel> model;
  Classified maps;
  const bool is_echo = is_echo_file(request.data);
  if (is_echo) {
    if (request.sample)
      throw InputError(
          fmt::format("--sample {}: {} is the echo of one interval", *request.sample, request.data.string()));
    EchoFile file = read_echo_file(request.data);
    model = SavedModel::load(request.model, kVersion);
    maps = classified_echo(*model, std::move(file), request.data);
  } else {
    const DatasetReader reader(request.data);
    warn(data_set_warnings(reader));
    if (request.sample && *request.sample >= reader.size())
      throw InputError(
          fmt::format("--sample {}: the data set has samples 0 to {}", *request.sample, reader.size() - 1));
    model = SavedModel::load(request.model, kVersion);
    maps = classified_samples(request, stop, *model, reader);
  }
  if (!request.output.empty()) write_file(request.output, csv(*model, maps));
  return is_echo || request.sample ? sample_text(*model, maps) : all_text(*model, maps);
}

}  // namespace seaglint
