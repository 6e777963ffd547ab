// SPDX-License-Identifier: BSD-3-Clause
#include "sim/field_tables/rows/hdf5_header.h"

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
  constexpr std::size_t kExtents = 11;  // behind version, class, rank and address
  if (message.size() < kExtents + 4 * rank) return false;
  for (std::size_t k = 0; k < rank; ++k) {
    if (number(message, kExtents + 4 * k, 4) == 0) return false;
  }
  return true;
}

}  // namespace

bool has_sound_layout(const std::filesystem::path& path, std::uint64_t address) {
  constexpr std::uint64_t kHead = 16, kMessageHead = 8, kLayout = 0x8, kContinuation = 0x10, kShared = 2;
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
      if (type != kLayout) continue;
      if ((flags & kShared) != 0 || !is_sound_layout(message)) return false;
      ++layouts;
    }
  }
  return layouts == 1;
}

}  // namespace seaglint
