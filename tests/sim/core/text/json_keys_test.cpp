// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/json_keys.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/core/process/error.h"

namespace seaglint {
namespace {

std::string refusal(const std::string& json) {
  try {
    refuse_repeated_keys(json, "m.json");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RepeatedKeys, AreRefusedInEveryObject) {
  EXPECT_EQ(refusal(R"({"a": 1, "b": 2, "a": 3})"), "m.json: the key 'a' appears twice in an object");
  EXPECT_EQ(refusal(R"([{"x": {"a": 1, "\u0061": 3}}])"), "m.json: the key 'a' appears twice in an object");
  EXPECT_EQ(refusal("{\"\\u001b\": 1, \"\\u001b\": 2}"), "m.json: the key '\\x1b' appears twice in an object");
}

TEST(RepeatedKeys, AreNotThoseOfDifferentObjects) {
  EXPECT_EQ(refusal(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})"), "accepted");
  for (const char* no_json : {"", "{", "{\"a\": 1,", "{\"a\" 1}", "]"}) EXPECT_EQ(refusal(no_json), "accepted");
}

}  // namespace
}  // namespace seaglint
