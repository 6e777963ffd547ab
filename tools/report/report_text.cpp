// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>
#include <vector>

#include "classify/model/data_rows.h"
#include "radar/waveform/pulse_train.h"
#include "tools/page/html.h"

namespace seaglint {

namespace {

using nlohmann::ordered_json;

// independent: of a probe that is random by construction, which is away from chance below guessing, too. Any other
// probe separates nothing there: what it learnt does not hold on unseen rows.
bool scores_as_chance(const ordered_json& scores, bool independent, int repeats) {
  constexpr double kDeviations = 2.576;  // 99 % of a normal distribution, two-sided
  const Guessing guess = guessing(scores);
  const double low = value_or_nan(scores.at("accuracy_95").at(0));
  if (!independent && std::isfinite(low)) return low <= guess.most;
  const double rows = scores.at("rows").get<double>() / repeats, accuracy = value_or_nan(scores.at("accuracy"));
  const double off = std::max({accuracy - guess.most, independent ? guess.least - accuracy : 0.0, 0.0});
  return off <= kDeviations * std::sqrt(guess.most * (1 - guess.most) / rows);
}

}  // namespace

std::string scores_fault(const ordered_json& metrics, std::size_t classes) {
  if (!metrics.is_structured()) return "";
  if (metrics.is_object() && metrics.contains("confusion") && metrics.at("confusion").size() != classes * classes)
    return fmt::format("confusion: {} counts of {} classes", metrics.at("confusion").size(), classes);
  if (metrics.is_object() && metrics.contains("false_alarms") && metrics.contains("detections") &&
      metrics.at("false_alarms").size() != metrics.at("detections").size())
    return fmt::format("roc: {} false_alarms, {} detections", metrics.at("false_alarms").size(),
                       metrics.at("detections").size());
  for (const ordered_json& member : metrics)
    if (std::string fault = scores_fault(member, classes); !fault.empty()) return fault;
  return "";
}

double value_or_nan(const ordered_json& json) { return json.is_number() ? json.get<double>() : std::nan(""); }

std::string percent(double fraction) { return std::isfinite(fraction) ? fmt::format("{:.1f} %", 100 * fraction) : "–"; }

std::string accuracy_cell(const ordered_json& scores) {
  const double low = value_or_nan(scores.at("accuracy_95").at(0)), high = value_or_nan(scores.at("accuracy_95").at(1));
  std::string cell = percent(value_or_nan(scores.at("accuracy")));
  if (std::isfinite(low)) cell += fmt::format(" <small>({:.0f}–{:.0f})</small>", 100 * low, 100 * high);
  return cell;
}

double probe_accuracy(const ordered_json& metrics, const std::string& name) {
  for (const auto& probe : metrics.at("probes")) {
    if (probe.at("name") == name) return value_or_nan(probe.at("group").at("accuracy"));
  }
  return std::nan("");
}

DivisionWords division_words(const ordered_json& metrics) {
  const auto column = metrics.at("learning").at("split.by").get<std::string>();
  DivisionWords words;
  words.by_sea = column == "sea";
  words.by = "by " + column;
  words.unseen = words.by_sea ? "unseen seas" : fmt::format("values of {} that were not trained on", column);
  words.heading = words.by_sea ? "Split by sea realisation (no test sea was seen in training)"
                               : fmt::format("Split by {0} (no value of {0} is trained and tested on)", column);
  // Text of Division: "tested on layout=ring only; split by ..."
  constexpr std::string_view kTested = "tested on ", kOnly = " only; split by ";
  const std::string division = metrics.value("division", "");
  const std::size_t end = division.rfind(kOnly);
  if (!division.starts_with(kTested) || end == std::string::npos) return words;
  const std::string held = division.substr(kTested.size(), end - kTested.size());
  words.unseen = fmt::format("held-out maps ({}) of {}", held, words.unseen);
  words.heading += fmt::format(", tested on {} only", held);
  return words;
}

std::string Guessing::text() const {
  const std::string high = fmt::format("{:.1f} %", 100 * most);
  return most - least < 5e-4 ? high : fmt::format("{:.1f} to {}", 100 * least, high);
}

Guessing guessing(const ordered_json& scores) {
  // Entries by truth, then decision.
  const ordered_json& confusion = scores.at("confusion");
  const auto classes = static_cast<std::size_t>(std::lround(std::sqrt(confusion.size())));
  std::vector<double> rows(classes);
  std::size_t entry = 0;
  for (const ordered_json& count : confusion) rows.at(entry++ / classes) += count.get<double>();
  const double all = std::accumulate(rows.begin(), rows.end(), 0.0);
  if (!(all > 0)) return {1.0 / static_cast<double>(classes), 1.0 / static_cast<double>(classes)};
  double squares = 0;
  for (const double count : rows) squares += count / all * (count / all);
  return {squares, *std::max_element(rows.begin(), rows.end()) / all};
}

bool as_chance(const ordered_json& metrics, const ordered_json& probe) {
  const bool blind = probe.at("kind") == "blind";
  const int repeats = metrics.at("split_repeats");
  const bool random = !probe.contains("random") || scores_as_chance(probe.at("random"), blind, repeats);
  return random && scores_as_chance(probe.at("group"), blind, repeats);
}

ClassNames class_names(const Scenario& scenario) {
  constexpr std::size_t kMostNames = 3;
  if (scenario.dataset.classes != default_classes()) return scenario.dataset.classes;
  ClassNames classes;
  for (const int label : {0, 1}) {
    std::vector<std::string> names;
    for (const TargetSpec& target : scenario.targets)
      if (target.role == TargetRole::kClass && target.label == label) names.push_back(target.name);
    classes.push_back(names.empty() || names.size() > kMostNames ? fmt::format("label {}", label)
                                                                 : fmt::format("{}", fmt::join(names, ", ")));
  }
  return classes;
}

std::size_t confused(const nlohmann::ordered_json& scores, std::size_t classes, std::size_t truth,
                     std::size_t decision) {
  return std::next(scores.at("confusion").begin(), static_cast<std::ptrdiff_t>(truth * classes + decision))
      ->get<std::size_t>();
}

std::string confusion_table(const nlohmann::ordered_json& metrics, const ClassNames& classes) {
  std::vector<std::vector<std::string>> rows{{"truth"}};
  for (const std::string& name : classes) rows.front().push_back("declared " + escape_html(name));
  for (std::size_t truth = 0; truth < classes.size(); ++truth) {
    rows.push_back({escape_html(classes[truth])});
    for (std::size_t decision = 0; decision < classes.size(); ++decision)
      rows.back().push_back(
          fmt::format("{}", confused(metrics.at("fused").at("group"), classes.size(), truth, decision)));
  }
  return fmt::format("<h3>Decisions by class, fused features, split {}</h3>\n", division_words(metrics).by) +
         html_table(rows);
}

std::string by_class(const ClassNames& classes, const std::function<std::string(int label)>& value) {
  std::string text;
  for (int label = static_cast<int>(classes.size()) - 1; label >= 0; --label) {
    text += text.empty() ? "" : label > 0 ? ", " : " and ";
    text += fmt::format("{} ({})", value(label), escape_html(classes[static_cast<std::size_t>(label)]));
  }
  return text;
}

namespace {

using nlohmann::ordered_json;

// Those of clutter and noise whose level does not follow the target's; empty if both do. The target's level then
// determines which of its centres exceed the threshold, and so affects the features.
std::string not_scaled(const ClutterSpec& clutter) {
  const bool sea = clutter.enabled && clutter.level == ClutterLevel::kNrl;
  const bool receiver = clutter.noise_level == NoiseLevel::kThermal;
  if (sea && receiver) return "Clutter and receiver noise are";
  if (sea) return "The clutter is";
  return receiver ? "The receiver’s noise is" : "";
}

// Interpretation of a probe's accuracy by its kind.
std::string reading(const std::string& kind, bool chance, bool level_seen) {
  if (kind == "blind") return chance ? "as chance" : "<b>away from chance: look for a leak</b>";
  if (kind == "feature") {
    if (chance) return "chance: does not tell by itself";
    return level_seen ? "tells by itself; level has a part in what is found" : "tells by itself";
  }
  if (kind == "scale") {
    if (chance) return "chance: level does not tell";
    return level_seen ? "level tells the class; features see it by what is found"
                      : "level tells the class; no feature uses it";
  }
  if (chance) return "chance: does not tell";
  return kind == "ratio" ? "tells the class: it decides what is found" : "tells by shape or strength of the target";
}

}  // namespace

std::string probes_table(const ordered_json& metrics, const Scenario& scenario) {
  // A benchmark has no random split.
  const bool has_random =
      std::ranges::any_of(metrics.at("probes"), [](const ordered_json& probe) { return probe.contains("random"); });
  std::vector<std::vector<std::string>> rows{{"probe", "what it is"}};
  if (has_random) rows.front().push_back("random split");
  rows.front().push_back("split " + division_words(metrics).by);
  rows.front().push_back("reading");
  const bool level_seen = !not_scaled(scenario.clutter).empty();
  for (const auto& entry : metrics.at("probes")) {
    rows.push_back(
        {escape_html(entry.at("name").get<std::string>()), escape_html(entry.at("meaning").get<std::string>())});
    if (has_random) rows.back().push_back(accuracy_cell(entry.at("random")));
    rows.back().push_back(accuracy_cell(entry.at("group")));
    rows.back().push_back(reading(entry.at("kind"), as_chance(metrics, entry), level_seen));
  }
  return html_table(rows, false);
}

std::string note_of_level(const ordered_json& metrics, const Scenario& scenario) {
  const ClutterSpec& clutter = scenario.clutter;
  const std::string absolute = not_scaled(clutter), power = percent(probe_accuracy(metrics, "total power")),
                    unseen = escape_html(division_words(metrics).unseen);
  if (!absolute.empty()) {
    return fmt::format(
        "<b>Features see the level.</b> {} not scaled to the target, which stands out the more the larger it is. Total "
        "power alone "
        "reaches {} on {}, the ratio of the target to clutter and noise {}. Centre weights are normalised and "
        "the network’s "
        "input is divided by its energy, but which centres are found depends on that ratio: part of what features "
        "reach here may be the "
        "target’s size. Clutter and noise at given ratios to the target (<code>clutter.level: scr</code>, "
        "<code>noise_level: "
        "cnr</code> or <code>snr</code>) take it out.",
        absolute, power, unseen, percent(probe_accuracy(metrics, "signal to clutter and noise")));
  }
  return fmt::format(
      "<b>Absolute level would settle it.</b> {}, so the level of a map is the target’s size. Total power alone "
      "reaches {} on {}. No feature group sees it: clutter and noise follow the target, centre weights are normalised, "
      "the "
      "network’s input is "
      "divided by its energy. A pipeline with unnormalised maps would look better for the wrong reason.",
      clutter.enabled
          ? fmt::format("The clutter follows the target (SCR in dB: {})",
                        escape_html(value_text(scenario, "clutter.scr_db", fmt::format("{:g}", clutter.scr_db))))
          : "There is no clutter",
      power, unseen);
}

namespace {

using nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

constexpr const char* kGroups[3] = {"handmade", "cnn", "fused"};
constexpr const char* kGroupNames[3] = {"hand-made", "CNN", "fused"};
constexpr const char* kRandom = "random";

// The protocols that metrics.json has: a benchmark has the second only.
std::vector<const char*> protocols_of(const ordered_json& metrics) {
  if (metrics.at("handmade").contains(kRandom)) return {kRandom, "group"};
  return {"group"};
}

double accuracy(const ordered_json& metrics, const char* group, const char* protocol) {
  return value_or_nan(metrics.at(group).at(protocol).at("accuracy"));
}

// "62.0, 81.3, 90.0 %" by ascending wave height
std::string by_height(const ordered_json& scores) {
  std::string text;
  for (const auto& row : scores.at("by_wave_height"))
    text += fmt::format("{}{:.1f}", text.empty() ? "" : ", ", 100 * value_or_nan(row.at("accuracy")));
  return text + " %";
}

// True if the accuracy increases from each height to the next.
bool rises(const ordered_json& scores) {
  double last = -1;
  for (const auto& row : scores.at("by_wave_height")) {
    if (!(value_or_nan(row.at("accuracy")) > last)) return false;
    last = value_or_nan(row.at("accuracy"));
  }
  return scores.at("by_wave_height").size() > 1;
}

// Median of a feature of class `label` in a bin of `list`; NaN if there is none.
double median_in(const ordered_json& metrics, const char* list, const std::string& bin, int label,
                 const char* feature) {
  for (const auto& entry : metrics.at("report").at(list)) {
    if (entry.at("bin") == bin && entry.at("label") == label) return value_or_nan(entry.at(feature).at("median"));
  }
  return std::nan("");
}

// Comparison of the accuracy on random rows with that of the group protocol; with overlapping 95 % intervals they are
// not distinguished.
std::string compared_protocols(const ordered_json& random, const ordered_json& group) {
  const double gap = 100 * (value_or_nan(random.at("accuracy")) - value_or_nan(group.at("accuracy")));
  const auto low = [](const ordered_json& scores) { return value_or_nan(scores.at("accuracy_95").at(0)); };
  const auto high = [](const ordered_json& scores) { return value_or_nan(scores.at("accuracy_95").at(1)); };
  const std::string by = fmt::format("by {:.1f} points", std::abs(gap));
  if (!std::isfinite(gap)) return "";
  if (std::abs(gap) < 0.05) return "; here they agree";
  if (low(random) > high(group)) return ", so that random rows flatter " + by;
  if (high(random) < low(group)) return "; here random rows are the harder test, " + by;
  const std::string direction = gap > 0 ? "higher" : "lower";
  const bool known = std::isfinite(low(random)) && std::isfinite(low(group));
  return fmt::format("; random rows come out {} {}, {}", direction, by,
                     known ? "which is within the intervals" : "without intervals to judge it by");
}

// Note on what the row counts of a table refer to.
std::string pooled_splits(int repeats, std::size_t protocols) {
  const char* const each = protocols > 1 ? " under each protocol" : "";
  if (repeats == 1) return fmt::format("<p>One split{}: a test prediction is a map.</p>\n", each);
  return fmt::format(
      "<p>{} splits{}, pooled: a map that several of them test has a prediction of each, so that "
      "there "
      "may be more predictions than maps. A test sea counts once.</p>\n",
      repeats, each);
}

// Accuracy under each protocol by the bins of every drawn key; empty without drawn keys.
std::string drawn_table(const ordered_json& metrics, const std::vector<const char*>& protocols) {
  std::string html;
  for (const char* protocol : protocols) {
    const auto of = [&](const char* group) -> const ordered_json& { return metrics.at(group).at(protocol); };
    if (!of("handmade").contains("by_drawn")) continue;
    Rows rows{{"drawn key", "values", "hand-made", "CNN", "fused", "test predictions", "test seas"}};
    for (std::size_t key = 0; key < of("handmade").at("by_drawn").size(); ++key) {
      const auto& condition = of("handmade").at("by_drawn").at(key);
      const std::string units = condition.at("units");
      for (std::size_t bin = 0; bin < condition.at("bins").size(); ++bin) {
        const auto& counts = condition.at("bins").at(bin);
        rows.push_back({escape_html(condition.at("column").get<std::string>()),
                        escape_html(counts.at("bin").get<std::string>()) +
                            (units.empty() || units == "1" ? "" : fmt::format(" {}", escape_html(units)))});
        for (const char* group : kGroups)
          rows.back().push_back(accuracy_cell(of(group).at("by_drawn").at(key).at("bins").at(bin)));
        rows.back().push_back(fmt::format("{}", counts.at("rows").get<std::size_t>()));
        rows.back().push_back(fmt::format("{}", counts.at("groups").get<std::size_t>()));
      }
    }
    html += fmt::format("<details><summary>By drawn quantity, {}</summary>\n{}</details>\n",
                        protocol == kRandom ? "random split" : escape_html(division_words(metrics).heading),
                        html_table(rows));
  }
  return html;
}

std::string item(const std::string& text) { return "<li>" + text + "</li>\n"; }

}  // namespace

std::string summary_tiles(const ordered_json& metrics) {
  const auto tile = [](const std::string& number, const std::string& words) {
    return fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", number, words);
  };
  double seconds = 0;
  for (const auto& entry : metrics.at("run").at("seconds")) seconds += value_or_nan(entry);
  const std::string unseen = escape_html(division_words(metrics).unseen);
  std::string html = "<div class=\"tiles\">\n";
  html += tile(fmt::format("{}", metrics.at("data").at("maps").get<std::size_t>()), "range-velocity maps");
  html += tile(percent(accuracy(metrics, "handmade", "group")), "hand-made features, " + unseen);
  html += tile(percent(accuracy(metrics, "cnn", "group")), "CNN features, " + unseen);
  html += tile(percent(accuracy(metrics, "fused", "group")), "fused features, " + unseen);
  if (protocols_of(metrics).size() > 1)
    html += tile(percent(accuracy(metrics, "fused", kRandom)), "fused, the paper's random split");
  html += tile(fmt::format("{:.0f} s", seconds), "run time");
  return html + "</div>\n";
}

std::string accuracy_tables(const ordered_json& metrics, const ClassNames& classes) {
  const DivisionWords division = division_words(metrics);
  std::string html;
  const std::vector<const char*> protocols = protocols_of(metrics);
  for (const char* protocol : protocols) {
    const bool random = protocol == kRandom;
    html += random ? "<h3>Random split of the maps (the paper’s protocol)</h3>\n"
                   : fmt::format("<h3>{}</h3>\n", escape_html(division.heading));
    Rows rows{{"H<sub>s</sub> (m)", "hand-made", "CNN", "fused", "test predictions", "test seas"}};
    const auto& heights = metrics.at("handmade").at(protocol).at("by_wave_height");
    for (std::size_t i = 0; i <= heights.size(); ++i) {
      const bool total = i == heights.size();
      std::vector<std::string> row{total ? "all" : heights.at(i).at("bin").get<std::string>()};
      for (const char* group : kGroups) {
        const auto& evaluation = metrics.at(group).at(protocol);
        row.push_back(accuracy_cell(total ? evaluation : evaluation.at("by_wave_height").at(i)));
      }
      const auto& counts = total ? metrics.at("handmade").at(protocol) : heights.at(i);
      row.push_back(fmt::format("{}", counts.at("rows").get<std::size_t>()));
      row.push_back(fmt::format("{}", counts.at("groups").get<std::size_t>()));
      rows.push_back(std::move(row));
    }
    html += html_table(rows);
  }

  html += drawn_table(metrics, protocols);
  html += "<h3>Further figures of merit, all wave heights</h3>\n";
  const bool has_both = metrics.at("handmade").contains("fewer_rows");  // fusions
  const bool two = classes.size() == 2;
  Rows rows{{"features, split", "fusion", "accuracy", two ? "AUC" : "AUC, mean over pairs of classes", "log loss"}};
  if (two) {
    rows.front().push_back(fmt::format("predictions: {} as {}", escape_html(classes[0]), escape_html(classes[1])));
    rows.front().push_back(fmt::format("{} as {}", escape_html(classes[1]), escape_html(classes[0])));
  }
  rows.front().push_back("maps the trees learned from, each split");
  const auto add = [&rows, two](const std::string& name, const std::string& fusion, const ordered_json& e) {
    const auto number = [](double x, const char* format) {
      return std::isfinite(x) ? fmt::format(fmt::runtime(format), x) : "–";
    };
    rows.push_back({name, fusion, accuracy_cell(e), number(value_or_nan(e.at("auc")), "{:.3f}"),
                    number(value_or_nan(e.at("log_loss")), "{:.3f}")});
    if (two) {
      rows.back().push_back(fmt::format("{}", confused(e, 2, 0, 1)));
      rows.back().push_back(fmt::format("{}", confused(e, 2, 1, 0)));
    }
    rows.back().push_back(fmt::format("{}", e.at("train_rows").get<std::size_t>()));
  };
  for (const char* protocol : protocols) {
    for (int k = 0; k < 3; ++k) {
      const auto& group = metrics.at(kGroups[k]);
      const std::string name = fmt::format("{}, {}", kGroupNames[k], protocol == kRandom ? "random" : division.by);
      if (k == 0) {
        add(name, "–", group.at(protocol));
        if (has_both) add(name, "rows of split", group.at("fewer_rows").at(protocol));
      } else {
        const std::string main = group.at("fusion"), other = main == "split" ? "in_sample" : "split";
        add(name, main, group.at(protocol));
        if (has_both) add(name, other, group.at(other).at(protocol));
      }
    }
  }
  html += html_table(rows);
  if (!two) html += confusion_table(metrics, classes);
  html += pooled_splits(metrics.at("split_repeats"), protocols.size());
  if (!has_both) return html;
  html +=
      "<p>Fusion <code>split</code>: the network learns from one part of the training maps, the trees from the other, "
      "so that the trees never see "
      "features of maps the network was fitted to. <code>in_sample</code>, the paper’s method, gives both the same "
      "maps: "
      "the trees then trust the "
      "network more than unseen maps justify. Hand-made features need no network; “rows of split” shows them with as "
      "few maps as the fused ones "
      "have.</p>\n";
  return html;
}

std::string claims_table(const ordered_json& metrics, const ClassNames& classes) {
  const auto verdict = [](bool holds) { return holds ? std::string("yes") : std::string("no"); };
  const std::vector<const char*> protocols = protocols_of(metrics);
  Rows rows{{"The paper’s claim"}};
  for (const char* protocol : protocols)
    rows[0].push_back(protocol == kRandom ? "Random split (the paper’s)" : "Split " + division_words(metrics).by);
  rows[0].push_back("Holds here");
  // A row of a claim with figures and verdict under each protocol.
  const auto add = [&](const std::string& claim, const auto& figures, const auto& holds) {
    rows.push_back({claim});
    std::vector<std::string> verdicts;
    for (const char* protocol : protocols) {
      rows.back().push_back(figures(protocol));
      verdicts.push_back(verdict(holds(protocol)));
    }
    rows.back().push_back(fmt::format("{}", fmt::join(verdicts, " / ")));
  };
  for (int k = 0; k < 3; ++k) {
    const auto& group = metrics.at(kGroups[k]);
    add(
        fmt::format("Accuracy rises with wave height: {} features", kGroupNames[k]),
        [&](const char* protocol) { return by_height(group.at(protocol)); },
        [&](const char* protocol) { return rises(group.at(protocol)); });
  }
  const auto of = [&](const char* protocol) {
    return std::array{accuracy(metrics, "handmade", protocol), accuracy(metrics, "cnn", protocol),
                      accuracy(metrics, "fused", protocol)};
  };
  add(
      "Fused features are best (hand-made / CNN / fused)",
      [&](const char* protocol) {
        const auto [a, b, c] = of(protocol);
        return fmt::format("{} / {} / {}", percent(a), percent(b), percent(c));
      },
      [&](const char* protocol) {
        const auto [a, b, c] = of(protocol);
        return c >= a && c >= b;
      });
  add(
      "Hand-made features alone exceed 86 %", [&](const char* protocol) { return percent(of(protocol)[0]); },
      [&](const char* protocol) { return of(protocol)[0] > 0.86; });
  if (classes.size() > 2) return html_table(rows, false);  // the next claim is on a ship and an array
  std::string residuals;
  bool array_scatters = true;
  for (const auto& row : metrics.at("handmade").at("group").at("by_wave_height")) {
    const std::string height = row.at("bin");
    const auto mwr = [&](int label) { return median_in(metrics, "features_by_wave_height", height, label, "mwr"); };
    residuals += fmt::format("{}{} m: {:.2g} / {:.2g}", residuals.empty() ? "" : "; ", height, mwr(1), mwr(0));
    array_scatters = array_scatters && mwr(0) > 2 * mwr(1);
  }
  rows.push_back(
      {fmt::format("A ship’s centres lie on a line, an array’s do not (median MWR of {} / {} in (m/s)², all aspects)",
                   escape_html(classes[1]), escape_html(classes[0])),
       residuals});
  if (protocols.size() > 1) rows.back().push_back("the same maps");
  rows.back().push_back(array_scatters ? "yes" : "not at every height");
  return html_table(rows, false);
}

std::string feature_table(const ordered_json& metrics, const ClassNames& classes) {
  Rows rows{{"class, H<sub>s</sub>", "MWR ((m/s)²)", "CCF", "σ<sub>r</sub> (m)", "σ<sub>v</sub> (m/s)", "centres",
             "line explains"}};
  const auto cell = [](const ordered_json& q, const char* format, double scale) {
    const auto number = [&](const char* key) {
      return fmt::format(fmt::runtime(format), scale * value_or_nan(q.at(key)));
    };
    return fmt::format("{} <small>({}–{})</small>", number("median"), number("lower"), number("upper"));
  };
  for (const auto& e : metrics.at("report").at("features_by_wave_height")) {
    rows.push_back({fmt::format("{}, {} m", escape_html(classes.at(e.at("label").get<std::size_t>())),
                                e.at("bin").get<std::string>()),
                    cell(e.at("mwr"), "{:.3g}", 1), cell(e.at("ccf"), "{:.2f}", 1),
                    cell(e.at("sigma_r_m"), "{:.1f}", 1), cell(e.at("sigma_v_mps"), "{:.3f}", 1),
                    cell(e.at("centres"), "{:.0f}", 1), cell(e.at("line_explained"), "{:.0f} %", 100)});
  }
  return html_table(rows) + "<p>Median and quartiles over all aspects.</p>\n";
}

std::string note_of_seas(const ordered_json& metrics) {
  const std::size_t seas = metrics.at("handmade").at("group").at("groups");
  const int repeats = metrics.at("split_repeats");
  const std::string by = division_words(metrics).by;
  return fmt::format(
      "<b>Few seas, wide intervals.</b> {} {} sea realisations{}. The bootstrap draws seas, not maps; with so few it "
      "is rough, and a "
      "height with one test sea has no interval at all. Differences smaller than the intervals are not findings.",
      repeats == 1 ? fmt::format("The split {} tests on", by)
                   : fmt::format("{} splits {}, pooled, test on", repeats, by),
      seas, repeats == 1 ? "" : " in all, each on a part of them");
}

std::string expert_notes(const ordered_json& metrics, const Scenario& scenario) {
  std::string html = "<ul>\n";
  const ordered_json& group = metrics.at("fused").at("group");
  const DivisionWords division = division_words(metrics);
  const std::string unseen = escape_html(division.unseen);
  if (protocols_of(metrics).size() > 1) {
    html += item(fmt::format(
        "<b>Two protocols.</b> Fused features reach {} on random maps and {} on {}{}. Maps of one sea, {:g} s apart "
        "and "
        "seen from several aspects, are not independent: {}.",
        percent(accuracy(metrics, "fused", kRandom)), percent(value_or_nan(group.at("accuracy"))), unseen,
        compared_protocols(metrics.at("fused").at(kRandom), group), scenario.dataset.interval_spacing_s,
        division.by_sea
            ? "the second figure is the one that would carry over to another day"
            : fmt::format("a split {} has them on both sides, so that neither figure is that of another day",
                          division.by)));
  }
  html += item(note_of_seas(metrics));
  html += item(note_of_level(metrics, scenario));
  const auto alone = [&metrics](const char* name) { return percent(probe_accuracy(metrics, name)); };
  html +=
      item(fmt::format("<b>Geometry or motion?</b> By itself, on {}, the range spread σ<sub>r</sub> reaches "
                       "{}, the velocity spread σ<sub>v</sub> {}, MWR {}, CCF {}; the mere "
                       "number of centres {}. Range spread and number of centres follow from length, layout and "
                       "richness of the target, not from its micro-motion: one ship and one "
                       "array, always with the same layout, can be told apart by them in any sea. The network is free "
                       "to use them too. Only arrays matched to the ship in extent, "
                       "strength and number of scatterers would show what micro-motion alone is worth.",
                       unseen, alone("sigma_r alone"), alone("sigma_v alone"), alone("MWR alone"), alone("CCF alone"),
                       alone("number of centres")));
  if (!rises(metrics.at("handmade").at("group"))) {
    html += item(
        "<b>Why accuracy need not rise with the waves.</b> The flatter the sea, the more exactly length and layout "
        "repeat from map to map, and "
        "the trees learn them. Waves blur this before micro-motion has grown enough to replace it.");
  }
  bool clean = true;
  for (const auto& entry : metrics.at("probes")) {
    if (entry.at("kind") == "blind") clean = clean && as_chance(metrics, entry);
  }
  const ClassNames classes = class_names(scenario);
  const std::string chance = guessing(group).text();
  html +=
      item(clean ? fmt::format(
                       "<b>No leak by construction.</b> Hop code and sample order, which know nothing of the target, "
                       "stay at chance ({} on {}, from the shares of the classes).",
                       chance, unseen)
                 : fmt::format(
                       "<b>Look for a leak.</b> A quantity that knows nothing of the target (hop code or sample order) "
                       "is away from chance ({} on {}, from the shares of the classes) by more than its "
                       "interval. With several probes and few seas this happens by chance now and then; repeat with "
                       "another seed before believing it.",
                       chance, unseen));
  // The random code's pedestal and the velocity cell determine what the features can resolve.
  const PulseTrain train = make_pulse_train(scenario.radar, scenario.map.range_span_m, scenario.seed, 0);
  const double cell = train.velocity_resolution_mps();
  const std::string shown = metrics.at("report").at("features_by_azimuth").at(0).at(kWaveHeightColumn);
  const std::string residuals = by_class(classes, [&](int label) {
    return fmt::format("{:.2g}", median_in(metrics, "features_by_wave_height", shown, label, "mwr"));
  });
  html +=
      item(fmt::format("<b>Scale of the residual.</b> One velocity cell is {:.3f} m/s; a spread over one cell alone "
                       "gives an MWR of {:.2g} (m/s)². At H<sub>s</sub> {} m "
                       "the medians are {} (m/s)².",
                       cell, cell * cell / 12, shown, residuals));
  std::string aspects;
  for (const auto& e : metrics.at("report").at("features_by_azimuth")) {
    if (e.at("label") != 1) continue;
    const std::string azimuth = e.at("bin");
    std::vector<std::string> explained;
    for (int label = static_cast<int>(classes.size()) - 1; label >= 0; --label) {
      const double line = median_in(metrics, "features_by_azimuth", azimuth, label, "line_explained");
      explained.push_back(fmt::format("{:.0f}", 100 * line));
    }
    aspects += fmt::format("{}{}°: {} %", aspects.empty() ? "" : ", ", azimuth, fmt::join(explained, " / "));
  }
  std::vector<std::string> names;
  for (auto name = classes.rbegin(); name != classes.rend(); ++name) names.push_back(escape_html(*name));
  html += item(
      fmt::format("<b>When a ship is a line.</b> v = r̂·(ω × x) depends on cross-range coordinates alone: it is "
                  "linear in range only for a line-like hull seen obliquely, mast "
                  "height breaks it, and it fades near bow and stern. A flat line (nothing moves) explains no variance "
                  "and is a line all the same: there MWR is what is small. Velocity variance explained by the line "
                  "(adjusted for the number of centres, 0 for loose points), "
                  "medians of {} at H<sub>s</sub> {} m: {}.",
                  fmt::join(names, " / "), shown, aspects));
  if (scenario.radar.hop_code != HopCode::kStepped) {
    html += item(
        "<b>The pedestal is not noise.</b> Random hopping leaves a pedestal at all velocities within ±6 m of every "
        "strong centre, 15 to 24 dB below it. It shows as vertical "
        "stripes in the maps and grows with the number of centres that share 6 m, so a ship’s is higher: the probe "
        "“pedestal” says how far that alone would go.");
  }
  const std::size_t degenerate = metrics.at("data").at("maps_with_fewer_than_3_centres");
  if (degenerate > 0) {
    html +=
        item(fmt::format("<b>Thin maps.</b> {} of {} maps contain fewer than three centres; their line features are "
                         "defined but say little.",
                         degenerate, metrics.at("data").at("maps").get<std::size_t>()));
  }
  return html + "</ul>\n";
}

namespace {

using nlohmann::ordered_json;

// "93.1"; a dash for null.
std::string per_cent(const ordered_json& fraction) {
  return fraction.is_null() ? "–" : fmt::format("{:.1f}", 100 * fraction.get<double>());
}

std::string with_interval(const ordered_json& entry) {
  const ordered_json& interval = entry.at("interval");
  if (interval.at(0).is_null()) return per_cent(entry.at("accuracy"));
  return fmt::format("{} ({:.0f}–{:.0f})", per_cent(entry.at("accuracy")), 100 * interval.at(0).get<double>(),
                     100 * interval.at(1).get<double>());
}

// A row per entry of `member`: in total and by wave height.
std::string accuracies(const ordered_json& benchmark, const char* member, const char* title) {
  std::vector<std::vector<std::string>> rows{{title, "all"}};
  for (const auto& [height, entry] : benchmark.at("baselines").at("handmade").at("by").items())
    rows.front().push_back("Hs " + escape_html(height) + " m");
  for (const auto& [name, entry] : benchmark.at(member).items()) {
    const bool leaks = entry.contains("leaks") && entry.at("leaks").get<bool>();
    rows.push_back({escape_html(name) + (leaks ? " *" : ""), with_interval(entry)});
    for (const auto& of_height : entry.at("by")) rows.back().push_back(per_cent(of_height.at("accuracy")));
  }
  return html_table(rows);
}

std::string claims(const ordered_json& benchmark) {
  std::vector<std::vector<std::string>> rows{{"claim of the paper", "", "figures"}};
  for (const ordered_json& claim : benchmark.at("claims")) {
    const ordered_json& held = claim.at("held");
    rows.push_back({escape_html(claim.at("claim").get<std::string>()),
                    held.is_null()     ? "undecided"
                    : held.get<bool>() ? "held"
                                       : "not held",
                    escape_html(claim.at("why").get<std::string>())});
  }
  return html_table(rows, false);
}

}  // namespace

std::string benchmark_section(const ordered_json& benchmark, const std::string& report) {
  const std::string name = escape_html(benchmark.at("benchmark").get<std::string>());
  std::string html = fmt::format(
      "<p>Benchmark <b>{}</b>{}: {} maps in {} seas; {}. Accuracy in %, in brackets the 95 % interval. Each "
      "quantity without motion is classified by itself; their intervals are for all of them at once, * marks those "
      "that differ from chance.{}</p>\n",
      name, benchmark.at("small").get<bool>() ? " at its small size, whose figures say little" : "",
      benchmark.at("maps").get<std::uint64_t>(), benchmark.at("seas").get<std::uint64_t>(),
      escape_html(benchmark.at("division").get<std::string>()),
      report.empty() ? "" : fmt::format(" <a href=\"{}\">Its own report</a>.", escape_html(report)));
  return html + accuracies(benchmark, "baselines", "features") + accuracies(benchmark, "floor", "without motion") +
         claims(benchmark);
}

}  // namespace seaglint
