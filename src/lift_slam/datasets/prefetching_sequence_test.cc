#include "lift_slam/datasets/prefetching_sequence.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <stdexcept>

#include "lift_slam/datasets/dataset_test_files.h"

namespace lift_slam {
namespace {

// Frames without end, or up to one that throws.
class CountingSequence : public Sequence {
 public:
  CountingSequence(std::int64_t throw_at, std::atomic<int>& calls)
      : throw_at_(throw_at), calls_(calls) {}

  std::optional<SequenceFrame> Next() override {
    ++calls_;
    if (next_ == throw_at_) throw std::runtime_error("the disk is gone");
    SequenceFrame frame;
    frame.frame_index = next_++;
    return frame;
  }
  const SequenceInfo& info() const override { return info_; }

 private:
  SequenceInfo info_;
  std::int64_t throw_at_, next_ = 0;
  std::atomic<int>& calls_;
};

TEST(PrefetchingSequence, GivesTheSameFramesInTheSameOrder) {
  const TestFolder folder;
  for (int i = 0; i < 20; ++i) folder.WriteImage(fmt::format("{}.png", i), 10 * i, 40, 30);
  folder.Write("7.png", "no image");
  folder.Write("camera.yaml",
               "{model: pinhole, width: 40, height: 30, fx: 9, fy: 9, cx: 9, cy: 9}");
  const auto open = [&] { return OpenSequence(folder.path().string()); };
  const std::vector<SequenceFrame> expected = ReadAll(*open());
  for (const std::size_t num_ahead : {0, 1, 3, 100}) {
    PrefetchingSequence sequence(open(), num_ahead);
    EXPECT_EQ(sequence.info().num_frames, 20);
    const std::vector<SequenceFrame> frames = ReadAll(sequence);
    ASSERT_EQ(frames.size(), expected.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(frames[i].frame_index, expected[i].frame_index);
      EXPECT_EQ(frames[i].timestamp_ns, expected[i].timestamp_ns);
      EXPECT_EQ(frames[i].problem_text, expected[i].problem_text);
      ASSERT_EQ(frames[i].image.has_value(), expected[i].image.has_value());
      for (int y = 0; frames[i].image && y < 30; ++y) {
        EXPECT_EQ(std::memcmp(frames[i].image->row(y), expected[i].image->row(y), 40), 0);
      }
    }
    EXPECT_FALSE(sequence.Next()) << "the end stays the end";
  }
}

TEST(PrefetchingSequence, StopsEarlyAndReadsOnlySoFarAhead) {
  std::atomic<int> calls = 0;
  {
    PrefetchingSequence sequence(std::make_unique<CountingSequence>(-1, calls), 4);
    EXPECT_EQ(sequence.Next()->frame_index, 0);
    EXPECT_EQ(sequence.Next()->frame_index, 1);
  }
  EXPECT_LE(calls, 2 + 4 + 1);
  { const PrefetchingSequence unused(std::make_unique<CountingSequence>(-1, calls), 4); }
}

TEST(PrefetchingSequence, PassesOnAnExceptionAfterTheFramesBeforeIt) {
  std::atomic<int> calls = 0;
  PrefetchingSequence sequence(std::make_unique<CountingSequence>(3, calls), 2);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(sequence.Next()->frame_index, i);
  EXPECT_THROW(sequence.Next(), std::runtime_error);
  EXPECT_THROW(sequence.Next(), std::runtime_error);
}

}  // namespace
}  // namespace lift_slam
