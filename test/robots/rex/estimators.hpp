// The estimators of Rex by their names, for tests of both.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "robots/rex/ekf.hpp"
#include "robots/rex/mhe.hpp"

namespace mrroc::rex::test {

inline std::unique_ptr<edp::Estimator> make(const std::string& kind) {
  if (kind == "mhe") return std::make_unique<Mhe>();
  return std::make_unique<Ekf>();
}

inline std::string name_of(const testing::TestParamInfo<std::string>& info) { return info.param; }

}  // namespace mrroc::rex::test
