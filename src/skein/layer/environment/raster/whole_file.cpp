// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/whole_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

namespace skein::environment {
namespace {

// Largest count of anything in a header: beyond it, and in products of sizes, the header
// is taken for damaged.
constexpr std::uint64_t kMax = 1ULL << 60;

// Big-endian numbers one after the other. After a failure all reads give 0.
class Bytes {
 public:
  explicit Bytes(const std::string& path) : in_(path, std::ios::binary) {}

  bool good() const { return in_.good(); }
  void seek(std::uint64_t at) { in_.seekg(static_cast<std::streamoff>(at)); }
  void skip(std::uint64_t count) {
    if (count > kMax) return in_.setstate(std::ios::failbit);
    in_.seekg(static_cast<std::streamoff>(count), std::ios::cur);
  }
  std::uint64_t number(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int byte = in_.get();
      if (byte < 0) return 0;
      value = value << 8 | static_cast<std::uint64_t>(byte);
    }
    return value;
  }

 private:
  std::ifstream in_;
};

std::uint64_t padded(std::uint64_t size) {
  return (size + 3) / 4 * 4;
}

// Bytes of a value of a NetCDF type; 0 for an unknown one.
std::uint64_t size_of_type(std::uint64_t type) {
  constexpr std::array<std::uint64_t, 12> kSizes = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return type < kSizes.size() ? kSizes[type] : 0;
}

struct Variable {
  std::uint64_t begin = 0;
  std::uint64_t size = 0;  // of all of it, or of one record
  bool record = false;
};

// The header of a classic NetCDF file.
class NetcdfHeader {
 public:
  NetcdfHeader(Bytes& bytes, int version)
      : bytes_(bytes), count_(version == 5 ? 8 : 4), offset_(version == 1 ? 4 : 8) {}

  // The minimum length of a valid file; none when the header makes no sense.
  std::optional<std::uint64_t> min_length() {
    const std::uint64_t records = bytes_.number(count_);
    const bool streaming =
        records == (count_ == 4 ? 0xFFFFFFFFULL : 0xFFFFFFFFFFFFFFFFULL);
    read_list([&] {
      name();
      dimensions_.push_back(bytes_.number(count_));
    });
    attributes();
    read_list([&] { variable(); });
    if (!bytes_.good() || !sound_) return std::nullopt;
    return end_of_data(streaming ? 0 : records);
  }

 private:
  template <class Read>
  void read_list(const Read& read) {
    bytes_.number(4);  // what kind of list; 0 when it is empty
    const std::uint64_t count = bytes_.number(count_);
    for (std::uint64_t i = 0; i < count && bytes_.good() && sound_; ++i) read();
  }
  void name() { bytes_.skip(padded(bytes_.number(count_))); }
  void attributes() {
    read_list([&] {
      name();
      const std::uint64_t size = size_of_type(bytes_.number(4));
      const std::uint64_t count = bytes_.number(count_);
      sound_ = sound_ && size > 0 && count < kMax / 8;
      if (sound_) bytes_.skip(padded(size * count));
    });
  }
  void variable() {
    name();
    Variable variable;
    variable.size = 1;
    const std::uint64_t rank = bytes_.number(count_);
    for (std::uint64_t i = 0; i < rank && bytes_.good(); ++i) {
      const std::uint64_t index = bytes_.number(count_);
      sound_ = sound_ && index < dimensions_.size();
      if (!sound_) return;
      const std::uint64_t length = dimensions_[index];
      if (length == 0)  // the unlimited dimension, always the first one
        variable.record = true;
      else
        variable.size = product(variable.size, length);
    }
    attributes();
    const std::uint64_t type = size_of_type(bytes_.number(4));
    sound_ = sound_ && type > 0;
    variable.size = product(variable.size, type);
    bytes_.number(count_);  // the size again, which is wrong for large variables
    variable.begin = bytes_.number(offset_);
    sound_ = sound_ && variable.begin < kMax;
    variables_.push_back(variable);
  }
  std::uint64_t product(std::uint64_t a, std::uint64_t b) {
    if (a != 0 && b > kMax / a) sound_ = false;
    return sound_ ? a * b : 0;
  }
  std::optional<std::uint64_t> end_of_data(std::uint64_t records) {
    // Records of several variables are padded, those of a single one are not.
    std::uint64_t record_size = 0, record_variables = 0;
    for (const Variable& v : variables_)
      if (v.record) {
        record_size = std::min(kMax, record_size + padded(v.size));
        ++record_variables;
      }
    std::uint64_t end = 0;
    for (const Variable& v : variables_) {
      if (v.record && records == 0) continue;
      const std::uint64_t stride = record_variables == 1 ? v.size : record_size;
      const std::uint64_t before = v.record ? product(stride, records - 1) : 0;
      end = std::max(end, v.begin + before + v.size);
    }
    if (!sound_) return std::nullopt;
    return end;
  }

