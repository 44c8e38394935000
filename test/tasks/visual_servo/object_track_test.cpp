#include "tasks/visual_servo/object_track.hpp"

#include <gtest/gtest.h>

#include <random>

#include "test/base/random_pose.hpp"

namespace mrroc::visual_servo {
namespace {

using mrroc::test::random_pose;

constexpr double kDt = 0.002;

/// Pictures of an object with a constant velocity, every 20 steps, with noise.
class Filmed {
 public:
  Filmed(const ObjectMotion& motion, double noise, unsigned seed)
      : motion_(motion), noise_(noise), random_(seed) {
    start_ = random_pose(random_);
  }
  [[nodiscard]] Pose at(std::int64_t step) const {
    return carried(start_, motion_, static_cast<double>(step) * kDt);
  }
  Sighting picture(std::int64_t step) {
    std::normal_distribution<double> normal;
    Vector6 d, deviation;
    deviation << Vector3::Constant(noise_), Vector3::Constant(5 * noise_);
    for (int k = 0; k < 6; ++k) d[k] = deviation[k] * normal(random_);
    const Pose T = at(step);
    return {step,
            {rotation_from_angle_axis(d.tail<3>()) * T.R, T.p + d.head<3>()},
            deviation.cwiseAbs2().asDiagonal()};
  }
  ObjectTrack film(const TrackParameters& k, int pictures) {
    ObjectTrack track;
    for (int n = 0; n < pictures; ++n) track = see(k, track, picture(20 * n), kDt);
    return track;
  }

 private:
  ObjectMotion motion_;
  double noise_;
  std::mt19937_64 random_;
  Pose start_;
};

TEST(ObjectTrack, FindsTheVelocityOfAMovingObject) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ObjectMotion motion{{0.1, -0.02, 0.01}, {0, 0.1, -0.3}};
    const ObjectTrack track = Filmed(motion, 2e-4, seed).film({}, 50);
    const ObjectMotion found = significant_motion({}, track);
    EXPECT_LT((found.v - motion.v).norm(), 0.01);
    EXPECT_LT((found.omega - motion.omega).norm(), 0.08);
  }
}

TEST(ObjectTrack, IsExactlyAtRestWhenNoiseExplainsTheMotion) {
  int moving = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Filmed still({}, 1e-3, seed);
    ObjectTrack track;
    for (int n = 0; n < 100; ++n) {
      track = see({}, track, still.picture(20 * n), kDt);
      if (significant_motion({}, track).v != Vector3::Zero()) ++moving;
    }
  }
  EXPECT_LE(moving, 20) << "of 2000";
}

TEST(ObjectTrack, KnowsHowUnsureItIs) {
  double linear = 0, angular = 0;
  constexpr int kRuns = 200;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const ObjectTrack track = Filmed({{0.05, 0, 0}, {0, 0, 0.1}}, 5e-4, seed).film({}, 40);
    const Vector3 v = track.v - Vector3(0.05, 0, 0), w = track.omega - Vector3(0, 0, 0.1);
    linear += v.dot(track.P.block<3, 3>(6, 6).inverse() * v) / 3;
    angular += w.dot(track.P.block<3, 3>(9, 9).inverse() * w) / 3;
  }
  // The object does not accelerate at random as the filter allows for, so that it is surer than it thinks.
  EXPECT_LT(linear / kRuns, 1.2);
  EXPECT_GT(linear / kRuns, 0.1);
  EXPECT_LT(angular / kRuns, 1.2);
  EXPECT_GT(angular / kRuns, 0.1);
}

TEST(ObjectTrack, BelievesTheBetterCameraMore) {
  Filmed good({}, 2e-4, 1);
  ObjectTrack track = good.film({}, 20);
  Sighting bad = good.picture(400);
  bad.T_0G.p.x() += 0.03;
  bad.covariance *= 1e4;
  const ObjectTrack after = see({}, track, bad, kDt);
  EXPECT_LT((after.T_0G.p - good.at(400).p).norm(), 1e-3);
}

TEST(ObjectTrack, ForgetsAnObjectThatJumpsOrWasAwayForLong) {
  Filmed film({{0.1, 0, 0}, {0, 0, 0}}, 1e-4, 1);
  const ObjectTrack track = film.film({}, 30);
  Sighting far = film.picture(600);
  far.T_0G.p.y() += 0.2;
  EXPECT_EQ(see({}, track, far, kDt).v, Vector3(0, 0, 0));
  EXPECT_EQ(see({}, track, film.picture(580 + 251), kDt).v, Vector3(0, 0, 0));
  EXPECT_GT(see({}, track, film.picture(600), kDt).v.x(), 0.08);
}

