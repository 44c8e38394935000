#include "ui_cli/panel.hpp"

#include <fmt/format.h>

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
    case 'x':
      return OperatorOrder::stop;
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
    const OperatorOrder order = *asks_;
    asks_.reset();
    if (key == 'y' || key == 'Y')
      give(order, now);
    else
      notice(order == OperatorOrder::stop ? "not stopped" : "not triggered", Style::plain, now);
  } else if (view_.help) {
    view_.help = false;
  } else if (key == 'q' || key == kControlC) {
    leaving_ = true;
  } else if (key == '?' || key == 'h') {
    view_.help = true;
  } else if (const auto order = order_of(key)) {
    ask_or_give(*order, now);
  }
}

void Panel::ask_or_give(OperatorOrder order, Clock::time_point now) {
  const auto& s = view_.snapshot;
  if (s && s->state >= TaskState::ending) {
    notice("the task is over; q leaves", Style::plain, now);
  } else if (order == OperatorOrder::stop) {
    asks_ = order;
    notice("stop the task for good? y/n", Style::warning, now);
  } else if (order == OperatorOrder::trigger && s && s->waits_for_trigger && !s->early.empty()) {
    asks_ = order;
    notice(s->early + "; trigger all the same? y/n", Style::warning, now);
  } else {
    give(order, now);
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
  } catch (const FaultError& e) {
    notice(std::string(e.what()).append("; ").append(e.remedy()), Style::bad, now);
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
    shown.notice = {"the task has ended; its files are in " + shown.snapshot->run_folder, Style::good};
  return lay_out(shown, size);
}

}  // namespace mrroc::ui
