#include "ui_cli/log/replay.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "base/fault.hpp"
#include "base/link/channel.hpp"
#include "base/link/text.hpp"
#include "base/operator.hpp"
#include "mrroc/operator_answer_t.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::ui {
namespace {

using namespace std::chrono_literals;

constexpr auto kTick = 5ms;  // between two looks at the clock

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// Ctrl-C, and who ends this process otherwise, end the replay: nothing of it stays behind.
class Interruptible {
 public:
  Interruptible() { interrupted = 0; }
  ~Interruptible() {
    std::signal(SIGINT, int_);
    std::signal(SIGTERM, term_);
  }
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

 private:
  void (*int_)(int) = std::signal(SIGINT, interrupt);
  void (*term_)(int) = std::signal(SIGTERM, interrupt);
};

/// The number of the run, which is in every message.
std::int64_t session_id_of(const RunRecord& run) {
  for (const link::LoggedMessage& m : run.log().messages())
    if (m.channel == "supervisor") return link::header_of(m.bytes).session;
  return link::header_of(run.log().messages().front().bytes).session;
}

}  // namespace

/// Answers terminals: what has happened cannot be changed.
class Replay::Desk {
 public:
  Desk(link::Bus& bus, const std::string& session, std::int64_t id)
      : order_in_(bus, {link::Group::agents, session + ".operator"}, id),
        answer_out_(bus, {link::Group::agents, session + ".answer"}, id) {}

  void poll() {
    while (const auto order = order_in_.take()) {
      operator_answer_t answer{};
      answer.id = order->id;
      answer.accepted = order->order == static_cast<int>(OperatorOrder::stop);
      stopped_ = stopped_ || answer.accepted != 0;
      link::put_text(answer.text,
                     answer.accepted != 0 ? "the replay ends" : "this is a replay; it can only be stopped");
      answer_out_.publish(answer, 0);
    }
  }
  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  link::Queue<operator_order_t> order_in_;
  link::Outbox<operator_answer_t> answer_out_;
  bool stopped_{};
};

Replay::Replay(link::Bus& bus, const RunRecord& run, const std::string& session, const ReplayOptions& options)
    : bus_(bus),
      run_(run),
      session_(session),
      options_(options),
      desk_(std::make_shared<Desk>(bus, session, session_id_of(run))) {
  // What the desk says itself is not said twice.
  options_.without.insert({"operator", "answer"});
}

bool Replay::stopped() const { return desk_->stopped(); }

void Replay::publish(const link::LoggedMessage& m) {
  if (options_.without.contains(m.channel)) return;
  bus_.publish({link::Group::agents, session_ + "." + m.channel}, m.bytes);
  ++published_;
}

bool Replay::go_on_to(double time) {
  bus_.wait(0ms);
  desk_->poll();
  const auto& all = run_.log().messages();
  while (next_ < all.size()) {
    // The log is in the order in which things happened; messages without a time go with their neighbours.
    if (!by_wall_clock(all[next_].channel))
      if (const auto t = run_.time_of(all[next_])) time_ = std::max(time_, *t);
    if (time_ > time) return true;
    if (time_ >= options_.from) publish(all[next_]);
    ++next_;
  }
  return false;
}

namespace {

struct Words {
  std::string run, session;
  ReplayOptions options;
  std::vector<std::string> without;
  bool json{};
};

double play(Replay& replay, const ReplayOptions& o) {
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  while (interrupted == 0 && !replay.stopped()) {
    const double passed = std::chrono::duration<double>(Clock::now() - begun).count();
    const double until = o.speed > 0 ? o.from + passed * o.speed : replay.time() + 0.1;
    if (!replay.go_on_to(until)) break;
    if (o.speed > 0) std::this_thread::sleep_for(kTick);
  }
  return replay.time();
}

int replay_run(const Words& w, const ReplaySurroundings& around, std::ostream& out) {
  const RunRecord run(w.run);
  ReplayOptions options = w.options;
  options.without.insert(w.without.begin(), w.without.end());
  const std::string session =
      w.session.empty() ? link::unique_session_name("replay", around.sessions) : w.session;
  const link::LcmAddress address = link::address_for(session);
  const Interruptible while_replaying;
  const link::SessionFile file({.name = session,
                                .id = session_id_of(run),
                                .address = address,
                                .task = "replay of " + (run.task().empty() ? "a run" : run.task()),
                                .run_folder = std::filesystem::absolute(run.folder()),
                                .pid = 0},
                               around.sessions);
  const auto bus = around.open(address);
  Replay replay(*bus, run, session, options);
  if (!w.json) out << fmt::format("replay of {}, session {}\n", run.folder().string(), session) << std::flush;
  const double end = play(replay, options);
  out << (w.json
              ? nlohmann::ordered_json{{"session", session}, {"messages", replay.published()}, {"sim_s", end}}
                        .dump() +
                    "\n"
              : fmt::format("{} messages, until {:.2f} s\n", replay.published(), end));
  return 0;
}

}  // namespace

int run_replay(const std::vector<std::string>& arguments, const ReplaySurroundings& around, std::ostream& out,
               std::ostream& err) {
  Words w;
  CLI::App app(
      "Publishes the messages of a run once more, at their pace, on a session of its own: look at it with "
      "`ui_cli`, or let a virtual sensor read it.",
      "ui_cli replay");
  app.add_option("run", w.run, "the run folder")->required()->type_name("RUN");
  app.add_option("--speed", w.options.speed,
                 "simulated seconds per second, 0: as fast as possible (default 1)")
      ->check(CLI::Range(0.0, 1e4))
      ->type_name("X");
  app.add_option("--from", w.options.from, "simulated time at which to begin")->type_name("S");
  app.add_option("--without", w.without, "channels that somebody else publishes, such as arm1.pen_state")
      ->delimiter(',')
      ->type_name("C,C...");
  app.add_option("--session", w.session, "name of the session (default: unique)")->type_name("NAME");
  app.add_flag("--json", w.json, "print JSON");
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::Success& e) {
    return app.exit(e, out, err);
  } catch (const CLI::Error& e) {
    err << FaultError(FaultCode::bad_usage, e.what()).error_line() << "\n";
    return exit_status(FaultCode::bad_usage);
  }
  return replay_run(w, around, out);
}

}  // namespace mrroc::ui
