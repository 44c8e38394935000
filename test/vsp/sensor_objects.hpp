// The objects of the receptors of poses: what they look like, how large they are, and how exactly they must
// be seen.
#pragma once
#include "base/target/board.hpp"
#include "test/vsp/adverse.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"

namespace mrroc::test {

/// The chessboard with its receptor's sensor and the goals of its exactness.
struct Chessboard {
  using Sensor = vsp::ChessboardSensor;
  static constexpr auto kObject = AdversePictures::Object::chessboard;
  static constexpr double kMillimetres = 0.5, kDegrees = 0.2;  // 95 %, 0.3 to 1 m, tilt up to 45 degrees
  static constexpr int kMisses = 0;                            // of 30
  static constexpr double kHalfWidth = 0.15, kHalfHeight = 0.1125;
  static PlaneCamera::Texture texture(float table = 120) {
    return chessboard_texture(kBoard.columns, kBoard.rows, kBoard.square, kBoard.margin, table);
  }
};

/// The tag, likewise.
struct AprilTag {
  using Sensor = vsp::AprilTagSensor;
  static constexpr auto kObject = AdversePictures::Object::apriltag;
  static constexpr double kMillimetres = 1.5, kDegrees = 0.6;
  static constexpr int kMisses = 2;
  static constexpr double kHalfWidth = 0.075, kHalfHeight = 0.075;
  static PlaneCamera::Texture texture(float table = 120) {
    return tag_texture(kTag.id, kTag.edge, kTag.margin, table);
  }
};

}  // namespace mrroc::test
