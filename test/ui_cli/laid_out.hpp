// Views of a task for tests of the screen, and what is to be seen on it.
#pragma once
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/link/text.hpp"
#include "test/ui_cli/fake_task.hpp"
#include "ui_cli/layout.hpp"

namespace mrroc::test {

using ui::Canvas;
using ui::lay_out;
using ui::Size;
using ui::Style;
using ui::View;

inline constexpr Size kSmallTerminal{24, 80};

inline View drawing() {
  View v;
  v.session = "drawing-1a2b";
  v.snapshot = ui::snapshot(drawing_status(), v.session);
  for (int k = 0; k < 100; ++k) v.history.add(*v.snapshot);
  v.messages = {{"mp", FaultCode::none, "all processes are ready"},
                {"edp arm1", FaultCode::lost_command, "number 7 expected"}};
  return v;
}

inline View largest() {
  task_status_t m = drawing_status();
  m.n_agents = 4;
  m.n_processes = 16;
  for (int k = 0; k < 16; ++k) link::put_text(m.process[k], "process " + std::to_string(k));
  View v = drawing();
  v.snapshot = ui::snapshot(m, v.session);
  return v;
}

/// A platform that drives, and an agent without an effector beside it.
inline View driving() {
  task_status_t m = drawing_status();
  m.effector[0] = static_cast<std::int8_t>(EffectorKind::platform);
  m.effector[1] = static_cast<std::int8_t>(EffectorKind::none);
  link::put_text(m.agent[0], "rex");
  link::put_text(m.agent[1], "map");
  m.T_0E[0][5] = -1.5707963;
  m.velocity[0][0] = 0.58;
  m.velocity[0][2] = -0.33;
  link::put_text(m.sensor_text[0], "odometry 260, map 0.1 s");
  link::put_text(m.agent_behaviour[0], "execute the plan");
  m.agent_m[1] = 1;
  link::put_text(m.agent_behaviour[1], "locate");
  View v;
  v.session = "rex_drive-1a2b";
  v.snapshot = ui::snapshot(m, v.session);
  for (int k = 0; k < 100; ++k) v.history.add(*v.snapshot);
  return v;
}

inline int row_of(const Canvas& c, const std::string& text) {
  for (int row = 0; row < c.size().rows; ++row)
    if (c.text(row).find(text) != std::string::npos) return row;
  return -1;
}

/// @return the style of the first character of the text, wherever it stands
inline Style style_of(const Canvas& c, const std::string& text) {
  const int row = row_of(c, text);
  EXPECT_GE(row, 0) << text << " is not to be seen in\n" << c.text();
  return row < 0 ? Style::plain : c.cell(row, static_cast<int>(c.text(row).find(text))).style;
}

inline void expect_seen(const Canvas& c, const std::vector<std::string>& texts) {
  for (const std::string& t : texts) EXPECT_GE(row_of(c, t), 0) << t << " is not to be seen in\n" << c.text();
}

}  // namespace mrroc::test
