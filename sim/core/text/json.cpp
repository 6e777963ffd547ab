// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/json.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"

namespace seaglint {

namespace {

constexpr std::size_t kDeepest = 64;  // levels of lists and objects; real files have about ten

// Events of the parser; each returns whether to go on.
class KeyCheck : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit KeyCheck(std::size_t max_keys) : max_keys_(max_keys) {}

  bool key(string_t& name) override {
    if (!open_.back().insert(name).second)
      return stop(fmt::format("the key {} appears twice in an object", in_quotes(name)));
    return open_.back().size() <= max_keys_ || stop(fmt::format("an object has more than {} keys", max_keys_));
  }
  bool start_object(std::size_t) override {
    open_.emplace_back();
    return descend();
  }
  bool end_object() override {
    open_.pop_back();
    return ascend();
  }
  bool start_array(std::size_t) override { return descend(); }
  bool end_array() override { return ascend(); }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

  std::string fault;

 private:
  bool stop(std::string what) {
    fault = std::move(what);
    return false;
  }
  bool descend() {
    return ++depth_ <= kDeepest || stop(fmt::format("the JSON is nested more than {} levels deep", kDeepest));
  }
  bool ascend() {
    --depth_;
    return true;
  }

  std::size_t max_keys_, depth_ = 0;
  std::vector<std::unordered_set<std::string>> open_;  // keys of the objects around the present place
};

}  // namespace

void check_json(std::string_view json, const std::string& name, std::size_t max_keys) {
  KeyCheck check(max_keys);
  nlohmann::json::sax_parse(json.begin(), json.end(), &check);
  if (!check.fault.empty()) throw InputError(fmt::format("{}: {}", name, check.fault));
}

nlohmann::ordered_json number_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

std::uint64_t whole_number(const nlohmann::ordered_json& object, const char* key, const std::string& name) {
  const nlohmann::ordered_json& value = object.at(key);
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  throw InputError(fmt::format("{}: {}: {}: must be a whole number", name, key, shown(value.dump())));
}

std::string json_problem(const std::exception& error) {
  if (const auto* broken = dynamic_cast<const nlohmann::json::parse_error*>(&error))
    return fmt::format("no valid JSON from byte {} on", broken->byte);
  const std::string text = error.what();
  const std::size_t end = text.find("] ");
  return end == std::string::npos ? text : text.substr(end + 2);
}

}  // namespace seaglint
