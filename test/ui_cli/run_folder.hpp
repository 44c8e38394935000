// A small run folder, made by the test, and the commands on it.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "base/hash.hpp"
#include "base/link/event_log.hpp"
#include "base/link/process.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/operator_image_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/supervisor_t.hpp"
#include "mrroc/task_status_t.hpp"
#include "ui_cli/log/log_command.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::test {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class RunFolder : public ::testing::Test {
 protected:
  static constexpr std::int64_t kMacrosteps = 50;

  RunFolder() {
    std::string pattern = (fs::temp_directory_path() / "log_test.XXXXXX").string();
    home_ = ::mkdtemp(pattern.data());
    a_ = make("a", 1, 0);
  }
  ~RunFolder() override { fs::remove_all(home_); }

  template <link::FixedMessage M>
  static void log(link::EventLog& to, const std::string& channel, M m, std::int64_t session,
                  std::int64_t number, std::int64_t stamp) {
    m.header = {session, number, stamp};
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<M>()));
    m.encode(bytes.data(), 0, link::encoded_size<M>());
    to.receive("s." + channel, bytes);
  }

  /// An arm that approaches until macrostep 20, refuses a command in 30, and a process that says something.
  fs::path make(const std::string& name, std::int64_t session, double more_force) const {
    fs::path folder = home_ / name;
    fs::create_directories(folder);
    std::ofstream(folder / "config.toml") << "[time]\nn_s = 10\n";
    std::ofstream(folder / "summary.json")
        << R"({"outcome": "done", "figures": {"hold_N": )" << 4 + more_force << "}}";
    std::ofstream(folder / "processes.json")
        << R"({"task": "press", "clock": "step", "processes": [{"name": "mp", "program": "press", "arguments": []},
               {"name": "ecp-arm1", "program": "ecp_press", "arguments": ["--name", "ecp-arm1"]}]})";
    link::EventLog to(folder / link::kEventLog, session);
    supervisor_t s{};
    log(to, "supervisor", s, session, 1, 0);
    for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
      Report r{.m = i < 20 ? 1 : 2, .position_known = true};
      r.driver_state = DriverState::executing;
      r.F_a[Axis::z] = 0.1 * static_cast<double>(i) + (i > 40 ? more_force : 0);
      if (i == 30) {
        r.verdict = Verdict::refused;
        r.fault.code = FaultCode::too_fast;
      }
      log(to, "arm1.report", to_message(r), session, i, i);
      operator_image_t h{};
      h.started = i > 3;
      log(to, "operator.image", h, session, i, i);
    }
    console_t line{};
    link::put_text(line.process, "ecp-arm1");
    link::put_text(line.text, "late: 3 skipped");
    log(to, "ecp-arm1.console", line, session, 1, 25);
    return folder;
  }

  /// Adds a process to a run of session 1, which has come to its end and has sent what is logged on that channel.
  static void tell_channels(const fs::path& folder, const std::string& process, const std::string& channel) {
    Json run = Json::parse(std::ifstream(folder / "processes.json"));
    run["processes"].push_back({{"name", process}, {"program", "vsp"}, {"arguments", Json::array()}});
    std::ofstream(folder / "processes.json") << run;
    const link::LogReader before(folder);
    link::EventLog to(folder / link::kEventLog, 1);
    Hash hash;
    process_status_t done{};
    for (const link::LoggedMessage& m : before.messages()) {
      to.receive("s." + m.channel, m.bytes);
      if (m.channel != channel) continue;
      ++done.hash[0].count;
      hash.add(std::span(m.bytes).subspan(16));  // without LCM's fingerprint and the session
    }
    done.state = static_cast<std::int32_t>(link::ProcessState::done);
    done.n_hashes = 1;
    done.hash[0].hash = static_cast<std::int64_t>(hash.value());
    link::put_text(done.hash[0].channel, "." + channel);
    log(to, process + ".status", done, 1, 1, kMacrosteps);
  }

  int run(const std::vector<std::string>& arguments) {
    out_.str("");
    err_.str("");
    try {
      return ui::run_log(arguments, out_, err_);
    } catch (const FaultError& e) {
      err_ << e.error_line();
      return exit_status(e.fault().code);
    }
  }
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> all;
    std::istringstream in(out_.str());
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  static std::string bad_run(const fs::path& folder) {
    try {
      static_cast<void>(ui::RunRecord(folder));
    } catch (const FaultError& e) {
      return std::string(to_string(e.fault().code));
    }
    return "";
  }

  fs::path home_, a_;
  std::ostringstream out_, err_;
};

}  // namespace mrroc::test
