#include "ui_cli/view/camera_window.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

#include "base/fault.hpp"

namespace mrroc::view {
namespace {

void put32(std::string& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<char>(value >> 8 * k & 255);
}

}  // namespace

std::string bitmap(const ImageView& image) {
  constexpr std::size_t kHead = 54;
  const auto width = static_cast<std::size_t>(image.width);
  const auto height = static_cast<std::size_t>(image.height);
  const std::size_t row = (3 * width + 3) / 4 * 4;
  std::string bytes(kHead + row * height, '\0');
  bytes[0] = 'B';
  bytes[1] = 'M';
  put32(bytes, 2, static_cast<std::uint32_t>(bytes.size()));
  put32(bytes, 10, kHead);
  put32(bytes, 14, 40);  // of the second header
  put32(bytes, 18, static_cast<std::uint32_t>(width));
  put32(bytes, 22, static_cast<std::uint32_t>(height));
  bytes[26] = 1;   // plane
  bytes[28] = 24;  // bits
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t* from = image.row(static_cast<int>(height - 1 - y));  // the lowest comes first
    char* to = bytes.data() + kHead + y * row;
    if (image.channels == 3)
      std::memcpy(to, from, 3 * width);
    else
      for (std::size_t x = 0; x < width; ++x) std::fill_n(to + 3 * x, 3, static_cast<char>(from[x]));
  }
  return bytes;
}

void CameraWindow::begin(const std::string& session, std::int64_t session_id,
                         const std::vector<std::string>& cameras, pid_t task,
                         std::filesystem::path directory) {
  const std::lock_guard lock(mutex_);
  name_ = {.session = session, .session_id = session_id, .camera = {}, .directory = std::move(directory)};
  task_ = task;
  eyes_.clear();
  for (const std::string& camera : cameras) eyes_[camera];
}

void CameraWindow::look() {
  const std::lock_guard lock(mutex_);
  for (auto& [camera, eye] : eyes_) {
    if (eye.store) continue;
    name_.camera = camera;
    try {
      eye.store = link::FrameReader::open(name_);
    } catch (const FaultError&) {  // no store of this session: perhaps the next time
    }
  }
}

void CameraWindow::look_hidden() {
  const std::lock_guard lock(mutex_);
  if (task_ == 0) return;
  std::vector<pid_t> processes{task_};
  std::ifstream children(fmt::format("/proc/{0}/task/{0}/children", task_));
  for (pid_t child = 0; children >> child;) processes.push_back(child);
  for (auto& [camera, eye] : eyes_) {
    name_.camera = camera;
    for (const pid_t process : processes) {
      if (eye.store) break;
      try {
        eye.store = link::FrameReader::open_hidden(name_, process);
      } catch (const FaultError&) {  // no store of this session
      }
    }
  }
}

bool CameraWindow::complete() const {
  const std::lock_guard lock(mutex_);
  return std::ranges::all_of(eyes_, [](const auto& eye) { return eye.second.store.has_value(); });
}

void CameraWindow::announce(const std::string& camera, const camera_frame_t& m) {
  const std::lock_guard lock(mutex_);
  if (const auto eye = eyes_.find(camera); eye != eyes_.end()) {
    eye->second.slot = m.slot;
    eye->second.frame = m.header.stamp;
  }
}

std::optional<std::string> CameraWindow::picture(const std::string& camera) {
  const std::lock_guard lock(mutex_);
  const auto found = eyes_.find(camera);
  if (found == eyes_.end() || !found->second.store || found->second.frame < 0) return {};
  Eye& eye = found->second;
  const bool read = eye.store->read(eye.slot, eye.frame, eye.last) == link::FrameFate::read;
  if (!read && eye.last.image.empty()) return {};
  return bitmap(eye.last.image.view());
}

}  // namespace mrroc::view
