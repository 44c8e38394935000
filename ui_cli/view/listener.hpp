// Makes the contents of a page from the messages of a session, live or recorded.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "base/fault.hpp"
#include "base/link/bus.hpp"
#include "mrroc/agent_order_t.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/cube_truth_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "mrroc/free_body_truth_t.hpp"
#include "mrroc/hand_order_t.hpp"
#include "mrroc/object_truth_t.hpp"
#include "mrroc/platform_reply_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/task_status_t.hpp"
#include "ui_cli/view/platform_track.hpp"
#include "ui_cli/view/record.hpp"
#include "ui_cli/view/scene.hpp"

namespace mrroc::view {

/// Listens to every channel of one session. What it makes of them, in the record:
///   tracks  one per arm from ARM.reply (samples.hpp); "object" from object.truth; "cube" from cube.truth; "body" from free_body.truth; those of a
///           platform from PLATFORM.reply, .telemetry, .truth and .command, and from the link .PLATFORM.plan of its
///           coordinator; "box:BOX" from BOX.truth; "agent:NAME" of an agent without an effector from NAME.report, and
///           "agent:mp" of the coordinator of platforms from the orders to the first one
///   lines   {t [s], process, code, text, fault: 0 or 1} from *.console, and what a driver refused
///   values  "status" (ui::status_json), "behaviours" {agent: {m: name}} with "" for the coordinator, "frames" {camera:
///           number}, "count" {messages, lost, refused: what the record had no room for}
/// A message that comes again is ignored; numbers that are missing are counted as lost, and so is what comes on more
/// channels than a system has. A reading of a driver that
/// does not know its position yet is no row: there is nothing to draw.
class Listener final : public link::Sink {
 public:
  /// @param record  outlives this
  /// @param session_id  0: whatever comes; else messages of other sessions are ignored
  Listener(Record& record, Scene scene, std::string session, std::int64_t session_id);

  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;

  /// Writes down the counts, which change with every message. To be called now and then.
  void publish_count();

  /// @return messages of the session that were new
  [[nodiscard]] std::int64_t messages() const { return messages_; }
  /// @return messages that are missing, or could not be read
  [[nodiscard]] std::int64_t lost() const { return lost_; }

  /// Called with every picture that is announced. May be empty.
  std::function<void(const std::string& camera, const camera_frame_t&)> on_frame;

 private:
  struct Arm {
    ArmScene scene;
    int m{};
    bool known{};  // the scene has it, or its driver has replied: it is no agent without an effector
    bool new_sheet{};
    std::int32_t fault{};  // told last
  };

  /// Counts them as lost; numbers come from the network, and their sum stays within its bounds.
  void lose(std::int64_t messages);
  [[nodiscard]] bool is_new(std::string_view channel, std::span<const std::uint8_t> bytes);
  void take(std::string_view name, std::span<const std::uint8_t> bytes);
  /// @return whether it was something that a platform, or its coordinator, tells
  bool take_of_platform(std::string_view name, std::span<const std::uint8_t> bytes);
  void take_reply(const std::string& name, const effector_reply_t& m);
  void take_reply(const std::string& name, const platform_reply_t& m);
  void take_refusal(const std::string& name, Arm& arm, const fault_t& fault);
  void take_report(const std::string& name, int m);
  void take_order(const agent_order_t& m);
  void take_status(const task_status_t& m);
  void take_status(const std::string& agent, const process_status_t& m);
  void name_behaviour(const std::string& agent, int m, const std::string& name);
  void take_hands(const hand_order_t& m);
  void take_object(const object_truth_t& m);
  void take_cube(const cube_truth_t& m);
  void take_body(const free_body_truth_t& m);
  void take_frame(const std::string& camera, const camera_frame_t& m);
  void log(const std::string& process, std::int32_t code, const std::string& text);

  Record& record_;
  PlatformTracks platforms_;
  Scene scene_;
  std::string session_;
  std::int64_t session_id_;
  std::map<std::string, Arm, std::less<>> arms_;
  std::map<std::string, std::int64_t, std::less<>> last_;                 // number by channel
  std::map<std::string, std::map<std::string, std::string>> behaviours_;  // name by agent and m
  std::map<std::string, std::int64_t> frames_;
  std::int64_t messages_{};
  std::int64_t lost_{};
  double t_{};
  double belt_{};  // how far it has moved the sheets [m]
};

}  // namespace mrroc::view
