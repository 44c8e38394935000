// Reads the balls by which a cell is calibrated from a configuration.
#pragma once
#include <optional>

#include "base/config.hpp"
#include "sim/artefact.hpp"

namespace mrroc::sim {

/// Reads [artefact], what is told (base/artefact.hpp), and [sim.artefact], what is true: place_error, by which all
/// of it stands elsewhere, ball_errors, by which each ball does, and diameter.
/// @return nothing: there is no artefact
/// @throws ConfigError; FaultError bad_configuration
[[nodiscard]] std::optional<ArtefactParameters> read_true_artefact(const Config& config);

}  // namespace mrroc::sim
