// Everything that a page is sent, kept in memory for any number of pages that read at their own pace.
#pragma once
#include <cstdint>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace mrroc::view {

/// One scene with its tracks, lines and values. One thread writes, any number read; every function locks, allocates and
/// is not for the servo step.
///
/// A track is a table of numbers that grows (the readings of an arm), a line is something that was said once, a value
/// is something of which only the newest counts (the task's status). Nothing of tracks and lines is ever left out: a
/// page that reads seldom gets more at a time.
class Record {
 public:
  /// Position up to which a page has read. A new one begins at the beginning.
  struct Cursor {
    std::int64_t generation{};                      ///< of the scene that the page shows
    std::map<std::string, std::size_t> rows;        ///< per track
    std::size_t lines{};                            ///< that the page has
    std::map<std::string, std::int64_t> value_age;  ///< per value: change at which it was read
    std::int64_t change{-1};                        ///< of the record, at the last reading
  };

  /// Rows of one track that one piece of news carries at most: about 0.3 MB as text.
  static constexpr std::size_t kMostRows = 2000;
  /// Rows of one track that are kept at most: eleven hours at 50 a second. Later ones are left out and counted.
  static constexpr std::size_t kMostKept = 2'000'000;
  /// Tracks and values at most; rows of further tracks, and further values, are left out and counted.
  static constexpr std::size_t kMostTracks = 64;
  static constexpr std::size_t kMostValues = 64;
  /// Lines that are kept at most; later ones are left out and counted, too.
  static constexpr std::size_t kMostLines = 20'000;

  /// Forgets everything and begins anew. @param scene  JSON that the page gets first
  void begin(std::string scene);
  /// @param row  the same number of numbers for all rows of a track; one with another number is left out and counted,
  ///             and so is a track whose name is no plain word
  void add(const std::string& track, std::span<const float> row);
  /// @param line  JSON
  void log(std::string line);
  /// @param value  JSON
  void set(const std::string& key, std::string value);

  /// @return changes so far; it grows with each
  [[nodiscard]] std::int64_t changes() const;
  /// @return rows of a track so far
  [[nodiscard]] std::size_t rows(const std::string& track) const;
  /// @return rows, lines and values that did not find room, or did not fit, since begin()
  [[nodiscard]] std::size_t refused() const;
  /// @return JSON of the scene
  [[nodiscard]] std::string scene() const;

  /// News for a page: an object with the number `generation` and, where there is something, `scene` (once per
  /// generation), `tracks` {name: base64 of little-endian 32-bit floats, row by row}, `lines` [...], `values`
  /// {key: ...}.
  /// @param cursor  moved forward  @return empty when nothing is new
  [[nodiscard]] std::string news(Cursor& cursor) const;

 private:
  struct Track {
    std::size_t width{};
    std::vector<float> data;
  };
  struct Value {
    std::string text;
    std::int64_t change{};
  };
  [[nodiscard]] std::string tracks_news(Cursor& cursor, bool& all) const;
  [[nodiscard]] std::string lines_news(Cursor& cursor) const;
  [[nodiscard]] std::string values_news(Cursor& cursor) const;

  mutable std::mutex mutex_;
  std::int64_t generation_{};
  std::int64_t change_{};
  std::string scene_{"{}"};
  std::map<std::string, Track> tracks_;
  std::vector<std::string> lines_;
  std::map<std::string, Value> values_;
  std::size_t refused_{};
};

/// @return the bytes in base64 with padding
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace mrroc::view
