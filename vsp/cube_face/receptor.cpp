#include "vsp/cube_face/receptor.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/camera_config.hpp"
#include "base/msg/convert_cube_face.hpp"
#include "vsp/camera_loop.hpp"
#include "vsp/recorded.hpp"

namespace mrroc::vsp {
namespace {

constexpr const char* kObject = "cube_face";

Pose pose_in(const Config& t) {
  const auto pose = t.numbers<6>("pose", std::nullopt, {-10, 10}, "m, angle times axis in rad");
  return pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(pose.data()));
}

ObjectShape shape(const Config& /*config*/) {
  ObjectShape s;
  const double half = kCubeFace.edge / 2;
  s.outline = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  for (int k = 0; k < kStickers; ++k) s.marks.push_back(kCubeFace.middle(k));
  s.axes = half;
  return s;
}

/// Place of the face, in the form in which objects are drawn.
CameraReading place_of(const CubeFaceReading& r) {
  CameraReading reading;
  reading.frame = r.frame;
  reading.step = r.step;
  reading.seen = r.seen;
  reading.T_CG = r.T_CG;
  return reading;
}

/// @return e.g. "WRG YOB W?R": first letters, ? for what is not certain
std::string in_words(const CubeFaceReading& r) {
  if (!r.seen) return "";
  std::string text;
  for (int k = 0; k < kStickers; ++k) {
    const StickerReading& s = r.stickers[static_cast<std::size_t>(k)];
    constexpr double kCertain = 0.5;
    if (k % 3 == 0 && k > 0) text += ' ';
    text += s.confidence > kCertain ? static_cast<char>(to_string(s.colour)[0] - 'a' + 'A') : '?';
  }
  return text;
}

/// @return e.g. "U: ", the face that is shown; empty when none is
std::string in_words(const CubeFaceSetting& asked) {
  if (asked.face < 0) return "";
  return {"URFDLB"[asked.face], ':', ' '};
}

nlohmann::json line_of(const CubeFaceReading& r, const std::string& source) {
  nlohmann::json line = as_json(place_of(r), source);
  line.erase("ambiguous");
  line["valid"] = r.valid;
  if (!r.seen) return line;
  line["place"] = r.place;
  line["reprojection_px"] = r.reprojection_px;
  line["sigma"] = nlohmann::json::array();
  for (int k = 0; k < 6; ++k) line["sigma"].push_back(std::sqrt(r.covariance(k, k)));
  for (const StickerReading& s : r.stickers) {
    line["rgb"].push_back(s.rgb);
    line["colour"].push_back(to_string(s.colour));
    line["confidence"].push_back(s.confidence);
    line["flaw"].push_back(to_string(s.flaw));
  }
  return line;
}

}  // namespace

std::vector<std::string> cube_face_places(const Config& config) { return config.tables("cube_face.places"); }

CubeFaceSensor make_cube_face_sensor(const Config& config, const std::string& key) {
  const Config t = config.section("cube_face");
  CubeFaceParameters k;
  k.place_error = t.number("place_error", k.place_error, {1e-4, 0.008}, "m");
  k.angle_error = t.number("angle_error", k.angle_error, {1e-3, 0.2}, "rad");
  k.contrast = t.number("contrast", k.contrast, {1, 100}, "grey levels");
  k.rms_px = t.number("rms", k.rms_px, {0.01, 10}, "pixels");
  k.edge_share = t.number("edge_share", k.edge_share, {0.1, 1});
  k.glare_share = t.number("glare_share", k.glare_share, {0, 0.67});
  k.dark = t.number("dark", k.dark, {1, 200}, "grey levels");
  k.veil = t.number("veil", k.veil, {0, 1});
  k.confidence = t.number("confidence", k.confidence, {0.5, 1});
  const CameraSetup camera = read_camera(config, key);
  std::vector<Pose> places;
  for (const std::string& name : cube_face_places(config))
    places.push_back(camera.place.inverse() * pose_in(t.section("places." + name)));
  return {camera.model, std::move(places), k};
}

void run_cube_face(link::Process& process, const Config& config, const link::NodeArguments& /*arguments*/) {
  process.needs_unlogged("the pictures of cameras");
  const std::string key = camera_of(process);
  const CameraModel camera = read_camera_model(config, key);
  const CubeFaceSensor sensor = make_cube_face_sensor(config, key);
  CameraFilm film(key, kObject, shape(config), camera, config);
  const auto readings = process.outbox<cube_face_reading_t>(key + "." + kObject);
  const int n_s = config.integer("time.n_s", 10, {2, 64}, "steps");
  PictureSettings<CubeFaceSetting> settings(process, fmt::format("{}.{}.setting", key, kObject), n_s);
  const auto answer = [&](const ImageView* picture, std::int64_t frame, std::int64_t step, double /*t*/,
                          bool last) {
    CubeFaceReading reading;
    reading.frame = frame;
    reading.step = step;
    if (picture != nullptr) {
      const CubeFaceSetting& asked = settings.at(step);
      reading = sensor.detect(*picture, frame, step, asked.place);
      film.see(*picture, place_of(reading), in_words(asked) + in_words(reading));
    }
    cube_face_reading_t m = to_message(reading);
    m.last = last;
    readings->publish(m, frame);
  };
  run_camera(
      process, key, camera, answer, [&film] { film.write(); }, &settings);
}

int cube_face_main(int argc, char** argv) {
  const auto make = [](const CameraModel& /*camera*/, const Config& config, const std::string& key) {
    return [sensor = make_cube_face_sensor(config, key)](const ImageView& picture, std::int64_t number,
                                                         const std::string& source) {
      const CubeFaceReading reading = sensor.detect(picture, number, number);
      return RecordedAnswer{line_of(reading, source), place_of(reading), in_words(reading)};
    };
  };
  return recorded_main(
      argc, argv, {"vsp_cube_face", "Virtual receptor (VSP) of the colours of a cube's face.", shape, make},
      run_cube_face);
}

}  // namespace mrroc::vsp
