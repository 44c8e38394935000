#include "tasks/visual_servo/servo.hpp"

#include <gtest/gtest.h>

#include "base/screw.hpp"
#include "tasks/visual_servo/program.hpp"
#include "test/base/random_pose.hpp"
#include "test/tasks/visual_servo/synthetic_cell.hpp"

namespace mrroc::visual_servo {
namespace {

using mrroc::test::distance;
using mrroc::test::random_vector;
using X = Arm::X;

constexpr std::array kSac{true, false}, kEih{false, true}, kBoth{true, true};

/// What exact cameras see of an object and an arm that move with constant velocities, looked at in step 1000.
struct Truth {
  Pose T_0E{rotation_from_angle_axis({3, 0.2, 0.1}), {0.9, 0.1, 1.1}};  // in step 1000
  Pose T_0G = test::object_at(1, 0, 0.85, 0.3);                         // the same
  Twist arm;                                                            // per step, in E
  ObjectMotion object;

  [[nodiscard]] Pose E(std::int64_t step) const {
    return T_0E * exp_screw(arm, static_cast<double>(step - 1000));
  }
  [[nodiscard]] Pose G(std::int64_t step) const {
    return carried(T_0G, object, static_cast<double>(step - 1000) * 0.002);
  }
  [[nodiscard]] X image(std::int64_t sac_step, std::int64_t eih_step) const {
    X x;
    x.c = begin(test::parameters(), 0);
    x.c.k.track.significance = 0;
    x.i = 1;
    x.e.step = 1000;
    const AngleAxisPose r = angle_axis_from_pose(E(1000));
    std::ranges::copy(r, x.e.T_0E.begin());
    x.c.under_way = x.c.before = exp_screw(arm, 21);
    const std::array steps{sac_step, eih_step};
    for (std::size_t n = 0; n < kCameras; ++n) {
      CameraImage& c = x.V.camera[n];
      c.there = true;
      c.T_0E = E(steps[n]);
      const Pose T_0C = n == 0 ? x.c.k.camera[0].place : c.T_0E * x.c.k.camera[1].place;
      c.reading.frame = steps[n] / 20;
      c.reading.step = steps[n];
      c.reading.seen = true;
      c.reading.T_CG = T_0C.inverse() * G(steps[n]);
    }
    return x;
  }
  /// The error when a command begins that is made in step 1000: the rest of the control step, 2, and 21 more.
  [[nodiscard]] Pose error() const {
    return E(1023).inverse() * G(1023) * test::parameters().T_EGd.inverse();
  }
};

TEST(Servo, EveryCameraSeesTheErrorAtTheStartOfTheCommandWhileTheArmMoves) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 200; ++n) {
    Truth truth;
    truth.T_0G.p += random_vector(random, 0.2);
    truth.arm = Twist::from(random_vector(random, 4e-4), random_vector(random, 1e-3));
    const X x = truth.image(980, 960);
    for (const auto& uses : {kSac, kEih, kBoth})
      EXPECT_LT(distance(conclude(x, uses).e, truth.error()), 1e-9);
  }
}

TEST(Servo, TheObjectsVelocityIsCarriedOnFromTheImagesInstant) {
  Truth truth;
  truth.object = {{0.1, 0.03, 0}, {0, 0, 0.2}};
  X x = truth.image(980, 960);
  x.c.track = {.known = true,
               .step = 960,
               .T_0G = truth.G(960),
               .v = truth.object.v,
               .omega = truth.object.omega,
               .P = 1e-12 * ObjectTrack::Covariance::Identity()};
  for (const auto& uses : {kSac, kEih, kBoth}) EXPECT_LT(distance(conclude(x, uses).e, truth.error()), 1e-5);
  x.c.k.feed_forward = false;
  EXPECT_GT(distance(conclude(x, kSac).e, truth.error()), 4e-3);
}

TEST(Servo, WithoutAnErrorItMovesWithTheObject) {
  Truth truth;
  truth.object = {{0.1, 0.03, 0}, {0, 0, 0.2}};
  const Pose T_dE = test::parameters().T_EGd.inverse();
  truth.T_0E = truth.T_0G * T_dE;
  // The arm's own motion for which there is no error when the command begins.
  const Pose there = truth.G(1023) * T_dE;
  truth.arm = log_screw(truth.T_0E.inverse() * there) * (1. / 23);
  X x = truth.image(980, 960);
  x.c.track = {.known = true,
               .step = 960,
               .T_0G = truth.G(960),
               .v = truth.object.v,
               .omega = truth.object.omega,
               .P = 1e-12 * ObjectTrack::Covariance::Identity()};
  const Pose T_dc = conclude(x, kBoth).T_dc;
  const Pose wanted = there.inverse() * truth.G(1044) * T_dE;
  EXPECT_LT(distance(T_dc, wanted), 1e-4);
  EXPECT_GT(wanted.p.norm(), 4e-3);
}

