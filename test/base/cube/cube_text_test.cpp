#include "base/cube/cube_text.hpp"

#include <gtest/gtest.h>

#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"
#include "base/fault.hpp"

namespace mrroc::cube {
namespace {

const std::string kScramble = "F' R2 D2 F L D B D R F";
const std::string kFacelets = "DDFBUFULLBRRURRLDRBUUFFFFBBRDDRDLFRDLLRULLUUDUFFDBBBBL";

/// @return the facelets with a blank after every so many
std::string grouped(const std::string& facelets, std::size_t size, const std::string& blank = " ") {
  std::string text;
  for (std::size_t k = 0; k < facelets.size(); k += size)
    text += (k > 0 ? blank : "") + facelets.substr(k, size);
  return text;
}

std::string refusal(const std::string& text) {
  try {
    static_cast<void>(read_cube(text));
  } catch (const FaultError& e) {
    return e.what();
  }
  return "";
}

TEST(CubeText, IsFaceletsWithBlanksWhereverTheyPlease) {
  const Cube cube = after({}, parse_moves(kScramble));
  EXPECT_EQ(read_cube(kFacelets), cube);
  EXPECT_EQ(read_cube(" " + kFacelets + "\n"), cube);
  for (const std::size_t size : {1, 3, 9, 20, 45})
    for (const char* blank : {" ", "\n", "\r\n", "\t "}) {
      EXPECT_EQ(read_cube(grouped(kFacelets, size, blank)), cube) << size;
      EXPECT_EQ(read_cube_line(grouped(kFacelets, size) + " F L2 some remark"), cube) << size;
    }
}

TEST(CubeText, IsTurnsAlsoWhenTheyAreMany) {
  std::string turns, in_one_word;
  for (int k = 0; k < 30; ++k) turns += "R U ", in_one_word += "RU'";
  EXPECT_EQ(read_cube(turns), after({}, parse_moves(turns)));
  EXPECT_EQ(read_cube_line(turns), after({}, parse_moves(turns)));
  EXPECT_EQ(read_cube(in_one_word), after({}, parse_moves(in_one_word)));
  EXPECT_EQ(refusal(turns + "Q"), "'Q' at character 121 is no turn");
}

TEST(CubeText, ThatCanOnlyBeFaceletsIsRefusedAsFacelets) {
  const std::string broken = "the rule 'length' is broken: ";
  EXPECT_EQ(refusal(kFacelets.substr(1)), broken + "53 facelets instead of 54");
  EXPECT_EQ(refusal(grouped(kFacelets.substr(1), 9)), broken + "53 facelets instead of 54");
  EXPECT_EQ(refusal(grouped(kFacelets.substr(1), 1)), broken + "53 facelets instead of 54");
  EXPECT_EQ(refusal(kFacelets.substr(0, 40)), broken + "40 facelets instead of 54");
  EXPECT_EQ(refusal(kFacelets + " " + kFacelets), broken + "108 facelets instead of 54");
  for (const std::string wrong : {"2", "'", "x", "\u2019", "-"}) {
    std::string text = kFacelets;
    text.replace(20, 1, wrong);
    for (const std::size_t size : {54, 27})
      EXPECT_EQ(
          refusal(text.substr(0, size) + " " + text.substr(size)),
          "the rule 'letter' is broken: facelet F3, number 21, is '" + wrong + "', no letter of URFDLB");
  }
  std::string small = kFacelets;
  for (char& c : small) c = static_cast<char>(std::tolower(c));
  EXPECT_EQ(refusal(small), "the rule 'letter' is broken: facelet U1, number 1, is 'd', no letter of URFDLB");
}

TEST(CubeText, OfALineThatLacksAFaceletDoesNotTakeOneFromTheRemark) {
  try {
    static_cast<void>(read_cube_line(kFacelets.substr(0, 53) + " L2 F B"));
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(std::string(e.what()), "the rule 'length' is broken: 53 facelets instead of 54");
  }
}

}  // namespace
}  // namespace mrroc::cube
