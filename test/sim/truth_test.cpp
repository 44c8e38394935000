// What the plant really is: each key of it changes the plant, and nothing that controllers read.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "launch/cell_nodes.hpp"
#include "sim/camera/config.hpp"
#include "sim/config.hpp"

namespace mrroc::sim {
namespace {

const std::vector<launch::CellArm> kArms{{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}};
const std::vector<std::string> kKeys{"arm1", "arm2"};

constexpr const char* kPens = R"(
[robots]
order = ["arm1", "arm2"]
[robots.arm1]
synchro = "known_pose"
plate = { shape = "rectangle", length = 0.2, width = 0.2, thickness = 0.004, distance = 0 }
[robots.arm2]
synchro = "known_pose"
[sim]
start_height = 0.005
[cameras]
order = ["eye"]
[cameras.eye]
mount = "arm1"
pose = [0, 0, 0, 0, 0, 0]
)";

/// Its palm lies on the cube and presses.
constexpr const char* kCube = R"(
[robots]
order = ["arm1", "arm2"]
[robots.arm1]
synchro = "known_pose"
gripper = "two_jaw"
fingers = "one_layer"
jaws = 0.0568
[robots.arm2]
synchro = "known_pose"
gripper = "two_jaw"
fingers = "two_layers"
[cube]
held_by = "arm1"
[sim.cube]
place_error.z = -0.0005
)";

constexpr const char* kBody = R"(
[robots]
order = ["arm1", "arm2"]
[robots.arm1]
synchro = "known_pose"
palm = true
[robots.arm2]
synchro = "known_pose"
palm = true
[free_body]
shape = "ball"
)";

/// A cell, and the keys of its plant with values that are others than usual.
struct Cell {
  const char* config;
  std::map<std::string, std::string> others;
};

const std::vector<Cell>& cells() {
  static const std::string balls =
      std::string(kPens) + "[artefact]\nballs = [0.1, 0.02, 0.03]\nplace = [0, 1, 1, 0, 0, 0]\n";
  static const std::vector<Cell> all{
      {kPens,
       {{"sim.substeps", "3"},
        {"sim.motor_friction", "1.5"},
        {"sim.pen_radius", "0.003"},
        {"sim.paper.distance", "0.91"},
        {"sim.paper.height", "0.921"},
        {"sim.paper.tilt.x", "0.0175"},
        {"sim.paper.tilt.y", "0.0175"},
        {"sim.paper.stiffness", "2e4"},
        {"sim.paper.damping_ratio", "0.001"},
        {"sim.paper.friction", "0.4"},
        {"sim.sensor.force_noise", "0.1"},
        {"sim.sensor.torque_noise", "0.01"},
        {"sim.sensor.force_bias", "1"},
        {"sim.sensor.torque_bias", "0.2"}}},
      {kCube,
       {{"sim.solver_iterations", "20"},
        {"sim.pads.friction", "1.2"},
        {"sim.pads.palm_friction", "0"},
        {"sim.pads.stiffness", "4e5"},
        {"sim.pads.palm_stiffness", "4e4"},
        {"sim.pads.wrist_stiffness", "1e4"},
        {"sim.cube.size_error", "0.0003"},
        {"sim.cube.mass", "0.2"},
        {"sim.cube.friction", "0.5"},
        {"sim.cube.place_error.x", "0.0015"},
        {"sim.cube.place_error.y", "0.0005"},
        {"sim.cube.place_error.z", "-0.001"},
        {"sim.cube.place_error.ax", "0.026"},
        {"sim.cube.place_error.ay", "0.026"},
        {"sim.cube.place_error.az", "0.026"}}},
      {balls.c_str(), {}},
      {kBody, {{"sim.free_body.size", "0.21"}, {"sim.free_body.offset", "[0.01, 0, 0]"}}}};
  return all;
}

