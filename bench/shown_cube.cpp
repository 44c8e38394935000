#include "bench/shown_cube.hpp"

#include <cmath>

#include "base/fault.hpp"
#include "sim/camera/cell_scene.hpp"
#include "sim/camera/cube_view.hpp"
#include "tasks/rubik/cell/cube_camera.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/plan/planner.hpp"
#include "test/rig/cube_cell.hpp"

namespace mrroc::bench {
namespace {

using namespace rubik;

/// The cell as the task begins.
sim::WorldParameters start_cell() {
  rubik::CubeCellParameters retreated;
  retreated.distance = kRetreatDistance;
  return rubik::cube_cell(retreated);
}

PlanStart start_of(const sim::WorldParameters& cell) {
  PlanStart start{grasp_from(Hand::track, cell.cube->T_EC.R), {}};
  for (const Hand hand : kHands) {
    const std::vector<double>& joints = cell.arms[index(hand)].start;
    start.joints[index(hand)] =
        Eigen::Map<const Eigen::VectorXd>(joints.data(), static_cast<Eigen::Index>(joints.size()));
  }
  return start;
}

/// @param cell  the arms are put where the step has them
Look look_of(const Step& step, const Pose& T_UG, sim::WorldParameters cell) {
  const double held = cell.arms[rubik::kTrack].jaws->start;
  cell.cube.reset();
  for (const Hand hand : kHands) {
    const AxisVector& joints = step.contact[index(hand)];
    sim::ArmParameters& arm = cell.arms[index(hand)];
    arm.start.assign(joints.begin(), joints.end());
    arm.jaws->start = hand == step.before_grasp.hand ? held : kOpenJaws;
  }
  return {T_UG, step.R_GC, sim::CellScene(cell).take(sim::World(cell, 1))};
}

}  // namespace

ShownCube::ShownCube(unsigned seed) : random_(seed), camera_(cube_camera()) {
  const sim::WorldParameters parameters = start_cell();
  PlanStart start = start_of(parameters);
  for (int reading = 0; reading < kReadings; ++reading) {
    const Viewing viewing = viewing_place(reading);
    const CubePlanCell cell(usual_cell(), viewing);
    const Planned planned = Planner(cell).make_reading_plan(start);
    if (!planned.plan)
      throw FaultError(FaultCode::internal_error, "no plan to show all faces: " + planned.text);
    for (const Step& step : planned.plan->steps)
      if (step.shows)
        looks_[static_cast<std::size_t>(reading)].push_back(look_of(step, viewing.T_UG, parameters));
    start = {planned.plan->end, planned.plan->end_joints};
  }
}

std::vector<Pose> ShownCube::places() const {
  std::vector<Pose> places;
  for (int reading = 0; reading < kReadings; ++reading)
    places.push_back(camera_.place.inverse() * viewing_place(reading).T_UG);
  return places;
}

CubeLight ShownCube::draw_light(Lighting lighting) {
  CubeLight drawn;
  camera::Light& light = drawn.light;
  light.direction += Vector3(uniform(-0.5, 0.5), uniform(-0.5, 0.5), 0);
  light.exposure = uniform(0.7, 1.2);
  if (lighting == Lighting::dim) light.exposure = uniform(0.2, 0.4);
  if (lighting == Lighting::coloured) {
    const camera::Colour tint{std::exp(uniform(-0.4, 0.4)), 1, std::exp(uniform(-0.4, 0.4))};
    for (std::size_t c = 0; c < 3; ++c) light.lamp[c] *= tint[c], light.ambient[c] *= tint[c];
  }
  if (lighting != Lighting::glaring) return drawn;
  // The lamp mirrors itself somewhere on the face.
  const Pose T_UG = viewing_place().T_UG;
  const Vector3 view =
      (camera_.place.p - T_UG * Vector3(uniform(-0.03, 0.03), uniform(-0.03, 0.03), 0)).normalized();
  const Vector3 normal = T_UG.R.col(2);
  light.direction = 2 * normal.dot(view) * normal - view;
  light.lamp.fill(uniform(0.8, 1.4));
  light.exposure = 0.6;
  drawn.shadows = false;
  return drawn;
}

camera::Scene ShownCube::show(const Look& look, const Cube& cube, const CubeLight& light) {
  camera::Scene scene = look.scene;
  const Vector3 shift(uniform(-2e-3, 2e-3), uniform(-2e-3, 2e-3), uniform(-2e-3, 2e-3));
  const Vector3 turn(uniform(-0.02, 0.02), uniform(-0.02, 0.02), uniform(-0.02, 0.02));
  sim::CubeTruth truth;
  truth.state = cube;
  truth.T_UC =
      look.T_UG * Pose{rotation_from_angle_axis(turn) * look.R_GC, shift - Vector3(0, 0, sim::kCubeEdge / 2)};
  sim::add_cube(scene.bodies, truth);
  scene.light = light.light;
  if (!light.shadows)
    for (camera::Body& body : scene.bodies) body.casts_shadow = false;
  return scene;
}

}  // namespace mrroc::bench
