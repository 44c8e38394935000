// The session of a run: its name and address, the bus on which its processes talk, and their start on it.
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/link/lcm_bus.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/process.hpp"
#include "base/link/session.hpp"
#include "mp/options.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::mp {

/// Entered among the running sessions of this user as long as it lives.
class RunSession {
 public:
  /// Enters the session and opens its bus. Nodes of other hosts get the words with which they are started.
  /// @param folder  run folder, exists  @param config  of the run
  /// @throws FaultError session_in_use, no_multicast, cannot_write, bad_usage: hosts; ConfigError: hosts or losses
  RunSession(const std::string& task, const TaskOptions& options, const std::filesystem::path& folder,
             const Config& config, std::vector<NodeSpec>& nodes);

  [[nodiscard]] const std::string& name() const { return context_.session; }  ///< prefix of every channel
  /// @return MP's context
  [[nodiscard]] const link::NodeContext& context() const { return context_; }
  [[nodiscard]] link::Bus& bus() { return *bus_; }  ///< of MP
  /// @return whether all is in one process, so that nobody can attach
  [[nodiscard]] bool alone() const { return !address_; }

  /// Writes processes.json: what is run. @throws FaultError cannot_write
  void write_processes(const std::vector<NodeSpec>& nodes) const;
  /// Starts every node, as a thread or as a process. @throws FaultError start_failed
  void start(Supervisor& supervisor);

 private:
  void choose_address(const TaskOptions& options, bool several_hosts);
  void open_bus();

  std::string task_;
  std::filesystem::path folder_;
  link::NodeContext context_;
  bool separate_;
  std::optional<link::LcmAddress> address_;  // none: all in one process
  std::unique_ptr<link::SessionFile> file_;
  std::unique_ptr<link::MemoryHub> hub_;
  std::unique_ptr<link::Bus> lossless_;  // below bus_, when messages are to be lost
  std::unique_ptr<link::Bus> bus_;
};

}  // namespace mrroc::mp
