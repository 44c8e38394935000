// The supervisor: leads a system from assembling to its end, and tells who died and why.
#include "mp/supervisor.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <future>
#include <random>

#include "mrroc/operator_order_t.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;
using link::Process;
using link::ProcessState;

/// A part that counts to n in step with MP and says what it has counted.
std::function<void(Process&)> counts(int n) {
  return [n](Process& p) {
    const auto in = p.inbox<operator_order_t>("beat");
    const auto out = p.outbox<operator_order_t>(p.membership().name + ".out");
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

class SupervisorTest : public ::testing::Test {
 protected:
  SupervisorTest() {
    std::string pattern = (fs::temp_directory_path() / "supervisor_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~SupervisorTest() override { fs::remove_all(folder_); }

  /// A system with MP in this thread.
  struct System {
    System(const std::vector<Part>& parts, const fs::path& messages, std::int64_t session_id = 1,
           std::chrono::milliseconds leave = std::chrono::seconds(5))
        : bus(hub.open()),
          mp(*bus, member(parts, session_id)),
          beat(mp.outbox<operator_order_t>("beat")),
          supervisor(mp, parts, messages, leave) {}
    static link::Membership member(const std::vector<Part>& parts, std::int64_t session_id) {
      link::Membership m;
      m.session = "test";
      m.session_id = session_id;
      m.name = "mp";
      m.roster = {"mp"};
      for (const Part& p : parts) m.roster.push_back(p.name);
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
    for (const PartStatus& p : s.supervisor.parts()) EXPECT_EQ(p.state, ProcessState::done) << p.name;
    return s.supervisor.log_hash();
  }
  fs::path folder_;
};

TEST_F(SupervisorTest, LeadsASystemToItsEnd) { EXPECT_NE(hash_of_run(10, 1), 0U); }

TEST_F(SupervisorTest, FingerprintIsThatOfTheTrafficAndNotOfTheSession) {
  const std::uint64_t first = hash_of_run(10, 1);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(hash_of_run(10, 1, 1000 + k), first);
  EXPECT_NE(hash_of_run(10, 2), first);
  EXPECT_NE(hash_of_run(9, 1), first);
}

TEST_F(SupervisorTest, AFaultOfAPartStopsTheSystemAndIsTold) {
  const auto fails = [](Process& p) {
    if (p.assemble()) throw FaultError({.code = FaultCode::over_current, .axis = 2});
  };
  System s({{"good", {}, {}, counts(10)}, {"bad", {}, {}, fails}}, messages());
  s.supervisor.start_threads(s.hub);
  EXPECT_TRUE(s.mp.assemble());
  EXPECT_TRUE(s.await([&] { return s.mp.over(); }));
  s.mp.report_done();
  s.supervisor.end();
  ASSERT_TRUE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::over_current);
  EXPECT_EQ(s.supervisor.fault()->axis, 2);
  EXPECT_EQ(s.supervisor.fault()->process.view(), "bad");
  EXPECT_NE(logged().find("over_current"), std::string::npos);
}

TEST_F(SupervisorTest, AnUnexpectedExceptionOfAPartIsAnInternalError) {
  const auto fails = [](Process& p) {
    if (p.assemble()) throw std::runtime_error("unforeseen");
  };
  System s({{"bad", {}, {}, fails}}, messages());
  s.supervisor.start_threads(s.hub);
  s.mp.assemble();
  EXPECT_TRUE(s.await([&] { return s.mp.over(); }));
  s.mp.report_done();
  s.supervisor.end();
  ASSERT_TRUE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::internal_error);
  EXPECT_EQ(s.supervisor.fault()->text.view(), "unforeseen");
}

TEST_F(SupervisorTest, ADeadChildIsNoticedNamedAndDeclaredDead) {
  for (const auto& [script, how] :
       {std::pair("kill -9 $$", "signal 9 (Killed)"), std::pair("exit 3", "exit status 3")}) {
    System s({{"good", "/bin/sh", {"-c", "exec sleep 600"}, {}}, {"bad", "/bin/sh", {"-c", script}, {}}},
             messages());
    s.supervisor.start_processes({});
    EXPECT_FALSE(s.mp.assemble());
    ASSERT_TRUE(s.supervisor.fault());
    EXPECT_EQ(s.supervisor.fault()->code, FaultCode::process_died);
    EXPECT_EQ(s.supervisor.fault()->process.view(), "bad");
    EXPECT_NE(s.supervisor.fault()->text.view().find(how), std::string_view::npos);
    EXPECT_TRUE(s.await([&] { return s.mp.dead("bad"); }));
    EXPECT_FALSE(s.mp.dead("good"));
    EXPECT_EQ(s.supervisor.parts()[2].state, ProcessState::dead);
    EXPECT_EQ(s.supervisor.log_hash(), 0U);
  }  // the other child ends with its supervisor
}

TEST_F(SupervisorTest, AProgramThatIsMissingIsSaidAtOnce) {
  System s({{"part", "/no/such/program", {}, {}}}, messages());
  EXPECT_THROW(s.supervisor.start_processes({}), FaultError);
}

TEST_F(SupervisorTest, TheFirstReasonIsKeptAndADeathDoesNotWaitForTheAgreedMacrostep) {
  System s({}, messages());
  EXPECT_TRUE(s.mp.assemble());
  s.supervisor.stop({.code = FaultCode::operator_stop}, 1000);
  EXPECT_TRUE(s.await([&] { return s.mp.over(); }));
  EXPECT_EQ(s.mp.stop_as_of(), 1000);
  s.supervisor.stop({.code = FaultCode::process_died}, 0);
  EXPECT_TRUE(s.await([&] { return s.mp.stop_as_of() == 0; }));
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::operator_stop);
  s.supervisor.stop({.code = FaultCode::operator_stop}, 2000);
  s.mp.poll();
  EXPECT_EQ(s.mp.stop_as_of(), 0);
}

TEST_F(SupervisorTest, LinesOfAllProcessesAreWrittenDown) {
  const auto talks = [](Process& p) {
    p.say("hello there");
    p.say("that hurt", FaultCode::not_at_rest);
    if (p.assemble()) p.report_done();
  };
  System s({{"talker", {}, {}, talks}}, messages());
  s.supervisor.start_threads(s.hub);
  s.mp.assemble();
  s.mp.report_done();
  s.supervisor.end();
  EXPECT_EQ(s.supervisor.last_message(), "talker: that hurt");
  const std::string text = logged();
  EXPECT_NE(text.find("hello there"), std::string::npos);
  EXPECT_NE(text.find("not_at_rest"), std::string::npos);
}

TEST_F(SupervisorTest, DestructionEndsThreadsThatStillWait) {
  System s({{"one", {}, {}, counts(1000)}}, messages());
  s.supervisor.start_threads(s.hub);
  EXPECT_TRUE(s.mp.assemble());
}

TEST_F(SupervisorTest, AThreadThatDoesNotEndIsNamedAndDoesNotHoldUpTheEnd) {
  const auto hangs = [](Process& p) {
    p.assemble();
    std::promise<void>().get_future().wait();
  };
  const auto run = [&] {
    System s({{"stuck", {}, {}, hangs}}, messages(), 1, std::chrono::milliseconds(50));
    s.supervisor.start_threads(s.hub);
    s.mp.assemble();
    s.supervisor.stop({.code = FaultCode::operator_stop}, 0);
    s.mp.report_done();
    s.supervisor.end();
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(exit_status(FaultCode::process_hung)), "");
  EXPECT_NE(logged().find("the thread stuck does not end"), std::string::npos) << logged();
}

TEST_F(SupervisorTest, RandomStatusesOfAStrangerDoNoHarm) {
  System s({{"one", {}, {}, counts(3)}}, messages());
  link::Outbox<process_status_t> stranger(s.mp.bus(), s.mp.route("one.status"), 1);
  std::mt19937_64 random(3);
  s.mp.report_done();
  for (int k = 0; k < 200; ++k) {
    process_status_t m{};
    const auto number = [&] { return static_cast<std::int32_t>(random()); };
    m.state = k % 3 == 0 ? number() : static_cast<int>(ProcessState::done);
    m.n_hashes = number();
    m.fault.code = number();
    m.skipped = static_cast<std::int64_t>(random());
    for (auto& h : m.hash)
      for (auto& c : h.channel) c = static_cast<std::int8_t>(random());
    if (m.state == static_cast<int>(ProcessState::faulted)) continue;
    stranger.publish(m, 0);
    s.mp.poll();
    for (const PartStatus& p : s.supervisor.parts()) EXPECT_LE(p.state, ProcessState::dead);
    std::ignore = s.supervisor.log_hash();
  }
  EXPECT_FALSE(s.supervisor.fault());
}

}  // namespace
}  // namespace mrroc::mp
