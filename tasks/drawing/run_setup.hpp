// The settings of a run, from its options and its configuration.
#pragma once
#include <filesystem>

#include "base/config.hpp"
#include "tasks/drawing/hand_operator.hpp"
#include "tasks/drawing/images.hpp"
#include "tasks/drawing/input.hpp"

namespace mrroc::drawing {

/// All of it.
struct RunSetup {
  Input input;    ///< what is drawn
  Parameters k;   ///< of the coordinator
  HandPlan plan;  ///< of the simulated operator
};

/// Reads everything that the task will read of its configuration and of files.
/// @param checked       folder of the run that is checked: its recording counts, not the options; empty: none is
/// @param gives_orders  the simulated operator gives start and triggers
/// @throws ConfigError; FaultError bad_usage, bad_drawing, bad_recording
[[nodiscard]] RunSetup read_setup(const InputOptions& options, const Config& config,
                                  const std::filesystem::path& checked, bool gives_orders);

}  // namespace mrroc::drawing
