#include "test/docs/rex_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/msg/convert_platform.hpp"
#include "ecp/map/map_agent.hpp"
#include "edp/platform/driver.hpp"
#include "edp/platform/guard.hpp"
#include "mp/black_box.hpp"
#include "mrroc/agent_order_t.hpp"
#include "mrroc/agent_report_t.hpp"
#include "tasks/rex_drive/keys.hpp"
#include "tasks/rex_drive/locomotion.hpp"
#include "tasks/rex_drive/ontology.hpp"
#include "test/docs/rex_data_flow.hpp"

namespace mrroc::test {
namespace {

using rex_drive::Locomotion;

// The name of a member or a function, which there must be.
// NOLINTBEGIN(bugprone-macro-parentheses): a type and a member cannot stand in parentheses
#define MRROC_MEMBER(type, path) (static_cast<void>(sizeof(std::declval<type&>().path)), #type "::" #path)
#define MRROC_FIELD(type, path) (static_cast<void>(sizeof(std::declval<type&>().path)), #type "." #path)
#define MRROC_FUNCTION(name) (static_cast<void>(sizeof(&name)), #name)
// NOLINTEND(bugprone-macro-parentheses)

// --- figures 3 and 4 --------------------------------------------------------------------------------------------

struct ChannelRow {
  std::string paper, channel, message, from, to;
};

std::string table(const std::vector<ChannelRow>& rows) {
  std::string text = "| paper | channel | message | from | to |\n| --- | --- | --- | --- | --- |\n";
  for (const ChannelRow& r : rows)
    text += fmt::format("| {} | `{}` | `{}` | `{}` | {} |\n", r.paper, r.channel, r.message, r.from, r.to);
  return text;
}

/// @param channel  FROM.TO.WHAT @return its sender
std::string first_word(const std::string& channel) { return channel.substr(0, channel.find('.')); }
std::string process_of(const std::string& key) { return key == rex_drive::kCoordinator ? key : "ecp-" + key; }

template <class Message>
ChannelRow link_row(const char* paper, const std::string& channel, const std::string& to) {
  return {paper, channel, Message::getTypeName(), process_of(first_word(channel)),
          "`" + process_of(to) + "`"};
}
/// @param what  of the platform's channel, "command"
template <class Message>
ChannelRow platform_row(const char* paper, const std::string& key, const char* what, const std::string& to) {
  const std::string channel = key + "." + what;
  const std::string message = Message::getTypeName();
  return {paper, channel, message, mp::sender_of(channel, message), to};
}

std::string figure_3() {
  const std::string rex = rex_drive::kPlatform, map = rex_drive::kMap;
  return table({
      link_row<plan_t>("T_x c_1,2[desired_plan]", rex_drive::plan_channel(), rex),
      platform_row<agent_report_t>("T_y c_1,2[ack]: the field `event`", rex, "report", "`mp`"),
      link_row<map_report_t>("T_x c_1,3[x^, y^, phi^]", rex_drive::pose_channel(), rex),
      link_row<platform_estimate_t>("T_y c_1,3[q~, q~']", rex_drive::estimate_channel(), map),
      platform_row<motion_capture_t>("motion capture", rex, "motion_capture", "`ecp-" + map + "`"),
      platform_row<agent_order_t>("- (start, pause, end)", rex, "order", "`ecp-" + rex + "`"),
      platform_row<agent_order_t>("- (the same)", map, "order", "`ecp-" + map + "`"),
      platform_row<agent_report_t>("- (position seen or lost)", map, "report", "`mp`"),
  });
}

std::string figure_4() {
  const std::string rex = rex_drive::kPlatform;
  const std::string simulator = "simulator";
  const auto step_row = [&](const char* paper, const char* what, const char* message, const std::string& from,
                            const std::string& to) {
    return ChannelRow{paper, rex + "." + what, message, from, to};
  };
  return table({
      platform_row<platform_command_t>("c_1 -> e_1,1", rex, "command", "`edp-" + rex + "`"),
      platform_row<platform_reply_t>("e_1,1 -> c_1", rex, "reply", "`ecp-" + rex + "`"),
      step_row("e_1,1 -> E_1", "hardware_command", platform_drive_t::getTypeName(), "edp-" + rex,
               "`" + simulator + "`"),
      step_row("E_1 -> e_1,1", "hardware_state", platform_reading_t::getTypeName(), simulator,
               "`edp-" + rex + "`"),
      step_row("r_1,1 -> c_1", "odometry", odometry_reading_t::getTypeName(), "vsp-odometry-" + rex,
               "`ecp-" + rex + "`"),
      platform_row<platform_telemetry_t>("-", rex, "telemetry", "log, viewers"),
      platform_row<platform_truth_t>("-", rex, "truth", "figures, viewers; never control"),
  });
}

// --- figure 5 -----------------------------------------------------------------------------------------------------

template <class Function>
struct Named {
  Function function;
  const char* name;
};
using Row = Motion<Locomotion>;

/// @return of a function of the table its name, in the form of its algorithm
template <class Function, std::size_t n>
std::string name_of(Function function, const std::array<Named<Function>, n>& names, const char* else_name) {
  for (const Named<Function>& each : names)
    if (each.function == function) return each.name;
  return else_name;
}

std::string memory_name(const Row& row) {
  const std::array<Named<decltype(Row::f_cc)>, 3> names{
      {{rex_drive::take_plan, "Alg. 4 `take_plan`"},
       {rex_drive::plan_and_hand_over, "Alg. 6 `plan_and_hand_over`"},
       {rex_drive::kBehaviours[2].f_cc, "keeps, but for the pace"}}};
  return name_of(row.f_cc, names, "?");
}
std::string effector_name(const Row& row) {
  const std::array<Named<decltype(Row::f_ce)>, 2> names{
      {{rex_drive::fragment, "routes; Alg. 7 `fragment`"}, {rex_drive::kBehaviours[0].f_ce, "routes"}}};
  return name_of(row.f_ce, names, "?");
}
std::string told_name(const Row& row) {
  const std::array<Named<decltype(Row::f_cT)>, 3> names{{{rex_drive::take_back_ack, "Alg. 5 `take_back_ack`"},
                                                         {rex_drive::acknowledge, "Alg. 8 `acknowledge`"},
                                                         {rex_drive::kBehaviours[1].f_cT, "tells, no ack"}}};
  return name_of(row.f_cT, names, "?");
}

std::string figure_5() {
  std::string text =
      "| m | behaviour | c,c f | c,e f | c,T f | ends when |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const Row& row : rex_drive::kBehaviours)
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.m, row.name, memory_name(row),
                        effector_name(row), told_name(row), row.until);
  text += "\nThe automaton:\n\n```\n";
  const auto& start = rex_drive::kWaitForStart;
  const Row* from = &start;
  for (const Row& row : rex_drive::kBehaviours) {
    text += fmt::format("{} {} -- {} --> {} {}\n", from->m, from->name, from->until, row.m, row.name);
    from = &row;
  }
  const Row& first = rex_drive::kBehaviours.front();
  text += fmt::format("{} {} -- {} --> {} {}\n```\n", from->m, from->name, from->until, first.m, first.name);
  text += fmt::format(
      "\nWhen the order says that the task is over, the program ends after the behaviour under way. A "
      "planner that finds no way leads to m = {}, {}.\n",
      rex_drive::kGiveUp.m, rex_drive::kGiveUp.name);
  return text;
}

template <class... Motions>
std::string small_agent(const Motions&... motions) {
  std::string text = "| m | behaviour | ends when |\n| --- | --- | --- |\n";
  ((text += fmt::format("| {} | {} | {} |\n", motions.m, motions.name, motions.until)), ...);
  return text;
}

// --- figure 6 -----------------------------------------------------------------------------------------------------

std::string name(const BufferName& buffer) {
  return buffer.paper == "-" ? fmt::format("`{}`", buffer.here)
                             : fmt::format("{} `{}`", buffer.paper, buffer.here);
}
std::string names(const std::vector<BufferName>& buffers) {
  std::string text;
  for (const BufferName& buffer : buffers)
    text += (text.empty() ? "" : ", ") + (buffer.paper == "-" ? "*" + name(buffer) + "*" : name(buffer));
  return text;
}

std::string figure_6() {
  const auto flows = data_flows();
  std::string text;
  for (const Row& row : rex_drive::kBehaviours) {
    text += fmt::format("{}m = {}, {}:\n\n| function | output | is made of |\n| --- | --- | --- |\n",
                        text.empty() ? "" : "\n", row.m, row.name);
    std::string kept, same;
    for (const Flow& flow : flows) {
      if (flow.m != row.m) continue;
      if (flow.kept) {
        kept += (kept.empty() ? "" : ", ") + fmt::format("`{}`", flow.output.here);
      } else if (flow.inputs.empty()) {
        same += (same.empty() ? "" : ", ") + fmt::format("`{}`", flow.output.here);
      } else {
        text += fmt::format("| `{}` | {} | {} |\n", flow.function, name(flow.output), names(flow.inputs));
      }
    }
    if (!kept.empty()) text += fmt::format("\nKept as they were: {}.\n", kept);
    if (!same.empty()) text += fmt::format("\nThe same whatever is read: {}.\n", same);
  }
  return text;
}

// --- figures 7 and 8 ----------------------------------------------------------------------------------------------

struct BufferRow {
  std::string paper, value, field, function;
};
std::string table(const std::vector<BufferRow>& rows) {
  std::string text = "| paper | value | field of the message | function |\n| --- | --- | --- | --- |\n";
  const auto cell = [](const std::string& word) {
    constexpr std::string_view kSpace = "edp::";
    return word == "-" ? word : "`" + word.substr(word.starts_with(kSpace) ? kSpace.size() : 0) + "`";
  };
  for (const BufferRow& r : rows)
    text += fmt::format("| {} | {} | {} | {} |\n", r.paper, cell(r.value), cell(r.field), cell(r.function));
  return text;
}

std::string figure_7() {
  using edp::EstimatorResult, edp::FragmentQueue, edp::Observer, edp::PlatformDriver, edp::Tracker,
      edp::TrackerResult, edp::StageReading;
  return table(std::vector<BufferRow>{
      {"c_x e_1,1[x^, y^, phi^]", MRROC_MEMBER(PlatformCommand, map), MRROC_FIELD(platform_command_t, map),
       MRROC_FUNCTION(Observer::note)},
      {"c_x e_1,1[A_4x4]", MRROC_MEMBER(PlatformCommand, odometry), MRROC_FIELD(platform_command_t, odometry),
       MRROC_FUNCTION(Observer::note)},
      {"c_x e_1,1[traj]", MRROC_MEMBER(Fragment, knot), MRROC_FIELD(platform_command_t, fragment),
       MRROC_FUNCTION(PlatformDriver::take)},
      {"c_x e_1,1[steps]", MRROC_MEMBER(Fragment, steps), MRROC_FIELD(platform_command_t, fragment.steps),
       MRROC_FUNCTION(edp::check_fragment)},
      {"c_x e_1,1[notify]", MRROC_MEMBER(Fragment, notify), MRROC_FIELD(platform_command_t, fragment.notify),
       MRROC_FUNCTION(edp::check_fragment)},
      {"-", MRROC_MEMBER(PlatformCommand, pace), MRROC_FIELD(platform_command_t, pace),
       MRROC_FUNCTION(edp::Pace::go_to)},
      {"E_x e_1,1[alpha, alpha']", MRROC_MEMBER(PlatformReading, yaw_rate),
       MRROC_FIELD(platform_reading_t, yaw_rate), MRROC_FUNCTION(edp::StageCollector::measure)},
      {"E_x e_1,1[F_ij,k]", MRROC_MEMBER(PlatformReading, load), MRROC_FIELD(platform_reading_t, load),
       MRROC_FUNCTION(edp::StageCollector::measure)},
      {"E_x e_1,1[theta, theta']", MRROC_MEMBER(PlatformReading, encoder),
       MRROC_FIELD(platform_reading_t, encoder), MRROC_FUNCTION(edp::StageCollector::measure)},
      {"e_e1,1[estym]", MRROC_MEMBER(EstimatorResult, estimate), "-", MRROC_FUNCTION(edp::Estimator::step)},
      {"e_e1,1[track]", MRROC_MEMBER(TrackerResult, torque), "-", MRROC_FUNCTION(Tracker::step)},
      {"e_e1,1[step]", MRROC_MEMBER(PlatformReply, remaining), MRROC_FIELD(platform_reply_t, remaining),
       MRROC_FUNCTION(FragmentQueue::advance)},
      {"e_e1,1[notify]", MRROC_MEMBER(PlatformReply, notified), MRROC_FIELD(platform_reply_t, notified),
       MRROC_FUNCTION(FragmentQueue::advance)},
      {"e_e1,1[tau]", MRROC_MEMBER(StageReading, torque), "-", MRROC_FUNCTION(edp::StageCollector::command)},
      {"c_y e_1,1[q~, q~']", MRROC_MEMBER(PlatformReply, estimate), MRROC_FIELD(platform_reply_t, estimate),
       MRROC_FUNCTION(edp::build_reply)},
      {"c_y e_1,1[ready]", MRROC_MEMBER(PlatformReply, notified), MRROC_FIELD(platform_reply_t, notified),
       MRROC_FUNCTION(rex_drive::is_ready)},
      {"E_y e_1,1[tau]", MRROC_MEMBER(PlatformDrive, torque), MRROC_FIELD(platform_drive_t, torque),
       MRROC_FUNCTION(PlatformDriver::step)},
      {"E_y e_1,1[cmd_E1,1]", MRROC_MEMBER(PlatformDrive, imu_reset),
       MRROC_FIELD(platform_drive_t, imu_reset), MRROC_FUNCTION(edp::PlatformSynchronisation::resets_imu)},
      {"p, slip of the wheels", MRROC_MEMBER(PlatformReply, slip), MRROC_FIELD(platform_reply_t, slip),
       MRROC_FUNCTION(Observer::slip)},
  });
}

std::string figure_8() {
  return table(std::vector<BufferRow>{
      {"c_y r_1,1[A_4x4]", MRROC_MEMBER(OdometryReading, A), MRROC_FIELD(odometry_reading_t, motion), "-"},
      {"- (k of r_1,1, the pairs' stages)", MRROC_MEMBER(OdometryReading, step_before),
       MRROC_FIELD(odometry_reading_t, motion), "-"},
  });
}

}  // namespace

std::vector<MadePart> rex_tables() {
  return {{"figure 3", figure_3()},
          {"figure 4", figure_4()},
          {"figure 5", figure_5()},
          {"ontology agent", small_agent(rex_drive::kStart, rex_drive::kSendPlan, rex_drive::kAwaitAck,
                                         rex_drive::kComeToRest)},
          {"map agent", small_agent(ecp::kLocate, ecp::kPositionGone)},
          {"figure 6", figure_6()},
          {"figure 7", figure_7()},
          {"figure 8", figure_8()}};
}

std::string with_parts(std::string document, const std::vector<MadePart>& parts) {
  for (const MadePart& part : parts) {
    const std::string begin = fmt::format("<!-- made: {} -->\n", part.name);
    const std::string end = fmt::format("<!-- end: {} -->\n", part.name);
    const std::size_t first = document.find(begin);
    const std::size_t last = document.find(end);
    if (first == std::string::npos || last == std::string::npos || last < first)
      throw std::runtime_error("the document has no place for " + part.name);
    const std::size_t from = first + begin.size();
    document.replace(from, last - from, "\n" + part.text + "\n");
  }
  return document;
}

}  // namespace mrroc::test
