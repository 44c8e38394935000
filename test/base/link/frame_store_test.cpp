#include "base/link/frame_store.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <random>
#include <thread>
#include <tuple>

#include "base/fault.hpp"
#include "test/base/link/short_transfers.hpp"
#include "test/open_files.hpp"

namespace mrroc::link {
namespace {

using namespace std::chrono_literals;

class FrameStore : public ::testing::Test {
 protected:
  FrameStore() {
    name_.directory = std::filesystem::temp_directory_path() /
                      ("mrroc-frames-test-" + std::to_string(::getpid()) + "-" +
                       ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(name_.directory);
  }
  ~FrameStore() override { std::filesystem::remove_all(name_.directory); }

  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(name_.directory), {}));
  }

  [[nodiscard]] std::size_t image_size() const { return picture(0, shape_).data.size(); }

  static Image picture(int seed, const FrameStoreShape& shape) {
    Image image(shape.width, shape.height, shape.channels);
    std::mt19937 random(static_cast<unsigned>(seed));
    for (auto& byte : image.data) byte = static_cast<std::uint8_t>(random());
    return image;
  }

  static FaultCode code_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const FaultError& e) {
      return e.fault().code;
    }
    return FaultCode::none;
  }

  FrameStoreName name_{"s", 7, "sac", {}};
  FrameStoreShape shape_{33, 21, 3, 4};
};

TEST_F(FrameStore, GivesEveryPictureBackWithItsStepAndTime) {
  FrameWriter writer(name_, shape_);
  FrameReader reader = FrameReader::open(name_).value();
  EXPECT_EQ(reader.shape(), shape_);
  Frame frame;
  for (int k = 0; k < 11; ++k) {
    const Image image = picture(k, shape_);
    const int slot = writer.write(k, 20 * k, 0.04 * k, image.view());
    ASSERT_EQ(reader.read(slot, k, frame), FrameFate::read);
    EXPECT_EQ(frame.image, image);
    EXPECT_EQ(frame.frame, k);
    EXPECT_EQ(frame.step, 20 * k);
    EXPECT_EQ(frame.t, 0.04 * k);
  }
}

TEST_F(FrameStore, GivesWholePicturesThoughTheKernelMovesAFewBytesAtATimeAndIsInterrupted) {
  for (const std::size_t most : {1U, 7U, 500U}) {
    const test::ShortTransfers kernel(most);
    FrameWriter writer(name_, shape_);
    FrameReader reader = FrameReader::open(name_).value();
    Frame frame;
    for (int k = 0; k < 6; ++k) {
      const Image image = picture(k, shape_);
      ASSERT_EQ(reader.read(writer.write(k, 20 * k, 0.04 * k, image.view()), k, frame), FrameFate::read);
      EXPECT_EQ(frame.image, image);
      EXPECT_EQ(frame.step, 20 * k);
    }
    EXPECT_GT(test::ShortTransfers::calls(), 12 * image_size() / most);
  }
}

TEST_F(FrameStore, OneFrameMayBeReadFromStoresOfDifferentSizes) {
  const FrameStoreShape other{5, 4, 1, 2};
  FrameStoreName second = name_;
  second.camera = "eih";
  FrameWriter writer(name_, shape_), small(second, other);
  FrameReader reader = FrameReader::open(name_).value(), small_reader = FrameReader::open(second).value();
  Frame frame;
  for (int k = 0; k < 5; ++k) {
    const Image image = picture(k, shape_), little = picture(k, other);
    ASSERT_EQ(reader.read(writer.write(k, k, 0, image.view()), k, frame), FrameFate::read);
    EXPECT_EQ(frame.image, image);
    ASSERT_EQ(small_reader.read(small.write(k, k, 0, little.view()), k, frame), FrameFate::read);
    EXPECT_EQ(frame.image, little);
  }
}

