#include "mp/supervised_node.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "base/program.hpp"

namespace mrroc::mp {
namespace {

using link::Phase;
using link::ProcessState;

constexpr std::chrono::seconds kTellSkipped{1};  // between lines about lateness

}  // namespace

SupervisedNode::SupervisedNode(link::Process& mp, NodeSpec spec)
    : spec_(std::move(spec)),
      status_in_(mp.bus(), mp.route(spec_.name + ".status"), mp.context().session_id),
      console_in_(mp.bus(), mp.route(spec_.name + ".console"), mp.context().session_id) {}

void SupervisedNode::start_process(const std::vector<std::string>& common, const std::string& input) {
  if (spec_.program.empty()) return;
  std::vector<std::string> arguments = common;
  arguments.insert(arguments.end(), spec_.arguments.begin(), spec_.arguments.end());
  const bool here = spec_.start.empty();
  child_.emplace(here ? program_beside(spec_.program) : program_folder() / spec_.program, arguments,
                 spec_.start, input);
  heartbeat_.hear(Clock::now());
}

void SupervisedNode::start_thread(link::MemoryHub& hub, const link::NodeContext& like) {
  if (!spec_.body) return;
  link::NodeContext context = like;
  context.name = spec_.name;
  thread_ = std::jthread([&hub, context, body = spec_.body, &ended = thread_ended_] {
    const auto bus = hub.open();
    link::Process process(*bus, context);
    try {
      body(process);
    } catch (const FaultError& e) {
      process.report_fault(e.fault());
    } catch (const std::exception& e) {
      process.report_fault({.code = FaultCode::internal_error, .text = e.what()});
    }
    ended = true;
  });
}

std::optional<SupervisedNode::News> SupervisedNode::take_status(Clock::time_point now) {
  const auto s = status_in_.take();
  if (!s) return std::nullopt;
  News news;
  if (s->state < 0 || s->state >= static_cast<int>(ProcessState::dead)) return news;  // nobody says so
  heartbeat_.hear(now);
  const auto state = static_cast<ProcessState>(s->state);
  if (state_ == ProcessState::dead) return news;
  if (state_ >= ProcessState::done && state < ProcessState::done) return news;  // late
  if (s->skipped > skipped_told_ && (state >= ProcessState::done || now - told_at_ > kTellSkipped)) {
    news.late = s->skipped - skipped_told_;
    skipped_told_ = s->skipped;
    told_at_ = now;
  }
  news.begun = s->m != status_.m || !std::ranges::equal(s->behaviour, status_.behaviour);
  if (state != state_ && state == ProcessState::faulted) news.fault = from_message(s->fault);
  status_ = *s;
  state_ = state;
  if (s->at_rest) stop_steps_ = s->stop_steps;
  return news;
}

NodeStatus SupervisedNode::summary(Clock::time_point now) const {
  return {spec_.name,
          state_,
          std::chrono::duration<double>(now - heartbeat_.heard()).count(),
          status_.m,
          link::get_text(status_.behaviour),
          link::get_text(status_.ended_because)};
}

bool SupervisedNode::runs() const {
  return (child_ && !child_->ended()) || (thread_.joinable() && !thread_ended_);
}

bool SupervisedNode::join() {
  if (!thread_.joinable()) return true;
  if (!thread_ended_) return false;
  thread_.join();
  return true;
}

SupervisedNode::Clock::duration SupervisedNode::silence(Clock::time_point now) {
  heartbeat_.look(now);
  return heartbeat_.counted();
}

SupervisedNode::Clock::duration SupervisedNode::left(Clock::time_point now) {
  if (!left_) left_.emplace(now);
  left_->look(now);
  return left_->counted();
}

bool SupervisedNode::confirms(std::int64_t as_of) const {
  if (!runs() || state_ >= ProcessState::done) return true;
  return status_.phase >= static_cast<int>(Phase::stopping) && status_.as_of <= as_of;
}

bool SupervisedNode::ended() const {
  return state_ == ProcessState::done || state_ == ProcessState::dead || thread_ended_ ||
         (child_ && child_->ended());
}

}  // namespace mrroc::mp
