// The reader of an effector driver: keeps the last steps and writes them down after a fault.
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "base/fault.hpp"

namespace mrroc::edp {

/// The newest steps, in a ring that is as long as it was made.
/// @tparam Record  everything about one step, trivially copyable
template <class Record>
class BasicRecorder {
 public:
  /// @param capacity  steps, at least 1
  explicit BasicRecorder(std::size_t capacity) : ring_(std::max<std::size_t>(1, capacity)) {}

  /// Real-time safe.
  void add(const Record& record) noexcept {
    ring_[next_] = record;
    next_ = (next_ + 1) % ring_.size();
    size_ = std::min(size_ + 1, ring_.size());
  }

  /// @return number of steps it holds
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// @param k  0: the oldest, below size()
  [[nodiscard]] const Record& operator[](std::size_t k) const noexcept {
    return ring_[(next_ + ring_.size() - size_ + k) % ring_.size()];
  }
  /// Holds nothing any more. Real-time safe.
  void clear() noexcept { size_ = 0; }

 private:
  std::vector<Record> ring_;
  std::size_t next_{};
  std::size_t size_{};
};

/// How the records of a kind of driver are written: a Record has the number of its step and the code of the fault that stood
/// after it; header() names the columns of the lines that append() adds, one for a record, with the duration of a step [s].
template <class F>
concept RecordFormat = std::copyable<F> &&
    requires(const F f, const typename F::Record r, std::string& text, double dt) {
  { r.step } -> std::convertible_to<std::int64_t>;
  { r.fault } -> std::convertible_to<FaultCode>;
  { f.header() } -> std::same_as<std::string>;
  f.append(text, r, dt);
};

/// That of a record that writes itself: R::header() and append(text, dt) mean what those of a RecordFormat do.
template <class R>
struct OwnFormat {
  using Record = R;  ///< of a step
  [[nodiscard]] std::string header() const { return R::header(); }
  void append(std::string& text, const R& record, double dt) const { record.append(text, dt); }
};

/// @param dt  duration of a step [s]
/// @return one line per step, without the header; what is not finite is `nan`
template <RecordFormat F>
[[nodiscard]] std::string record_lines(const BasicRecorder<typename F::Record>& recorder, const F& format,
                                       double dt) {
  std::string text;
  for (std::size_t k = 0; k < recorder.size(); ++k) format.append(text, recorder[k], dt);
  return text;
}

/// When the steps of a robot are written down.
enum class Recording : std::uint8_t {
  never,
  on_fault,  ///< the last kBefore steps and kAfter more, once per fault, kMostFiles times
  always     ///< all of them
};

/// Writes the steps of one robot into files. The steps before a fault are many: a thread writes them, so that the
/// driver goes on meanwhile.
template <RecordFormat F>
class BasicRecordFiles {
 public:
  using Record = typename F::Record;  ///< of a step

  static constexpr std::size_t kBefore = 2500;  ///< steps
  static constexpr int kAfter = 50;             ///< steps
  static constexpr int kMostFiles = 5;          ///< of faults, in a run

  /// @param folder  where ROBOT-steps.csv (always) or ROBOT-fault-STEP.csv go
  BasicRecordFiles(Recording when, std::filesystem::path folder, std::string robot, F format, double dt);
  /// Writes what a fault has begun, and waits for it.
  ~BasicRecordFiles();
  BasicRecordFiles(const BasicRecordFiles&) = delete;
  BasicRecordFiles& operator=(const BasicRecordFiles&) = delete;

  /// After every step. Real-time safe.
  void add(const Record& record) noexcept;
  /// When no more steps come because of a fault elsewhere: writes those there are, unless a file has them already. Not
  /// real-time safe.
  void dump_on_abort();
  /// Begins a file as a fault does, unless one was begun a moment ago: something has happened elsewhere. Real-time safe.
  void trigger() noexcept { triggered_ = true; }
  /// Once per macrostep: writes what there is to be written. What cannot be written is left out: a driver does not end
  /// for it. Not real-time safe.
  /// @return the file that a fault has got, or empty
  std::filesystem::path write();

 private:
  std::filesystem::path write_fault();

  Recording when_;
  std::filesystem::path folder_;
  std::string robot_;
  F format_;
  double dt_;
  BasicRecorder<Record> recorder_;
  FaultCode last_fault_{FaultCode::none};
  std::int64_t fault_step_{-1};                                 // of the fault that is being recorded
  int after_{};                                                 // steps since
  bool triggered_{};                                            // the next step begins a file
  std::int64_t recorded_{-static_cast<std::int64_t>(kBefore)};  // step of the last file
  int files_{};
  bool begun_{};  // ROBOT-steps.csv has its header
  std::jthread writer_;
};

}  // namespace mrroc::edp
