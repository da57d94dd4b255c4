// SPDX-License-Identifier: Apache-2.0
#include "skein/base/valid_text.h"

#include <gtest/gtest.h>

#include <string>

#include "skein/base/random.h"
#include "skein/base/shown_text.h"

namespace skein {
namespace {

using namespace std::string_literals;

TEST(ValidText, LeavesWhatIsTextAsItIs) {
  for (const std::string& text :
       {""s, "uav-1"s, "\tline\r\n\x1b[31m"s, "Zähler über 50 µm"s, "火の鳥"s, "🔥 fire"s,
        "\xF4\x8F\xBF\xBF"s, "\xEF\xBF\xBD"s}) {
    EXPECT_TRUE(is_valid_text(text));
    EXPECT_EQ(valid_text(text), text);
  }
}

TEST(ValidText, ReplacesEachByteThatBeginsNoCharacter) {
  EXPECT_EQ(valid_text("Motor \xff\xfe\xb0 fail"s), "Motor \uFFFD\uFFFD\uFFFD fail");
  EXPECT_EQ(valid_text("\xC0\xAF"s), "\uFFFD\uFFFD");            // overlong
  EXPECT_EQ(valid_text("\xED\xA0\x80"s), "\uFFFD\uFFFD\uFFFD");  // a surrogate
  EXPECT_EQ(valid_text("a\xE2\x82"s), "a\uFFFD\uFFFD");          // cut
  EXPECT_EQ(valid_text("a\0b"s), "a\uFFFDb");                    // NUL
  EXPECT_EQ(valid_text("long ASCII, then \0 and more"s),
            "long ASCII, then \uFFFD and more");
}

TEST(ValidText, IsValidWhateverTheBytesAndChangesNothingTwice) {
  RandomStream random(38, 0, Purpose::kTest);
  for (int run = 0; run < 20000; ++run) {
    std::string bytes(random.bits() % 24, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.bits() % 256);
    const std::string text = valid_text(bytes);
    ASSERT_TRUE(is_valid_text(text));
    ASSERT_EQ(valid_text(text), text);
    ASSERT_EQ(is_valid_text(bytes), text == bytes);
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t length = utf8_length(std::string_view(text).substr(i));
      ASSERT_GT(length, 0U);
      i += length;
    }
  }
}

}  // namespace
}  // namespace skein
