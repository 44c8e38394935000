// The viewer: what it costs, and whether its page gets everything.
#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/fault.hpp"
#include "base/link/session.hpp"
#include "bench/operator_figures.hpp"
#include "bench/task_process.hpp"
#include "test/ui_cli/view/sample_run.hpp"
#include "test/ui_cli/view/sample_task.hpp"
#include "ui_cli/view/httplib.hpp"

namespace mrroc::bench {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kSettle = 2;    // [s] before the measurement
constexpr int kMeasure = 20;  // [s]

/// @return processor time of a process so far [s]
double processor_time(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string text(std::istreambuf_iterator<char>(file), {});
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 2, text.size())));
  std::string skipped;
  for (int k = 0; k < 11; ++k) fields >> skipped;
  double user = 0;
  double system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

/// A page: reads the stream and counts the readings that it gets.
class Page {
 public:
  explicit Page(int port) : thread_([this, port] { read(port); }) {}
  ~Page() {
    leave_ = true;
    thread_.join();
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;
  [[nodiscard]] std::int64_t rows() const { return rows_; }

 private:
  void read(int port) {
    httplib::Client client("127.0.0.1", port);
    std::string text;
    client.Get("/api/stream", [&](const char* data, std::size_t size) {
      text.append(data, size);
      for (std::size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n")) {
        if (text.starts_with("data: ")) take(text.substr(6, end - 6));
        text.erase(0, end + 2);
      }
      return !leave_;
    });
  }
  void take(const std::string& news) {
    const auto j = nlohmann::json::parse(news);
    if (j.contains("scene")) width_ = j.at("scene").at("columns").size();
    if (!j.contains("tracks")) return;
    for (const auto& [name, text] : j.at("tracks").items())
      if (name.starts_with("arm"))
        rows_ += static_cast<std::int64_t>(test::rows_of(news, name).size() / width_);
  }

  std::atomic<bool> leave_{false};
  std::atomic<std::int64_t> rows_{};
  std::size_t width_{1};
  std::thread thread_;
};

/// Says macrosteps in real time.
void say(test::SampleTask& task, int seconds) {
  auto next = Clock::now();
  for (int k = 0; k < seconds * test::SampleTask::kPerSecond; ++k) {
    task.step();
    next += 1s / test::SampleTask::kPerSecond;
    std::this_thread::sleep_until(next);
  }
}

}  // namespace

Figures viewer_figures() {
  const ScratchFolder folder;
  const std::string session = link::unique_session_name("view");
  TaskProcess viewer("ui_cli", {"view", "--session", session});
  std::string line;
  if (!viewer.read_until("view: http://127.0.0.1:", &line))
    throw FaultError(FaultCode::start_failed, "the viewer did not start");
  const Page page(std::stoi(line.substr(line.rfind(':') + 1)));
  test::SampleTask task(session, folder.path() / "run");
  std::this_thread::sleep_for(1s);  // until the viewer has found it
  say(task, kSettle);
  const double before = processor_time(viewer.pid());
  say(task, kMeasure);
  const double spent = processor_time(viewer.pid()) - before;
  std::this_thread::sleep_for(500ms);
  return {{"viewer_cpu_pct", 100 * spent / kMeasure, "%",
           "of one core: viewer with one page, two arms at 50 macrosteps/s, wanted <= 5"},
          {"viewer_lost", static_cast<double>(2 * task.steps() - page.rows()), "",
           "readings of the arms that the page did not get, wanted 0"}};
}

}  // namespace mrroc::bench
