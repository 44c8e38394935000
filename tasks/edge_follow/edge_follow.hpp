// Each of two arms leads a finger around a plate, pushing against its edge with 4 N: the edge following
// benchmark.
#pragma once
#include <array>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "base/motion.hpp"
#include "base/pose.hpp"
#include "ecp/generators/force.hpp"
#include "ecp/generators/rows.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::edge_follow {

/// c_c: what an arm remembers.
struct Memory {
  ecp::EdgeRule rule;  ///< from the contact on as slow as suits the edge
  Pose T_WE;           ///< the tool before anything is turned
  Pose T_0E;           ///< of the tool when the edge was found
  double angle{};      ///< of the task frame about z now [rad], grows with every round
  int pushing{};       ///< macrosteps in succession with contact
  double impact{};     ///< largest force so far on the way to the edge [N]
  double farthest{};   ///< largest distance from the place of contact so far [m]
};

/// One of the arms; they know nothing of each other.
struct Arm : ArmAgent<Memory> {};

/// Steps of a macrostep; n_Q is one less.
inline constexpr ecp::Pacing kPacing{.n_s = 8, .n_Q = 7};

/// The behaviours: to the edge, around the plate, away from it.
extern const std::array<Motion<Arm>, 3> kEdgeFollow;

/// @return [task]
/// @throws ConfigError
ecp::EdgeRule read_rule(const Config& config);

/// @return memory at the beginning, from [task] and the tool of the arm
/// @throws ConfigError
Memory read_memory(const Config& config, const std::string& arm);

/// Body of the ECP of each arm.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

/// @return per arm, of the contact force along the edge: edge_follow_rms_N (error), edge_follow_mean_N,
///         edge_follow_peak_N; and edge_follow_s, the time for one round
mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& config);

/// @return the task's TOML file
std::string_view config();

}  // namespace mrroc::edge_follow
