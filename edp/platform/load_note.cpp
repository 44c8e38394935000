#include "edp/platform/load_note.hpp"

#include <fmt/core.h>

#include "edp/platform/wheel_load.hpp"

namespace mrroc::edp {

std::string LoadNote::next(const StageCollector& sensors) {
  if (told_ || !sensors.loads_wrong()) return {};
  told_ = true;
  const std::string told = sensors.told_load()
                               ? fmt::format("tell {:.0f} N in all", total_load(*sensors.told_load()))
                               : std::string("are silent");
  return fmt::format(
      "the load cells {}, of {:.0f} N that were weighed: the platform goes on with the loads at rest", told,
      total_load(sensors.static_load()));
}

}  // namespace mrroc::edp
