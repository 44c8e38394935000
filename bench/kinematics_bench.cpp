// Cost of the kinematics and transmissions of the arms, and of KDL's numeric inverse kinematics on the same
// poses.
#include <benchmark/benchmark.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <kdl/chain.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "bench/kinematics_bench.hpp"
#include "robots/irb6/arm.hpp"
#include "robots/irb6/robot_type.hpp"

namespace mrroc::irb6 {
namespace {

constexpr std::size_t kPoses = 4096;

// Random poses within the motor limits; near: the joints a step of 2 ms before, at moderate speed.
struct Poses {
  explicit Poses(const Arm& arm) {
    std::mt19937_64 random(1);
    const auto uniform = [&random](double a, double b) {
      return std::uniform_real_distribution<>(a, b)(random);
    };
    for (std::size_t k = 0; k < kPoses; ++k) {
      AxisVector motors(arm.axes());
      for (int j = 0; j < motors.size(); ++j)
        motors[j] = uniform(arm.axis(j).motor.lower, arm.axis(j).motor.upper);
      AxisVector q = arm.joints_from_motors(motors);
      joints.push_back(q);
      wrist.push_back(arm.forward(q));
      for (int j = arm.parameters().first(); j < q.size(); ++j) q[j] += uniform(-0.004, 0.004);
      near.push_back(q);
    }
  }
  std::vector<AxisVector> joints, near;
  std::vector<Pose> wrist;
};

const Arm& arm_of(const benchmark::State& state) {
  static const Arm arms[]{Arm(kPostument), Arm(kTrack)};
  return arms[state.range(0)];
}

const Poses& poses_of(const benchmark::State& state) {
  static const Poses all[]{Poses(Arm(kPostument)), Poses(Arm(kTrack))};
  return all[state.range(0)];
}

template <class Function>
void over_poses(benchmark::State& state, Function function) {
  const edp::Robot& arm = arm_of(state);
  const Poses& poses = poses_of(state);
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(function(arm, poses, k++ % kPoses));
}

void direct_kinematics(benchmark::State& state) {
  over_poses(state,
             [](const edp::Robot& arm, const Poses& p, std::size_t k) { return arm.forward(p.joints[k]); });
}
void inverse_kinematics(benchmark::State& state) {
  over_poses(state, [](const edp::Robot& arm, const Poses& p, std::size_t k) {
    return arm.inverse(p.wrist[k], p.near[k]);
  });
}
// From a pose that has nothing to do with the target.
void inverse_kinematics_from_afar(benchmark::State& state) {
  over_poses(state, [](const edp::Robot& arm, const Poses& p, std::size_t k) {
    return arm.inverse(p.wrist[k], p.near[(k + kPoses / 2) % kPoses]);
  });
}
void motors_from_joints(benchmark::State& state) {
  over_poses(state, [](const edp::Robot& arm, const Poses& p, std::size_t k) {
    return arm.motors_from_joints(p.joints[k]);
  });
}

KDL::Chain postument_chain() {
  const auto model = urdf::parseURDF(std::string(irb6::postument().urdf));
  std::vector<KDL::Segment> reversed;
  for (auto link = model->getLink("wrist"); link->parent_joint;
       link = model->getLink(link->parent_joint->parent_link_name)) {
    const urdf::Joint& j = *link->parent_joint;
    const urdf::Pose& o = j.parent_to_joint_origin_transform;
    const KDL::Frame f(KDL::Rotation::Quaternion(o.rotation.x, o.rotation.y, o.rotation.z, o.rotation.w),
                       KDL::Vector(o.position.x, o.position.y, o.position.z));
    const KDL::Vector axis = f.M * KDL::Vector(j.axis.x, j.axis.y, j.axis.z);
    reversed.emplace_back(KDL::Joint(j.name, f.p, axis, KDL::Joint::RotAxis), f);
  }
  KDL::Chain chain;
  std::reverse(reversed.begin(), reversed.end());
  for (const KDL::Segment& s : reversed) chain.addSegment(s);
  return chain;
}

// KDL's Levenberg-Marquardt solver, eps 1e-6, on the same poses from the same joints.
void kdl_inverse_kinematics(benchmark::State& state) {
  const Poses& poses = poses_of(state);
  const KDL::Chain chain = postument_chain();
  KDL::ChainIkSolverPos_LMA solver(chain, 1e-6);
  KDL::JntArray from(6), found(6);
  std::size_t k = 0;
  for (auto _ : state) {
    const Pose& T = poses.wrist[k];
    from.data = poses.near[k];
    KDL::Frame f;
    for (int r = 0; r < 3; ++r) {
      f.p[r] = T.p[r];
      for (int c = 0; c < 3; ++c) f.M(r, c) = T.R(r, c);
    }
    benchmark::DoNotOptimize(solver.CartToJnt(from, f, found));
    k = (k + 1) % kPoses;
  }
}

// Argument: 0 the arm on the pedestal, 1 the arm on the track.
BENCHMARK(direct_kinematics)->Arg(0)->Arg(1);
BENCHMARK(inverse_kinematics)->Arg(0)->Arg(1);
BENCHMARK(inverse_kinematics_from_afar)->Arg(0)->Arg(1);
BENCHMARK(motors_from_joints)->Arg(0)->Arg(1);
BENCHMARK(kdl_inverse_kinematics)->Arg(0);

// Keeps the times instead of printing them.
class Keeper : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs)
      if (run.run_type == Run::RT_Iteration) times_[run.run_name.str()].push_back(run.GetAdjustedCPUTime());
  }
  [[nodiscard]] std::map<std::string, double> medians() const {
    std::map<std::string, double> result;
    for (auto [name, times] : times_) {
      const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
      std::nth_element(times.begin(), middle, times.end());
      result[name.substr(0, name.find("/repeats"))] = *middle;
    }
    return result;
  }

 private:
  std::map<std::string, std::vector<double>> times_;
};

}  // namespace
}  // namespace mrroc::irb6

namespace mrroc::bench {

std::map<std::string, double> run_kinematics_benchmarks() {
  std::string words[]{"bench", "--benchmark_min_time=0.05", "--benchmark_repetitions=9"};
  char* arguments[]{words[0].data(), words[1].data(), words[2].data(), nullptr};
  int count = 3;
  benchmark::Initialize(&count, arguments);
  irb6::Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);
  return keeper.medians();
}

}  // namespace mrroc::bench
