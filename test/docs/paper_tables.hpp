// Tables 1-4 of MS and 4-8 of MG as they are printed, and docs/tables.md, which shows them beside what the programs
// command.
#pragma once
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/axis_command.hpp"

namespace mrroc::test {

/// Rows x, y, z, ax, ay, az as printed: b, F_d, v_d, I, B with blanks between them; "-" is irrelevant.
using PrintedRows = std::array<std::string, 6>;

/// The command of an arm in one behaviour.
struct Commanded {
  TaskFrameCommand frame;
  std::optional<double> jaws;  ///< dg per macrostep [m]; nothing: the task has no jaws
};

/// A printed table and the row of the task's table that stands for it.
struct PaperTable {
  std::string name;          ///< "MG 4(a)"
  std::string what;          ///< what it is for, with m and the arm
  std::string printed_jaws;  ///< dg; empty: the paper's table has none
  PrintedRows printed;
  std::string source;  ///< where the code has it
  std::function<Commanded()> code;
  std::map<std::string, std::string> notes;  ///< why an axis (or "dg") differs
};

/// @return all tables, in the papers' order
[[nodiscard]] std::vector<PaperTable> paper_tables();

/// @return five columns as PrintedRows have them
[[nodiscard]] std::string written(const AxisCommand& row);

/// @return whether a printed row says the same as the code's; "-" and "node" in the paper say nothing about a number
[[nodiscard]] bool same(const std::string& printed, const AxisCommand& row);

/// @return docs/tables.md
[[nodiscard]] std::string tables_document();

}  // namespace mrroc::test
