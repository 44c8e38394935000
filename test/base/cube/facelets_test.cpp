#include "base/cube/facelets.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/cube/move.hpp"
#include "base/cube/vocabulary.hpp"
#include "base/fault.hpp"

namespace mrroc::cube {
namespace {

const std::string kSolved = "UUUUUUUUURRRRRRRRRFFFFFFFFFDDDDDDDDDLLLLLLLLLBBBBBBBBB";

std::string exchanged(std::string facelets, int a, int b) {
  std::swap(facelets[a], facelets[b]);
  return facelets;
}

CubeRule rule_of(const std::string& facelets) { return read_facelets(facelets).broken; }

TEST(Facelets, AreReadAndWrittenBack) {
  std::mt19937_64 random(1);
  EXPECT_EQ(to_facelets({}), kSolved);
  for (int k = 0; k < 500; ++k) {
    const Cube cube = random_cube(random);
    const FaceletReading reading = read_facelets(to_facelets(cube));
    ASSERT_TRUE(reading.cube) << reading.text;
    EXPECT_EQ(*reading.cube, cube);
    EXPECT_EQ(reading.broken, CubeRule::none);
  }
}

TEST(Facelets, FollowTurnsAsOtherProgramsDraw) {
  EXPECT_EQ(to_facelets(after({}, parse_moves("R"))),
            "UUFUUFUUFRRRRRRRRRFFDFFDFFDDDBDDBDDBLLLLLLLLLUBBUBBUBB");
  // A scramble and its facelets from another program.
  EXPECT_EQ(to_facelets(after({}, parse_moves("F' R2 D2 F L D B D R F"))),
            "DDFBUFULLBRRURRLDRBUUFFFFBBRDDRDLFRDLLRULLUUDUFFDBBBBL");
}

TEST(Facelets, NameTheRuleThatIsBroken) {
  EXPECT_EQ(rule_of(kSolved.substr(1)), CubeRule::length);
  EXPECT_EQ(rule_of(kSolved + "U"), CubeRule::length);
  EXPECT_EQ(rule_of(""), CubeRule::length);
  std::string facelets = kSolved;
  facelets[10] = 'X';
  EXPECT_EQ(rule_of(facelets), CubeRule::letter);
  EXPECT_EQ(rule_of(exchanged(kSolved, 4, 13)), CubeRule::centre);
  facelets = kSolved;
  facelets[0] = 'R';
  EXPECT_EQ(rule_of(facelets), CubeRule::count);
  EXPECT_EQ(rule_of(exchanged(kSolved, 0, 29)), CubeRule::piece);       // a corner with D and D
  EXPECT_EQ(rule_of(exchanged(kSolved, 10, 25)), CubeRule::duplicate);  // UR to UF, DF to DR
}

TEST(Facelets, NameTheRuleOfTheGroupThatIsBroken) {
  Cube twisted, flipped, parity;
  twisted.corners[2] = 3 * 2 + 1;
  flipped.edges[8] ^= 1;
  std::swap(parity.corners[0], parity.corners[7]);
  EXPECT_EQ(rule_of(to_facelets(twisted)), CubeRule::twist);
  EXPECT_EQ(rule_of(to_facelets(flipped)), CubeRule::flip);
  EXPECT_EQ(rule_of(to_facelets(parity)), CubeRule::parity);
  Cube twice;
  twice.edges[0] = twice.edges[6] = 2 * 3;  // counts are wrong as well: colours are counted first
  EXPECT_EQ(rule_of(to_facelets(twice)), CubeRule::count);
}

TEST(Facelets, AreRefusedWithTheRuleInTheText) {
  try {
    static_cast<void>(cube_from_facelets(exchanged(kSolved, 4, 13)));
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, kBadCube);
    EXPECT_EQ(exit_status(e.fault().code), 2);
    EXPECT_EQ(std::string(e.what()), "the rule 'centre' is broken: the centre of face U is R");
  }
}

TEST(Facelets, MayHaveBlanksAndEndsOfLinesBetweenThem) {
  EXPECT_EQ(cube_from_facelets("UUUUUUUUU\nRRRRRRRRR\r\nFFF FFF FFF\tDDDDDDDDD LLLLLLLLL BBBBBBBBB\n"),
            Cube{});
}

TEST(Facelets, AreRefusedWithTheirNumberAndTheLetterThatIsWrong) {
  EXPECT_EQ(read_facelets(kSolved.substr(1)).text, "53 facelets instead of 54");
  EXPECT_EQ(read_facelets(kSolved + "x").text,
            "55 facelets instead of 54; number 55 is 'x', no letter of URFDLB");
  std::string facelets = kSolved;
  facelets[11] = 'W';
  EXPECT_EQ(read_facelets(facelets).text, "facelet R3, number 12, is 'W', no letter of URFDLB");
  facelets.replace(11, 1, "\u00d6");
  EXPECT_EQ(read_facelets(facelets).text, "facelet R3, number 12, is '\u00d6', no letter of URFDLB");
}

TEST(Facelets, OfAnyKindGiveACubeOrARule) {
  std::mt19937_64 random(4);
  int valid = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string facelets = to_facelets(random_cube(random));
    for (auto n = random() % 4; n > 0; --n) switch (random() % 3) {
        case 0:
          std::swap(facelets[random() % facelets.size()], facelets[random() % facelets.size()]);
          break;
        case 1:
          facelets[random() % facelets.size()] = static_cast<char>(random() % 256);
          break;
        default:
          facelets.resize(1 + random() % 60, 'U');
      }
    const FaceletReading reading = read_facelets(facelets);
    EXPECT_EQ(reading.cube.has_value(), reading.broken == CubeRule::none);
    EXPECT_EQ(reading.text.empty(), reading.broken == CubeRule::none);
    if (!reading.cube) continue;
    ++valid;
    EXPECT_EQ(to_facelets(*reading.cube), facelets);
    EXPECT_TRUE(is_reachable(*reading.cube));
  }
  EXPECT_GT(valid, 4000);
}

}  // namespace
}  // namespace mrroc::cube
