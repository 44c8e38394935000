// The page of manual operation in the full-screen view: makes instructions of keys, and a picture of
// readings.
#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/effector_command.hpp"
#include "ui_cli/canvas.hpp"

namespace mrroc::ui {

/// One arm as the page shows it.
struct ManualArm {
  std::string name;                        ///< key of the arm
  int axes{6};                             ///< 1..kMaxAxes
  std::vector<std::string> presets;        ///< names of positions
  std::optional<EffectorReply> reading{};  ///< newest; nothing: none has come
};

/// @param run_folder  of the task; may be empty, or of another host
/// @return the arms of its config.toml; none when it cannot be read
[[nodiscard]] std::vector<ManualArm> manual_arms(const std::filesystem::path& run_folder);

/// Meaning of a key. At most one of the texts is set.
struct ManualDeed {
  bool known{true};       ///< false: the key is none of this page
  bool leave{};           ///< back to the task
  std::string words{};    ///< an instruction, as behind `ui_cli manual`
  std::string refusal{};  ///< why nothing is done
};

/// Keys: 1 to 4 an arm, 0 all arms; c coordinates; up, down an axis; left, right jog it by a step, + and - change the
/// step, < and > the speed; a to an absolute coordinate; h home, o preset, g gripper, w tool, W weight, k model, v
/// servo, b bias, z clear fault, blank stop, : any instruction; m or Escape back. All but jogs and the stop open a line
/// of text: Enter sends, Escape drops it. So a letter alone moves nothing, and an instruction that is typed without the
/// colon is understood where its first letter opens a line. Blanks, a colon before the words, `ui_cli manual` before
/// them and the words that stand there already do no harm; an instruction that is too long is refused.
class ManualPage {
 public:
  /// @param arms  the first of them is chosen
  explicit ManualPage(std::vector<ManualArm> arms) : arms_(std::move(arms)) {}

  /// Takes the reading of an arm. @param arm  a name; unknown ones are ignored
  void show(const std::string& arm, const EffectorReply& reading);
  /// @param key  as Terminal::key() gives it  @return what has to be done now
  ManualDeed key(int key);
  /// @return whether a line of text is being typed: then every key but the panel's Ctrl-E belongs to it
  [[nodiscard]] bool typing() const { return prompt_.has_value(); }
  /// @return the line of text, as far as it has been typed
  [[nodiscard]] std::string prompt() const;

  /// Draws into the rows first..limit-1. On a small screen the lower rows go first; the chosen axis stays.
  void draw(Canvas& c, int first, int limit) const;
  /// Draws the help on the keys of this page.
  static void draw_help(class Rows& rows);
  /// Rows of draw_keys().
  static constexpr int kKeyRows = 3;
  /// The keys that mean something now. @param first  the uppermost of their rows
  void draw_keys(Canvas& c, int first) const;
  /// @return with their newest readings
  [[nodiscard]] const std::vector<ManualArm>& arms() const { return arms_; }

 private:
  enum class Space : std::uint8_t { motors, joints, euler, angle_axis };
  enum class Unit : std::uint8_t { motor, angle, length };
  enum class Needs : std::uint8_t { nothing, words, coordinate };  ///< what is to be typed before Enter
  struct Prompt {
    std::string label;          ///< what is asked for
    std::string words;          ///< what the instruction begins with
    std::string text{};         ///< typed so far
    Needs needs{Needs::words};  ///< coordinate: of the chosen axis
    std::string key{};  ///< that opened it, and may have been meant as the first letter of an instruction
  };

  [[nodiscard]] ManualDeed type(int key);
  [[nodiscard]] ManualDeed jog(double direction) const;
  [[nodiscard]] ManualDeed go_to(const std::string& line) const;
  [[nodiscard]] ManualDeed ask(Prompt prompt);
  [[nodiscard]] ManualDeed sent(const Prompt& asked) const;
  [[nodiscard]] bool choose(int key);
  [[nodiscard]] int coordinates() const;
  [[nodiscard]] Unit unit() const;
  [[nodiscard]] double step() const;
  [[nodiscard]] std::string whom() const;
  [[nodiscard]] std::string tail() const;
  [[nodiscard]] std::array<double, 8> values(const ManualArm& arm) const;
  /// The arms and the kinds of coordinates, of which one is chosen. @param column  after what stands in the row
  void draw_choices(Canvas& c, int row, int column) const;
  void draw_coordinates(Rows& rows) const;
  /// One of them, of all arms.
  void draw_coordinate(Canvas& c, int row, int axis) const;

  std::vector<ManualArm> arms_;
  std::size_t arm_{};
  bool all_{};
  Space space_{Space::joints};
  int axis_{};
  std::array<std::size_t, 3> step_{3, 3, 3};  // per unit, into the table of steps
  std::size_t speed_{1};
  std::optional<Prompt> prompt_;
};

}  // namespace mrroc::ui
