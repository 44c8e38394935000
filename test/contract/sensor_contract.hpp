// Contract of every virtual sensor that uses the driver's readings (vsp/shell.hpp, concept StepSensor), as a
// test suite. A new sensor uses it in three lines:
//
//   #include "test/contract/sensor_contract.hpp"
//   struct My { static MySensor make() { return MySensor(); }  static constexpr int kStates = 4; };
//   INSTANTIATE_TYPED_TEST_SUITE_P(MySensor, SensorContract, My);
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "test/heap.hpp"
#include "vsp/shell.hpp"

namespace mrroc::contract {

/// The driver's readings of a tool that wanders and touches things.
class SampleTrace {
 public:
  explicit SampleTrace(unsigned seed) : random_(seed) {}

  StepSample next() {
    if (pick(500) == 0) rest_ = pick(2) == 0;
    for (std::size_t k = 0; k < 6; ++k) {
      velocity_[k] = rest_ ? 0 : 0.97 * velocity_[k] + 2e-3 * normal();
      sample_.T_0E[k] += velocity_[k] * 0.002;
      const bool touches = pick(100) == 0;
      double& F = sample_.F_a.v[k];
      F = touches ? 6 * normal() : 0.98 * F + 0.05 * normal();
    }
    return sample_;
  }
  int pick(int n) { return std::uniform_int_distribution<>(0, n - 1)(random_); }
  double normal() { return std::normal_distribution<>()(random_); }

 private:
  std::mt19937 random_;
  bool rest_{true};
  std::array<double, 6> velocity_{};
  StepSample sample_{{0.9, 0.1, 0.9, 3.1, 0, 0}, {}};
};

template <class Case>
class SensorContract : public testing::Test {
 protected:
  using Sensor = decltype(Case::make());
  static_assert(vsp::StepSensor<Sensor>);
  static constexpr int kSamples = 20'000;
  static constexpr int kMacrostep = 10;

  static bool same(const SensorReading& a, const SensorReading& b) {
    return a.state == b.state && a.valid == b.valid && a.value == b.value;
  }
  /// Checks that a reading is one: of a known state, all numbers finite.
  static void expect_usable(const SensorReading& r) {
    ASSERT_GE(r.state, 0);
    ASSERT_LT(r.state, Case::kStates);
    for (const double x : r.value) ASSERT_TRUE(std::isfinite(x));
  }
};
TYPED_TEST_SUITE_P(SensorContract);

TYPED_TEST_P(SensorContract, HasSeenNothingAtTheBeginning) {
  auto sensor = TypeParam::make(), other = TypeParam::make();
  const SensorReading first = sensor.reading();
  this->expect_usable(first);
  EXPECT_FALSE(first.valid);
  EXPECT_TRUE(this->same(first, other.reading()));
}

TYPED_TEST_P(SensorContract, IsAFunctionOfItsSamples) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    auto a = TypeParam::make(), b = TypeParam::make(), bystander = TypeParam::make();
    SampleTrace trace(seed), other(seed + 100);
    for (int k = 0; k < this->kSamples; ++k) {
      const StepSample sample = trace.next();
      a.step(sample);
      bystander.step(other.next());
      b.step(sample);
      if (k % this->kMacrostep == 0) {
        ASSERT_TRUE(this->same(a.reading(), b.reading())) << "sample " << k;
      }
    }
  }
}

TYPED_TEST_P(SensorContract, IsAValueWhoseCopyGoesOnAlone) {
  // What was never copied is how both must read on.
  auto sensor = TypeParam::make(), alone = TypeParam::make(), other = TypeParam::make();
  SampleTrace trace(4), elsewhere(5);
  for (int k = 0; k < 5000; ++k) {
    const StepSample sample = trace.next();
    sensor.step(sample);
    alone.step(sample);
    other.step(sample);
  }
  auto copy = sensor;
  for (int k = 0; k < 5000; ++k) {
    const StepSample sample = trace.next(), another = elsewhere.next();
    sensor.step(sample);
    alone.step(sample);
    copy.step(another);
    other.step(another);
    if (k % this->kMacrostep != 0) continue;
    ASSERT_TRUE(this->same(sensor.reading(), alone.reading()))
        << "the copy changes what it was made of, " << k;
    ASSERT_TRUE(this->same(copy.reading(), other.reading())) << "the copy is changed, " << k;
  }
}

TYPED_TEST_P(SensorContract, ReadsWithinItsStatesAndFinite) {
  auto sensor = TypeParam::make();
  SampleTrace trace(6);
  for (int k = 0; k < this->kSamples; ++k) {
    sensor.step(trace.next());
    if (k % this->kMacrostep != 0) continue;
    const SensorReading r = sensor.reading();
    this->expect_usable(r);
    ASSERT_TRUE(r.valid);
  }
}

// Macrosteps without a sample (they may be lost), and many samples without a reading.
TYPED_TEST_P(SensorContract, ReadsAlsoWithoutANewSample) {
  auto sensor = TypeParam::make();
  SampleTrace trace(7);
  for (int k = 0; k < this->kSamples; ++k) {
    if (trace.pick(3) != 0) sensor.step(trace.next());
    if (trace.pick(5) == 0) this->expect_usable(sensor.reading());
  }
}

TYPED_TEST_P(SensorContract, SurvivesSamplesThatAreNone) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  auto sensor = TypeParam::make();
  SampleTrace trace(8);
  for (int k = 0; k < this->kSamples; ++k) {
    StepSample sample = trace.next();
    if (trace.pick(50) == 0) {
      constexpr std::array kStrange{
          std::numeric_limits<double>::quiet_NaN(), kInf, -kInf, 1e308, -1e308, 1e154};
      const double x = kStrange[static_cast<std::size_t>(trace.pick(kStrange.size()))];
      const auto at = static_cast<std::size_t>(trace.pick(6));
      (trace.pick(2) == 0 ? sample.T_0E[at] : sample.F_a.v[at]) = x;
    }
    sensor.step(sample);
    this->expect_usable(sensor.reading());
    if (testing::Test::HasFatalFailure()) return;
  }
}

// A sample that is none leaves no trace: the sensor reads on as if it had not come.
TYPED_TEST_P(SensorContract, ForgetsSamplesThatAreNone) {
  auto sensor = TypeParam::make(), spared = TypeParam::make();
  SampleTrace trace(9);
  StepSample none{};
  none.T_0E.fill(std::numeric_limits<double>::quiet_NaN());
  none.F_a.v.fill(std::numeric_limits<double>::quiet_NaN());
  for (int k = 0; k < 5000; ++k) {
    const StepSample sample = trace.next();
    sensor.step(sample);
    spared.step(sample);
    if (k % 100 == 0) sensor.step(none);
  }
  EXPECT_TRUE(this->same(sensor.reading(), spared.reading()));
}

TYPED_TEST_P(SensorContract, NeverAllocates) {
  auto sensor = TypeParam::make();
  SampleTrace trace(10);
  const mrroc::test::AllocationCounter heap;
  for (int k = 0; k < 5000; ++k) {
    sensor.step(trace.next());
    if (k % this->kMacrostep == 0) (void)sensor.reading();
  }
  EXPECT_EQ(heap.count(), 0);
}

REGISTER_TYPED_TEST_SUITE_P(SensorContract, HasSeenNothingAtTheBeginning, IsAFunctionOfItsSamples,
                            IsAValueWhoseCopyGoesOnAlone, ReadsWithinItsStatesAndFinite,
                            ReadsAlsoWithoutANewSample, SurvivesSamplesThatAreNone, ForgetsSamplesThatAreNone,
                            NeverAllocates);

}  // namespace mrroc::contract
