#include "base/table_config.hpp"

namespace mrroc {

TableDescription read_table(const Config& config) {
  const Config t = config.section("table");
  TableDescription d;
  d.distance = t.number("distance", d.distance, TableBounds::kDistance, "m");
  d.height = t.number("height", d.height, TableBounds::kHeight, "m");
  d.stiffness = t.number("stiffness", d.stiffness, TableBounds::kStiffness, "N/m");
  d.damping_ratio = t.number("damping_ratio", d.damping_ratio, TableBounds::kDampingRatio, "s");
  d.friction = t.number("friction", d.friction, TableBounds::kFriction);
  return d;
}

}  // namespace mrroc
