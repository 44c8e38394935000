// A* over grips, postures and what has been done of the order.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tasks/rubik/plan/motions.hpp"
#include "tasks/rubik/plan/planner.hpp"

namespace mrroc::rubik {

/// Turns of one face, or of two opposite ones, whose order does not matter.
struct TurnGroup {
  std::vector<Move> moves;  ///< one or two
};
/// @return the turns so grouped; those of one face are taken together, and what cancels is left out
[[nodiscard]] std::vector<TurnGroup> grouped(std::span<const Move> moves);

/// What is to be done: turns, or faces to be shown.
struct Order {
  std::vector<TurnGroup> groups;
  bool show_all{};
};

/// A state between two steps: one hand holds, the other one is drawn back.
struct Node {
  Grasp grasp;                   ///< of the hand that holds
  std::array<int, 2> stances{};  ///< of both hands, by index(Hand)
  int done{};  ///< turns: 4 * groups + bits of the group's moves; faces: bits of those shown

  friend auto operator==(const Node&, const Node&) -> bool = default;
};

/// A step that leads to the next node.
struct Edge {
  int holder{}, comer{};  ///< postures in which both hands meet; `shows`: holder's alone
  std::optional<Move> turn;
  int quarters{};       ///< by which the track arm turns
  bool comer_leaves{};  ///< the hand that has come also goes
  std::optional<Face> shows;
  Node to;
  double cost{};  ///< [s], with the penalty
};

/// Finds cheapest sequences. Motions whose ways are not known count as straight lines.
class GraspSearch {
 public:
  GraspSearch(const Motions& motions, const PlanOptions& options, Order order)
      : motions_(motions), options_(options), order_(std::move(order)) {}

  /// @return edges from the node to the end of the order; nothing: there is no way
  [[nodiscard]] std::optional<std::vector<Edge>> run(const Node& start) const;
  /// @return the motions of an edge in their order
  [[nodiscard]] std::vector<Motion> motions_of(const Node& from, const Edge& edge) const;

 private:
  [[nodiscard]] std::vector<Edge> edges(const Node& node) const;
  void add_meetings(std::vector<Edge>& edges, const Node& node, int holder, Place comes) const;
  void add_turns(std::vector<Edge>& edges, const Node& node, const Edge& meeting, const Grasp& comer) const;
  void add_looks(std::vector<Edge>& edges, const Node& node) const;
  void add(std::vector<Edge>& edges, const Node& node, Edge edge) const;
  [[nodiscard]] std::vector<int> holder_stances(const Node& node, Place place) const;
  [[nodiscard]] bool is_done(const Node& node) const;
  [[nodiscard]] double least_rest(const Node& node) const;
  [[nodiscard]] std::optional<int> turned_stance(int stance, int quarters) const;

  const Motions& motions_;
  PlanOptions options_;
  Order order_;
};

}  // namespace mrroc::rubik
