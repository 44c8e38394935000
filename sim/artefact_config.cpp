#include "sim/artefact_config.hpp"

#include "base/artefact.hpp"
#include "base/representation.hpp"

namespace mrroc::sim {

std::optional<ArtefactParameters> read_true_artefact(const Config& config) {
  const auto told = read_artefact(config);
  if (!told) return {};
  const auto offset = config.numbers<6>(
      "sim.artefact.offset", {{0, 0, 0, 0, 0, 0}}, {-0.5, 0.5},
      {"m, rad", "by which all balls stand elsewhere, in their own frame", "artefact.place"});
  const Pose T_UA = told->T_UA * pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(offset.data()));
  ArtefactParameters p;
  p.diameter = told->diameter;
  for (const Vector3& ball : told->balls) p.balls.push_back(T_UA * ball);
  return p;
}

}  // namespace mrroc::sim
