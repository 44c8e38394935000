#include "tasks/haptic/passivity.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mrroc::haptic {
namespace {

constexpr double kMacrostep = 0.004;

Vector3 any(std::mt19937_64& random, double size) {
  std::normal_distribution<> normal(0, size);
  return {normal(random), normal(random), normal(random)};
}

TEST(HapticPassivity, LetsNoMoreOutThanWasHeardToGoInWhateverIsPutOutAndMet) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 100; ++run) {
    const PassivityLaw law;
    PortEnergy port;
    double heard = 0, exchanged = 0, damped = 0;
    for (int i = 0; i < 2000; ++i) {
      if (random() % 3 == 0)
        heard += 1e-3 * std::uniform_real_distribution<>(-0.5, 1)(random);  // old news, too
      port = hear(port, law, heard);
      const Vector3 output = any(random, 20), input = any(random, 0.05);
      const double taken = 1e-5 * std::uniform_real_distribution<>(0, 1)(random);
      const Passed passed = pass(port, law, output, input, kMacrostep, taken);
      damped += taken;
      port = passed.port;
      exchanged += kMacrostep * passed.output.dot(input);
      ASSERT_GE(port.observed(), -law.start - 1e-12);
      ASSERT_GE(port.store, 0);
      // What has come out in truth was heard of, went in here, or was taken up by the damping.
      ASSERT_LE(exchanged, port.heard + law.start + damped + 1e-9);
    }
  }
}

TEST(HapticPassivity, OnlyTakesFromTheOutputAlongWhatItMeetsAndNeverTurnsItRound) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 1000; ++run) {
    const Vector3 output = any(random, 20), input = any(random, 0.05);
    const Vector3 passed = pass({}, {}, output, input, kMacrostep).output;
    EXPECT_LT((output - passed).cross(input).norm(), 1e-9);
    EXPECT_LE(passed.norm(), output.norm() + 1e-12);
    if (output.dot(input) <= 0) {
      EXPECT_EQ(passed, output) << "energy goes in";
    } else {
      EXPECT_GE(passed.dot(input), -1e-12);
    }
  }
}

TEST(HapticPassivity, OnlyObservesWhenTheControllerIsOff) {
  const PassivityLaw law{.control = false};
  PortEnergy port;
  for (int i = 0; i < 100; ++i) {
    const Passed passed = pass(port, law, {10, 0, 0}, {0.1, 0, 0}, kMacrostep);
    EXPECT_EQ(passed.output, Vector3(10, 0, 0));
    port = passed.port;
  }
  EXPECT_NEAR(port.observed(), -100 * kMacrostep, 1e-9);
  EXPECT_EQ(port.kept_back, 0);
}

TEST(HapticPassivity, SavesNoMoreThanTheSurplus) {
  const PassivityLaw law;
  PortEnergy port = hear({}, law, 10);
  double out = 0;
  for (int i = 0; i < 1000; ++i) {
    const Passed passed = pass(port, law, {10, 0, 0}, {0.1, 0, 0}, kMacrostep);
    port = passed.port;
    out += kMacrostep * passed.output.x() * 0.1;
  }
  EXPECT_NEAR(out, law.start + law.surplus, 1e-9);
}

TEST(HapticPassivity, DoesNotSendOnWhatNoiseTakesToAndFro) {
  const PassivityLaw law;
  PortEnergy port;
  for (int i = 0; i < 1000; ++i)
    port = pass(port, law, {i % 2 ? 5.0 : -5.0, 0, 0}, {0.005, 0, 0}, kMacrostep).port;
  EXPECT_LT(port.in, 1e-9);
  EXPECT_LE(port.out, law.start);
}

}  // namespace
}  // namespace mrroc::haptic
