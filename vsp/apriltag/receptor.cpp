#include "base/target/target_config.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/image_receptor.hpp"

namespace mrroc::vsp {
namespace {

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

ObjectShape tag_shape(const Config& config) { return shape_of(read_tag(config)); }

}  // namespace

const ImageReceptor& apriltag_receptor() {
  static const ImageReceptor receptor{"vsp_apriltag", "Virtual receptor (VSP) of an AprilTag's pose.", "tag",
                                      tag_shape, make_apriltag};
  return receptor;
}

}  // namespace mrroc::vsp
