#include "tasks/visual_servo/config.hpp"

#include <gtest/gtest.h>

#include "tasks/visual_servo/scenario.hpp"
#include "test/base/random_pose.hpp"

namespace mrroc::visual_servo {
namespace {

Config built_in(const std::vector<std::string>& settings = {}) {
  Config c = Config::parse(config(), "visual_servo.toml");
  for (const std::string& s : settings) c.set(s);
  return c;
}

TEST(ServoConfig, KnowsTheCamerasAsTheWorldDoes) {
  const Parameters k = read_parameters(
      built_in({"cameras.sac.pose=[1, 2, 3, 0, 0, 0]", "cameras.eih.latency=33", "cameras.order=[\"eih\"]"}));
  EXPECT_EQ(k.camera[0].place.p, Vector3(1, 2, 3));
  EXPECT_EQ(k.camera[1].latency, 33);
  EXPECT_FALSE(k.camera[0].used);
  EXPECT_TRUE(k.camera[1].used);
  EXPECT_EQ(k.pacing.n_s, 21);
  EXPECT_EQ(k.pacing.n_Q, 20);
  EXPECT_EQ(k.duration, 190) << "8 s of control steps of 42 ms";
}

TEST(ServoConfig, RefusesACameraWhoseMountIsOfNoUse) {
  for (const char* bad : {"cameras.sac.mount=world", "cameras.sac.mount=arm1", "cameras.eih.mount=arm1.base",
                          "cameras.eih.mount=arm2"})
    EXPECT_THROW((void)read_parameters(built_in({bad})), FaultError) << bad;
}

TEST(ServoConfig, RefusesWhatMakesNoSense) {
  for (const char* bad :
       {"task.regulator.gain=0", "task.regulator.gain=1.5", "task.aggregation=median", "task.duration=-1",
        "task.max_age=-1", "task.max_age=11", "task.desired=[1, 2]", "time.n_s=40"})
    EXPECT_THROW((void)read_parameters(built_in({bad})), ConfigError) << bad;
}

TEST(ServoConfig, NamesTheChannelsOfWhatIsLookedAt) {
  using Channels = std::array<std::string, kCameras>;
  EXPECT_EQ(reading_channels(read_object(built_in())), (Channels{"sac.board", "eih.board"}));
  EXPECT_EQ(reading_channels(read_object(built_in({"task.object=apriltag"}))),
            (Channels{"sac.tag", "eih.tag"}));
}

TEST(Scenarios, AllCanBeReadWithEveryObject) {
  std::set<std::string_view> names;
  for (const Scenario& s : scenarios()) {
    names.insert(s.name);
    for (const char* object : {"chessboard", "apriltag"}) {
      const auto settings = settings_of({std::string(s.name), object, "weights", "sac"});
      const Parameters k = read_parameters(built_in(settings));
      EXPECT_EQ(k.aggregation, Aggregation::weights);
      EXPECT_FALSE(k.camera[1].used);
    }
  }
  for (const char* name : {"rest", "hand", "line", "circle", "occluded", "absent", "wrong_board"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Scenarios, LeaveTheConfigurationsChoicesAloneUnlessAsked) {
  const auto settings = settings_of({});
  EXPECT_EQ(read_parameters(built_in(settings)).aggregation, Aggregation::mean);
  EXPECT_THROW(settings_of({"none", "chessboard", "", ""}), FaultError);
}

}  // namespace
}  // namespace mrroc::visual_servo
