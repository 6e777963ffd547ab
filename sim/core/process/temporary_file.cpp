// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/temporary_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kEnding = ".tmp";
constexpr std::size_t kDigits = 16;
constexpr int kMaxAttempts = 100;  // each is lost only to a process that removes leftovers in the same microseconds

// 64 random bits of the system.
std::uint64_t random_bits() {
  std::uint64_t bits = 0;
  while (::getrandom(&bits, sizeof bits, 0) != static_cast<ssize_t>(sizeof bits)) {
    if (errno != EINTR) throw WorkError(fmt::format("no random numbers of the system: {}", std::strerror(errno)));
  }
  return bits;
}

enum class Lock { kHeld, kRefused, kUnsupported };

// Locks the whole file for this descriptor without waiting; type F_WRLCK or F_RDLCK.
Lock lock(int descriptor, short type) {
  struct flock whole {};
  whole.l_type = type;
  whole.l_whence = SEEK_SET;
  while (::fcntl(descriptor, F_OFD_SETLK, &whole) != 0) {
    if (errno == EAGAIN || errno == EACCES) return Lock::kRefused;
    if (errno != EINTR) return Lock::kUnsupported;
  }
  return Lock::kHeld;
}

// True if the path is this open file, and no link to it.
bool is_open_file(const fs::path& path, int descriptor) {
  struct stat named {
  }, opened{};
  return ::lstat(path.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 && named.st_dev == opened.st_dev &&
         named.st_ino == opened.st_ino;
}

bool is_old(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  const auto written = std::chrono::system_clock::from_time_t(status.st_mtim.tv_sec);
  return std::chrono::system_clock::now() - written > std::chrono::hours(24);
}

// Calls use() while the leftover is locked, so that no process can begin to write it; false for a file that is none.
template <class Use>
bool with_leftover(const fs::path& file, Use use) {
  if (target_of_temporary(file.filename().native()).empty()) return false;
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  const Lock state = lock(descriptor, F_RDLCK);
  const bool left = state == Lock::kHeld || (state == Lock::kUnsupported && is_old(descriptor));
  if (left) use();
  ::close(descriptor);
  return left;
}

}  // namespace

TemporaryFile::TemporaryFile(fs::path target) : target_(std::move(target)) {
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    path_ = target_;
    path_ += fmt::format(".{:016x}{}", random_bits(), kEnding);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && (errno == EEXIST || errno == EINTR)) continue;
    if (descriptor_ < 0) fail();
    // Between creation and lock, another process may have taken the file for a leftover.
    if (lock(descriptor_, F_WRLCK) != Lock::kRefused && is_open_file(path_, descriptor_)) return;
    ::unlink(path_.c_str());  // if it is still there, nothing but the name could not be looked up
    ::close(std::exchange(descriptor_, -1));
  }
  errno = EBUSY;
  fail();
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ < 0) return;
  if (is_open_file(path_, descriptor_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

void TemporaryFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor_, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void TemporaryFile::publish() {
  while (::fsync(descriptor_) != 0) {
    if (errno != EINTR) fail();
  }
  if (!is_open_file(path_, descriptor_)) {
    errno = ENOENT;
    fail();
  }
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail();
  // Reports write errors that a file system delays until now.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail();
}

void TemporaryFile::fail() const {
  throw WorkError(fmt::format("{}: cannot write: {}", target_.string(), std::strerror(errno)));
}

std::string_view target_of_temporary(std::string_view name) {
  if (!name.ends_with(kEnding)) return {};
  name.remove_suffix(kEnding.size());
  if (name.size() < kDigits + 2 || name[name.size() - kDigits - 1] != '.') return {};
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (!std::all_of(name.end() - kDigits, name.end(), is_digit)) return {};
  return name.substr(0, name.size() - kDigits - 1);
}

bool is_leftover(const fs::path& file) {
  return with_leftover(file, [] {});
}

void remove_leftover(const fs::path& file) {
  with_leftover(file, [&] {
    std::error_code ignored;
    fs::remove(file, ignored);
  });
}

void remove_leftovers(const fs::path& folder, std::string_view target) {
  std::vector<fs::path> found;
  std::error_code ended;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, ended), end; !ended && it != end; it.increment(ended)) {
    const std::string name = it->path().filename();
    const std::string_view of = target_of_temporary(name);
    if (!of.empty() && (target.empty() || of == target)) found.push_back(it->path());
  }
  for (const fs::path& file : found) remove_leftover(file);
}

}  // namespace seaglint
