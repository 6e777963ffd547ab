// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr const char* kNumbers = "drawn_numbers";
constexpr const char* kWords = "drawn_words";

// Ends of keys with their units, longer ones first where one ends with another.
constexpr std::pair<std::string_view, const char*> kUnits[] = {
    {"_deg_s", "deg/s"}, {"_mps", "m/s"}, {"_deg", "deg"},   {"_db", "dB"},   {"_mm", "mm"},
    {"_km", "km"},       {"_us", "us"},   {"_m2", "m2"},     {"_m3", "m3"},   {"_kg", "kg"},
    {"_m", "m"},         {"_s", "s"},     {"_c", "Celsius"}, {"_psu", "psu"},
};

std::vector<std::string> keys_of(const Hdf5Reader& file, const char* attribute) {
  std::vector<std::string> keys;
  std::istringstream list(file.attribute(attribute));
  for (std::string key; list >> key;) {
    const bool is_key = std::all_of(key.begin(), key.end(), [](unsigned char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
             c == '.';
    });
    if (!is_key || key.front() == '.') throw WorkError(fmt::format("attribute {}: a name is no key", attribute));
    keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace

DrawnKeys drawn_keys(const SampleRecord& record) {
  DrawnKeys keys;
  for (const auto& drawn : record.drawn_numbers) keys.numbers.push_back(drawn.key);
  for (const auto& drawn : record.drawn_words) keys.words.push_back(drawn.key);
  return keys;
}

bool same_drawn(const SampleRecord& a, const SampleRecord& b) {
  return a.drawn_numbers == b.drawn_numbers && a.drawn_words == b.drawn_words;
}

std::string drawn_path(const std::string& key) { return "/drawn/" + key; }

ArrayText drawn_text(const std::string& key) {
  const auto unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                 [&](const auto& entry) { return std::string_view(key).ends_with(entry.first); });
  return {unit == std::end(kUnits) ? "1" : unit->second, "drawn value of the scenario's key " + key};
}

void create_drawn(Hdf5Writer& file, const DrawnKeys& keys, std::uint64_t rows, std::uint64_t chunk) {
  if (keys.empty()) return;
  if (!keys.numbers.empty()) file.attribute(kNumbers, fmt::format("{}", fmt::join(keys.numbers, " ")));
  if (!keys.words.empty()) file.attribute(kWords, fmt::format("{}", fmt::join(keys.words, " ")));
  file.group("/drawn");
  for (const std::string& key : keys.numbers)
    file.array(drawn_path(key), ArrayType::kDouble, {rows}, {chunk}, drawn_text(key));
  for (const std::string& key : keys.words)
    file.array(drawn_path(key), ArrayType::kName, {rows}, {chunk}, drawn_text(key));
}

void write_drawn(Hdf5Writer& file, std::uint64_t first, const std::vector<const SampleRecord*>& records) {
  const DrawnKeys keys = drawn_keys(*records.front());
  for (const SampleRecord* record : records)
    SEAGLINT_CHECK(drawn_keys(*record) == keys, "all samples have the same drawn keys");
  for (std::size_t i = 0; i < keys.numbers.size(); ++i) {
    std::vector<double> values;
    for (const SampleRecord* record : records) values.push_back(record->drawn_numbers[i].value);
    file.write<double>(drawn_path(keys.numbers[i]), first, values);
  }
  for (std::size_t i = 0; i < keys.words.size(); ++i) {
    std::vector<std::string> values;
    for (const SampleRecord* record : records) values.push_back(record->drawn_words[i].value);
    file.write_names(drawn_path(keys.words[i]), first, values);
  }
}

DrawnKeys read_drawn_keys(const Hdf5Reader& file) { return {keys_of(file, kNumbers), keys_of(file, kWords)}; }

void read_drawn(const Hdf5Reader& file, std::uint64_t first, const std::vector<SampleRecord*>& records) {
  const DrawnKeys keys = read_drawn_keys(file);
  for (const std::string& key : keys.numbers) {
    const std::vector<double> values = file.rows<double>(drawn_path(key), first, records.size());
    for (std::size_t i = 0; i < records.size(); ++i) records[i]->drawn_numbers.push_back({key, values[i]});
  }
  for (const std::string& key : keys.words) {
    const std::vector<std::string> values = file.names(drawn_path(key), first, records.size());
    for (std::size_t i = 0; i < records.size(); ++i) records[i]->drawn_words.push_back({key, values[i]});
  }
}

}  // namespace seaglint
