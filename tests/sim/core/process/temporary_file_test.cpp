// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <string>

#include "sim/core/process/error.h"
#include "tests/temporary_folder.h"

namespace seaglint {
namespace {

namespace fs = std::filesystem;
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
    for (const std::string& name : names()) {
      if (!before.contains(name)) return folder_ / name;
    }
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

}  // namespace
}  // namespace seaglint
