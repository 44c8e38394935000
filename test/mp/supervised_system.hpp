// A system that is led by a supervisor, for tests.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mp/supervisor.hpp"
#include "mrroc/operator_order_t.hpp"
#include "test/mp/no_deadlines.hpp"

namespace mrroc::mp {

namespace fs = std::filesystem;
using link::Process;
using link::ProcessState;

/// A node that counts to n in step with MP and says what it has counted.
inline std::function<void(Process&)> counts(int n) {
  return [n](Process& p) {
    const auto in = p.inbox<operator_order_t>("beat");
    const auto out = p.outbox<operator_order_t>(p.context().name + ".out");
    if (!p.assemble()) return;
    for (std::int64_t i = 1; i <= n; ++i) {
      p.await([&] { return in->at(i) || p.over(); });
      if (p.over()) break;
      operator_order_t m{};
      m.id = in->at(i)->id;
      out->publish(m, i);
      p.report_progress(i, i);
    }
    p.report_done();
    p.stay();
  };
}

/// A driver whose robot is at rest so long after the system stops.
inline NodeSpec driver(const std::string& name, std::chrono::milliseconds rests_after = {},
                       int stop_steps = 0) {
  return {name, {}, {}, [=](Process& p) {
            p.report_effector(0);
            p.assemble();  // or the system ends before it has begun
            p.await([&] { return p.over(); });
            p.await([&] { return p.phase() == link::Phase::finished; }, Process::Clock::now() + rests_after);
            p.report_rest(true, stop_steps);
            p.report_done();
            p.stay();
          }};
}

class SupervisorTest : public ::testing::Test {
 protected:
  SupervisorTest() {
    std::string pattern = (fs::temp_directory_path() / "supervisor_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~SupervisorTest() override { fs::remove_all(folder_); }

  /// A system with MP in this thread.
  struct System {
    System(const std::vector<NodeSpec>& nodes, const fs::path& messages, std::int64_t session_id = 1,
           const SupervisorTimes& times = {})
        : bus(hub.open()),
          mp(*bus, context_of(nodes, session_id)),
          beat(mp.outbox<operator_order_t>("beat")),
          supervisor(mp, nodes, messages, times) {}
    static link::NodeContext context_of(const std::vector<NodeSpec>& nodes, std::int64_t session_id) {
      link::NodeContext m;
      m.session = "test";
      m.session_id = session_id;
      m.name = "mp";
      m.roster = {"mp"};
      for (const NodeSpec& p : nodes) m.roster.push_back(p.name);
      return m;
    }
    /// Gives n beats that follow from the seed.
    void run(int n, int seed = 0) {
      for (std::int64_t i = 1; i <= n && !mp.over(); ++i) {
        operator_order_t m{};
        m.id = 100 * seed + i;
        beat->publish(m, i);
      }
    }
    template <class Ready>
    bool await(Ready ready) {
      return mp.await(ready, Process::Clock::now() + std::chrono::seconds(20));
    }
    /// Starts the threads of a system that stops by itself. @return how long its end takes after that
    Process::Clock::duration end_when_it_stops() {
      supervisor.start_threads(hub);
      mp.assemble();
      EXPECT_TRUE(await([&] { return mp.over(); }));
      const auto stopped = Process::Clock::now();
      mp.report_done();
      supervisor.end();
      return Process::Clock::now() - stopped;
    }

    link::MemoryHub hub;
    std::unique_ptr<link::Bus> bus;
    Process mp;
    std::unique_ptr<link::Outbox<operator_order_t>> beat;
    Supervisor supervisor;
  };

  [[nodiscard]] fs::path messages() const { return folder_ / "messages.log"; }
  [[nodiscard]] std::string logged() const {
    std::ifstream in(messages());
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Runs two counters to their end. @return the fingerprint
  std::uint64_t hash_of_run(int beats, int seed, std::int64_t session_id = 1) {
    System s({{"one", {}, {}, counts(beats)}, {"two", {}, {}, counts(beats)}}, messages(), session_id);
    s.supervisor.start_threads(s.hub);
    EXPECT_TRUE(s.mp.assemble());
    s.run(beats, seed);
    EXPECT_EQ(s.supervisor.log_hash(), 0U);  // not known before everybody is done
    s.mp.report_done();
    s.supervisor.end();
    EXPECT_FALSE(s.supervisor.fault());
    for (const NodeStatus& p : s.supervisor.node_statuses()) EXPECT_EQ(p.state, ProcessState::done) << p.name;
    return s.supervisor.log_hash();
  }
  fs::path folder_;
};

/// A status as a node sends it.
inline process_status_t status(ProcessState state, link::Phase heard) {
  process_status_t m{};
  m.state = static_cast<int>(state);
  m.phase = static_cast<int>(heard);
  return m;
}

}  // namespace mrroc::mp
