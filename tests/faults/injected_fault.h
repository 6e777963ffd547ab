// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A job (job_folder.h) in which one call fails, and what is left of it.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "sim/core/numbers/random.h"
#include "tests/faults/fault_counts.h"
#include "tests/faults/job_folder.h"

namespace seaglint {

struct Fault {
  const Job* job = nullptr;
  FaultKind kind = FaultKind::kOpen;
  std::uint64_t number = 0;  // of the call, from 1
  int error = 0;
  std::string end = {};  // of the paths on which calls are counted

  std::string text() const {
    const char* const name = error == kShort  ? "short"
                             : error == kKill ? "SIGKILL"
                             : error == kStop ? "SIGSTOP"
                                              : ::strerrorname_np(error);
    return fmt::format("{}: {} {} {}: {}", job->name, kFaultKinds[static_cast<std::size_t>(kind)], number, end, name);
  }
};

// The file that the program and the test map.
class MappedCounts {
 public:
  explicit MappedCounts(std::filesystem::path file) : file_(std::move(file)) {
    write_file(file_, std::string(sizeof(FaultCounts), '\0'));
    const int descriptor = ::open(file_.c_str(), O_RDWR | O_CLOEXEC);
    void* const mapped = ::mmap(nullptr, sizeof(FaultCounts), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    counts_ = new (mapped) FaultCounts{};
  }
  ~MappedCounts() { ::munmap(counts_, sizeof(FaultCounts)); }
  MappedCounts(const MappedCounts&) = delete;
  MappedCounts& operator=(const MappedCounts&) = delete;

  const FaultCounts& operator*() const { return *counts_; }
  const FaultCounts* operator->() const { return counts_; }

  // The words by which a program runs with the library of faults.
  Words launcher(const JobFolder& folder, const Fault* fault) const {
    Words words{"/usr/bin/env", "LD_PRELOAD=" SEAGLINT_FAULT_SHIM, "SEAGLINT_FAULT_FOLDER=" + folder.path().string(),
                "SEAGLINT_FAULT_COUNTS=" + file_.string()};
    if (fault != nullptr) {
      words.push_back(fmt::format("SEAGLINT_FAULT={}:{}:{}{}{}", kFaultKinds[static_cast<std::size_t>(fault->kind)],
                                  fault->number, fault->error, fault->end.empty() ? "" : ":", fault->end));
    }
    return words;
  }

 private:
  std::filesystem::path file_;
  FaultCounts* counts_ = nullptr;
};

using CallCounts = std::array<std::uint64_t, kFaultKinds.size()>;

// The calls of a job by kind.
inline const CallCounts& calls_of(const Job& job, JobFolder& folder) {
  static std::map<std::string, CallCounts> known;
  if (known.contains(job.name)) return known[job.name];
  folder.begin(job);
  const MappedCounts counts(folder.beside("counts"));
  const ProgramResult result = run_words(folder.words(job, counts.launcher(folder, nullptr)));
  EXPECT_EQ(result.code, 0) << job.name << ": " << result.err;
  EXPECT_EQ(folder.differences(job, true), Words{}) << job.name << ": counting changes the result";
  CallCounts& calls = known[job.name];
  std::copy(counts->calls.begin(), counts->calls.end(), calls.begin());
  return calls;
}

// What a call of a kind may fail with.
inline const std::vector<int>& errors_of(FaultKind kind) {
  static const std::map<FaultKind, std::vector<int>> errors{{FaultKind::kOpen, {EIO, ENOSPC, EDQUOT, EINTR, EMFILE}},
                                                            {FaultKind::kRead, {EIO, EINTR, kShort}},
                                                            {FaultKind::kWrite, {EIO, ENOSPC, EDQUOT, EINTR, kShort}},
                                                            {FaultKind::kSync, {EIO, ENOSPC, EDQUOT, EINTR}},
                                                            {FaultKind::kRename, {EIO, ENOSPC, EDQUOT}},
                                                            {FaultKind::kClose, {EIO, ENOSPC, EDQUOT, EINTR}},
                                                            {FaultKind::kTruncate, {EIO, ENOSPC, EINTR}},
                                                            {FaultKind::kUnlink, {EIO}},
                                                            {FaultKind::kMkdir, {EIO, ENOSPC, EDQUOT}},
                                                            {FaultKind::kStat, {EIO}},
                                                            {FaultKind::kList, {EIO}}};
  return errors.at(kind);
}

// Draw number `index`: a job, a kind that it calls, one of these calls. A run takes as long as five other jobs, and is
// one in ten.
inline Fault draw_fault(JobFolder& folder, std::uint64_t seed, std::uint64_t index) {
  Random random({seed, Stream::kTest, index});
  Fault fault;
  fault.job = &(index % 10 == 9 ? jobs().back() : jobs()[index % (jobs().size() - 1)]);
  const CallCounts& calls = calls_of(*fault.job, folder);
  std::vector<FaultKind> kinds;
  for (std::size_t kind = 0; kind < calls.size(); ++kind) {
    if (calls[kind] > 0) kinds.push_back(static_cast<FaultKind>(kind));
  }
  const auto below = [&](std::uint64_t count) { return random.below(static_cast<std::uint32_t>(count)); };
  fault.kind = kinds[below(kinds.size())];
  fault.number = 1 + below(calls[static_cast<std::size_t>(fault.kind)]);
  const std::vector<int>& errors = errors_of(fault.kind);
  fault.error = errors[below(errors.size())];
  return fault;
}

// A number of the environment, as tools/faults sets it.
inline std::uint64_t environment_number(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace seaglint
