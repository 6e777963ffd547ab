// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/metrics.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/text/json.h"
#include "tools/pipeline/train.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

using nlohmann::ordered_json;

// Calls read() on the object of a file. Throws InputError naming the file if it is none, or lacks what is read.
template <class Read>
auto from_object(const fs::path& file, Read&& read) {
  const std::string text = read_file(file);
  check_json(text, file.string(), kMaxOrderedKeys);
  try {
    const ordered_json object = ordered_json::parse(text);
    if (!object.is_object()) throw InputError(fmt::format("{}: must be a JSON object", file.string()));
    return read(object);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", file.string(), json_problem(error)));
  }
}

// JSON has no NaN: an undefined value is null.
double value_or_nan(const ordered_json& json) { return json.is_number() ? json.get<double>() : std::nan(""); }

// The study in an object of metrics.json.
class StudyReader {
 public:
  StudyReader(const std::string& file, std::vector<std::string> classes) : file_(file), classes_(std::move(classes)) {}

  Study study(const ordered_json& json) const {
    Study study;
    study.classes = classes_;
    study.division = json.value("division", "");
    for (const char* name : kModelNames) study.groups.push_back(group(name, json.at(name)));
    for (const ordered_json& entry : json.at("probes")) {
      ProbeResult& probe = study.probes.emplace_back();
      probe.name = entry.at("name");
      probe.kind = kind(entry.at("kind"));
      probe.meaning = entry.at("meaning");
      if (entry.contains("random")) probe.evaluations.push_back(evaluation(entry.at("random")));
      probe.evaluations.push_back(evaluation(entry.at("group")));
    }
    return study;
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const { throw InputError(fmt::format("{}: {}", file_, fault)); }

  ProbeKind kind(const std::string& word) const {
    for (const ProbeKind kind :
         {ProbeKind::kBlind, ProbeKind::kScale, ProbeKind::kRatio, ProbeKind::kFeature, ProbeKind::kShape})
      if (word == name(kind)) return kind;
    fail(fmt::format("probes: kind '{}'", word));
  }

  FeatureGroupResult group(const char* name, const ordered_json& json) const {
    FeatureGroupResult group;
    group.name = name;
    std::string other = "fewer_rows";  // member of the alternative
    if (json.contains("fusion")) other = json.at("fusion") == "split" ? "in_sample" : "split";
    for (const Protocol protocol : {Protocol::kRandom, Protocol::kGroup}) {
      const char* member = seaglint::name(protocol);
      if (protocol == Protocol::kRandom && !json.contains(member)) continue;
      const ordered_json& of_protocol = json.at(member);
      Outcome& outcome = group.outcomes.emplace_back();
      outcome.protocol = protocol;
      outcome.primary = evaluation(of_protocol);
      outcome.linear = evaluation(of_protocol.at("logistic_regression"));
      outcome.roc = curves(of_protocol.at("roc"));
      if (json.contains(other)) outcome.alternative = evaluation(json.at(other).at(member));
      if (of_protocol.contains("wrong"))
        for (const ordered_json& wrong : of_protocol.at("wrong")) outcome.wrong.push_back(error_of(wrong));
      if (!of_protocol.contains("by_condition")) continue;
      for (const ordered_json& condition : of_protocol.at("by_condition"))
        outcome.by_condition.push_back(
            {condition.at("column"), condition.at("units"), bins(condition.at("bins"), "mean")});
    }
    return group;
  }

  // The probabilities of other classes than the declared one are not stored.
  Prediction error_of(const ordered_json& json) const {
    Prediction error{json.at("row"), 0, json.at("label"), 0, {}};
    const std::size_t declared = json.at("declared");
    const double probability = json.at("probability");
    if (classes_.size() == 2) error.probability = declared == 1 ? probability : 1 - probability;
    if (classes_.size() > 2) {
      error.by_class.assign(classes_.size(), 0);
      error.by_class.at(declared) = probability;
    }
    return error;
  }

  Evaluation evaluation(const ordered_json& json) const {
    return {scores(json), bins(json.at("by_wave_height"), kWaveHeightColumn), json.at("train_rows")};
  }

  std::vector<BinnedScores> bins(const ordered_json& list, const char* mean) const {
    std::vector<BinnedScores> bins;
    for (const ordered_json& bin : list) {
      bins.push_back({bin.at("bin"), value_or_nan(bin.at("lowest")), value_or_nan(bin.at("highest")),
                      value_or_nan(bin.at(mean)), scores(bin)});
      if (bin.contains("roc")) bins.back().roc = curves(bin.at("roc"));
    }
    return bins;
  }

  Scores scores(const ordered_json& json) const {
    Scores scores;
    scores.rows = json.at("rows");
    scores.groups = json.at("groups");
    scores.accuracy = value_or_nan(json.at("accuracy"));
    scores.accuracy_95 = {value_or_nan(json.at("accuracy_95").at(0)), value_or_nan(json.at("accuracy_95").at(1))};
    scores.auc = value_or_nan(json.at("auc"));
    scores.log_loss = value_or_nan(json.at("log_loss"));
    const ordered_json& confusion = json.at("confusion");  // by truth, then decision
    const std::size_t classes = classes_.size();
    if (confusion.size() != classes * classes)
      fail(fmt::format("confusion: {} counts of {} classes", confusion.size(), classes));
    scores.confusion.assign(classes, std::vector<std::size_t>(classes));
    std::size_t entry = 0;
    for (const ordered_json& count : confusion) {
      scores.confusion[entry / classes][entry % classes] = count;
      ++entry;
    }
    return scores;
  }

  // One of two classes, else one of each.
  std::vector<std::vector<RocPoint>> curves(const ordered_json& json) const {
    std::vector<std::vector<RocPoint>> curves;
    if (json.contains("detections")) return {curve(json)};
    for (const ordered_json& of_class : json) curves.push_back(curve(of_class));
    return curves;
  }

  std::vector<RocPoint> curve(const ordered_json& json) const {
    const ordered_json &alarms = json.at("false_alarms"), &detections = json.at("detections");
    if (alarms.size() != detections.size())
      fail(fmt::format("roc: {} false_alarms, {} detections", alarms.size(), detections.size()));
    std::vector<RocPoint> points;
    for (std::size_t i = 0; i < alarms.size(); ++i) points.push_back({alarms.at(i), detections.at(i)});
    return points;
  }

  const std::string& file_;
  std::vector<std::string> classes_;
};

RunRecord run_of(const ordered_json& json) {
  RunRecord run{json.at("threads"), json.at("maps_made"), json.at("maps_kept"), {}};
  for (const auto& [stage, seconds] : json.at("seconds").items())
    if (stage != "report") run.seconds.emplace_back(stage, value_or_nan(seconds));
  return run;
}

ordered_json to_object(const Quartiles& q) {
  return {{"lower", number_or_null(q.lower)}, {"median", number_or_null(q.median)}, {"upper", number_or_null(q.upper)}};
}

// Quartiles of all quantities by bin and class, the last label first. `height`: of the rows; its text is a member.
ordered_json quartiles_by(const ReportData& data, const char* name, const std::vector<ColumnBin>& bins,
                          const std::function<RowFilter(const ColumnBin&)>& filter, const ColumnBin* height) {
  ordered_json list = ordered_json::array();
  for (const ColumnBin& bin : bins) {
    for (int label = data.classes - 1; label >= 0; --label) {
      ordered_json entry{{name, bin.mean}, {"bin", bin.text}, {"lowest", bin.lowest}, {"highest", bin.highest}};
      if (height != nullptr) entry[kWaveHeightColumn] = height->text;
      entry["label"] = label;
      RowFilter rows = filter(bin);
      rows.label = label;
      for (const ReportQuantity& quantity : kReportQuantities)
        entry[quantity.name] = to_object(quartiles_of(data, rows, quantity.value));
      list.push_back(std::move(entry));
    }
  }
  return list;
}

ordered_json report_numbers(const ReportData& data) {
  const ColumnBin* height = data.height_shown();
  ordered_json json;
  json["features_by_wave_height"] = quartiles_by(
      data, kWaveHeightColumn, data.heights.bins,
      [](const ColumnBin& bin) {
        return RowFilter{{}, &bin};
      },
      nullptr);
  json["features_by_azimuth"] = quartiles_by(
      data, "azimuth_deg", data.azimuths.bins,
      [&](const ColumnBin& bin) {
        return RowFilter{{}, height, &bin};
      },
      height);
  json["maps_shown"] = ordered_json::array();
  for (const ShownMap& shown : data.shown) {
    const SampleRecord& record = shown.sample.record;
    const LineFit line = fit_line(shown.sample.centre_list);
    json["maps_shown"].push_back({{"sample", record.sample},
                                  {"target", record.target_name},
                                  {"label", record.label},
                                  {"azimuth_deg", record.azimuth_deg},
                                  {"significant_wave_height_m", record.significant_wave_height_m},
                                  {"peak_m", record.peak_m},
                                  {"centres", record.centres},
                                  {"mwr", record.mwr},
                                  {"ccf", record.ccf},
                                  {"sigma_r_m", record.sigma_r_m},
                                  {"sigma_v_mps", record.sigma_v_mps},
                                  {"line_slope_per_s", number_or_null(line.slope)},
                                  {"line_explained", number_or_null(line.explained)},
                                  {"scr_per_pulse_db", number_or_null(record.scr_per_pulse_db)},
                                  {"scr_peak_cell_db", number_or_null(record.scr_peak_cell_db)}});
  }
  return json;
}

// "93.1 (82–100)"; a dash for null.
std::string per_cent(const ordered_json& fraction) {
  return fraction.is_null() ? "–" : fmt::format("{:.1f}", 100 * fraction.get<double>());
}
std::string with_interval(const ordered_json& entry) {
  const ordered_json& interval = entry.at("interval");
  if (interval.at(0).is_null()) return per_cent(entry.at("accuracy"));
  return fmt::format("{} ({:.0f}–{:.0f})", per_cent(entry.at("accuracy")), 100 * interval.at(0).get<double>(),
                     100 * interval.at(1).get<double>());
}

std::vector<StoredBenchmark::Row> rows_of(const ordered_json& entries) {
  std::vector<StoredBenchmark::Row> rows;
  for (const auto& [name, entry] : entries.items()) {
    rows.push_back({name, entry.contains("leaks") && entry.at("leaks").get<bool>(), {with_interval(entry)}});
    for (const ordered_json& of_height : entry.at("by"))
      rows.back().values.push_back(per_cent(of_height.at("accuracy")));
  }
  return rows;
}

}  // namespace

