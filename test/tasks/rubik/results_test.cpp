// From what a run has left to figures of its turns.
#include "tasks/rubik/results.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

#include "base/cube/facelets.hpp"
#include "base/representation.hpp"
#include "tasks/rubik/turn/tables.hpp"
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
    record_.execution_log.push_back({.turn = parse_moves("U").front(),
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
  record_.execution_log.push_back(
      {.turn = parse_moves("R").front(), .begun = 300, .ended = 310, .grips = 1, .attempts = 3});
  const auto figures = figures_of(record_, cube_, turns_of(record_, cube_));
  EXPECT_EQ(std::get<double>(figures.at("moves")), 1);
  EXPECT_EQ(std::get<double>(figures.at("retries")), 2);
}

mp::ArmRow row_of(std::int64_t i, int m, const Wrench& F) {
  mp::ArmRow row;
  row.i = i;
  row.t = 0.02 * static_cast<double>(i);
  row.m = m;
  row.F = F;
  return row;
}

/// Five cycles: a turn of F at once, a re-grasp with two grips, a turn that jammed, one that was never tried.
class RubikFigures : public RubikResults {
 protected:
  RubikFigures() {
    auto& track = record_.traces[index(Hand::track)];
    auto& postument = record_.traces[index(Hand::postument)];
    for (int i = 100; i < 200; ++i) {
      track.push_back(row_of(i, i < 150 ? 5 : 6,
                             {{i == 120 ? -7. : 1., i == 121 ? 9. : 2., 3, 50, 60, i == 122 ? -2.5 : 0.5}}));
      postument.push_back(row_of(i,
                                 i < 110   ? 1
                                 : i < 140 ? 2
                                           : 4,
                                 {{0, 0,
                                   i == 105  ? -12.
                                   : i < 120 ? 8.
                                             : 5.,
                                   0, 0, 0}}));
    }
    say_all(100, 0, {0, 0, 0}, 10);
    say_all(110, 0.2, {0.001, 0, 0}, 30);
    say_all(130, 0.02, {0.001, 0.002, 0}, 20);
    record_.execution_log.push_back({.comes = Hand::postument,
                                     .leaves = Hand::track,
                                     .turn = parse_moves("F").front(),
                                     .begun = 100,
                                     .ended = 160,
                                     .turn_begun = 100,
                                     .turn_ended = 140,
                                     .grips = 1,
                                     .attempts = 1,
                                     .done = true,
                                     .tool = 91 * kDegree});
    record_.execution_log.push_back({.comes = Hand::track,
                                     .leaves = Hand::postument,
                                     .turn = {},
                                     .begun = 300,
                                     .ended = 320,
                                     .grips = 2});
    record_.execution_log.push_back({.turn = parse_moves("R'").front(),
                                     .begun = 400,
                                     .ended = 410,
                                     .grips = 1,
                                     .attempts = 3,
                                     .given_up = true,
                                     .tool = -0.2});
    record_.execution_log.push_back({.turn = {}, .begun = 500, .ended = 510, .grips = 0});
    record_.turning = 1000;
  }
  void say_all(int i, double angle, const Vector3& in_hand, double squeeze, const Cube& cube = {}) {
    cube_truth_t m{};
    std::ranges::copy(to_facelets(cube), m.facelets);
    m.angle[0] = 0.001;
    m.angle[1] = -angle;
    for (int k = 0; k < 3; ++k) {
      m.T_UC[5 * k] = 1;
      m.T_UC[4 * k + 3] = k + 1;
      m.in_hand[index(Hand::track)][k] = in_hand[k];
      m.in_hand[index(Hand::postument)][k] = 100 + k;
    }
    m.squeeze = squeeze;
    m.on_floor = i == 130;
    out_.publish(m, i);
    cube_.collect();
  }
  double figure(const std::string& key) {
    const auto figures = figures_of(record_, cube_, turns_of(record_, cube_));
    const auto found = figures.find(key);
    return found == figures.end() ? -1 : std::get<double>(found->second);
  }
};

TEST_F(RubikFigures, ATurnIsDoneAtTheFirstTryWhenNeitherItNorAGripBeforeItWasTriedAgain) {
  const auto share = [this](const ExecutionLog& log) {
    record_.execution_log = log;
    return figure("first_try_share");
  };
  const Move R = parse_moves("R").front();
  const CycleRecord good{.turn = R, .grips = 1, .attempts = 1, .done = true};
  const CycleRecord shown{};
  CycleRecord again = good, twice = good, jammed = good, regrasp, regrasped;
  again.attempts = 2;
  regrasp.grips = 1;
  regrasped.grips = 2;
  twice.grips = 2;
  jammed.done = false;
  EXPECT_EQ(share({}), -1) << "nothing was turned";
  EXPECT_EQ(share({shown, regrasp, good}), 1);
  for (const CycleRecord& other : {again, twice, jammed}) EXPECT_EQ(share({good, other}), 0.5);
  EXPECT_EQ(share({regrasped, good, good}), 0.5) << "a grip counts for the turn that follows";
}

TEST_F(RubikFigures, ATurnHasItsTimesItsForcesAndWhatTheCubeDidMeanwhile) {
  const auto turns = turns_of(record_, cube_);
  ASSERT_EQ(turns.size(), 2U);
  const TurnRow& t = turns[0];
  EXPECT_EQ(t.k, 1);
  EXPECT_EQ(turns[1].k, 2);
  EXPECT_EQ(to_string(t.turn), "F");
  EXPECT_NEAR(t.t_start, 2, 1e-12);
  EXPECT_NEAR(t.t_end, 3.2, 1e-12);
  EXPECT_EQ(t.attempts, 1);
  EXPECT_EQ(turns[1].attempts, 3);
  EXPECT_NEAR(t.tool_deg, 91, 1e-9);
  EXPECT_EQ(t.force_peak_N, 9) << "of x, y and z, whatever its sign";
  EXPECT_EQ(t.torque_peak_Nm, 2.5) << "about z alone";
  EXPECT_NEAR(t.force_std_N, std::sqrt((49. + 49) / 50 - std::pow((-7 + 49.) / 50, 2)), 1e-9) << "that of x";
  EXPECT_NEAR(t.slip_mm, std::hypot(1., 2.), 1e-9);
  EXPECT_EQ(turns[1].force_peak_N, 0) << "it has no rows";
}

TEST_F(RubikFigures, AFaceThatTheToolOnlySlippedOverIsWhereItWas) {
  EXPECT_NEAR(turns_of(record_, cube_)[0].face_deg, 0.02 / kDegree, 1e-9) << "towards the tool";
  say_all(135, 0.02, {0, 0, 0}, 0, after(Cube{}, parse_moves("F")));
  EXPECT_NEAR(turns_of(record_, cube_)[0].face_deg, 90 - 0.02 / kDegree, 1e-9);
  record_.execution_log[0].tool = -record_.execution_log[0].tool;
  EXPECT_NEAR(turns_of(record_, cube_)[0].face_deg, -90 + 0.02 / kDegree, 1e-9);
}

TEST_F(RubikFigures, AreCountedOverTheCycles) {
  EXPECT_EQ(figure("moves"), 1);
  EXPECT_EQ(figure("regrasps"), 1) << "a cycle without a grip is none";
  EXPECT_EQ(figure("retries"), 1 + 2 + 1)
      << "a second grip, two more attempts, and the way round that was given up";
  EXPECT_EQ(figure("other_way"), 1);
  EXPECT_NEAR(figure("approach_settled_N"), 5, 1e-12) << "the last quarter of a second";
  EXPECT_EQ(figure("approach_peak_N"), 12);
  EXPECT_EQ(figure("turn_lateral_peak_N"), 9);
  EXPECT_EQ(figure("turn_torque_peak_Nm"), 2.5);
  EXPECT_NEAR(figure("turn_slip_mm"), std::hypot(1., 2.), 1e-9);
  EXPECT_GT(figure("turn_lateral_std_N"), 0);
  EXPECT_EQ(figure("sim_s_per_turn"), -1) << "one turn has no mean";
  CycleRecord turned;
  turned.done = true;
  record_.execution_log.insert(record_.execution_log.end(), 4, turned);
  EXPECT_NEAR(figure("sim_s_per_turn"), 4, 1e-12);
  EXPECT_EQ(figure("squeeze_N"), 30);
  EXPECT_EQ(figure("solved"), 1);
  EXPECT_EQ(figure("verified"), -1) << "nobody has looked";
  record_.verified = false;
  EXPECT_EQ(figure("verified"), 0);
  record_.verified = true;
  EXPECT_EQ(figure("verified"), 1);
  say_all(140, 0, {0, 0, 0}, 5, after(Cube{}, parse_moves("U")));
  EXPECT_EQ(figure("solved"), 0);
  EXPECT_EQ(figure("squeeze_N"), 30);
  record_.execution_log.resize(0);
  EXPECT_EQ(figure("approach_peak_N"), -1);
  EXPECT_EQ(figure("turn_slip_mm"), -1);
  EXPECT_EQ(figure("moves"), 0);
}

TEST_F(RubikFigures, TheRecordOfTheCubeHasEveryMacrostepOfWhichAMessageCame) {
  const auto& rows = cube_.rows();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[1].i, 110);
  EXPECT_EQ(rows[1].T_UC.p, Vector3(1, 2, 3));
  EXPECT_EQ(rows[1].T_UC.R, Matrix3::Identity());
  EXPECT_EQ(rows[1].in_hand[index(Hand::track)].x(), 0.001);
  EXPECT_EQ(rows[1].in_hand[index(Hand::postument)], Vector3(100, 101, 102));
  EXPECT_EQ(rows[1].facelets, to_facelets(Cube{}));
  EXPECT_EQ(rows[1].angle, -0.2) << "of the layer that is farther off";
  EXPECT_EQ(rows[0].angle, 0.001);
  EXPECT_EQ(rows[1].squeeze, 30);
  EXPECT_FALSE(rows[1].on_floor);
  EXPECT_TRUE(rows[2].on_floor);
  EXPECT_EQ(cube_.at(99), nullptr);
  EXPECT_EQ(cube_.at(100)->i, 100);
  EXPECT_EQ(cube_.at(129)->i, 110);
  EXPECT_EQ(cube_.at(1000)->i, 130);
}

