#include "tasks/visual_servo/config.hpp"

#include <gtest/gtest.h>

#include <fmt/core.h>

#include <functional>
#include <optional>
#include <tuple>

#include "base/representation.hpp"

#include "tasks/visual_servo/scenario.hpp"
#include "tasks/visual_servo/servo.hpp"
#include "test/base/random_pose.hpp"
#include "test/tasks/visual_servo/built_in.hpp"

namespace mrroc::visual_servo {
namespace {

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

TEST(ServoConfig, WithTheWallClockPicturesAreBelievedForLongUnlessTheUserSaysOtherwise) {
  Config config = built_in();
  const int longest = longest_age(read_parameters(built_in()));
  EXPECT_GT(longest, 2);
  believe_late_pictures(config);
  EXPECT_EQ(read_parameters(config).max_age, longest);
  Config given = built_in({"task.max_age=3"});
  believe_late_pictures(given);
  EXPECT_EQ(read_parameters(given).max_age, 3);
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
  EXPECT_THROW(std::ignore = settings_of({"none", "chessboard", "", ""}), FaultError);
}

TEST(ServoConfig, EveryNumberHasItsKeyItsDefaultAndItsBounds) {
  struct Number {
    const char* key;
    double least, most;
    std::function<double(const Parameters&)> value;
  };
  const std::vector<Number> numbers{
      {"regulator.gain", 0.01, 1, [](const Parameters& k) { return k.regulator.gain; }},
      {"regulator.angular_gain", 0.01, 1, [](const Parameters& k) { return k.regulator.angular_gain; }},
      {"regulator.quiet", 0.01, 1, [](const Parameters& k) { return k.regulator.quiet; }},
      {"regulator.significance", 0, 20, [](const Parameters& k) { return k.regulator.significance; }},
      {"regulator.speed", 0.001, 0.4, [](const Parameters& k) { return k.regulator.speed; }},
      {"regulator.angular_speed", 0.01, 1.5, [](const Parameters& k) { return k.regulator.angular_speed; }},
      {"regulator.top_speed", 0.001, 0.45, [](const Parameters& k) { return k.regulator.top_speed; }},
      {"regulator.top_angular_speed", 0.01, 1.8,
       [](const Parameters& k) { return k.regulator.top_angular_speed; }},
      {"regulator.acceleration", 0.1, 10, [](const Parameters& k) { return k.regulator.acceleration; }},
      {"regulator.angular_acceleration", 0.1, 40,
       [](const Parameters& k) { return k.regulator.angular_acceleration; }},
      {"track.acceleration", 1e-3, 10, [](const Parameters& k) { return k.track.acceleration; }},
      {"track.angular_acceleration", 1e-3, 30,
       [](const Parameters& k) { return k.track.angular_acceleration; }},
      {"track.speed", 0, 2, [](const Parameters& k) { return k.track.speed; }},
      {"track.angular_speed", 0, 5, [](const Parameters& k) { return k.track.angular_speed; }},
      {"track.significance", 0, 20, [](const Parameters& k) { return k.track.significance; }},
      {"track.jump", 1e-3, 1, [](const Parameters& k) { return k.track.jump; }},
      {"track.angular_jump", 0.01, 3, [](const Parameters& k) { return k.track.angular_jump; }},
      {"position_floor", 1e-6, 0.1, [](const Parameters& k) { return k.position_floor; }},
      {"angle_floor", 1e-6, 0.1, [](const Parameters& k) { return k.angle_floor; }}};
  const auto read = [&](const Number& n, double value) -> std::optional<Parameters> {
    try {
      return read_parameters(built_in({fmt::format("task.{}={:.8f}", n.key, value)}));
    } catch (const ConfigError&) {
      return std::nullopt;
    }
  };
  const Parameters usual = read_parameters(built_in());
  for (const Number& n : numbers) {
    for (const double bound : {n.least, n.most}) {
      const auto k = read(n, bound);
      ASSERT_TRUE(k) << n.key << " = " << bound;
      EXPECT_EQ(n.value(*k), bound) << n.key;
      for (const Number& other : numbers)
        if (other.key != n.key) {
          EXPECT_EQ(other.value(*k), other.value(usual)) << other.key << " by " << n.key;
        }
    }
    EXPECT_FALSE(read(n, n.least - 5e-7)) << n.key;
    EXPECT_FALSE(read(n, n.most + 5e-7)) << n.key;
  }
}

TEST(ServoConfig, TimesBecomeControlStepsAndWhatWasSeenTooLongAgoCannotBeBelieved) {
  EXPECT_EQ(read_parameters(built_in({"task.duration=0.1"})).duration, 2);
  EXPECT_EQ(read_parameters(built_in({"task.duration=3600"})).duration, 85'714);
  EXPECT_EQ(read_parameters(built_in({"task.timeout=0"})).timeout, 0);
  EXPECT_EQ(read_parameters(built_in({"task.timeout=4.2"})).timeout, 100);
  for (const char* bad : {"task.duration=0.09", "task.duration=3601", "task.timeout=-0.1",
                          "task.timeout=3601", "time.n_s=1", "time.n_s=33"})
    EXPECT_THROW((void)read_parameters(built_in({bad})), ConfigError) << bad;
  for (const auto& [n_s, n_Q] : {std::pair{2, 1}, {32, 31}}) {
    const Parameters k = read_parameters(built_in({fmt::format("time.n_s={}", n_s)}));
    EXPECT_EQ(k.pacing.n_s, n_s);
    EXPECT_EQ(k.pacing.n_Q, n_Q);
  }
  // 256 poses are kept; 21 of them are of the steps to come: 235 = 10 * 20 + 35.
  const std::vector<std::string> oldest{"task.max_age=10", "cameras.sac.period=20", "cameras.sac.latency=35"};
  EXPECT_EQ(read_parameters(built_in(oldest)).max_age, 10);
  std::vector<std::string> older = oldest;
  older.back() = "cameras.sac.latency=36";
  try {
    (void)read_parameters(built_in(older));
    ADD_FAILURE() << "one step too old";
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("max_age * period + latency must be at most 235 steps"),
              std::string::npos)
        << e.what();
  }
  older.emplace_back("cameras.order=[\"eih\"]");
  EXPECT_EQ(read_parameters(built_in(older)).max_age, 10) << "a camera that is not used has no say";
}

TEST(ServoConfig, OtherCamerasThanItsOwnAreRefusedByName) {
  const auto said = [](const std::string& setting) -> std::string {
    try {
      (void)read_parameters(built_in({setting}));
    } catch (const FaultError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(said("cameras.order=[]").find("the task needs a camera: sac, eih or both"), std::string::npos);
  EXPECT_NE(said("cameras.order=[\"sac\", \"roof\"]").find("cameras sac and eih, none called roof"),
            std::string::npos);
  EXPECT_NE(said("cameras.sac.mount=world").find("cameras.sac.mount: this task needs \"arm1.base\""),
            std::string::npos)
      << said("cameras.sac.mount=world");
  EXPECT_NE(said("cameras.eih.mount=world").find("cameras.eih.mount: this task needs \"arm1\""),
            std::string::npos);
}

TEST(ServoConfig, ChoicesAndFlagsAreRead) {
  for (const auto& [name, method] : {std::pair{"mean", Aggregation::mean},
                                     {"switching", Aggregation::switching},
                                     {"weights", Aggregation::weights}})
    EXPECT_EQ(read_parameters(built_in({std::string("task.aggregation=") + name})).aggregation, method);
  EXPECT_FALSE(read_parameters(built_in({"task.feed_forward=false"})).feed_forward);
  EXPECT_TRUE(read_parameters(built_in({"task.feed_forward=true"})).feed_forward);
  const Parameters k =
      read_parameters(built_in({"task.desired=[0.1, 0.2, 0.3, 0, 0, 0.5]", "task.track.memory=1"}));
  EXPECT_EQ(k.T_EGd.p, Vector3(0.1, 0.2, 0.3));
  EXPECT_NEAR(angle_axis_from_rotation(k.T_EGd.R).z(), 0.5, 1e-12);
  EXPECT_EQ(k.track.memory, 1);
  EXPECT_EQ(read_parameters(built_in({"task.track.memory=10000"})).track.memory, 10'000);
  for (const char* bad : {"task.track.memory=0", "task.track.memory=10001", "task.max_age=101"})
    EXPECT_THROW((void)read_parameters(built_in({bad})), ConfigError) << bad;
}

TEST(Scenarios, AreTheseSettings) {
  const auto settings = [](const char* name) {
    for (const Scenario& s : scenarios())
      if (s.name == name) return s.settings;
    return std::vector<std::string>{"none"};
  };
  using Settings = std::vector<std::string>;
  EXPECT_EQ(settings("rest"), Settings{});
  EXPECT_EQ(settings("hand"), (Settings{"object.motion=hand", "object.start=4", "task.duration=16"}));
  EXPECT_EQ(settings("line"), (Settings{"object.motion=line", "object.start=6", "object.speed=0.1",
                                        "object.length=0.35", "object.heading=1.5707963",
                                        "object.pose=[0.92, -0.17, 0.93, 0, 0, 0]", "task.duration=12"}));
  EXPECT_EQ(settings("circle"),
            (Settings{"object.motion=circle", "object.start=6", "object.speed=0.06", "object.radius=0.1",
                      "object.heading=1.5707963", "task.duration=14"}));
  EXPECT_EQ(settings("occluded"), (Settings{"object.hidden_from=4", "object.hidden_for=1"}));
  EXPECT_EQ(settings("absent"), (Settings{"object.absent_until=5", "task.duration=11"}));
  EXPECT_EQ(settings("wrong_board"), Settings{"task.timeout=3"});
}

TEST(Scenarios, OptionsComeBehindTheirSettings) {
  using Settings = std::vector<std::string>;
  EXPECT_EQ(settings_of({}), (Settings{"task.object=chessboard", "object.kind=chessboard"}));
  EXPECT_EQ(settings_of({"absent", "apriltag", "weights", "eih"}),
            (Settings{"task.object=apriltag", "object.kind=apriltag", "object.absent_until=5",
                      "task.duration=11", "task.aggregation=weights", "cameras.order=[\"eih\"]"}));
  EXPECT_EQ(settings_of({"wrong_board", "apriltag", "", "both"}),
            (Settings{"task.object=apriltag", "object.kind=apriltag", "task.timeout=3", "object.tag=7"}));
  EXPECT_EQ(settings_of({"wrong_board", "chessboard", "", "sac"}),
            (Settings{"task.object=chessboard", "object.kind=chessboard", "task.timeout=3",
                      "object.kind=wrong_board", "cameras.order=[\"sac\"]"}));
}

}  // namespace
}  // namespace mrroc::visual_servo
