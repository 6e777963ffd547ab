// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/key_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

namespace {

struct Row {
  std::string path;
  std::string standard;
  std::string allowed;
};

class Lister : public FieldVisitor {
 public:
  std::vector<Row> rows;

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
  void section(const char* key, const Fields& fields) override {
    is_optional_ = false;
    below(key, [&] { fields(*this); });
  }
  void list(const char* key, std::size_t, std::size_t, const std::function<void(std::size_t)>& resize,
            const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    resize(1);
    below(fmt::format("{}.N", key), [&] { item(0, *this); });
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

}  // namespace

std::string list_keys() {
  Scenario scenario;
  Lister lister;
  visit_fields(scenario, lister);
  std::size_t path_width = 0;
  std::size_t standard_width = 0;
  for (const Row& row : lister.rows) {
    path_width = std::max(path_width, row.path.size());
    standard_width = std::max(standard_width, row.standard.size());
  }
  std::string text;
  for (const Row& row : lister.rows) {
    text += fmt::format("{:{}}  {:{}}  {}\n", row.path, path_width, row.standard, standard_width, row.allowed);
  }
  return text;
}

}  // namespace seaglint
