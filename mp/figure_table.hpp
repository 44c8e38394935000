// The figures of a run as a table for people: the meaning of each, and whether it is within its bounds.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mp/run_folder.hpp"

namespace mrroc::mp {

/// Description of a figure, known beforehand.
struct FigureInfo {
  std::string_view key;                                  ///< in summary.json
  std::string_view words;                                ///< what it is, for a person
  std::string_view unit;                                 ///< such as "mm"; empty: a number
  double low{-std::numeric_limits<double>::infinity()};  ///< wanted at least
  double high{std::numeric_limits<double>::infinity()};  ///< wanted at most
  bool always{};  ///< it is told and judged also when the run did not come to its end
};

/// @return the description of the figure with that key, or null: there is none
[[nodiscard]] const FigureInfo* info_of(std::string_view key, std::span<const FigureInfo> known);

/// A figure and what it means, in the order of the table.
struct TaskFigure {
  FigureInfo info;  ///< what it means
  Figure value;     ///< in the unit of info; one number, or one per arm
};
using TaskFigures = std::vector<TaskFigure>;  ///< in the order of the table

/// @return the value of the figure with that key
/// @throws std::out_of_range  there is none
[[nodiscard]] const Figure& figure(const TaskFigures& figures, std::string_view key);

/// @return what is wanted, such as "<= 0.5", "1 +- 0.05" or "0"; empty when nothing is
[[nodiscard]] std::string wanted(const FigureInfo& info);

/// @return what is wanted of those figures of which something is wanted, by key, for summary.json
[[nodiscard]] std::map<std::string, FigureBounds> bounds_of(const Figures& figures,
                                                            std::span<const FigureInfo> known);

/// Comparison of a run's figures with their bounds.
struct FigureVerdict {
  std::size_t judged{};  ///< figures of which something is wanted
  /// Those that are not as wanted, such as "copy_rms_mm 29.1 (wanted <= 0.5)". A number that is not finite was not
  /// measured, which is not as wanted: "force_N not measured (wanted 1 +- 0.05)".
  std::vector<std::string> missed;
};

/// @param figures  of a run that is done; one that does not apply to it is not among them
/// @param known  what is wanted
[[nodiscard]] FigureVerdict judge(const std::map<std::string, Figure>& figures,
                                  std::span<const FigureInfo> known);

/// @return the verdict in one line; empty when nothing was judged
[[nodiscard]] std::string to_string(const FigureVerdict& verdict);

/// @param figures  of the run; those without a row in `known` come last, under their keys. A figure that is not a
/// finite number could not be measured and is shown as "-"
/// @param known    in the order of the table
/// @param columns  headings for figures with several numbers; a single number stands in the first column
/// @param judged   whether the run came to its end; if not, figures are only shown, but for FigureInfo::always
/// @return lines, each ended by a line feed; the last column says "ok" or "NOT OK" where something is wanted
[[nodiscard]] std::string figure_table(const std::map<std::string, Figure>& figures,
                                       std::span<const FigureInfo> known,
                                       std::span<const std::string_view> columns, bool judged = true);

}  // namespace mrroc::mp