TEST_F(FrameStore, LeavesNoFileOpen) {
  const auto before = mrroc::test::open_files();
  {
    FrameWriter writer(name_, shape_);
    FrameReader reader = FrameReader::open(name_).value();
    EXPECT_EQ(mrroc::test::open_files(), before + 2);
    FrameReader moved = std::move(reader);
    reader = FrameReader::open(name_).value();
    EXPECT_EQ(mrroc::test::open_files(), before + 3);
    moved = std::move(reader);
    EXPECT_THROW(FrameWriter(name_, shape_), FaultError);
    std::filesystem::resize_file(name_.path(), 20'000);
    EXPECT_THROW(std::ignore = FrameReader::open(name_), FaultError);
  }
  EXPECT_EQ(mrroc::test::open_files(), before);
}

TEST_F(FrameStore, WhatOthersHaveInTheFolderStays) {
  const std::string user = std::to_string(::geteuid());
  for (const char* const name : {"frames", "mrroc-frames-", "mrroc-frames-999999.s.7.sac"})
    std::ofstream(name_.directory / name) << "text";
  std::ofstream(name_.directory / ("mrroc-frames-" + user + ".s.7.dead")) << "text";
  { const FrameWriter writer(name_, shape_); }
  EXPECT_EQ(files(), 3U) << "and its own dead one does not";
}

TEST_F(FrameStore, APictureThatIsBeingWrittenIsNone) {
  FrameWriter writer(name_, shape_);
  FrameReader reader = FrameReader::open(name_).value();
  const int slot = writer.write(0, 0, 0, picture(0, shape_).view());
  Frame frame;
  const auto with_sequence = [&](char sequence) {
    std::fstream file(name_.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(4096);
    file.put(sequence);
    file.close();
    return reader.read(slot, 0, frame);
  };
  EXPECT_EQ(with_sequence(2), FrameFate::read);
  EXPECT_EQ(with_sequence(3), FrameFate::overwritten);
  EXPECT_EQ(with_sequence(0), FrameFate::overwritten) << "nothing was written";
  EXPECT_EQ(with_sequence(4), FrameFate::read);
}

TEST_F(FrameStore, ThatFindsNoRoomIsRefusedAndNotLeft) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{10'000, 10'000};
    ::setrlimit(RLIMIT_FSIZE, &small);
    try {
      const FrameWriter writer(name_, shape_);
      ::_exit(1);
    } catch (const FaultError& e) {
      const std::string why = "cannot use " + name_.path().string() + ": File too large";
      ::_exit(e.fault().code == FaultCode::cannot_write && e.what() == why ? 0 : 2);
    }
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(files(), 0U);
}

TEST_F(FrameStore, OfAnotherUserIsRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  const FrameWriter writer(name_, shape_);
  ASSERT_EQ(::chown(name_.path().c_str(), 65534, 65534), 0);
  EXPECT_EQ(code_of([&] { std::ignore = FrameReader::open(name_); }), FaultCode::malformed_message);
}

TEST_F(FrameStore, KeepsAsManyPicturesAsItHasSlots) {
  FrameWriter writer(name_, shape_);
  FrameReader reader = FrameReader::open(name_).value();
  std::vector<int> slots;
  for (int k = 0; k < 6; ++k) slots.push_back(writer.write(k, k, 0, picture(k, shape_).view()));
  Frame frame;
  for (int k = 0; k < 6; ++k)
    EXPECT_EQ(reader.read(slots[static_cast<std::size_t>(k)], k, frame),
              k < 2 ? FrameFate::overwritten : FrameFate::read);
}

TEST_F(FrameStore, TellsOfSlotsThatAreNotThereOrEmpty) {
  FrameWriter writer(name_, shape_);
  FrameReader reader = FrameReader::open(name_).value();
  Frame frame;
  EXPECT_EQ(reader.read(-1, 0, frame), FrameFate::malformed);
  EXPECT_EQ(reader.read(shape_.slots, 0, frame), FrameFate::malformed);
  EXPECT_EQ(reader.read(0, 0, frame), FrameFate::overwritten);
  EXPECT_EQ(reader.read(0, -1, frame), FrameFate::overwritten);
  EXPECT_TRUE(frame.image.empty());
}

TEST_F(FrameStore, NeverGivesHalfOfOnePictureAndHalfOfAnother) {
  const FrameStoreShape shape{640, 480, 1, 2};
  FrameWriter writer(name_, shape);
  FrameReader reader = FrameReader::open(name_).value();
  std::atomic<std::int64_t> newest{-1};
  std::jthread camera([&](const std::stop_token& stop) {
    Image image(shape.width, shape.height, 1);
    for (std::int64_t k = 0; !stop.stop_requested(); ++k) {
      std::ranges::fill(image.data, static_cast<std::uint8_t>(k));
      writer.write(k, k, 0, image.view());
      newest = k;
      if (k % 4 == 0) std::this_thread::sleep_for(100us);
    }
  });
  int read = 0;
  Frame frame;
  while (read < 200) {
    const std::int64_t k = newest - 1;  // the one that will be written over next
    if (k < 0 || reader.read(static_cast<int>(k % 2), k, frame) != FrameFate::read) continue;
    ++read;
    const auto grey = static_cast<std::uint8_t>(k);
    ASSERT_TRUE(std::ranges::all_of(frame.image.data, [&](std::uint8_t x) { return x == grey; }));
  }
}

TEST_F(FrameStore, LivesOnWithoutItsNameAndLeavesNothing) {
  {
    FrameWriter writer(name_, shape_);
    FrameReader reader = FrameReader::open(name_).value();
    EXPECT_EQ(files(), 1U);
    writer.hide();
    EXPECT_EQ(files(), 0U);
    Frame frame;
    const Image image = picture(1, shape_);
    EXPECT_EQ(reader.read(writer.write(5, 100, 0.2, image.view()), 5, frame), FrameFate::read);
    EXPECT_EQ(frame.image, image);
    EXPECT_FALSE(FrameReader::open(name_));
    auto late = FrameReader::open_hidden(name_, ::getpid());
    ASSERT_TRUE(late) << "through the process that has it";
    EXPECT_EQ(late->read(writer.write(6, 120, 0.24, image.view()), 6, frame), FrameFate::read);
    FrameStoreName other = name_;
    other.camera = "other";
    EXPECT_FALSE(FrameReader::open_hidden(other, ::getpid()));
    EXPECT_FALSE(FrameReader::open_hidden(name_, 0)) << "there is no such process";
  }
  { FrameWriter writer(name_, shape_); }
  EXPECT_EQ(files(), 0U);
}

TEST_F(FrameStore, ThatIsBeingMadeIsNotThereYet) {
  EXPECT_FALSE(FrameReader::open(name_));
  FrameWriter writer(name_, shape_);
  EXPECT_TRUE(FrameReader::open(name_));
  std::filesystem::resize_file(name_.path(), 3);
  EXPECT_FALSE(FrameReader::open(name_));
}

TEST_F(FrameStore, OfAKilledRunIsSweptAwayAndThatOfALivingOneIsNot) {
  FrameStoreName other = name_;
  other.camera = "eih";
  const pid_t child = ::fork();
  if (child == 0) {
    new FrameWriter(other, shape_);
    ::kill(::getpid(), SIGKILL);
  }
  int status{};
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(files(), 1U);
  const FrameWriter writer(name_, shape_);
  EXPECT_EQ(files(), 1U) << "that of the killed one is still there";
  const FrameWriter again(other, shape_);
  EXPECT_EQ(files(), 2U);
  EXPECT_EQ(code_of([&] { FrameWriter twice(name_, shape_); }), FaultCode::session_in_use);
  EXPECT_EQ(files(), 2U);
}

TEST_F(FrameStore, RefusesWhatIsNoStore) {
  const auto refused = [&](auto spoil) {
    FrameWriter writer(name_, shape_);
    spoil(name_.path());
    return code_of([&] { std::ignore = FrameReader::open(name_); });
  };
  const auto overwrite = [](const std::filesystem::path& path, int place, std::uint8_t byte) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(place);
    file.put(static_cast<char>(byte));
  };
  using Path = const std::filesystem::path&;
  EXPECT_EQ(refused([](Path) {}), FaultCode::none);
  EXPECT_EQ(refused([](Path p) { std::filesystem::resize_file(p, 20'000); }), FaultCode::malformed_message);
  EXPECT_EQ(refused([](Path p) { std::filesystem::resize_file(p, 10'000'000); }),
            FaultCode::malformed_message);
  for (const int place : {0, 7, 8, 11, 12, 16, 20, 24})  // magic, width, height, channels, slots, session
    EXPECT_EQ(refused([&](Path p) { overwrite(p, place, 0x7f); }), FaultCode::malformed_message) << place;
}

TEST_F(FrameStore, ThatIsCutShortIsToldOfAndCrashesNobody) {
  FrameWriter writer(name_, shape_);
  FrameReader reader = FrameReader::open(name_).value();
  const int slot = writer.write(0, 0, 0, picture(0, shape_).view());
  std::filesystem::resize_file(name_.path(), 4096);
  Frame frame;
  EXPECT_EQ(reader.read(slot, 0, frame), FrameFate::malformed);
}

TEST_F(FrameStore, RefusesPicturesOfAnotherSize) {
  FrameWriter writer(name_, shape_);
  FrameStoreShape other = shape_;
  ++other.width;
  EXPECT_EQ(code_of([&] { writer.write(0, 0, 0, picture(0, other).view()); }), FaultCode::internal_error);
  name_.camera = "x";
  for (const FrameStoreShape& wrong : {FrameStoreShape{0, 10, 1, 4},
                                       {4097, 10, 1, 4},
                                       {10, 0, 1, 4},
                                       {10, 4097, 1, 4},
                                       {10, 10, 0, 4},
                                       {10, 10, 2, 4},
                                       {10, 10, 4, 4},
                                       {10, 10, 1, 1},
                                       {10, 10, 1, 65}})
    EXPECT_EQ(code_of([&] { FrameWriter refused(name_, wrong); }), FaultCode::internal_error);
  EXPECT_EQ(files(), 1U);
}

TEST_F(FrameStore, IsMadeForAnySizeUpToItsLimits) {
  using Shape = FrameStoreShape;
  for (const Shape& good : {Shape{4096, 1, 1, 2}, Shape{1, 4096, 3, 2}, Shape{1, 1, 1, 64}}) {
    FrameWriter writer(name_, good);
    FrameReader reader = FrameReader::open(name_).value();
    EXPECT_EQ(reader.shape(), good);
    Frame frame;
    const Image image = picture(1, good);
    EXPECT_EQ(reader.read(writer.write(3, 4, 0.5, image.view()), 3, frame), FrameFate::read);
    EXPECT_EQ(frame.image, image);
  }
  for (const Shape& bad :
       {Shape{4097, 1, 1, 2}, Shape{1, 4097, 1, 2}, Shape{1, 1, 1, 65}, Shape{1, 1, 1, 1}, Shape{1, 0, 1, 2},
        Shape{-1, 1, 1, 2}, Shape{1, 1, 0, 2}, Shape{1, 1, 2, 2}, Shape{1, 1, 4, 2}})
    EXPECT_EQ(code_of([&] { FrameWriter refused(name_, bad); }), FaultCode::internal_error);
}

TEST_F(FrameStore, IsNamedAfterItsUserSessionAndCamera) {
  EXPECT_EQ(name_.path(), name_.directory / ("mrroc-frames-" + std::to_string(::geteuid()) + ".s.7.sac"));
}

TEST_F(FrameStore, SaysWhereItCannotBeMade) {
  name_.directory /= "nowhere";
  EXPECT_EQ(code_of([&] { FrameWriter refused(name_, shape_); }), FaultCode::cannot_write);
}

}  // namespace
}  // namespace mrroc::link
