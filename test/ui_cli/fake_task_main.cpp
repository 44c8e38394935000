// A task without robots, to try the operator's terminal with: enters itself as running, tells a status and
// obeys. Usage: ui_cli_fake_task [SESSION]. Ends after `stop`, or after a minute.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "base/fault.hpp"
#include "base/link/session.hpp"
#include "base/link/text.hpp"
#include "test/ui_cli/fake_task.hpp"

namespace {

using namespace std::chrono_literals;
using mrroc::OperatorOrder;
using mrroc::TaskState;

std::optional<std::string> refusal_reason(OperatorOrder order, TaskState state) {
  const bool allowed = order == OperatorOrder::start    ? state == TaskState::waiting_for_start
                       : order == OperatorOrder::resume ? state == TaskState::paused
                       : order >= OperatorOrder::stop   ? true
                                                        : state == TaskState::running;
  if (allowed) return std::nullopt;
  return "the task is " + std::string(to_string(state));
}

TaskState after(OperatorOrder order, TaskState state) {
  switch (order) {
    case OperatorOrder::start:
    case OperatorOrder::resume:
      return TaskState::running;
    case OperatorOrder::pause:
      return TaskState::paused;
    case OperatorOrder::trigger:
      return state;
    case OperatorOrder::stop:
    case OperatorOrder::emergency_stop:
      break;
  }
  return TaskState::ended;
}

void run(const std::string& session) {
  const auto address = mrroc::link::address_for(session);
  const mrroc::link::SessionFile file(
      {session, mrroc::link::random_id(), address, "drawing", "/runs/" + session, 0});
  const auto bus = mrroc::link::open_session(file.info());
  mrroc::test::FakeTask task(*bus, session, file.info().id);
  TaskState state = TaskState::waiting_for_start;
  task.refusal_reason = [&](OperatorOrder order) { return refusal_reason(order, state); };
  auto status = mrroc::test::drawing_status();
  for (int tick = 0; tick < 600 && state != TaskState::ended; ++tick) {
    for (const auto end = std::chrono::steady_clock::now() + 100ms; std::chrono::steady_clock::now() < end;) {
      task.poll(10ms);
      for (const OperatorOrder order : std::exchange(task.obeyed, {})) {
        state = after(order, state);
        task.say("mp", "operator: " + std::string(to_string(order)));
      }
    }
    if (state == TaskState::running) {
      status.sim_time += 0.1;
      status.header.stamp += 5;
      status.progress = std::min(1.0, status.progress + 0.001);
      for (int arm = 0; arm < 2; ++arm) {
        status.T_0E[arm][0] += 1e-4;
        status.F_a[arm][2] = 1 + std::sin(0.2 * tick + arm);
      }
    }
    status.state = static_cast<std::int32_t>(state);
    status.waits_for_trigger = state == TaskState::running && tick / 50 % 2 == 1;
    task.publish(status);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(argc > 1 ? argv[1] : mrroc::link::unique_session_name("fake"));
    return 0;
  } catch (const mrroc::FaultError& e) {
    std::fprintf(stderr, "%s\n", e.error_line().c_str());
    return mrroc::exit_status(e.fault().code);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 3;
  }
}
