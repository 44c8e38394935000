// Reads the receptors' target from the configuration. The simulator puts the same object there unless
// [object] says otherwise.
//
//   [chessboard]                    # the board: inner corners along a row (odd) and a column (even), edge of a square
//   columns = 9
//   rows = 6
//   square = 0.025
//   [apriltag]                      # the tag of the family 36h11: its number, edge of the black border
//   id = 0
//   edge = 0.1
#pragma once
#include "base/config.hpp"
#include "base/target/board.hpp"
#include "base/target/tag.hpp"

namespace mrroc {

/// @return `chessboard.columns`, `.rows`, `.square`, `.margin` [m]; by default kBoard
/// @throws ConfigError  also when the board looks the same upside down: two odd or two even counts
Board read_board(const Config& config);

/// @return `apriltag.id`, `.edge`, `.white` (width of the light margin) [m]; by default kTag
/// @throws ConfigError
Tag read_tag(const Config& config);

}  // namespace mrroc
