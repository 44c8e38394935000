#include "sim/artefact_config.hpp"

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
  ArtefactParameters p;
  p.diameter = told->diameter;
  for (const Vector3& ball : told->balls) p.balls.push_back(T_UA * ball);
  return p;
}

}  // namespace mrroc::sim
