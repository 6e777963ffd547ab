// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/varied_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "sim/core/process/printable.h"
#include "sim/scenario/fields.h"

namespace seaglint {

namespace {

constexpr std::size_t kMaxListed = 8;  // values of a sweep
constexpr std::size_t kMaxWords = 8;   // that are compared

// At most `count` of the values, equally spaced, first and last among them.
std::vector<std::string> spaced(const std::vector<std::string>& values, std::size_t count) {
  if (values.size() <= count) return values;
  std::vector<std::string> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(values[i * (values.size() - 1) / (count - 1)]);
  return some;
}

// Collects the sweeps with several values.
class SweepCollector : public FieldVisitor {
 public:
  explicit SweepCollector(std::string path = {}) : path_(std::move(path)) {}

  std::vector<std::pair<std::string, Sweep>> found;

  void number(const char*, double&, const Bound&) override {}
  void number_or_auto(const char*, std::optional<double>&, const Bound&) override {}
  void integer(const char*, int&, const Bound&) override {}
  void natural(const char*, std::uint64_t&) override {}
  void flag(const char*, bool&) override {}
  void text(const char*, std::string&) override {}
  void choice(const char*, std::size_t&, Names) override {}
  void triple(const char*, std::array<double, 3>&, const Bound&) override {}
  void ratio(const char*, double&) override {}
  void sweep(const char* key, Sweep& values, const Bound&, Names, std::size_t*) override {
    if (values.size() > 1) found.emplace_back(path_of(key), values);
  }
  void hold_outs(const char*, std::vector<HoldOutSpec>&) override {}
  void section(const char* key, const Fields& fields) override { visit(path_of(key), fields); }
  void list(const char* key, std::size_t size, std::size_t, const std::function<void(std::size_t)>&,
            const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    for (std::size_t i = 0; i < size; ++i)
      visit(path_of(fmt::format("{}.{}", key, i)), [&](FieldVisitor& v) { item(i, v); });
  }
  void words(const char*, std::vector<std::string>&, std::size_t, std::size_t) override {}
  void dictionary(const char* key, const std::vector<std::string>& names, std::size_t,
                  const std::function<void(const std::vector<std::string>&)>&,
                  const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    for (std::size_t i = 0; i < names.size(); ++i)
      visit(path_of(fmt::format("{}.{}", key, names[i])), [&](FieldVisitor& v) { item(i, v); });
  }
  void require(const char*) override {}
  bool optional(const char*, bool present) override { return present; }

 private:
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  void visit(const std::string& path, const Fields& fields) {
    SweepCollector nested(path);
    fields(nested);
    found.insert(found.end(), nested.found.begin(), nested.found.end());
  }

  std::string path_;
};

std::string number_text(double value) { return fmt::format("{}", value); }

}  // namespace

std::string VariedKey::text() const {
  if (drawn != nullptr) return fmt::format("{}, once per {}", shown(drawn->text()), name(drawn->per));
  if (sweep.size() <= kMaxListed) return fmt::format("{}", fmt::join(sweep, ", "));
  const auto [low, high] = std::ranges::minmax(sweep);
  return fmt::format("{} to {} in {} values", low, high, sweep.size());
}

std::vector<std::string> VariedKey::trial_values() const {
  std::vector<std::string> values;
  if (drawn != nullptr) {
    values = {drawn->distribution.middle()};
    for (std::string& end : spaced(drawn->distribution.ends(), kMaxWords)) values.push_back(std::move(end));
  } else {
    for (const double value : {sweep[sweep.size() / 2], sweep.front(), sweep.back()})
      values.push_back(number_text(value));
  }
  std::set<std::string> known;
  std::erase_if(values, [&](const std::string& value) { return !known.insert(value).second; });
  return values;
}

std::vector<VariedKey> varied_keys(const Scenario& scenario) {
  Scenario copy = scenario;
  SweepCollector sweeps;
  visit_fields(copy, sweeps);
  std::vector<VariedKey> keys;
  for (auto& [path, values] : sweeps.found) keys.push_back({path, std::move(values), nullptr});
  for (const Variation& variation : scenario.variations) keys.push_back({variation.key_path, {}, &variation});
  return keys;
}

}  // namespace seaglint
