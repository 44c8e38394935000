// The full-screen view as a pure function of what is to be seen.
#pragma once
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ui_cli/canvas.hpp"
#include "ui_cli/message_log.hpp"
#include "ui_cli/snapshot.hpp"
#include "ui_cli/strip_chart.hpp"

namespace mrroc::ui {

/// A line for the operator above the keys.
struct Notice {
  std::string text;
  Style style{Style::plain};
};

/// The last forces of the agents, one per status.
class ForceHistory {
 public:
  /// Samples kept per agent: more than a terminal has columns.
  static constexpr std::size_t kKept = 600;

  void add(const Snapshot& s);
  /// @return F_z [N], oldest first; empty for an agent that is not known
  [[nodiscard]] std::vector<double> F_z(const std::string& agent) const;

 private:
  std::map<std::string, std::deque<double>> F_z_;
};

/// Everything that is to be seen.
struct View {
  std::string session;
  std::optional<Snapshot> snapshot;  ///< nothing: no status has come yet
  double silence{};                  ///< [s] since the last status
  ForceHistory forces;
  std::vector<Message> messages;  ///< oldest first
  Notice notice;
  bool help{};  ///< what the keys do, instead of the task
  Glyphs glyphs{Glyphs::ascii};
};

/// A task tells its status ten times a second; silence beyond this is shown [s].
inline constexpr double kSilence = 2;

/// @return whether the task would accept the order now, as far as its status tells
[[nodiscard]] bool sensible(OperatorOrder order, const Snapshot& s);

/// Made for 80 x 24 and more. On a smaller screen charts go first, then messages, processes and the right
/// ends of lines; the state, the notice and the keys stay. Any size is allowed.
[[nodiscard]] Canvas lay_out(const View& view, Size size);

}  // namespace mrroc::ui