NetworkRecord record_of(const Network& network) {
  return {network.parameter_count(), network.history().epochs, network.history().fit};
}

RunNumbers read_metrics(const fs::path& directory, const Scenario& scenario) {
  const fs::path file = directory / kMetricsFile, of_model = directory / "model" / kMetricsFile;
  if (!fs::exists(file))
    throw InputError(fmt::format("{}: not the directory of a finished run: no {}", directory.string(), kMetricsFile));
  return from_object(file, [&](const ordered_json& metrics) {
    // Members that every part of the page uses; a file of another version or origin is detected here.
    for (const char* member : {"handmade", "cnn", "fused", "probes", "network", "data", "run"})
      if (!metrics.contains(member)) throw InputError(fmt::format("{}: no member `{}`", file.string(), member));
    if (!fs::exists(of_model))
      throw InputError(fmt::format("{}: missing: the last training did not end; go on by `seaglint run --resume`",
                                   of_model.string()));
    from_object(of_model, [&](const ordered_json& model) {
      for (const auto& [member, value] : model.items()) {
        if (metrics.contains(member) && metrics.at(member) == value) continue;
        throw InputError(fmt::format("{}: `{}` is of another training than {}; go on by `seaglint run --resume`",
                                     file.string(), member, of_model.string()));
      }
      return true;
    });
    const ordered_json& network = metrics.at("network");
    RunNumbers stored;
    stored.study = StudyReader(file.string(), scenario.dataset.classes).study(metrics);
    stored.network = {network.at("parameters"), network.at("epochs"), {}};
    for (const ordered_json& loss : network.at("training_loss"))
      stored.network.training_loss.push_back(value_or_nan(loss));
    stored.run = run_of(metrics.at("run"));
    stored.version = metrics.at("version");
    stored.processors = metrics.at("data").at("processors");
    stored.scenario_sha256 = metrics.at("data").at("scenario_sha256");
    return stored;
  });
}

