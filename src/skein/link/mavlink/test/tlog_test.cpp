// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/tlog.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace skein::mavlink::tlog_test {
namespace {

TEST(Tlog, HasATimeBeforeEachFrameAndNoSignatures) {
  const auto file = std::filesystem::path(testing::TempDir()) / "skein-tlog-test.tlog";
  auto tlog = TlogWriter::create(file);
  ASSERT_TRUE(tlog.ok());
  FrameWriter plain(1, 1), secure(1, 1);
  Signer signer(key_of("key"), 2, 0);
  Attitude attitude;
  attitude.yaw = 1.5F;
  std::vector<std::byte> expected;
  for (const bool is_signed : {false, true}) {
    const auto bytes =
        is_signed ? secure.write(attitude, signer, 7) : plain.write(attitude);
    FrameParser().read(bytes, [&](const Frame& frame) {
      EXPECT_EQ(frame.is_signed(), is_signed);
      tlog.value().write(0x0102030405060708, frame);
      if (!is_signed) expected.assign(frame.bytes.begin(), frame.bytes.end());
    });
  }
  ASSERT_TRUE(tlog.value().flush().ok());
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::string entry = "\x01\x02\x03\x04\x05\x06\x07\x08";
  for (const std::byte byte : expected) entry += static_cast<char>(byte);
  EXPECT_EQ(text, entry + entry);
  std::filesystem::remove(file);
}

TEST(Tlog, SaysWhereItCannotBeWritten) {
  const auto tlog = TlogWriter::create("/no/such/folder/x.tlog");
  ASSERT_FALSE(tlog.ok());
  EXPECT_EQ(tlog.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace skein::mavlink::tlog_test
