#include "tasks/move/plan.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/representation.hpp"
#include "test/tasks/move/straight_arm.hpp"

namespace mrroc::any_motion {
namespace {

std::string one(const std::string& keys) { return "[arm1]\norder = [\"a\"]\n[arm1.a]\n" + keys; }

PlannedMotion planned(const std::string& keys) { return plan_of_text(one(keys)).arms[0].motions[0]; }

std::string refusal(const std::string& keys) {
  try {
    std::ignore = planned(keys);
  } catch (const FaultError& e) {
    return e.what();
  }
  return "";
}

const std::vector<std::string> kMotions{"generator = \"trapezoid\"",
                                        "generator = \"trapezoid\"\npass = true",
                                        "generator = \"polyline\"\npass = true",
                                        "generator = \"linear\"",
                                        "generator = \"cubic\"",
                                        "generator = \"quintic\"",
                                        "generator = \"nurbs\"\ndegree = 2",
                                        "generator = \"cubic\"\ntimes = [2.0, 5.0]"};
const std::vector<std::string> kSpaces{"space = \"joints\"", "space = \"xyz_angle_axis\"",
                                       "space = \"xyz_euler_zyz\"",
                                       "space = \"xyz_angle_axis\"\ninterpolation = \"tcim\""};
const std::string kTwo = "positions = [0.2, 0.1, 0.1, 0.1, 0.3, 0.2,  0.1, 0.3, -0.1, 0.2, 0.4, 0]\n";

TEST(MovePlan, EveryGeneratorBeginsAtTheStartAndEndsInItsLastPositionWithinItsShares) {
  for (const std::string& motion : kMotions)
    for (const std::string& space : kSpaces) {
      SCOPED_TRACE(motion + ", " + space);
      const PlannedMotion m = planned(motion + "\n" + space + "\n" + kTwo);
      ASSERT_EQ(m.poses.size(), static_cast<std::size_t>(m.path.macrosteps()) + 1);
      EXPECT_LT(m.poses.front().p.norm(), 1e-9);
      const ecp::Coordinates end = m.spec.positions.back();
      const Pose there =
          pose_from_numbers(
              m.spec.space == Representation::joints ? Representation::xyz_angle_axis : m.spec.space,
              numbers_from_axes(end))
              .value();
      EXPECT_LT((m.poses.back().p - there.p).norm(), 1e-9);
      EXPECT_LT((m.poses.back().R - there.R).norm(), 1e-9);
      EXPECT_LE(largest(m.rates.velocity), 1);
      EXPECT_LE(largest(m.rates.acceleration), 1);
      EXPECT_GT(m.path.macrosteps(), 10);
      if (m.spec.times.empty() && m.spec.generator != Generator::trapezoid &&
          m.spec.generator != Generator::polyline) {
        EXPECT_LE(largest(m.rates.velocity), 0.15 + 1e-9) << "the usual share";
        EXPECT_LE(largest(m.rates.acceleration), 0.02 + 1e-9);
        EXPECT_GT(std::max(largest(m.rates.velocity) / 0.15, largest(m.rates.acceleration) / 0.02), 0.8)
            << "no slower than it must";
      }
    }
}

TEST(MovePlan, RelativePositionsAddUpAndAreSentAsIncrements) {
  const PlannedMotion m = planned(
      "space = \"xyz_angle_axis\"\nreference = \"relative\"\n"
      "positions = [0.1, 0, 0, 0, 0, 1.5707963267948966,  0.1, 0, 0, 0, 0, 0]\n");
  EXPECT_LT((m.poses.back().p - Vector3(0.1, 0.1, 0)).norm(), 1e-9)
      << "the second one is seen from the turned tool";
  Pose T;
  for (std::int64_t k = 0; k < m.path.macrosteps(); ++k) {
    const ArmCommand command = m.command(k);
    ASSERT_EQ(command.reference, Reference::relative);
    T = T * pose_from_numbers(command.representation, command.pose).value();
  }
  EXPECT_LT((T.p - m.poses.back().p).norm(), 1e-9);
}

TEST(MovePlan, CommandsAreInTheRepresentationOfTheFile) {
  const std::string matrix = "positions = [1, 0, 0, 0.2,  0, 1, 0, 0,  0, 0, 1, 0,  0, 0, 0, 1]\n";
  const PlannedMotion frame = planned("space = \"frame\"\n" + matrix);
  EXPECT_EQ(frame.command(0).representation, Representation::frame);
  const auto last = frame.command(frame.path.macrosteps() - 1);
  EXPECT_NEAR(last.pose[3], 0.2, 1e-12);
  EXPECT_EQ(last.pose[15], 1);
  const PlannedMotion straight = planned(
      "generator = \"straight\"\nspace = \"xyz_euler_zyz\"\n"
      "positions = [0.1, 0.2, 0, 0.3, 0.2, 0.1]\n");
  const auto end = straight.command(straight.path.macrosteps());
  EXPECT_EQ(end.representation, Representation::xyz_euler_zyz);
  const Pose there = pose_from_numbers(Representation::xyz_euler_zyz, {0.1, 0.2, 0, 0.3, 0.2, 0.1}).value();
  EXPECT_LT((straight.poses.back().R - there.R).norm(), 1e-9);
}

TEST(MovePlan, MotorsAreThoseOfTheArm) {
  const PlannedMotion m = planned("space = \"motors\"\npositions = [1, 2, 3, 0, 0, 0]\n");
  EXPECT_NEAR(m.joints.back()[2], 0.3, 1e-12);
  EXPECT_EQ(m.command(0).representation, Representation::motors);
}

TEST(MovePlan, EachMotionBeginsWhereTheOneBeforeEndedWhateverItsSpace) {
  const Plan plan = plan_of_text(R"([arm1]
order = ["a", "b", "c"]
[arm1.a]
positions = [0.1, 0.2, 0.1, 0, 0, 0.5]
[arm1.b]
generator = "straight"
positions = [0.3, 0, 0, 0, 0, 0]
[arm1.c]
space = "motors"
positions = [0, 0, 0, 0, 0, 0]
)");
  const auto& motions = plan.arms[0].motions;
  for (std::size_t k = 0; k + 1 < motions.size(); ++k)
    EXPECT_LT((motions[k].joints.back() - motions[k + 1].joints.front()).norm(), 1e-9) << k;
}

TEST(MovePlan, TooFastIsRefusedWithMotionTimeAxisAndRemedy) {
  const std::string text =
      refusal("generator = \"cubic\"\ntimes = [0.1]\npositions = [0, 0, 0.4, 0, 0, 0]\n");
  EXPECT_TRUE(text.starts_with("arm1.a, ")) << text;
  EXPECT_NE(text.find("joint 3"), std::string::npos) << text;
  EXPECT_NE(text.find("of its limit"), std::string::npos) << text;
  EXPECT_EQ(refusal("generator = \"cubic\"\ntimes = [1.0]\npositions = [0, 0, 0.4, 0, 0, 0]\n"), "");
}

TEST(MovePlan, OutOfReachIsRefusedWithTheMotion) {
  const std::string text = refusal("generator = \"straight\"\npositions = [3, 0, 0, 0, 0, 0]\n");
  EXPECT_TRUE(text.starts_with("arm1.a, ")) << text;
  EXPECT_NE(text.find("out of the arm's reach"), std::string::npos) << text;
}

TEST(MovePlan, AMotionThatTakesForEverIsRefused) {
  for (const std::string generator : {"\"trapezoid\"", "\"cubic\"", "\"nurbs\"\ndegree = 1"})
    EXPECT_NE(
        refusal("velocity = [0.0001]\nspace = \"motors\"\npositions = [1e5, 0, 0, 0, 0, 0]\ngenerator = " +
                generator + "\n")
            .find("and may take 3600 s"),
        std::string::npos)
        << generator;
}

TEST(MovePlan, GeneratorsRefuseWhatTheyCannotDoUnderTheNameOfTheMotion) {
  EXPECT_TRUE(refusal("generator = \"nurbs\"\ndegree = 3\npositions = [0, 0, 0.4, 0, 0, 0]\n")
                  .starts_with("arm1.a: "));
  EXPECT_TRUE(
      refusal("generator = \"straight\"\ncorner = 0.1\npositions = [0.1, 0, 0, 0, 0, 0,  0, 0, 0, 0, 0, 0]\n")
          .starts_with("arm1.a: "));
}

TEST(MovePlan, TogetherMotionsTakeTheTimeOfTheSlowerArm) {
  const std::string text = R"([arm1]
order = ["a"]
[arm1.a]
positions = [0.4, 0, 0, 0, 0, 0]
[arm2]
order = ["a", "b"]
[arm2.a]
generator = "replay"
times = [0.0, 2.0]
positions = [0, 0, 0, 0, 0, 0,  0.01, 0, 0, 0, 0, 0]
[arm2.b]
generator = "hold"
time = 1.0
)";
  const Plan alone = plan_of_text(text), together = plan_of_text("together = true\n" + text);
  const auto macrosteps = [](const Plan& p, std::size_t arm) {
    return p.arms[arm].motions[0].path.macrosteps();
  };
  ASSERT_NE(macrosteps(alone, 0), macrosteps(alone, 1));
  EXPECT_EQ(macrosteps(together, 0), macrosteps(together, 1));
  EXPECT_EQ(macrosteps(together, 0), std::max(macrosteps(alone, 0), macrosteps(alone, 1)));
  EXPECT_EQ(together.arms[1].motions[1].path.macrosteps(), 50);
  EXPECT_NEAR(together.arms[1].motions[0].joints.back()[0], 0.01, 1e-12);
}

TEST(MovePlan, AReplayHasItsForcesAlongTheAxesInContact) {
  const PlannedMotion m = planned(
      "generator = \"replay\"\nspace = \"xyz_angle_axis\"\ninterpolation = \"tcim\"\ntimes = [0.0, 1.0]\n"
      "positions = [0, 0, 0, 0, 0, 0,  0.05, 0, 0, 0, 0, 0]\n"
      "forces = [0, 0, 1, 0, 0, 0,  0, 0, 3, 0, 0, 0]\ncontact = [\"z\"]\n");
  const ArmCommand middle = m.command(24);
  EXPECT_EQ(middle.frame[Axis::z].b, Behaviour::contact);
  EXPECT_NEAR(middle.frame[Axis::z].force, 2, 1e-9);
  EXPECT_EQ(middle.frame[Axis::x].b, Behaviour::unguarded);
}

TEST(MovePlan, IsToldALinePerMotion) {
  const std::string text = describe_plan(plan_of_text(one("generator = \"hold\"\ntime = 1.5\n")));
  EXPECT_NE(text.find("arm1.a"), std::string::npos);
  EXPECT_NE(text.find("hold"), std::string::npos);
  EXPECT_NE(text.find("1.50"), std::string::npos) << text;
}

}  // namespace
}  // namespace mrroc::any_motion
