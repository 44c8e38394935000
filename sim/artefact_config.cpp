#include "sim/artefact_config.hpp"

#include <fmt/core.h>

#include "base/artefact.hpp"
#include "sim/errors.hpp"

namespace mrroc::sim {

std::optional<ArtefactParameters> read_true_artefact(const Config& config) {
  const auto told = read_artefact(config);
  if (!told) return {};
  const Pose error =
      read_displacement(config.section("sim.artefact.place_error"), "true balls in the believed place",
                        "artefact.place", {.shift = 0.5, .turn = 0.5});
  const Pose T_UA = displaced(told->T_UA, error);
  const Config truth = config.section("sim.artefact");
  ArtefactParameters p;
  p.diameter =
      truth.number("diameter", told->diameter, {0.01, 0.2}, {"m", "of each ball", "artefact.diameter"});
  const auto errors =
      truth.list("ball_errors", std::vector<double>{}, {-0.05, 0.05},
                 {"m", "x y z of each ball, true less believed, in the artefact's frame; empty: none",
                  "artefact.balls"});
  if (!errors.empty() && errors.size() != 3 * told->balls.size())
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("sim.artefact.ball_errors: {} balls have {} numbers, but {} are given",
                                 told->balls.size(), 3 * told->balls.size(), errors.size()));
  for (std::size_t k = 0; k < told->balls.size(); ++k) {
    Vector3 ball = told->balls[k];
    if (!errors.empty()) ball += Vector3::Map(&errors[3 * k]);
    p.balls.push_back(T_UA * ball);
  }
  return p;
}

}  // namespace mrroc::sim
