// A task without robots that says what a real one says, macrostep by macrostep: something to look at.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/link/bus.hpp"
#include "base/link/frame_store.hpp"
#include "base/link/session.hpp"

namespace mrroc::test {

/// Two arms of which the first draws a circle on its sheet. Entered as a running session from construction to
/// destruction.
class SampleTask {
 public:
  /// Macrosteps per second of a task in real time.
  static constexpr int kPerSecond = 50;

  /// @param run  its run folder is written there, without an event log
  /// @throws FaultError session_in_use, cannot_write; NoMulticast
  SampleTask(const std::string& session, const std::filesystem::path& run);

  /// Says what belongs to the next macrostep: of each arm order, command, reply, report and samples; ten times a
  /// second the status; 25 times a second a picture. After half a second the camera's store has no name any more.
  void step();
  /// @return replies of one arm so far
  [[nodiscard]] std::int64_t steps() const { return i_; }

 private:
  void take_picture();
  template <class M>
  void publish(const std::string& name, const M& m, std::int64_t number);

  std::string session_;
  std::unique_ptr<link::SessionFile> file_;
  std::unique_ptr<link::Bus> bus_;
  std::unique_ptr<link::FrameWriter> camera_;
  std::int64_t i_{};
};

}  // namespace mrroc::test
