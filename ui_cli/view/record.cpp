#include "ui_cli/view/record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <bit>

namespace mrroc::view {

static_assert(std::endian::native == std::endian::little, "rows are sent as they lie in memory");

namespace {

/// @return whether the name can stand in a page's news as it is
bool is_plain(std::string_view name) {
  return std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~' && c != '"' && c != '\\'; });
}

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  char* out = text.data();
  for (std::size_t k = 0; k < bytes.size(); k += 3, out += 4) {
    const std::size_t left = bytes.size() - k;
    const std::uint32_t three = std::uint32_t{bytes[k]} << 16 |
                                (left > 1 ? std::uint32_t{bytes[k + 1]} << 8 : 0) |
                                (left > 2 ? std::uint32_t{bytes[k + 2]} : 0);
    out[0] = kLetters[three >> 18];
    out[1] = kLetters[three >> 12 & 63];
    if (left > 1) out[2] = kLetters[three >> 6 & 63];
    if (left > 2) out[3] = kLetters[three & 63];
  }
  return text;
}

void Record::begin(std::string scene) {
  const std::lock_guard lock(mutex_);
  ++generation_;
  ++change_;
  scene_ = std::move(scene);
  tracks_.clear();
  lines_.clear();
  values_.clear();
  refused_ = 0;
}

void Record::add(const std::string& track, std::span<const float> row) {
  const std::lock_guard lock(mutex_);
  auto it = tracks_.find(track);
  if (it == tracks_.end() && tracks_.size() < kMostTracks && !row.empty() && is_plain(track))
    it = tracks_.emplace(track, Track{row.size(), {}}).first;
  if (it == tracks_.end() || it->second.width != row.size() ||
      it->second.data.size() >= kMostKept * row.size()) {
    ++refused_;
    return;
  }
  Track& t = it->second;
  t.data.insert(t.data.end(), row.begin(), row.end());
  ++change_;
}

void Record::log(std::string line) {
  const std::lock_guard lock(mutex_);
  if (lines_.size() >= kMostLines) {
    ++refused_;
    return;
  }
  lines_.push_back(std::move(line));
  ++change_;
}

void Record::set(const std::string& key, std::string value) {
  const std::lock_guard lock(mutex_);
  if (values_.size() >= kMostValues && !values_.contains(key)) {
    ++refused_;
    return;
  }
  Value& v = values_[key];
  if (v.text == value) return;
  v = {std::move(value), ++change_};
}

std::int64_t Record::changes() const {
  const std::lock_guard lock(mutex_);
  return change_;
}

std::size_t Record::rows(const std::string& track) const {
  const std::lock_guard lock(mutex_);
  const auto found = tracks_.find(track);
  return found == tracks_.end() ? 0 : found->second.data.size() / found->second.width;
}

std::size_t Record::refused() const {
  const std::lock_guard lock(mutex_);
  return refused_;
}

std::string Record::scene() const {
  const std::lock_guard lock(mutex_);
  return scene_;
}

std::string Record::tracks_news(Cursor& cursor, bool& all) const {
  std::string text;
  for (const auto& [name, track] : tracks_) {
    std::size_t& read = cursor.rows[name];
    const std::size_t rows = track.data.size() / track.width;
    if (read == rows) continue;
    const std::size_t count = std::min(rows - read, kMostRows);
    const std::span part(track.data.data() + read * track.width, count * track.width);
    text += fmt::format("{}\"{}\":\"{}\"", text.empty() ? "" : ",", name,
                        base64({reinterpret_cast<const std::uint8_t*>(part.data()), part.size_bytes()}));
    read += count;
    all = all && read == rows;
  }
  return text;
}

std::string Record::lines_news(Cursor& cursor) const {
  std::string text;
  for (; cursor.lines < lines_.size(); ++cursor.lines)
    text += (text.empty() ? "" : ",") + lines_[cursor.lines];
  return text;
}

std::string Record::values_news(Cursor& cursor) const {
  std::string text;
  for (const auto& [key, value] : values_) {
    std::int64_t& age = cursor.value_age[key];
    if (age == value.change) continue;
    age = value.change;
    text += fmt::format("{}\"{}\":{}", text.empty() ? "" : ",", key, value.text);
  }
  return text;
}

std::string Record::news(Cursor& cursor) const {
  const std::lock_guard lock(mutex_);
  if (cursor.change == change_ && cursor.generation == generation_) return {};
  std::string text = fmt::format("{{\"generation\":{}", generation_);
  if (cursor.generation != generation_) {
    cursor = Cursor{};
    cursor.generation = generation_;
    text += ",\"scene\":" + scene_;
  }
  bool all = true;
  if (const std::string t = tracks_news(cursor, all); !t.empty()) text += ",\"tracks\":{" + t + "}";
  if (const std::string l = lines_news(cursor); !l.empty()) text += ",\"lines\":[" + l + "]";
  if (const std::string v = values_news(cursor); !v.empty()) text += ",\"values\":{" + v + "}";
  cursor.change = all ? change_ : -1;
  return text + "}";
}

}  // namespace mrroc::view
