#include "vsp/recorded.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/camera_config.hpp"
#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "vsp/picture_file.hpp"
#include "vsp/receptor_program.hpp"

namespace mrroc::vsp {
namespace {

std::string key_of_camera(const Config& config, const RecordedRun& run) {
  std::vector<std::string> keys = config.tables("cameras");
  std::erase(keys, "light");  // no camera: that of the simulated ones
  const std::string list = joined(keys, ", ");
  const std::string file = run.camera.string();
  if (keys.empty()) throw FaultError(FaultCode::bad_configuration, file + " has no table [cameras.NAME]");
  if (run.key.empty() && keys.size() > 1)
    throw FaultError(FaultCode::bad_configuration, file + " has several cameras: " + list,
                     "choose one with --name");
  if (!run.key.empty() && std::ranges::find(keys, run.key) == keys.end())
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("{} has no camera {}; it has {}", file, run.key, list));
  return run.key.empty() ? keys.front() : run.key;
}

RecordedTool tool_of(const ImageReceptor& receptor) {
  const auto make = [&receptor](const CameraModel& camera, const Config& config, const std::string& /*key*/) {
    return [detect = receptor.make(camera, config)](const ImageView& picture, std::int64_t number,
                                                    const std::string& source) {
      const CameraReading reading = detect(picture, number, number);
      return RecordedAnswer{as_json(reading, source), reading, ""};
    };
  };
  return {receptor.program, receptor.about, receptor.shape, make};
}

int run(const RecordedTool& tool, int argc, char** argv) {
  CommandLine line(tool.about + "\nHere on recorded pictures: prints a line of JSON for each.", tool.program);
  RecordedRun r;
  line.option("--source", r.source, "a picture, a folder of pictures, or a film").required();
  line.option("--camera", r.camera, "the camera's TOML file, as `calibrate` writes it").required();
  line.option("--name", r.key, "which camera of the file, when there are several");
  line.option("--annotate", r.annotate, "folder for pictures with the detection drawn in");
  line.option("--strip", r.strip, "PNG file with all of them side by side");
  line.refuse_unknown_options(argc, argv);
  const std::string example = tool.program + " --source pictures --camera camera.toml";
  if (const auto help = line.parse_or_help(
          argc, argv,
          {example, example + " --name eih", example + " --annotate seen", example + " --strip strip.png"})) {
    fmt::print("{}", *help);
    return 0;
  }
  run_recorded(tool, r, stdout);
  return 0;
}

}  // namespace

nlohmann::json as_json(const CameraReading& r, const std::string& source) {
  nlohmann::json line{{"frame", r.frame}, {"source", source}, {"seen", r.seen}, {"ambiguous", r.ambiguous}};
  if (!r.seen) return line;
  const AngleAxisPose pose = angle_axis_from_pose(r.T_CG);
  line["p"] = {pose[0], pose[1], pose[2]};
  line["aa"] = {pose[3], pose[4], pose[5]};
  for (int k = 0; k < 6; ++k) line["sigma"].push_back(std::sqrt(r.covariance(k, k)));
  line["reprojection_px"] = r.reprojection_px;
  return line;
}

void run_recorded(const RecordedTool& tool, const RecordedRun& run, std::FILE* out) {
  const Config config = Config::load(run.camera);
  const std::string key = key_of_camera(config, run);
  const CameraModel camera = read_camera_model(config, key);
  const RecordedDetector detect = tool.make(camera, config, key);
  const ObjectShape shape = tool.shape(config);
  PictureSource source(run.source);
  if (!run.annotate.empty()) {
    std::error_code error;
    std::filesystem::create_directories(run.annotate, error);
    if (error) throw FaultError(FaultCode::cannot_write, "cannot make the folder " + run.annotate.string());
  }
  FilmStrip strip;
  SourcePicture picture;
  for (std::int64_t k = 0; source.next(picture); ++k) {
    const Image& image = picture.image;
    check_size(image, picture.name, camera);
    RecordedAnswer answer = detect(image.view(), k, picture.name);
    answer.line["t"] = picture.t;
    fmt::print(out, "{}\n", answer.line.dump());
    if (run.annotate.empty() && run.strip.empty()) continue;
    annotate(picture.image, answer.reading, camera, shape,
             answer.text.empty() ? fmt::format("{}", k) : fmt::format("{}  {}", k, answer.text));
    if (!run.annotate.empty()) write_picture(run.annotate / fmt::format("{:06}.png", k), image.view());
    const bool seen = answer.reading.seen;
    if (!run.strip.empty() && strip.wants(k, seen)) strip.add(k, seen, image.view());
  }
  if (!run.strip.empty()) write_picture(run.strip, strip.picture().view());
}

int recorded_main(int argc, char** argv, const RecordedTool& tool, const link::NodeMain& body) {
  return receptor_program(
      argc, argv,
      tool.about + "\n\nFor recorded pictures: " + tool.program +
          " --source FILE --camera FILE.toml [options]\n"
          "  --source FILE               a picture, a folder of pictures, or a film\n"
          "  --camera FILE.toml          the camera, as `calibrate` writes it\n"
          "  --name CAMERA               which camera of the file, when there are several\n"
          "  --annotate FOLDER           for pictures with the detection drawn in\n"
          "  --strip FILE.png            all of them side by side",
      body, [&tool](int count, char** words) { return run(tool, count, words); });
}

void run_recorded(const ImageReceptor& receptor, const RecordedRun& run, std::FILE* out) {
  run_recorded(tool_of(receptor), run, out);
}

int receptor_main(int argc, char** argv, const ImageReceptor& receptor) {
  return recorded_main(argc, argv, tool_of(receptor), body_of(receptor));
}

}  // namespace mrroc::vsp
