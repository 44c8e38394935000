#include "test/ui_cli/view/sample_run.hpp"

#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/effector_command.hpp"
#include "base/link/event_log.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert_platform.hpp"
#include "base/operator.hpp"

namespace mrroc::test {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder(const std::string& name)
    : path_(fs::temp_directory_path() / (name + "-" + std::to_string(::getpid()))) {
  fs::remove_all(path_);
  fs::create_directories(path_);
}

ScratchFolder::~ScratchFolder() { fs::remove_all(path_); }

std::string sample_config() {
  return R"(
[robots]
order = ["arm1", "arm2"]
[robots.arm1]
model = "irb6_postument"
place = [0.0, 2.1, 0.0, 0.0, 0.0, 0.0]
gripper = "none"
tool.pose = [0.0, 0.0, 0.25, 0.0, 0.0, 0.0]
[robots.arm2]
model = "irb6_track"
gripper = "two_jaw"
fingers = "two_layers"
[sim.paper]
distance = 0.9
height = 0.92
[cube]
held_by = "arm2"
[cameras]
order = ["sac"]
[cameras.sac]
width = 320
height = 240
[object]
kind = "chessboard"
arm = "arm1"
square = 0.02
columns = 9
rows = 6
)";
}

effector_reply_t reply(std::int64_t i, double x, double y, double z) {
  effector_reply_t m{};
  m.step = 10 * i;
  m.state = static_cast<std::int8_t>(DriverState::executing);
  m.position_known = 1;
  for (int k = 0; k < 8; ++k) m.joints[k] = 0.1 * k + 0.001 * static_cast<double>(i);
  m.T_0E[0] = x;
  m.T_0E[1] = y;
  m.T_0E[2] = z;
  m.F_a[2] = static_cast<double>(i);
  return m;
}

agent_report_t report(int m) {
  agent_report_t r{};
  r.m = m;
  return r;
}

cube_truth_t cube(std::int64_t i) {
  cube_truth_t m{};
  const double T_UC[12]{1, 0, 0, 0.6, 0, 1, 0, 1.0, 0, 0, 1, 1.4};
  std::copy(std::begin(T_UC), std::end(T_UC), m.T_UC);
  for (std::size_t k = 0; k < std::size(m.facelets); ++k)
    m.facelets[k] = static_cast<std::int8_t>("URFDLB"[k / 9]);
  m.axis = 2;
  m.angle[0] = 0.7 * static_cast<double>(i) / 500;
  return m;
}

task_status_t status(int m, std::string_view name) {
  task_status_t s{};
  s.state = static_cast<int>(TaskState::running);
  s.m = m;
  link::put_text(s.task, "sample");
  link::put_text(s.behaviour, name);
  s.n_agents = 1;  // arm1 has behaviours of its own
  s.agent_m[0] = m;
  link::put_text(s.agent[0], "arm1");
  link::put_text(s.agent_behaviour[0], "arm1 does: " + std::string(name));
  return s;
}

console_t line(std::string_view text, int code) {
  console_t c{};
  c.code = code;
  link::put_text(c.text, text);
  return c;
}

void write_run(const fs::path& folder, int macrosteps) {
  fs::create_directories(folder / "plots");
  std::ofstream(folder / "config.toml") << sample_config();
  std::ofstream(folder / "summary.json") << R"({"task": "sample", "outcome": "done", "fault": null})";
  std::ofstream(folder / "sac_board.png") << "camera";
  std::ofstream(folder / "plots" / "force.png") << "plot";
  link::EventLog log(folder / "events.lcmlog", 7);
  log.receive("s.task_status", encoded(status(1, "approach"), 1, 0));
  log.receive("s.mp.console", encoded(line("operator: start"), 1, 0));
  for (int i = 1; i <= macrosteps; ++i) {
    const int m = 2 * i <= macrosteps ? 1 : 2;
    if (2 * i == macrosteps) log.receive("s.task_status", encoded(status(2, "draw"), 2, i));
    if (4 * i == macrosteps) {
      hand_order_t hands{};
      hands.new_sheet[0] = 1;
      log.receive("s.hand.order", encoded(hands, 1, i));
    }
    log.receive("s.cube.truth", encoded(cube(i), i, i));
    const double share = static_cast<double>(i) / macrosteps;
    for (const std::string arm : {"arm1", "arm2"}) {
      log.receive("s." + arm + ".report", encoded(report(m), i, i));
      log.receive("s." + arm + ".reply",
                  encoded(reply(i, 0.85 + 0.1 * share, 0.1 - 0.2 * share, m == 2 ? 0.9199 : 0.93), i, i));
    }
  }
  log.flush();
}

void write_wild_run(const fs::path& folder) {
  fs::create_directories(folder);
  std::ofstream(folder / "config.toml") << "[robots]\norder = [\"arm1\"]\n[platforms]\norder = [\"rex\"]\n";
  link::EventLog log(folder / "events.lcmlog", 7);
  const std::string markup = "<img src=x onerror=\"document.title='bad'\">";
  log.receive("s.mp.console", encoded(line(markup), 1, 0));
  log.receive("s.task_status", encoded(status(1, markup), 1, 0));
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr std::array kNumbers{0.0,  1e300, -1e300, 1e-300, kNone, std::numeric_limits<double>::infinity(),
                                3e12, 1.0};
  constexpr std::array<std::int64_t, 4> kSteps{1, 20, 1'000'000'000'000'000, 4'000'000'000'000'000'000};
  for (std::int64_t i = 1; i <= 200; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double x = kNumbers[k % kNumbers.size()];
    effector_reply_t arm = reply(i, x, -x, x);
    arm.step = kSteps[k % kSteps.size()];
    for (double& q : arm.joints) q = x;
    for (double& f : arm.F_a) f = x;
    log.receive("s.arm1.reply", encoded(arm, i, i));
    PlatformReply platform;
    platform.step = kSteps[(k + 1) % kSteps.size()];
    platform.estimate.step = platform.step;
    platform.estimate.p = {x, -x, x};
    platform.estimate.covariance = {x, x, 0, x, -x, 0, 0, 0, 1};
    platform.position_known = true;
    log.receive("s.rex.reply", encoded(to_message(platform), i, i));
    PlatformTelemetry telemetry;
    telemetry.step = platform.step;
    telemetry.horizon.fill({x, x, x});
    log.receive("s.rex.telemetry", encoded(to_message(telemetry), i, i));
    PlatformCommand command;
    command.instruction = Instruction::set;
    command.fragment.number = i;
    command.fragment.knot.fill({.p = {x, x, x}, .v = x, .w = x});
    log.receive("s.rex.command", encoded(to_message(command), i, kSteps[k % kSteps.size()]));
  }
  log.flush();
}

std::vector<float> rows_of(const std::string& news, const std::string& track) {
  static constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::string text = nlohmann::json::parse(news).at("tracks").at(track);
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(kLetters.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>(bits >> count & 255));
  }
  std::vector<float> rows(bytes.size() / sizeof(float));
  std::memcpy(rows.data(), bytes.data(), rows.size() * sizeof(float));
  return rows;
}

}  // namespace mrroc::test
