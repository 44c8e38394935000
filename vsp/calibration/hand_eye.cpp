#include "vsp/calibration/hand_eye.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "base/counted.hpp"
#include "base/fault.hpp"
#include "vsp/least_squares.hpp"
#include "vsp/planar_pose.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kLeastTurn = 0.26;       // of the hand between some two views [rad]
constexpr double kLeastSecondTurn = 0.1;  // about an axis across [rad]
constexpr double kWorstRms = 5;           // [pixel]
constexpr double kWorstSigma = 0.005;     // [m]
constexpr int kMost = 12;                 // unknowns: both poses

using Matrix12 = Eigen::Matrix<double, kMost, kMost>;
using Vector12 = Eigen::Matrix<double, kMost, 1>;

[[noreturn]] void refuse(const std::string& why) { throw FaultError(FaultCode::bad_calibration, why); }

// T_CG = X^-1 * A_k * Y with X the camera, Y the board; A_k is known.
struct Unknowns {
  Pose X;
  Pose Y;

  [[nodiscard]] Unknowns moved(const Vector12& d) const {
    const auto move = [](const Pose& T, const Vector6& by) {
      return Pose{T.R * rotation_from_angle_axis(by.tail<3>()), T.p + by.head<3>()};
    };
    return {move(X, d.head<6>()), move(Y, d.tail<6>())};
  }
};

class Problem {
 public:
  Problem(const CameraModel& camera, Arrangement arrangement, std::span<const PosedView> views,
          const Board& board)
      : camera_(camera), views_(views), unknowns_(arrangement == Arrangement::known_board ? 6 : kMost) {
    for (int r = 0; r < board.rows; ++r)
      for (int c = 0; c < board.columns; ++c) model_.push_back(board.corner(r, c));
    for (const PosedView& v : views)
      A_.push_back(arrangement == Arrangement::eye_in_hand ? v.known.inverse() : v.known);
  }

  [[nodiscard]] const Pose& A(std::size_t k) const { return A_[k]; }
  [[nodiscard]] const std::vector<Vector3>& model() const { return model_; }

  // Residuals of one view [pixel].
  [[nodiscard]] Eigen::VectorXd residuals(const Unknowns& u, std::size_t k) const {
    const Pose T_CG = u.X.inverse() * A_[k] * u.Y;
    Eigen::VectorXd r(2 * static_cast<Eigen::Index>(model_.size()));
    for (std::size_t n = 0; n < model_.size(); ++n) {
      Vector3 q = T_CG * model_[n];
      q.z() = std::max(q.z(), 1e-3);  // a wrong start may put a corner behind the camera
      r.segment<2>(2 * static_cast<Eigen::Index>(n)) = project(camera_, q) - views_[k].view.corners[n];
    }
    return r;
  }

  [[nodiscard]] double cost(const Unknowns& u) const {
    double sum = 0;
    for (std::size_t k = 0; k < views_.size(); ++k) sum += residuals(u, k).squaredNorm();
    return sum;
  }

  void linearise(const Unknowns& u, Matrix12& JtJ, Vector12& Jtr) const {
    constexpr double kDelta = 1e-6;
    JtJ.setIdentity();  // of what is not unknown
    JtJ.topLeftCorner(unknowns_, unknowns_).setZero();
    Jtr.setZero();
    for (std::size_t k = 0; k < views_.size(); ++k) {
      const Eigen::VectorXd r = residuals(u, k);
      Eigen::MatrixXd J(r.size(), unknowns_);
      for (int n = 0; n < unknowns_; ++n) {
        const Vector12 d = kDelta * Vector12::Unit(n);
        J.col(n) = (residuals(u.moved(d), k) - residuals(u.moved(-d), k)) / (2 * kDelta);
      }
      JtJ.topLeftCorner(unknowns_, unknowns_) += J.transpose() * J;
      Jtr.head(unknowns_) += J.transpose() * r;
    }
  }

  [[nodiscard]] static Unknowns moved(const Unknowns& u, const Vector12& step) { return u.moved(step); }

  [[nodiscard]] double freedom() const {
    return static_cast<double>(2 * model_.size() * views_.size()) - unknowns_;
  }

 private:
  const CameraModel& camera_;
  std::span<const PosedView> views_;
  int unknowns_;
  std::vector<Vector3> model_;
  std::vector<Pose> A_;
};

