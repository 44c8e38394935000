#include "tasks/calibrate_cell/cell/view_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/cell/believed_arm.hpp"
#include "tasks/calibrate_cell/cell/by_board.hpp"
#include "tasks/calibrate_cell/cell/findings.hpp"
#include "tasks/calibrate_cell/vocabulary.hpp"

namespace mrroc::calibrate_cell {
namespace {

constexpr std::size_t kViews = 20;

Config cell() { return Config::parse(config(), "calibrate_cell.toml"); }

AxisVector vector(const std::vector<double>& q) {
  return Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
}

TEST(ViewPlan, ShowsTheWholeBoardInEveryPose) {
  const Config c = cell();
  const BelievedSight sight = read_sight(c);
  const BelievedArm camera_arm = read_arm(c, kCameraArm), board_arm = read_arm(c, kBoardArm);
  const ViewPlan camera = plan_views(c, kCameraArm, kViews), board = plan_views(c, kBoardArm, kViews);
  const auto check = [&](const CameraSetup& k, const Pose& T_UC, const std::vector<double>& q) {
    EXPECT_TRUE(in_sight(k.model, sight.board, T_UC.inverse() * board_arm.at(vector(q)) * sight.T_EG));
  };
  ASSERT_EQ(board.at(0).joints.size(), kViews);
  ASSERT_EQ(camera.at(0).joints.size(), kViews);
  ASSERT_EQ(board.at(1).joints.size(), kViews);
  for (const auto& q : board[0].joints)
    check(*sight.in_hand, camera_arm.at(vector(camera[0].from)) * sight.in_hand->place, q);
  for (const auto& q : camera[0].joints)
    check(*sight.in_hand, camera_arm.at(vector(q)) * sight.in_hand->place, board[0].from);
  for (const auto& q : board[1].joints) check(sight.fixed.at(0), camera_arm.T_UB * sight.fixed[0].place, q);
}

TEST(ViewPlan, WhatCannotBeSeenOrReachedIsRefused) {
  Config other_hand = cell();
  other_hand.set("cameras.eih.mount=arm2");
  EXPECT_THROW(static_cast<void>(read_sight(other_hand)), FaultError);
  Config on_floor = cell();
  on_floor.set("object.in_hand=false");
  EXPECT_THROW(static_cast<void>(read_sight(on_floor)), FaultError);
  Config far = cell();
  far.set("task.board_stand=[3, 1, 1]");
  EXPECT_THROW(plan_views(far, kBoardArm, kViews), FaultError);
  Config high = cell();
  high.set("cameras.sac.pose=[0.75, 0.3, 7, 3.14, 0, 0]");
  EXPECT_THROW(plan_views(high, kBoardArm, kViews), FaultError);
}

TEST(Turns, GoToTheLowestNumberWhenEveryArmWaits) {
  std::vector<Report> agents(kArms);
  std::vector<Order> orders(kArms);
  const auto allowed = [&](int first, int second) {
    agents[0].event = first;
    agents[1].event = second;
    take_turns(agents, orders);
    return std::array<int, kArms>{orders[0].variant, orders[1].variant};
  };
  using Numbers = std::array<int, kArms>;
  EXPECT_EQ(allowed(2, 0), (Numbers{0, 0})) << "one is not there yet";
  EXPECT_EQ(allowed(2, 1), (Numbers{0, 1}));
  EXPECT_EQ(allowed(2, 4), (Numbers{2, 0}));
  EXPECT_EQ(allowed(kWorkDone, 8), (Numbers{0, 8}));
}

/// Arms that held still for pictures, and what receptors have told; cameras, board and bases are elsewhere than believed.
class ByBoardTest : public testing::Test {
 protected:
  static Pose displaced(const Pose& T, double m, double rad) {
    return T * Pose{rotation_from_angle_axis({rad, -rad, rad}), {m, -m, m}};
  }
  void SetUp() override {
    for (std::size_t arm = 0; arm < kArms; ++arm) {
      plans_[arm] = plan_views(config_, arm, kViews);
      arms_[arm] = read_arm(config_, arm);
    }
    T_UB_ = {arms_[0].T_UB, displaced(arms_[1].T_UB, 0.003, 0.004)};
    T_EC_ = displaced(sight_.in_hand->place, 0.002, 0.008);
    T_1C_ = displaced(sight_.fixed[0].place, -0.002, 0.005);
    T_EG_ = displaced(sight_.T_EG, 0.003, 0.01);
    records_ = {{*sight_.in_hand, {}}, {sight_.fixed[0], {}}};
    stand(Turn::show, kBoardArm, plans_[kBoardArm][0].joints);
    stand(Turn::look, kCameraArm, plans_[kCameraArm][0].joints);
    stand(Turn::present, kBoardArm, plans_[kBoardArm][1].joints);
  }
  void stand(Turn turn, std::size_t moving, const std::vector<std::vector<double>>& poses) {
    for (const auto& q : poses) {
      Still s{.turn = turn, .from = time_, .to = time_ + 0.2, .T_0E = {}};
      for (std::size_t arm = 0; arm < kArms; ++arm)
        s.T_0E[arm] =
            arms_[arm].T_UB.inverse() * arms_[arm].at(vector(arm == moving ? q : plans_[arm][0].from));
      const Pose T_UG = T_UB_[kBoardArm] * s.T_0E[kBoardArm] * T_EG_;
      see(records_[0], T_UB_[kCameraArm] * s.T_0E[kCameraArm] * T_EC_, T_UG);
      see(records_[1], T_UB_[0] * T_1C_, T_UG);
      stills_.push_back(s);
      time_ += 1;
    }
  }
  void see(CameraRecord& record, const Pose& T_UC, const Pose& T_UG) const {
    CameraReading reading;
    reading.t = time_ + 0.1;
    reading.T_CG = T_UC.inverse() * T_UG;
    reading.seen = in_sight(record.camera.model, sight_.board, reading.T_CG);
    record.readings.push_back(to_message(reading));
  }

