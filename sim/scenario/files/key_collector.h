// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The keys of one map of a scenario, of which others are refused.

#include <string>
#include <vector>

#include "sim/scenario/fields.h"

namespace seaglint {

// The keys a map may have.
class KeyCollector : public FieldVisitor {
 public:
  std::vector<std::string> keys;

  void number(const char* key, double&, const Bound&) override { keys.emplace_back(key); }
  void number_or_auto(const char* key, std::optional<double>&, const Bound&) override { keys.emplace_back(key); }
  void integer(const char* key, int&, const Bound&) override { keys.emplace_back(key); }
  void natural(const char* key, std::uint64_t&) override { keys.emplace_back(key); }
  void flag(const char* key, bool&) override { keys.emplace_back(key); }
  void text(const char* key, std::string&) override { keys.emplace_back(key); }
  void choice(const char* key, std::size_t&, Names) override { keys.emplace_back(key); }
  void triple(const char* key, std::array<double, 3>&, const Bound&) override { keys.emplace_back(key); }
  void ratio(const char* key, double&) override { keys.emplace_back(key); }
  void sweep(const char* key, Sweep&, const Bound&, Names, std::size_t*) override { keys.emplace_back(key); }
  void hold_outs(const char* key, std::vector<HoldOutSpec>&) override { keys.emplace_back(key); }
  void section(const char* key, const Fields&) override { keys.emplace_back(key); }
  void list(const char* key, std::size_t, std::size_t, const std::function<void(std::size_t)>&,
            const std::function<void(std::size_t, FieldVisitor&)>&) override {
    keys.emplace_back(key);
  }
  void words(const char* key, std::vector<std::string>&, std::size_t, std::size_t) override { keys.emplace_back(key); }
  void dictionary(const char* key, const std::vector<std::string>&, std::size_t,
                  const std::function<void(const std::vector<std::string>&)>&,
                  const std::function<void(std::size_t, FieldVisitor&)>&) override {
    keys.emplace_back(key);
  }
  void require(const char*) override {}
  bool optional(const char* key, bool) override {
    keys.emplace_back(key);
    return false;
  }
};

}  // namespace seaglint
