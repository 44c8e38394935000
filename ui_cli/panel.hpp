// The full-screen view without a screen: makes a picture of keys and status.
#pragma once
#include <memory>
#include <optional>

#include "base/operator.hpp"
#include "ui_cli/client.hpp"
#include "ui_cli/layout.hpp"
#include "ui_cli/manual_link.hpp"
#include "ui_cli/manual_page.hpp"
#include "ui_cli/message_log.hpp"

namespace mrroc::ui {

/// The operator's actions in the full-screen view. Looks at no clock: every function is told the time, which
/// must not decrease.
class Panel {
 public:
  /// @param bus      that of the client; both must outlive the panel
  /// @param session  that hints have to name, see command_hint(); empty: none
  Panel(link::Bus& bus, Client& client, Glyphs glyphs, Clock::time_point now, std::string session = {});

  /// A key: s start, p pause, r resume, t trigger (asks for y when it comes early), x stop (asks for y), e emergency
  /// stop (asks nothing; Ctrl-E too, also where an e is a letter of a line being typed), c what the charts show, m the
  /// page of manual operation, ? help, q leave. Others do nothing; while the panel asks, any other than y and e means
  /// no; any key ends the help, and does nothing else but for e. On the page of manual operation its own keys come
  /// first, see ManualPage, and r asks for y.
  void key(int key, Clock::time_point now);
  /// Takes what the client has heard, and sends what has to be sent. Call it often.
  void update(Clock::time_point now);

  /// @return whether the operator wants to leave
  [[nodiscard]] bool leaving() const { return leaving_; }
  /// @param size  of the terminal, any  @return what it is to show now
  [[nodiscard]] Canvas picture(Size size, Clock::time_point now);

 private:
  void ask_or_give(OperatorOrder order, Clock::time_point now);
  void give(OperatorOrder order, Clock::time_point now);
  void notice(std::string_view text, Style style, Clock::time_point now);
  void open_manual(Clock::time_point now);
  /// @return whether the key belongs to the page of manual operation
  bool manual_key(int key, Clock::time_point now);
  void update_manual(Clock::time_point now);

  link::Bus& bus_;
  Client& client_;
  std::string session_;  // in hints
  MessageLog log_;
  View view_;
  std::int64_t news_{};
  Clock::time_point heard_;
  Clock::time_point noticed_;
  std::optional<OperatorOrder> asks_;  // whether this order is meant
  bool leaving_{};
  std::unique_ptr<ManualPage> page_;  // made when it is first opened
  std::unique_ptr<ManualLink> instructions_;
};

}  // namespace mrroc::ui
