// Rex keeps the contract of platforms.
#include <memory>
#include <span>
#include <string_view>

#include "robots/rex/rex.hpp"
#include "test/contract/platform_contract.hpp"

namespace mrroc::contract {
namespace {

/// The contract owns its platforms; Rex is one that lives to the end of the program.
class SameRex final : public edp::Platform {
 public:
  [[nodiscard]] const edp::PlatformProperties& properties() const noexcept override {
    return rex::platform().properties();
  }
  [[nodiscard]] std::span<const std::string_view> estimators() const noexcept override {
    return rex::platform().estimators();
  }
  [[nodiscard]] std::span<const std::string_view> trackers() const noexcept override {
    return rex::platform().trackers();
  }
  [[nodiscard]] std::unique_ptr<edp::Estimator> estimator(std::string_view kind) const override {
    return rex::platform().estimator(kind);
  }
  [[nodiscard]] std::unique_ptr<edp::Tracker> tracker(std::string_view kind) const override {
    return rex::platform().tracker(kind);
  }
};

std::unique_ptr<edp::Platform> make() { return std::make_unique<SameRex>(); }

INSTANTIATE_TEST_SUITE_P(Rex, PlatformContract, testing::Values(make), platform_name);

}  // namespace
}  // namespace mrroc::contract
