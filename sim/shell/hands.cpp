#include "sim/shell/hands.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "base/msg/finite.hpp"

namespace mrroc::sim {

Hands::Hands(link::Process& process, World& world, const ShellParameters& parameters)
    : world_(world),
      k_(parameters),
      report_out_(process.outbox<hand_report_t>("hand.report")),
      order_in_(process.inbox<hand_order_t>("hand.order")),
      sheets_(static_cast<std::size_t>(world.arms())) {}

void Hands::report(std::int64_t i) {
  hand_report_t report{};
  for (int arm = 0; arm < led_arms(); ++arm) {
    const HandStatus s = world_.hand(arm).status();
    report.done[arm] = s.phase == HandPhase::done;
    report.progress[arm] = s.fraction;
    const auto& ink = world_.ink(arm);
    report.ink_strokes[arm] = ink.empty() ? 0 : ink.back().stroke + 1;
  }
  report_out_->publish(report, i);
}

void Hands::obey_what_has_come(bool paused) {
  while (const hand_order_t* const order = order_in_->next(obeyed_ + 1)) obey(*order, paused);
}

void Hands::obey(const hand_order_t& order, bool paused) {
  obeyed_ = order.header.stamp;
  if (!finite(order)) return;  // a hand goes on with what it does
  for (int arm = 0; arm < led_arms(); ++arm) {
    Hand& hand = world_.hand(arm);
    if (order.new_sheet[arm]) {
      write_sheet(arm);
      world_.new_sheet(arm);
    }
    const auto action = static_cast<HandAction>(order.action[arm]);
    auto& last = actions_[static_cast<std::size_t>(arm)];
    if (action != last) {  // a number that is no action leads nowhere
      last = action;
      if (action == HandAction::release) hand.release();
      if (action == HandAction::lead_along) hand.lead_along(k_.strokes);
      if (action == HandAction::follow && !k_.track.empty()) hand.follow(k_.track);
      if (action == HandAction::push) hand.push({order.x[arm], order.y[arm], order.height[arm]});
      if (action == HandAction::lead_to) hand.lead_to({order.x[arm], order.y[arm]}, order.height[arm]);
    }
    hand.pause(paused);
  }
}

void Hands::release() {
  for (int arm = 0; arm < world_.arms(); ++arm) world_.hand(arm).release();
}

void Hands::write_sheets() {
  for (int arm = 0; arm < world_.arms(); ++arm) write_sheet(arm);
}

void Hands::write_sheet(int arm) {
  if (k_.folder.empty()) return;
  const auto n = sheets_[static_cast<std::size_t>(arm)]++;
  std::ofstream file(k_.folder / fmt::format("{}-sheet-{}.csv", k_.robots[static_cast<std::size_t>(arm)], n));
  file << "stroke,t,x,y\n";
  for (const InkPoint& p : world_.ink(arm))
    file << fmt::format("{},{:.3f},{:.5f},{:.5f}\n", p.stroke, p.t, p.x, p.y);
}

/// @return arms for which the messages have room
int Hands::led_arms() const {
  return std::min(world_.arms(), static_cast<int>(std::size(hand_order_t{}.action)));
}

}  // namespace mrroc::sim
