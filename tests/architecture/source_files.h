// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The text files of the repository, their C++ without comments and literals, and the names of tests and benchmarks in
// it.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

struct SourceFile {
  std::string path;  // relative to the root
  std::string text;

  bool is_code() const { return path.ends_with(".h") || path.ends_with(".cpp"); }
  bool is_below(std::string_view folder) const { return path.starts_with(std::string(folder) + "/"); }
};

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::vector<std::string> split(const std::string& list, char separator) {
  std::vector<std::string> items;
  std::istringstream stream(list);
  for (std::string item; std::getline(stream, item, separator);)
    if (!item.empty()) items.push_back(item);
  return items;
}

// Whether a file is text that names or defines something: code, documents and scripts. Data are not read.
inline bool is_read(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return extension.empty() || extension == ".h" || extension == ".cpp" || extension == ".md" || extension == ".py" ||
         extension == ".sh" || extension == ".cmake" || file.filename() == "CMakeLists.txt";
}

// All text files of the project's folders and of its root, by path.
inline const std::vector<SourceFile>& source_files() {
  static const std::vector<SourceFile> files = [] {
    namespace fs = std::filesystem;
    const fs::path root = SEAGLINT_SOURCE_DIR;
    std::vector<SourceFile> found;
    const auto add = [&](const fs::directory_entry& entry) {
      if (!entry.is_regular_file() || !is_read(entry.path())) return;
      std::ifstream file(entry.path(), std::ios::binary);
      std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      found.push_back({fs::relative(entry.path(), root).string(), std::move(text)});
    };
    for (const auto& entry : fs::directory_iterator(root)) add(entry);
    for (const char* folder : {"assets", "scenarios", "sim", "radar", "classify", "tools", "tests"})
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) add(entry);
    std::sort(found.begin(), found.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return found;
  }();
  return files;
}

// The C++ files among them.
inline std::vector<SourceFile> code_files() {
  std::vector<SourceFile> code;
  for (const SourceFile& file : source_files())
    if (file.is_code()) code.push_back(file);
  return code;
}

// The folders of stages and rooms from the first that may be included to the last: the rooms of a stage precede the
// stage itself, which contains the files outside its rooms.
inline std::vector<std::string> ordered_folders(const std::vector<std::string>& stages,
                                                const std::vector<std::string>& rooms) {
  std::vector<std::string> folders;
  for (const std::string& stage : stages) {
    for (const std::string& room : rooms)
      if (room.starts_with(stage + "/")) folders.push_back(room);
    folders.push_back(stage);
  }
  return folders;
}

inline std::vector<std::string> stage_list() { return split(SEAGLINT_STAGES, ','); }
inline std::vector<std::string> room_list() { return split(SEAGLINT_ROOMS, ','); }

// C++ text without comments and with empty literals of text; its lines stay.
inline std::string code_of(const std::string& text) {
  std::string code;
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "R\"") == 0) {
      const std::size_t open = text.find('(', i);
      const std::string close = ")" + text.substr(i + 2, open - i - 2) + "\"";
      end = text.find(close, open) + close.size();
      code += "\"\"" + std::string(static_cast<std::size_t>(std::count(&text[i], &text[end], '\n')), '\n');
      i = end;
    } else if (text[i] == '"' || (text[i] == '\'' && (i == 0 || !is_word(text[i - 1])))) {
      while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
      code += std::string(2, text[i]);
      i = end + 1;
    } else {
      code += text[i++];
    }
  }
  return code;
}

// A test as its macro names it.
struct NamedTest {
  std::string suite;
  std::string name;  // as in a filter: SUITE.NAME, of an instantiated one INSTANCE/SUITE.NAME/0
  std::string file;
};

// Every part of a text that matches a pattern: its groups.
inline std::vector<std::smatch> matches_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern, std::regex::ECMAScript | std::regex::multiline);
  return {std::sregex_iterator(text.begin(), text.end(), regex), {}};
}

// The tests of one file; instantiations are in the file of their tests.
inline std::vector<NamedTest> tests_in(const SourceFile& file) {
  static const std::regex test(R"((?:^|\n)(?:TEST|TEST_F|TYPED_TEST|(TEST_P))\((\w+),\s*(\w+)\))"),
      instance(R"(\nINSTANTIATE_TEST_SUITE_P\((\w*),\s*(\w+),)");
  std::vector<NamedTest> tests;
  for (std::sregex_iterator match(file.text.begin(), file.text.end(), test), end; match != end; ++match) {
    const std::string suite = (*match)[2], name = suite + "." + (*match)[3].str();
    if (!(*match)[1].matched) {
      tests.push_back({suite, name, file.path});
      continue;
    }
    for (std::sregex_iterator found(file.text.begin(), file.text.end(), instance); found != end; ++found)
      if ((*found)[2] == suite)
        tests.push_back({suite, (*found)[1].str() + ((*found)[1].length() > 0 ? "/" : "") + name + "/0", file.path});
  }
  return tests;
}

inline std::vector<NamedTest> all_tests() {
  std::vector<NamedTest> all;
  for (const SourceFile& file : code_files()) {
    if (!file.path.ends_with("_test.cpp")) continue;
    for (NamedTest& test : tests_in(file)) all.push_back(std::move(test));
  }
  return all;
}

inline std::set<std::string> benchmarks_in(const std::vector<SourceFile>& files) {
  static const std::regex benchmark(R"(\nBENCHMARK\w*\((\w+))");
  std::set<std::string> names;
  for (const SourceFile& file : files) {
    if (!file.path.ends_with("_bench.cpp")) continue;
    for (std::sregex_iterator match(file.text.begin(), file.text.end(), benchmark), end; match != end; ++match)
      names.insert((*match)[1]);
  }
  return names;
}

}  // namespace seaglint
