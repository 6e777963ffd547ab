// SPDX-License-Identifier: BSD-3-Clause
// No type and no function of external linkage is defined twice, whichever programs they are linked into.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/architecture/definitions.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

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
