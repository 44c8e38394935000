// Inputs of a servo command besides the cameras' readings: motion under way, velocity, certainty.
#include <gtest/gtest.h>

#include "base/screw.hpp"
#include "tasks/visual_servo/program.hpp"
#include "tasks/visual_servo/servo.hpp"
#include "test/base/random_pose.hpp"
#include "test/tasks/visual_servo/synthetic_cell.hpp"

namespace mrroc::visual_servo {
namespace {

using mrroc::test::distance;
using X = Arm::X;

constexpr std::array kNone{false, false}, kSac{true, false}, kEih{false, true}, kBoth{true, true};

/// Both cameras see an object that is off by so much from where it is wanted; step 1000, control step 110.
X image(const Vector3& off = {0.01, 0, 0}) {
  X x;
  x.c = begin(test::parameters(), 100);
  x.i = 110;
  x.c.made_in = 109;
  x.e.step = 1000;
  x.e.parts = static_cast<std::uint8_t>(Part::arm);
  const Pose T_0E{rotation_from_angle_axis({3, 0, 0}), {0.9, 0, 1}};
  const AngleAxisPose r = angle_axis_from_pose(T_0E);
  std::ranges::copy(r, x.e.T_0E.begin());
  const Pose T_0G = T_0E * Pose{Matrix3::Identity(), off} * x.c.k.T_EGd;
  for (std::size_t n = 0; n < kCameras; ++n) {
    CameraImage& c = x.V.camera[n];
    c.there = c.reading.seen = true;
    c.T_0E = T_0E;
    c.reading.step = n == 0 ? 980 : 960;
    c.reading.frame = c.reading.step / 20;
    const Pose T_0C = n == 0 ? x.c.k.camera[0].place : T_0E * x.c.k.camera[1].place;
    c.reading.T_CG = T_0C.inverse() * T_0G;
    c.reading.covariance = (n == 0 ? 4e-6 : 1e-6) * Matrix6::Identity();
  }
  return x;
}

void refuse(X& x, Verdict verdict = Verdict::refused) {
  x.e.verdict = verdict;
  x.e.fault.code = FaultCode::unreachable_pose;
}

TEST(ServoMemory, AChangeToACameraThatSaysOtherwiseIsGoneOverInStepsOfHalfAMillimetre) {
  X x = image();
  x.V.camera[0].reading.T_CG.p += Vector3(0.02, 0, 0);
  const Pose sac = conclude(x, kSac).e, eih = conclude(x, kEih).e;
  ASSERT_GT((sac.p - eih.p).norm(), 0.015);
  x.c.handover = conclude(x, kSac).handover;
  Pose e = sac;
  for (int k = 0; k < 200; ++k) {
    const Conclusion c = conclude(x, kEih);
    ASSERT_LT((c.e.p - e.p).norm(), 1e-3) << k;
    x.c.handover = c.handover;
    e = c.e;
  }
  EXPECT_LT((e.p - eih.p).norm(), 1e-5);
}

TEST(ServoMemory, SpeedsAreHalvedByARefusalDownToATenthAndComeBackInTenSteps) {
  X x = image();
  refuse(x);
  for (const double ease : {0.5, 0.25, 0.125, 0.1, 0.1}) {
    x.c.ease = conclude(x, kBoth).ease;
    EXPECT_DOUBLE_EQ(x.c.ease, ease);
  }
  x = image();
  x.c.ease = 0.1;
  for (int k = 2; k <= 12; ++k) {
    x.c.ease = conclude(x, kBoth).ease;
    EXPECT_NEAR(x.c.ease, std::min(1., 0.1 * k), 1e-12);
  }
}

TEST(ServoMemory, AnEasedServoIsSlowerAndAimsAtTheSame) {
  X x = image({0.3, 0, 0});
  for (int k = 0; k < 60; ++k) x.c.under_way = conclude(x, kBoth).T_dc;  // up to speed
  const double fast = x.c.under_way.p.norm();
  for (int k = 0; k < 60; ++k) {
    x.c.ease = 0.4;
    x.c.under_way = conclude(x, kBoth).T_dc;
  }
  EXPECT_NEAR(x.c.under_way.p.norm(), 0.5 * fast, 1e-3 * fast);
}

TEST(ServoMemory, RefusalsAreCountedUntilTheDriverHasMovedTheArm) {
  X x = image();
  x.c.refused = 3;
  refuse(x);
  EXPECT_EQ(conclude(x, kBoth).refused, 4);
  refuse(x, Verdict::failed);
  EXPECT_EQ(conclude(x, kBoth).refused, 4) << "what could not be made as a whole counts, too";
  x = image();
  x.c.refused = 3;
  EXPECT_EQ(conclude(x, kBoth).refused, 0);
  x.e.parts = 0;
  EXPECT_EQ(conclude(x, kBoth).refused, 3) << "an answer that is not about the arm";
}

TEST(ServoMemory, WhatCouldNotBeMadeIsNotOnItsWayEither) {
  X x = image();
  x.c.before = {Matrix3::Identity(), {0.021, 0, 0}};
  const Pose T_0E = pose_of(x.e);
  EXPECT_NEAR((start_of_command(x).T_0E.p - T_0E.p).norm(), 0.002, 1e-12);
  refuse(x, Verdict::failed);
  EXPECT_NEAR((start_of_command(x).T_0E.p - T_0E.p).norm(), 0, 1e-12);
}

TEST(ServoMemory, ACommandBeginsWhenTheStepsThatAreCommandedAreOver) {
  X x = image();
  EXPECT_EQ(start_of_command(x).step, 1000 + 2 + 21);
  x.c.k.pacing.n_s = 11;
  x.c.k.pacing.n_Q = 6;
  EXPECT_EQ(start_of_command(x).step, 1000 + 6 + 11);
}

TEST(ServoMemory, PartsOfDisplacementsCountInsteadOfWhatWasDecided) {
  X x = image();
  x.c.under_way = x.c.before = {Matrix3::Identity(), {0.5, 0.5, 0.5}};
  x.parts = {Pose{rotation_from_angle_axis({0, 0, 0.3}), {0.01, 0, 0}},
             Pose{Matrix3::Identity(), {0, 0.021, 0}}};
  const Pose wanted = pose_of(x.e) * Pose{Matrix3::Identity(), {0, 0.002, 0}} * (*x.parts)[0];
  EXPECT_LT(distance(start_of_command(x).T_0E, wanted), 1e-12);
}

TEST(ServoMemory, WithoutACameraThereIsNeitherAnErrorNorAMotion) {
  const Conclusion c = conclude(image(), kNone);
  EXPECT_EQ(c.e.p, Vector3(0, 0, 0));
  EXPECT_EQ(c.e.R, Matrix3(Matrix3::Identity()));
  EXPECT_EQ(c.T_dc.p, Vector3(0, 0, 0));
  EXPECT_EQ(c.T_dc.R, Matrix3(Matrix3::Identity()));
  EXPECT_TRUE(c.track.known) << "pictures are taken all the same";
}

TEST(ServoMemory, TheOlderPictureIsTakenFirstSoThatBothCount) {
  const X x = image();
  ObjectTrack track;
  for (const Camera camera : {Camera::eih, Camera::sac})
    track = see(x.c.k.track, track, sighting(x, camera), x.c.k.pacing.dt);
  EXPECT_EQ(conclude(x, kBoth).track.P, track.P);
}

TEST(ServoMemory, APictureThatIsNotBelievedIsNotTaken) {
  X x = image();
  x.V.camera[0].reading.seen = false;
  Conclusion c = conclude(x, kNone);
  EXPECT_EQ(c.taken, (std::array<std::int64_t, 2>{-1, 48}));
  EXPECT_EQ(c.sees, (std::array{false, true}));
  x = image();
  x.c.taken = {49, 47};
  c = conclude(x, kNone);
  EXPECT_EQ(c.taken, (std::array<std::int64_t, 2>{49, 48}));
  EXPECT_EQ(c.track.step, 960);
}

TEST(ServoMemory, NoCameraIsSurerThanItsCalibration) {
  X floored = image(), told = image();
  floored.c.k.position_floor = 3e-3;
  floored.c.k.angle_floor = 5e-3;
  told.c.k.position_floor = told.c.k.angle_floor = 0;
  Vector6 least;
  least << Vector3::Constant(9e-6), Vector3::Constant(25e-6);
  for (CameraImage& c : told.V.camera) c.reading.covariance += Matrix6(least.asDiagonal());
  for (const Camera camera : {Camera::sac, Camera::eih}) {
    const Matrix6 a = sighting(floored, camera).covariance, b = sighting(told, camera).covariance;
    EXPECT_LT((a - b).norm(), 1e-15);
    const Start start = start_of_command(told);
    EXPECT_LT((error_of(floored, camera, start, {}).covariance - error_of(told, camera, start, {}).covariance)
                  .norm(),
              1e-15);
  }
}

TEST(ServoMemory, ASightingIsAsUnsureAlongTheAxesOfItsCamera) {
  X x = image();
  x.c.k.position_floor = x.c.k.angle_floor = 0;
  for (const Camera camera : {Camera::sac, Camera::eih}) {
    CameraReading& r = x.V.camera[index(camera)].reading;
    r.covariance = Matrix6::Zero();
    r.covariance(2, 2) = 1;  // along the view
    r.covariance(3, 3) = 1;  // about the x of the picture
    const Pose T_0C = camera == Camera::sac ? x.c.k.camera[0].place : pose_of(x.e) * x.c.k.camera[1].place;
    const Matrix6 P = sighting(x, camera).covariance;
    const Vector3 view = T_0C.R.col(2), side = T_0C.R.col(0);
    EXPECT_LT((P.topLeftCorner<3, 3>() - view * view.transpose()).norm(), 1e-12);
    EXPECT_LT((P.bottomRightCorner<3, 3>() - side * side.transpose()).norm(), 1e-12);
    EXPECT_LT((P.topRightCorner<3, 3>()).norm(), 1e-12);
  }
}

TEST(ServoMemory, AnErrorThatNoiseExplainsIsFollowedQuietly) {
  X x = image({1e-3, 0, 0});
  for (CameraImage& c : x.V.camera) c.reading.covariance = 1e-4 * Matrix6::Identity();  // 10 mm
  x.c.k.regulator.acceleration = x.c.k.regulator.angular_acceleration = 1e6;
  const double share = x.c.k.regulator.quiet * x.c.k.regulator.gain;
  EXPECT_NEAR(conclude(x, kSac).T_dc.p.norm(), 1e-3 * share, 1e-9);
  for (CameraImage& c : x.V.camera) c.reading.covariance = 1e-12 * Matrix6::Identity();
  x.c.k.position_floor = x.c.k.angle_floor = 1e-9;
  EXPECT_NEAR(conclude(x, kSac).T_dc.p.norm(), 1e-3 * x.c.k.regulator.gain, 1e-8);
}

TEST(ServoMemory, WithoutAPictureItsAgeIsThatOfTheTask) {
  X x = image();
  EXPECT_EQ(age_of_picture(x, Camera::sac), 20);
  EXPECT_EQ(age_of_picture(x, Camera::eih), 40);
  x.V.camera[0].there = false;
  EXPECT_EQ(age_of_picture(x, Camera::sac), 10 * 21);
}

TEST(ServoMemory, APictureIsBelievedForItsFramesBeyondItsLatency) {
  Parameters k = test::parameters();
  k.max_age = 3;
  k.camera[1].period = 25;
  k.camera[1].latency = 17;
  EXPECT_EQ(oldest_believed(k, Camera::sac), 3 * 20 + 20);
  EXPECT_EQ(oldest_believed(k, Camera::eih), 3 * 25 + 17);
}

TEST(ServoMemory, TheLongestAgeIsThatOfTheCameraThatNeedsMost) {
  Parameters k = test::parameters();
  k.camera[0].period = 20;
  k.camera[0].latency = 35;  // 256 - 21 - 35 = 10 * 20
  k.camera[1].period = 1;
  EXPECT_EQ(longest_age(k), 10);
  k.camera[0].latency = 36;
  EXPECT_EQ(longest_age(k), 9);
  k.camera[0].latency = 500;
  EXPECT_EQ(longest_age(k), 0);
  k.camera[0].used = false;
  k.camera[1].latency = 0;
  EXPECT_EQ(longest_age(k), 235);
}

}  // namespace
}  // namespace mrroc::visual_servo
