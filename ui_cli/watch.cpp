#include "ui_cli/watch.hpp"

#include <unistd.h>

#include "base/link/real_time.hpp"
#include "ui_cli/panel.hpp"
#include "ui_cli/terminal.hpp"

namespace mrroc::ui {
namespace {

using namespace std::chrono_literals;

constexpr auto kRedraw = 100ms;
constexpr auto kKeys = 20ms;  // a key waits no longer than this, on a bus that it does not wake

}  // namespace

void watch(link::Bus& bus, Client& client, const std::string& session) {
  link::keep_in_memory();  // a key that has never been pressed takes no longer
  Terminal terminal;
  Panel panel(bus, client, terminal.glyphs(), Clock::now(), session);
  bus.wake_on(STDIN_FILENO);
  Clock::time_point redraw = Clock::now();
  while (!panel.leaving()) {
    client.receive(kKeys);
    Clock::time_point now = Clock::now();
    bool pressed = false;
    while (const auto key = terminal.key()) {
      panel.key(*key, now);
      pressed = true;
    }
    panel.update(now);
    if (!pressed && now < redraw) continue;
    redraw = now + kRedraw;
    terminal.show(panel.picture(terminal.size(), now));
  }
}

}  // namespace mrroc::ui
