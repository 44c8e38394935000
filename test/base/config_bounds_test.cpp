// Configurations that are too deep or too large are refused before the TOML library follows them.
#include "base/config_bounds.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/config.hpp"

namespace mrroc::test {
namespace {

/// @return "a.a.a", that many parts
std::string parts(int count, const std::string& part = "a") {
  std::string key = part;
  for (int k = 1; k < count; ++k) key += "." + part;
  return key;
}

std::string nested(int depth, const std::string& open, const std::string& close) {
  std::string text = "x = ";
  for (int k = 0; k < depth; ++k) text += open;
  text += "1";
  for (int k = 0; k < depth; ++k) text += close;
  return text + "\n";
}

/// @return what the error says; empty: there is none
std::string error_of(const std::string& text) {
  try {
    (void)Config::parse(text, "a.toml");
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.fault().code, FaultCode::bad_configuration);
    return error.what();
  }
  return {};
}

TEST(ConfigBounds, KeysMayHaveSoManyPartsWhereverTheyStand) {
  for (const std::string part : {"a", "\"a\"", "'a'", "\"=\"", "'#'", "\"\\\"\"", "a \t", "\"]\""}) {
    const bool bare = part.find_first_of("=#]\\") == std::string::npos;
    for (const int depth : {kMostKeyParts + 1, 1000, 20'000}) {
      const std::string key = parts(depth, part);
      EXPECT_NE(error_of("b = 1\n" + key + " = 1\n").find("a.toml:2:"), std::string::npos) << part << depth;
      for (const std::string& text : {key + "=1", "[" + key + "]", "[[" + key + "]]", "b = {" + key + "=1}",
                                      "b = {c = 1, " + key + "=1}", "b = [{" + key + "=1}]"})
        EXPECT_NE(error_of(text + "\n").find("a key has over 32 parts"), std::string::npos)
            << part << ' ' << depth << ' ' << text.substr(0, 40);
    }
    if (bare) {
      EXPECT_EQ(error_of(parts(kMostKeyParts, part) + " = 1\n"), "") << part;
    }
  }
}

TEST(ConfigBounds, TheWholeDepthOfATextIsBoundedHoweverKeysAndBracketsAreMixed) {
  std::string text;
  for (int k = 0; k < kDeepestBrackets; ++k) text += parts(kMostKeyParts) + " = {";
  EXPECT_EQ(config_excess(text), std::nullopt);
  EXPECT_NE(error_of(text).find("a.toml:1:"), std::string::npos) << "the braces are not closed";
  EXPECT_TRUE(config_excess(text + "b = {").has_value());
}

TEST(ConfigBounds, PartsOfTheTablesAroundAKeyCountSoThatADumpCanBeRead) {
  for (const std::string& text :
       {"[" + parts(20) + "]\n" + parts(12) + " = 1\n", parts(20) + " = {" + parts(12) + " = 1}\n"}) {
    ASSERT_EQ(error_of(text), "");
    const std::string dumped = Config::parse(text, "a.toml").dump();
    EXPECT_EQ(Config::parse(dumped, "b.toml").dump(), dumped);
  }
  for (const std::string& text : {"[" + parts(20) + "]\n" + parts(13) + " = 1\n",
                                  parts(20) + " = {" + parts(13) + " = 1}\n", "[" + parts(32) + "]\na = 1\n"})
    EXPECT_NE(error_of(text).find("a key has over 32 parts"), std::string::npos) << text;
}

TEST(ConfigBounds, BracketsMayBeNestedSoDeep) {
  EXPECT_EQ(error_of("x = " + std::string(7, '[') + std::string(7, ']') + "\n").find("deeper"),
            std::string::npos);
  for (const int depth : {kDeepestBrackets + 1, 300, 100'000}) {
    EXPECT_NE(error_of(nested(depth, "[", "]")).find("nested deeper than 8"), std::string::npos) << depth;
    EXPECT_NE(error_of(nested(depth, "{a=", "}")).find("nested deeper than 8"), std::string::npos) << depth;
    EXPECT_NE(error_of("[[" + nested(depth, "[ {a=", "}]")).find("deeper"), std::string::npos) << depth;
  }
}

TEST(ConfigBounds, WhatFollowsATextAtOnceCounts) {
  std::string lists, tables;
  for (int k = 0; k < 2 * kDeepestBrackets; ++k) {
    lists += "x" + std::to_string(k) + " = [\"a\"]\n";
    tables += "y" + std::to_string(k) + " = {a='b'}\n";
  }
  EXPECT_EQ(error_of(lists), "") << "every bracket is closed";
  EXPECT_EQ(error_of(tables), "");
}

TEST(ConfigBounds, DotsAndBracketsInTextsAndCommentsAreNoDepth) {
  const std::string many = parts(500) + std::string(100, '[');
  for (const std::string& text :
       {"x = \"" + many + "\"\n", "x = '" + many + "'\n", "# " + many + "\nx = 1\n", "x = 1 # " + many + "\n",
        "x = \"\"\"\n\"" + many + "\\\"\"\"\"\"\n", "x = '''" + many + "\n''" + many + "'''''\n",
        "x = \"\\\\\" # \"" + many + "\n"})
    EXPECT_EQ(error_of(text), "") << text.substr(0, 30);
  std::string list = "x = [0.5";
  for (int k = 0; k < 1000; ++k) list += k % 3 == 0 ? ",\n 1.5" : ", 1.5";
  EXPECT_EQ(error_of(list + "]\n"), "");
}

TEST(ConfigBounds, AStringThatSeemsToEndDoesNotHideDepth) {
  const std::string deep = parts(20'000) + " = 1\n";
  for (const std::string before :
       {"a = \"\\\"\"\n", "a = '\\'\n", "a = \"\"\n", "a = ''\n", "a = \"\"\"\"\"\"\n", "a = ''''''\n",
        "a = \"\"\"x\"\"\"\"\"\n", "a = '''x'''\n", "# \"\n", "# '''\n", "a = \"\"\"\\\\\"\"\"\n",
        "a = '''\\'''\n", "a = \"#\"\n", "\t\t\ta = 1\t\r\n"})
    EXPECT_NE(error_of(before + deep).find("a key has over 32 parts"), std::string::npos) << before;
}

TEST(ConfigBounds, TextsAndKeysHaveALargestSize) {
  EXPECT_NE(error_of("x = \"" + std::string(kLargestConfig, 'a') + "\"").find("over the limit of 1000000"),
            std::string::npos);
  EXPECT_EQ(error_of(std::string(kLongestKey, 'a') + " = 1"), "");
  const std::string error = error_of("b = 1\n" + std::string(500'000, 'a') + " = 1");
  EXPECT_EQ(error, "a.toml:2: a key with 500000 characters; it may have 200");
  for (const std::string& table :
       {"[" + parts(8, std::string(30, 'a')) + "]\n", parts(20, "abcdefghij") + " = 1\n"})
    EXPECT_NE(error_of(table).find("; it may have 200"), std::string::npos) << table;
}

TEST(ConfigBounds, AnIntegerInAListIsReadExactlyOrRefused) {
  const Config config = Config::parse("x = [9007199254740992, -9007199254740992]", "a.toml");
  EXPECT_EQ(config.dump(), "x = [9007199254740992.0, -9007199254740992.0]\n");
  for (const std::string large : {"9007199254740993", "9223372036854775807", "-9223372036854775808"})
    EXPECT_EQ(error_of("x = [1, " + large + "]"),
              "a.toml:1: 'x' has an integer that is too large for a list of numbers");
}

TEST(ConfigBounds, ErrorsAreShortAndCannotSpeakToTheTerminal) {
  const Config config = Config::parse("x = \"" + std::string(500'000, 'a') + "\"", "a\x1b[2J.toml");
  try {
    (void)config.number("x", 1);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_LT(std::string(error.what()).size(), 200U);
    EXPECT_TRUE(std::string(error.what()).starts_with("a?[2J.toml:1: ")) << error.what();
  }
  for (const std::string text : {"\x1b[2J = 1", "x = \x1b[2J", "x = \"\x9b\"", "\"\xc2\x9b\" = 1"})
    EXPECT_EQ(error_of(text).find_first_of("\x1b\x9b"), std::string::npos) << text;
}

// Whatever the scan lets through, the library survives: random texts of the signs that matter.
TEST(ConfigBounds, RandomNestingEndsInAnErrorOrAConfiguration) {
  std::mt19937_64 random(7);
  constexpr std::string_view kSigns[]{".", ".", ".", "a", "\"", "'",  "\"\"\"", "'''", "[",
                                      "]", "{", "}", "=", ",",  "\n", "#",      "\\",  " = 1\n"};
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = trial % 2 == 0 ? "a = " : "";
    for (int k = 0; k < 40; ++k) {
      const std::string_view sign = kSigns[random() % std::size(kSigns)];
      for (std::size_t n = random() % 8 == 0 ? random() % 400 : 1; n > 0; --n) text += sign;
    }
    const std::string error = error_of(text);
    EXPECT_TRUE(error.empty() || error.starts_with("a.toml")) << error;
  }
}

}  // namespace
}  // namespace mrroc::test
