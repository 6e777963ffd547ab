// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The types and functions that a file defines at namespace scope with external linkage, found by a scan of its tokens
// without a compiler: macros and aliases are taken as written.

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/cpp_tokens.h"
#include "tests/architecture/parameter_types.h"
#include "tests/architecture/source_files.h"

namespace seaglint {

struct Definition {
  std::string name;  // with its namespaces, of a function with the types of its parameters
  bool type = false;
  std::string place;  // FILE:LINE
};

class DefinitionScan {
 public:
  explicit DefinitionScan(const SourceFile& file) : path_(file.path), tokens_(tokens_of(file.text)) {}

  std::vector<Definition> definitions() {
    while (at_ < tokens_.size()) declaration();
    return std::move(found_);
  }

 private:
  struct Scope {
    std::string name;
    bool anonymous = false;
  };

  const std::string& text(std::size_t i) const { return text_at(tokens_, i); }
  bool is(const char* token) const { return text(at_) == token; }

  std::size_t closed(std::size_t i) const { return past_bracket(tokens_, i); }

  // Past the next `;` outside brackets.
  void skip_statement() {
    while (at_ < tokens_.size() && !is(";")) at_ = is("(") || is("{") || is("[") ? closed(at_) : at_ + 1;
    ++at_;
  }

  void add(bool type, const std::string& name, std::size_t token) {
    std::string whole;
    for (const Scope& scope : scopes_) {
      if (scope.anonymous) return;
      whole += scope.name + "::";
    }
    found_.push_back({whole + name, type, path_ + ":" + std::to_string(tokens_[token].line)});
  }

  void declaration() {
    if (is("template")) {
      templates_ += "<>";
      at_ = text(at_ + 1) == "<" ? closed(at_ + 1) : at_ + 1;
      return;
    }
    if (is("}")) {
      if (!scopes_.empty()) scopes_.pop_back();
      ++at_;
    } else if (is(";")) {
      ++at_;
    } else if (is("namespace") || (is("inline") && text(at_ + 1) == "namespace")) {
      enter_namespace();
    } else if (is("extern") && (text(at_ + 1) == "{" || (text(at_ + 1) == "\"" && text(at_ + 2) == "{"))) {
      scopes_.push_back({"extern C", false});
      while (!is("{")) ++at_;
      ++at_;
    } else if (is("using")) {
      if (text(at_ + 2) == "=") add(true, text(at_ + 1), at_ + 1);
      skip_statement();
    } else if (is("typedef")) {
      const std::size_t begin = at_;
      skip_statement();
      if (at_ - begin > 3) add(true, text(at_ - 2), at_ - 2);
    } else if (is("static_assert")) {
      skip_statement();
    } else if (is("struct") || is("class") || is("union") || is("enum")) {
      type_or_object();
    } else {
      function_or_object();
    }
    templates_.clear();
  }

  void enter_namespace() {
    while (is("inline") || is("namespace")) ++at_;
    std::string name;
    while (!is("{") && !is("=") && !is(";")) name += text(at_++);
    if (is("{")) {
      scopes_.push_back({name, name.empty()});
      ++at_;
    } else {
      skip_statement();  // an alias of a namespace
    }
  }

  void type_or_object() {
    std::size_t i = at_ + 1;
    while (text(i) == "class" || text(i) == "struct" || text(i) == "[" || text(i) == "alignas")
      i = text(i) == "[" ? closed(i) : text(i) == "alignas" ? closed(i + 1) : i + 1;
    const std::size_t name_at = i;
    std::string name = text(i);
    while (text(i + 1) == "::") {  // a member's definition outside its class
      name += "::" + text(i + 2);
      i += 2;
    }
    ++i;
    if (text(i) == "<") {  // a specialisation
      for (const std::size_t end = closed(i); i < end; ++i) name += text(i);
    }
    if (text(i) == "final") ++i;
    if (text(i) == ":") {
      while (text(i) != "{" && text(i) != ";") i = text(i) == "<" || text(i) == "(" ? closed(i) : i + 1;
    }
    if (text(i) != "{") {  // declared only, or the type of a function or an object
      return text(i) == ";" ? skip_statement() : function_or_object();
    }
    add(true, name, name_at);
    at_ = closed(i);
    skip_statement();
  }

  // From the name to the body; anything without a parameter list and a body is skipped.
  void function_or_object() {
    bool internal = false;
    std::size_t i = at_;
    for (; text(i) != ";" && text(i) != "=" && text(i) != "{"; ++i) {
      if (text(i) == "static") internal = true;
      if (text(i) == "operator") return function(i, operator_end(i), internal);
      if (text(i) == "<" || text(i) == "[") i = closed(i) - 1;
      if (text(i) != "(") continue;
      if (is_one_of(text(i - 1), {"decltype", "alignas", "noexcept", "__attribute__", "explicit"})) {
        i = closed(i) - 1;
      } else {
        return function(name_begin(i), i, internal);
      }
    }
    skip_statement_or_body(i);
  }

  static bool is_one_of(const std::string& token, const std::set<std::string>& names) { return names.contains(token); }

  std::size_t operator_end(std::size_t i) const {
    if (text(i + 1) == "(") return i + 3;  // operator()
    while (text(i) != "(") ++i;
    return i;
  }

  // The first token of a qualified name that ends before `end`.
  std::size_t name_begin(std::size_t end) const {
    std::size_t begin = end - 1;
    if (begin > at_ && text(begin - 1) == "~") --begin;
    while (begin > at_ + 1 && text(begin - 1) == "::") begin -= 2;
    return std::max(begin, at_);
  }

  void function(std::size_t name_begin_at, std::size_t open, bool internal) {
    std::string name;
    while (name_begin_at > at_ + 1 && text(name_begin_at - 1) == "::") name_begin_at -= 2;
    for (std::size_t i = name_begin_at; i < open; ++i) name += text(i);
    const std::size_t close = closed(open);
    std::string after;
    std::size_t i = close;
    for (; text(i) != ";" && text(i) != "{" && text(i) != "=" && text(i) != ":"; ++i) {
      if (text(i) == "const" || text(i) == "&") after += " " + text(i);
      if (text(i) == "(" || text(i) == "<" || text(i) == "[") i = closed(i) - 1;
    }
    const bool defaulted = text(i) == "=" && text(i + 1) == "default";
    if (text(i) == ":") i = past_initialisers(i + 1);
    // Macros such as TEST(Suite, Name) { have no type before their name.
    const bool macro = name_begin_at == at_ && name.find("::") == std::string::npos;
    if ((text(i) == "{" || defaulted) && !internal && !macro)
      add(false, name + templates_ + "(" + parameter_types(tokens_, open, close) + ")" + after, name_begin_at);
    skip_statement_or_body(i);
  }

  std::size_t past_initialisers(std::size_t i) const {
    while (i < tokens_.size()) {
      while (text(i) != "(" && text(i) != "{" && text(i) != ";") i = text(i) == "<" ? closed(i) : i + 1;
      if (text(i) == ";") return i;
      i = closed(i);
      if (text(i) != ",") return i;
      ++i;
    }
    return i;
  }

  void skip_statement_or_body(std::size_t i) {
    at_ = i;
    if (is("{")) {
      at_ = closed(at_);
      if (is(";") || is(",")) skip_statement();  // an object with braces
    } else {
      skip_statement();
    }
  }

  std::string path_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  std::vector<Scope> scopes_;
  std::string templates_;  // of the declaration that follows
  std::vector<Definition> found_;
};

inline std::vector<Definition> definitions_of(const SourceFile& file) { return DefinitionScan(file).definitions(); }

}  // namespace seaglint
