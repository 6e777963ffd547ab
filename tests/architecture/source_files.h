// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The text files of the repository, their C++ as tokens, and the names of tests and benchmarks in it.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
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
  for (std::string item; std::getline(stream, item, separator);) {
    if (!item.empty()) items.push_back(item);
  }
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
    for (const char* folder : {"assets", "scenarios", "sim", "radar", "classify", "tools", "tests"}) {
      for (const auto& entry : fs::recursive_directory_iterator(root / folder)) add(entry);
    }
    std::sort(found.begin(), found.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return found;
  }();
  return files;
}

// The C++ files among them.
inline std::vector<SourceFile> code_files() {
  std::vector<SourceFile> code;
  for (const SourceFile& file : source_files()) {
    if (file.is_code()) code.push_back(file);
  }
  return code;
}

// The folders of stages and rooms from the first that may be included to the last: the rooms of a stage precede the
// stage itself, which contains the files outside its rooms.
inline std::vector<std::string> ordered_folders(const std::vector<std::string>& stages,
                                                const std::vector<std::string>& rooms) {
  std::vector<std::string> folders;
  for (const std::string& stage : stages) {
    for (const std::string& room : rooms) {
      if (room.starts_with(stage + "/")) folders.push_back(room);
    }
    folders.push_back(stage);
  }
  return folders;
}

inline std::vector<std::string> stage_list() { return split(SEAGLINT_STAGES, ','); }
inline std::vector<std::string> room_list() { return split(SEAGLINT_ROOMS, ','); }

// C++ text as tokens: identifiers, numbers, `::`, `->` and single characters. Comments, preprocessor lines and the
// branches of #else are left out, literals of text become one token each.
struct Token {
  std::string text;
  int line = 1;

  bool is_name() const { return std::isalpha(static_cast<unsigned char>(text[0])) != 0 || text[0] == '_'; }
};

class Tokeniser {
 public:
  explicit Tokeniser(const std::string& text) : text_(text) {}

  std::vector<Token> tokens() {
    while (at_ < text_.size()) {
      if (text_[at_] == '\n') {
        start_of_line_ = true;
        skip(1);
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        skip(1);
      } else if (starts("//")) {
        skip_to("\n");
      } else if (starts("/*")) {
        skip_to("*/");
        skip(2);
      } else if (text_[at_] == '#' && start_of_line_) {
        directive();
      } else {
        start_of_line_ = false;
        const int line = line_;
        std::string token = next();
        if (hidden_ == 0) tokens_.push_back({std::move(token), line});
      }
    }
    return std::move(tokens_);
  }

 private:
  bool starts(std::string_view with) const { return text_.compare(at_, with.size(), with) == 0; }

  void skip(std::size_t count) {
    for (; count > 0 && at_ < text_.size(); --count) line_ += text_[at_++] == '\n';
  }

  void skip_to(std::string_view end) {
    while (at_ < text_.size() && !starts(end)) skip(1);
  }

  // The first branch of #if, #else and #endif is kept.
  void directive() {
    std::string line;
    for (; at_ < text_.size() && text_[at_] != '\n'; skip(1)) {
      if (starts("\\\n")) skip(1);
      line += text_[at_];
    }
    const std::size_t word = line.find_first_not_of(" \t", 1);
    if (word == std::string::npos) return;
    const auto is = [&](std::string_view name) { return line.compare(word, name.size(), name) == 0; };
    if (is("if") && hidden_ > 0) ++hidden_;
    if (is("el") && hidden_ <= 1) hidden_ = 1;
    if (is("endif") && hidden_ > 0) --hidden_;
  }

  std::string next() {
    const std::size_t begin = at_;
    const auto is_word = [this] {
      return at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_');
    };
    if (starts("R\"")) return raw_text();
    if (text_[at_] == '"' || text_[at_] == '\'') return quoted(text_[at_]);
    if (std::isdigit(static_cast<unsigned char>(text_[at_])) != 0) {
      while (is_word() || starts(".") || starts("'")) skip(1);
      return text_.substr(begin, at_ - begin);
    }
    if (is_word()) {
      while (is_word()) skip(1);
      return text_.substr(begin, at_ - begin);
    }
    skip(starts("::") || starts("->") ? 2 : 1);
    return text_.substr(begin, at_ - begin);
  }

