// A* over grips, postures and the part of the goal that has been reached.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "tasks/rubik/plan/goal.hpp"
#include "tasks/rubik/plan/motions.hpp"
#include "tasks/rubik/plan/planner.hpp"

namespace mrroc::rubik {

/// A state between two steps: one hand holds, the other one is drawn back.
struct Node {
  Grasp grasp;                          ///< of the hand that holds
  std::array<int, 2> configurations{};  ///< classes of both hands' postures, by index(Hand)
  int done{};  ///< turns: 4 * groups + bits of the group's moves; faces: bits of those shown

  friend auto operator==(const Node&, const Node&) -> bool = default;
};

/// A step that leads to the next node.
struct Edge {
  int holder{}, comer{};      ///< classes of postures in which both hands meet; `shows`: holder's alone
  std::optional<Move> turn;   ///< none: the cube only changes hands, or is shown
  int quarters{};             ///< by which the track arm turns
  bool either_direction{};    ///< or by as much in the other direction
  bool comer_leaves{};        ///< the hand that has come also goes
  std::optional<Face> shows;  ///< none: it is no look
  Node to;                    ///< state after the step
  double cost{};              ///< [s], with the penalty
};

/// Postures in which a step begins and is done, or classes of them.
struct StepConfigurations {
  std::array<int, 2> before{};   ///< by index(Hand)
  std::array<int, 2> meeting{};  ///< when both hands are at the cube, or when the camera looks
  std::array<int, 2> after{};    ///< when the step is done
};
/// @return the motions of a step in their order
[[nodiscard]] std::vector<ArmTransfer> motions_of(Hand holder, const Edge& edge,
                                                  const StepConfigurations& configurations);

/// Finds cheapest sequences. Motions whose paths are not known count as straight lines.
class GraspSearch {
 public:
  /// @param motions  must outlive the search
  GraspSearch(const Motions& motions, const PlanOptions& options, PlanGoal goal);

  /// @return edges from the node to the goal; nothing: there is no path
  [[nodiscard]] std::optional<std::vector<Edge>> run(const Node& start) const;

 private:
  [[nodiscard]] std::vector<Edge> edges(const Node& node) const;
  void add_meetings(std::vector<Edge>& edges, const Node& node, int holder, Place comes) const;
  void add_turns(std::vector<Edge>& edges, const Node& node, const Edge& meeting, const Grasp& comer) const;
  void add_looks(std::vector<Edge>& edges, const Node& node) const;
  void add(std::vector<Edge>& edges, const Node& node, Edge edge) const;
  [[nodiscard]] std::vector<int> holder_configurations(const Node& node, Place place) const;
  [[nodiscard]] bool is_done(const Node& node) const;
  // A lower bound of what is left to pay.
  [[nodiscard]] double least_rest(const Node& node) const;
  // Time of m = 5, at least and as the edge has it.
  [[nodiscard]] double turning(Move m) const;
  [[nodiscard]] double turning(const Edge& edge) const;
  [[nodiscard]] double least(MotionKind kind, Hand hand, std::optional<Place> from, Place to) const;

  const Motions& motions_;
  PlanOptions options_;
  PlanGoal goal_;
  double grip_{};      // least cost of a step in which an arm comes, without the path to the cube
  double new_face_{};  // least cost of what lies between turns of two faces
  std::vector<double>
      rest_;  // least cost of all turns from each group on, but for what lies before its first
};

}  // namespace mrroc::rubik