/// Those of an arm, in the cell with pens.
const std::map<std::string, std::string> kOfArm{{"base_error.x", "0.005"},
                                                {"base_error.y", "0.005"},
                                                {"base_error.z", "0.005"},
                                                {"base_error.ax", "0.0087"},
                                                {"base_error.ay", "0.0087"},
                                                {"base_error.az", "0.0087"},
                                                {"place", "[0.1, 0, 0, 0, 0, 0]"},
                                                {"kinematics", "calibrated"},
                                                {"mass_scale", "1.2"},
                                                {"mass_centre_error.x", "0.02"},
                                                {"mass_centre_error.y", "0.02"},
                                                {"mass_centre_error.z", "0.02"},
                                                {"tool.mass_scale", "1.2"},
                                                {"tool.mass_centre_error.x", "0.02"},
                                                {"tool.mass_centre_error.y", "0.02"},
                                                {"tool.mass_centre_error.z", "0.02"},
                                                {"tool.tip_error.x", "0.002"},
                                                {"tool.tip_error.y", "0.002"},
                                                {"tool.tip_error.z", "0.002"},
                                                {"tool.tip_error.ax", "0.01"},
                                                {"tool.tip_error.ay", "0.01"},
                                                {"tool.tip_error.az", "0.01"},
                                                {"sensor.gain", "1.03"},
                                                {"sensor.turn.ax", "0.035"},
                                                {"sensor.turn.ay", "0.035"},
                                                {"sensor.turn.az", "0.035"},
                                                {"sensor.force_drift", "0.1"},
                                                {"sensor.torque_drift", "0.01"},
                                                {"sensor.delay", "2"},
                                                {"friction_scale", "2"},
                                                {"torque_constant_scale", "1.1"},
                                                {"resistance_scale", "1.1"},
                                                {"rotor_inertia_scale", "1.2"},
                                                {"elasticity", "10"}};

/// Keys whose effect needs more than these cells do; other tests have them: where the arms begin, the engine, how gears
/// that give way are damped, and faces that turn.
const std::set<std::string> kElsewhere{"sim.start_height",
                                       "sim.engine",
                                       "sim.robots.ARM.elasticity_damping",
                                       "sim.cube.breakaway",
                                       "sim.cube.kinetic",
                                       "sim.cube.jam",
                                       "sim.cube.jam_direction",
                                       "sim.cube.jam_loosening",
                                       "sim.cube.face_friction_scale"};

/// Those of a simulated hand with a mass.
const std::map<std::string, std::string> kOfHand{{"stiffness", "500"},
                                                 {"damping", "15"},
                                                 {"speed", "0.03"},
                                                 {"travel_speed", "0.05"},
                                                 {"lowering_speed", "0.02"},
                                                 {"lifting_speed", "0.06"},
                                                 {"lift", "0.02"},
                                                 {"uneven", "0"},
                                                 {"dwell", "0.2"},
                                                 {"press", "3"},
                                                 {"press_wander", "0.5"},
                                                 {"tremor", "2e-4"},
                                                 {"tremor_frequency", "5"},
                                                 {"drag", "100"},
                                                 {"inertia", "10"},
                                                 {"scale", "2"},
                                                 {"mass", "2"},
                                                 {"grip_stiffness", "3000"},
                                                 {"grip_damping", "60"}};

/// Those of a body that rests and of palms that do not touch it: what the simulator gets of them is looked at.
const std::map<std::string, std::string> kAtRest{
    {"sim.palm.width", "0.1"},       {"sim.palm.friction", "0.5"}, {"sim.palm.stiffness", "5000"},
    {"sim.palm.relaxation", "0.01"}, {"sim.free_body.mass", "1"},  {"sim.free_body.friction", "0.4"},
    {"sim.free_body.patch", "0.004"}};

Config config_of(const Cell& cell, const std::string& setting) {
  Config config = Config::parse(cell.config, "test.toml");
  if (!setting.empty()) config.set(setting);
  launch::check_cell(config, kArms, {});
  config.check_all_used();
  return config;
}

/// What controllers, planners and whoever reads the configuration get.
std::string beliefs(const Config& config) {
  std::string all;
  for (const ConfigParameter& p : config.parameters())
    if (!p.key.starts_with("sim.")) all += p.key + " = " + p.value + "\n";
  return all;
}

