// SPDX-License-Identifier: Apache-2.0
// Frames that another implementation has made, read and written: ../shared/data/mavlink.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace skein::mavlink::reference_frames_test {
namespace {

using Json = nlohmann::json;

std::filesystem::path data(const char* name) {
  return std::filesystem::path(SKEIN_SHARED_DATA) / "mavlink" / name;
}

std::vector<std::byte> from_hex(const std::string& text) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

std::string to_hex(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    text += kDigits[static_cast<unsigned>(byte) >> 4];
    text += kDigits[static_cast<unsigned>(byte) & 15];
  }
  return text;
}

template <class T>
void set(T& value, const Json& from) {
  if constexpr (type_traits::kIsArray<T>) {
    if constexpr (std::is_same_v<typename T::value_type, char>)
      set_text(value, from.get<std::string>());
    else
      for (std::size_t i = 0; i < value.size(); ++i) set(value[i], from.at(i));
  } else if (from.is_string()) {  // a 64-bit integer
    if constexpr (std::is_signed_v<T>)
      value = static_cast<T>(std::stoll(from.get<std::string>()));
    else
      value = static_cast<T>(std::stoull(from.get<std::string>()));
  } else {
    value = from.get<T>();
  }
}

// What a test knows of a reference frame.
struct Reference {
  const Json& json;
  std::uint8_t number(const char* key) const { return json.at(key).get<std::uint8_t>(); }
};

FrameWriter writer_of(const Reference& reference, int version) {
  FrameWriter writer(reference.number("sysid"), reference.number("compid"), version);
  for (int k = reference.number("seq"); k > 0; --k) writer.write(Heartbeat());
  return writer;
}

Frame only_frame(FrameParser& parser, std::span<const std::byte> bytes,
                 std::vector<std::byte>& held) {
  Frame found;
  parser.read(bytes, [&](const Frame& frame) {
    held.assign(frame.bytes.begin(), frame.bytes.end());
    found = {held, frame.message};
  });
  return found;
}

template <class T>
void check_read(const Reference& reference, const char* form, const T& message) {
  const std::vector<std::byte> bytes =
      from_hex(reference.json.at(form).get<std::string>());
  FrameParser parser;
  std::vector<std::byte> held;
  const Frame frame = only_frame(parser, bytes, held);
  ASSERT_EQ(parser.counts().frames, 1U) << form;
  EXPECT_EQ(parser.counts().skipped_bytes, 0U);
  EXPECT_EQ(frame.system(), reference.number("sysid"));
  EXPECT_EQ(frame.component(), reference.number("compid"));
  EXPECT_EQ(frame.sequence(), reference.number("seq"));
  EXPECT_EQ(frame.is_signed(), std::string(form) == "v2_signed");
  EXPECT_EQ(pack(unpack<T>(frame.payload())), pack(message)) << form;
}

template <class T>
void check(const Reference& reference) {
  T message;
  for_each_field<T>([&](const auto& field) {
    set(message.*field.member, reference.json.at("fields").at(std::string(field.name)));
  });
  check_read(reference, "v2", message);
  EXPECT_EQ(to_hex(writer_of(reference, 2).write(message)),
            reference.json.at("v2").get<std::string>());
  if (reference.json.contains("v1")) {
    check_read(reference, "v1", message);
    // The reference sends extensions by version 1 too, against the definition.
    if constexpr (kBaseLength<T> == kLength<T>) {
      EXPECT_EQ(to_hex(writer_of(reference, 1).write(message)),
                reference.json.at("v1").get<std::string>());
    }
  }
  if (reference.json.contains("v2_signed")) check_read(reference, "v2_signed", message);
}

template <class... Ts>
bool check_any(const Reference& reference, const std::tuple<Ts...>*) {
  const auto id = reference.json.at("id").get<std::uint32_t>();
  return ((kFacts<Ts>.id == id && (check<Ts>(reference), true)) || ...);
}

class ReferenceFrames : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(data("vectors.json")))
      GTEST_SKIP() << "without ../shared/data/mavlink";
    vectors_ = Json::parse(std::ifstream(data("vectors.json")));
    messages_ = Json::parse(std::ifstream(data("messages.json")));
  }

  Json vectors_, messages_;
};

TEST_F(ReferenceFrames, AreReadAndWritten) {
  int checked = 0;
  for (const Json& vector : vectors_.at("vectors")) {
    SCOPED_TRACE(vector.at("name").get<std::string>() + ' ' +
                 vector.at("variant").get<std::string>());
    EXPECT_TRUE(check_any({vector}, static_cast<const AllMessages*>(nullptr)));
    ++checked;
  }
  EXPECT_GE(checked, 281);
}

TEST_F(ReferenceFrames, AreSignedTheSame) {
  const Json& signing = vectors_.at("signing");
  SigningKey key;
  const auto bytes = from_hex(signing.at("passphrase_sha256_key_hex"));
  std::ranges::copy(bytes, key.begin());
  EXPECT_EQ(key, key_of("test-passphrase"));
  int checked = 0;
  for (const Json& vector : vectors_.at("vectors")) {
    if (!vector.contains("v2_signed")) continue;
    SCOPED_TRACE(vector.at("name").get<std::string>());
    const auto whole = from_hex(vector.at("v2_signed"));
    FrameParser parser;
    std::vector<std::byte> held;
    const Frame frame = only_frame(parser, whole, held);
    const std::uint64_t stamp = signing_time(frame);
    EXPECT_GE(stamp, signing.at("first_timestamp").get<std::uint64_t>());
    SignatureChecker checker(key);
    EXPECT_EQ(checker.check(frame, stamp), SignatureVerdict::kValid);
    EXPECT_EQ(checker.check(frame, stamp), SignatureVerdict::kRepeated);
    // The same signature, made here.
    Signer signer(key, signing.at("link_id").get<std::uint8_t>(), 0);
    const auto signature =
        signer.sign(frame.bytes.first(frame.bytes.size() - kSignatureLength), stamp);
    EXPECT_EQ(to_hex(signature), to_hex(frame.bytes.last(kSignatureLength)));
    ++checked;
  }
  EXPECT_GE(checked, 94);
}

TEST_F(ReferenceFrames, HaveTheLengthsAndTargetsOfTheDefinitions) {
  ASSERT_EQ(messages_.at("messages").size(), all_messages().size());
  for (const Json& message : messages_.at("messages")) {
    SCOPED_TRACE(message.at("name").get<std::string>());
    const MessageEntry* entry = find_message(message.at("id").get<std::uint32_t>());
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->name, message.at("name").get<std::string>());
    EXPECT_EQ(entry->crc_extra, message.at("crc_extra").get<int>());
    EXPECT_EQ(entry->base_length, message.at("len_min").get<int>());
    EXPECT_EQ(entry->length, message.at("len_max").get<int>());
    const auto offset = [&](const char* key) {
      return message.contains(key) && message.at(key).is_number()
                 ? message.at(key).get<std::uint8_t>()
                 : MessageEntry::kNowhere;
    };
    EXPECT_EQ(entry->target_system, offset("target_system_offset"));
    EXPECT_EQ(entry->target_component, offset("target_component_offset"));
  }
}

}  // namespace
}  // namespace skein::mavlink::reference_frames_test
