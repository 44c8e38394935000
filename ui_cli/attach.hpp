// Selects the running task to which a terminal attaches.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/link/session.hpp"

namespace mrroc::ui {

/// The user's choice on the command line; empty: none.
struct SessionSelector {
  std::string session;               ///< name of the session
  std::string url;                   ///< udpm://HOST:PORT?ttl=N, for a task of another host
  std::filesystem::path key_file{};  ///< key of that session
};

/// @param running as link::running_sessions gives them
/// @return the selected session, or the only one that runs, always with an address; a session that is not among the
///         running ones, but selected with an url, has the id and the pid 0, and a key only from a key file
/// @throws FaultError bad_usage: the name, url or key file cannot be one, or an url without a name
/// @throws FaultError no_such_session, naming the candidates, or how to start a task when none runs
link::SessionInfo choose_session(const SessionSelector& selector,
                                 const std::vector<link::SessionInfo>& running);

}  // namespace mrroc::ui
