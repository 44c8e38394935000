#include "sim/cube_config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/cube/cube_config.hpp"

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
                              {{"as_given", kAsGiven}, {"none", 0}, {"one_layer", 1}, {"two_layers", 2}});
  const int layers = own == kAsGiven ? given : own;
  if (layers == 0) return {};
  return layers == 1 ? Fingers::one_layer : Fingers::two_layers;
}

}  // namespace

void read_fingers(const Config& config, const std::string& key, ArmParameters& arm) {
  const auto fingers = fingers_of(config, key);
  if (fingers && !arm.jaws)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("{0}robots.{1}.fingers: they are those of a gripper, and {1} has none",
                                 layers_given(config, key) == 0 ? "sim." : "", key),
                     fmt::format("give robots.{}.gripper = \"two_jaw\", too", key));
  if (fingers) arm.gripper = gripper_body(cube::gripper_with(*fingers));
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
  p.faces.mean.breakaway = t.number("breakaway", p.faces.mean.breakaway, {0.1, 50}, "N m");
  p.faces.mean.kinetic = t.number("kinetic", p.faces.mean.kinetic, {0, 50}, "N m");
  p.faces.jam = t.number("jam", p.faces.jam, {0, 50}, "N m");
  p.faces.mean.jam_direction =
      t.choice("jam_direction", 0, {{"both", 0}, {"clockwise", -1}, {"counterclockwise", 1}});
  p.faces.mean.jam_loosening =
      t.number("jam_loosening", 0, {0, 1}, "share that a jam loses each time the face leaves it");
  p.friction = t.number("friction", p.friction, {0, 2}, "of the stickers, times that of a pad");
  const auto names = cube::face_names();
  const Face facing = t.choice("facing", Face::U, std::span(std::as_const(names)));
  p.T_EC = cube::cube_in_hand(*fingers, facing);
  const auto offset =
      t.numbers<3>("offset", std::array{0., 0., 0.}, {-0.1, 0.1}, "m, of the cube in the hand");
  if (std::abs(offset[1]) > kMostInJaws)
    refuse(fmt::format("offset: along y, from jaw to jaw, the cube cannot be farther off than {} m",
                       kMostInJaws));
  p.T_EC.p += Vector3(offset[0], offset[1], offset[2]);
  return p;
}

}  // namespace mrroc::sim
