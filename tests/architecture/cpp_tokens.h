// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// C++ text as tokens: identifiers, numbers, `::`, `->` and single characters. Comments, preprocessor lines and the
// branches of #else are left out, literals of text become one token each.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace seaglint {

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

}  // namespace seaglint
