// How the platform comes to rest at 0.8 m/s: each of its processes killed, and the operator's orders, at random moments.
#include <fmt/core.h>
#include <csignal>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>
#include <vector>

#include "base/fault.hpp"
#include "base/link/log_reader.hpp"
#include "base/platform_path.hpp"
#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/side_by_side.hpp"
#include "bench/task_process.hpp"
#include "mrroc/map_report_t.hpp"
#include "mrroc/odometry_reading_t.hpp"
#include "mrroc/platform_command_t.hpp"
#include "mrroc/platform_reply_t.hpp"
#include "mrroc/platform_truth_t.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;

constexpr std::size_t kMoments = 50;  // of each process, and of each order
constexpr int kSystemError = 3;
constexpr double kMoving = 0.3;  // [m/s]

/// How a disturbed run came to rest.
struct Rest {
  double speed{};    // when it was disturbed [m/s]
  double way{};      // from then on [m]
  double steps{-1};  // to rest; -1: nobody told
  bool wrong_exit{};
  int left_running{};
};

Words drive(const fs::path& folder, const Words& more) {
  Words words{"--plan", "figure_eight", "--speed-mps", "0.8", "--run-dir", folder.string()};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// @param from  macrostep of the disturbance; what was true then is the first thing that counts
void add_way(const link::LogReader& log, std::int64_t from, Rest& rest) {
  const auto truths = log.messages<platform_truth_t>("rex.truth");
  auto at = truths.lower_bound(from);
  if (at == truths.end()) return;
  rest.speed = std::hypot(at->second.v[0], at->second.v[1]);
  for (auto next = std::next(at); next != truths.end(); at = next++)
    rest.way += std::hypot(next->second.p[0] - at->second.p[0], next->second.p[1] - at->second.p[1]);
}

void add_steps(const fs::path& folder, Rest& rest) {
  const json figures = needed_summary(folder).value("figures", json::object());
  if (figures.contains("stop_steps_max")) rest.steps = figures.at("stop_steps_max").get<double>();
}

/// @return macrostep of the newest message on a channel; 0: there is none
template <class M>
std::int64_t last_of(const link::LogReader& log, const std::string& channel) {
  const auto messages = log.messages<M>(channel);
  return messages.empty() ? 0 : messages.rbegin()->first;
}

/// @return macrostep in which the newest reading of the odometry was due
std::int64_t last_odometry(const link::LogReader& log) {
  constexpr std::int64_t kLatency = 70;  // [steps] from the second picture on
  std::int64_t last = 0;
  for (const auto& [stamp, m] : log.messages<odometry_reading_t>("rex.odometry"))
    last = std::max(last, m.motion.step + kLatency);
  return last / kPlatformSteps;
}

/// A process of the task, and when it spoke last.
struct Victim {
  const char* name;  // empty: the task itself
  std::int64_t (*last)(const link::LogReader&);
  bool eyes{};
};

/// Without `last` the plant dies, too, and there is no way to rest.
const std::vector<Victim> kVictims{
    {"edp-rex", [](const link::LogReader& log) { return last_of<platform_reply_t>(log, "rex.reply"); }},
    {"ecp-rex", [](const link::LogReader& log) { return last_of<platform_command_t>(log, "rex.command"); }},
    {"ecp-map", [](const link::LogReader& log) { return last_of<map_report_t>(log, "map.rex.pose"); }},
    {"vsp-odometry-rex", last_odometry, true},
    {"simulator", nullptr},
    {"", nullptr}};

Words of_victim(const Victim& victim) {
  Words words{"--processes", "separate", "--eyes", victim.eyes ? "on" : "off"};
  if (!victim.eyes) return words;
  for (const char* const camera : {"rex_left", "rex_right"})
    for (const char* const setting : {"width=320", "height=240", "fx=210"})
      words.insert(words.end(), {"--set", fmt::format("cameras.{}.{}", camera, setting)});
  return words;
}

Rest killed(const Victim& victim, unsigned seed) {
  std::mt19937 random(seed);
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "run";
  TaskProcess task("rex_drive", drive(folder, of_victim(victim)));
  if (!task.read_until("plan 1 of"))
    throw FaultError(FaultCode::internal_error, "the platform did not begin its plan");
  std::this_thread::sleep_for(std::chrono::milliseconds(victim.eyes ? random() % 6000 : random() % 2000));
  const std::vector<pid_t> children = task.children();
  const pid_t pid = *victim.name == '\0' ? task.pid() : task.child(victim.name);
  Rest rest;
  if (pid <= 0) return rest;  // it has ended
  ::kill(pid, SIGKILL);
  const int status = task.wait();
  rest.left_running = still_running(children);
  if (*victim.name != '\0') rest.wrong_exit = status != kSystemError;
  if (victim.last == nullptr) return rest;
  const link::LogReader log(folder);
  add_way(log, victim.last(log), rest);
  add_steps(folder, rest);
  return rest;
}

Rest ordered(const std::string& order, unsigned seed) {
  std::mt19937 random(seed);
  const auto macrostep = static_cast<std::int64_t>(100 + random() % 1400);
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "run";
  const fs::path script = scratch.path() / "orders";
  std::ofstream(script) << "3 start\n" << macrostep << ' ' << order << '\n';
  TaskProcess task("rex_drive", drive(folder, {"--processes", "one", "--eyes", "off", "--script", script}));
  Rest rest;
  rest.wrong_exit = task.wait() != 1;
  const link::LogReader log(folder);
  add_way(log, macrostep, rest);
  add_steps(folder, rest);
  return rest;
}

/// Of all moments at which it moved.
struct Worst {
  double way{}, steps{};
  int moved{}, unknown{}, wrong_exits{}, left_running{};
  void add(const Rest& r) {
    wrong_exits += r.wrong_exit ? 1 : 0;
    left_running += r.left_running;
    if (r.speed < kMoving) return;
    ++moved;
    unknown += r.steps < 0 ? 1 : 0;
    way = std::max(way, r.way);
    steps = std::max(steps, r.steps);
  }
};

template <class Disturb>
Worst worst_of(const char* what, std::size_t at_a_time, const Disturb& disturb) {
  const auto rests = side_by_side<Rest>(
      kMoments, at_a_time, [&](std::size_t k) { return disturb(static_cast<unsigned>(k + 1)); },
      [&](std::size_t done) {
        if (done % 10 == 0) fmt::print(stderr, "rex_stops: {}: {} of {}\n", what, done, kMoments);
      });
  Worst worst;
  for (const Rest& rest : rests) worst.add(rest);
  return worst;
}

}  // namespace

