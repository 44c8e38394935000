// The task's side of the operator's protocol, without a task.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/link/bus.hpp"
#include "base/operator.hpp"
#include "mrroc/operator_answer_t.hpp"
#include "mrroc/operator_order_t.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc::test {

/// A status in the middle of a drawing: two arms, eight processes.
task_status_t drawing_status();

/// Answers orders as MP does: every sending is answered, an order is obeyed once.
class FakeTask final : public link::Sink {
 public:
  /// @param bus must outlive the task
  FakeTask(link::Bus& bus, std::string session, std::int64_t session_id);

  /// Takes in what has come and answers it.
  void poll(std::chrono::milliseconds timeout = {});
  void publish(const task_status_t& status);
  /// Says a line as a process of the system.
  void say(const std::string& process, const std::string& text, std::int32_t code = 0,
           std::int64_t macrostep = 0);

  std::function<std::optional<std::string>(OperatorOrder)> refusal_reason;  ///< none: everything is allowed
  int deaf{};                           ///< so many sendings are lost from now on
  std::int64_t wrong_id{};              ///< added to the number in answers
  std::int64_t wrong_session{};         ///< added to the session in answers
  std::vector<operator_order_t> heard;  ///< every sending that was not lost
  std::vector<OperatorOrder> obeyed;

  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;

 private:
  void answer(const operator_order_t& message);

  link::Bus& bus_;
  std::string session_;
  std::int64_t session_id_;
  std::int64_t number_{};
  std::vector<operator_order_t> waiting_;
  std::vector<std::int64_t> known_;
};

}  // namespace mrroc::test
