// An operator command server and its terminal, for tests.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/link/text.hpp"
#include "mp/operator_command_server.hpp"
#include "mrroc/console_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::mp {

/// Tests of the command server; they have a folder of their own.
class CommandServer : public ::testing::Test {
 protected:
  CommandServer() {
    std::string pattern = (std::filesystem::temp_directory_path() / "command_server_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~CommandServer() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& text) const {
    std::filesystem::path file = folder_ / "script";
    std::ofstream(file) << text;
    return file;
  }
  std::filesystem::path folder_;
};

/// A command server and its terminal.
struct CommandServerFixture {
  explicit CommandServerFixture(
      std::vector<ScriptedOrder> script = {}, const std::filesystem::path& record = {},
      link::NodeContext m =
          [] {
            link::NodeContext me;
            me.session = "s";
            me.name = "mp";
            me.roster = {"mp"};
            return me;
          }())
      : process(bus, std::move(m)),
        command_server(process, std::move(script), record),
        orders(bus, process.route("operator"), m.session_id),
        answers(bus, process.route("answer"), m.session_id),
        lines(bus, process.route("mp.console"), m.session_id) {}

  /// Gives an order from the terminal. @return the answer; what earlier orders are still told is passed over
  operator_answer_t order(std::int64_t number_of_order, int number) {
    operator_order_t m{};
    m.id = number_of_order;
    m.order = number;
    orders.publish(m, 0);
    command_server.poll();
    auto a = answers.take();
    while (a && a->id != number_of_order) a = answers.take();
    EXPECT_TRUE(a);
    return a.value_or(operator_answer_t{});
  }
  bool accepts(OperatorOrder o) {
    const auto a = order(++id, static_cast<int>(o));
    EXPECT_FALSE(link::get_text(a.text).empty());
    return a.accepted;
  }

  link::test::DirectBus bus;
  link::Process process;
  OperatorCommandServer command_server;
  link::Outbox<operator_order_t> orders;
  link::Queue<operator_answer_t> answers;
  link::Queue<console_t> lines;
  std::int64_t id{1000};
};

}  // namespace mrroc::mp
