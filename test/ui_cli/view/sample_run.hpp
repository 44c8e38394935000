// Messages of a small task, for the tests of the viewer.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/link/channel.hpp"
#include "base/link/decode.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/cube_truth_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/object_truth_t.hpp"
#include "mrroc/task_status_t.hpp"

namespace mrroc::test {

/// A folder that is removed at the end.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// @return config.toml of a cell: arm1 on a pedestal with a pen, arm2 on a track with a gripper and a cube, a camera, a
///         chessboard
[[nodiscard]] std::string sample_config();

/// @return bytes of a message with such a header
template <link::FixedMessage M>
std::vector<std::uint8_t> encoded(M message, std::int64_t number, std::int64_t stamp,
                                  std::int64_t session = 7) {
  message.header = {session, number, stamp};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<M>()));
  message.encode(bytes.data(), 0, link::encoded_size<M>());
  return bytes;
}

/// @return a driver's reply of macrostep i: synchronised, joint k is 0.1 k + i / 1000, E is in the arm's base at (x, y, z) [m],
///         F_z = i
[[nodiscard]] effector_reply_t reply(std::int64_t i, double x, double y, double z);

/// @return what an agent reports
[[nodiscard]] agent_report_t report(int m);

/// @return a solved cube between the arms whose upper layer turns by 0.7 rad in 10 s
[[nodiscard]] cube_truth_t cube(std::int64_t i);

/// @return a status: the coordinator is in behaviour m
[[nodiscard]] task_status_t status(int m, std::string_view name);

/// @return a line of a process
[[nodiscard]] console_t line(std::string_view text, int code = 0);

/// Writes a run folder: config.toml, summary.json, two pictures, and an event log with `macrosteps` replies of both
/// arms. arm1 gets a new sheet after a quarter
/// of it; its pen is on the paper in the second half.
void write_run(const std::filesystem::path& folder, int macrosteps);

/// Writes a run folder of an arm and a platform whose messages have numbers and texts that no driver tells: times and places
/// of any size, no numbers, markup.
void write_wild_run(const std::filesystem::path& folder);

/// @return the rows of a track of a piece of news, one after the other
[[nodiscard]] std::vector<float> rows_of(const std::string& news, const std::string& track);

}  // namespace mrroc::test
