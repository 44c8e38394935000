// What a receptor of a flat object owes to whoever shows it a film: the object moves, is hidden at times, has a double
// beside it at times.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

#include "test/base/random_pose.hpp"
#include "test/vsp/plane_camera.hpp"

namespace mrroc::test {

/// The camera of the films: small pictures.
inline CameraModel film_camera() {
  CameraModel camera = web_camera();
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300;
  camera.cx = 159.5;
  camera.cy = 119.5;
  return camera;
}

/// One picture of a film, and what is in it.
struct Shot {
  Image image;
  Pose T_CG;          ///< of the object
  bool hidden{};      ///< it is not to be seen
  double other{};     ///< where its double is, along x of G [m]; 0: there is none
  std::string where;  ///< for messages
};

/// Counts what films have shown, so that a test can say that all was there.
struct FilmCount {
  int seen{}, ambiguous{}, not_seen{};
};

/// The reading is what the header of every receptor says, and the pose is the true one, or that of the double.
/// @param most_px  the largest reprojection error that is delivered [pixel]
inline void expect_true(const CameraReading& r, const Shot& shot, double most_px) {
  if (!r.seen) {
    EXPECT_EQ(r.T_CG.p, Vector3::Zero()) << shot.where;
    EXPECT_TRUE(r.T_CG.R.isIdentity(0)) << shot.where;
    return;
  }
  EXPECT_FALSE(shot.hidden) << shot.where;
  EXPECT_FALSE(r.ambiguous) << shot.where;
  EXPECT_LE(r.reprojection_px, most_px) << shot.where;
  double worst = std::numeric_limits<double>::infinity();
  for (const double x : {0., shot.other}) {
    const Pose T = shot.T_CG * Pose{Matrix3::Identity(), {x, 0, 0}};
    const Vector3 turn = angle_axis_from_rotation(r.T_CG.R * T.R.transpose());
    double most = 0;  // of any component, in standard deviations and a little
    for (int k = 0; k < 3; ++k) {
      most = std::max(most, std::abs((r.T_CG.p - T.p)[k]) / (8 * std::sqrt(r.covariance(k, k)) + 3e-4));
      most = std::max(most, std::abs(turn[k]) / (8 * std::sqrt(r.covariance(k + 3, k + 3)) + 2e-3));
    }
    worst = std::min(worst, most);
  }
  EXPECT_LT(worst, 1) << shot.where;
}

/// Shows a film. A sensor that has forgotten reads as a new one, bit by bit; one that follows the object reads the same
/// place as a new one does.
/// @param make  a new sensor  @param shots  the film, one picture after the other
template <class Make>
void expect_film(Make make, int shots, const std::function<Shot(int)>& shot_of, double most_px,
                 FilmCount& count) {
  auto follows = make();
  for (int step = 0; step < shots; ++step) {
    const Shot shot = shot_of(step);
    const CameraReading r = follows.detect(shot.image.view(), step, 20 * step);
    EXPECT_EQ(r.frame, step);
    EXPECT_EQ(r.step, 20 * step);
    expect_true(r, shot, most_px);
    auto fresh = make(), forgets = make();
    const CameraReading first = fresh.detect(shot.image.view(), step, 20 * step);
    expect_true(first, shot, most_px);
    if (r.seen && first.seen && shot.other == 0) {
      EXPECT_LT((r.T_CG.p - first.T_CG.p).norm(), 1e-3) << shot.where;
    }
    if (step % 3 == 0) {
      (void)forgets.detect(shot_of(step + 1).image.view(), 0, 0);
      forgets.forget();
      const CameraReading again = forgets.detect(shot.image.view(), step, 20 * step);
      EXPECT_EQ(again.seen, first.seen) << shot.where;
      EXPECT_EQ(again.T_CG.p, first.T_CG.p) << shot.where;
      EXPECT_EQ(again.reprojection_px, first.reprojection_px) << shot.where;
      EXPECT_EQ(again.covariance, first.covariance) << shot.where;
    }
    ++(first.seen ? count.seen : first.ambiguous ? count.ambiguous : count.not_seen);
  }
}

}  // namespace mrroc::test