TEST_F(RubikFigures, AreWrittenWithTheirTables) {
  std::string pattern = (std::filesystem::temp_directory_path() / "rubik_results.XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  const auto text_of = [&](const char* name) -> std::string {
    std::ifstream in(folder / name);
    return {std::istreambuf_iterator<char>(in), {}};
  };
  say_all(140, 0, {0, 0, 0}, 5, after(Cube{}, parse_moves("U")));
  const auto figures = write_results(folder, record_, cube_);
  EXPECT_EQ(std::get<double>(figures.at("moves")), 1);
  EXPECT_EQ(text_of("cube_start.txt"), to_facelets(Cube{}) + "\n");
  EXPECT_EQ(text_of("cube_end.txt"), to_facelets(after(Cube{}, parse_moves("U"))) + "\n");
  EXPECT_EQ(text_of("cube_read.txt"), "") << "nothing was read";
  const std::string moves = text_of("moves.csv");
  EXPECT_TRUE(
      moves.starts_with("k,turn,t_start,t_end,attempts,tool_deg,face_deg,behind_deg,slip_mm,force_peak_N,"
                        "torque_peak_Nm,force_std_N\n1,F,2.00,3.20,1,91.00,"))
      << moves;
  EXPECT_NE(moves.find("\n2,R',8.00,8.20,3,-11.46,"), std::string::npos) << moves;
  record_.readings.resize(3);
  record_.readings[0].facelets = "first";
  record_.readings[1].facelets = "second";
  record_.readings[2].facelets = "third";
  static_cast<void>(write_results(folder, record_, cube_));
  EXPECT_EQ(text_of("cube_read.txt"), "third\n") << "none was a cube";
  record_.readings[1].cube = Cube{};
  static_cast<void>(write_results(folder, record_, cube_));
  EXPECT_EQ(text_of("cube_read.txt"), "second\n");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace mrroc::rubik
