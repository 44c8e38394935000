// Which set of lengths and zero positions each arm has: the one with which what it touched are balls, and those of the other
// arm.
#pragma once
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "tasks/calibrate_cell/cell/cell.hpp"

namespace mrroc::calibrate_cell {

/// What the touches say when each arm is taken to have one of its sets.
struct SetsFit {
  SetNumbers sets{};                     ///< of the arms
  std::array<std::string, kArms> names;  ///< as robots.ARM.kinematics has them; empty: the arm has but one
  std::optional<Calibration> found;      ///< what follows; nothing: with these sets the touches are no balls
  double rms{std::numeric_limits<double>::infinity()};  ///< misfit() [m]
};

/// What all pairs of sets say.
struct SetsVerdict {
  std::vector<SetsFit> fits;  ///< of all pairs, the best one first; at least one
  std::size_t chosen{};       ///< the best one; when they cannot be told apart, the one that drivers believe
  bool told_apart{};          ///< the best one fits clearly better than the next, or there is but one
};

/// Takes back what drivers made of the encoders with the sets that they believe, and does it anew with each other set.
/// @param traces  of both arms, by their drivers @param config  with robots.ARM.synchro_joints, if SYNCHRO is told them
/// @throws ConfigError
[[nodiscard]] SetsVerdict fit_sets(const std::vector<mp::ArmTrace>& traces, const Config& config);

/// @return the sets that drivers believe @throws ConfigError
[[nodiscard]] SetNumbers believed_sets(const Config& config);

/// @return the traces as drivers would have measured them with these sets: rows of touches, and of pictures, alone
/// @param traces  of both arms, by their drivers @throws ConfigError
[[nodiscard]] std::vector<mp::ArmTrace> measured_with(const std::vector<mp::ArmTrace>& traces,
                                                      const SetNumbers& sets, const Config& config);

/// @return every pair with its misfit, and in words when they cannot be told apart; lines, each ended by a line feed
[[nodiscard]] std::string describe(const SetsVerdict& verdict);

/// Adds sets_rms_mm, other_sets_rms_mm and sets_wrong. @param real  as true_sets()
void add_figures(mp::TaskFigures& figures, const SetsVerdict& verdict, const SetNumbers& real);

}  // namespace mrroc::calibrate_cell