Figures run_rex_stops_group() {
  Figures figures;
  Worst all;
  const auto add = [&](const std::string& key, const std::string& words, const Worst& worst) {
    figures.push_back({"way_m_" + key, worst.way, "m",
                       fmt::format("{}, at {} moments at which it moved", words, worst.moved)});
    figures.push_back({"steps_" + key, worst.steps, "steps", "  to rest"});
    all.way = std::max(all.way, worst.way);
    all.steps = std::max(all.steps, worst.steps);
    all.unknown += worst.unknown;
  };
  int wrong_exits = 0, left_running = 0;
  double killed_way = 0;
  for (const Victim& victim : kVictims) {
    const char* const name = *victim.name == '\0' ? "mp" : victim.name;
    const Worst worst =
        worst_of(name, victim.eyes ? 1 : 2, [&](unsigned seed) { return killed(victim, seed); });
    wrong_exits += worst.wrong_exits;
    left_running += worst.left_running;
    if (victim.last == nullptr) continue;
    add(name, fmt::format("way after {} was killed", name), worst);
    killed_way = all.way;
  }
  for (const char* const order : {"stop", "e-stop"}) {
    const Worst worst = worst_of(order, 2, [&](unsigned seed) { return ordered(order, seed); });
    wrong_exits += worst.wrong_exits;
    add(order, fmt::format("way after the order {}", order), worst);
  }
  figures.push_back({"killed_way_m", killed_way, "m", "after any process was killed, wanted <= 0.35"});
  figures.push_back({"stop_steps_max", all.steps, "steps", "to rest, of all, wanted <= 300"});
  figures.push_back(
      {"rest_unknown", static_cast<double>(all.unknown), "", "of all, nobody told the rest, wanted 0"});
  figures.push_back({"kill_wrong_exits", static_cast<double>(wrong_exits), "", "wanted 0"});
  figures.push_back(
      {"kill_left_running", static_cast<double>(left_running), "", "processes still there, wanted 0"});
  return figures;
}

}  // namespace mrroc::bench
