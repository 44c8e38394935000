#include "sim/cube_config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/cube_cell.hpp"
#include "tasks/rubik/cube/facelets.hpp"
#include "tasks/rubik/cube/move.hpp"

namespace mrroc::sim {
namespace {

using rubik::Face;

constexpr double kMostInJaws = 0.001;  // that a pad may be pressed into a sticker at the beginning [m]

[[noreturn]] void refuse(const std::string& what) {
  throw FaultError(FaultCode::bad_configuration, "cube: " + what);
}

rubik::Cube read_state(const Config& t, std::uint64_t seed) {
  const std::string state = t.text("state", "");
  const std::string scramble = t.text("scramble", "");
  const int turns = t.integer("random_turns", 0, {0, 100});
  if (!state.empty() + !scramble.empty() + (turns > 0) > 1)
    refuse("give one of state, scramble and random_turns");
  if (!state.empty()) return rubik::cube_from_facelets(state);
  std::mt19937_64 random(seed);
  return rubik::after({}, turns > 0 ? rubik::random_moves(turns, random) : rubik::parse_moves(scramble));
}

}  // namespace

void read_fingers(const Config& robot, ArmParameters& arm) {
  const int layers = robot.choice("fingers", 0, {{"none", 0}, {"one_layer", 1}, {"two_layers", 2}});
  if (layers > 0) arm.gripper = gripper_with(layers == 1 ? Fingers::one_layer : Fingers::two_layers);
  if (arm.jaws) arm.jaws->start = robot.number("jaws", arm.jaws->start, {0.053, 0.09}, "m");
}

std::optional<CubeParameters> read_cube(const Config& config, const std::vector<std::string>& arms) {
  const Config t = config.section("cube");
  const std::string holder = t.text("held_by", "");
  if (holder.empty()) return {};
  const auto found = std::ranges::find(arms, holder);
  if (found == arms.end()) refuse("held_by: there is no arm " + holder);

  CubeParameters p;
  p.held_by = static_cast<int>(found - arms.begin());
  const auto seed =
      static_cast<std::uint64_t>(t.integer<std::int64_t>("seed", config.integer<std::int64_t>("seed", 1)));
  p.state = read_state(t, seed);
  // A cube that was taken apart: no turns lead to it.
  const int twist = t.integer("twist", 0, {0, 2}, "thirds of a turn of the corner at U R F in its place");
  std::uint8_t& corner = p.state.corners[0];
  corner = static_cast<std::uint8_t>(corner / 3 * 3 + (corner % 3 + twist) % 3);
  p.faces.seed = seed;
  p.faces.mean.breakaway = t.number("breakaway", p.faces.mean.breakaway, {0.1, 50}, "N m");
  p.faces.mean.kinetic = t.number("kinetic", p.faces.mean.kinetic, {0, 50}, "N m");
  p.faces.jam = t.number("jam", p.faces.jam, {0, 50}, "N m");
  p.faces.mean.jam_direction =
      t.choice("jam_direction", 0, {{"both", 0}, {"clockwise", -1}, {"counterclockwise", 1}});
  p.faces.mean.jam_loosening =
      t.number("jam_loosening", 0, {0, 1}, "share that a jam loses each time the face leaves it");
  p.friction = t.number("friction", p.friction, {0, 2}, "of the stickers, times that of a pad");
  const Face facing = t.choice(
      "facing", Face::U,
      {{"U", Face::U}, {"R", Face::R}, {"F", Face::F}, {"D", Face::D}, {"L", Face::L}, {"B", Face::B}});
  const bool two = config.section("robots." + holder).text("fingers", "none") == "two_layers";
  p.T_EC = cube_in_hand(two ? Fingers::two_layers : Fingers::one_layer, facing);
  const auto offset =
      t.numbers<3>("offset", std::array{0., 0., 0.}, {-0.1, 0.1}, "m, of the cube in the hand");
  if (std::abs(offset[1]) > kMostInJaws)
    refuse(fmt::format("offset: along y, from jaw to jaw, the cube cannot be farther off than {} m",
                       kMostInJaws));
  p.T_EC.p += Vector3(offset[0], offset[1], offset[2]);
  return p;
}

}  // namespace mrroc::sim