void write_metrics(const fs::path& directory, const RunRecord& run, const ReportData& data) {
  const std::string text = from_object(directory / "model" / kMetricsFile, [&](ordered_json metrics) {
    ordered_json& json = metrics["run"];
    json = {{"threads", run.threads}, {"maps_made", run.maps_made}, {"maps_kept", run.maps_kept}};
    for (const auto& [stage, seconds] : run.seconds) json["seconds"][stage] = seconds;
    metrics["report"] = report_numbers(data);
    return metrics.dump(2) + "\n";
  });
  write_file(directory / kMetricsFile, text);
}

StoredBenchmark read_benchmark_file(const fs::path& file) {
  return from_object(file, [&](const ordered_json& json) {
    StoredBenchmark benchmark;
    benchmark.folder = file.parent_path().filename();
    benchmark.record = {json.at("benchmark"), json.at("small"), 0, json.at("maps"), json.at("seas"), 1};
    benchmark.division = json.at("division");
    for (const auto& [height, entry] : json.at("baselines").at("handmade").at("by").items())
      benchmark.heights.push_back(height);
    benchmark.baselines = rows_of(json.at("baselines"));
    benchmark.floor = rows_of(json.at("floor"));
    for (const ordered_json& claim : json.at("claims")) {
      const std::string word = claim.at("verdict");
      const auto is_word = [&](Verdict verdict) { return word == name(verdict); };
      constexpr Verdict kAll[] = {Verdict::kHeld, Verdict::kNotHeld, Verdict::kUndecided};
      const Verdict* const verdict = std::ranges::find_if(kAll, is_word);
      if (verdict == std::end(kAll)) throw InputError(fmt::format("{}: verdict '{}'", file.string(), word));
      benchmark.claims.push_back({claim.at("claim"), *verdict, claim.at("why"), claim.at("meaning")});
    }
    return benchmark;
  });
}

std::vector<StoredBenchmark> read_benchmarks(const fs::path& run) {
  std::vector<StoredBenchmark> benchmarks;
  for (const fs::directory_entry& entry : fs::directory_iterator(run))
    if (is_there(entry.path() / kBenchmarkFile))
      benchmarks.push_back(read_benchmark_file(entry.path() / kBenchmarkFile));
  std::ranges::sort(benchmarks, {}, &StoredBenchmark::folder);
  return benchmarks;
}

}  // namespace seaglint
