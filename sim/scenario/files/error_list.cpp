// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/error_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr const char* kVersionKey = "seaglint";

}  // namespace

void ErrorList::add(const InputError& error, Keys keys) {
  if (is_full()) return count_further(keys);
  const auto* placed = dynamic_cast<const PlacedError*>(&error);
  const std::string first = keys.size() == 0 ? "" : std::string(*keys.begin());
  const Location location = placed != nullptr ? placed->location : document_.location_of(first);
  for (std::string& message : messages_of(error)) errors_.push_back({location, std::move(message), first});
  unusable_.insert(keys.begin(), keys.end());
}

void ErrorList::count_further(Keys keys) {
  ++further_;
  unusable_.insert(keys.begin(), keys.end());
}

bool ErrorList::is_unusable(std::string_view key_path) const {
  if (unusable_.empty()) return false;
  if (key_path.empty() || unusable_.contains(key_path)) return true;
  const std::string below = std::string(key_path) + ".";
  const auto next = unusable_.lower_bound(below);
  return next != unusable_.end() && next->starts_with(below);
}

bool ErrorList::concerns(std::string_view key_path) const {
  if (unusable_.empty()) return false;
  if (unusable_.contains("") || is_unusable(key_path)) return true;
  for (std::size_t dot = key_path.find('.'); dot != std::string_view::npos; dot = key_path.find('.', dot + 1)) {
    if (unusable_.contains(key_path.substr(0, dot))) return true;
  }
  return false;
}

std::vector<std::string> ErrorList::messages(const std::string& end) const {
  std::vector<Entry> sorted = errors_;
  const bool is_other_version = unusable_.contains(kVersionKey);
  if (is_other_version) std::erase_if(sorted, [](const Entry& entry) { return entry.key != kVersionKey; });
  std::ranges::stable_sort(sorted, {}, [](const Entry& entry) {
    return std::tuple(entry.location.override_index, entry.location.line, entry.location.column);
  });
  std::vector<std::string> messages;
  for (const Entry& entry : sorted) messages.push_back(entry.message + end);
  if (further_ > 0 && !is_other_version)
    messages.push_back(fmt::format("{}: and {} more", document_.file_name, further_));
  return messages;
}

void ErrorList::throw_if_any(const std::string& end) const {
  if (!is_empty()) throw_input_errors(messages(end));
}

}  // namespace seaglint