TEST(Servo, InControlStepsThatWerePassedOverNothingWasCommanded) {
  Truth truth;
  truth.arm = Twist{{4e-4}};
  X x = truth.image(980, 980);
  const auto still_to_come = [&] { return (start_of_command(x).T_0E.p - truth.E(1000).p).norm(); };
  EXPECT_NEAR(still_to_come(), 23 * 4e-4, 1e-9);
  ++x.i;
  EXPECT_NEAR(still_to_come(), 2 * 4e-4, 1e-9) << "the rest of the last one";
  ++x.i;
  EXPECT_EQ(still_to_come(), 0);
}

TEST(Servo, ADisplacementThatWasRefusedIsNotTakenToBeOnItsWay) {
  Truth truth;
  truth.arm = Twist{{4e-4}};
  X x = truth.image(980, 980);
  const Pose before = start_of_command(x).T_0E;
  x.e.verdict = Verdict::refused;
  x.e.fault.code = FaultCode::unreachable_pose;
  EXPECT_NEAR((start_of_command(x).T_0E.p - before.p).norm(), 2 * 4e-4, 1e-9) << "two steps of it were left";
}

TEST(Servo, KnowsHowUnsureAnErrorIs) {
  const Truth truth;
  for (const Camera camera : {Camera::sac, Camera::eih})
    for (int axis = 0; axis < 6; ++axis) {
      X x = truth.image(980, 980);
      x.c.k.position_floor = x.c.k.angle_floor = 0;
      CameraReading& reading = x.V.camera[index(camera)].reading;
      constexpr double kOff = 1e-5;
      reading.covariance(axis, axis) = kOff * kOff;
      const CameraError exact = error_of(x, camera, start_of_command(x), {});
      Vector6 off = Vector6::Zero();
      off[axis] = kOff;
      reading.T_CG.p += off.head<3>();
      reading.T_CG.R = rotation_from_angle_axis(off.tail<3>()) * reading.T_CG.R;
      const Vector6 xi =
          log_screw(exact.e.inverse() * error_of(x, camera, start_of_command(x), {}).e).vector();
      EXPECT_LT((xi * xi.transpose() - exact.covariance).norm(), 1e-4 * exact.covariance.norm()) << axis;
    }
}

TEST(Servo, LeadsTowardsTheGoal) {
  std::mt19937_64 random(2);
  for (int n = 0; n < 200; ++n) {
    Truth truth;
    truth.T_0G.p += random_vector(random, 0.2);
    const X x = truth.image(980, 980);
    const Conclusion c = conclude(x, kBoth);
    const Pose after = c.T_dc.inverse() * c.e;
    EXPECT_LT(after.p.norm(), c.e.p.norm());
    EXPECT_LT(angle_axis_from_rotation(after.R).norm(), angle_axis_from_rotation(c.e.R).norm());
  }
}

TEST(Servo, TakesEveryPictureIntoTheTrackOnceAndTheOlderOneFirst) {
  Truth truth;
  X x = truth.image(980, 960);
  const Conclusion first = conclude(x, kBoth);
  EXPECT_EQ(first.taken, (std::array<std::int64_t, 2>{49, 48}));
  EXPECT_EQ(first.track.step, 980);
  x.c.track = first.track;
  x.c.taken = first.taken;
  EXPECT_EQ(conclude(x, kBoth).track.P, first.track.P) << "nothing new";
}

TEST(Servo, ReadingsOfAnUnusedCameraDoNotMatter) {
  Truth truth;
  X x = truth.image(980, 980);
  x.c.k.camera[0].used = false;
  const Pose e = conclude(x, kEih).e;
  x.V.camera[0].reading.T_CG.p.x() += 0.3;
  EXPECT_EQ(distance(conclude(x, kEih).e, e), 0);
  EXPECT_FALSE(sees(x, Camera::sac));
}

}  // namespace
}  // namespace mrroc::visual_servo