/// What the drives, the sensors and the true state of a world tell of two seconds in which hands lead both arms.
std::uint64_t happened(const Config& config) {
  World world(read_world(config), 1);
  const bool pens = !config.has("cube.held_by") || config.text("cube.held_by", "").empty();
  for (int arm = 0; arm < world.arms(); ++arm)
    if (pens) world.hand(arm).lead_along({{{0, 0}, {20, 0}}, {{0, 10}, {20, 10}}});
  std::vector<HardwareCommand> commands(static_cast<std::size_t>(world.arms()));
  for (HardwareCommand& c : commands) c.enabled = true;
  std::uint64_t hash = 0;
  const auto take = [&hash](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3; };
  const int steps = pens ? 4000 : 100;
  for (int k = 0; k < steps; ++k) {
    world.step(commands);
    for (int arm = 0; arm < world.arms(); ++arm) {
      for (const double x : world.reading(arm).S_F_m.v) take(x);
      for (const double q : world.truth(arm).joints) take(q);
      for (const double x : world.effector(arm).p) take(x);
      for (const double x : world.effector(arm).R.reshaped()) take(x);
    }
    take(std::bit_cast<double>(world.state_hash()));
  }
  return hash;
}

/// What a hand does that leads a tool through something viscous.
std::uint64_t led(const Config& config) {
  constexpr double kDrag = 200;    // [N s/m]
  constexpr double kTooLong = 20;  // [s]
  const ArmParameters arm = read_world(config).arms.front();
  Hand hand(arm.hand, arm.paper, 1);
  hand.lead_along({{{0, 0}, {20, 0}}, {{0, 10}, {20, 10}}});
  const Pose T_P0 = arm.paper.T_0P.inverse();
  Vector3 tip = arm.paper.T_0P * Vector3(0, 0, 0.02), velocity = Vector3::Zero();
  std::uint64_t hash = 0;
  for (double t = 0; t < kTooLong && hand.status().phase != HandPhase::done; t += kStep) {
    const double height = (T_P0 * tip).z();
    const Vector3 force = hand.step(kStep, tip, velocity, height <= 0);
    for (const double f : force) hash = (hash ^ std::bit_cast<std::uint64_t>(f)) * 0x100000001b3;
    velocity = (force + std::max(0.0, -height) * arm.paper.stiffness * Vector3::UnitZ()) / kDrag;
    tip += kStep * velocity;
  }
  return hash;
}

/// The numbers of a body and of palms.
std::uint64_t of_body(const Config& config) {
  const WorldParameters world = read_world(config);
  const PalmParameters palm = world.arms.front().palm.value_or(PalmParameters{});
  const FreeBodyParameters body = world.free_body.value_or(FreeBodyParameters{});
  std::uint64_t hash = 0;
  for (const double x :
       {palm.width, palm.friction, palm.stiffness, palm.relaxation, body.mass, body.friction, body.patch})
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3;
  return hash;
}

std::uint64_t seen(const Config& config) {
  std::uint64_t hash = 0;
  const auto take = [&hash](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3; };
  const CameraWorld cameras = read_camera_world(config, kKeys, {});
  for (const SimulatedCamera& c : cameras.cameras) {
    for (const double x : angle_axis_from_pose(c.setup.place * c.error)) take(x);
    for (const double x : {c.setup.model.fx, c.setup.model.fy, c.setup.model.cx, c.setup.model.cy}) take(x);
    for (const double x : c.setup.model.distortion) take(x);
  }
  const ObjectParameters object = cameras.object;
  for (const double x : {object.board.square, object.tag_edge}) take(x);
  return hash;
}

using Plant = std::uint64_t(const Config&);

/// @param plant  tells what there is of it
void changes_the_plant_alone(const Cell& cell, const std::string& key, const std::string& value,
                             Plant* plant) {
  static std::map<std::pair<const char*, Plant*>, std::uint64_t> usual;
  const Config before = config_of(cell, "");
  const Config other = config_of(cell, key + "=" + value);
  EXPECT_EQ(beliefs(other), beliefs(before)) << key;
  const auto found = usual.find({cell.config, plant});
  const std::uint64_t hash = found != usual.end() ? found->second : plant(before);
  usual[{cell.config, plant}] = hash;
  EXPECT_NE(plant(other), hash) << key << " changes nothing";
}

TEST(Truth, OfACellChangesThePlantAndNothingThatControllersRead) {
  for (const Cell& cell : cells())
    for (const auto& [key, value] : cell.others) changes_the_plant_alone(cell, key, value, happened);
}

