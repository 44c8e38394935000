#include "ui_cli/doctor.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>

#include "base/command_hint.hpp"
#include "base/counted.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"

namespace mrroc::ui {
namespace {

/// Sockets of the framework ask for so much [bytes].
constexpr std::int64_t kReceiveBuffer = 4'194'304;
/// Tolerable lateness within the servo step's 2 ms [us].
constexpr std::int64_t kLateness = 500;
/// The highest priority that a process of the framework asks for: the simulator's (base/link/child_main.cpp).
constexpr int kPriority = 40;
/// A run of a minute with its log is some 20 MB.
constexpr std::int64_t kFreeBytes = 1'000'000'000;

Finding multicast(const Host& h) {
  if (h.multicast) return {"multicast", Verdict::good, "messages reach processes of this host", ""};
  return {"multicast", Verdict::bad, "this host has no route for multicast messages",
          "ip route add 224.0.0.0/4 dev lo    (as root), or give tasks --processes one"};
}

Finding buffers(const Host& h) {
  const std::string found = fmt::format("sockets may hold {} of {} bytes", h.receive_buffer, kReceiveBuffer);
  if (h.receive_buffer >= kReceiveBuffer) return {"buffers", Verdict::good, found, ""};
  return {"buffers", Verdict::limited, found + "; messages may be lost under load, and are sent again",
          fmt::format("sysctl -w net.core.rmem_max={}    (as root)", kReceiveBuffer)};
}

Finding clocks(const Host& h) {
  const std::string found = fmt::format("monotonic clock of {} ns; sleeps of 1 ms end up to {} us late",
                                        h.clock_resolution_ns, h.latest_wake_us);
  if (h.clock_resolution_ns <= 1000 && h.latest_wake_us <= kLateness)
    return {"clocks", Verdict::good, found, ""};
  return {"clocks", Verdict::limited, found + "; periods of --clock wall will be missed",
          "end what else runs; --clock step, the default, does not mind"};
}

Finding cores(const Host& h) {
  const std::string found = counted(h.cores, "core") + ", to each of which a driver may be pinned";
  if (h.cores >= 2) return {"cores", Verdict::good, found, ""};
  return {"cores", Verdict::limited, found + "; tasks run several times slower",
          "give the machine a second core"};
}

Finding real_time(const Host& h) {
  if (h.real_time_priority >= kPriority && h.memory_lock)
    return {"real time", Verdict::good, "SCHED_FIFO and locked memory are permitted", ""};
  return {
      "real time", Verdict::limited,
      "not permitted; --clock wall would use both, --speed and the full-screen view locked memory",
      "printf '%s - rtprio 40\\n%s - memlock unlimited\\n' $USER $USER > /etc/security/limits.d/mrroc.conf"
      "    (as root), then log in again"};
}

Finding packages(const Host& h) {
  if (h.missing.empty()) return {"packages", Verdict::good, "all programs that runs use are installed", ""};
  std::string found = "missing:", packages;
  for (const std::string& name : h.missing) {
    const auto n = std::ranges::find_if(kNeeded, [&](const Needed& each) { return name == each.name; });
    found += fmt::format("{} {}", found.ends_with(":") ? "" : ";", name);
    if (n == kNeeded.end()) continue;
    found += fmt::format(", {}", n->without);
    packages += fmt::format(" {}", n->packages);
  }
  return {"packages", Verdict::limited, found, fmt::format("apt-get install{}    (as root)", packages)};
}

Finding platform(const Host& h) {
  if (h.platforms.empty())
    return {"platform", Verdict::limited, "there is none in this build, and no task rex_drive",
            "./run rex_drive    takes CasADi from PyPI and builds Rex; see docs/install.md"};
  std::vector<std::string> built, silent;
  for (const BuiltPlatform& p : h.platforms) (p.starts ? built : silent).push_back(p.name);
  if (silent.empty())
    return {"platform", Verdict::good,
            fmt::format("built in, and its driver starts: {}", joined(built, ", ")), ""};
  return {"platform", Verdict::limited,
          fmt::format("the driver does not start of: {}; a library, such as HPIPM, is not where it was",
                      joined(silent, ", ")),
          "build again, or install again"};
}

Finding disk(const Host& h) {
  const std::string found =
      fmt::format("{:.1f} GB free in {}", static_cast<double>(h.free_bytes) / 1e9, h.folder.string());
  if (h.free_bytes >= kFreeBytes) return {"disk", Verdict::good, found, ""};
  return {"disk", Verdict::bad, found, "make room, or give tasks --run-dir on another disk"};
}

Finding authentication(const Host& h) {
  if (!h.sessions_refused.empty())
    return {"sessions", Verdict::bad, h.sessions_refused, "remove what is there, or set XDG_RUNTIME_DIR"};
  if (h.tag_us < 0)
    return {"sessions", Verdict::bad, "a message that was signed is not recognised",
            "install libsodium23 anew"};
  const std::string found = fmt::format(
      "messages are signed with a key of their run, {:.1f} us each; keys are in {}, for you alone: they do "
      "not protect from "
      "your own programs, root, listeners, or a network that is filled up",
      h.tag_us, h.sessions.string());
  if (h.sessions_note.empty()) return {"sessions", Verdict::good, found, ""};
  return {"sessions", Verdict::limited, h.sessions_note + "; " + found,
          "let root remove it, or set XDG_RUNTIME_DIR"};
}

std::string_view to_string(Verdict v) {
  switch (v) {
    case Verdict::good:
      return "ok";
    case Verdict::limited:
      return "limited";
    case Verdict::bad:
      break;
  }
  return "NOT OK";
}

std::string text_of(const std::vector<Finding>& findings) {
  std::string text;
  for (const Finding& f : findings) {
    text += fmt::format("{:<10} {:<8} {}\n", f.what, to_string(f.verdict), f.found);
    if (!f.type.empty()) text += fmt::format("{:>19} {}\n", "->", f.type);
  }
  return text;
}

std::string json_of(const std::vector<Finding>& findings) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Finding& f : findings)
    all.push_back(
        {{"what", f.what}, {"verdict", to_string(f.verdict)}, {"found", f.found}, {"type", f.type}});
  return all.dump(2) + "\n";
}

}  // namespace

std::vector<Finding> examine(const Host& h) {
  return {multicast(h), buffers(h),  clocks(h), cores(h),         real_time(h),
          packages(h),  platform(h), disk(h),   authentication(h)};
}

int run_doctor(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  const bool json = arguments == std::vector<std::string>{"--json"};
  if (!json && !arguments.empty()) {
    if (std::ranges::count(arguments, "--help") + std::ranges::count(arguments, "-h") > 0) {
      out << command_hint(
          "Usage: ui_cli doctor [--json]\n\nLooks whether this host suits the framework. Each line says ok, "
          "or "
          "what to type.\nExit status: 0; 1 when tasks will not run.\n");
      return 0;
    }
    err << FaultError(FaultCode::bad_usage, fmt::format("doctor does not know '{}'", arguments.front()))
               .error_line()
        << "\n";
    return 2;
  }
  const std::vector<Finding> findings = examine(look_at_host());
  out << (json ? json_of(findings) : text_of(findings));
  return std::ranges::any_of(findings, [](const Finding& f) { return f.verdict == Verdict::bad; }) ? 1 : 0;
}

}  // namespace mrroc::ui
