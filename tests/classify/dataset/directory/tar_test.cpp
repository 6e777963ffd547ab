// SPDX-License-Identifier: BSD-3-Clause
// Tar archives by the definition of POSIX; tests/pipeline/webdataset_test.cpp reads them with other programs.
#include "classify/dataset/directory/webdataset.h"

#include <gtest/gtest.h>

#include <numeric>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

std::string archive_of(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string bytes;
  const AppendText append = [&](std::string_view part) { bytes += part; };
  TarWriter tar(append);
  for (const auto& [name, content] : files) tar.add(name, content);
  EXPECT_EQ(tar.bytes(), bytes.size());
  tar.finish();
  return bytes;
}

// The sum of all bytes of a header, those of the checksum counted as blanks.
TEST(TarArchive, HasTheChecksumOfItsHeader) {
  const std::string header = archive_of({{"000000001.json", "{}"}}).substr(0, 512);
  const auto sum = [](const std::string& text) {
    return std::accumulate(text.begin(), text.end(), 0,
                           [](int total, char byte) { return total + static_cast<unsigned char>(byte); });
  };
  EXPECT_EQ(std::stoi(header.substr(148, 6), nullptr, 8),
            sum(header.substr(0, 148)) + 8 * ' ' + sum(header.substr(156)));
  EXPECT_EQ(header.substr(257, 8), std::string("ustar\0"
                                               "00",
                                               8));
}

TEST(TarArchive, IsInBlocksOf512BytesAndRecordsOf10240) {
  const std::string archive = archive_of({{"a", std::string(513, 'x')}, {"b", ""}});
  EXPECT_EQ(archive.size() % 10240, 0u);
  EXPECT_EQ(archive.substr(512, 513), std::string(513, 'x'));
  EXPECT_EQ(archive.substr(512 + 1024, 2), std::string("b\0", 2));
  EXPECT_EQ(archive.substr(512 + 1024 + 512), std::string(archive.size() - 2048, '\0'));
}

TEST(TarArchive, HasAtLeastTwoBlocksOfZerosAtItsEnd) {
  EXPECT_EQ(TarWriter::archive_bytes(0), 10240u);
  EXPECT_EQ(TarWriter::archive_bytes(10240 - 1024), 10240u);
  EXPECT_EQ(TarWriter::archive_bytes(10240 - 512), 20480u);
  EXPECT_EQ(TarWriter::member_bytes(0), 512u);
  EXPECT_EQ(TarWriter::member_bytes(1), 1024u);
  EXPECT_EQ(TarWriter::member_bytes(512), 1024u);
}

TEST(TarArchive, RefusesNamesThatUstarCannotHold) {
  EXPECT_NO_THROW(archive_of({{std::string(100, 'a'), ""}}));
  EXPECT_ANY_THROW(archive_of({{std::string(101, 'a'), ""}}));
  EXPECT_ANY_THROW(archive_of({{"", ""}}));
}

}  // namespace
}  // namespace seaglint
