// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/memory_file.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

[[noreturn]] void fail() { throw WorkError(fmt::format("file in memory: {}", std::strerror(errno))); }

// Calls transfer(done), which returns a number of bytes as read() does, until all are transferred.
template <class Transfer>
void transfer_all(std::size_t bytes, Transfer transfer) {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t count = transfer(done);
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = EIO;
    if (count <= 0) fail();
    done += static_cast<std::size_t>(count);
  }
}

}  // namespace

MemoryFile::MemoryFile(std::string_view content) : descriptor_(::memfd_create("seaglint", MFD_CLOEXEC)) {
  if (descriptor_ < 0) fail();
  try {
    transfer_all(content.size(), [&](std::size_t done) {
      return ::pwrite(descriptor_, content.data() + done, content.size() - done, static_cast<off_t>(done));
    });
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

std::string MemoryFile::content() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail();
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  transfer_all(bytes.size(), [&](std::size_t done) {
    return ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
  });
  return bytes;
}

}  // namespace seaglint
