// The command `ui_cli doctor`: checks that this host suits the framework, and says what to type where it does
// not.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace mrroc::ui {

/// A platform whose driver this build has. A kernel may need libraries that no package brings: that of Rex HPIPM.
struct BuiltPlatform {
  std::string name;  ///< of its type
  bool starts{};     ///< its driver does; otherwise a library is missing
};

/// Properties of a host that are checked.
struct Host {
  bool multicast{};                      ///< a process can hear its own messages
  std::int64_t receive_buffer{};         ///< largest that a socket may have, net.core.rmem_max [bytes]
  std::int64_t clock_resolution_ns{};    ///< of the monotonic clock
  std::int64_t latest_wake_us{};         ///< worst of a hundred sleeps of 1 ms: how much too late it ended
  int cores{};                           ///< that this process may use
  int real_time_priority{};              ///< highest permitted of SCHED_FIFO, 0: none
  bool memory_lock{};                    ///< all of a process may be kept in RAM
  std::vector<std::string> missing;      ///< of kNeeded, what is not installed
  std::vector<BuiltPlatform> platforms;  ///< their drivers are beside this program
  std::filesystem::path folder;          ///< where runs/ would go
  std::int64_t free_bytes{};             ///< there
  std::filesystem::path sessions{};      ///< where sessions and their keys are
  std::string sessions_note{};           ///< why that is not the usual folder; empty: it is
  std::string sessions_refused{};        ///< why it cannot be used; empty: it can
  double tag_us{};                       ///< time to make the tag of a command and to check it [us]
};

/// Something that runs use, and the packages that bring it.
struct Needed {
  const char* name;      ///< of a program, or of a library that is loaded when it is needed
  bool library;          ///< false: a program
  const char* without;   ///< what there is not without it
  const char* packages;  ///< of Debian
};
/// All of them.
inline constexpr std::array kNeeded{
    Needed{"gnuplot", false, "runs have no plots", "gnuplot-nox"},
    Needed{"libEGL.so.1", true, "tasks with cameras do not start", "libegl1 libegl-mesa0 libgl1-mesa-dri"}};

/// @return this host. Takes a quarter of a second
[[nodiscard]] Host look_at_host();

/// Result of one check.
enum class Verdict : std::uint8_t {
  good,
  limited,  ///< works, with what the text says
  bad       ///< tasks will not run
};
/// One line of what the command prints.
struct Finding {
  std::string what;   ///< "multicast"
  Verdict verdict{};  ///< decides on type and exit status
  std::string found;  ///< in words, with figures
  std::string type;   ///< what to type, or to do; empty when good
};

/// @return one finding per thing that matters, the same for every host
[[nodiscard]] std::vector<Finding> examine(const Host& host);

/// Runs the command. @param arguments behind the word doctor
/// @return exit status: 0, 1 when a finding is bad, 2 for bad usage
int run_doctor(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::ui
