// Bodies of edp/recorder.hpp, for the files that instantiate them.
#pragma once
#include <fmt/core.h>

#include <fstream>
#include <utility>

#include "base/effector_command.hpp"
#include "edp/recorder.hpp"

namespace mrroc::edp {
namespace detail {

/// Steps between two calls of write() at most.
inline constexpr std::size_t kMostUnwritten = 2 * kMaxSteps;

inline void write_text(const std::filesystem::path& path, const std::string& text, bool anew) {
  std::ofstream(path, anew ? std::ios::trunc : std::ios::app) << text;
}

}  // namespace detail

template <RecordFormat F>
BasicRecordFiles<F>::BasicRecordFiles(Recording when, std::filesystem::path folder, std::string robot,
                                      F format, double dt)
    : when_(folder.empty() ? Recording::never : when),
      folder_(std::move(folder)),
      robot_(std::move(robot)),
      format_(std::move(format)),
      dt_(dt),
      recorder_(when_ == Recording::never      ? 1
                : when_ == Recording::on_fault ? kBefore + detail::kMostUnwritten
                                               : detail::kMostUnwritten) {}

template <RecordFormat F>
BasicRecordFiles<F>::~BasicRecordFiles() {
  if (fault_step_ >= 0) write_fault();
}

template <RecordFormat F>
void BasicRecordFiles<F>::add(const Record& record) noexcept {
  if (when_ == Recording::never) return;
  recorder_.add(record);
  if (fault_step_ >= 0) ++after_;
  const bool fresh = record.fault != FaultCode::none && record.fault != last_fault_;
  last_fault_ = record.fault;
  const bool elsewhere = triggered_ && record.step - recorded_ >= static_cast<std::int64_t>(kBefore);
  triggered_ = false;
  if (when_ != Recording::on_fault || !(fresh || elsewhere) || fault_step_ >= 0 || files_ == kMostFiles)
    return;
  fault_step_ = recorded_ = record.step;
  after_ = 0;
}

template <RecordFormat F>
void BasicRecordFiles<F>::dump_on_abort() {
  if (when_ != Recording::on_fault || recorder_.size() == 0 || fault_step_ >= 0 || files_ == kMostFiles)
    return;
  const std::int64_t last = recorder_[recorder_.size() - 1].step;
  if (last - recorded_ < static_cast<std::int64_t>(kBefore)) return;
  fault_step_ = recorded_ = last;
  write_fault();
}

template <RecordFormat F>
std::filesystem::path BasicRecordFiles<F>::write() {
  if (when_ == Recording::on_fault) return fault_step_ >= 0 && after_ >= kAfter ? write_fault() : "";
  if (when_ == Recording::never || recorder_.size() == 0) return {};
  const std::filesystem::path file = folder_ / (robot_ + "-steps.csv");
  detail::write_text(file, (begun_ ? "" : format_.header()) + record_lines(recorder_, format_, dt_), !begun_);
  begun_ = true;
  recorder_.clear();
  return {};
}

template <RecordFormat F>
std::filesystem::path BasicRecordFiles<F>::write_fault() {
  std::filesystem::path file = folder_ / fmt::format("{}-fault-{}.csv", robot_, fault_step_);
  writer_ = std::jthread([file, copy = recorder_, format = format_, dt = dt_] {
    detail::write_text(file, format.header() + record_lines(copy, format, dt), true);
  });
  fault_step_ = -1;
  ++files_;
  return file;
}

}  // namespace mrroc::edp
