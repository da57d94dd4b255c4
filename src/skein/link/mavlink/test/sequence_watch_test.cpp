// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/sequence_watch.h"

#include <gtest/gtest.h>

#include <initializer_list>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace skein::mavlink::sequence_watch_test {
namespace {

// Frames of one sender, or of two, with these counts.
struct Heard {
  SequenceWatch watch;
  void hear(std::uint8_t component, std::initializer_list<int> counts) {
    for (const int count : counts) {
      FrameWriter writer(1, component);
      for (int k = 0; k < count; ++k) writer.write(Heartbeat());
      FrameParser().read(writer.write(Heartbeat()),
                         [&](const Frame& frame) { watch.hear(frame); });
    }
  }
};

TEST(SequenceWatch, CountsWhatIsMissing) {
  Heard x;
  x.hear(1, {3, 4, 7, 8});
  EXPECT_EQ(x.watch.lost(), 2U);
  EXPECT_DOUBLE_EQ(x.watch.loss(), 2.0 / 6);
}

TEST(SequenceWatch, GoesOnFrom255To0) {
  Heard x;
  x.hear(1, {254, 255, 0, 2});
  EXPECT_EQ(x.watch.lost(), 1U);
}

TEST(SequenceWatch, TellsSendersApart) {
  Heard x;
  x.hear(1, {1, 2});
  x.hear(2, {100, 101});
  x.hear(1, {3});
  EXPECT_EQ(x.watch.lost(), 0U);
}

TEST(SequenceWatch, WhatComesLateWasNotLostAndWhatComesTwiceCountsOnce) {
  Heard x;
  x.hear(1, {1, 3, 2, 4, 4});
  EXPECT_EQ(x.watch.lost(), 0U);
  EXPECT_EQ(x.watch.heard(), 4U);
}

TEST(SequenceWatch, ASenderThatBeginsAnewHasLostNothing) {
  Heard x;
  x.hear(1, {100, 101, 0, 1});
  EXPECT_EQ(x.watch.lost(), 0U);
}

}  // namespace
}  // namespace skein::mavlink::sequence_watch_test
