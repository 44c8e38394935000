#include "ui_cli/view/scene.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "ui_cli/view/samples.hpp"

namespace mrroc::view {
namespace {

using Json = nlohmann::ordered_json;

template <class V>
Json numbers(const V& v) {
  return Json(std::vector<double>(v.data(), v.data() + v.size()));
}

AngleAxisPose six(const Config& t, const char* key, const std::array<double, 6>& fallback) {
  return Eigen::Map<const AngleAxisPose>(t.numbers<6>(key, fallback).data());
}

/// Runs of versions that did not tell it: the arms stood 2.1 m apart.
std::array<double, 6> usual_place(std::size_t arm, std::size_t arms) {
  return {0, arms > 1 ? 2.1 * static_cast<double>(arms - 1 - arm) : 0.0, 0, 0, 0, 0};
}

ArmScene read_arm(const Config& config, const std::string& name, const std::array<double, 6>& usual) {
  const Config robot = config.section("robots." + name);
  ArmScene a;
  a.name = name;
  a.model = robot.text("model", "irb6_postument");
  a.place = six(robot, "place", usual);
  a.T_0P.R << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  a.T_0P.p = {config.number("sim.paper.distance", 0.9), 0, config.number("sim.paper.height", 0.92)};
  a.belt = a.model == "conveyor";
  a.gripper = robot.text("gripper", "none");
  a.fingers = robot.text("fingers", "none");
  a.palm = robot.flag("palm", false);
  a.tool = six(robot, "tool.pose", {0, 0, 0.25, 0, 0, 0});
  a.plate = robot.text("plate.shape", "none");
  a.plate_size = {robot.number("plate.length", 0.08), robot.number("plate.width", 0.05),
                  robot.number("plate.thickness", 0.03)};
  a.plate_distance = robot.number("plate.distance", 0.06);
  return a;
}

void read_body(const Config& config, BodyScene& body) {
  body.shape = config.text("free_body.shape", "none");
  if (body.shape == "none") return;
  body.size = config.number("sim.free_body.size", config.number("free_body.size", 0.2));
  body.pedestal = config.numbers<3>("free_body.pedestal", std::array{0., 0., 0.});
  const auto offset = config.numbers<3>("sim.free_body.offset", std::array{0., 0., 0.});
  for (std::size_t k = 0; k < offset.size(); ++k) body.pedestal[k] += offset[k];
}

void read_object(const Config& config, Scene& scene) {
  const Config t = config.section("object"), truth = config.section("sim.object");
  scene.object = t.text("kind", "none");
  scene.object_arm = t.text("arm", "arm1");
  if (scene.object == "apriltag") {
    scene.object_square = truth.number("tag_edge", t.number("tag_edge", 0.1));
    scene.object_size = {1.4 * scene.object_square, 1.4 * scene.object_square, 0.004};
  } else if (scene.object != "none") {
    // A board has one square more than inner corners along an edge, and a margin of one square all around.
    scene.object_square = truth.number("square", t.number("square", 0.025));
    scene.object_size = {(t.integer("columns", 9) + 3) * scene.object_square,
                         (t.integer("rows", 6) + 3) * scene.object_square, 0.004};
  }
}

Json json_of(const ArmScene& a) {
  return {{"name", a.name},
          {"model", a.model},
          {"place", numbers(a.place)},
          {"paper", {{"place", numbers(angle_axis_from_pose(a.T_0P))}, {"size", kSheet}}},
          {"belt", a.belt},
          {"gripper", a.gripper},
          {"fingers", a.fingers},
          {"palm", a.palm},
          {"tool", numbers(a.tool)},
          {"plate", {{"shape", a.plate}, {"size", numbers(a.plate_size)}, {"distance", a.plate_distance}}}};
}

Json json_of_room(const Scene& scene) {
  Json j{{"lower", scene.room.lower},
         {"upper", scene.room.upper},
         {"obstacles", Json::array()},
         {"ground", Json::array()},
         {"boxes", Json::array()}};
  for (const Obstacle& o : scene.room.obstacles) j["obstacles"].push_back(o.corner);
  for (const GroundArea& a : scene.ground)
    j["ground"].push_back({{"lower", a.lower}, {"upper", a.upper}, {"scale", a.scale}, {"from", a.from}});
  for (const BoxScene& b : scene.boxes) j["boxes"].push_back({{"name", b.name}, {"size", b.size}});
  return j;
}

void read_platforms(const Config& config, Scene& scene) {
  for (const std::string& name : config.texts("platforms.order", std::vector<std::string>{}))
    scene.platforms.push_back({name, config.text("platforms." + name + ".model", name)});
  if (scene.platforms.empty()) return;
  scene.room = read_room(config);
  scene.ground = read_ground_areas(config);
  for (const std::string& name : config.tables("sim.boxes"))
    scene.boxes.push_back({name, config.numbers<2>("sim.boxes." + name + ".size", Config::kRequired)});
}

}  // namespace

Scene read_scene(const Config& config) {
  Scene scene;
  const auto names = config.texts("robots.order", std::vector<std::string>{});
  for (std::size_t k = 0; k < names.size(); ++k)
    scene.arms.push_back(read_arm(config, names[k], usual_place(k, names.size())));
  read_platforms(config, scene);
  for (const std::string& name : config.texts("cameras.order", std::vector<std::string>{})) {
    const Config camera = config.section("cameras." + name);
    scene.cameras.push_back({name, camera.integer("width", 640), camera.integer("height", 480)});
  }
  scene.cube_held_by = config.text("cube.held_by", "");
  read_body(config, scene.body);
  read_object(config, scene);
  return scene;
}

bool on_paper(const ArmScene& arm, const Vector3& E, double belt) {
  constexpr double kAbove = 2e-5;
  constexpr double kWithin = 5e-3;
  const Vector3 p = arm.T_0P.inverse() * (E - belt * Vector3::UnitY());
  return p.z() < kAbove && p.z() > -kWithin && std::abs(p.x()) <= kSheet / 2 && std::abs(p.y()) <= kSheet / 2;
}

std::string scene_json(const Scene& scene, const SceneFrame& frame) {
  Json j{
      {"source", frame.source},
      {"task", frame.task},
      {"session", frame.session},
      {"folder", frame.folder},
      {"pictures", frame.pictures},
      {"note", frame.note},
      {"columns", kArmColumns},
      {"platform_columns", kPlatformColumns},
      {"arms", Json::array()},
      {"platforms", Json::array()},
      {"cameras", Json::array()},
      {"cube", {{"held_by", scene.cube_held_by}}},
      {"body", {{"shape", scene.body.shape}, {"size", scene.body.size}, {"pedestal", scene.body.pedestal}}},
      {"object",
       {{"kind", scene.object},
        {"arm", scene.object_arm},
        {"size", numbers(scene.object_size)},
        {"square", scene.object_square}}}};
  for (const ArmScene& a : scene.arms) j["arms"].push_back(json_of(a));
  for (const PlatformScene& p : scene.platforms)
    j["platforms"].push_back({{"name", p.name}, {"model", p.model}});
  if (!scene.platforms.empty()) j["room"] = json_of_room(scene);
  for (const CameraScene& c : scene.cameras)
    j["cameras"].push_back({{"name", c.name}, {"width", c.width}, {"height", c.height}});
  return j.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace mrroc::view
