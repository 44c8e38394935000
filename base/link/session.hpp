// Sessions: how running tasks of one user find names that are free, and how terminals find running tasks.
// A task enters itself as a small file in a directory that only its user can open. Not for the servo step.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/link/lcm_bus.hpp"

namespace mrroc::link {

/// Longest name of a session [characters].
inline constexpr std::size_t kMaxSessionName = 24;

/// What a running task tells about itself.
struct SessionInfo {
  std::string name;                   ///< 1..kMaxSessionName of A-Z a-z 0-9 _ -; prefix of every channel
  std::int64_t id{};                  ///< distinguishes runs with the same name, > 0
  std::optional<LcmAddress> address;  ///< where it talks; nothing: within its own process only
  std::string task;                   ///< e.g. "drawing"
  std::filesystem::path run_folder;   ///< absolute
  pid_t pid{};                        ///< the task's parent process; filled in by SessionFile
};

/// @return whether the name is 1..kMaxSessionName characters of A-Z a-z 0-9 _ -
[[nodiscard]] bool valid_session_name(std::string_view name) noexcept;
/// @throws FaultError bad_usage, unless valid_session_name
void check_session_name(std::string_view name);

/// @return a random number > 0, for SessionInfo::id and whatever else must not be guessed twice
[[nodiscard]] std::int64_t random_id();

/// The address at which a session talks unless it is told another: a pure function of the name, so that any
/// host can compute it. Ports are 20000..29999 in steps of 4, of which the groups use the first three; two
/// names share a port with probability 1/2500, and are then kept apart by channel names and session ids.
[[nodiscard]] LcmAddress address_for(std::string_view session);

/// @return ${XDG_RUNTIME_DIR}/mrroc-UID, or /tmp/mrroc-UID when there is no such variable or directory
[[nodiscard]] std::filesystem::path session_directory();

/// @param task characters that a name cannot have become '-'; cut to leave room
/// @return a name that no running session has, such as drawing-1a2b
[[nodiscard]] std::string unique_session_name(std::string_view task,
                                              const std::filesystem::path& directory = session_directory());

/// @return what runs, by name. Files whose process is dead are deleted; files that are not session files are
///         left alone. A directory that is not there holds nothing.
[[nodiscard]] std::vector<SessionInfo> running_sessions(
    const std::filesystem::path& directory = session_directory());

/// The entry of a running task, from construction to destruction. A task that dies without a destructor
/// leaves a file that everybody recognises as dead, even when its process number has been given away again.
class SessionFile {
 public:
  /// Makes the directory (mode 0700) and enters the calling process. Of several that try the same name at
  /// the same time, one succeeds.
  /// @param info pid is ignored
  /// @throws FaultError bad_usage: the name; session_in_use: a living process has it; cannot_write: the
  ///         directory or file cannot be written, or the directory is open to others
  explicit SessionFile(SessionInfo info, const std::filesystem::path& directory = session_directory());
  SessionFile(const SessionFile&) = delete;
  SessionFile& operator=(const SessionFile&) = delete;
  /// Removes the file, if this is the process that made it: a forked child leaves it alone.
  ~SessionFile();

  /// @return what the file says
  [[nodiscard]] const SessionInfo& info() const { return info_; }
  /// @return of the file
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  SessionInfo info_;
  std::filesystem::path path_;
};

}  // namespace mrroc::link
