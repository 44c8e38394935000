// Sessions: running tasks of one user find names that are free, and terminals find running tasks.
// A task enters itself as a small file in a directory that only its user can open. Not for the servo step.
#pragma once
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/link/lcm_bus.hpp"

namespace mrroc::link {

/// Longest name of a session [characters].
inline constexpr std::size_t kMaxSessionName = 24;

/// Data that a running task publishes about itself.
struct SessionInfo {
  std::string name;                   ///< 1..kMaxSessionName of A-Z a-z 0-9 _ -; prefix of every channel
  std::int64_t id{};                  ///< distinguishes runs with the same name, > 0
  std::optional<LcmAddress> address;  ///< where it talks; nothing: within its own process only
  std::string task;                   ///< e.g. "drawing"
  std::filesystem::path run_folder;   ///< absolute
  pid_t pid{};                        ///< the task's parent process; filled in by SessionFile
  std::optional<Key> key{};  ///< of its messages, made by SessionFile; nothing: none, or not known here
  std::filesystem::path key_file{};  ///< where that is kept, absolute; empty: none
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

/// Directory in which this user's tasks enter themselves.
struct SessionPlace {
  std::filesystem::path directory;  ///< absolute
  std::string note;                 ///< why it is not the usual one, for a person; empty: it is
};
/// @return ${XDG_RUNTIME_DIR}/mrroc-UID, or /tmp/mrroc-UID when there is no such variable or directory. When another user
///         has taken that name: mrroc/HOST below ${XDG_STATE_HOME} or ~/.local/state; also afterwards, as long as a task is
///         entered there
[[nodiscard]] SessionPlace session_place();
/// @return its directory
[[nodiscard]] std::filesystem::path session_directory();

/// @param task characters that a name cannot have become '-'; cut to leave room
/// @return a name that no running session has, such as drawing-1a2b
[[nodiscard]] std::string unique_session_name(std::string_view task,
                                              const std::filesystem::path& directory = session_directory());

/// @return what runs, by name. Files whose process is dead are deleted; files that are not session files are
///         left alone. A directory that is not there holds nothing.
[[nodiscard]] std::vector<SessionInfo> running_sessions(
    const std::filesystem::path& directory = session_directory());

/// @return an end of the network on which a session talks
/// @param session  with an address
/// @throws FaultError no_such_session: its key is not known  @throws NoMulticast
[[nodiscard]] std::unique_ptr<Bus> open_session(const SessionInfo& session);

/// The entry of a running task, from construction to destruction. A task that dies without a destructor
/// leaves files that everybody recognises as dead, even when its process number has been given away again.
class SessionFile {
 public:
  /// Makes the directory (mode 0700) and enters the calling process; with an address also the key of the session, in a
  /// file of its own (mode 0600). Of several that try the same name at the same time, one succeeds.
  /// @param info pid, key and key_file are ignored
  /// @throws FaultError bad_usage: the name; session_in_use: a living process has it; cannot_write: the
  ///         directory or file cannot be written, or another process holds the lock of the directory for 5 s
  explicit SessionFile(SessionInfo info, const std::filesystem::path& directory = session_directory());
  SessionFile(const SessionFile&) = delete;
  SessionFile& operator=(const SessionFile&) = delete;
  /// Removes the files, if this is the process that made it: a forked child leaves it alone.
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
