#include "tasks/ball/config.hpp"

#include <gtest/gtest.h>

#include "tasks/ball/grip.hpp"

namespace mrroc::ball {
namespace {

Config with(const std::vector<std::string>& settings) {
  Config c = Config::parse(std::string(config()), "ball.toml");
  for (const std::string& s : settings) c.set(s);
  return c;
}

TEST(BallConfig, HasTheOriginalsForceCircleAndTurn) {
  const Parameters k = read_parameters(with({}));
  EXPECT_EQ(k.force, 12.5);
  EXPECT_EQ(k.radius, 0.1);
  EXPECT_EQ(k.turn, 800);
  EXPECT_EQ(kPacing.n_s, 10);
}

TEST(BallConfig, RefusesExactlyWhatFrictionCannotHold) {
  const double most = most_load(12.5, 0.8, 1.3) / kGravity;
  EXPECT_NO_THROW(std::ignore = read_parameters(with({"free_body.mass=" + std::to_string(most - 0.01)})));
  try {
    std::ignore = read_parameters(with({"free_body.mass=" + std::to_string(most + 0.01)}));
    ADD_FAILURE() << "was not refused";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    EXPECT_NE(e.remedy().find("task.force=13"), std::string::npos) << e.remedy();
  }
  EXPECT_NO_THROW(std::ignore = read_parameters(
                      with({"free_body.mass=" + std::to_string(most + 0.01), "task.force=13"})));
}

TEST(BallConfig, AdvisesMoreForceOnlyWhereMoreIsPossible) {
  const auto remedy = [](const std::vector<std::string>& settings) {
    try {
      std::ignore = read_parameters(with(settings));
    } catch (const FaultError& e) {
      return std::string(e.remedy());
    }
    return std::string("was not refused");
  };
  EXPECT_EQ(remedy({"free_body.mass=9", "task.force=60", "task.most_force=100"}),
            "take a lighter or rougher object: task.force is 60 N at most");
  EXPECT_EQ(remedy({"free_body.mass=5"}).find("press with more by"), std::string::npos);
  EXPECT_NE(remedy({"free_body.mass=5"}).find("task.most_force"), std::string::npos);
}

TEST(BallConfig, RefusesAForceThatWouldCrush) {
  EXPECT_THROW(std::ignore = read_parameters(with({"task.force=25"})), FaultError);
}

TEST(BallConfig, HasNoHandUnlessItIsAskedFor) {
  EXPECT_FALSE(read_hand_push(with({})));
  const auto push = read_hand_push(with({"hand.arm=arm2", "hand.force=[1, 2, 3]"}));
  ASSERT_TRUE(push);
  EXPECT_EQ(push->arm, 1U);
  EXPECT_EQ(push->force, Vector3(1, 2, 3));
}

}  // namespace
}  // namespace mrroc::ball
