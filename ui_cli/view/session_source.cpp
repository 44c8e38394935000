#include "ui_cli/view/session_source.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "ui_cli/view/listener.hpp"
#include "ui_cli/view/run_source.hpp"

namespace mrroc::view {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kLook = 150ms;     // between looks for a session
constexpr auto kSilence = 5s;     // of a session on another host, until it counts as ended
constexpr auto kReceive = 100ms;  // longest wait for a message
constexpr auto kCheck = 250ms;    // between looks whether the session still runs

/// @return the cell of a session, and what a person should know when that is not known
std::pair<Scene, std::string> cell_of(const link::SessionInfo& session) {
  try {
    if (!session.run_folder.empty()) return {scene_of(session.run_folder), ""};
    return {{}, "the task runs on another host: its cell is not drawn"};
  } catch (const FaultError& e) {
    return {{}, e.what()};
  }
}

std::vector<std::string> names_of(const std::vector<CameraScene>& cameras) {
  std::vector<std::string> names;
  for (const CameraScene& c : cameras) names.push_back(c.name);
  return names;
}

}  // namespace

SessionSource::SessionSource(SessionEnvironment environment, Record& record, CameraWindow& cameras)
    : environment_(std::move(environment)), record_(record), cameras_(cameras) {
  record_.begin(scene_json({}, {.source = "none"}));
  set_state("waiting", "");
  thread_ = std::thread([this] { work(); });
}

SessionSource::~SessionSource() {
  stop_ = true;
  thread_.join();
}

std::filesystem::path SessionSource::folder() const {
  const std::lock_guard lock(mutex_);
  return folder_;
}

void SessionSource::set_state(const char* name, const std::string& text) {
  record_.set("state", nlohmann::json{{"name", name}, {"text", text}}.dump(
                           -1, ' ', true, nlohmann::json::error_handler_t::replace));
}

bool SessionSource::pause(std::chrono::milliseconds time) {
  std::this_thread::sleep_for(time);
  return !stop_;
}

std::optional<link::SessionInfo> SessionSource::find() {
  try {
    return ui::choose_session(environment_.selector, link::running_sessions(environment_.sessions));
  } catch (const FaultError& e) {
    if (!shown_) set_state("waiting", e.what());
    return {};
  }
}

bool SessionSource::talks(link::Bus& bus, const link::SessionInfo& session) {
  struct Flag final : link::Sink {
    bool heard = false;
    void receive(std::string_view, std::span<const std::uint8_t>) noexcept override { heard = true; }
  } flag;
  bus.subscribe_all(session.name + ".", flag);
  while (!stop_ && !flag.heard) bus.wait(kReceive);
  return flag.heard;
}

void SessionSource::work() {
  do {
    const auto session = find();
    if (!session) continue;
    try {
      follow(*session);
    } catch (const std::exception& e) {
      set_state("waiting", e.what());
    }
    following_ = false;
  } while (pause(kLook));
}

void SessionSource::follow(const link::SessionInfo& session) {
  // Of another host: no entry tells when the next run begins, and the one before is to stay on the page until then.
  if (shown_ && session.pid == 0 && !talks(*environment_.open(session), session)) return;
  following_ = true;
  const auto bus = environment_.open(session);
  const auto [scene, note] = cell_of(session);
  Listener listener(record_, scene, session.name, session.id);
  cameras_.begin(session.name, session.id, names_of(scene.cameras), session.pid);
  listener.on_frame = [this](const std::string& camera, const camera_frame_t& m) {
    cameras_.announce(camera, m);
  };
  {
    const std::lock_guard lock(mutex_);
    folder_ = session.run_folder;
  }
  record_.begin(scene_json(scene, {.source = "live",
                                   .task = session.task,
                                   .session = session.name,
                                   .folder = session.run_folder.string(),
                                   .note = note}));
  set_state("live", "");
  bus->subscribe_all(session.name + ".", listener);
  pump(*bus, session, listener);
  shown_ = true;
  if (stop_) return;
  load_summary(session.run_folder, record_);
  listener.publish_count();
  nlohmann::json pictures = pictures_of(session.run_folder);
  record_.set("pictures", pictures.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
  set_state("ended", "");
}

void SessionSource::pump(link::Bus& bus, const link::SessionInfo& session, Listener& listener) {
  const auto begun = Clock::now();
  auto heard = begun;
  auto looked = begun;
  while (!stop_) {
    if (begun + 20s > Clock::now() && !cameras_.complete()) cameras_.look();
    const bool seeking = !cameras_.complete() && begun + 20s > Clock::now();
    if (bus.wait(seeking ? 2ms : kReceive)) heard = Clock::now();
    if (const auto now = Clock::now(); now - looked > kCheck) {
      looked = now;
      if (seeking) cameras_.look_hidden();
      listener.publish_count();
      const auto running = link::running_sessions(environment_.sessions);
      // A replay has the number of its run, and may have its name.
      const bool here = std::ranges::any_of(running, [&](const link::SessionInfo& s) {
        return s.name == session.name && s.id == session.id && s.pid == session.pid;
      });
      if (!here && (session.pid != 0 || now - heard > kSilence)) return;
    }
  }
}

}  // namespace mrroc::view
