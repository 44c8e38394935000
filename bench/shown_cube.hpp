// A cube that the task `rubik` shows to its camera, in light of four kinds.
#pragma once
#include <array>
#include <random>
#include <vector>

#include "base/camera_config.hpp"
#include "base/cube/cube.hpp"
#include "base/pose.hpp"
#include "sim/camera/scene.hpp"
#include "tasks/rubik/reading/state_reading.hpp"

namespace mrroc::bench {

/// Light in which cubes are read. dim: 20 to 40 % of it; glaring: the face mirrors the lamp.
enum class Lighting : std::uint8_t { white, coloured, dim, glaring };
inline constexpr int kLightings = 4;  ///< kinds of light

/// Light that stays while a cube is read.
struct CubeLight {
  camera::Light light;  ///< the same for all faces
  bool shadows{true};   ///< false: nothing stands in the lamp's light
};

/// One face before the camera, as a plan of the task shows it.
struct Look {
  Pose T_UG;            ///< where the face is shown
  Matrix3 R_GC;         ///< of the core in the frame of the shown face
  camera::Scene scene;  ///< of both arms as they stand then, without the cube
};

/// The task's cell, camera and plans to show all faces.
class ShownCube {
 public:
  /// @param seed  of light and errors
  explicit ShownCube(unsigned seed);

  /// @return the looks at the six faces in their order, of a reading from 0 on
  [[nodiscard]] const std::vector<Look>& looks(int reading) const {
    return looks_[static_cast<std::size_t>(reading)];
  }
  /// @return camera of the task, as configured
  [[nodiscard]] const CameraSetup& camera() const { return camera_; }
  /// @return T_CG of the places where faces are shown
  [[nodiscard]] std::vector<Pose> places() const;

  /// @return light of a kind, another one at each call
  CubeLight draw_light(Lighting lighting);
  /// @return what the camera sees, with the cube some millimetres and degrees from where it should be in the hand, anew at
  ///         each call
  camera::Scene show(const Look& look, const cube::Cube& cube, const CubeLight& light);

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

  std::mt19937 random_;
  CameraSetup camera_;
  std::array<std::vector<Look>, rubik::kReadings> looks_;
};

}  // namespace mrroc::bench
