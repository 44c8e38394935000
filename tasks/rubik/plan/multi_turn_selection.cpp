#include "tasks/rubik/plan/multi_turn_selection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace mrroc::rubik {
namespace {

using Pair = std::array<int, 2>;

/// The best path to a pair of postures after a step.
struct Reached {
  double seconds{};
  Pair before{};
  SelectedStep step;
};

/// @return posture of the track arm after a turn by so many quarters
std::optional<int> turned_by(const Motions& motions, int from, int quarters) {
  const auto& configurations = motions.configurations(Hand::track);
  const AxisVector& joints = configurations[static_cast<std::size_t>(from)].hold;
  for (int k = 0; k < static_cast<int>(configurations.size()); ++k) {
    const ArmConfiguration& s = configurations[static_cast<std::size_t>(k)];
    if (s.place == Place::front && std::abs(s.hold[joints.size() - 1] - joints[joints.size() - 1] -
                                            quarters * std::numbers::pi / 2) < 1e-3)
      return k;
  }
  return {};
}

/// Extends the paths by one step.
class Layer {
 public:
  Layer(const Motions& motions, Hand holder, const Edge& edge, std::map<Pair, Reached>& reached)
      : motions_(motions), holder_(holder), edge_(edge), reached_(reached) {}

  void extend(const Pair& before, double seconds) {
    const std::size_t h = index(holder_), w = index(other(holder_));
    const std::vector<int> stays{before[w]};
    const auto& comers =
        edge_.shows ? stays : motions_.classes(other(holder_))[static_cast<std::size_t>(edge_.comer)];
    for (const int holds : motions_.classes(holder_)[static_cast<std::size_t>(edge_.holder)])
      for (const int comes : comers) {
        StepConfigurations s{before, {}, {}};
        s.meeting[h] = holds;
        s.meeting[w] = comes;
        turn(s, seconds);
      }
  }

 private:
  void turn(StepConfigurations s, double seconds) {
    s.after = s.meeting;
    if (!edge_.turn) return add(s, 0, seconds);
    const std::size_t T = index(Hand::track);
    for (const int sign : {1, -1}) {
      if (sign < 0 && !edge_.either_direction) break;
      const auto to = turned_by(motions_, s.meeting[T], sign * edge_.quarters);
      if (!to) continue;
      s.after[T] = *to;
      add(s, sign * edge_.quarters, seconds);
    }
  }

  void add(const StepConfigurations& s, int quarters, double seconds) {
    SelectedStep step{s, quarters, motions_of(holder_, edge_, s)};
    for (const ArmTransfer& m : step.motions) {
      const double one = motions_.seconds(m);
      // The duration of a turn depends on the face.
      seconds += m.kind == MotionKind::turn && std::isfinite(one) ? 0 : one;
    }
    if (!std::isfinite(seconds)) return;
    const auto [place, is_new] = reached_.try_emplace(s.after);
    if (is_new || seconds < place->second.seconds) place->second = {seconds, s.before, std::move(step)};
  }

  const Motions& motions_;
  Hand holder_;
  const Edge& edge_;
  std::map<Pair, Reached>& reached_;
};

}  // namespace

std::optional<std::vector<SelectedStep>> select_turns(const Motions& motions, const Node& start_classes,
                                                      const Pair& start, const std::vector<Edge>& edges) {
  std::vector<std::map<Pair, Reached>> layers(edges.size() + 1);
  layers[0][start] = {};
  Hand holder = start_classes.grasp.hand;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    Layer layer(motions, holder, edges[k], layers[k + 1]);
    for (const auto& [pair, reached] : layers[k]) layer.extend(pair, reached.seconds);
    holder = edges[k].to.grasp.hand;
  }
  if (layers.back().empty()) return {};
  Pair at =
      std::ranges::min_element(layers.back(), {}, [](const auto& l) { return l.second.seconds; })->first;
  std::vector<SelectedStep> steps;
  for (std::size_t k = edges.size(); k > 0; --k) {
    const Reached& r = layers[k].at(at);
    steps.push_back(r.step);
    at = r.before;
  }
  std::ranges::reverse(steps);
  return steps;
}

}  // namespace mrroc::rubik
