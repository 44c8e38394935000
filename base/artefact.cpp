#include "base/artefact.hpp"

#include "base/representation.hpp"

namespace mrroc {

std::optional<ArtefactDescription> read_artefact(const Config& config) {
  const Config t = config.section("artefact");
  const auto numbers = t.list("balls", std::vector<double>{}, {-2, 2},
                              "m, x y z of each in the artefact's frame; empty: there is none");
  if (numbers.empty()) return {};
  if (numbers.size() % 3 != 0)
    throw FaultError(FaultCode::bad_configuration, "artefact.balls: each ball has three numbers, x y z");
  ArtefactDescription d;
  for (std::size_t k = 0; k < numbers.size(); k += 3)
    d.balls.emplace_back(numbers[k], numbers[k + 1], numbers[k + 2]);
  d.diameter = t.number("diameter", d.diameter, {0.01, 0.2}, "m");
  const auto place = t.numbers<6>("place", {{0, 0, 0, 0, 0, 0}}, {-10, 10}, "m, rad, in the world");
  d.T_UA = pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(place.data()));
  return d;
}

}  // namespace mrroc
