// Transport over LCM (udpm), between processes of one or several hosts.
#pragma once
#include <memory>

#include "base/link/bus.hpp"
#include "base/link/key.hpp"
#include "base/link/multicast_socket.hpp"

namespace mrroc::link {

/// Address of a system: one multicast address, a port per Group beginning with the given one.
struct LcmAddress {
  std::string host{"239.255.76.67"};  ///< of the multicast group
  int port{7667};                     ///< of the first Group; the others follow it
  int ttl{0};                         ///< 0: nothing leaves this host

  /// @param url udpm://HOST:PORT?ttl=N
  /// @throws std::invalid_argument that says what is wrong with the url
  static LcmAddress parse(const std::string& url);
  /// @return as parse() takes it
  [[nodiscard]] std::string url() const;
};

/// @param key  of the session: processes with another one are not heard, see authentication.hpp
/// @throws NoMulticast when there is no route for multicast
std::unique_ptr<Bus> open_lcm(const LcmAddress& address, const Key& key);

/// @return whether open_lcm would succeed and a message arrives
bool multicast_works(const LcmAddress& address);

}  // namespace mrroc::link
