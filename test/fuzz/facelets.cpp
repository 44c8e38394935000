// Cubes as people write them: what is read and written again is the same cube.
#include "base/cube/facelets.hpp"

#include "base/cube/cube_text.hpp"
#include "base/cube/vocabulary.hpp"
#include "base/fault.hpp"
#include "test/fuzz/fuzz.hpp"

using namespace mrroc;

namespace {

template <class Read>
void read_and_write(std::string_view text, Read read) {
  try {
    const cube::Cube cube = read(text);
    fuzz::require(cube::cube_from_facelets(cube::to_facelets(cube)) == cube, "facelets tell the whole cube");
  } catch (const FaultError& e) {
    fuzz::require(e.fault().code == cube::kBadCube, "what is no cube is a bad cube");
    fuzz::require_readable(e.what());
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzz::text_of(data, size);
  read_and_write(text, cube::cube_from_facelets);
  read_and_write(text, cube::read_cube);
  read_and_write(text, cube::read_cube_line);
  const cube::FaceletReading reading = cube::read_facelets(text);
  fuzz::require(reading.cube.has_value() == (reading.broken == cube::CubeRule::none) &&
                    reading.text.empty() == reading.cube.has_value(),
                "a cube, or the rule that is broken");
  return 0;
}
