#include "ui_cli/view/listener.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/link/decode.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/senders.hpp"
#include "base/link/text.hpp"
#include "base/msg/convert.hpp"
#include "ui_cli/report.hpp"
#include "ui_cli/view/samples.hpp"

namespace mrroc::view {
namespace {

using Json = nlohmann::ordered_json;
using link::get_text;

constexpr std::size_t kMostChannels = 512;  // a system has a few dozen
constexpr std::size_t kMostAgents = 64;     // whose behaviours are told
constexpr std::size_t kMostBehaviours = 1000;
constexpr double kStep = 0.002;  // of the effector drivers [s]

std::string compact(const Json& j) { return j.dump(-1, ' ', true, Json::error_handler_t::replace); }

/// @return the name of the channel without the ending, or nothing when it ends otherwise
std::optional<std::string> before(std::string_view name, std::string_view ending) {
  if (!name.ends_with(ending)) return {};
  return std::string(name.substr(0, name.size() - ending.size()));
}

template <link::FixedMessage M, class Take>
void decoded(std::span<const std::uint8_t> bytes, Take take) {
  if (const auto m = link::decode<M>(bytes)) take(*m);
}

}  // namespace

Listener::Listener(Record& record, Scene scene, std::string session, std::int64_t session_id)
    : record_(record),
      platforms_(record),
      scene_(std::move(scene)),
      session_(std::move(session)),
      session_id_(session_id) {
  for (const ArmScene& a : scene_.arms) arms_[a.name] = {.scene = a, .known = true};
  for (const PlatformScene& p : scene_.platforms) arms_[p.name].known = true;
}

void Listener::receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept {
  try {
    if (is_new(channel, bytes)) take(channel.substr(channel.find('.') + 1), bytes);
  } catch (const std::exception&) {  // no memory: what a page shows is not worth more
    lose(1);
  }
}

void Listener::lose(std::int64_t messages) {
  lost_ += std::min(messages, std::numeric_limits<std::int64_t>::max() - lost_);
}

bool Listener::is_new(std::string_view channel, std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kHeader = 32;  // LCM's fingerprint and header_t
  if (bytes.size() < kHeader) return false;
  const link::RawHeader header = link::header_of(bytes);
  if (session_id_ != 0 && header.session != session_id_) return false;
  if (!link::has_several_senders(channel)) {
    const std::int64_t number = header.number;
    if (number < 1) return false;  // senders count from 1
    auto it = last_.find(channel);
    if (it == last_.end() && last_.size() >= kMostChannels) {
      lose(1);
      return false;
    }
    if (it == last_.end()) it = last_.emplace(std::string(channel), number - 1).first;
    if (number <= it->second) return false;
    lose(number - it->second - 1);
    it->second = number;
  }
  ++messages_;
  return true;
}

/// Whose truth is told that is no platform and no box.
bool is_of_the_cell(std::string_view name) {
  return name == "object" || name == "cube" || name == "free_body";
}

bool Listener::take_of_platform(std::string_view name, std::span<const std::uint8_t> bytes) {
  const auto add = [&](const auto& platform) {
    return [this, &platform](const auto& m) { platforms_.take(platform, m); };
  };
  if (const auto commanded = before(name, ".command")) {
    decoded<platform_command_t>(bytes, add(*commanded));
  } else if (const auto platform = before(name, ".telemetry")) {
    decoded<platform_telemetry_t>(bytes, add(*platform));
  } else if (const auto of = before(name, ".truth"); of && !is_of_the_cell(*of)) {
    decoded<platform_truth_t>(bytes, add(*of));
    decoded<box_truth_t>(bytes, add(*of));
  } else if (const auto link = before(name, ".plan")) {
    const std::string to = link->substr(link->rfind('.') + 1);
    decoded<plan_t>(bytes, [&](const auto& m) { platforms_.take(to, m, t_); });
  } else {
    return false;
  }
  return true;
}

void Listener::take(std::string_view name, std::span<const std::uint8_t> bytes) {
  if (take_of_platform(name, bytes)) return;
  if (const auto effector = before(name, ".reply")) {
    decoded<effector_reply_t>(bytes, [&](const auto& m) { take_reply(*effector, m); });
    decoded<platform_reply_t>(bytes, [&](const auto& m) { take_reply(*effector, m); });
  } else if (const auto of = before(name, ".report")) {
    decoded<agent_report_t>(bytes, [&](const auto& m) { take_report(*of, m.m); });
  } else if (!scene_.platforms.empty() && name == scene_.platforms.front().name + ".order") {
    decoded<agent_order_t>(bytes, [&](const auto& m) { take_order(m); });
  } else if (const auto process = before(name, ".console")) {
    decoded<console_t>(bytes, [&](const auto& m) { log(*process, m.code, get_text(m.text)); });
  } else if (const auto agent = before(name, ".status"); agent && agent->starts_with("ecp-")) {
    decoded<process_status_t>(bytes, [&](const auto& m) { take_status(agent->substr(4), m); });
  } else if (const auto camera = before(name, ".frame")) {
    decoded<camera_frame_t>(bytes, [&](const auto& m) { take_frame(*camera, m); });
  } else if (name == "task_status") {
    decoded<task_status_t>(bytes, [&](const auto& m) { take_status(m); });
  } else if (name == "hand.order") {
    decoded<hand_order_t>(bytes, [&](const auto& m) { take_hands(m); });
  } else if (name == "object.truth") {
    decoded<object_truth_t>(bytes, [&](const auto& m) { take_object(m); });
  } else if (name == "cube.truth") {
    decoded<cube_truth_t>(bytes, [&](const auto& m) { take_cube(m); });
  } else if (name == "free_body.truth") {
    decoded<free_body_truth_t>(bytes, [&](const auto& m) { take_body(m); });
  }
}

void Listener::take_reply(const std::string& name, const effector_reply_t& m) {
  Arm& arm = arms_[name];
  arm.known = true;
  t_ = static_cast<double>(m.step) * kStep;
  take_refusal(name, arm, m.fault);
  if (m.position_known == 0) return;
  std::array<float, kArmColumns.size()> row{drawn(t_), static_cast<float>(arm.m)};
  auto next = row.begin() + 2;
  const auto put = [&](const auto& numbers) {
    for (const double x : numbers) *next++ = drawn(x);
  };
  put(m.joints);
  put(m.T_0E);
  put(m.F_a);
  *next++ = drawn(m.gripper);
  if (arm.scene.belt) belt_ = m.joints[0];
  const bool writes = arm.scene.gripper == "none" && !arm.scene.model.empty() && !arm.scene.belt &&
                      on_paper(arm.scene, {m.T_0E[0], m.T_0E[1], m.T_0E[2]}, belt_);
  *next = arm.new_sheet ? -1.0F : writes ? 1.0F : 0.0F;
  arm.new_sheet = false;
  record_.add(name, row);
}

void Listener::take_reply(const std::string& name, const platform_reply_t& m) {
  Arm& agent = arms_[name];
  agent.known = true;
  t_ = static_cast<double>(m.step) * kStep;
  take_refusal(name, agent, m.fault);
  platforms_.take(name, m, agent.m);
}

void Listener::take_refusal(const std::string& name, Arm& arm, const fault_t& fault) {
  if (fault.code == arm.fault) return;
  arm.fault = fault.code;
  if (fault.code != 0) log("edp-" + name, fault.code, what_happened(from_message(fault)));
}

void Listener::take_report(const std::string& name, int m) {
  Arm& agent = arms_[name];
  agent.m = m;
  // Before the first reply it is not known what time it is.
  if (!agent.known && t_ > 0) record_.add("agent:" + name, std::array{drawn(t_), static_cast<float>(m)});
}

void Listener::take_order(const agent_order_t& m) {
  if (t_ > 0) record_.add("agent:mp", std::array{drawn(t_), static_cast<float>(m.m)});
}

void Listener::take_status(const std::string& agent, const process_status_t& m) {
  name_behaviour(agent, m.m, get_text(m.behaviour));
}

void Listener::take_status(const task_status_t& m) {
  const ui::Snapshot s = ui::snapshot(m, session_);
  std::string text = ui::status_json(s);
  std::erase(text, '\n');  // those within texts are escaped
  record_.set("status", std::move(text));
  name_behaviour("", s.m, s.behaviour);
  for (const ui::AgentView& a : s.agents) name_behaviour(a.name, a.m, a.behaviour);
}

void Listener::name_behaviour(const std::string& agent, int m, const std::string& name) {
  if (m == 0 || name.empty()) return;
  if (behaviours_.size() >= kMostAgents && !behaviours_.contains(agent)) return lose(1);
  auto& names = behaviours_[agent];
  if (names.size() >= kMostBehaviours && !names.contains(std::to_string(m))) return lose(1);
  std::string& known = names[std::to_string(m)];
  if (known == name) return;
  known = name;
  record_.set("behaviours", compact(behaviours_));
}

void Listener::take_hands(const hand_order_t& m) {
  for (std::size_t k = 0; k < std::min(scene_.arms.size(), std::size(m.new_sheet)); ++k)
    if (m.new_sheet[k] != 0) arms_[scene_.arms[k].name].new_sheet = true;
}

void Listener::take_object(const object_truth_t& m) {
  std::array<float, kObjectColumns> row{drawn(static_cast<double>(m.step) * kStep),
                                        m.present != 0 ? 1.0F : 0.0F, m.hidden != 0 ? 1.0F : 0.0F};
  std::ranges::transform(m.T_0G, row.begin() + 3, drawn);
  record_.add(std::string(kObjectTrack), row);
}

void Listener::take_cube(const cube_truth_t& m) {
  constexpr std::string_view kFaces = "URFDLB";
  constexpr std::size_t kStickers = 9;
  std::array<float, kCubeColumns> row{drawn(t_), static_cast<float>(m.axis), drawn(m.angle[0]),
                                      drawn(m.angle[1])};
  auto next = std::ranges::transform(m.T_UC, row.begin() + 4, drawn).out;
  for (std::size_t face = 0; face < kFaces.size(); ++face) {
    int packed = 0;  // below 6^9: a float holds it exactly
    for (std::size_t k = 0; k < kStickers; ++k) {
      const auto colour = kFaces.find(static_cast<char>(m.facelets[face * kStickers + k]));
      packed = 6 * packed + static_cast<int>(colour == std::string_view::npos ? face : colour);
    }
    *next++ = static_cast<float>(packed);
  }
  record_.add(std::string(kCubeTrack), row);
}

void Listener::take_body(const free_body_truth_t& m) {
  std::array<float, kBodyColumns> row{drawn(t_)};
  std::ranges::transform(m.T_UO, row.begin() + 1, drawn);
  record_.add(std::string(kBodyTrack), row);
}

void Listener::take_frame(const std::string& camera, const camera_frame_t& m) {
  if (m.last != 0) return;
  if (on_frame) on_frame(camera, m);
  frames_[camera] = m.header.stamp;
  record_.set("frames", compact(frames_));
}

void Listener::log(const std::string& process, std::int32_t code, const std::string& text) {
  const FaultCode known = fault_code(code).value_or(FaultCode::internal_error);
  record_.log(compact({{"t", t_},
                       {"process", process},
                       {"code", known == FaultCode::none ? "" : std::string(to_string(known))},
                       {"text", text},
                       {"fault", known == FaultCode::none ? 0 : 1}}));
}

void Listener::publish_count() {
  record_.set("count", compact({{"messages", messages_}, {"lost", lost_}, {"refused", record_.refused()}}));
}

}  // namespace mrroc::view
