#include "vsp/odometry/recorded_pairs.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/pose.hpp"
#include "vsp/odometry/config.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

std::string key_of_platform(const Config& config, const RecordedPairs& run) {
  if (!run.key.empty()) return run.key;
  const std::vector<std::string> keys = config.tables("odometry");
  const std::string file = run.camera.string();
  if (keys.empty())
    throw FaultError(FaultCode::bad_configuration, file + " has no table [odometry.NAME]",
                     "it names the two cameras, left and right");
  if (keys.size() > 1)
    throw FaultError(FaultCode::bad_configuration, file + " has several pairs: " + joined(keys, ", "),
                     "choose one with --name");
  return keys.front();
}

Image picture_of(const std::filesystem::path& file, const CameraModel& camera) {
  Image picture = read_picture(file, 1);
  check_size(picture, file.string(), camera);
  return picture;
}

void add_motion(nlohmann::json& line, const OdometryReading& r) {
  Pose A;
  A.R << r.A[0], r.A[1], r.A[2], r.A[4], r.A[5], r.A[6], r.A[8], r.A[9], r.A[10];
  A.p << r.A[3], r.A[7], r.A[11];
  const AngleAxisPose motion = angle_axis_from_pose(A);
  line["step_before"] = r.step_before;
  line["p"] = {motion[0], motion[1], motion[2]};
  line["aa"] = {motion[3], motion[4], motion[5]};
  constexpr std::size_t kDiagonal = 7;
  for (std::size_t k = 0; k < r.covariance.size(); k += kDiagonal)
    line["sigma"].push_back(std::sqrt(r.covariance[k]));
}

nlohmann::json line_of(const OdometryReading& r, const OdometrySupport& support) {
  nlohmann::json line{{"frame", support.frame},     {"step", r.step},
                      {"valid", r.valid},           {"finding", to_words(support.finding)},
                      {"matches", support.matches}, {"inliers", support.inliers},
                      {"cells", support.cells},     {"reprojection_px", support.rms_px}};
  if (r.valid) add_motion(line, r);
  return line;
}

}  // namespace

int recorded_pairs_main(int argc, char** argv) {
  CommandLine line(
      "Virtual receptor (VSP) of a platform's visual odometry: the motion between two stereo pairs.\n"
      "On recorded pairs: prints a line of JSON for each.",
      "vsp_odometry");
  RecordedPairs r;
  line.option("--source", r.source,
              "a folder with a folder of pictures for either camera, named as the camera")
      .required();
  line.option("--camera", r.camera, "the TOML file with [odometry.NAME] and both [cameras.KEY]").required();
  line.option("--name", r.key, "which platform of the file, when there are several");
  line.refuse_unknown_options(argc, argv);
  const std::string example = "vsp_odometry --source pairs --camera rex.toml";
  if (const auto help = line.parse_or_help(argc, argv, {example, example + " --name rex"})) {
    fmt::print("{}", *help);
    return 0;
  }
  run_recorded_pairs(r, stdout);
  return 0;
}

void run_recorded_pairs(const RecordedPairs& run, std::FILE* out) {
  const Config config = Config::load(run.camera);
  const StereoSetup pair = read_stereo(config, key_of_platform(config, run));
  StereoOdometry odometry(pair.rig(), pair.parameters);
  const auto left = pictures_in(run.source / pair.left.key);
  const auto right = pictures_in(run.source / pair.right.key);
  if (left.size() != right.size())
    throw FaultError(FaultCode::bad_picture,
                     fmt::format("{} has {} pictures of {} and {} of {}", run.source.string(), left.size(),
                                 pair.left.key, right.size(), pair.right.key));
  for (std::size_t k = 0; k < left.size(); ++k) {
    const auto frame = static_cast<std::int64_t>(k);
    const Image left_picture = picture_of(left[k], pair.left.model);
    const Image right_picture = picture_of(right[k], pair.right.model);
    const OdometryReading reading =
        odometry.step(left_picture.view(), right_picture.view(), frame, frame * pair.left.period);
    nlohmann::json line = line_of(reading, odometry.support());
    line["left"] = left[k].string();
    line["right"] = right[k].string();
    fmt::print(out, "{}\n", line.dump());
  }
}

}  // namespace mrroc::vsp
