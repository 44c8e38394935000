#include "ui_cli/panel.hpp"

#include <fmt/core.h>

#include "base/command_hint.hpp"
#include "ui_cli/keys.hpp"

namespace mrroc::ui {
namespace {

using namespace std::chrono_literals;

constexpr auto kNoticeStays = 8s;
constexpr std::size_t kMessages = MessageLog::kKept;

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

/// A screen that changes its size, an arrow and the like come from curses as keys too; they are no answer to a question.
bool answers(int key) { return (key >= 0 && key < 256) || key == key::kKeypadEnter; }

}  // namespace

Panel::Panel(link::Bus& bus, Client& client, Glyphs glyphs, Clock::time_point now, std::string session)
    : bus_(bus),
      client_(client),
      session_(std::move(session)),
      log_(bus, client.session().name),
      heard_(now),
      noticed_(now) {
  view_.session = client.session().name;
  view_.glyphs = glyphs;
}

void Panel::key(int key, Clock::time_point now) {
  const bool typing = view_.manual && !view_.help && page_->typing();
  if (key == key::kControlE || (key == 'e' && !typing)) {  // before everything that could swallow it
    asks_.reset();
    view_.help = false;
    ask_or_give(OperatorOrder::emergency_stop, now);
  } else if (asks_ && !answers(key)) {  // the question stays
  } else if (asks_) {
    const OperatorOrder order = *asks_;
    asks_.reset();
    if (key == 'y' || key == 'Y')
      give(order, now);
    else
      notice(order == OperatorOrder::stop     ? "not stopped"
             : order == OperatorOrder::resume ? "not resumed"
                                              : "not triggered",
             Style::plain, now);
    const auto other = order_of(key);
    const bool meant =
        !view_.manual || other == OperatorOrder::pause;  // letters may be those of a word there
    if (other && *other != order && meant) ask_or_give(*other, now);
  } else if (view_.help) {
    view_.help = false;
  } else if (view_.manual && key != key::kControlC && manual_key(key, now)) {
    return;
  } else if (key == 'q' || key == key::kControlC) {
    leaving_ = true;
  } else if (key == 'c') {
    ++view_.chart;
  } else if (key == 'm') {
    open_manual(now);
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
  } else if (order == OperatorOrder::resume && view_.manual) {  // the r may be one of a word
    asks_ = order;
    notice("go on after the pause? y/n", Style::warning, now);
  } else if (order == OperatorOrder::trigger && s && s->waits_for_trigger && !s->early.empty()) {
    asks_ = order;
    notice(s->early + "; trigger all the same? y/n", Style::warning, now);
  } else {
    give(order, now);
  }
}

void Panel::give(OperatorOrder order, Clock::time_point now) {
  if (client_.pending() && order != OperatorOrder::emergency_stop) {
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
        notice(answer->code == FaultCode::none ? order + " refused: " + answer->text : answer->text,
               answer->code == FaultCode::none ? Style::warning : Style::bad, now);
    }
  } catch (const FaultError& e) {
    notice(std::string(e.what()).append("; ").append(e.remedy()), Style::bad, now);
  }
  update_manual(now);
  if (client_.news() == news_) return;
  news_ = client_.news();
  heard_ = now;
  view_.snapshot = client_.status();
  view_.history.add(*view_.snapshot);
  log_.follow(*view_.snapshot);
}

void Panel::notice(std::string_view text, Style style, Clock::time_point now) {
  view_.notice = {command_hint(text, session_), style};
  noticed_ = now;
}

void Panel::open_manual(Clock::time_point now) {
  if (!view_.snapshot || view_.snapshot->task != kManualTask) {
    notice("arms are moved by hand in the task `manual`: `./run manual`", Style::warning, now);
    return;
  }
  if (!page_) {
    std::vector<ManualArm> arms = manual_arms(view_.snapshot->run_folder);
    std::vector<std::string> names;
    if (arms.empty())
      for (const AgentView& a : view_.snapshot->agents)
        if (a.effector == EffectorKind::arm) arms.push_back({.name = a.name, .presets = {}});
    for (const ManualArm& a : arms) names.push_back(a.name);
    link::SessionInfo session = client_.session();
    session.id = view_.snapshot->session_id;
    instructions_ = std::make_unique<ManualLink>(bus_, session, names);
    page_ = std::make_unique<ManualPage>(std::move(arms));
  }
  view_.manual = page_.get();
}

bool Panel::manual_key(int key, Clock::time_point now) {
  const ManualDeed deed = page_->key(key);
  if (!deed.known) return false;
  if (deed.leave) view_.manual = nullptr;
  if (!deed.refusal.empty()) notice(deed.refusal, Style::warning, now);
  if (deed.words.empty()) return true;
  if (instructions_->unanswered() && !deed.words.starts_with("stop")) {
    notice("the last instruction has not been answered yet; repeat the key then", Style::warning, now);
    return true;
  }
  instructions_->begin(deed.words, now);
  notice(deed.words + " ...", Style::plain, now);
  update(now);
  return true;
}

void Panel::update_manual(Clock::time_point now) {
  if (!page_) return;
  for (const ManualArm& a : page_->arms())
    if (const auto reading = instructions_->reading(a.name)) page_->show(a.name, *reading);
  try {
    const auto answer = instructions_->poll(now);
    if (!answer) return;
    const bool refused =
        answer->state == InstructionState::refused || answer->state == InstructionState::not_understood;
    const bool bad = refused || answer->state == InstructionState::failed;
    const std::string_view what = refused                                     ? " refused: "
                                  : answer->state == InstructionState::failed ? " failed: "
                                                                              : ": ";
    const std::string text = answer->state == InstructionState::taken ? "is being done" : answer->text;
    const std::size_t numbers = answer->words.find(' ', answer->words.find(' ') + 1);
    // A reason needs the room that the numbers would take.
    notice(fmt::format("{}{}{}", bad ? answer->words.substr(0, numbers) : answer->words, what, text),
           bad                                       ? Style::warning
           : answer->state == InstructionState::done ? Style::good
                                                     : Style::plain,
           now);
  } catch (const FaultError& e) {
    notice(std::string(e.what()).append("; ").append(e.remedy()), Style::bad, now);
  }
}

Canvas Panel::picture(Size size, Clock::time_point now) {
  if (!asks_ && now - noticed_ > kNoticeStays) view_.notice = {};
  view_.silence = std::chrono::duration<double>(now - heard_).count();
  view_.messages = log_.newest(kMessages);
  for (Message& m : view_.messages) m.text = command_hint(m.text, session_);
  View shown = view_;
  if (shown.notice.text.empty() && shown.snapshot && shown.snapshot->state == TaskState::ended)
    shown.notice = {"the task has ended; its files are in " + shown.snapshot->run_folder,
                    shown.snapshot->fault == FaultCode::none ? Style::good : Style::plain};
  if (view_.manual && page_->typing()) shown.notice = {page_->prompt(), Style::heading};
  return lay_out(shown, size);
}

}  // namespace mrroc::ui
