// Replays a run from its log: the same transition functions must decide the same from the same images.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {

/// What a replay has found.
struct ReplayResult {
  std::int64_t macrosteps{};   ///< decisions of all agents that were recomputed
  std::int64_t differences{};  ///< of these, the ones that differ from the log in any bit
  std::string first;           ///< the first difference: agent, macrostep, channel; empty if there is none
};

/// Recomputes every y_c of a run from its logged x_c: the coordinator's orders and the agents' commands and reports.
/// @param log         events.lcmlog of a run
/// @param parameters  of the run
/// @param taught      the recording that the run had loaded; empty: it was taught in the run
/// @throws FaultError bad_log
ReplayResult replay(const std::filesystem::path& log, const Parameters& parameters, const Recording& taught);

}  // namespace mrroc::drawing
