#include "base/free_body.hpp"

#include <array>

namespace mrroc {

std::optional<FreeBodyDescription> read_free_body(const Config& config) {
  const Config t = config.section("free_body");
  const auto shape = t.choice("shape", std::optional<FreeBodyShape>(),
                              {{"none", std::optional<FreeBodyShape>()},
                               {"ball", std::optional(FreeBodyShape::ball)},
                               {"box", std::optional(FreeBodyShape::box)}});
  if (!shape) return {};
  FreeBodyDescription d;
  d.shape = *shape;
  d.size = t.number("size", d.size, {0.08, 0.3}, "m, diameter or edge");
  d.mass = t.number("mass", d.mass, {0.05, 10}, "kg");
  d.friction = t.number("friction", d.friction, {0.05, 2}, "on rubber palms");
  const auto top = t.numbers<3>("pedestal", std::array{d.pedestal.x(), d.pedestal.y(), d.pedestal.z()},
                                {-10, 10}, "m, middle of its upper side in the world");
  d.pedestal = {top[0], top[1], top[2]};
  return d;
}

}  // namespace mrroc
