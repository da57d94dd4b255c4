// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/signing_key_file.h"

#include <fcntl.h>
#include <openssl/crypto.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>

namespace skein::mavlink {
namespace {

constexpr std::string_view kPassphrase = "passphrase:";
constexpr std::size_t kMaxLength = 1024;  // of the file

// Closes when it goes.
struct OpenFile {
  int descriptor;
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
};

// What the file holds; wiped when it goes.
struct Secret {
  std::array<char, kMaxLength> bytes{};
  std::size_t length = 0;
  ~Secret() { OPENSSL_cleanse(bytes.data(), bytes.size()); }
  std::string_view text() const { return {bytes.data(), length}; }
};

std::optional<unsigned> digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<unsigned>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<unsigned>(c - 'A' + 10);
  return std::nullopt;
}

std::optional<SigningKey> key_in_digits(std::string_view text) {
  SigningKey key;
  if (text.size() != 2 * key.size()) return std::nullopt;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const auto high = digit(text[2 * i]), low = digit(text[2 * i + 1]);
    if (!high || !low) return std::nullopt;
    key[i] = static_cast<std::byte>(*high << 4 | *low);
  }
  return key;
}

std::string_view without_line_end(std::string_view text) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::optional<SigningKey> key_in(std::string_view text) {
  const std::string_view line = without_line_end(text);
  if (line.starts_with(kPassphrase)) {
    std::string_view phrase = line.substr(kPassphrase.size());
    while (phrase.starts_with(' ')) phrase.remove_prefix(1);
    if (phrase.empty()) return std::nullopt;
    return key_of(phrase);
  }
  if (const auto key = key_in_digits(line)) return key;
  SigningKey key;
  if (text.size() != key.size()) return std::nullopt;
  std::memcpy(key.data(), text.data(), key.size());
  return key;
}

}  // namespace

Result<SigningKey> read_signing_key(const std::filesystem::path& file) {
  const std::string place = file.string();
  // Without waiting: a pipe would block.
  const OpenFile open{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (open.descriptor < 0)
    return Error{errno == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnavailable, place,
                 std::strerror(errno), ""};
  struct stat about {};
  if (::fstat(open.descriptor, &about) != 0)
    return Error{ErrorCode::kUnavailable, place, std::strerror(errno), ""};
  if (!S_ISREG(about.st_mode))
    return Error{ErrorCode::kBadInput, place, "this is no plain file", ""};
  if ((about.st_mode & 077) != 0)
    return Error{ErrorCode::kBadInput, place, "others can read or write this key.",
                 "Take that from them: chmod 600 " + place};
  Secret secret;
  while (secret.length < kMaxLength) {
    const auto got = ::read(open.descriptor, secret.bytes.data() + secret.length,
                            kMaxLength - secret.length);
    if (got < 0) return Error{ErrorCode::kUnavailable, place, std::strerror(errno), ""};
    if (got == 0) break;
    secret.length += static_cast<std::size_t>(got);
  }
  if (secret.length < kMaxLength)
    if (const auto key = key_in(secret.text())) return *key;
  return Error{ErrorCode::kBadInput, place, "there is no key in this file.",
               "A key is 32 bytes, 64 hexadecimal digits, or 'passphrase: some text'."};
}

}  // namespace skein::mavlink
