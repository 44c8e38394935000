// The virtual receptors that look at pictures, for programs and tasks: one value says everything that
// distinguishes them.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "vsp/annotate.hpp"
#include "vsp/image_sensor.hpp"

namespace mrroc::vsp {

/// An image sensor whose type does not matter.
using ImageDetector = std::function<CameraReading(const ImageView&, std::int64_t frame, std::int64_t step)>;

/// @return the sensor's detect()
template <ImageSensor S>
ImageDetector as_detector(S sensor) {
  return [kept = std::make_shared<S>(std::move(sensor))](const ImageView& picture, std::int64_t frame,
                                                         std::int64_t step) {
    return kept->detect(picture, frame, step);
  };
}

/// One kind of receptor.
struct ImageReceptor {
  std::string program;                  ///< e.g. "vsp_chessboard"
  std::string about;                    ///< one sentence for --help
  std::string object;                   ///< last part of the channel's name, e.g. "board"
  ObjectShape (*shape)(const Config&);  ///< what it looks for, for drawing. @throws ConfigError
  /// Makes the sensor of one camera; thresholds from the configuration. @throws ConfigError
  std::function<ImageDetector(const CameraModel&, const Config&)> make;
};

/// The chessboard; what it is, and thresholds, in [chessboard].
const ImageReceptor& chessboard_receptor();
/// The tag; which it is, and thresholds, in [apriltag].
const ImageReceptor& apriltag_receptor();

/// Body of a receptor's process: for every picture of its camera one reading, also when nothing was seen, until the
/// camera's last one or the end of the system. The process's name is "vsp-KEY" with KEY of [cameras.KEY]; pictures are
/// announced on "KEY.frame" and lie in the camera's frame store; readings go to "KEY.OBJECT". With `film.directory` in
/// the configuration it leaves KEY_OBJECT.png there: what the camera saw over the run, with what was found drawn in.
/// @throws FaultError bad_configuration: no such camera, or its pictures are of another size; malformed_message: the
///         frame store does not hold what was announced
void run_receptor(const ImageReceptor& receptor, link::Process& process, const Config& config);
/// @param receptor  must outlive the body
/// @return run_receptor() as the main function of a node
[[nodiscard]] link::NodeMain body_of(const ImageReceptor& receptor);

/// The receptor's program: a node of a running system, or with --source a tool for recorded pictures.
/// @return exit status
int receptor_main(int argc, char** argv, const ImageReceptor& receptor);

}  // namespace mrroc::vsp
