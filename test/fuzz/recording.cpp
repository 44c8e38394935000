// Recordings: what is read and written again reads as the same, bit for bit.
#include "tasks/drawing/recording.hpp"

#include "base/text_file.hpp"
#include "tasks/drawing/input.hpp"
#include "test/fuzz/fuzz.hpp"

using namespace mrroc;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const drawing::Taught taught = drawing::parse_recording(fuzz::text_of(data, size), "r.taught");
    fuzz::require(
        drawing::parse_recording(drawing::recording_text(taught, "r.taught"), "again.taught") == taught,
        "a recording is saved and loaded without a change");
    drawing::check(drawing::strokes_of(taught.ink), "r.taught", taught.ink.size());
  } catch (const FileError& e) {
    fuzz::require_readable(e.what());
    fuzz::require(std::string_view(e.what()).starts_with("r.taught"), "an error names the file");
  }
  return 0;
}
