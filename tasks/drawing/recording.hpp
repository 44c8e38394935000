// The recording that teach-in memorises and reproduction executes (MS (39)(40), a_0's memory [1][2][4]).
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/pen_state.hpp"
#include "base/spatial.hpp"
#include "tasks/drawing/ink.hpp"

namespace mrroc::drawing {

/// One macrostep of the teach-in.
struct Node {
  Twist velocity{};  ///< of E during the macrostep, along the axes of E as it was at its beginning
  PenState pen{};    ///< what the pen-state sensor reported in it

  friend bool operator==(const Node&, const Node&) = default;
};

/// The nodes of a taught drawing, a value to which nodes can only be appended. Being part of the
/// coordinator's memory c_c, it is copied with every image; versions therefore share one buffer, of which
/// each sees its first size() nodes.
///
/// Not real-time safe. Versions of one recording must not be used by two threads at once.
class Recording {
 public:
  Recording() = default;
  /// @param macrostep_s  duration of the macrostep in which one node was taken, dt n_s [s]
  explicit Recording(double macrostep_s) : macrostep_s_(macrostep_s) {}

  /// @return this recording with one node more; this one stays as it is. O(1) amortised for the newest
  /// version, a copy for an older one.
  [[nodiscard]] Recording appended(const Node& node) const;

  /// @return the number n of nodes
  [[nodiscard]] std::size_t size() const { return size_; }
  /// @return whether there is no node
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// @param p  from 0 to size() - 1; the papers count from 1
  [[nodiscard]] Node operator[](std::size_t p) const { return (*nodes_)[p]; }
  /// @return the duration of the macrostep [s]
  [[nodiscard]] double macrostep_s() const { return macrostep_s_; }

  /// Two recordings are equal when their durations and all nodes are.
  friend bool operator==(const Recording& a, const Recording& b);

 private:
  std::shared_ptr<std::vector<Node>> nodes_;
  std::size_t size_{};
  double macrostep_s_{};
};

/// A surface through which the pen fell was not the paper: a run of Paper surface that goes over into
/// Lowering, without a Lift-off, becomes Lowering. When the first run is such a one, the drawing begins with the first
/// real touch.
/// @return the recording without such touches
[[nodiscard]] Recording without_false_touches(const Recording& recording);

/// A recording and the ink that was left while it was taught, which later copies are compared with.
struct Taught {
  Recording recording;  ///< nodes
  Ink ink;              ///< on the sheet of the arm that was led

  friend bool operator==(const Taught&, const Taught&) = default;
};

/// The version of the file format that save writes and load reads.
inline constexpr int kRecordingVersion = 1;

/// A taught drawing as text. Lines, fields separated by one space:
///
///     mrroc-drawing-recording 1         format and its version
///     macrostep_s 0.02                  duration of a macrostep [s]
///     nodes N
///     x y z ax ay az pen                N rows: velocity [m/s, rad/s], name of the pen state
///     ink M
///     stroke t x y                      M rows: number from 0, time [s], place on the sheet [mm]
///     end
///
/// Numbers have 17 significant digits, so that load gives back every bit. The two column lines are part of
/// the file.
/// @param name  the file's, for errors
/// @throws FileError  a number is not finite
[[nodiscard]] std::string recording_text(const Taught& taught, const std::string& name);

/// Reads what recording_text makes.
/// @param name  the file's, for errors
/// @throws FileError  naming file and line: another format or version, a wrong count, a number that is not
/// finite, an unknown pen state, no node on the paper, a truncated file or text behind its end
[[nodiscard]] Taught parse_recording(std::string_view text, const std::string& name);

/// @throws FileError  a number is not finite @throws FaultError cannot_write
void save(const std::filesystem::path& file, const Taught& taught);

/// Reads what save writes.
/// @throws FileError  as parse_recording, and when the file cannot be read
[[nodiscard]] Taught load(const std::filesystem::path& file);

}  // namespace mrroc::drawing
