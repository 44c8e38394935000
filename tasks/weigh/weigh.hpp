// One arm turns its tool into three orientations and finds weight and mass centre (MG 8.2.1).
#pragma once
#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "ecp/generators/weighing.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::weigh {

/// c_c: what the arm remembers.
struct Memory {
  ecp::Weighing weighing;  ///< all that the rows need
};
/// The only one of the task.
struct Arm : ArmAgent<Memory> {};

/// The behaviours: ecp::WeighingRows, m = 1..10.
extern const std::array<Motion<Arm>, 10> kWeigh;

/// @return memory at the beginning: the plan, from [task] and the tool of the arm
/// @throws ConfigError
Memory read_memory(const Config& config, const std::string& arm);

/// Body of the ECP.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

inline constexpr int kWithToolUp = 6, kWithToolSideways = 9;  ///< behaviours that read the force

/// @param m  kWithToolUp or kWithToolSideways @return F_a, mean over that behaviour [N], [N m]; NaN without a row
[[nodiscard]] Wrench mean_reading(const mp::ArmTrace& trace, int m);

/// @return what the readings say; a tool without weight when there are none
ecp::ForceTool found_tool(const mp::ArmTrace& trace);

/// @return tool_weight_N and tool_mass_centre_m
mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& config);

/// @return what was found as [robots.arm1.tool] of a configuration has it
std::string result(const std::vector<mp::ArmTrace>& arms);

/// @return the task's TOML file
std::string_view config();

}  // namespace mrroc::weigh
