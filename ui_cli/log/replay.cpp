#include "ui_cli/log/replay.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <sstream>
#include <thread>

#include "base/command_line.hpp"
#include "base/counted.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/link/channel.hpp"
#include "base/link/child.hpp"
#include "base/link/text.hpp"
#include "base/operator.hpp"
#include "base/program.hpp"
#include "mrroc/operator_answer_t.hpp"
#include "mrroc/operator_order_t.hpp"
#include "ui_cli/log/log_check.hpp"
#include "ui_cli/log/log_whole.hpp"
#include "ui_cli/log/replay_check.hpp"

namespace mrroc::ui {
namespace {

using namespace std::chrono_literals;

constexpr auto kTick = 5ms;      // between two looks at the clock
constexpr auto kRepeat = 200ms;  // of waiting for a process: something may have been lost
constexpr auto kSilent = 10s;    // of waiting for it in vain

volatile std::sig_atomic_t interrupted = 0;
void interrupt(int) { interrupted = 1; }

/// Ctrl-C, and any other end of this process, end the replay: nothing of it stays behind.
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

}  // namespace

/// Answers terminals: what has happened cannot be changed.
class Replay::CommandServer {
 public:
  CommandServer(link::Bus& bus, const std::string& session, std::int64_t id)
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
      command_server_(std::make_shared<CommandServer>(bus, session, run.log().session_id())) {
  // The command server's own messages are not sent twice.
  options_.without.insert({"operator", "answer"});
  if (options_.check)
    options_.without.insert(options_.check->channels().begin(), options_.check->channels().end());
}

bool Replay::stopped() const { return command_server_->stopped(); }

void Replay::publish(const link::LoggedMessage& m) {
  if (options_.without.contains(m.channel)) return;
  bus_.publish({link::Group::agents, session_ + "." + m.channel}, m.bytes);
}

void Replay::repeat() {
  constexpr std::size_t kLast = 64;  // more than a macrostep of any task
  const auto& all = run_.log().messages();
  for (std::size_t k = next_ - std::min(next_, kLast); k < next_; ++k)
    if (!by_wall_clock(all[k].channel) || all[k].channel == "supervisor") publish(all[k]);
}

void Replay::give_up() { options_.check->give_up(run_.log().messages()[next_]); }

bool Replay::go_on_to(double time) {
  while (bus_.wait(0ms)) {
  }
  command_server_->poll();
  waits_ = false;
  const auto& all = run_.log().messages();
  while (next_ < all.size()) {
    // The log is in the order in which things happened; messages without a time go with their neighbours.
    if (!by_wall_clock(all[next_].channel))
      if (const auto t = run_.time_of(all[next_])) time_ = std::max(time_, *t);
    if (time_ > time) return true;
    waits_ = options_.check && !options_.check->passed(all[next_]);
    if (waits_) return true;
    if (time_ >= options_.from) {
      publish(all[next_]);
      published_ += !options_.without.contains(all[next_].channel);
    }
    ++next_;
  }
  return false;
}

namespace {

struct Words {
  std::string run, session;
  ReplayOptions options;
  std::vector<std::string> without;
  std::vector<std::string> with;
  bool json{};
};

using Clock = std::chrono::steady_clock;

/// A process of the run that listens to the replay.
struct Listener {
  std::string name;
  link::Child child;
};

/// @return whether the log has come to its end
bool play(Replay& replay, const ReplayOptions& o, std::vector<Listener>& listeners, link::Bus& bus) {
  const auto begun = Clock::now();
  auto waits_since = begun, repeated = begun;
  while (interrupted == 0 && !replay.stopped()) {
    const double passed = std::chrono::duration<double>(Clock::now() - begun).count();
    const double until = o.speed > 0 ? o.from + passed * o.speed : replay.time() + 0.1;
    const std::int64_t before = replay.published();
    for (Listener& l : listeners)
      if (l.child.reap()) o.check->ended(l.name, *l.child.ended());
    if (!replay.go_on_to(until)) return true;
    const auto now = Clock::now();
    if (!replay.waits() || replay.published() != before) {
      waits_since = repeated = now;
    } else if (now - waits_since > kSilent) {
      replay.give_up();
    } else if (now - repeated > kRepeat) {
      replay.repeat();
      repeated = now;
    }
    if (replay.waits())
      bus.wait(1ms);
    else if (o.speed > 0)
      std::this_thread::sleep_for(kTick);
  }
  return false;
}

/// Starts processes of the run beside the replay and waits until they wait for its beginning.
std::vector<Listener> start(const RunRecord& run, const Words& w, const link::SessionInfo& session,
                            const ReplayCheck& check, link::Bus& bus) {
  std::vector<Listener> listeners;
  for (const std::string& name : w.with) {
    const LoggedProcess& p = *std::ranges::find(run.processes(), name, &LoggedProcess::name);
    std::vector<std::string> arguments{
        "--session",    session.name,
        "--session-id", std::to_string(run.log().session_id()),
        "--url",        session.address->url(),
        "--key-fd",     "0",
        "--roster",     "mp," + name,
        "--clock",      "step",
        "--timeout",    "0",
        "--config",     std::filesystem::absolute(run.folder() / "config.toml").string()};
    arguments.insert(arguments.end(), p.arguments.begin(), p.arguments.end());
    listeners.push_back(
        {name, link::Child(program_beside(p.program), arguments, {}, session.key->hex() + "\n")});
  }
  const auto begun = Clock::now();
  while (!check.ready() && interrupted == 0) {
    bus.wait(20ms);
    for (Listener& l : listeners)
      if (l.child.reap())
        throw FaultError(FaultCode::start_failed, fmt::format("{} ended with {}", l.name, *l.child.ended()),
                         "see its own line above");
    if (Clock::now() - begun > kSilent)
      throw FaultError(FaultCode::peer_silent, fmt::format("{} did not get ready", joined(w.with, ", ")));
  }
  return listeners;
}

/// Refuses processes that need more than messages.
void check_can_listen(const RunRecord& run, const std::vector<std::string>& names, const Prover& prove) {
  for (const std::string& name : names) {
    if (name == "mp")
      throw FaultError(
          FaultCode::bad_usage,
          "mp cannot listen to a replay: its supervisor would start and step the processes, which the "
          "replay does from the log",
          fmt::format("recompute it: `ui_cli log check {}`", run.folder().string()));
    const link::LogVerdict verdict =
        check_process_of(run, *std::ranges::find(run.processes(), name, &LoggedProcess::name), prove);
    if (!verdict.not_checked.empty())
      throw FaultError(FaultCode::bad_usage,
                       fmt::format("{} cannot listen to a replay: {}", name, verdict.not_checked));
  }
}

int replay_run(const Words& w, const ReplayEnvironment& environment, std::ostream& out, std::ostream& err) {
  const RunRecord run(w.run);
  warn_of_damage(run, err);
  ReplayOptions options = w.options;
  options.without.insert(w.without.begin(), w.without.end());
  const std::string session =
      w.session.empty() ? link::unique_session_name("replay", environment.sessions) : w.session;
  const link::LcmAddress address = link::address_for(session);
  const Interruptible while_replaying;
  const link::SessionFile file({.name = session,
                                .id = run.log().session_id(),
                                .address = address,
                                .task = "replay of " + (run.task().empty() ? "a run" : run.task()),
                                .run_folder = std::filesystem::absolute(run.folder()),
                                .pid = 0},
                               environment.sessions);
  const auto bus = environment.open(file.info());
  std::optional<ReplayCheck> check;
  if (!w.with.empty()) {
    options.check = &check.emplace(*bus, run, session, w.with);
    check_can_listen(run, w.with, environment.prove);
  }
  Replay replay(*bus, run, session, options);
  std::vector<Listener> listeners;
  if (check) listeners = start(run, w, file.info(), *check, *bus);
  if (!w.json) out << fmt::format("replay of {}, session {}\n", run.folder().string(), session) << std::flush;
  const bool to_its_end = play(replay, options, listeners, *bus);
  if (check && !to_its_end) check->cut_short();
  nlohmann::ordered_json told{
      {"session", session}, {"messages", replay.published()}, {"sim_s", replay.time()}};
  const auto verdicts = check ? check->verdicts() : std::vector<link::LogVerdict>{};
  for (const link::LogVerdict& v : verdicts)
    told["processes"].push_back(nlohmann::ordered_json::parse(link::to_json(v)));
  out << (w.json
              ? told.dump() + "\n"
              : fmt::format("{}, until {:.2f} s\n", counted(replay.published(), "message"), replay.time()));
  if (!check) return 0;
  std::ostringstream unread;
  return report_check(run.folder(), verdicts, {}, "", false, w.json ? unread : out);
}

}  // namespace

int run_replay(const std::vector<std::string>& arguments, const ReplayEnvironment& environment,
               std::ostream& out, std::ostream& err) {
  Words w;
  CommandLine line(
      "Publishes the messages of a run once more, at their pace, on a session of its own: look at it with "
      "`ui_cli`, or let a virtual sensor read it.",
      "ui_cli replay");
  line.option("run", w.run, "the run folder").required().type_name("RUN");
  line.option("--speed", w.options.speed, "simulated seconds per second, 0: as fast as possible (default 1)")
      .range(0.0, 1e4)
      .type_name("X");
  line.option("--from", w.options.from, "simulated time at which to begin").type_name("S");
  line.option("--without", w.without, "channels that somebody else publishes, such as arm1.pen_state")
      .delimiter(',')
      .type_name("C,C...");
  line.option("--with", w.with,
              "processes of the run that are started before the replay begins and listen to it, such as "
              "vsp-arm1: "
              "what they say is compared with the log")
      .delimiter(',')
      .type_name("P,P...");
  line.option("--session", w.session, "name of the session (default: unique)").type_name("NAME");
  line.flag("--json", w.json, "print JSON");
  if (const auto status =
          line.parse_words(arguments, out, err,
                           {"ui_cli replay runs/press-20260314-101500",
                            "ui_cli replay runs/press-20260314-101500 --speed 10 --from 5",
                            "ui_cli replay runs/press-20260314-101500 --without arm1.order,arm1.report",
                            "ui_cli replay runs/drawing-20260314-101500 --with vsp-arm1,vsp-arm2",
                            "ui_cli replay runs/press-20260314-101500 --session again"}))
    return *status;
  // Each process once, in the order in which they are named.
  std::set<std::string> named;
  std::erase_if(w.with, [&](const std::string& name) { return !named.insert(name).second; });
  if (!w.with.empty() && w.options.from > 0)
    throw FaultError(FaultCode::bad_usage,
                     "--with begins with the run: what a process says depends on all that it has "
                     "seen",
                     "leave --from out");
  return replay_run(w, environment, out, err);
}

}  // namespace mrroc::ui
