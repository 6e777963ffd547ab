// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_files.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The types of a function's parameters as normalised text, so that two parameter lists can be compared.

// The type of one parameter without its name. The const of a parameter passed by value and the size of an array are not
// part of a function's type.
std::string parameter_type(std::vector<std::string> words) {
  static const std::set<std::string> kKeywords = {"int",   "double", "float", "bool",     "char", "void",
                                                  "short", "long",   "auto",  "unsigned", "const"};
  const auto has = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  std::string array;
  if (words.back() == "]") {
    array = "[]";
    words.erase(std::find(words.begin(), words.end(), "["), words.end());
  }
  const std::string before = words.size() > 1 ? words[words.size() - 2] : "::";
  const bool named = Token{words.back()}.is_name() && !kKeywords.contains(words.back()) && before != "::" &&
                     before != "const" && before != "typename";
  if (named) words.pop_back();
  if (!has("&") && !has("*") && words.front() == "const") words.erase(words.begin());
  std::string type;
  for (const std::string& word : words) {
    const bool spaced = !type.empty() && Token{word}.is_name() && std::isalnum(static_cast<unsigned char>(type.back()));
    type += (spaced ? " " : "") + (word == "fs" ? "std::filesystem" : word);
  }
  return type + array;
}

// Of the parameters between two round brackets: `open` is the first one, `close` past the second. Defaults are left
// out.
std::string parameter_types(const std::vector<Token>& tokens, std::size_t open, std::size_t close) {
  std::string list;
  std::vector<std::string> words;
  bool in_default = false;
  for (std::size_t i = open + 1; i < close;) {
    const std::string& token = tokens[i].text;
    if (token == "," || i + 1 == close) {
      if (!words.empty()) list += (list.empty() ? "" : ", ") + parameter_type(words);
      words.clear();
      in_default = false;
      ++i;
      continue;
    }
    if (token == "=") in_default = true;
    const bool bracket = token == "(" || token == "{" || (token == "<" && !in_default);
    for (const std::size_t end = bracket ? past_bracket(tokens, i) : i + 1; i < end; ++i) {
      if (!in_default) words.push_back(tokens[i].text);
    }
  }
  return list;
}

// The types and functions that a file defines at namespace scope with external linkage, found by a scan of its tokens
// without a compiler: macros and aliases are taken as written.

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

std::vector<Definition> definitions_of(const SourceFile& file) { return DefinitionScan(file).definitions(); }

// No type and no function of external linkage is defined twice, whichever programs they are linked into.

// "name: place place" of every name that is defined more than once. `main` is one in every program.
std::vector<std::string> defined_twice(const std::vector<SourceFile>& files) {
  std::map<std::string, std::vector<std::string>> places;
  for (const SourceFile& file : files) {
    for (const Definition& definition : definitions_of(file)) {
      if (!definition.name.starts_with("main(")) places[definition.name].push_back(definition.place);
    }
  }
  std::vector<std::string> found;
  for (const auto& [name, all] : places) {
    if (all.size() < 2) continue;
    found.push_back(name + ":");
    for (const std::string& place : all) found.back() += " " + place;
  }
  return found;
}

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  for (const Definition& definition : definitions_of({"x.cpp", text})) names.push_back(definition.name);
  return names;
}

TEST(OneDefinition, NoTypeAndNoExternalFunctionIsDefinedTwice) {
  const std::vector<SourceFile> code = code_files();
  std::size_t types = 0, functions = 0;
  for (const SourceFile& file : code) {
    for (const Definition& definition : definitions_of(file)) ++(definition.type ? types : functions);
  }
  EXPECT_GT(types, 300u) << "the scan finds no types";
  EXPECT_GT(functions, 800u) << "the scan finds no functions";
  EXPECT_THAT(defined_twice(code), IsEmpty());
}

TEST(OneDefinition, TypesOfEveryKindAreFound) {
  EXPECT_THAT(names_in("namespace a { struct S { int x; }; class C final : public B<int> {}; enum class E { k };\n"
                       "enum F : int { f }; union U { int i; }; using V = int; typedef int W; }"),
              ElementsAre("a::S", "a::C", "a::E", "a::F", "a::U", "a::V", "a::W"));
  EXPECT_THAT(names_in("struct S; class C; using namespace std; using std::max; namespace fs = std::filesystem;\n"
                       "struct S make(); template <> struct hash<S> { struct Inner {}; };"),
              ElementsAre("hash<S>"));
}

TEST(OneDefinition, FunctionsAreNamedByTheTypesOfTheirParameters) {
  EXPECT_THAT(
      names_in("namespace a::b {\n"
               "inline int f(const std::vector<int>& all, double x = g(1, 2), const int n = 3) { return 1; }\n"
               "T C::g(std::size_t, fs::path file, double table[3]) const { if (x) {} }\n"
               "C::C(int x) : x_{x}, y_(x) { }\n"
               "template <typename T> auto h(T&& x) -> std::map<int, T> { }\n"
               "bool operator==(const C& a, const C& b) { }\n"
               "double C::operator()(double x) const { }\n"
               "C::~C() = default;\n"
               "}"),
      ElementsAre("a::b::f(const std::vector<int>&, double, int)",
                  "a::b::C::g(std::size_t, std::filesystem::path, double[]) const", "a::b::C::C(int)", "a::b::h<>(T&&)",
                  "a::b::operator==(const C&, const C&)", "a::b::C::operator()(double) const", "a::b::C::~C()"));
}

TEST(OneDefinition, DeclarationsObjectsAndInternalNamesAreNoDefinitions) {
  EXPECT_THAT(names_in("int f(int x); static int g() { } constexpr int kX = f(3); const std::regex pattern(\"(a)\");\n"
                       "constexpr auto k = [](int x) { return x; }; std::vector<int> v{1, 2};\n"
                       "namespace { struct S {}; int h() { } namespace n { struct T {}; } }\n"
                       "TEST(Suite, Name) { struct Local {}; } BENCHMARK(X)->Arg(1);\n"
                       "// struct Comment {};\n#define X struct Y {};\n#if 1\n#else\nstruct Other {};\n#endif\n"
                       "const char* text = R\"x(struct Z {};)x\"; const char quote = '{';"),
              IsEmpty());
}

TEST(OneDefinition, SecondDefinitionsAreFoundAndOverloadsAreNone) {
  const SourceFile a{"a.h", "namespace n { struct S { int x; }; inline int f(int x) { return x; } }"};
  const SourceFile b{"b.h", "namespace n {\nclass S {};\nint f(double x) { return 1; }\nint f(const int y) { } }"};
  EXPECT_THAT(defined_twice({a, b}), ElementsAre("n::S: a.h:1 b.h:2", "n::f(int): a.h:1 b.h:4"));
  const SourceFile c{"c.h", "namespace m { struct S { int x; }; int f(long x) { } namespace { struct T {}; } }"};
  EXPECT_THAT(defined_twice({a, c, {"d.cpp", "namespace m { namespace { struct T {}; } }"}}), IsEmpty());
}

}  // namespace
}  // namespace seaglint
