// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/json.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/refusal.h"

namespace seaglint {
namespace {

std::string json_refusal(const std::string& json) {
  return refusal_of([&] { check_json(json, "m.json", 3); });
}

TEST(RepeatedKeys, AreRefusedInEveryObject) {
  EXPECT_EQ(json_refusal(R"({"a": 1, "b": 2, "a": 3})"), "m.json: the key 'a' appears twice in an object");
  EXPECT_EQ(json_refusal(R"([{"x": {"a": 1, "\u0061": 3}}])"), "m.json: the key 'a' appears twice in an object");
  EXPECT_EQ(json_refusal("{\"\\u001b\": 1, \"\\u001b\": 2}"), "m.json: the key '\\x1b' appears twice in an object");
}

TEST(RepeatedKeys, AreNotThoseOfDifferentObjects) {
  EXPECT_EQ(json_refusal(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})"), "accepted");
  for (const char* no_json : {"", "{", "{\"a\": 1,", "{\"a\" 1}", "]"}) EXPECT_EQ(json_refusal(no_json), "accepted");
}

TEST(RepeatedKeys, AreCheckedInObjectsOfLimitedSizeAndDepth) {
  EXPECT_EQ(json_refusal(R"({"a": 1, "b": 2, "c": [{"d": 1}]})"), "accepted");
  EXPECT_EQ(json_refusal(R"({"a": 1, "b": 2, "c": 3, "d": 4})"), "m.json: an object has more than 3 keys");
  EXPECT_EQ(json_refusal(std::string(64, '[') + std::string(64, ']')), "accepted");
  EXPECT_EQ(json_refusal(std::string(65, '[') + std::string(65, ']')),
            "m.json: the JSON is nested more than 64 levels deep");
  EXPECT_EQ(json_refusal(R"({"a": )" + std::string(200'000, '[')),
            "m.json: the JSON is nested more than 64 levels deep");
}

}  // namespace
}  // namespace seaglint
