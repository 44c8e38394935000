// The contract of kernels holds for the fake one; a suite that nobody can pass would test nothing.
#include "test/contract/platform_contract.hpp"
#include "test/edp/platform/fake_platform.hpp"

namespace mrroc::contract {
namespace {

std::unique_ptr<edp::Platform> make() { return std::make_unique<edp::test::FakePlatform>(); }

INSTANTIATE_TEST_SUITE_P(FakePlatform, PlatformContract, testing::Values(make), platform_name);

}  // namespace
}  // namespace mrroc::contract
