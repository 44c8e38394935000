#include "tasks/rubik/solver/optimal.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "tasks/rubik/solver/bounds.hpp"

namespace mrroc::rubik {
namespace {

/// A state of the search. It can be continued at both ends: turns of the cube follow each other at the solution's
/// beginning, turns of the inverse, undone, at its end. The side to turn next is always called cube.
struct Node {
  CubePair pair;
  std::array<std::int8_t, kViews>
      bound;     ///< along the axes of the cube, then of the inverse; 0: not looked at
  bool swapped;  ///< cube is the inverse of the cube to solve
};

void swap_sides(Node& n) {
  std::swap(n.pair.cube, n.pair.inverse);
  std::swap_ranges(n.bound.begin(), n.bound.begin() + kAxes, n.bound.begin() + kAxes);
  n.swapped = !n.swapped;
}

/// Searches one depth, for one thread.
class DepthSearch {
 public:
  DepthSearch(const Bounds& bounds, Stopwatch& watch) : bounds_(bounds), counter_(watch) {}

  /// @param turns  how many turns the solution has from here
  /// @return whether a solution was found
  bool search(const Node& node, int turns);
  /// Begins at a state that so many turns led to.
  void begin(const Moves& first) {
    ends_[0] = first;
    ends_[1].clear();
  }
  [[nodiscard]] Moves solution() const {
    Moves moves = ends_[0];
    const Moves last = inverse(ends_[1]);
    moves.insert(moves.end(), last.begin(), last.end());
    return moves;
  }
  [[nodiscard]] bool over() const { return counter_.over(); }
  [[nodiscard]] std::uint64_t nodes() const { return nodes_; }

 private:
  struct Child {
    Node node;
    Move move;
    AxisCoordinates coordinates;  ///< of the side that is looked at
    Probe probe;
  };
  using Children = std::array<Child, kMoves>;

  static int make_children(const Node& node, const Move* last, Children& children);
  int drop_hopeless(const Node& node, Children& children, int count, int left) const;

  const Bounds& bounds_;
  NodeCounter counter_;
  std::array<Moves, 2> ends_;  ///< turns of the cube, turns of the inverse
  std::uint64_t nodes_{};
};

/// @return how many children there are
int DepthSearch::make_children(const Node& node, const Move* last, Children& children) {
  int count = 0;
  for (int m = 0; m < kMoves; ++m) {
    if (!may_follow(last, Move(m))) continue;
    Child& child = children[count++];
    child.move = Move(m);
    child.node.pair = FastTurns::get().after(node.pair, child.move);
    child.node.swapped = node.swapped;
    child.node.bound = {};
  }
  return count;
}

/// Leaves out children that so many turns cannot solve, and notes the others' bounds.
/// @return how many are left
int DepthSearch::drop_hopeless(const Node& node, Children& children, int count, int left) const {
  // The view with the largest bound before the turn is likely to cut off most.
  std::array<int, kViews> views{0, 1, 2, 3, 4, 5};
  const auto by_bound = [&node](int a, int b) { return node.bound[a] > node.bound[b]; };
  std::sort(views.begin(), views.begin() + kAxes, by_bound);
  std::sort(views.begin() + kAxes, views.end(), by_bound);
  for (int v = 0; v < kViews; ++v) {
    for (int k = 0; k < count; ++k) {
      Child& child = children[k];
      const CubePair& pair = child.node.pair;
      if (v % kAxes == 0) child.coordinates = bounds_.coordinates(v < kAxes ? pair.cube : pair.inverse);
      child.probe = bounds_.probe(child.coordinates, views[v] % kAxes);
    }
    int kept = 0;
    for (int k = 0; k < count; ++k) {
      const int bound = bounds_.bound(children[k].probe, left);
      if (bound > left) continue;
      children[k].node.bound[views[v]] = static_cast<std::int8_t>(bound);
      if (kept != k) children[kept] = children[k];
      ++kept;
    }
    count = kept;
  }
  int kept = 0;
  for (int k = 0; k < count; ++k)
    if (bounds_.corner_bound(children[k].node.pair.cube) <= left) children[kept++] = children[k];
  return kept;
}

bool DepthSearch::search(const Node& node, int turns) {
  if (turns == 0) return node.pair.cube == Cube{};
  if (counter_.count()) return false;
  ++nodes_;
  Moves& end = ends_[node.swapped ? 1 : 0];
  const int left = turns - 1;
  Children children;
  int count = make_children(node, end.empty() ? nullptr : &end.back(), children);
  if (left > 0 && left <= bounds_.largest()) count = drop_hopeless(node, children, count, left);
  for (int k = 0; k < count; ++k) {
    Node& next = children[k].node;
    const auto middle = next.bound.begin() + kAxes;
    const bool other_side =
        std::accumulate(middle, next.bound.end(), 0) > std::accumulate(next.bound.begin(), middle, 0);
    end.push_back(children[k].move);
    if (other_side) swap_sides(next);
    if (search(next, left)) return true;
    end.pop_back();
    if (counter_.over()) return false;
  }
  return false;
}

Node root_of(const Cube& cube) { return {CubePair::of(cube), {}, false}; }

/// The states after two turns, for threads to share.
struct Job {
  Moves first;
  Node node;
};

std::vector<Job> make_jobs(const Cube& cube) {
  std::vector<Job> jobs;
  for (int a = 0; a < kMoves; ++a)
    for (int b = 0; b < kMoves; ++b) {
      const Moves first{Move(a), Move(b)};
      if (may_follow(first.data(), Move(b))) jobs.push_back({first, root_of(after(cube, first))});
    }
  return jobs;
}

/// Searches all solutions of one length. @return a solution, or nothing
std::optional<Moves> search_depth(const Bounds& bounds, const Cube& cube, int turns, int threads,
                                  Stopwatch& watch, std::atomic<std::uint64_t>& nodes, bool& complete) {
  std::optional<Moves> found;
  if (threads == 1 || turns < 8) {
    DepthSearch search(bounds, watch);
    if (search.search(root_of(cube), turns)) found = search.solution();
    complete = !search.over();
    nodes += search.nodes();
    return found;
  }
  const std::vector<Job> jobs = make_jobs(cube);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> all{true};
  std::atomic<bool> done{false};
  std::mutex mutex;
  const auto run = [&] {
    DepthSearch search(bounds, watch);
    for (std::size_t k = next++; k < jobs.size() && !search.over() && !done; k = next++) {
      search.begin(jobs[k].first);
      if (!search.search(jobs[k].node, turns - 2)) continue;
      const std::lock_guard guard(mutex);
      if (!found) found = search.solution();
      done = true;
    }
    if (search.over()) all = false;
    nodes += search.nodes();
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads; ++k) others.emplace_back(run);
    run();
  }
  complete = all;
  return found;
}

}  // namespace

OptimalResult solve_optimally(const Bounds& bounds, const Cube& cube, const SearchLimits& limits,
                              const Lengths& lengths) {
  OptimalResult result;
  Stopwatch watch(limits);
  std::atomic<std::uint64_t> nodes{0};
  const int bound = cube == Cube{} ? 0 : std::max(1, bounds.lower_bound(CubePair::of(cube)));
  for (result.lower_bound = std::max(bound, lengths.shortest); result.lower_bound <= lengths.longest;
       ++result.lower_bound) {
    bool complete = true;
    result.moves = search_depth(bounds, cube, result.lower_bound, limits.threads, watch, nodes, complete);
    if (result.moves || !complete) break;
  }
  result.nodes = nodes;
  return result;
}

}  // namespace mrroc::rubik
