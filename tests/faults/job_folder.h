// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Commands of the program on a tiny scenario, each begun in the same folder with the same files, so that a disturbed
// one can be compared with an undisturbed one byte for byte.

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/pipeline/program.h"

namespace seaglint {

using Words = std::vector<std::string>;
using Bytes = std::map<std::string, std::string>;  // by path below the folder; a folder's name ends in a slash

// A command, repeated by the same words.
struct Job {
  const char* name;
  bool has_data;  // begins with a complete data set in data/
  Words words;    // without the program; "@" stands for the folder
};

inline const std::vector<Job>& jobs() {
  static const std::vector<Job> all{
      {"generate", false, {"generate", "@/tiny.yaml", "-o", "@/data", "--resume", "--threads", "1"}},
      {"merge", true, {"merge", "@/data"}},
      {"export", true, {"export", "@/data", "-o", "@/npz"}},
      {"export, one file", true, {"export", "@/data", "-o", "@/all.npz"}},
      {"export, tar", true, {"export", "@/data", "-o", "@/tar", "--as", "webdataset", "--max-tar-mb", "0.1"}},
      {"features",
       true,
       {"features", "@/data", "--set", "clutter.scr_db=10", "-o", "@/other", "--resume", "--threads", "1"}},
      {"card", true, {"card", "@/data", "--licence", "CC-BY-4.0", "--date", "2026-05-01"}},
      {"train", true, {"train", "@/data", "-o", "@/model", "--threads", "1"}},
      {"run", false, {"run", "@/tiny.yaml", "-o", "@/run", "--resume", "--threads", "1"}}};
  return all;
}

// The folder of the jobs, one for each test program.
class JobFolder {
 public:
  JobFolder() {
    begin(jobs().front());
    const ProgramResult generated = run_words(words(jobs().front()));
    EXPECT_EQ(generated.code, 0) << generated.err;
    std::filesystem::copy(path(), with_data_, std::filesystem::copy_options::recursive);
  }

  std::filesystem::path path() const { return folder_.path() / "job"; }
  // A file outside the folder.
  std::filesystem::path beside(const std::string& name) const { return folder_.path() / name; }

  // The files with which a job begins.
  std::filesystem::path start_of(const Job& job) const {
    return job.has_data ? with_data_ : std::filesystem::path(SEAGLINT_SOURCE_DIR "/tests/faults/tiny");
  }

  // Removes all files and copies those with which the job begins.
  void begin(const Job& job) const {
    std::filesystem::remove_all(path());
    std::filesystem::copy(start_of(job), path(), std::filesystem::copy_options::recursive);
  }

  // The words that start the job in the folder, behind those of `launcher`: data sets name their inputs as the scenario
  // does, relative to it or to the working directory.
  Words words(const Job& job, const Words& launcher = {}) const {
    Words all{"/usr/bin/env", "-C", path().string()};
    all.insert(all.end(), launcher.begin(), launcher.end());
    all.push_back(kProgram);
    for (std::string word : job.words) {
      if (word.starts_with('@')) word.replace(0, 1, path().string());
      all.push_back(word);
    }
    return all;
  }

  // What is there now, without the times that a run prints about itself and its count of maps that were kept.
  Bytes bytes() const {
    Bytes found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path())) {
      const std::string name = entry.path().lexically_relative(path());
      if (entry.is_directory()) {
        found[name + "/"];
        continue;
      }
      std::string& content = found[name] = read_file(entry.path());
      static const std::regex of_page("<b>[0-9]+ s</b>|<td>[0-9.]+ s</td>|<td>[0-9]+ / [0-9]+</td>"),
          of_numbers("\"(maps|learning|report|maps_made|maps_kept)\": [-+.e0-9]+");
      if (name == "run/report.html") content = std::regex_replace(content, of_page, "");
      if (name == "run/metrics.json") content = std::regex_replace(content, of_numbers, "");
    }
    return found;
  }

  // The files and folders after the job alone.
  const Bytes& undisturbed(const Job& job) {
    const auto known = undisturbed_.find(job.name);
    if (known != undisturbed_.end()) return known->second;
    begin(job);
    const ProgramResult result = run_words(words(job));
    EXPECT_EQ(result.code, 0) << job.name << ": " << result.err;
    return undisturbed_[job.name] = bytes();
  }

  // Names of what is there and differs from the undisturbed job's. With `all`, also of what is missing; without it,
  // files that are still those of the start count as equal, and the numbers of a run, which are written before the
  // report and again with the report's.
  Words differences(const Job& job, bool all) {
    const Bytes there = bytes();
    const Bytes& right = undisturbed(job);
    Words names;
    for (const auto& [name, content] : there) {
      if (!right.contains(name)) names.push_back("surplus: " + name);
      if (!all && (name == "run/metrics.json" || is_of_start(job, name, content))) continue;
      if (right.contains(name) && right.at(name) != content) names.push_back("other bytes: " + name);
    }
    for (const auto& [name, content] : right) {
      if (all && !there.contains(name)) names.push_back("missing: " + name);
    }
    return names;
  }

 private:
  bool is_of_start(const Job& job, const std::string& name, const std::string& content) const {
    const std::filesystem::path file = start_of(job) / name;
    return std::filesystem::is_regular_file(file) && read_file(file) == content;
  }

  TemporaryFolder folder_;
  std::filesystem::path with_data_ = folder_.path() / "with_data";
  std::map<std::string, Bytes> undisturbed_;
};

// The program's complaint: one line at the end, and none but warnings before it.
inline bool is_one_complaint(const std::string& err) {
  std::istringstream stream(err);
  int complaints = 0;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("seaglint: ")) return false;
    if (!line.starts_with("seaglint: warning: ")) ++complaints;
  }
  return complaints == 1;
}

}  // namespace seaglint
