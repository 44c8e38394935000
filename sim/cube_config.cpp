#include "sim/cube_config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/cube/cube_config.hpp"
#include "sim/errors.hpp"

namespace mrroc::sim {
namespace {

using cube::Face;
using cube::Fingers;

constexpr double kMostInJaws = 0.001;  // that a pad may be pressed into a sticker at the beginning [m]

[[noreturn]] void refuse(const std::string& what) {
  throw FaultError(FaultCode::bad_configuration, "cube." + what);
}

/// @return layers of the cube that the fingers of an arm take as everybody believes; 0: it has none
int layers_given(const Config& config, const std::string& key) {
  return config.section("robots." + key)
      .choice("fingers", 0, {{"none", 0}, {"one_layer", 1}, {"two_layers", 2}});
}

/// @return the fingers that an arm really has
std::optional<Fingers> fingers_of(const Config& config, const std::string& key) {
  constexpr int kAsGiven = -1;
  const int given = layers_given(config, key);
  const int own = config.section("sim.robots." + key)
                      .choice("fingers", kAsGiven,
                              {{"as_given", kAsGiven}, {"none", 0}, {"one_layer", 1}, {"two_layers", 2}},
                              {"", "layers of the cube that they cover", "robots.ARM.fingers"});
  const int layers = own == kAsGiven ? given : own;
  if (layers == 0) return {};
  return layers == 1 ? Fingers::one_layer : Fingers::two_layers;
}

void read_pads(const Config& t, GripperBodyParameters& p) {
  const char* const none = "none";
  p.friction =
      t.number("friction", p.friction, {0, 3}, {"", "of the pads, times that of the stickers", none});
  p.palm_friction = t.number("palm_friction", p.palm_friction, {0, 3},
                             {"", "of the palm, times that of the stickers", none});
  p.pad_stiffness =
      t.number("stiffness", p.pad_stiffness, {1e4, 2e6}, {"N/m", "of a pad, all its points together", none});
  p.palm_stiffness = t.number("palm_stiffness", p.palm_stiffness, {1e3, 1e6},
                              {"N/m", "of the palm, all its points together", none});
  p.wrist_stiffness = t.number("wrist_stiffness", p.wrist_stiffness, {2e3, 2e5},
                               {"N/m", "of the wrist before the sensor, along each axis", none});
}

/// The faces' friction, and what is wrong with them.
void read_faces(const Config& t, FaceFrictionSpread& faces) {
  const char* const none = "none";
  faces.mean.breakaway = t.number("breakaway", faces.mean.breakaway, {0.1, 50},
                                  {"N m", "of a face that leaves its seat, in the mean", none});
  faces.mean.kinetic =
      t.number("kinetic", faces.mean.kinetic, {0, 50}, {"N m", "of a face on its way, in the mean", none});
  faces.jam = t.number("jam", faces.jam, {0, 50}, {"N m", "largest jam of a face", none});
  faces.mean.jam_direction =
      t.choice("jam_direction", 0, {{"both", 0}, {"clockwise", -1}, {"counterclockwise", 1}},
               {"", "in which faces jam", none});
  faces.mean.jam_loosening =
      t.number("jam_loosening", 0, {0, 1}, {"", "share that a jam loses each time the face leaves it", none});
  const double scale =
      t.number("face_friction_scale", 1, {0.05, 20}, {"", "of breakaway, kinetic and jam", none});
  for (double* const each : {&faces.mean.breakaway, &faces.mean.kinetic, &faces.jam}) *each *= scale;
}

/// By how much the cube is another, or held otherwise, than it should be.
void read_errors(const Config& t, CubeParameters& p) {
  const double more = t.number("size_error", 0, {-0.002, 0.002},
                               {"m", "true edge less the believed one; the palm stays on its face", "57 mm"});
  p.edge += more;
  p.T_EC.p.z() += more / 2;
  p.mass = t.number("mass", p.mass, {0.02, 1}, {"kg", "of the cube", "none"});
  p.friction = t.number("friction", p.friction, {0, 2}, {"", "of the stickers, times that of a pad", "none"});
  const Pose error =
      read_displacement(t.section("place_error"), "true place of the cube in the hand's believed one",
                        "cube.facing, cell.cube.facing");
  if (std::abs(error.p.y()) > kMostInJaws)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("sim.cube.place_error.y: from jaw to jaw the cube cannot be farther off than {} m",
                    kMostInJaws));
  p.T_EC.p += error.p;
  if (!is_none(error)) p.T_EC.R = error.R * p.T_EC.R;
}

}  // namespace

void read_fingers(const Config& config, const std::string& key, ArmParameters& arm) {
  const auto fingers = fingers_of(config, key);
  if (fingers && !arm.jaws)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("{0}robots.{1}.fingers: they are those of a gripper, and {1} has none",
                                 layers_given(config, key) == 0 ? "sim." : "", key),
                     fmt::format("give robots.{}.gripper = \"two_jaw\", too", key));
  if (fingers) {
    arm.gripper = gripper_body(cube::gripper_with(*fingers));
    read_pads(config.section("sim.pads"), *arm.gripper);
  }
  if (arm.jaws)
    arm.jaws->start = config.section("robots." + key).number("jaws", arm.jaws->start, {0.053, 0.09}, "m");
}

std::optional<CubeParameters> read_cube(const Config& config, const std::vector<std::string>& arms) {
  const Config t = config.section("cube");
  const std::string holder = t.text("held_by", "");
  if (holder.empty()) return {};
  const auto found = std::ranges::find(arms, holder);
  if (found == arms.end()) refuse("held_by: there is no arm " + holder);

  const auto fingers = fingers_of(config, holder);
  if (!fingers) refuse(fmt::format("held_by: {} has no fingers to hold it", holder));

  CubeParameters p;
  p.held_by = static_cast<int>(found - arms.begin());
  p.state = cube::read_given_cube(config);
  p.faces.seed = cube::read_cube_seed(config);
  const auto names = cube::face_names();
  const Face facing = t.choice("facing", Face::U, std::span(std::as_const(names)));
  p.T_EC = cube::cube_in_hand(*fingers, facing);
  const Config truth = config.section("sim.cube");
  read_faces(truth, p.faces);
  read_errors(truth, p);
  return p;
}

}  // namespace mrroc::sim
