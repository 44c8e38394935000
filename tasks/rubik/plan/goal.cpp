#include "tasks/rubik/plan/goal.hpp"

#include <algorithm>

namespace mrroc::rubik {

std::vector<TurnGroup> grouped(std::span<const Move> moves) {
  std::vector<TurnGroup> groups;
  for (const Move m : moves) {
    if (groups.empty() ||
        (groups.back().moves[0].face() != m.face() && groups.back().moves[0].face() != opposite(m.face()))) {
      groups.push_back({{m}});
      continue;
    }
    auto& group = groups.back().moves;
    const auto same = std::ranges::find(group, m.face(), &Move::face);
    if (same == group.end()) {
      group.push_back(m);
    } else if (const int quarters = (same->quarters() + m.quarters()) % 4; quarters > 0) {
      *same = Move(m.face(), quarters);
    } else {
      group.erase(same);
      if (group.empty()) groups.pop_back();
    }
  }
  return groups;
}

}  // namespace mrroc::rubik
