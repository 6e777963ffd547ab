// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/tar.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "sim/core/process/error.h"

namespace seaglint {

namespace {

constexpr std::uint64_t kBlock = 512, kRecord = 20 * kBlock;

constexpr std::uint64_t rounded_up(std::uint64_t bytes, std::uint64_t unit) { return (bytes + unit - 1) / unit * unit; }

// The 512 bytes before a file's content. Numbers are octal digits with a NUL behind them.
std::string header(const std::string& name, std::uint64_t size) {
  SEAGLINT_CHECK(!name.empty() && name.size() <= 100 && size < (std::uint64_t{1} << 33), name);
  std::string block(kBlock, '\0');
  const auto put = [&](std::size_t offset, std::string_view text) {
    std::copy(text.begin(), text.end(), block.begin() + static_cast<std::ptrdiff_t>(offset));
  };
  put(0, name);
  put(100, "0000644");                     // mode
  put(108, "0000000");                     // user
  put(116, "0000000");                     // group
  put(124, fmt::format("{:011o}", size));  // bytes of the content
  put(136, "00000000000");                 // time of modification
  put(148, "        ");                    // checksum, as which blanks are summed
  put(156, "0");                           // a regular file
  put(257, "ustar");
  put(263, "00");       // version
  put(329, "0000000");  // device numbers
  put(337, "0000000");
  const unsigned sum = std::accumulate(block.begin(), block.end(), 0u, [](unsigned total, char byte) {
    return total + static_cast<unsigned char>(byte);
  });
  put(148, fmt::format("{:06o}", sum));
  block[154] = '\0';  // then the blank at 155 that stands there
  return block;
}

}  // namespace

void TarWriter::add(const std::string& name, std::string_view content) {
  append(header(name, content.size()));
  append(content);
  append(std::string(rounded_up(content.size(), kBlock) - content.size(), '\0'));
}

void TarWriter::finish() { append(std::string(archive_bytes(bytes_) - bytes_, '\0')); }

std::uint64_t TarWriter::member_bytes(std::uint64_t content_bytes) {
  return kBlock + rounded_up(content_bytes, kBlock);
}

std::uint64_t TarWriter::archive_bytes(std::uint64_t bytes) { return rounded_up(bytes + 2 * kBlock, kRecord); }

void TarWriter::append(std::string_view part) {
  append_(part);
  bytes_ += part.size();
}

}  // namespace seaglint
