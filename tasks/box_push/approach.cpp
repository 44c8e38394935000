#include "tasks/box_push/approach.hpp"

#include <iterator>
#include <limits>

namespace mrroc::box_push {
namespace {

/// @return the room with the box, and a platform that stands in it
Room room_with(const Hall& hall, const PlanarPose& box, const PlanarPose& platform) {
  const Formation& f = hall.formation;
  Room room = hall.room;
  room.obstacles.push_back(rectangle(box, f.box_length, f.box_width));
  room.obstacles.push_back(rectangle(platform, f.platform_length, f.platform_width));
  return room;
}

/// The ways of both for one distribution of places.
struct Ways {
  std::array<Way, kPlatforms> way;
  double length{};
};

/// @param away  where each is to turn before it comes near  @param near  where each is in the end
std::optional<Ways> find_ways(const Hall& hall, const PlanarPose& box, std::size_t first,
                              const std::array<PlanarPose, kPlatforms>& from,
                              const std::array<PlanarPose, kPlatforms>& away,
                              const std::array<PlanarPose, kPlatforms>& near) {
  Ways all;
  for (const std::size_t k : {first, 1 - first}) {
    const Room room = room_with(hall, box, k == first ? from[1 - k] : near[1 - k]);
    const auto way = way_around(room, {from[k].x, from[k].y}, {away[k].x, away[k].y}, hall.reach);
    if (!way) return std::nullopt;
    all.way[k] = *way;
    all.length += way->length;
  }
  return all;
}

}  // namespace

std::optional<Approach> plan_approach(const Hall& hall, const Push& push, const PlanarPose& box,
                                      const std::array<PlanarPose, kPlatforms>& platforms,
                                      const DriveLimits& k) {
  const Formation& f = hall.formation;
  const PlanarPose pair = chained(box, pair_at(f, push.side, f.gap));
  const PlanarPose behind = chained(box, pair_at(f, push.side, f.retreat));
  std::optional<Approach> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& place : {std::array{Place::left, Place::right}, {Place::right, Place::left}}) {
    std::array<PlanarPose, kPlatforms> away, near;
    for (std::size_t n = 0; n < kPlatforms; ++n) {
      away[n] = chained(behind, member_at(f, place[n]));
      near[n] = chained(pair, member_at(f, place[n]));
    }
    for (std::size_t first = 0; first < kPlatforms; ++first) {
      const auto ways = find_ways(hall, box, first, platforms, away, near);
      if (!ways || ways->length >= least) continue;
      least = ways->length;
      best = Approach{push, pair, place, first, {}};
      for (std::size_t n = 0; n < kPlatforms; ++n) {
        best->way[n] = drive_along(ways->way[n], platforms[n], pair.phi, k);
        PlanarPose turned = away[n];
        turned.phi = best->way[n].empty() ? platforms[n].phi : best->way[n].back().knot.back().p.phi;
        for (Fragment& each : straight(turned, f.retreat - f.gap, k)) best->way[n].push_back(each);
      }
    }
  }
  return best;
}

}  // namespace mrroc::box_push
