// Configurations: what is read and written again reads as the same.
#include "base/config.hpp"
#include "test/fuzz/fuzz.hpp"

using namespace mrroc;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzz::text_of(data, size));
  try {
    const Config config = Config::parse(text, "a.toml");
    const std::string written = config.dump();
    fuzz::require(Config::parse(written, "b.toml").dump() == written, "a dump reads as what was dumped");
    try {
      config.check_all_used();
    } catch (const ConfigError& e) {
      fuzz::require_readable(e.what());
    }
  } catch (const ConfigError& e) {
    fuzz::require_readable(e.what());
    fuzz::require(std::string_view(e.what()).starts_with("a.toml"), "an error names the file");
  }
  try {
    Config().set(text);
  } catch (const ConfigError&) {  // it tells the whole option, however long
  }
  return 0;
}
