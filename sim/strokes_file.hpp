// Reads from a file what the operator's hand draws, or along which it leads through the air.
#pragma once
#include <filesystem>
#include <vector>

#include "sim/hand.hpp"

namespace mrroc::sim {

/// Reads rows `stroke,t,x,y` [mm] under one line of headings; t does not matter.
/// @param file  empty: no strokes
/// @throws FaultError bad_drawing that names file and line
std::vector<Polyline> read_strokes(const std::filesystem::path& file);

/// @return whether a file has the headings of a track, `t,x,y,z`; false when it cannot be read
[[nodiscard]] bool is_hand_track(const std::filesystem::path& file);

/// Reads rows `t,x,y,z` [s], [mm] in sheet coordinates, z above the paper, under one line of headings.
/// @throws FaultError bad_drawing that names file and line: no number, a time that does not grow, no row
HandTrack read_hand_track(const std::filesystem::path& file);

}  // namespace mrroc::sim
