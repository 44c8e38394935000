// What a run is judged by: how the slave follows in the air, what the hand feels of what the slave exerts, and energies.
#pragma once
#include "mp/figure_table.hpp"
#include "tasks/haptic/config.hpp"
#include "tasks/haptic/record.hpp"

namespace mrroc::haptic {

/// How the slave follows the master through the air.
struct Following {
  double
      lag{};  ///< of the slave's way behind that of the master, beyond the delay of the channel [macrosteps]
  double rms{};  ///< of their distance, the delay of the channel taken away [m]
};

/// @return of the rows until the slave first meets something; NaN without a motion
[[nodiscard]] Following following(const HapticRecord& record, const Law& law);

/// @return rms of the mean of what the hand feels less that of what the slave exerts over rms of the latter [%], of all stretches of
///         0.6 s in which the slave presses and neither moves; NaN
///         when it never does
[[nodiscard]] double reflection_error(const HapticRecord& record, const Law& law);

/// @return smallest energy that hand and surroundings together have given to the arms, in the scale of the slave [J]
[[nodiscard]] double least_given(const HapticRecord& record, const Law& law);

/// @return all of a run, see README.md. Of a channel without delay and losses more is wanted
[[nodiscard]] mp::TaskFigures figures(const HapticRecord& record, const Law& law);

}  // namespace mrroc::haptic
