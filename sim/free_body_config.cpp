#include "sim/free_body_config.hpp"

#include <fmt/core.h>

#include <array>

namespace mrroc::sim {

void read_palm(const Config& config, const std::string& key, ArmParameters& arm) {
  if (!config.section("robots." + key).flag("palm", false)) return;
  if (arm.gripper)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("robots.{}: it has fingers and a palm; it can have one of them", key),
                     fmt::format("leave out robots.{0}.fingers or robots.{0}.palm", key));
  const Config t = config.section("sim.palm");
  PalmParameters p;
  p.width = t.number("width", p.width, {0.05, 0.3}, {"m", "edge of a palm", "none"});
  p.friction = t.number("friction", p.friction, {0, 2},
                        {"", "of the palms, times that of the body", "free_body.friction"});
  p.stiffness =
      t.number("stiffness", p.stiffness, {500, 5e4}, {"N/m", "of a palm, all its points together", "none"});
  p.relaxation =
      t.number("relaxation", p.relaxation, {0, 0.1}, {"s", "damping of a palm over its stiffness", "none"});
  arm.palm = p;
}

std::optional<FreeBodyParameters> read_true_body(const Config& config) {
  const auto told = read_free_body(config);
  if (!told) return {};
  FreeBodyParameters p;
  static_cast<FreeBodyDescription&>(p) = *told;
  const Config t = config.section("sim.free_body");
  p.size = t.number("size", told->size, {0.06, 0.4}, {"m", "diameter or edge of the body", "free_body.size"});
  p.mass = t.number("mass", told->mass, {0.02, 20}, {"kg", "of the body", "free_body.mass"});
  p.friction = t.number("friction", told->friction, {0, 2},
                        {"", "of the body, times that of the palms", "free_body.friction"});
  p.patch =
      t.number("patch", p.patch, {0, 0.05}, {"m", "radius in which a palm lies against a ball", "none"});
  const auto offset = t.numbers<3>("offset", std::array{0., 0., 0.}, {-0.1, 0.1},
                                   {"m", "by which body and pedestal stand elsewhere", "free_body.pedestal"});
  p.pedestal += Vector3(offset[0], offset[1], offset[2]);
  return p;
}

}  // namespace mrroc::sim
