// A room with a pair of cameras in it, as the simulation draws it: pairs of pictures with known motions between them.
#pragma once
#include <cstdint>
#include <memory>
#include <random>

#include "base/image.hpp"
#include "sim/camera/renderer.hpp"
#include "vsp/odometry/stereo_rig.hpp"

namespace mrroc::test {

/// What makes a room hard to see.
struct RoomLook {
  unsigned seed{1};      ///< of what is on the floor and the walls, and of the cameras' noise
  double contrast{1.2};  ///< of that
  double noise{2};       ///< of the cameras [grey levels]
  double walls{1};       ///< contrast of the walls, as a share; 0: plain
  double exposure{1};    ///< of the cameras: below 1 dark, above 1 parts are white
  double defocus{0.6};   ///< of the lenses [pixel]
  double blur{};         ///< duration for which light is gathered [pairs]: what moves is blurred
  bool pattern{};        ///< squares of 10 cm everywhere: each corner looks like others
  bool glare{};  ///< a reflection, white and sharp, at one place of each picture, wherever the platform looks
  double lens{1};  ///< true focal lengths, of those that are believed
  Vector3 turned{
      Vector3::
          Zero()};  ///< true direction of the right camera against the believed one: angle times axis in C [rad]
};

/// How the platform moves while a pair is taken.
struct SteadyMotion {
  double x{}, turn{};  ///< from pair to pair [m], [rad]
};

/// Two pictures of the same instant.
struct PicturePair {
  Image left, right;
};

/// @return a camera of 640 x 480 pixels, f 420 pixels, without distortion
CameraModel stereo_camera();
/// @param side  0.06: the left one [m] @return its place on the platform: 0.2 m before B, 0.45 m high, 0.25 rad down
Pose stereo_place(double side);
/// @return the pair: baseline 0.12 m
vsp::StereoRig stereo_rig();

/// 7.5 x 5 m, 2.5 m high, with obstacles along its walls; U in the middle of the floor.
class StereoRoom {
 public:
  explicit StereoRoom(const RoomLook& look = {});

  /// @param T_UB   of the platform @param frame  its number: decides the noise
  /// @param motion  by which they are blurred, when they are
  PicturePair pair(const Pose& T_UB, std::int64_t frame, const SteadyMotion& motion = {});

 private:
  Image picture(camera::Renderer& camera, const Pose& T_UB, const Pose& T_BC, std::int64_t frame,
                const SteadyMotion& motion) const;

  RoomLook look_;
  camera::Scene scene_;
  camera::Renderer left_, right_;
};

/// A way of the platform about the middle of the room, at up to 1 m/s and 1.6 rad/s, a pair of pictures every 80 ms.
class RandomWay {
 public:
  explicit RandomWay(unsigned seed) : random_(seed) {}

  /// @return where it is
  [[nodiscard]] const Pose& T_UB() const { return T_UB_; }
  /// Goes on to the next pair; the platform also sways by millimetres and milliradians. @return the motion
  Pose go_on();

 private:
  double uniform(double most) { return std::uniform_real_distribution<>(-most, most)(random_); }

  std::mt19937 random_;
  Pose T_UB_;
  Vector3 last_{Vector3::Zero()};  // its last way
};

/// @return planar motion of the platform @param x  [m] @param turn  about z [rad]
Pose planar_motion(double x, double turn);

}  // namespace mrroc::test
