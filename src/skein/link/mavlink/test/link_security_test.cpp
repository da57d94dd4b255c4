// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/link_security.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/mavlink/signing_key_file.h"

namespace skein::mavlink::link_security_test {
namespace {

constexpr std::int64_t kUnixNow = 1'767'225'600'000'000'000;  // 2026-01-01 [ns]
constexpr LinkSecurity::Channel kLink = 4;

struct Program {
  explicit Program(const char* phrase) : security(key_of(phrase)) {
    security.set_time(kUnixNow);
  }

  template <class T>
  std::vector<std::byte> write(const T& message, LinkSecurity::Channel channel = kLink) {
    const auto frame = security.write(channel, writer, message);
    return {frame.begin(), frame.end()};
  }
  bool admits(const std::vector<std::byte>& bytes,
              LinkSecurity::Channel channel = kLink) {
    bool admitted = false;
    FrameParser().read(
        bytes, [&](const Frame& frame) { admitted = security.admits(channel, frame); });
    return admitted;
  }

  LinkSecurity security;
  FrameWriter writer{7, 1};
};

TEST(LinkSecurity, SignsAndAsksForSignaturesWhereALinkIsSecured) {
  Program ours("right"), theirs("right"), others("wrong");
  for (Program* program : {&ours, &theirs, &others}) program->security.secure(kLink, 3);
  EXPECT_TRUE(ours.admits(theirs.write(Heartbeat())));
  EXPECT_TRUE(theirs.admits(ours.write(Heartbeat())));
  EXPECT_FALSE(ours.admits(others.write(Heartbeat())));
  EXPECT_FALSE(ours.admits(theirs.write(Heartbeat(), kLink + 1))) << "not signed";
  EXPECT_EQ(ours.security.refused(), 2U);
}

TEST(LinkSecurity, LeavesOtherLinksAlone) {
  Program ours("right"), plain("wrong");
  ours.security.secure(kLink, 3);
  EXPECT_TRUE(ours.admits(plain.write(Heartbeat()), kLink + 1));
  ours.security.close(kLink);
  EXPECT_TRUE(ours.admits(plain.write(Heartbeat())));
  LinkSecurity none;
  FrameWriter writer(1, 1);
  FrameParser().read(none.write(kLink, writer, Heartbeat()),
                     [](const Frame& frame) { EXPECT_FALSE(frame.is_signed()); });
}

TEST(LinkSecurity, LetsReportsOfRadiosThrough) {
  Program ours("right"), radio("wrong");
  ours.security.secure(kLink, 3);
  EXPECT_TRUE(ours.admits(radio.write(RadioStatus())));
  EXPECT_TRUE(ours.admits(radio.write(Radio())));
  EXPECT_FALSE(ours.admits(radio.write(CommandLong())));
}

TEST(LinkSecurity, RefusesWhatWasRecordedOnAnotherLink) {
  Program ours("right"), theirs("right");
  for (const LinkSecurity::Channel channel : {kLink, kLink + 1})
    ours.security.secure(channel, static_cast<std::uint8_t>(channel));
  theirs.security.secure(kLink, 3);
  const auto frame = theirs.write(CommandLong());
  EXPECT_TRUE(ours.admits(frame));
  EXPECT_FALSE(ours.admits(frame, kLink + 1));
}

TEST(LinkSecurity, TimeStampsRiseOverAllLinksAndRuns) {
  Program ours("right");
  ours.security.secure(1, 1);
  ours.security.secure(2, 2);
  std::uint64_t last = 0;
  for (int k = 0; k < 20; ++k) {
    ours.write(Heartbeat(), 1 + static_cast<LinkSecurity::Channel>(k) % 2);
    EXPECT_GT(ours.security.last(), last);
    last = ours.security.last();
  }
  // The clock went back before the next run.
  LinkSecurity again(key_of("right"), last);
  again.set_time(kUnixNow - 1'000'000'000'000);
  again.secure(1, 1);
  FrameWriter writer(7, 1);
  again.write(1, writer, Heartbeat());
  EXPECT_GT(again.last(), last);
}

TEST(LinkSecurity, FollowsASenderWhoseClockIsAhead) {
  Program ours("right"), ahead("right");
  ahead.security.set_time(kUnixNow + 3'600'000'000'000);
  ours.security.secure(kLink, 3);
  ahead.security.secure(kLink, 3);
  EXPECT_TRUE(ours.admits(ahead.write(Heartbeat())));
  EXPECT_TRUE(ahead.admits(ours.write(Heartbeat())));
}

class KeyFile : public testing::Test {
 protected:
  KeyFile() { std::filesystem::create_directories(folder_); }
  ~KeyFile() override { std::filesystem::remove_all(folder_); }

