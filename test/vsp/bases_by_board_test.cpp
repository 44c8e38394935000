// Bases of two arms by a board that one holds before the camera of the other: pictures of the simulated arms are drawn, and
// the board is looked for in them.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sim/camera/cell_scene.hpp"
#include "sim/camera/renderer.hpp"
#include "sim/camera/textures.hpp"
#include "test/rig/irb6_cell.hpp"
#include "vsp/calibration/bases.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr std::size_t kViews = 20;  // of each arm

/// A cell whose bases, board and camera are somewhat elsewhere than anybody knows.
class BoardCell {
 public:
  explicit BoardCell(unsigned seed) : random_(seed), renderer_(CameraModel{}, camera::exact_profile()) {
    for (sim::ArmParameters& arm : parameters_.arms) arm.T_UB = arm.T_UB * displacement(0.005, 0.5 * kDegree);
    T_E2C_ = Pose{Matrix3::Identity(), {0.09, 0, -0.12}} * displacement(0.003, kDegree);
    T_E1G_ = Pose{Matrix3::Identity(), {0, 0, 0.03}} * displacement(0.005, 2 * kDegree);
  }

  [[nodiscard]] Pose T_12() const { return parameters_.arms[0].T_UB.inverse() * parameters_.arms[1].T_UB; }
  [[nodiscard]] const Pose& T_E2C() const { return T_E2C_; }

  /// @param moving  index of the arm that moves
  MovingArm pictures(std::size_t moving) {
    std::array<AxisVector, 2> q{joints(0, Pose{}), joints(1, Pose{})};
    MovingArm seen;
    seen.T_standing = T_0E(1 - moving, q[1 - moving]);
    for (int tries = 0; seen.views.size() < kViews && tries < 200; ++tries) {
      q[moving] = joints(moving, displacement(0.05, 25 * kDegree));
      if (q[moving].size() == 0) continue;
      if (auto corners = look(q)) seen.views.push_back({{"", std::move(*corners)}, T_0E(moving, q[moving])});
    }
    return seen;
  }

 private:
  double uniform(double a, double b) { return a + (b - a) * static_cast<double>(random_()) / 4294967296.0; }
  Pose displacement(double m, double rad) {
    Vector3 p, turn;
    for (double& x : p) x = uniform(-m, m);
    for (double& x : turn) x = uniform(-rad, rad);
    return {rotation_from_angle_axis(turn), p};
  }
  [[nodiscard]] const sim::ArmParameters& arm(std::size_t k) const { return parameters_.arms[k]; }

  /// What the encoders say. @return 0_E T
  [[nodiscard]] Pose T_0E(std::size_t k, const AxisVector& q) const {
    return arm(k).type->make(arm(k).model)->forward(q) * arm(k).type->driver.T_WE;
  }

  /// @return joints with E there, moved from before the other arm by `by`; empty: out of reach
  AxisVector joints(std::size_t k, const Pose& by) const {
    const double z = k == 0 ? -1 : 1;  // towards the other arm, along y of the world
    Pose T_UE;
    T_UE.R.col(0) = Vector3::UnitZ();
    T_UE.R.col(2) = z * Vector3::UnitY();
    T_UE.R.col(1) = T_UE.R.col(2).cross(T_UE.R.col(0));
    T_UE.p = k == 0 ? Vector3(0, 1.3, 1.0) : Vector3(0, 0.85, 0.91);
    const auto robot = arm(k).type->make(arm(k).model);
    const auto& usual = arm(k).type->start;
    const auto found = robot->inverse(
        arm(k).T_UB.inverse() * T_UE * by * arm(k).type->driver.T_WE.inverse(),
        Eigen::Map<const Eigen::VectorXd>(usual.data(), static_cast<Eigen::Index>(usual.size())));
    return found.reached ? found.joints : AxisVector();
  }

  std::optional<std::vector<Vector2>> look(const std::array<AxisVector, 2>& q) {
    for (std::size_t k = 0; k < 2; ++k) parameters_.arms[k].start.assign(q[k].begin(), q[k].end());
    camera::Scene scene = sim::CellScene(parameters_).take(sim::World(parameters_, 1));
    camera::add_board(scene, {}, arm(0).T_UB * T_0E(0, q[0]) * T_E1G_);
    const Image picture = renderer_.render(scene, arm(1).T_UB * T_0E(1, q[1]) * T_E2C_, ++frame_);
    return find_corners(picture.view());
  }

  std::mt19937 random_;
  sim::WorldParameters parameters_ = rig::irb6_cell();
  camera::Renderer renderer_;
  Pose T_E2C_, T_E1G_;
  std::int64_t frame_{};
};

TEST(BasesByBoard, AreFoundFromPicturesOfTheArms) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    BoardCell cell(seed);
    const MovingArm board_moves = cell.pictures(0), camera_moves = cell.pictures(1);
    ASSERT_EQ(board_moves.views.size(), kViews) << "the board was not seen";
    ASSERT_EQ(camera_moves.views.size(), kViews) << "the board was not seen";
    const BasesByBoard found = calibrate_bases(CameraModel{}, board_moves, camera_moves);
    const double mm = 1e3 * (found.T_12.p - cell.T_12().p).norm();
    const double deg = angle_axis_from_rotation(found.T_12.R.transpose() * cell.T_12().R).norm() / kDegree;
    RecordProperty("base_err_mm_" + std::to_string(seed), std::to_string(mm));
    RecordProperty("base_err_deg_" + std::to_string(seed), std::to_string(deg));
    EXPECT_LE(mm, 0.5) << seed;
    EXPECT_LE(deg, 0.05) << seed;
    EXPECT_LE(1e3 * (found.T_E2C.p - cell.T_E2C().p).norm(), 0.5) << seed;
    EXPECT_LE(1e3 * found.apart_m, 1) << seed;
  }
}

}  // namespace
}  // namespace mrroc::vsp