  Bytes& bytes_;
  int count_, offset_;  // bytes of a count and of an offset
  bool sound_ = true;
  std::vector<std::uint64_t> dimensions_;
  std::vector<Variable> variables_;
};

Error cut_short(const std::string& path, std::uint64_t length, std::uint64_t requested) {
  return {ErrorCode::kBadInput, path,
          fmt::format("is truncated: {} bytes long, and its header asks for {}", length,
                      requested),
          "copy or download it again"};
}

Result<void> check_netcdf(const std::string& path, int version, std::uint64_t length) {
  Bytes bytes(path);
  bytes.seek(4);
  const auto requested = NetcdfHeader(bytes, version).min_length();
  if (!requested)
    return Error{ErrorCode::kBadInput, path,
                 "is truncated or damaged: its NetCDF header makes no sense",
                 "copy or download it again"};
  if (*requested > length) return cut_short(path, length, *requested);
  return {};
}

// Messages follow each other, each with its length in front; anything may stand between
// them, as headers of bulletins do.
Result<void> check_grib(const std::string& path, std::uint64_t length) {
  constexpr std::uint64_t kGrib = 0x47524942;  // "GRIB"
  constexpr std::uint64_t kLarge = 0x800000;   // a first-edition length of another form
  Bytes bytes(path);
  std::uint64_t at = 0;
  while (at + 16 <= length) {
    bytes.seek(at);
    std::uint64_t word = bytes.number(4);
    for (at += 4; word != kGrib && at < length; ++at)
      word = (word << 8 | bytes.number(1)) & 0xFFFFFFFF;
    if (word != kGrib) return {};
    at -= 4;
    const std::uint64_t first_length = bytes.number(3);
    const std::uint64_t edition = bytes.number(1);
    const std::uint64_t size = edition == 1 ? first_length : bytes.number(8);
    if (edition == 1 && first_length >= kLarge) return {};
    if (size > length - at) return cut_short(path, length, at + size);
    at += std::max<std::uint64_t>(size, 4);
  }
  return {};
}

}  // namespace

Result<void> check_whole(const std::string& path, std::string_view driver,
                         std::uint64_t pixel_bytes) {
  std::error_code failed;
  const std::uintmax_t length = std::filesystem::file_size(path, failed);
  if (failed) return Error{ErrorCode::kBadInput, path, "cannot be read", ""};
  if (driver == "GRIB") return check_grib(path, length);
  if (driver != "netCDF" && driver != "ENVI") return {};
  std::array<char, 4> magic{};
  std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
  if (driver == "ENVI") {
    const bool gzip = magic[0] == '\x1F' && magic[1] == '\x8B';  // has a check of its own
    if (!gzip && length < pixel_bytes) return cut_short(path, length, pixel_bytes);
    return {};
  }
  const bool classic = std::memcmp(magic.data(), "CDF", 3) == 0 &&
                       (magic[3] == 1 || magic[3] == 2 || magic[3] == 5);
  return classic ? check_netcdf(path, magic[3], length) : Result<void>();
}

}  // namespace skein::environment
