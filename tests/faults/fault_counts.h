// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What the preloaded library of injected faults (fault_shim.cpp) and the test that starts a program with it share: the
// kinds of calls, the environment variables and a file mapped by both.
//
//   SEAGLINT_FAULT_FOLDER  calls on paths below this absolute folder are counted
//   SEAGLINT_FAULT_COUNTS  a file of sizeof(FaultCounts) bytes, outside the folder
//   SEAGLINT_FAULT         KIND:NUMBER:FAULT, the call of a kind, from 1, that fails with this errno or as the negative
//                          numbers below say; KIND:NUMBER:FAULT:END counts only calls on paths that end so

#include <array>
#include <atomic>
#include <cstdint>

namespace seaglint {

enum class FaultKind { kOpen, kRead, kWrite, kSync, kRename, kClose, kTruncate, kUnlink, kMkdir, kStat, kList };

constexpr std::array<const char*, 11> kFaultKinds{"open",     "read",   "write", "sync", "rename", "close",
                                                  "truncate", "unlink", "mkdir", "stat", "list"};

// In place of an errno.
constexpr int kShort = -1;  // half of the bytes are read or written
constexpr int kKill = -2;   // SIGKILL to the process before the call
constexpr int kStop = -3;   // SIGSTOP, after which the call is done

// Filled with zeros by the test; counted by the program and its child processes alike.
struct FaultCounts {
  std::array<std::atomic<std::uint64_t>, kFaultKinds.size()> calls{};
  std::atomic<std::uint64_t> matching{0};  // of the fault's kind and on its paths
  std::atomic<std::uint64_t> injected{0};
  std::array<char, 512> path{};  // of the call that failed
};

}  // namespace seaglint
