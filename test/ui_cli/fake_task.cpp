#include "test/ui_cli/fake_task.hpp"

#include <algorithm>
#include <utility>

#include "base/link/decode.hpp"
#include "base/link/process.hpp"
#include "base/link/text.hpp"
#include "mrroc/console_t.hpp"

namespace mrroc::test {
namespace {

template <class M>
void send(link::Bus& bus, const std::string& channel, const M& m) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<M>()));
  m.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  bus.publish({link::Group::agents, channel}, bytes);
}

}  // namespace

task_status_t drawing_status() {
  task_status_t s{};
  link::put_text(s.task, "drawing");
  s.state = static_cast<std::int32_t>(TaskState::running);
  s.m = 5;
  link::put_text(s.behaviour, "draw on the paper");
  link::put_text(s.ended_because, "lowering: both pens settled on the paper");
  s.header.stamp = 617;
  s.sim_time = 12.34;
  s.progress = 0.63;
  link::put_text(s.progress_text, "stroke 3 of 6");
  s.speed = 8.1;
  s.n_agents = 2;
  link::put_text(s.agent[0], "arm1");
  link::put_text(s.agent[1], "arm2");
  const double pose[2][6]{{0.8123, 0.0124, 0.0456, 0, 3.14159, 0}, {0.9, -0.25, 0.0451, 0.01, 3.14, -0.02}};
  for (int k = 0; k < 2; ++k) {
    s.position_known[k] = 1;
    std::copy_n(pose[k], 6, s.T_0E[k]);
    s.F_a[k][2] = 1.02 - 0.1 * k;
    s.sensor[k] = 2;
    link::put_text(s.sensor_text[k], "paper_surface");
    link::put_text(s.agent_behaviour[k], "copy the coordinator's orders");
  }
  const char* const names[]{"mp",       "simulator", "edp arm1", "edp arm2",
                            "ecp arm1", "ecp arm2",  "vsp arm1", "vsp arm2"};
  for (const char* name : names) {
    link::put_text(s.process[s.n_processes], name);
    s.process_state[s.n_processes] = static_cast<std::int32_t>(link::ProcessState::running);
    s.process_age[s.n_processes++] = 0.1;
  }
  link::put_text(s.last_message, "mp: the pens are on the paper");
  link::put_text(s.run_folder, "/runs/drawing-1");
  return s;
}

FakeTask::FakeTask(link::Bus& bus, std::string session, std::int64_t session_id)
    : bus_(bus), session_(std::move(session)), session_id_(session_id) {
  bus_.subscribe({link::Group::agents, session_ + ".operator"}, *this);
}

void FakeTask::receive(std::string_view, std::span<const std::uint8_t> bytes) noexcept {
  const auto m = link::decode<operator_order_t>(bytes);
  if (m && m->header.session == session_id_) waiting_.push_back(*m);
}

void FakeTask::poll(std::chrono::milliseconds timeout) {
  bus_.wait(timeout);
  for (const operator_order_t& order : std::exchange(waiting_, {}))
    if (deaf > 0)
      --deaf;
    else
      answer(order);
}

void FakeTask::answer(const operator_order_t& message) {
  heard.push_back(message);
  const auto order = static_cast<OperatorOrder>(message.order);
  const auto reason = refusal_reason ? refusal_reason(order) : std::nullopt;
  if (!reason && std::ranges::find(known_, message.id) == known_.end()) {
    known_.push_back(message.id);
    obeyed.push_back(order);
  }
  operator_answer_t a{};
  a.header = {session_id_ + wrong_session, ++number_, 0};
  a.id = message.id + wrong_id;
  a.accepted = !reason;
  link::put_text(a.text, reason ? *reason : std::string(to_string(order)) + " accepted");
  send(bus_, session_ + ".answer", a);
}

void FakeTask::publish(const task_status_t& status) {
  task_status_t s = status;
  s.header.session = session_id_;
  s.header.number = ++number_;
  send(bus_, session_ + ".task_status", s);
}

void FakeTask::say(const std::string& process, const std::string& text, std::int32_t code,
                   std::int64_t macrostep) {
  console_t m{};
  m.header = {session_id_, ++number_, macrostep};
  m.code = code;
  link::put_text(m.process, process);
  link::put_text(m.text, text);
  send(bus_, session_ + "." + process + ".console", m);
}

}  // namespace mrroc::test
