#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/chessboard/chessboard_sensor.hpp"
#include "vsp/image_receptor.hpp"
#include "vsp/looked_for.hpp"

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

ImageDetector make_apriltag(const CameraModel& camera, const Config& config) {
  const Config t = config.section("apriltag");
  AprilTagParameters p;
  p.search_blur = t.number("search_blur", p.search_blur, {0, 5}, "pixels");
  p.margin = t.number("margin", p.margin, {0, 255}, "grey levels");
  p.contrast = t.integer("contrast", p.contrast, {1, 255}, "grey levels");
  p.worst_blur = t.number("worst_blur", p.worst_blur, {0.5, 100}, "pixels");
  p.rms_px = t.number("rms", p.rms_px, {0.01, 10}, "pixels");
  p.worst_angle = t.number("worst_angle", p.worst_angle, {0.001, 1}, "rad");
  p.pose.significance = t.number("significance", p.pose.significance, {0, 1e6}, "variances");
  return as_detector(AprilTagSensor(camera, read_tag(config), p));
}

ObjectShape board_shape(const Config& config) { return shape_of(read_board(config)); }
ObjectShape tag_shape(const Config& config) { return shape_of(read_tag(config)); }

}  // namespace

const ImageReceptor& chessboard_receptor() {
  static const ImageReceptor receptor{"vsp_chessboard", "Virtual receptor (VSP) of a chessboard's pose.",
                                      "board", board_shape, make_chessboard};
  return receptor;
}

const ImageReceptor& apriltag_receptor() {
  static const ImageReceptor receptor{"vsp_apriltag", "Virtual receptor (VSP) of an AprilTag's pose.", "tag",
                                      tag_shape, make_apriltag};
  return receptor;
}

void run_chessboard(link::Process& process, const Config& config, const link::PartArguments& /*arguments*/) {
  run_receptor(chessboard_receptor(), process, config);
}

void run_apriltag(link::Process& process, const Config& config, const link::PartArguments& /*arguments*/) {
  run_receptor(apriltag_receptor(), process, config);
}

}  // namespace mrroc::vsp
