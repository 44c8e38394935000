#include "vsp/calibration/calibrate.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/camera_config.hpp"
#include "base/counted.hpp"
#include "base/fault.hpp"
#include "base/text_file.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

struct Pictures {
  std::vector<BoardView> views;
  int width{};
  int height{};
};

Pictures look_at(const std::filesystem::path& folder, const Board& board, std::FILE* out) {
  Pictures result;
  for (const auto& file : pictures_in(folder)) {
    const Image picture = read_picture(file, 1);
    if (result.width == 0) {
      result.width = picture.width;
      result.height = picture.height;
    }
    const std::string name = file.filename().string();
    if (picture.width != result.width || picture.height != result.height)
      throw FaultError(FaultCode::bad_picture,
                       fmt::format("{}: it is {} x {}, the first one {} x {}", file.string(), picture.width,
                                   picture.height, result.width, result.height));
    if (auto corners = find_corners(picture.view(), board))
      result.views.push_back({name, std::move(*corners)});
    else
      fmt::print(out, "{:32} no board, or not one whole board: left out\n", name);
  }
  return result;
}

void print_views(std::FILE* out, const std::string& what, const std::vector<BoardView>& views,
                 const std::vector<double>& px) {
  for (std::size_t k = 0; k < views.size(); ++k)
    fmt::print(out, "{:32} {} {:.3f} px\n", views[k].name, what, px[k]);
}

CameraModel lens_of(const CalibrationOrder& order, const Pictures& pictures, std::FILE* out) {
  if (order.camera.empty()) {
    const LensCalibration lens = calibrate_lens(pictures.width, pictures.height, pictures.views, order.board);
    print_views(out, "lens", pictures.views, lens.view_px);
    fmt::print(out, "lens: {:.3f} px over {}, focal length {:.2f} +- {:.2f} pixels\n", lens.rms_px,
               counted(pictures.views.size(), "picture"), lens.model.fx, lens.sigma_f * lens.model.fx);
    return lens.model;
  }
  const Config config = Config::load(order.camera);
  const auto keys = config.tables("cameras");
  const std::string key = keys.size() == 1 ? keys.front() : order.name;
  if (std::ranges::find(keys, key) == keys.end())
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("{} has no table [cameras.{}]", order.camera.string(), key));
  const CameraModel model = read_camera_model(config, key);
  if (model.width != pictures.width || model.height != pictures.height)
    throw FaultError(FaultCode::bad_picture,
                     fmt::format("the pictures are {} x {}, the camera's are {} x {}", pictures.width,
                                 pictures.height, model.width, model.height));
  return model;
}

PlaceCalibration place_of(const CalibrationOrder& order, const CameraModel& model, const Pictures& pictures,
                          std::FILE* out) {
  const auto poses = read_poses(order.poses);
  std::vector<PosedView> views;
  std::vector<BoardView> used;
  for (const BoardView& v : pictures.views) {
    const auto pose = std::ranges::find(poses, v.name, &std::pair<std::string, Pose>::first);
    if (pose == poses.end()) {
      fmt::print(out, "{:32} no pose: left out\n", v.name);
      continue;
    }
    views.push_back({v, pose->second});
    used.push_back(v);
  }
  PlaceCalibration place = calibrate_place(model, order.arrangement, views, order.board);
  print_views(out, "place", used, place.view_px);
  fmt::print(out, "place: {:.3f} px over {}, position +- {:.2f} mm\n", place.rms_px,
             counted(used.size(), "picture"), 1e3 * place.sigma_m);
  return place;
}

}  // namespace

std::vector<std::pair<std::string, Pose>> read_poses(const std::filesystem::path& file) {
  constexpr std::size_t kLargest = 10'000'000;  // [bytes]
  std::vector<std::pair<std::string, Pose>> poses;
  try {
    const std::string text = read_text_file(file, kLargest);
    Lines lines(text, file.string());
    while (!lines.done()) {
      const std::string_view line = lines.next();
      if (line.empty() || line.front() == '#' || line.starts_with("picture,")) continue;
      const auto comma = line.find(',');
      if (comma == 0 || comma == std::string_view::npos) lines.fail("not picture,x,y,z,ax,ay,az");
      std::array<double, 6> values{};
      if (!lines.numbers(line.substr(comma + 1), ',', values).empty()) lines.fail("more than six numbers");
      poses.emplace_back(line.substr(0, comma),
                         pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(values.data())));
    }
  } catch (const FileError& e) {
    throw FaultError(FaultCode::bad_calibration, e.what(),
                     "correct the table: picture,x,y,z,ax,ay,az in m and rad");
  }
  return poses;
}

std::string as_toml(const CalibrationOrder& order, const CameraModel& m,
                    const std::optional<PlaceCalibration>& place) {
  const auto& d = m.distortion;
  std::string text = fmt::format(
      "[cameras.{}]\nwidth = {}\nheight = {}\nfx = {:.4f}\nfy = {:.4f}\ncx = {:.4f}\ncy = {:.4f}\n"
      "distortion = [{:.7f}, {:.7f}, {:.7f}, {:.7f}, {:.7f}]\n",
      order.name, m.width, m.height, m.fx, m.fy, m.cx, m.cy, d[0], d[1], d[2], d[3], d[4]);
  if (!place) return text;
  const AngleAxisPose r = angle_axis_from_pose(place->camera);
  const bool in_hand = order.arrangement == Arrangement::eye_in_hand;
  text += fmt::format("mount = \"{}{}\"\npose = [{:.6f}, {:.6f}, {:.6f}, {:.7f}, {:.7f}, {:.7f}]\n",
                      order.arm, in_hand ? "" : ".base", r[0], r[1], r[2], r[3], r[4], r[5]);
  return text;
}

void calibrate(const CalibrationOrder& order, std::FILE* out) {
  const Pictures pictures = look_at(order.pictures, order.board, out);
  if (pictures.views.empty())
    throw FaultError(FaultCode::bad_calibration,
                     fmt::format("no picture shows the whole board of {} x {} inner corners",
                                 order.board.columns, order.board.rows));
  const CameraModel model = lens_of(order, pictures, out);
  std::optional<PlaceCalibration> place;
  if (!order.poses.empty()) place = place_of(order, model, pictures, out);
  write_text_file(order.output, as_toml(order, model, place));
  fmt::print(out, "written: {}\n", order.output.string());
}

}  // namespace mrroc::vsp
