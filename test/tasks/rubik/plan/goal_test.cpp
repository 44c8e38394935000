// Grouping of turns keeps what they do.
#include "tasks/rubik/plan/goal.hpp"

#include <gtest/gtest.h>

namespace mrroc::rubik {
namespace {

Moves flattened(const std::vector<TurnGroup>& groups, bool reversed) {
  Moves moves;
  for (TurnGroup group : groups) {
    if (reversed) std::swap(group.moves.front(), group.moves.back());
    moves.insert(moves.end(), group.moves.begin(), group.moves.end());
  }
  return moves;
}

std::string text(std::string_view moves) { return to_string(flattened(grouped(parse_moves(moves)), false)); }

TEST(PlanGoal, GroupsDoWhatTheTurnsDoInEitherOrder) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 200; ++n) {
    Moves moves;
    for (int k = 0; k < 25; ++k) moves.emplace_back(static_cast<int>(random() % kMoves));
    const auto groups = grouped(moves);
    EXPECT_EQ(after({}, flattened(groups, false)), after({}, moves));
    EXPECT_EQ(after({}, flattened(groups, true)), after({}, moves));
    for (std::size_t g = 0; g < groups.size(); ++g) {
      ASSERT_TRUE(groups[g].moves.size() == 1 || groups[g].moves.size() == 2);
      if (groups[g].moves.size() == 2) {
        EXPECT_EQ(groups[g].moves[0].face(), opposite(groups[g].moves[1].face()));
      }
      if (g > 0) {
        EXPECT_NE(number(groups[g].moves[0].face()) % 3, number(groups[g - 1].moves[0].face()) % 3);
      }
    }
  }
}

TEST(PlanGoal, TakesTurnsOfOneFaceTogether) {
  EXPECT_EQ(text("U U"), "U2");
  EXPECT_EQ(text("U D U"), "U2 D");
  EXPECT_EQ(text("U D U'"), "D");
  EXPECT_EQ(text("R U U' R"), "R2");
  EXPECT_EQ(text("R U D D' U' R'"), "");
  EXPECT_EQ(text("R U R'"), "R U R'");
}

}  // namespace
}  // namespace mrroc::rubik
