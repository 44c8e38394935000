#include "edp/recorder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace mrroc::edp {
namespace {

/// Steps between two calls of write() at most.
constexpr std::size_t kMostUnwritten = 2 * kMaxSteps;

std::array<double, 3> three(const Vector3& p) { return {p.x(), p.y(), p.z()}; }

template <class Numbers>
void put(std::string& text, const Numbers& numbers, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) text += fmt::format(",{:.9g}", static_cast<double>(numbers[k]));
}

void append(const std::filesystem::path& path, const std::string& text, bool anew) {
  std::ofstream(path, anew ? std::ios::trunc : std::ios::app) << text;
}

}  // namespace

StepRecord record_of(const Driver& driver, const HardwareReading& reading,
                     const HardwareCommand& command) noexcept {
  StepRecord r;
  r.step = reading.step;
  r.state = driver.state();
  r.fault = driver.fault().code;
  const SetPoint& set = driver.set_point();
  std::copy_n(set.axes.motors.data(), set.axes.motors.size(), r.set_motor.begin());
  r.encoder = reading.encoder;
  r.current = reading.current;
  r.pwm = command.pwm;
  r.set_position = three(set.T_0E.p);
  if (const auto samples = driver.samples(); !samples.empty()) {
    r.position = three(samples.back().T_0E.p);
    r.F_a = samples.back().F_a;
  }
  r.S_F_m = reading.S_F_m;
  return r;
}

Recorder::Recorder(std::size_t capacity) : ring_(std::max<std::size_t>(1, capacity)) {}

void Recorder::add(const StepRecord& record) noexcept {
  ring_[next_] = record;
  next_ = (next_ + 1) % ring_.size();
  size_ = std::min(size_ + 1, ring_.size());
}

const StepRecord& Recorder::operator[](std::size_t k) const noexcept {
  return ring_[(next_ + ring_.size() - size_ + k) % ring_.size()];
}

std::string record_header(int axes) {
  std::string text = "step,t,state,fault";
  for (const std::string_view name : {"set_m", "enc", "current", "pwm"})
    for (int k = 1; k <= axes; ++k) text += fmt::format(",{}{}", name, k);
  return text + ",set_x,set_y,set_z,x,y,z,Fx,Fy,Fz,Nx,Ny,Nz,raw_Fx,raw_Fy,raw_Fz,raw_Nx,raw_Ny,raw_Nz\n";
}

std::string record_lines(const Recorder& recorder, int axes, double dt) {
  std::string text;
  const auto n = static_cast<std::size_t>(axes);
  for (std::size_t k = 0; k < recorder.size(); ++k) {
    const StepRecord& r = recorder[k];
    text += fmt::format("{},{:.4f},{},{}", r.step, static_cast<double>(r.step) * dt, to_string(r.state),
                        to_string(r.fault));
    put(text, r.set_motor, n);
    put(text, r.encoder, n);
    put(text, r.current, n);
    put(text, r.pwm, n);
    put(text, r.set_position, 3);
    put(text, r.position, 3);
    put(text, r.F_a.v, 6);
    put(text, r.S_F_m.v, 6);
    text += '\n';
  }
  return text;
}

RecordFiles::RecordFiles(Recording when, std::filesystem::path folder, std::string robot, int axes, double dt)
    : when_(folder.empty() ? Recording::never : when),
      folder_(std::move(folder)),
      robot_(std::move(robot)),
      axes_(axes),
      dt_(dt),
      recorder_(when_ == Recording::never      ? 1
                : when_ == Recording::on_fault ? kBefore + kMostUnwritten
                                               : kMostUnwritten) {}

RecordFiles::~RecordFiles() {
  if (fault_step_ >= 0) write_fault();
}

void RecordFiles::add(const StepRecord& record) noexcept {
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

void RecordFiles::trigger() noexcept { triggered_ = true; }

void RecordFiles::dump_on_abort() {
  if (when_ != Recording::on_fault || recorder_.size() == 0 || fault_step_ >= 0 || files_ == kMostFiles)
    return;
  const std::int64_t last = recorder_[recorder_.size() - 1].step;
  if (last - recorded_ < static_cast<std::int64_t>(kBefore)) return;
  fault_step_ = recorded_ = last;
  write_fault();
}

std::filesystem::path RecordFiles::write() {
  if (when_ == Recording::on_fault) return fault_step_ >= 0 && after_ >= kAfter ? write_fault() : "";
  if (when_ == Recording::never || recorder_.size() == 0) return {};
  const std::filesystem::path file = folder_ / (robot_ + "-steps.csv");
  append(file, (begun_ ? "" : record_header(axes_)) + record_lines(recorder_, axes_, dt_), !begun_);
  begun_ = true;
  recorder_.clear();
  return {};
}

std::filesystem::path RecordFiles::write_fault() {
  std::filesystem::path file = folder_ / fmt::format("{}-fault-{}.csv", robot_, fault_step_);
  writer_ = std::jthread([file, copy = recorder_, axes = axes_, dt = dt_] {
    append(file, record_header(axes) + record_lines(copy, axes, dt), true);
  });
  fault_step_ = -1;
  ++files_;
  return file;
}

}  // namespace mrroc::edp