  std::string quoted(char quote) {
    skip(1);
    while (at_ < text_.size() && text_[at_] != quote) skip(text_[at_] == '\\' ? 2 : 1);
    skip(1);
    return "\"";
  }

  std::string raw_text() {
    const std::size_t open = text_.find('(', at_);
    std::string end = text_.substr(at_ + 1, open - at_ - 1);  // ", then the delimiter
    std::rotate(end.begin(), end.begin() + 1, end.end());
    end.insert(end.begin(), ')');
    skip_to(end);
    skip(end.size());
    return "\"";
  }

  const std::string& text_;
  std::size_t at_ = 0;
  int line_ = 1;
  bool start_of_line_ = true;
  int hidden_ = 0;  // depth of conditionals inside a branch that is left out
  std::vector<Token> tokens_;
};

inline std::vector<Token> tokens_of(const std::string& text) { return Tokeniser(text).tokens(); }

// A token, or past the last one a `;`, which ends every declaration.
inline const std::string& text_at(const std::vector<Token>& tokens, std::size_t i) {
  static const std::string none = ";";
  return i < tokens.size() ? tokens[i].text : none;
}

// Past the bracket that closes the one at i, or past the last token.
inline std::size_t past_bracket(const std::vector<Token>& tokens, std::size_t i) {
  const std::string open = text_at(tokens, i);
  const std::string close = open == "(" ? ")" : open == "[" ? "]" : open == "<" ? ">" : "}";
  int depth = 0;
  for (; i < tokens.size(); ++i) {
    if (tokens[i].text == open) ++depth;
    if (tokens[i].text == close && --depth == 0) return i + 1;
    // Round and curly brackets inside angle brackets may contain a comparison.
    if (open == "<" && (tokens[i].text == "(" || tokens[i].text == "{")) i = past_bracket(tokens, i) - 1;
  }
  return i;
}

// A test as its macro names it.
struct NamedTest {
  std::string suite;
  std::string name;  // as in a filter: SUITE.NAME, of an instantiated one INSTANCE/SUITE.NAME/0
  std::string file;
};

// The tests of one file; instantiations are in the file of their tests.
inline std::vector<NamedTest> tests_in(const SourceFile& file) {
  static const std::set<std::string> kMacros = {"TEST", "TEST_F", "TEST_P", "TYPED_TEST"};
  const std::vector<Token> tokens = tokens_of(file.text);
  std::vector<NamedTest> tests;
  for (std::size_t i = 0; i + 5 < tokens.size(); ++i) {
    if (!kMacros.contains(tokens[i].text) || tokens[i + 1].text != "(" || tokens[i + 3].text != ",") continue;
    const std::string &suite = tokens[i + 2].text, name = suite + "." + tokens[i + 4].text;
    if (tokens[i].text != "TEST_P") {
      tests.push_back({suite, name, file.path});
      continue;
    }
    for (std::size_t k = 0; k + 4 < tokens.size(); ++k) {
      if (tokens[k].text != "INSTANTIATE_TEST_SUITE_P") continue;
      const bool nameless = tokens[k + 2].text == ",";
      if (tokens[k + (nameless ? 3 : 4)].text == suite)
        tests.push_back({suite, (nameless ? "" : tokens[k + 2].text + "/") + name + "/0", file.path});
    }
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
  std::set<std::string> names;
  for (const SourceFile& file : files) {
    if (!file.path.ends_with("_bench.cpp")) continue;
    const std::vector<Token> tokens = tokens_of(file.text);
    for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
      if (tokens[i].text.starts_with("BENCHMARK") && tokens[i + 1].text == "(") names.insert(tokens[i + 2].text);
    }
  }
  return names;
}

}  // namespace seaglint
