// SPDX-License-Identifier: BSD-3-Clause
// The commands where something that most systems have is missing or different: the same bytes, or one line and nothing
// left.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include "tests/faults/job_folder.h"

namespace seaglint {
namespace {

JobFolder& folder() {
  static JobFolder made;
  return made;
}

void expect_same_bytes(const Job& job, const Words& launcher) {
  folder().undisturbed(job);
  folder().begin(job);
  const ProgramResult result = run_words(folder().words(job, launcher));
  EXPECT_EQ(result.code, 0) << job.name << ": " << result.err;
  EXPECT_EQ(folder().differences(job, true), Words{}) << job.name;
}

bool has_locale(const std::string& name) {
  const ProgramResult all = run_words({"/usr/bin/locale", "-a"});
  return all.out.find(name) != std::string::npos;
}

// Neither a home nor a folder for temporary files, no time zone and no language.
TEST(Surroundings, WithoutAnEnvironmentGiveTheSameBytes) {
  for (const Job& job : jobs()) expect_same_bytes(job, {"/usr/bin/env", "-i", "PATH=/usr/bin:/bin"});
}

// Folders that do not exist, and decimal commas; where the system has no such language, one that it does not know.
TEST(Surroundings, OfMissingFoldersAndAnotherLanguageGiveTheSameBytes) {
  const std::string language = has_locale("de_DE.utf8") ? "LC_ALL=de_DE.utf8" : "LC_ALL=de_DE";
  for (const Job& job : jobs())
    expect_same_bytes(job, {"/usr/bin/env", "HOME=/nonexistent", "TMPDIR=/nonexistent", language});
}

TEST(Surroundings, OfAContainerGiveTheSameBytes) {
  const Words container{"/usr/bin/unshare", "--pid", "--mount-proc", "--fork"};
  Words probe = container;
  probe.push_back("/bin/true");
  if (run_words(probe).code != 0) GTEST_SKIP() << "no process namespaces (needs root)";
  for (const Job& job : {jobs()[0], jobs()[4]}) expect_same_bytes(job, container);
}

// The job's folder on a disk of its own; only root is allowed to mount one.
class SmallDisk : public testing::Test {
 protected:
  // False, and the test is skipped, without the permission.
  bool mount(const Job& job, const std::string& size) {
    folder().undisturbed(job);
    std::filesystem::remove_all(folder().path());
    std::filesystem::create_directory(folder().path());
    if (::mount("tmpfs", folder().path().c_str(), "tmpfs", 0, ("size=" + size).c_str()) != 0) return false;
    for (const auto& entry : std::filesystem::directory_iterator(folder().start_of(job)))
      std::filesystem::copy(entry.path(), folder().path() / entry.path().filename(),
                            std::filesystem::copy_options::recursive);
    return true;
  }

  void remount(const std::string& size, unsigned long flags) {
    EXPECT_EQ(::mount("tmpfs", folder().path().c_str(), "tmpfs", MS_REMOUNT | flags, ("size=" + size).c_str()), 0);
  }

  void TearDown() override { ::umount(folder().path().c_str()); }

  // Sizes in kB between that of the files with which the job begins and that with its results.
  std::vector<std::uintmax_t> sizes(const Job& job, int count) {
    const auto kilobytes = [](const std::filesystem::path& path) {
      std::uintmax_t sum = 0;
      for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
        sum += entry.is_regular_file() ? (entry.file_size() + 4095) / 4096 * 4 : 4;
      return sum;
    };
    folder().undisturbed(job);
    folder().begin(job);
    EXPECT_EQ(run_words(folder().words(job)).code, 0);
    const std::uintmax_t least = kilobytes(folder().start_of(job)) + 4, most = kilobytes(folder().path());
    std::vector<std::uintmax_t> found;
    for (int i = 0; i < count; ++i)
      found.push_back(least + (most - least) * static_cast<unsigned>(i) / static_cast<unsigned>(count));
    return found;
  }

  void expect_refused(const Job& job) {
    const ProgramResult result = run_words(folder().words(job));
    EXPECT_EQ(result.code, 1) << job.name << ": " << result.err;
    EXPECT_TRUE(is_one_complaint(result.err)) << job.name << ": " << result.err;
    EXPECT_EQ(folder().differences(job, false), Words{}) << job.name;
  }
};

TEST_F(SmallDisk, ThatIsFullEndsEveryCommandWithOneLineAndAgainGivesTheSameBytes) {
  for (const Job& job : jobs()) {
    const bool is_slow = &job == &jobs().back();
    for (const std::uintmax_t size : sizes(job, is_slow ? 1 : 2)) {
      if (!mount(job, std::to_string(size) + "k")) GTEST_SKIP() << "cannot mount a small disk (needs root)";
      expect_refused(job);
      remount("64m", 0);
      const ProgramResult again = run_words(folder().words(job));
      EXPECT_EQ(again.code, 0) << job.name << ": " << again.err;
      EXPECT_EQ(folder().differences(job, true), Words{}) << job.name << ", " << size << " kB";
      ::umount(folder().path().c_str());
    }
  }
}

TEST_F(SmallDisk, ThatIsReadOnlyEndsEveryCommandWithOneLine) {
  for (const Job& job : jobs()) {
    if (!mount(job, "64m")) GTEST_SKIP() << "cannot mount a small disk (needs root)";
    remount("64m", MS_RDONLY);
    expect_refused(job);
    ::umount(folder().path().c_str());
  }
}

}  // namespace
}  // namespace seaglint
