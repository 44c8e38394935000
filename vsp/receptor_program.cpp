#include "vsp/receptor_program.hpp"

#include <algorithm>
#include <string_view>

#include "vsp/recorded_status.hpp"

namespace mrroc::vsp {

int receptor_program(int argc, char** argv, const std::string& help, const link::NodeMain& body,
                     const std::function<int(int argc, char** argv)>& recorded) {
  const bool pictures = std::any_of(argv + 1, argv + argc, [](const char* word) {
    const std::string_view w = word;
    return w == "--source" || w.starts_with("--source=");
  });
  if (pictures) return recorded_status([&] { return recorded(argc, argv); });
  return link::child_main(argc, argv, help + "\n\nAs a part of a system:", body);
}

}  // namespace mrroc::vsp
