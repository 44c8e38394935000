// The marked points of fig. 16 and 17, and the scripts that draw them.
#include "tasks/rubik/plots.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mrroc::rubik {
namespace {

mp::ArmRow row(std::int64_t i, int m, Axis axis, double force) {
  mp::ArmRow r;
  r.i = i;
  r.t = 0.02 * static_cast<double>(i);
  r.m = m;
  r.F[axis] = force;
  return r;
}

/// Free motion with one spike, impact, settled at 4 N.
mp::ArmTrace approach() {
  mp::ArmTrace rows;
  for (int i = 0; i < 50; ++i) rows.push_back(row(i, 1, Axis::z, i == 10 ? 0.8 : i < 45 ? 0 : i - 44));
  for (int i = 50; i < 75; ++i) rows.push_back(row(i, 2, Axis::z, i < 55 ? 6 : 4.1));
  return rows;
}

/// A grasp without torque, breakaway at 3 N m, friction of 1.5 +- 0.4 N m, the opening.
mp::ArmTrace turning() {
  mp::ArmTrace rows;
  for (int i = 100; i < 120; ++i) rows.push_back(row(i, i < 110 ? 3 : 4, Axis::az, 0));
  for (int i = 120; i < 320; ++i) {
    const double friction = 1.5 + 0.4 * std::sin(0.04 * (i - 140));
    rows.push_back(row(i, 5, Axis::az, i < 135 ? 0.2 * (i - 119) : i < 140 ? 1.2 : friction));
  }
  for (int i = 320; i < 340; ++i) rows.push_back(row(i, 6, Axis::az, 0));
  return rows;
}

double place(const std::vector<Mark>& marks, char letter) {
  for (const Mark& m : marks)
    if (m.letter == letter) return m.t / 0.02;
  ADD_FAILURE() << "no " << letter;
  return -1;
}

TEST(RubikPlots, MarksImpactAndContactOfTheApproach) {
  const auto marks = marks_of_approach(approach());
  EXPECT_NEAR(place(marks, 'A'), 44, 1.01) << "not the spike before";
  EXPECT_NEAR(place(marks, 'B'), 55, 1e-9);
}

TEST(RubikPlots, MarksThePhasesOfATurn) {
  const auto marks = marks_of_turn(turning());
  std::string letters;
  for (const Mark& m : marks) letters += m.letter;
  EXPECT_EQ(letters, "ABCDEFGH");
  EXPECT_NEAR(place(marks, 'A'), 100, 1e-9);
  EXPECT_NEAR(place(marks, 'B'), 119, 1e-9);
  EXPECT_NEAR(place(marks, 'C'), 120, 1e-9);
  EXPECT_NEAR(place(marks, 'D'), 134, 1e-9) << "it breaks away";
  EXPECT_NEAR(place(marks, 'E'), 140 + M_PI / 2 / 0.04, 2);
  EXPECT_GT(place(marks, 'F'), place(marks, 'E'));
  EXPECT_NEAR(place(marks, 'G'), 319, 1e-9);
  EXPECT_NEAR(place(marks, 'H'), 339, 1e-9);
}

TEST(RubikPlots, MarksTheFirstQuarterOfAHalfTurn) {
  mp::ArmTrace rows = turning();
  const auto second = rows.begin() + 20;  // m = 5 once more, behind the seat on the way
  const mp::ArmTrace quarter(second, second + 200);
  rows.insert(second + 200, quarter.begin(), quarter.end());
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k].t = 0.02 * static_cast<double>(100 + k);
  const auto marks = marks_of_turn(rows, 2);
  EXPECT_NEAR(place(marks, 'D'), 134, 1e-9);
  EXPECT_NEAR(place(marks, 'E'), 140 + M_PI / 2 / 0.04, 2) << "not the second time that it breaks away";
  EXPECT_LT(place(marks, 'F'), 320);
  EXPECT_NEAR(place(marks, 'G'), 519, 1e-9);
}

TEST(RubikPlots, ShowsATurnThatWasDoneAndOfAQuarterIfThereIsOne) {
  RunRecord record;
  record.traces[0] = approach();
  record.traces[1] = turning();
  const auto drawn = [&] { return plots(record).size() == 3; };
  CycleRecord entry{
      .comes = Hand::postument, .leaves = Hand::track, .turn = Move(Face::U, 1), .begun = 1, .ended = 340};
  entry.given_up = true;
  record.execution_log.push_back(entry);
  EXPECT_FALSE(drawn()) << "the face jammed";
  entry = {
      .comes = Hand::postument, .leaves = Hand::track, .turn = Move(Face::U, 2), .begun = 1, .ended = 340};
  entry.done = true;
  record.execution_log.push_back(entry);
  EXPECT_TRUE(drawn());
  entry.turn = Move(Face::U, 3);
  entry.begun = 400;
  entry.ended = 500;
  record.execution_log.push_back(entry);
  EXPECT_EQ(plots(record).size(), 1u) << "the quarter, of which there are no rows";
}

TEST(RubikPlots, ARunWithoutATurnHasNoPictures) {
  RunRecord record;
  EXPECT_TRUE(plots(record).empty());
  record.execution_log.push_back(
      {.comes = Hand::track, .leaves = Hand::track, .turn = std::nullopt, .begun = 0, .ended = 10});
  EXPECT_TRUE(plots(record).empty());
}

TEST(RubikPlots, DrawsTheFirstTurnFromTheArmsTables) {
  RunRecord record;
  record.traces[0] = approach();
  record.traces[1] = turning();
  record.execution_log.push_back({.comes = Hand::postument,
                                  .leaves = Hand::track,
                                  .turn = Move(Face::U, 1),
                                  .begun = 1,
                                  .ended = 340,
                                  .done = true});
  const auto all = plots(record);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].first, "fig16_approach");
  EXPECT_NE(all[0].second.find("arm1.csv"), std::string::npos);
  EXPECT_EQ(all[1].first, "fig17_turn");
  EXPECT_NE(all[1].second.find("arm2.csv"), std::string::npos);
  EXPECT_NE(all[1].second.find("label 'H'"), std::string::npos);
  for (const auto& [name, script] : {all[0], all[1]})
    EXPECT_NE(script.find("set xlabel 'simulated time t [s]'"), std::string::npos) << name;
  EXPECT_NE(all[0].second.find("'A free motion ends, impact,  B the force has settled'"), std::string::npos);
  for (const char* words :
       {"A the grasp begins", "D the face breaks away", "H the jaws have opened", "'5 turn'", "turn U"})
    EXPECT_NE(all[1].second.find(words), std::string::npos) << words << "\n" << all[1].second;
  EXPECT_NE(all[1].second.find("set xrange [2:"), std::string::npos)
      << "the grasp begins in macrostep 100 of 20 ms";
  for (const char* words : {"force [N]", "torque [N m]", "set title"})
    EXPECT_NE(all[2].second.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace mrroc::rubik
