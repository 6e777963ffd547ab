// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/parallel.h"
#include "sim/core/process/shared_results.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;

// An empty folder of its own for each test.
class Files : public ::testing::Test {
 protected:
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  template <typename Error, typename Function>
  static std::string message_of(const Function& function) {
    try {
      function();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error of this type";
  }

  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

TEST_F(Files, AreReadAsWritten) {
  const std::string content("a\0b\n", 4);
  write_file(folder_ / "x", content);
  EXPECT_EQ(read_file(folder_ / "x"), content);
  write_file(folder_ / "x", "");
  EXPECT_EQ(read_file(folder_ / "x"), "");
  const std::string large(3000000, 'y');
  write_file(folder_ / "x", large);
  EXPECT_EQ(read_file(folder_ / "x"), large);
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, ReadingErrorsNameTheCause) {
  const auto reading = [&](const fs::path& path, std::size_t limit = 100) {
    return message_of<InputError>([&] { read_file(path, limit); });
  };
  EXPECT_EQ(reading(folder_ / "none"), (folder_ / "none").string() + ": cannot read: No such file or directory");
  EXPECT_EQ(reading(folder_), folder_.string() + ": cannot read: is a directory");
  EXPECT_EQ(reading("/dev/zero"), "/dev/zero: cannot read: is not a regular file");
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_HAS(reading(folder_ / "pipe"), "is not a regular file");
  write_file(folder_ / "large", std::string(101, ' '));
  EXPECT_HAS(reading(folder_ / "large"), "has 101 bytes, more than the limit of 100");
  EXPECT_EQ(read_file(folder_ / "large", 101).size(), 101u);
}

TEST_F(Files, AFailedWriteLeavesTheOldFileAndNothingElse) {
  write_file(folder_ / "x", "old");
  EXPECT_THROW(write_file_with(folder_ / "x",
                               [](const fs::path& temporary) {
                                 std::ofstream(temporary) << "half";
                                 throw WorkError("disk full");
                               }),
               WorkError);
  EXPECT_EQ(read_file(folder_ / "x"), "old");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, WritingErrorsNameTheFileAndTheCause) {
  const auto writing = [](const fs::path& path) { return message_of<WorkError>([&] { write_file(path, "content"); }); };
  EXPECT_HAS(writing(folder_ / "none" / "x"), "none/x: cannot write: No such file or directory");
  EXPECT_HAS(writing(folder_), "cannot write: Is a directory");
  EXPECT_EQ(writing("/dev/full"), "/dev/full: cannot write: No space left on device");
  EXPECT_EQ(entries(), 0u);
}

TEST_F(Files, AWriterWithoutAFileIsAnError) {
  EXPECT_HAS(message_of<WorkError>([&] { write_file_with(folder_ / "x", [](const fs::path&) {}); }),
             "x: cannot write: No such file or directory");
}

TEST_F(Files, ADeviceIsWrittenNotReplaced) {
  write_file("/dev/null", "content");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_HAS(message_of<WorkError>([] { write_file_with("/dev/null", [](const fs::path&) {}); }),
             "is not a regular file");
}

TEST_F(Files, ASymbolicLinkIsKept) {
  write_file(folder_ / "target", "old");
  fs::create_symlink("target", folder_ / "link");
  write_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(read_file(folder_ / "target"), "new");
}

TEST_F(Files, MakesADirectoryWithItsParents) {
  make_directory(folder_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder_ / "a" / "b"));
  make_directory(folder_ / "a");
  write_file(folder_ / "x", "");
  EXPECT_HAS(message_of<WorkError>([&] { make_directory(folder_ / "x"); }), "x: cannot make the directory");
  // Root can write anywhere: the check runs in a child process that is not root.
  fs::permissions(folder_, fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add);
  const fs::path locked = folder_ / "locked";
  fs::create_directory(locked);
  fs::permissions(locked,
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  EXPECT_EXIT(
      {
        if (::geteuid() == 0 && ::setuid(65534) != 0) std::abort();
        std::cerr << message_of<WorkError>([&] { make_directory(locked); });
        std::_Exit(0);
      },
      testing::ExitedWithCode(0), "locked: the directory is not writable: Permission denied");
  EXPECT_HAS(message_of<WorkError>([&] { make_directory(folder_ / "x" / "y"); }), "Not a directory");
  EXPECT_THROW(make_directory(""), WorkError);
}

using ::testing::IsEmpty;
using ::testing::SizeIs;

class TemporaryFiles : public ::testing::Test {
 protected:
  std::set<std::string> names() const {
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.insert(entry.path().filename());
    return found;
  }

  // The temporary file of a process that ended without removing it.
  fs::path left_by_an_ended_process() const {
    const std::set<std::string> before = names();
    const pid_t process = ::fork();
    if (process == 0) {
      new TemporaryFile(target_);
      ::_exit(0);
    }
    ::waitpid(process, nullptr, 0);
    for (const std::string& name : names())
      if (!before.contains(name)) return folder_ / name;
    return {};
  }

  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path(), target_ = folder_ / "x.h5";
};

TEST_F(TemporaryFiles, BecomeTheirTargetWhenPublished) {
  {
    TemporaryFile file(target_);
    file.write("con");
    file.write("tent");
    EXPECT_FALSE(fs::exists(target_));
    file.publish();
  }
  EXPECT_EQ(read_file(target_), "content");
  EXPECT_THAT(names(), SizeIs(1));
  { TemporaryFile unpublished(target_); }
  EXPECT_THAT(names(), SizeIs(1));
}

// Two containers may have one host name and one process number.
TEST_F(TemporaryFiles, OfOneProcessAndOneTargetAreDifferentFiles) {
  write_file_with(target_, [&](const fs::path& first) {
    std::ofstream(first) << "first";
    write_file_with(target_, [&](const fs::path& second) {
      EXPECT_NE(first, second);
      std::ofstream(second) << "second";
    });
    EXPECT_EQ(read_file(first), "first");
  });
  EXPECT_EQ(read_file(target_), "first");
}

TEST_F(TemporaryFiles, AreLeftoversWhenTheirProcessHasEnded) {
  const TemporaryFile live(target_);
  const fs::path left = left_by_an_ended_process();
  ASSERT_NE(left, fs::path());
  EXPECT_TRUE(is_leftover(left));
  EXPECT_FALSE(is_leftover(live.path()));
  remove_leftover(left);
  remove_leftover(live.path());
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(live.path()));
}

TEST_F(TemporaryFiles, LeftInAFolderAreRemovedByTheirTargetsName) {
  const TemporaryFile live(target_);
  const fs::path left = left_by_an_ended_process();
  ASSERT_NE(left, fs::path());
  write_file(folder_ / "y.h5", "of the user");
  remove_leftovers(folder_, "y.h5");
  EXPECT_TRUE(fs::exists(left));
  remove_leftovers(folder_, "x.h5");
  EXPECT_FALSE(fs::exists(left));
  const fs::path again = left_by_an_ended_process();
  remove_leftovers(folder_);
  EXPECT_FALSE(fs::exists(again));
  EXPECT_THAT(names(), SizeIs(2)) << "the live file and that of the user";
  remove_leftovers(folder_ / "absent");
}

TEST_F(TemporaryFiles, AreToldByTheirNames) {
  EXPECT_EQ(target_of_temporary("x.h5.0123456789abcdef.tmp"), "x.h5");
  EXPECT_EQ(target_of_temporary(TemporaryFile(target_).path().filename().native()), "x.h5");
  for (const char* other : {"x.h5", "x.h5.tmp", "x.h5.0123456789abcde.tmp", "x.h5.0123456789abcdeF.tmp",
                            ".0123456789abcdef.tmp", "x.h5-0123456789abcdef.tmp", "x.h5.0123456789abcdef.TMP"})
    EXPECT_THAT(target_of_temporary(other), IsEmpty()) << other;
  for (const char* other : {"notes", "notes.tmp"}) {
    write_file(folder_ / other, "of the user");
    EXPECT_FALSE(is_leftover(folder_ / other));
  }
}

// A link that was put in place of the file while it was written is neither written through nor published.
TEST_F(TemporaryFiles, ThatWereReplacedAreNotPublished) {
  write_file(folder_ / "secret", "of the user");
  TemporaryFile file(target_);
  file.write("content");
  fs::remove(file.path());
  fs::create_symlink("secret", file.path());
  EXPECT_THROW(file.publish(), WorkError);
  EXPECT_FALSE(fs::exists(target_));
  EXPECT_EQ(read_file(folder_ / "secret"), "of the user");
  EXPECT_FALSE(is_leftover(file.path())) << "a link is followed";
}

// Results that several threads need are computed once, and again when they are no longer kept.

TEST(SharedResults, AreComputedOnceByManyThreads) {
  SharedResults<int, int> squares(4);
  std::atomic<int> made = 0;
  parallel_for(400, 4, [&](std::size_t i) {
    const int key = static_cast<int>(i % 4);
    EXPECT_EQ(*squares.get(key,
                           [&] {
                             ++made;
                             return key * key;
                           }),
              key * key);
  });
  EXPECT_EQ(made, 4);
}

TEST(SharedResults, OfTheOldestKeyAreForgottenAndComputedAgain) {
  SharedResults<int, int> kept(2);
  int made = 0;
  const auto make = [&] { return ++made; };
  const auto first = kept.get(1, make);
  kept.get(2, make);
  kept.get(3, make);
  EXPECT_EQ(*kept.get(3, make), 3);
  EXPECT_EQ(*kept.get(2, make), 2);
  EXPECT_EQ(*kept.get(1, make), 4);
  EXPECT_EQ(*first, 1);
}

TEST(SharedResults, ThatFailedAreTriedAgain) {
  SharedResults<int, int> kept(2);
  EXPECT_THROW(kept.get(1, []() -> int { throw std::runtime_error("interrupted"); }), std::runtime_error);
  EXPECT_EQ(*kept.get(1, [] { return 7; }), 7);
}

}  // namespace
}  // namespace seaglint
