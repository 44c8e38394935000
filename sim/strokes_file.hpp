// Reads the strokes that the operator's hand draws from a file.
#pragma once
#include <filesystem>
#include <vector>

#include "sim/hand.hpp"

namespace mrroc::sim {

/// Reads rows `stroke,t,x,y` [mm] under one line of headings; t does not matter.
/// @param file  empty: no strokes
/// @throws FaultError bad_drawing that names file and line
std::vector<Polyline> read_strokes(const std::filesystem::path& file);

}  // namespace mrroc::sim
