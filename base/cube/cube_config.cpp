#include "base/cube/cube_config.hpp"

#include <random>

#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"
#include "base/fault.hpp"

namespace mrroc::cube {
namespace {

Cube read_state(const Config& t, std::uint64_t seed) {
  const std::string state = t.text("state", "");
  const std::string scramble = t.text("scramble", "");
  const int turns = t.integer("random_turns", 0, {0, 100});
  if (!state.empty() + !scramble.empty() + (turns > 0) > 1)
    throw FaultError(FaultCode::bad_configuration, "cube: give one of state, scramble and random_turns");
  if (!state.empty()) return cube_from_facelets(state);
  std::mt19937_64 random(seed);
  return after({}, turns > 0 ? random_moves(turns, random) : parse_moves(scramble));
}

}  // namespace

std::vector<std::pair<std::string_view, Face>> face_names() {
  return {{"U", Face::U}, {"R", Face::R}, {"F", Face::F}, {"D", Face::D}, {"L", Face::L}, {"B", Face::B}};
}

std::uint64_t read_cube_seed(const Config& config) {
  return static_cast<std::uint64_t>(
      config.integer<std::int64_t>("cube.seed", config.integer<std::int64_t>("seed", 1)));
}

Cube read_given_cube(const Config& config) {
  const Config t = config.section("cube");
  Cube cube = read_state(t, read_cube_seed(config));
  // A cube that was taken apart: no turns lead to it.
  const int twist = t.integer("twist", 0, {0, 2}, "thirds of a turn of the corner at U R F in its place");
  std::uint8_t& corner = cube.corners[0];
  corner = static_cast<std::uint8_t>(corner / 3 * 3 + (corner % 3 + twist) % 3);
  return cube;
}

}  // namespace mrroc::cube
