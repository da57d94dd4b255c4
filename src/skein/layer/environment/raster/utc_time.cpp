#include "skein/layer/environment/raster/utc_time.h"

#include <charconv>
#include <chrono>

namespace skein::environment {
namespace {

// Reads from the front of `text` and remembers whether all went well.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  int digits(std::size_t count) {
    int value = 0;
    if (text_.size() < count) return fail();
    for (std::size_t i = 0; i < count; ++i) {
      if (text_[i] < '0' || text_[i] > '9') return fail();
      value = 10 * value + (text_[i] - '0');
    }
    text_.remove_prefix(count);
    return value;
  }
  bool skip(char c) {
    if (text_.empty() || text_[0] != c) return false;
    text_.remove_prefix(1);
    return true;
  }
  void need(char c) {
    if (!skip(c)) fail();
  }
  double fraction() {
    double value = 0, place = 0.1;
    while (!text_.empty() && text_[0] >= '0' && text_[0] <= '9') {
      value += place * (text_[0] - '0');
      place /= 10;
      text_.remove_prefix(1);
    }
    return value;
  }
  bool at_end() const { return text_.empty(); }
  bool good() const { return good_; }

 private:
  int fail() {
    good_ = false;
    return 0;
  }
  std::string_view text_;
  bool good_ = true;
};

// Offset of the zone [s]; east of Greenwich positive.
int read_zone(Reader& reader) {
  if (reader.at_end() || reader.skip('Z')) return 0;
  const bool west = reader.skip('-');
  if (!west) reader.need('+');
  const int hours = reader.digits(2);
  int minutes = 0;
  if (!reader.at_end()) {
    reader.skip(':');
    minutes = reader.digits(2);
  }
  return (west ? -60 : 60) * (60 * hours + minutes);
}

}  // namespace

std::optional<double> parse_utc(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  Reader reader(text);
  const int year = reader.digits(4);
  reader.need('-');
  const int month = reader.digits(2);
  reader.need('-');
  const int day = reader.digits(2);
  double seconds = 0;
  int zone = 0;
  if (reader.good() && !reader.at_end()) {
    if (!reader.skip('T')) reader.need(' ');
    const int hour = reader.digits(2);
    reader.need(':');
    const int minute = reader.digits(2);
    double second = 0;
    if (reader.skip(':')) {
      second = reader.digits(2);
      if (reader.skip('.')) second += reader.fraction();
    }
    zone = read_zone(reader);
    if (hour > 24 || minute > 59 || second >= 61) return std::nullopt;
    seconds = 3600 * hour + 60 * minute + second;
  }
  if (!reader.good() || !reader.at_end()) return std::nullopt;
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return 86400.0 * static_cast<double>(days) + seconds - zone;
}

}  // namespace skein::environment