TEST(ObjectTrack, AJumpBeyondEitherBoundIsANewObjectAndOneBelowBothIsNot) {
  Filmed film({{0.1, 0, 0}, {0, 0, 0}}, 1e-4, 1);
  const TrackParameters k{.jump = 0.05, .angular_jump = 0.5};
  const ObjectTrack track = film.film(k, 30);
  const auto is_new = [&](double way, double angle) {
    Sighting seen = film.picture(600);
    seen.T_0G.p.z() -= way;
    seen.T_0G.R = rotation_from_angle_axis({0, -angle, 0}) * seen.T_0G.R;
    const ObjectTrack after = see(k, track, seen, kDt);
    return after.v == Vector3::Zero() && after.omega == Vector3::Zero();
  };
  EXPECT_FALSE(is_new(0.045, 0.45));
  EXPECT_TRUE(is_new(0.055, 0));
  EXPECT_TRUE(is_new(0, 0.55)) << "turned where it was";
}

TEST(ObjectTrack, AnObjectIsRememberedForTheMemoryAndNoLonger) {
  const TrackParameters k{.memory = 100};
  Filmed film({{0.1, 0, 0}, {0, 0, 0.2}}, 1e-4, 3);
  const ObjectTrack track = film.film(k, 30);  // the last picture: step 580
  EXPECT_NE(see(k, track, film.picture(580 + 100), kDt).v, Vector3(0, 0, 0));
  const ObjectTrack anew = see(k, track, film.picture(580 + 101), kDt);
  EXPECT_EQ(anew.v, Vector3(0, 0, 0));
  EXPECT_EQ(anew.omega, Vector3(0, 0, 0));
  EXPECT_NEAR(anew.P(0, 0), 1e-8, 1e-12) << "as sure as the picture";
  EXPECT_NEAR(anew.P(6, 6), k.speed * k.speed, 1e-12);
  EXPECT_NEAR(anew.P(11, 11), k.angular_speed * k.angular_speed, 1e-12);
}

// The filter's variances by hand, for one axis and a time of one second.
TEST(ObjectTrack, BecomesUnsureAsAccelerationsAllow) {
  const TrackParameters k{.acceleration = 0.2,
                          .angular_acceleration = 0.6,
                          .speed = 0.3,
                          .angular_speed = 0.5,
                          .jump = 10,
                          .angular_jump = 3,
                          .memory = 10'000};
  ObjectTrack track = see(k, {}, {0, {}, 1e-4 * Matrix6::Identity()}, kDt);
  const Matrix6 nothing = 1e12 * Matrix6::Identity();  // a picture that says nothing: the prediction stays
  track = see(k, track, {500, {}, nothing}, kDt);
  EXPECT_NEAR(track.P(0, 0), 1e-4 + 0.09 + 0.25 * 0.04, 1e-9);
  EXPECT_NEAR(track.P(1, 7), 0.09 + 0.5 * 0.04, 1e-9);
  EXPECT_NEAR(track.P(8, 8), 0.09 + 0.04, 1e-9);
  EXPECT_NEAR(track.P(3, 3), 1e-4 + 0.25 + 0.25 * 0.36, 1e-9);
  EXPECT_NEAR(track.P(10, 10), 0.25 + 0.36, 1e-9);
  EXPECT_NEAR(track.P(0, 1), 0, 1e-9);
}

TEST(ObjectTrack, AVelocityIsShrunkByWhatItsUncertaintyAccountsFor) {
  const TrackParameters k{.significance = 2};
  ObjectTrack track;
  track.known = true;
  track.P = 1e-4 * ObjectTrack::Covariance::Identity();
  track.v = {0.04, 0, 0};  // four standard deviations
  track.omega = {0, 0, -0.019};
  const ObjectMotion motion = significant_motion(k, track);
  EXPECT_NEAR(motion.v.x(), 0.75 * 0.04, 1e-12);
  EXPECT_EQ(motion.omega, Vector3(0, 0, 0)) << "less than two";
  track.omega = {0, 0, -0.04};
  EXPECT_NEAR(significant_motion(k, track).omega.z(), -0.75 * 0.04, 1e-12);
  track.known = false;
  EXPECT_EQ(significant_motion(k, track).v, Vector3(0, 0, 0));
}

TEST(ObjectTrack, IgnoresAPictureThatIsOlderThanWhatItKnows) {
  Filmed film({}, 1e-4, 1);
  const ObjectTrack track = film.film({}, 30);
  Sighting old = film.picture(560);
  old.T_0G.p.x() += 0.01;
  const ObjectTrack after = see({}, track, old, kDt);
  EXPECT_EQ(after.T_0G.p, track.T_0G.p);
  EXPECT_EQ(after.step, track.step);
}

TEST(ObjectTrack, StaysUsableForEver) {
  Filmed film({{0.01, 0, 0}, {0, 0, 0.2}}, 1e-6, 1);
  const ObjectTrack track = film.film({}, 5000);
  EXPECT_EQ((track.P - track.P.transpose()).norm(), 0);
  EXPECT_GT(track.P.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), 0);
  EXPECT_LT((track.T_0G.R.transpose() * track.T_0G.R - Matrix3::Identity()).norm(), 1e-9);
}

}  // namespace
}  // namespace mrroc::visual_servo