TEST(Truth, OfAnArmChangesThePlantAndNothingThatControllersRead) {
  for (const std::string& arm : kKeys)
    for (const auto& [key, value] : kOfArm)
      changes_the_plant_alone(cells().front(), "sim.robots." + arm + "." + key, value, happened);
  for (const std::string link : {"lower_arm", "upper_arm", "wrist_fork", "wrist_body", "wrist"})
    for (const auto& [key, value] : {std::pair{"mass_scale", "1.2"}, {"zero_error", "0.005"}})
      changes_the_plant_alone(cells().front(), "sim.robots.arm1.links." + link + "." + key, value, happened);
}

TEST(Truth, OfAPlateChangesThePlantAndNothingThatControllersRead) {
  changes_the_plant_alone(cells().front(), "sim.robots.arm1.plate.thickness", "0.0045", happened);
  for (const auto& [key, value] : {std::pair{"length", 0.05}, {"width", 0.06}, {"distance", 0.07}}) {
    const Config other =
        config_of(cells().front(), "sim.robots.arm1.plate." + std::string(key) + "=" + std::to_string(value));
    const PlateParameters plate = read_world(other).arms[0].plate;
    EXPECT_TRUE(plate.length == value || plate.width == value || plate.distance == value) << key;
    EXPECT_EQ(beliefs(other), beliefs(config_of(cells().front(), "")));
  }
}

TEST(Truth, OfAHandChangesWhatItDoesAndNothingThatControllersRead) {
  const std::string text = std::string(kPens) + "[sim.hand]\nmass = 1\n";
  const Cell cell{text.c_str(), {}};
  for (const auto& [key, value] : kOfHand) changes_the_plant_alone(cell, "sim.hand." + key, value, led);
}

TEST(Truth, OfABodyAndOfPalmsIsWhatTheSimulatorGets) {
  for (const auto& [key, value] : kAtRest) changes_the_plant_alone(cells().back(), key, value, of_body);
}

/// The balls that arms touch to find each other: where they stand, and how large they are.
std::uint64_t of_balls(const Config& config) {
  std::uint64_t hash = 0;
  const auto take = [&hash](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3; };
  const ArtefactParameters artefact = read_world(config).artefact.value_or(ArtefactParameters{});
  take(artefact.diameter);
  for (const Vector3& ball : artefact.balls)
    for (const double x : ball) take(x);
  return hash;
}

TEST(Truth, OfBallsIsWhatTheyAreAndNothingThatTheTaskReads) {
  const Cell& cell = cells()[2];
  for (const std::string axis : {"x", "y", "z", "ax", "ay", "az"})
    changes_the_plant_alone(cell, "sim.artefact.place_error." + axis, "0.01", of_balls);
  changes_the_plant_alone(cell, "sim.artefact.diameter", "0.0605", of_balls);
  changes_the_plant_alone(cell, "sim.artefact.ball_errors", "[0, 0.001, 0]", of_balls);
}

TEST(Truth, OfACameraChangesItAndNothingThatItsReceptorReads) {
  for (const std::string axis : {"x", "y", "z", "ax", "ay", "az"})
    changes_the_plant_alone(cells().front(), "sim.cameras.eye.place_error." + axis, "0.003", seen);
  for (const std::string key : {"focal_scale", "centre_error.x", "centre_error.y"})
    changes_the_plant_alone(cells().front(), "sim.cameras.eye." + key, "1.005", seen);
  for (const std::string term : {"k1", "k2", "p1", "p2", "k3"})
    changes_the_plant_alone(cells().front(), "sim.cameras.eye.distortion." + term, "0.01", seen);
}

TEST(Truth, OfABoardOrTagIsItsSizeAndNothingThatItsReceptorReads) {
  changes_the_plant_alone(cells().front(), "sim.object.square", "0.0251", seen);
  changes_the_plant_alone(cells().front(), "sim.object.tag_edge", "0.101", seen);
}

