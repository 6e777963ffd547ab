// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/key_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/text/names.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/key_meanings.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

namespace {

class Lister : public FieldVisitor {
 public:
  std::vector<KeyEntry> rows;

  void number(const char* key, double& value, const Bound& bound) override {
    add(key, is_optional_ ? "" : fmt::format("{}", value), number_text(bound));
  }
  void number_or_auto(const char* key, std::optional<double>& value, const Bound& bound) override {
    add(key, value ? fmt::format("{}", *value) : "auto", "auto, or " + number_text(bound));
  }
  void integer(const char* key, int& value, const Bound& bound) override {
    const bool single = bound.lowest == bound.highest;
    add(key, fmt::format("{}", value), single ? fmt::format("{}", bound.lowest) : "whole, " + bound.text());
  }
  void natural(const char* key, std::uint64_t& value) override {
    add(key, fmt::format("{}", value), "whole, 0 <= x < 2^63");
  }
  void flag(const char* key, bool& value) override { add(key, value ? "true" : "false", "true, false"); }
  void text(const char* key, std::string& value) override { add(key, value, "text"); }
  void choice(const char* key, std::size_t& index, Names names) override {
    add(key, names[index], fmt::format("{}", fmt::join(names, ", ")));
  }
  void triple(const char* key, std::array<double, 3>& values, const Bound& bound) override {
    add(key, is_optional_ ? "" : fmt::format("[{}]", fmt::join(values, ", ")), "[x, y, z], " + number_text(bound));
  }
  void ratio(const char* key, double& fraction) override {
    add(key, fmt::format("{:g}:{:g}", 10 * fraction, 10 * (1 - fraction)), "a:b, both greater than 0");
  }
  void sweep(const char* key, Sweep& values, const Bound& bound, Names words, std::size_t*) override {
    const std::string other = words.empty() ? "" : fmt::format(", or {}", fmt::join(words, " or "));
    add(key, fmt::format("{}", fmt::join(values, ", ")),
        fmt::format("number, list or from:to:step, {}{}", number_text(bound), other));
  }
  void hold_outs(const char* key, std::vector<HoldOutSpec>&) override {
    add(key, "{}", "{COLUMN: value, LOW:HIGH or a list of these}");
  }
  void section(const char* key, const Fields& fields) override {
    is_optional_ = false;
    below(key, [&] { fields(*this); });
  }
  void list(const char* key, std::size_t, std::size_t, const std::function<void(std::size_t)>& resize,
            const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    resize(1);
    below(fmt::format("{}.N", key), [&] { item(0, *this); });
  }
  void words(const char* key, std::vector<std::string>& values, std::size_t least, std::size_t most) override {
    add(key, fmt::format("[{}]", fmt::join(values, ", ")),
        fmt::format("list of {} to {} different names", least, most));
  }
  void dictionary(const char* key, const std::vector<std::string>&, std::size_t,
                  const std::function<void(const std::vector<std::string>&)>& rename,
                  const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    rename({"NAME"});
    below(fmt::format("{}.NAME", key), [&] { item(0, *this); });
  }
  void require(const char* key) override { required_ = prefix_ + key; }
  bool optional(const char*, bool present) override {
    is_optional_ = !present;
    return true;
  }

 private:
  static std::string number_text(const Bound& bound) {
    return fmt::format("{}{}", bound.or_zero ? "0 or " : "", bound.text());
  }

  void add(const char* key, const std::string& standard, const std::string& allowed) {
    const std::string path = prefix_ + key;
    rows.push_back({path, path == required_ ? "required" : standard, allowed});
    is_optional_ = false;
  }

  template <typename Visit>
  void below(const std::string& key, const Visit& visit) {
    const std::string before = prefix_;
    prefix_ += key + ".";
    visit();
    prefix_ = before;
  }

  std::string prefix_;
  std::string required_;      // path of the last required key
  bool is_optional_ = false;  // the next field has no default
};

// The key with names of targets and indices as NAME and N: targets.ship.points.0 -> targets.NAME.points.N.
std::string general_key(std::string_view key) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    std::string word(key.substr(begin, end - begin));
    const bool number = !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
    if (words.size() == 1 && words[0] == "targets") word = "NAME";
    words.push_back(number ? "N" : word);
    begin = end + 1;
  }
  return fmt::format("{}", fmt::join(words, "."));
}

}  // namespace

std::vector<KeyEntry> scenario_keys() {
  Scenario scenario;
  Lister lister;
  visit_fields(scenario, lister);
  return lister.rows;
}

std::string list_keys(std::string_view of) {
  std::vector<KeyEntry> rows = scenario_keys();
  if (!of.empty()) {
    const std::string asked = general_key(of);
    std::vector<std::string> known;
    for (const KeyEntry& row : rows) known.push_back(row.key);
    std::erase_if(rows, [&](const KeyEntry& row) { return row.key != asked && !row.key.starts_with(asked + "."); });
    if (rows.empty()) {
      throw InputError(fmt::format("{}: unknown key or section: {}", of,
                                   near_suggestion(asked, known).value_or("`seaglint keys` lists all")));
    }
  }
  std::size_t path_width = 0;
  std::size_t standard_width = 0;
  for (const KeyEntry& row : rows) {
    path_width = std::max(path_width, row.key.size());
    standard_width = std::max(standard_width, row.standard.size());
  }
  std::string text;
  for (const KeyEntry& row : rows) {
    text += fmt::format("{:{}}  {:{}}  {}\n", row.key, path_width, row.standard, standard_width, row.allowed);
    if (!of.empty()) text += fmt::format("    {}\n", meaning_of(row.key));
  }
  return text;
}

}  // namespace seaglint
