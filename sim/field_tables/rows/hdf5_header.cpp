// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/rows/hdf5_header.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seaglint {
namespace {

constexpr std::uint64_t kMaxBlock = 1 << 20;  // bytes
constexpr std::size_t kMaxBlocks = 256;

// Unsigned number of `bytes` bytes; the caller has checked the bounds.
std::uint64_t number(std::string_view text, std::size_t at, std::size_t bytes) {
  std::uint64_t value = 0;
  for (std::size_t n = bytes; n > 0; --n) value = value << 8 | static_cast<unsigned char>(text[at + n - 1]);
  return value;
}

std::optional<std::string> bytes_at(std::ifstream& file, std::uint64_t address, std::uint64_t count) {
  if (count > kMaxBlock || address > std::uint64_t{1} << 62) return std::nullopt;
  std::string bytes(count, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(address));
  if (!file.read(bytes.data(), static_cast<std::streamsize>(count))) return std::nullopt;
  return bytes;
}

bool is_sound_layout(std::string_view message) {
  constexpr std::uint64_t kVersion = 3, kChunked = 2;
  if (message.size() < 3 || number(message, 0, 1) != kVersion) return false;
  if (number(message, 1, 1) != kChunked) return true;
  const std::uint64_t rank = number(message, 2, 1);
  constexpr std::size_t kExtents = 11;                                  // behind version, class, rank and address
  if (rank != 2 || message.size() < kExtents + 4 * rank) return false;  // rows, and bytes of one
  for (std::size_t k = 0; k < rank; ++k) {
    if (number(message, kExtents + 4 * k, 4) == 0) return false;
  }
  return true;
}

// Goes past a datatype of version 1 or 2: numbers, texts, arrays and compounds of them, none of 0 bytes, members within
// their compound. False for another one.
bool skip_sound_type(std::string_view& rest, std::uint64_t most_bytes, int depth) {
  constexpr std::uint64_t kInteger = 0, kReal = 1, kText = 3, kCompound = 6, kArray = 10, kMaxDepth = 4;
  if (rest.size() < 8 || depth > static_cast<int>(kMaxDepth)) return false;
  const std::uint64_t type = number(rest, 0, 1) & 15, version = number(rest, 0, 1) >> 4, bytes = number(rest, 4, 4);
  const std::uint64_t members = number(rest, 1, 2);
  rest.remove_prefix(8);
  if (bytes == 0 || bytes > most_bytes || version < 1 || version > 2) return false;
  const auto skip = [&](std::uint64_t count) {
    if (count > rest.size()) return false;
    rest.remove_prefix(count);
    return true;
  };
  if (type == kInteger) return skip(4);
  if (type == kReal) return skip(12);
  if (type == kText) return true;
  if (type == kArray) {
    if (rest.empty()) return false;
    const std::uint64_t rank = number(rest, 0, 1);
    return version == 2 && skip(4 + 8 * rank) && skip_sound_type(rest, bytes, depth + 1);
  }
  if (type != kCompound || members == 0) return false;
  for (std::uint64_t k = 0; k < members; ++k) {
    const std::size_t name = rest.find('\0');
    if (name == std::string_view::npos || !skip(name / 8 * 8 + 8) || rest.size() < 4) return false;
    const std::uint64_t offset = number(rest, 0, 4);
    if (offset >= bytes || !skip(version == 1 ? 32 : 4) || !skip_sound_type(rest, bytes - offset, depth + 1))
      return false;
  }
  return true;
}

bool is_sound_type(std::string_view message) {
  constexpr std::uint64_t kMaxRow = 65536;  // bytes
  return skip_sound_type(message, kMaxRow, 0);
}

}  // namespace

bool has_sound_header(const std::filesystem::path& path, std::uint64_t address) {
  constexpr std::uint64_t kHead = 16, kMessageHead = 8, kType = 0x3, kLayout = 0x8, kContinuation = 0x10, kShared = 2;
  std::ifstream file(path, std::ios::binary);
  const std::optional<std::string> head = bytes_at(file, address, kHead);
  if (!head || number(*head, 0, 1) != 1) return false;
  struct Block {
    std::uint64_t address, bytes;
  };
  std::vector<Block> blocks{{address + kHead, number(*head, 8, 4)}};
  int layouts = 0;
  for (std::size_t n = 0; n < blocks.size() && n < kMaxBlocks; ++n) {
    const std::optional<std::string> block = bytes_at(file, blocks[n].address, blocks[n].bytes);
    if (!block) return false;
    for (std::string_view rest = *block; rest.size() >= kMessageHead;) {
      const std::uint64_t type = number(rest, 0, 2), bytes = number(rest, 2, 2), flags = number(rest, 4, 1);
      rest.remove_prefix(kMessageHead);
      if (bytes > rest.size()) return false;
      const std::string_view message = rest.substr(0, bytes);
      rest.remove_prefix(bytes);
      if (type == kContinuation && bytes >= 16) blocks.push_back({number(message, 0, 8), number(message, 8, 8)});
      if (type == kType && ((flags & kShared) != 0 || !is_sound_type(message))) return false;
      if (type != kLayout) continue;
      if ((flags & kShared) != 0 || !is_sound_layout(message)) return false;
      ++layouts;
    }
  }
  return layouts == 1;
}

namespace {

// The heap whose header begins at `address`.
bool is_sound_heap(std::ifstream& file, std::uint64_t address, std::uint64_t file_bytes) {
  constexpr std::uint64_t kHeader = 32, kBlock = 16, kEnd = 1;  // bytes; the offset that ends the list
  const std::optional<std::string> header = bytes_at(file, address, kHeader);
  if (!header) return false;
  const std::uint64_t bytes = number(*header, 8, 8), data = number(*header, 24, 8);
  if (data > file_bytes || bytes > file_bytes - data) return false;
  std::uint64_t offset = number(*header, 16, 8);
  for (std::uint64_t left = bytes / kBlock + 1; offset != kEnd; --left) {
    if (left == 0 || bytes < kBlock || offset > bytes - kBlock) return false;
    const std::optional<std::string> block = bytes_at(file, data + offset, kBlock);
    if (!block || number(*block, 8, 8) > bytes - offset) return false;
    offset = number(*block, 0, 8);
  }
  return true;
}

}  // namespace

bool has_sound_heaps(const std::filesystem::path& path) {
  constexpr std::string_view kSignature = "HEAP";
  std::ifstream file(path, std::ios::binary);
  file.seekg(0, std::ios::end);
  const std::uint64_t bytes = file ? static_cast<std::uint64_t>(file.tellg()) : 0;
  // Parts overlap by what a signature may stand across.
  const std::uint64_t part = kMaxBlock - kSignature.size();
  for (std::uint64_t begin = 0; begin < bytes; begin += part) {
    const std::optional<std::string> text = bytes_at(file, begin, std::min(kMaxBlock, bytes - begin));
    if (!text) return false;
    for (std::size_t at = text->find(kSignature); at != std::string::npos && at < part;
         at = text->find(kSignature, at + 1)) {
      const std::uint64_t address = begin + at;
      if (address + 32 <= bytes && !is_sound_heap(file, address, bytes)) return false;
    }
  }
  return true;
}

}  // namespace seaglint
