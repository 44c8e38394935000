// Which of the running tasks a terminal attaches to.
#pragma once
#include <string>
#include <vector>

#include "base/link/session.hpp"

namespace mrroc::ui {

/// What the user said on the command line; empty: nothing.
struct Wish {
  std::string session;  ///< name of the session
  std::string url;      ///< udpm://HOST:PORT?ttl=N, for a task of another host or user
};

/// @param running as link::running_sessions gives them
/// @return the session wished for, or the only one that runs, always with an address; a session that is not
///         among the running ones, but wished for with an url, has the id and the pid 0
/// @throws FaultError bad_usage: the name or url cannot be one, or an url without a name
/// @throws FaultError no_such_session, naming the candidates, or how to start a task when none runs
link::SessionInfo choose_session(const Wish& wish, const std::vector<link::SessionInfo>& running);

}  // namespace mrroc::ui