/// @return of a key of the plant without names of arms, links, cameras and axes
std::string family(std::string key) {
  const auto replace = [&key](const std::string& before, const std::string& after) {
    if (const std::size_t at = key.find(before); at != std::string::npos) {
      const std::size_t end = std::min(key.find('.', at + before.size()), key.size());
      key.replace(at + before.size(), end - at - before.size(), after);
    }
  };
  replace("sim.robots.", "ARM");
  replace(".links.", "LINK");
  replace("sim.cameras.", "KEY");
  for (const std::string axis : {".x", ".y", ".z", ".ax", ".ay", ".az", ".k1", ".k2", ".p1", ".p2", ".k3"})
    if (key.ends_with(axis)) return key.substr(0, key.size() - axis.size());
  return key;
}

TEST(Truth, HasAMeaningForEachKeyWhichADocumentTells) {
  std::ifstream file(std::string(MRROC_SOURCE_DIR) + "/docs/plant.md");
  std::stringstream text;
  text << file.rdbuf();
  const std::string document = text.str();
  for (const Cell& cell : cells())
    for (const ConfigParameter& p : config_of(cell, "").parameters()) {
      if (!p.key.starts_with("sim.")) continue;
      EXPECT_FALSE(p.about.empty()) << p.key << " has no meaning";
      EXPECT_NE(document.find("`" + family(p.key) + "`"), std::string::npos)
          << "docs/plant.md does not tell of " << family(p.key);
    }
}

TEST(Truth, OfEachKeyIsTried) {
  std::set<std::string> tried = kElsewhere;
  for (const Cell& cell : cells())
    for (const auto& [key, value] : cell.others) tried.insert(family(key));
  for (const auto& [key, value] : kOfArm) tried.insert(family("sim.robots.arm1." + key));
  for (const auto& [key, value] : kOfHand) tried.insert("sim.hand." + key);
  for (const auto& [key, value] : kAtRest) tried.insert(key);
  for (const std::string key :
       {"sim.robots.ARM.links.LINK.mass_scale", "sim.robots.ARM.links.LINK.mass_centre_error",
        "sim.robots.ARM.plate.thickness", "sim.robots.ARM.plate.length", "sim.robots.ARM.plate.width",
        "sim.robots.ARM.plate.distance", "sim.robots.ARM.fingers", "sim.cameras.KEY.place_error",
        "sim.cameras.KEY.focal_scale", "sim.cameras.KEY.centre_error", "sim.cameras.KEY.distortion",
        "sim.robots.ARM.links.LINK.zero_error", "sim.artefact.place_error", "sim.artefact.diameter",
        "sim.artefact.ball_errors", "sim.object.square", "sim.object.tag_edge"})
    tried.insert(key);
  for (const Cell& cell : cells())
    for (const ConfigParameter& p : config_of(cell, "").parameters()) {
      if (!p.key.starts_with("sim.")) continue;
      EXPECT_TRUE(tried.contains(family(p.key))) << p.key;
    }
}

TEST(Truth, OfAnUnknownKeyIsRefusedWithTheNearestOne) {
  try {
    config_of(cells().front(), "sim.robots.arm1.mass_scael=1.2");
    ADD_FAILURE() << "it was taken";
  } catch (const FaultError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'sim.robots.arm1.mass_scale'?"), std::string::npos)
        << e.what();
  }
}

TEST(Truth, BeginsAsWhatIsTold) {
  const auto world = [](const std::string& setting) {
    return read_world(config_of(cells().front(), setting));
  };
  EXPECT_EQ(world("table.height=0.95").arms[0].paper.T_0P.p.z(), 0.95);
  EXPECT_EQ(world("table.stiffness=5e4").arms[1].paper.stiffness, 5e4);
  EXPECT_EQ(world("robots.arm1.kinematics=calibrated").arms[0].model, 1);
  EXPECT_EQ(world("robots.arm1.kinematics=calibrated").arms[1].model, 0);
  const auto seen_object = [](const std::string& setting) {
    return read_camera_world(config_of(cells().front(), setting), kKeys, {}).object;
  };
  EXPECT_EQ(seen_object("chessboard.square=0.03").board.square, 0.03);
  EXPECT_EQ(seen_object("object.tag_edge=0.2").tag_edge, 0.2);
  EXPECT_EQ(read_world(config_of(cells()[2], "artefact.diameter=0.05")).artefact->diameter, 0.05);
  EXPECT_EQ(world("robots.arm1.plate.length=0.1").arms[0].plate.length, 0.1);
}

}  // namespace
}  // namespace mrroc::sim
