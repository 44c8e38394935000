// From what a run has left to figures of its turns.
#include "tasks/rubik/results.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/representation.hpp"
#include "tasks/rubik/cube/facelets.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kBegin = 100;  // macrostep of m = 5

class RubikResults : public testing::Test {
 protected:
  /// The tool turns by a degree per macrostep to 91 degrees, the face comes after it until its seat draws it in.
  /// @param behind  of the face [deg] @param drawn  from the seat, where it jumps there [deg]
  void turn(double behind, double drawn) {
    for (int degree = 0; degree <= 91; ++degree) {
      const int i = kBegin + degree;
      mp::ArmRow row;
      row.i = i + 1;
      row.m = 5;
      row.pose = angle_axis_from_pose({rotation_from_angle_axis({0, 0, degree * kDegree}), {0.1, 0.2, 0.3}});
      record_.traces[index(Hand::track)].push_back(row);
      const double face = std::max(0., degree - behind);
      const double from_seat = face < 45 ? face : 90 - face;
      say(i, face >= 45 && from_seat < drawn ? 0 : from_seat * kDegree);
    }
    record_.journal.push_back({.turn = parse_moves("U").front(),
                               .begun = kBegin,
                               .ended = kBegin + 95,
                               .turn_begun = kBegin,
                               .turn_ended = kBegin + 91,
                               .grips = 1,
                               .attempts = 1,
                               .done = true,
                               .tool = 91 * kDegree});
  }

  void say(int i, double angle) {
    cube_truth_t m{};
    std::ranges::copy(to_facelets(Cube{}), m.facelets);
    m.angle[0] = angle;
    for (int k = 0; k < 3; ++k) m.T_UC[5 * k] = 1;
    out_.publish(m, i);
    cube_.collect();
  }

  link::test::DirectBus bus_;
  link::Process process_{bus_, {.session = "s", .session_id = 1, .name = "mp", .roster = {"mp"}}};
  link::Outbox<cube_truth_t> out_{bus_, {link::Group::agents, "s.cube.truth"}, 1};
  CubeRecord cube_{process_};
  RunRecord record_;
};

TEST_F(RubikResults, AFaceIsBehindItsToolUntilTheSeatDrawsItIn) {
  turn(1.5, 3.5);
  const auto turns = turns_of(record_, cube_);
  ASSERT_EQ(turns.size(), 1u);
  EXPECT_NEAR(turns[0].behind_deg, 1.5, 1e-6)
      << "not the difference in the seat, where the tool is still on its way";
  EXPECT_NEAR(std::get<double>(figures_of(record_, cube_, turns).at("turn_angle_err_deg")), 1.5, 1e-6);
}

TEST_F(RubikResults, OnlyTurnsThatAreDoneAreMoves) {
  turn(1, 3.5);
  record_.journal.push_back(
      {.turn = parse_moves("R").front(), .begun = 300, .ended = 310, .grips = 1, .attempts = 3});
  const auto figures = figures_of(record_, cube_, turns_of(record_, cube_));
  EXPECT_EQ(std::get<double>(figures.at("moves")), 1);
  EXPECT_EQ(std::get<double>(figures.at("retries")), 2);
}

}  // namespace
}  // namespace mrroc::rubik
