// The small values that everything else is made of: texts, fingerprints, statistics, pictures, the pace of steps.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

#include "base/clock.hpp"
#include "base/cube/cube_face.hpp"
#include "base/effector_command.hpp"
#include "base/fault.hpp"
#include "base/file_content.hpp"
#include "base/fixed_text.hpp"
#include "base/hash.hpp"
#include "base/image.hpp"
#include "base/joined.hpp"
#include "base/link/text.hpp"
#include "base/operator.hpp"
#include "base/pen_state.hpp"
#include "base/printable.hpp"
#include "base/signals.hpp"
#include "base/standard_files.hpp"
#include "base/statistics.hpp"

namespace mrroc {
namespace {

TEST(FixedText, KeepsWhatFits) {
  using Text = FixedText<4>;
  for (const auto& [given, kept] :
       {std::pair("", ""), std::pair("abc", "abc"), std::pair("abcd", "abcd"), std::pair("abcde", "abcd")})
    EXPECT_EQ(Text(given).view(), kept);
  EXPECT_TRUE(Text().empty());
  EXPECT_TRUE(Text("").empty());
  EXPECT_FALSE(Text("a").empty());
  EXPECT_EQ(Text("abcde"), Text("abcd"));
  EXPECT_FALSE(Text("abc") == Text("abd"));
}

TEST(TextOfAMessage, IsCutOffFilledWithZerosAndPrintable) {
  std::int8_t field[5];
  std::fill(std::begin(field), std::end(field), std::int8_t{'x'});
  link::put_text(field, "ab");
  EXPECT_EQ(link::get_text(field), "ab");
  for (const std::size_t k : {2U, 3U, 4U}) EXPECT_EQ(field[k], 0);
  link::put_text(field, "abcdefg");
  EXPECT_EQ(link::get_text(field), "abcde");
  link::put_text(field, "\x1f ~\x7f\x80");
  EXPECT_EQ(link::get_text(field), "? ~??");
}

TEST(TextOfAMessage, KeepsTheLettersOfAnyLanguageAndNoControls) {
  std::int8_t field[24];
  for (const auto& [given, shown] : {std::pair{"Z\xc3\xbcrich", "Z\xc3\xbcrich"},
                                     {"\xe6\x97\xa5\xf0\x9f\xa4\x96", "\xe6\x97\xa5\xf0\x9f\xa4\x96"},
                                     {"\xc2\x9b"
                                      "2J",
                                      "?2J"},  // a control of UTF-8
                                     {"\x9b"
                                      "2J",
                                      "?2J"},                       // one of Latin-1
                                     {"a\xe6\x97", "a??"},          // cut off
                                     {"\xc0\x9b", "??"},            // a control, written too long
                                     {"\xed\xa0\x80", "???"},       // half of a pair
                                     {"\xf5\x80\x80\x80", "????"},  // beyond the last character
                                     {"\x1b[2J", "?[2J"}}) {
    link::put_text(field, given);
    EXPECT_EQ(link::get_text(field), shown) << given;
    EXPECT_EQ(without_controls(given), shown) << "one rule";
  }
}

TEST(Joined, HasTheSeparatorBetweenAndNowhereElse) {
  EXPECT_EQ(joined(std::vector<std::string>{}, ", "), "");
  EXPECT_EQ(joined(std::vector<std::string>{"a"}, ", "), "a");
  EXPECT_EQ(joined(std::vector<std::string>{"a", "", "c"}, ", "), "a, , c");
  EXPECT_EQ(joined(std::vector{1, 2}, "-", [](int k) { return std::to_string(10 * k); }), "10-20");
}

// Values of FNV-1a with 64 bits, from its authors' list.
TEST(Hash, IsFnv1a) {
  const auto of = [](std::string_view text) {
    Hash h;
    h.add(text);
    return h.value();
  };
  EXPECT_EQ(of(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(of("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(of("foobar"), 0x85944171f73967e8ULL);
  Hash bytes, number;
  const std::array<std::uint8_t, 8> little{0x88, 0x77, 0x66, 0x55, 0x44, 0x33, 0x22, 0x11};
  bytes.add(little);
  number.add(std::uint64_t{0x1122334455667788});
  EXPECT_EQ(bytes.value(), number.value()) << "from the lowest byte on";
}

TEST(Statistics, AreThoseOfTheNumbers) {
  Statistics s;
  EXPECT_TRUE(std::isnan(s.mean()));
  EXPECT_EQ(s.least(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(s.most(), -std::numeric_limits<double>::infinity());
  for (const double x : {-1., 3., 4.}) s.add(x);
  EXPECT_EQ(s.mean(), 2);
  EXPECT_NEAR(s.deviation(), std::sqrt((9 + 1 + 4) / 3.), 1e-12);
  EXPECT_EQ(s.least(), -1);
  EXPECT_EQ(s.most(), 4);
}

TEST(Image, LiesRowByRowWithItsChannelsTogether) {
  Image image(3, 2, 3);
  EXPECT_EQ(image.data, std::vector<std::uint8_t>(18, 0)) << "black";
  image.row(1)[3 * 2 + 1] = 7;
  const ImageView view = image.view();
  EXPECT_EQ(view.size(), 18U);
  EXPECT_EQ(view.at(2, 1, 1), 7);
  EXPECT_EQ(view.at(2, 0, 1), 0);
  EXPECT_EQ(view.at(1, 1, 1), 0);
  EXPECT_EQ(view.bytes()[3 * 3 + 3 * 2 + 1], 7);
  EXPECT_EQ(view.row(1), view.data + 9);
  EXPECT_FALSE(view.empty());
  EXPECT_FALSE(image.empty());
  EXPECT_TRUE(ImageView{}.empty());
  EXPECT_TRUE(Image{}.empty());
  for (const auto& [w, h] : {std::pair(0, 2), std::pair(3, 0), std::pair(-1, 2)})
    EXPECT_TRUE((ImageView{w, h, 3, image.data.data()}).empty());
}

TEST(Pacer, GivesEveryStepItsTimeAndMakesUpForSmallDelaysOnly) {
  using namespace std::chrono_literals;
  const Pacer::Time start{1000s};
  Pacer pacer(0.01, 50ms);
  pacer.begin(start);
  EXPECT_EQ(pacer.next(1, start), start + 10ms);
  EXPECT_EQ(pacer.next(0.5, start + 10ms), start + 30ms) << "half the speed, twice the time";
  EXPECT_EQ(pacer.next(1, start + 90ms), start + 40ms) << "50 ms late: the time is made up for";
  EXPECT_EQ(pacer.next(1, start + 101ms), start + 101ms) << "51 ms late: it begins anew";
  EXPECT_EQ(pacer.next(1, start + 101ms), start + 111ms);
  EXPECT_EQ(pacer.next(0, start + 105ms), start + 105ms) << "as fast as possible";
  EXPECT_EQ(pacer.next(1, start + 105ms), start + 115ms);
}

TEST(CubeFaceShape, NumbersStickersRowByRowFromTheUpperLeft) {
  const CubeFaceShape shape{.edge = 0.06};
  EXPECT_LT((shape.middle(0) - Vector3(-0.02, 0.02, 0)).norm(), 1e-12);
  EXPECT_LT((shape.middle(2) - Vector3(0.02, 0.02, 0)).norm(), 1e-12);
  EXPECT_LT(shape.middle(4).norm(), 1e-12);
  EXPECT_LT((shape.middle(6) - Vector3(-0.02, -0.02, 0)).norm(), 1e-12);
}

TEST(CubeFaceShape, HasStickersApartFromEachOtherUnlessToldOtherwise) {
  EXPECT_GT(kCubeFace.sticker, 0.2 * kCubeFace.edge);
  EXPECT_LT(kCubeFace.sticker, kCubeFace.edge / 3);
  EXPECT_EQ(CubeFaceShape{}.edge, kCubeFace.edge);
}

TEST(Tint, IsTheLogarithmOfRedAndBlueOverGreenWithALittleGrey) {
  const double grey = 1 + 0.03 * (200 + 50 + 100);
  const auto t = tint({200, 50, 100});
  EXPECT_NEAR(t[0], std::log((200 + grey) / (50 + grey)), 1e-12);
  EXPECT_NEAR(t[1], std::log((100 + grey) / (50 + grey)), 1e-12);
}

// What a lamp of unknown colour adds changes both tints: the derivative of the logarithm, and the lamp's own tint.
TEST(Tint, VarianceIsThatOfLightThatMayBeInIt) {
  StickerReading s;
  s.rgb = {200, 50, 100};
  s.deviation = 5;
  const double grey = 1 + 0.03 * 350, red = 5 / (200 + grey), green = 5 / (50 + grey),
               blue = 5 / (100 + grey);
  const auto v = s.tint_variance();
  EXPECT_NEAR(v[0], (red - green) * (red - green) + 0.1 * (red * red + green * green), 1e-12);
  EXPECT_NEAR(v[1], (blue - green) * (blue - green) + 0.1 * (blue * blue + green * green), 1e-12);
}

TEST(OperatorNames, AreThoseOfTerminalsAndScripts) {
  std::vector<std::string_view> orders, states;
  for (const OperatorOrder o : kOperatorOrders) orders.push_back(to_string(o));
  EXPECT_EQ(orders, (std::vector<std::string_view>{"start", "pause", "resume", "trigger", "stop", "e-stop"}));
  for (int s = 0; s <= static_cast<int>(TaskState::ended); ++s)
    states.push_back(to_string(static_cast<TaskState>(s)));
  EXPECT_EQ(states, (std::vector<std::string_view>{"starting", "waiting for start", "running", "paused",
                                                   "stopping", "ending", "ended"}));
  EXPECT_EQ(to_string(static_cast<OperatorOrder>(6)), "?");
  EXPECT_EQ(to_string(static_cast<TaskState>(7)), "?");
}

TEST(DriverStateNames, AreInTheOrderOfTheStates) {
  std::vector<std::string_view> names;
  for (int s = 0; s <= static_cast<int>(DriverState::jogging); ++s)
    names.push_back(to_string(static_cast<DriverState>(s)));
  EXPECT_EQ(names, (std::vector<std::string_view>{"not synchronised", "homing", "ready", "executing",
                                                  "decelerating", "holding", "faulted", "jogging"}));
  EXPECT_EQ(to_string(static_cast<DriverState>(99)), "unknown");
}

TEST(PenStateNames, AreThoseOfTheCodeAndComeBack) {
  std::vector<std::string_view> names;
  for (const PenState s : kPenStates) {
    names.push_back(to_string(s));
    EXPECT_EQ(pen_state_named(names.back()), s);
  }
  EXPECT_EQ(names, (std::vector<std::string_view>{"above_paper", "lowering", "paper_surface", "lift_off"}));
  EXPECT_EQ(to_string(static_cast<PenState>(4)), "?");
  EXPECT_FALSE(pen_state_named("?"));
  EXPECT_FALSE(pen_state_named(""));
}

TEST(StandardFiles, ThatAreClosedAreOpenedOnNothingAndTheOthersStay) {
  for (int closed = 0; closed < 8; ++closed) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int file = 0; file < 3; ++file)
        if (closed >> file & 1) ::close(file);
      struct stat before[3]{}, now[3]{}, null{};
      for (int file = 0; file < 3; ++file) ::fstat(file, &before[file]);
      keep_standard_files();
      ::stat("/dev/null", &null);
      for (int file = 0; file < 3; ++file) {
        if (::fstat(file, &now[file]) != 0) ::_exit(1);
        const struct stat& wanted = closed >> file & 1 ? null : before[file];
        if (now[file].st_ino != wanted.st_ino || now[file].st_dev != wanted.st_dev) ::_exit(2);
        if ((closed >> file & 1) && (::fcntl(file, F_GETFL) & O_ACCMODE) != (file == 0 ? O_RDONLY : O_WRONLY))
          ::_exit(3);
      }
      ::_exit(0);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << closed;
  }
}

/// @return exit status of a program that says something into a file and ends as it did
int said_into(int file, int status) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGPIPE, SIG_IGN);
    ::dup2(file, STDOUT_FILENO);
    std::fputs("something", stdout);
    ::_exit(end_standard_output(status));
  }
  int ended = -1;
  ::waitpid(child, &ended, 0);
  return WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
}

TEST(StandardFiles, OutputThatCannotBeWrittenIsAnErrorUnlessNobodyReadsIt) {
  std::fflush(stdout);  // the children would say it once more
  const int full = ::open("/dev/full", O_WRONLY), nothing = ::open("/dev/null", O_WRONLY);
  EXPECT_EQ(said_into(nothing, 0), 0);
  EXPECT_EQ(said_into(full, 0), exit_status(FaultCode::cannot_write));
  EXPECT_EQ(said_into(full, 1), 1) << "it was told of another error already";
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  ::close(pipe[0]);
  EXPECT_EQ(said_into(pipe[1], 0), 0) << "as behind head -1";
  for (const int file : {full, nothing, pipe[1]}) ::close(file);
}

TEST(FileContent, IsAllOfItOrNothing) {
  const auto file = std::filesystem::temp_directory_path() / ("values_test." + std::to_string(::getpid()));
  const std::string all("a\r\n\0\xff b", 7);
  std::ofstream(file, std::ios::binary) << all;
  EXPECT_EQ(file_content(file), all);
  std::filesystem::remove(file);
  EXPECT_EQ(file_content(file), "");
}

TEST(Signals, AWriteThatCannotBeDoneIsAnErrorAndNotTheEnd) {
  const pid_t child = ::fork();
  if (child == 0) {
    report_failed_writes();
    int ends[2];
    if (::pipe(ends) != 0) ::_exit(1);
    ::close(ends[0]);
    if (::write(ends[1], "x", 1) != -1 || errno != EPIPE) ::_exit(2);
    ::raise(SIGXFSZ);
    ::_exit(0);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST(CubeFaceNames, AreDifferent) {
  std::vector<std::string_view> names;
  for (int c = 0; c < kStickerColours; ++c) names.push_back(to_string(static_cast<StickerColour>(c)));
  EXPECT_EQ(names, (std::vector<std::string_view>{"white", "red", "green", "yellow", "orange", "blue"}));
  EXPECT_EQ(to_string(StickerFlaw::none), "none");
  EXPECT_EQ(to_string(StickerFlaw::hidden), "hidden");
  EXPECT_EQ(to_string(StickerFlaw::glaring), "glaring");
  EXPECT_EQ(to_string(StickerFlaw::dark), "dark");
  EXPECT_EQ(to_string(StickerFlaw::mixed), "mixed");
}

}  // namespace
}  // namespace mrroc
