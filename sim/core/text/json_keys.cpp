// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/json_keys.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/text/shown.h"

namespace seaglint {
namespace {

// Events of the parser; each returns whether to go on.
class KeyCheck : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool key(string_t& name) override {
    if (open_.back().insert(name).second) return true;
    repeated = name;
    return false;
  }
  bool start_object(std::size_t) override {
    open_.emplace_back();
    return true;
  }
  bool end_object() override {
    open_.pop_back();
    return true;
  }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

  std::optional<std::string> repeated;

 private:
  std::vector<std::unordered_set<std::string>> open_;  // keys of the objects around the present place
};

}  // namespace

void refuse_repeated_keys(std::string_view json, const std::string& name) {
  KeyCheck check;
  nlohmann::json::sax_parse(json.begin(), json.end(), &check);
  if (check.repeated)
    throw InputError(fmt::format("{}: the key {} appears twice in an object", name, in_quotes(*check.repeated)));
}

}  // namespace seaglint
