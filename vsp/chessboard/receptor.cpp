#include "base/target/target_config.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"
#include "vsp/image_receptor.hpp"

namespace mrroc::vsp {
namespace {

ImageDetector make_chessboard(const CameraModel& camera, const Config& config) {
  const Config t = config.section("chessboard");
  ChessboardParameters p;
  p.offset = t.integer("offset", p.offset, {1, 100}, "grey levels");
  p.rms_px = t.number("rms", p.rms_px, {0.01, 10}, "pixels");
  p.worst_px = t.number("worst", p.worst_px, {0.01, 50}, "pixels");
  p.pose.significance = t.number("significance", p.pose.significance, {0, 1e6}, "variances");
  return as_detector(ChessboardSensor(camera, read_board(config), p));
}

ObjectShape board_shape(const Config& config) { return shape_of(read_board(config)); }

}  // namespace

const ImageReceptor& chessboard_receptor() {
  static const ImageReceptor receptor{"vsp_chessboard", "Virtual receptor (VSP) of a chessboard's pose.",
                                      "board", board_shape, make_chessboard};
  return receptor;
}

}  // namespace mrroc::vsp
