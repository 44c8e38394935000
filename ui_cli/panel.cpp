#include "ui_cli/panel.hpp"

#include <fmt/format.h>

#include "ui_cli/failure.hpp"

namespace mrroc::ui {
namespace {

using namespace std::chrono_literals;

constexpr auto kNoticeStays = 8s;
constexpr std::size_t kMessages = MessageLog::kKept;
constexpr int kControlC = 3;

std::optional<OperatorOrder> order_of(int key) {
  switch (key) {
    case 's':
      return OperatorOrder::start;
    case 'p':
      return OperatorOrder::pause;
    case 'r':
      return OperatorOrder::resume;
    case 't':
      return OperatorOrder::trigger;
    default:
      return std::nullopt;
  }
}

}  // namespace

Panel::Panel(link::Bus& bus, Client& client, Glyphs glyphs, Clock::time_point now)
    : client_(client), log_(bus, client.session().name), heard_(now), noticed_(now) {
  view_.session = client.session().name;
  view_.glyphs = glyphs;
}

void Panel::key(int key, Clock::time_point now) {
  if (asks_) {
    asks_ = false;
    if (key == 'y' || key == 'Y')
      give(OperatorOrder::stop, now);
    else
      notice("not stopped", Style::plain, now);
  } else if (key == 'q' || key == kControlC) {
    leaving_ = true;
  } else if (key == 'x') {
    asks_ = true;
    notice("stop the task for good? y/n", Style::warning, now);
  } else if (const auto order = order_of(key)) {
    give(*order, now);
  }
}

void Panel::give(OperatorOrder order, Clock::time_point now) {
  if (client_.pending()) {
    notice("the last order has not been answered yet; repeat the key then", Style::warning, now);
    return;
  }
  client_.begin(order, now);
  notice(fmt::format("{} ...", to_string(order)), Style::plain, now);
  update(now);
}

void Panel::update(Clock::time_point now) {
  try {
    if (const auto answer = client_.poll(now)) {
      const std::string order(to_string(answer->order));
      if (answer->accepted)
        notice(answer->text.empty() ? order + " accepted" : answer->text, Style::good, now);
      else
        notice(order + " refused: " + answer->text, Style::warning, now);
    }
  } catch (const Failure& e) {
    notice(std::string(e.what()) + "; " + e.remedy(), Style::bad, now);
  }
  if (client_.news() == news_) return;
  news_ = client_.news();
  heard_ = now;
  view_.snapshot = client_.status();
  view_.forces.add(*view_.snapshot);
  log_.follow(*view_.snapshot);
}

void Panel::notice(std::string text, Style style, Clock::time_point now) {
  view_.notice = {std::move(text), style};
  noticed_ = now;
}

Canvas Panel::picture(Size size, Clock::time_point now) {
  if (!asks_ && now - noticed_ > kNoticeStays) view_.notice = {};
  view_.silence = std::chrono::duration<double>(now - heard_).count();
  view_.messages = log_.newest(kMessages);
  View shown = view_;
  if (shown.notice.text.empty() && shown.snapshot && shown.snapshot->state == TaskState::ended)
    shown.notice = {"the task has ended; q leaves", Style::good};
  return lay_out(shown, size);
}

}  // namespace mrroc::ui
