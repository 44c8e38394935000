// Draws the full-screen view as a pure function of its contents.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ui_cli/canvas.hpp"
#include "ui_cli/history.hpp"
#include "ui_cli/message_log.hpp"
#include "ui_cli/snapshot.hpp"
#include "ui_cli/strip_chart.hpp"

namespace mrroc::ui {

/// A line for the operator above the keys.
struct Notice {
  std::string text;           ///< in as many lines as it needs
  Style style{Style::plain};  ///< good, warning or bad, by what it says
};

/// Everything that is to be seen.
struct View {
  std::string session;               ///< its name
  std::optional<Snapshot> snapshot;  ///< nothing: no status has come yet
  double silence{};                  ///< [s] since the last status
  History history;                   ///< of all agents, for the charts
  std::size_t chart{};  ///< what the charts show: the place in quantities_of(), counted on from its end
  std::vector<Message> messages;     ///< oldest first
  Notice notice;                     ///< empty text: there is none
  bool help{};                       ///< what the keys do, instead of the task
  const class ManualPage* manual{};  ///< this page instead of agents and processes; none: the task
  Glyphs glyphs{Glyphs::ascii};      ///< of the charts, as the terminal can show them
};

/// The task whose arms can be moved by hand.
inline constexpr std::string_view kManualTask = "manual";

/// A task tells its status ten times a second; silence beyond this is shown [s].
inline constexpr double kSilence = 2;

/// @return whether the task would accept the order now, as far as its status tells
[[nodiscard]] bool sensible(OperatorOrder order, const Snapshot& s);

/// Made for 80 x 24 and more. Processes that are well are only counted where charts would find no room; on a smaller
/// screen charts go first, then messages, processes and the right ends of lines. The state, the notice and the keys
/// stay, of these the emergency stop and the help to the end. Any size is allowed.
[[nodiscard]] Canvas lay_out(const View& view, Size size);

}  // namespace mrroc::ui
