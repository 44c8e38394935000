#include "vsp/odometry/receptor.hpp"

#include <array>

#include "base/msg/convert_platform.hpp"
#include "vsp/camera_loop.hpp"
#include "vsp/odometry/config.hpp"
#include "vsp/odometry/film.hpp"
#include "vsp/odometry/recorded_pairs.hpp"
#include "vsp/receptor_program.hpp"

namespace mrroc::vsp {
namespace {

/// @return KEY of the process "vsp-odometry-KEY" @throws FaultError bad_usage
std::string platform_of(const link::Process& process) {
  constexpr std::string_view kPrefix = "vsp-odometry-";
  const std::string& name = process.context().name;
  if (!name.starts_with(kPrefix) || name.size() == kPrefix.size())
    throw FaultError(FaultCode::bad_usage,
                     "a platform's odometry is called vsp-odometry-PLATFORM, not " + name);
  return name.substr(kPrefix.size());
}

}  // namespace

void run_odometry(link::Process& process, const Config& config, const link::NodeArguments&) {
  process.needs_unlogged("the pictures of cameras");
  const StereoSetup pair = read_stereo(config, platform_of(process));
  StereoOdometry odometry(pair.rig(), pair.parameters);
  OdometryFilm film(pair.key, config);
  const auto readings = process.outbox<odometry_reading_t>(pair.key + ".odometry");
  const auto answer = [&](std::span<const ImageView> pictures, std::int64_t frame, std::int64_t step, double,
                          bool last) {
    const bool there = pictures.size() == 2;
    const ImageView left = there ? pictures[0] : ImageView{}, right = there ? pictures[1] : ImageView{};
    const OdometryReading reading = odometry.step(left, right, frame, step);
    film.see(left, odometry);
    odometry_reading_t m = to_message(reading, odometry.support());
    m.last = last;
    readings->publish(m, frame);
  };
  const std::array<WatchedCamera, 2> cameras{
      {{pair.left.key, pair.left.model}, {pair.right.key, pair.right.model}}};
  run_cameras(process, cameras, answer, [&film] { film.write(); });
}

int odometry_main(int argc, char** argv) {
  return receptor_program(
      argc, argv,
      "Virtual receptor (VSP) of a platform's visual odometry: the motion between two stereo pairs.\n\n"
      "For recorded pairs: vsp_odometry --source FOLDER --camera FILE.toml [options]\n"
      "  --source FOLDER             a folder of pictures for either camera, named as the camera\n"
      "  --camera FILE.toml          [odometry.NAME] and both [cameras.KEY]\n"
      "  --name NAME                 which platform of the file, when there are several",
      run_odometry, recorded_pairs_main);
}

}  // namespace mrroc::vsp