  Result<SigningKey> read(const std::string& content, mode_t mode = 0600) {
    const auto file = folder_ / "key";
    std::filesystem::remove(file);
    std::ofstream(file, std::ios::binary) << content;
    EXPECT_EQ(::chmod(file.c_str(), mode), 0);
    return read_signing_key(file);
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("skein_key_" + std::to_string(::getpid()) + "_" +
       testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(KeyFile, HoldsBytesDigitsOrAPassphrase) {
  std::string raw, digits;
  SigningKey key;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const auto byte = static_cast<unsigned>(i * 37 + 10) & 0xffU;
    key[i] = std::byte(byte);
    raw += static_cast<char>(byte);
    digits += "0123456789aBcDeF"[byte >> 4];
    digits += "0123456789AbCdEf"[byte & 15];
  }
  EXPECT_EQ(read(raw).value(), key);
  EXPECT_EQ(read(digits).value(), key);
  EXPECT_EQ(read(digits + "\n").value(), key);
  EXPECT_EQ(read("passphrase: our secret\n").value(), key_of("our secret"));
  EXPECT_EQ(read("passphrase:our secret").value(), key_of("our secret"));
  // As long as a key of bytes, and yet a phrase.
  EXPECT_EQ(read("passphrase: twenty letters here.").value(),
            key_of("twenty letters here."));
}

TEST_F(KeyFile, IsRefusedWhenOthersCanReadIt) {
  const std::string phrase = "passphrase: our secret\n";
  for (const mode_t mode : {0640, 0604, 0660, 0610, 0601}) {
    const auto key = read(phrase, mode);
    ASSERT_FALSE(key.ok()) << std::oct << mode;
    EXPECT_EQ(key.error().code, ErrorCode::kBadInput);
    EXPECT_EQ(key.error().text().find("our secret"), std::string::npos);
  }
  EXPECT_TRUE(read(phrase, 0400).ok());
}

TEST_F(KeyFile, IsRefusedWhenItHoldsNoKey) {
  for (const std::string& content :
       {std::string(), std::string(31, 'x'), std::string(33, 'x'), std::string(64, 'x'),
        std::string(63, '0'), std::string("passphrase: "), std::string(5000, '0')}) {
    const auto key = read(content);
    ASSERT_FALSE(key.ok()) << content.size();
    EXPECT_EQ(key.error().code, ErrorCode::kBadInput);
  }
  EXPECT_EQ(read_signing_key(folder_ / "none").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_signing_key(folder_).error().code, ErrorCode::kBadInput);
}

// Over a link without a key: who does not sign may report and ask.
TEST(LinkSecurity, UnsignedFramesMayBeLimitedToTelemetry) {
  using Admission = LinkSecurity::Admission;
  Program plain("none");
  LinkSecurity open;
  open.allow_unsigned(kLink, UnsignedFrames::kTelemetry);
  const auto judge = [&](const auto& message) {
    Admission verdict{};
    FrameParser parser;
    const auto bytes = plain.write(message);
    parser.read(bytes, [&](const Frame& frame) { verdict = open.judge(kLink, frame); });
    return verdict;
  };
  CommandLong question;
  question.command = static_cast<std::uint16_t>(CommandId::kRequestMessage);
  CommandLong arm;
  arm.command = static_cast<std::uint16_t>(CommandId::kArm);
  CommandInt reposition;
  reposition.command = static_cast<std::uint16_t>(CommandId::kReposition);
  EXPECT_EQ(judge(Heartbeat()), Admission::kTaken);
  EXPECT_EQ(judge(GlobalPositionInt()), Admission::kTaken);
  EXPECT_EQ(judge(ParamRequestList()), Admission::kTaken);
  EXPECT_EQ(judge(MissionRequestList()), Admission::kTaken);
  EXPECT_EQ(judge(question), Admission::kTaken);
  EXPECT_EQ(judge(arm), Admission::kOrderRefused);
  EXPECT_EQ(judge(reposition), Admission::kOrderRefused);
  EXPECT_EQ(judge(ParamSet()), Admission::kOrderRefused);
  EXPECT_EQ(judge(SetMode()), Admission::kOrderRefused);
  EXPECT_EQ(judge(MissionCount()), Admission::kOrderRefused);
  EXPECT_EQ(judge(MissionClearAll()), Admission::kOrderRefused);
  EXPECT_EQ(judge(MissionSetCurrent()), Admission::kOrderRefused);
  EXPECT_EQ(judge(RcChannelsOverride()), Admission::kOrderRefused);
  EXPECT_EQ(judge(ManualControl()), Admission::kOrderRefused);
  EXPECT_EQ(judge(SetPositionTargetGlobalInt()), Admission::kOrderRefused);
  EXPECT_EQ(judge(SetAttitudeTarget()), Admission::kOrderRefused);
  EXPECT_EQ(judge(FileTransferProtocol()), Admission::kOrderRefused);
  EXPECT_EQ(judge(HilGps()), Admission::kOrderRefused);
  EXPECT_EQ(open.refused(), 13U);
  open.close(kLink);
  EXPECT_EQ(judge(arm), Admission::kTaken) << "the next link is as by default";
}

TEST(LinkSecurity, AKeyedLinkMayReadUnsignedTelemetry) {
  Program ours("a"), plain("none");
  ours.security.secure(kLink, 3);
  EXPECT_FALSE(ours.admits(plain.write(Heartbeat())));
  ours.security.allow_unsigned(kLink, UnsignedFrames::kTelemetry);
  EXPECT_TRUE(ours.admits(plain.write(Heartbeat())));
  EXPECT_FALSE(ours.admits(plain.write(ParamSet())));
  Program theirs("a");
  theirs.security.secure(kLink, 3);
  EXPECT_TRUE(ours.admits(theirs.write(ParamSet()))) << "signed ones may";
}

}  // namespace
}  // namespace skein::mavlink::link_security_test
