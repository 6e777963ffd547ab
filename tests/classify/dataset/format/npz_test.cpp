// SPDX-License-Identifier: BSD-3-Clause
// Arrays of NumPy's archives: values come back as written, in the headers that NumPy writes, and damaged files are
// refused with the name of the array.
#include "classify/dataset/format/npz.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

using testing::HasSubstr;

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return bytes_of_values(std::span<const T>(values));
}

std::string problem_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Npz, ReadsWhatItWrites) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.npz";
  const std::vector<std::complex<float>> waves{{1, 2}, {3, 4}, {-5, 0.5F}, {0, 7}, {8, 9}, {10, 11}};
  write_npz(file,
            {npz_array("waves", "<c8", {2, 3}, bytes_of(waves)),
             npz_array("code", "<i8", {3}, bytes_of(std::vector<std::int64_t>{7, -1, 1LL << 40})),
             npz_array("one", "<f8", {}, bytes_of(std::vector<double>{0.1})), npz_array("none", "<u2", {0, 4}, "")},
            {{"a.txt", "text"}});
  EXPECT_THAT(npz_members(file), testing::ElementsAre("waves.npy", "code.npy", "one.npy", "none.npy", "a.txt"));
  const NpzValues read = read_npz_array(file, "waves");
  EXPECT_EQ(read.shape_text(), "(2, 3)");
  const auto values = read.complex_numbers();
  ASSERT_EQ(values.size(), waves.size());
  for (std::size_t i = 0; i < waves.size(); ++i) EXPECT_EQ(values[i], std::complex<double>(waves[i]));
  EXPECT_THAT(read_npz_array(file, "code").numbers(), testing::ElementsAre(7, -1, 1099511627776.0));
  EXPECT_THAT(read_npz_array(file, "one").numbers(), testing::ElementsAre(0.1));
  EXPECT_THAT(read_npz_array(file, "none").numbers(), testing::IsEmpty());
  EXPECT_EQ(read_npz_text(file, "a.txt"), "text");
}

// As numpy.lib.format writes them: versions 1 to 3, keys in any order, a type of a single number.
TEST(Npz, ReadsTheHeadersOfNumpy) {
  const auto header = [](char version, const std::string& text) {
    std::string bytes = std::string("\x93NUMPY") + version + '\0' + static_cast<char>(text.size());
    bytes += std::string(version == 1 ? 1 : 3, '\0');
    return bytes + text;
  };
  const std::string usual = "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 40), }     \n";
  for (const char version : {'\x01', '\x02', '\x03'}) {
    const NpyHeader read = read_npy_header(header(version, usual) + "data");
    EXPECT_EQ(read.type, "<f4");
    EXPECT_THAT(read.shape, testing::ElementsAre(3, 40));
    EXPECT_EQ(read.bytes, (version == 1 ? 10 : 12) + usual.size());
  }
  EXPECT_THAT(read_npy_header(header(1, "{\"shape\": (5,), \"fortran_order\": False, \"descr\": \"<i8\"}")).shape,
              testing::ElementsAre(5));
  const auto refused = [&](const std::string& bytes) { return problem_of([&] { read_npy_header(bytes); }); };
  EXPECT_THAT(refused(header(1, "{'descr': '<f4', 'fortran_order': True, 'shape': (3, 4), }")),
              HasSubstr("Fortran order"));
  for (const char* text :
       {"{'descr': '<f4', 'shape': (3, 4), }", "{'descr': '<f4', 'fortran_order': False, 'shape': (3,",
        "{'descr': [('x', '<f4')], 'fortran_order': False, 'shape': (3,), }", "", "{",
        "{'descr': '<f4', 'descr': '<f4', 'fortran_order': False, 'shape': (-3,), }"}) {
    EXPECT_THAT(refused(header(1, text)), HasSubstr("no header of NumPy's .npy format")) << text;
  }
  for (const char* bytes : {"", "\x93NUMPY", "\x93NUMPY\x01", "NUMPY", "\x93NUMPY\x09\x01xx"})
    EXPECT_THAT(refused(bytes), HasSubstr("no header of NumPy's .npy format"));
}

TEST(Npz, RefusesWhatIsNoArrayOfItsShape) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.npz";
  const std::string values = bytes_of(std::vector<double>{1, 2, 3, 4, 5, 6});
  // As a text, so that the bytes need not be those of the shape.
  const auto write = [&](const std::string& type, const std::vector<std::uint64_t>& shape) {
    write_npz(file, {}, {{"x.npy", npy_header(type, shape) + values}});
    return problem_of([&] { read_npz_array(file, "x"); });
  };
  EXPECT_EQ(write("<f8", {6}), "none");
  EXPECT_EQ(write("<f8", {2, 3}), "none");
  EXPECT_EQ(write("<f8", {5}), file.string() + ": array x: 48 bytes of values for (5,) of <f8");
  EXPECT_THAT(write("<f8", {7}), HasSubstr("48 bytes of values"));
  EXPECT_THAT(write("<f8", {0}), HasSubstr("48 bytes of values"));
  EXPECT_THAT(write("<f8", {1ULL << 63, 2, 6}), HasSubstr("48 bytes of values"));
  EXPECT_THAT(write("|O", {6}), HasSubstr("no array of numbers"));
  EXPECT_EQ(write(">f8", {6}), "none");
  EXPECT_THAT(problem_of([&] { read_npz_array(file, "x").numbers(); }), HasSubstr("type >f8: must be <f4"));
  EXPECT_THAT(problem_of([&] { read_npz_array(file, "x").complex_numbers(); }), HasSubstr("must be <c8 or <c16"));
  EXPECT_THAT(problem_of([&] { read_npz_array(file, "y"); }), HasSubstr("array y: is missing"));
}

TEST(Npz, RefusesADamagedArchive) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.npz";
  write_npz(file, {npz_array("x", "<f8", {100}, std::string(800, 'a'))});
  const std::string bytes = read_file(file);
  for (std::size_t length = 0; length < bytes.size(); length += 7) {
    write_file(file, bytes.substr(0, length));
    EXPECT_THAT(problem_of([&] { read_npz_array(file, "x"); }), HasSubstr("no .npz archive of NumPy, or truncated"));
    EXPECT_THAT(problem_of([&] { npz_members(file); }), HasSubstr("truncated"));
  }
  std::string changed = bytes;
  changed[changed.find("aaaa") + 400] = 'b';
  write_file(file, changed);
  EXPECT_THAT(problem_of([&] { read_npz_array(file, "x"); }), HasSubstr("array x: is damaged"));
}

}  // namespace
}  // namespace seaglint
