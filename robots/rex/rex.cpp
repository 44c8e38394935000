#include "robots/rex/rex.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>

#include "robots/rex/ekf.hpp"
#include "robots/rex/kinematic_tracker.hpp"
#include "robots/rex/mhe.hpp"
#include "robots/rex/nmpc.hpp"
#include "robots/rex/parameters.hpp"

namespace mrroc::rex {
namespace {

/// Names of algorithms, and what makes them. The first is the default.
template <class Interface, std::size_t n>
struct Kinds {
  std::array<std::string_view, n> name;
  std::array<std::unique_ptr<Interface> (*)(), n> make;

  [[nodiscard]] std::unique_ptr<Interface> made(std::string_view what, std::string_view kind) const {
    for (std::size_t i = 0; i < n; ++i)
      if (name[i] == kind) return make[i]();
    throw std::invalid_argument(
        fmt::format("the platform rex has no {} '{}'; it has {}", what, kind, fmt::join(name, ", ")));
  }
};

template <class Interface, class Algorithm>
std::unique_ptr<Interface> make() {
  return std::make_unique<Algorithm>();
}

constexpr Kinds<edp::Tracker, 2> kTrackers{{"nmpc", "kinematic"},
                                           {make<edp::Tracker, Nmpc>, make<edp::Tracker, KinematicTracker>}};
constexpr Kinds<edp::Estimator, 2> kEstimators{{"mhe", "ekf"},
                                               {make<edp::Estimator, Mhe>, make<edp::Estimator, Ekf>}};

class Rex final : public edp::Platform {
 public:
  [[nodiscard]] const edp::PlatformProperties& properties() const noexcept override {
    static constexpr edp::PlatformProperties kProperties{.name = "rex",
                                                         .wheel_radius = kWheelRadius,
                                                         .half_track = kHalfTrack,
                                                         .increments_per_turn = kIncrementsPerTurn,
                                                         .max_torque = kMaxTorque,
                                                         .brake = kBrake,
                                                         .braking_torque = kBrakingTorque,
                                                         .max_wheel_speed = kMaxWheelSpeed,
                                                         .max_speed = kMaxSpeed,
                                                         .max_turn_rate = kMaxTurnRate,
                                                         .max_lateral_acceleration = kMaxLateralAcceleration};
    return kProperties;
  }
  [[nodiscard]] std::span<const std::string_view> estimators() const noexcept override {
    return kEstimators.name;
  }
  [[nodiscard]] std::span<const std::string_view> trackers() const noexcept override {
    return kTrackers.name;
  }
  [[nodiscard]] std::unique_ptr<edp::Estimator> estimator(std::string_view kind) const override {
    return kEstimators.made("estimator", kind);
  }
  [[nodiscard]] std::unique_ptr<edp::Tracker> tracker(std::string_view kind) const override {
    return kTrackers.made("tracker", kind);
  }
};

}  // namespace

const edp::Platform& platform() {
  static const Rex rex;
  return rex;
}

}  // namespace mrroc::rex