// Two axes are needed: about one alone, the camera may be anywhere along it.
void check_turns(std::span<const PosedView> views) {
  Matrix3 scatter = Matrix3::Zero();
  double largest = 0;
  for (const PosedView& v : views) {
    const Vector3 turn = angle_axis_from_rotation(views.front().known.R.transpose() * v.known.R);
    largest = std::max(largest, turn.norm());
    scatter += turn * turn.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(scatter);
  const double across = std::sqrt(std::max(0.0, solver.eigenvalues()[1]));
  if (largest < kLeastTurn)
    refuse(fmt::format("the hand turned by {:.0f} degrees at most; at least 15 are needed",
                       largest * 180 / M_PI));
  if (across < kLeastSecondTurn)
    refuse("the hand turned about one axis only; turn it about another one, too");
}

cv::Matx33d matrix(const Matrix3& R) {
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
}
cv::Vec3d vector(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

Unknowns start(const Problem& problem, const std::vector<Pose>& T_CG, bool known_board) {
  if (known_board) return {problem.A(0) * T_CG[0].inverse(), Pose{}};
  std::vector<cv::Mat> R_hand;
  std::vector<cv::Mat> p_hand;
  std::vector<cv::Mat> R_board;
  std::vector<cv::Mat> p_board;
  for (std::size_t k = 0; k < T_CG.size(); ++k) {
    const Pose hand = problem.A(k).inverse();
    R_hand.emplace_back(matrix(hand.R));
    p_hand.emplace_back(vector(hand.p));
    R_board.emplace_back(matrix(T_CG[k].R));
    p_board.emplace_back(vector(T_CG[k].p));
  }
  cv::Mat R;
  cv::Mat p;
  cv::calibrateHandEye(R_hand, p_hand, R_board, p_board, R, p, cv::CALIB_HAND_EYE_PARK);
  Unknowns u;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) u.X.R(row, column) = R.at<double>(row, column);
    u.X.p[row] = p.at<double>(row);
  }
  if (!u.X.p.allFinite()) refuse("no place of the camera explains the pictures");
  u.X.R = orthonormal(u.X.R);
  u.Y = problem.A(0).inverse() * u.X * T_CG[0];
  return u;
}

}  // namespace

PlaceCalibration calibrate_place(const CameraModel& camera, Arrangement arrangement,
                                 std::span<const PosedView> views, const Board& board) {
  const bool known_board = arrangement == Arrangement::known_board;
  const std::size_t least = known_board ? 1 : 3;
  if (views.size() < least)
    refuse(fmt::format("the board was found in {} with a known pose; at least {} {} needed",
                       counted(views.size(), "picture"), least, least == 1 ? "is" : "are"));
  if (!known_board) check_turns(views);
  const Problem problem(camera, arrangement, views, board);
  std::vector<Pose> T_CG;
  for (const PosedView& v : views) {
    const auto pose = planar_pose(camera, problem.model(), v.view.corners);
    if (!pose) refuse(v.view.name + ": no pose of the board explains the picture");
    T_CG.push_back(pose->best.T_CG);
  }
  constexpr int kSteps = 60;
  Unknowns u = start(problem, T_CG, known_board);
  minimise<kMost>(problem, u, kSteps, 1e7);
  PlaceCalibration result{u.X, u.Y, 0, {}, 0};
  const auto corners = static_cast<double>(problem.model().size());
  for (std::size_t k = 0; k < views.size(); ++k)
    result.view_px.push_back(std::sqrt(problem.residuals(u, k).squaredNorm() / corners));
  const double cost = problem.cost(u);
  result.rms_px = std::sqrt(cost / (corners * static_cast<double>(views.size())));
  if (!(result.rms_px < kWorstRms))
    refuse(fmt::format(
        "pictures and poses do not fit together: {:.1f} pixels; is every picture in the line of its pose?",
        result.rms_px));
  Matrix12 JtJ;
  Vector12 Jtr;
  problem.linearise(u, JtJ, Jtr);
  const Matrix12 covariance = cost / problem.freedom() * JtJ.ldlt().solve(Matrix12::Identity());
  result.sigma_m = std::sqrt(covariance.diagonal().head<3>().maxCoeff());
  if (!(result.sigma_m < kWorstSigma))
    refuse(fmt::format("the camera's position stays uncertain by {:.1f} mm; turn the hand more",
                       1e3 * result.sigma_m));
  return result;
}

}  // namespace mrroc::vsp
