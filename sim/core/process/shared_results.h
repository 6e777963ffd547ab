// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Results that several threads need: one of them computes a result, the others wait for it.

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace seaglint {

// Keeps the results of the `kept` keys that were requested last for the first time. Any thread may use it.
template <class Key, class Value>
class SharedResults {
 public:
  explicit SharedResults(std::size_t kept) : kept_(kept) {}

  // The result of a key, make() where it is not kept. An exception of make() is the caller's; the next one tries again.
  template <class Make>
  std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    const std::shared_ptr<Slot> slot = slot_of(key);
    // std::call_once() waits for ever after an exception where pthread_once() does not know of it (thread sanitizer).
    const std::lock_guard lock(slot->making);
    if (!slot->value) slot->value = std::make_shared<const Value>(make());
    return slot->value;
  }

 private:
  struct Slot {
    explicit Slot(const Key& of) : key(of) {}
    Key key;
    std::mutex making;
    std::shared_ptr<const Value> value;
  };

  std::shared_ptr<Slot> slot_of(const Key& key) {
    const std::lock_guard lock(mutex_);
    for (const auto& slot : slots_) {
      if (slot->key == key) return slot;
    }
    if (slots_.size() == kept_) slots_.erase(slots_.begin());
    slots_.push_back(std::make_shared<Slot>(key));
    return slots_.back();
  }

  std::size_t kept_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<Slot>> slots_;  // most recently made last
};

}  // namespace seaglint
