#include <fmt/core.h>

#include "base/camera_config.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/camera_reading_t.hpp"
#include "vsp/camera_loop.hpp"
#include "vsp/image_receptor.hpp"

namespace mrroc::vsp {

void run_receptor(const ImageReceptor& receptor, link::Process& process, const Config& config) {
  process.needs_unlogged("the pictures of cameras");
  const std::string key = camera_of(process);
  const CameraModel camera = read_camera_model(config, key);
  const ImageDetector detect = receptor.make(camera, config);
  CameraFilm film(key, receptor.object, receptor.shape(config), camera, config);
  const auto readings = process.outbox<camera_reading_t>(key + "." + receptor.object);
  const auto answer = [&](const ImageView* picture, std::int64_t frame, std::int64_t step, double t,
                          bool last) {
    CameraReading reading;
    reading.frame = frame;
    reading.step = step;
    if (picture != nullptr) {
      reading = detect(*picture, frame, step);
      reading.t = t;
      film.see(*picture, reading, reading.seen ? fmt::format("{:.3f} m", reading.T_CG.p.norm()) : "");
    }
    camera_reading_t m = to_message(reading);
    m.last = last;
    readings->publish(m, frame);
  };
  run_camera(process, key, camera, answer, [&film] { film.write(); });
}

link::NodeMain body_of(const ImageReceptor& receptor) {
  return [&receptor](link::Process& process, const Config& config, const link::NodeArguments&) {
    run_receptor(receptor, process, config);
  };
}

}  // namespace mrroc::vsp
