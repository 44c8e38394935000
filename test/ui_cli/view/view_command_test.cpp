// Output of `ui_cli view`: the address of the page.
#include "ui_cli/view/view_command.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "test/docs/json_table.hpp"

namespace mrroc::view {
namespace {

/// Presses Ctrl-C as soon as something is to be read.
class Reader : public std::stringbuf {
 protected:
  int sync() override { return std::raise(SIGINT); }
};

std::string first_line(const std::vector<std::string>& arguments) {
  Reader reader;
  std::ostream out(&reader);
  std::ostringstream err;
  EXPECT_EQ(run_view(arguments, out, err), 0) << err.str();
  return reader.str();
}

TEST(ViewCommand, TellsTheAddressInWordsOrAsJson) {
  const std::string words = first_line({"--session", "nobody"});
  EXPECT_EQ(words.find("view: http://127.0.0.1:"), 0U) << words;
  const auto json = nlohmann::json::parse(first_line({"--session", "nobody", "--json"}));
  EXPECT_TRUE(test::documented("view", json));
  EXPECT_EQ(json.at("url").get<std::string>().find("http://127.0.0.1:"), 0U) << json;
}

}  // namespace
}  // namespace mrroc::view
