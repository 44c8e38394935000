// A supervisor whose nodes send what a test lets them send.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/link/text.hpp"
#include "mp/supervisor.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::mp::test {

using link::Phase;
using link::Process;
using link::ProcessState;

/// MP in this thread, on a bus that delivers at once.
class SupervisorFixture : public ::testing::Test {
 protected:
  SupervisorFixture() {
    std::string pattern = (std::filesystem::temp_directory_path() / "supervisor_test.XXXXXX").string();
    folder = ::mkdtemp(pattern.data());
  }
  ~SupervisorFixture() override {
    supervisor.reset();
    std::filesystem::remove_all(folder);
  }

  /// Makes everything anew. @param macrostep  how long one lasts
  void begin(const std::vector<NodeSpec>& nodes, const SupervisorTimes& times = {}, bool replayed = false,
             std::chrono::microseconds macrostep = {}) {
    supervisor.reset();
    mp.reset();
    own.clear();
    words.reset();
    bus = std::make_unique<link::test::DirectBus>();
    link::NodeContext m;
    m.session = "supervised";
    m.name = "mp";
    m.roster = {"mp"};
    m.replayed = replayed;
    m.macrostep = macrostep;
    for (const NodeSpec& p : nodes) m.roster.push_back(p.name);
    mp.emplace(*bus, m);
    words.emplace(*bus, mp->route("supervisor"), 1);
    supervisor.emplace(*mp, nodes, folder / "messages.log", times);
    for (const std::string& name : m.roster)
      own.emplace(name,
                  std::make_unique<link::Outbox<process_status_t>>(*bus, mp->route(name + ".status"), 1));
  }
  /// A node that is a program of a shell.
  static NodeSpec child(const std::string& name, const std::string& script) {
    return {name, "/bin/sh", {"-c", script}, {}};
  }
  static NodeSpec sleeper(const std::string& name) { return child(name, "exec sleep 600"); }

  /// A node says something, and the supervisor hears it.
  void says(const std::string& name, ProcessState state,
            const std::function<void(process_status_t&)>& more = {}) {
    process_status_t m{};
    m.state = static_cast<int>(state);
    if (more) more(m);
    own.at(name)->publish(m, 0);
    mp->poll();
  }
  void mp_is_done() {
    mp->report_done();
    mp->poll();
  }
  void confirms(const std::string& name, Phase phase = Phase::stopping, std::int64_t as_of = 0) {
    says(name, ProcessState::running, [&](process_status_t& m) {
      m.phase = static_cast<int>(phase);
      m.as_of = as_of;
    });
  }
  /// Everybody is there.
  void run() {
    for (const auto& [name, box] : own)
      if (name != "mp") says(name, ProcessState::ready);
    ASSERT_TRUE(mp->assemble());
  }
  bool until(const std::function<bool()>& ready) {
    return mp->await(
        [&] {
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
          return ready();
        },
        Process::Clock::now() + std::chrono::seconds(20));
  }
  /// Lets so much time go by, the supervisor at work.
  void pass(std::chrono::milliseconds time) {
    const auto end = Process::Clock::now() + time;
    until([&] { return Process::Clock::now() >= end; });
  }
  [[nodiscard]] ProcessState state_of(std::size_t node) const {
    return supervisor->node_statuses()[node].state;
  }
  [[nodiscard]] std::string text_of(const std::string& file) const {
    std::ifstream in(folder / file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// @return how often a text is in messages.log
  [[nodiscard]] int logged(const std::string& text) const {
    const std::string all = text_of("messages.log");
    int n = 0;
    for (std::size_t at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) ++n;
    return n;
  }

  std::filesystem::path folder;
  std::unique_ptr<link::test::DirectBus> bus;
  std::optional<Process> mp;
  std::optional<link::Queue<supervisor_t>> words;  // of the supervisor
  std::optional<Supervisor> supervisor;
  std::map<std::string, std::unique_ptr<link::Outbox<process_status_t>>> own;
};

}  // namespace mrroc::mp::test
