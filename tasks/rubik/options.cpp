#include "tasks/rubik/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/command_line.hpp"
#include "base/fault.hpp"

namespace mrroc::rubik {

void add_cube_options(CommandLine& line, CubeOptions& o) {
  const Option scramble =
      line.option("--scramble", o.scramble,
                  "Turns that scramble the cube, such as \"R U' F2\"; \"\": none (default: 20 by the seed)");
  line.option("--state", o.state, "The cube as 54 facelets, U R F D L B").excludes(scramble);
  line.option("--eyes", o.eyes, "How the state becomes known: camera (default), or none: it is told")
      .one_of({"camera", "none"});
}

std::vector<std::string> cube_settings(const CubeOptions& o) {
  if (!o.scramble && !o.state) return {};
  if (o.state && o.state->empty())
    throw FaultError(FaultCode::bad_usage, "--state is empty", "give 54 facelets: U R F D L B, nine each");
  return {fmt::format("cube.scramble=\"{}\"", o.scramble.value_or("")),
          fmt::format("cube.state=\"{}\"", o.state.value_or("")), "cube.random_turns=0"};
}

void complete_cube(Config& config) {
  constexpr std::array kKeys{"cube.scramble", "cube.state", "cube.random_turns"};
  if (std::ranges::none_of(kKeys, [&](const char* key) { return config.has(key); }))
    config.set("cube.random_turns=20");
}

}  // namespace mrroc::rubik