  Config config_ = cell();
  BelievedSight sight_ = read_sight(config_);
  std::array<BelievedArm, kArms> arms_;
  std::array<ViewPlan, kArms> plans_;
  std::array<Pose, kArms> T_UB_;
  Pose T_EC_, T_1C_, T_EG_;
  std::vector<CameraRecord> records_;
  std::vector<Still> stills_;
  double time_{};
};

TEST_F(ByBoardTest, BasesAndCamerasAreFoundFromPosesOfTheBoard) {
  const ByBoard found = find_by_board(sight_, stills_, records_, {}, believed_bases(config_));
  ASSERT_TRUE(found.T_12);
  EXPECT_LT(distance(*found.T_12, T_UB_[0].inverse() * T_UB_[1]).mm, 1e-3);
  EXPECT_LT(distance(found.T_EG, T_EG_).mm, 1e-3);
  ASSERT_EQ(found.cameras.size(), 2U);
  EXPECT_LT(distance(found.cameras[0].place, T_EC_).mm, 1e-3);
  EXPECT_LT(distance(found.cameras[0].place, T_EC_).deg, 1e-3);
  EXPECT_LT(distance(found.cameras[1].place, T_1C_).mm, 1e-2);
  EXPECT_LT(distance(found.cameras[1].place, T_1C_).deg, 1e-3);
}

TEST_F(ByBoardTest, PicturesWithoutABoardAreLeftOutAndCounted) {
  for (std::size_t k = 0; k < 5; ++k) records_[0].readings[k].seen = 0;
  const ByBoard found = find_by_board(sight_, stills_, records_, {}, believed_bases(config_));
  EXPECT_EQ(found.cameras[0].stills, 2 * kViews);
  EXPECT_GE(found.cameras[0].stills - found.cameras[0].seen, 5U);
  EXPECT_LT(distance(*found.T_12, T_UB_[0].inverse() * T_UB_[1]).mm, 1e-3);
}

TEST_F(ByBoardTest, TooFewPicturesAreAFaultThatSaysOfWhichCamera) {
  for (camera_reading_t& m : records_[1].readings) m.seen = 0;
  try {
    static_cast<void>(find_by_board(sight_, stills_, records_, {}, believed_bases(config_)));
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, kBoardNotSeen);
    EXPECT_NE(std::string(e.what()).find("sac"), std::string::npos) << e.what();
  }
}

TEST_F(ByBoardTest, WaysThatDisagreeAreSaidToDoSo) {
  Findings f;
  f.pictured = find_by_board(sight_, stills_, records_, {}, believed_bases(config_));
  EXPECT_NE(describe_ways(f).find("alone"), std::string::npos);
  SetsFit touched{.sets = {}, .names = {}, .found = Calibration{}};
  touched.found->T_12.T_AB = *f.by_pictures();
  touched.found->T_12.T_AB.p.y() += 0.0005;
  f.touched = SetsVerdict{.fits = {touched}, .chosen = 0, .told_apart = true};
  EXPECT_EQ(describe_ways(f).find("DISAGREE"), std::string::npos);
  f.touched->fits[0].found->T_12.T_AB.p.y() += 0.0015;
  EXPECT_NE(describe_ways(f).find("DISAGREE"), std::string::npos);
  EXPECT_EQ(f.T_12()->p, f.touched->fits[0].found->T_12.T_AB.p) << "touching is believed";
}

}  // namespace
}  // namespace mrroc::calibrate_cell
