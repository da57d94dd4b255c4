// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/raster_service.h"

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "skein/geo/gdal/gdal_guard.h"
#include "skein/layer/environment/raster/raster_source.h"

namespace skein::environment {
namespace {

constexpr std::size_t kTextsOfBand = 3, kNumbersOfBand = 3;
constexpr std::size_t kNumbersOfRaster = 8;

// Answers that are errors have these four texts and no numbers; others begin with "".
ServiceMessage to_message(const Error& error) {
  return {{error.code == ErrorCode::kNotFound ? "not found" : "bad input", error.place,
           error.message, error.hint},
          {}};
}

std::optional<Error> error_in(const ServiceMessage& message) {
  if (message.texts.size() != 4 || message.texts[0].empty()) return std::nullopt;
  return Error{
      message.texts[0] == "not found" ? ErrorCode::kNotFound : ErrorCode::kBadInput,
      message.texts[1], message.texts[2], message.texts[3]};
}

ServiceMessage to_message(const RasterFacts& facts) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  ServiceMessage message{
      {"", facts.system},
      {static_cast<double>(facts.columns), static_cast<double>(facts.rows)}};
  message.numbers.insert(message.numbers.end(), facts.geo.begin(), facts.geo.end());
  for (const BandInfo& band : facts.bands) {
    message.texts.insert(message.texts.end(), {band.name, band.standard_name, band.unit});
    message.numbers.insert(message.numbers.end(),
                           {static_cast<double>(band.number), band.utc_s.value_or(kNone),
                            band.height_m.value_or(kNone)});
  }
  return message;
}

std::optional<double> unless_nan(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

// Nothing when the message is none of to_message().
std::optional<RasterFacts> facts_in(const ServiceMessage& message) {
  const auto& texts = message.texts;
  const auto& numbers = message.numbers;
  if (texts.size() < 2 || numbers.size() < kNumbersOfRaster) return std::nullopt;
  const std::size_t bands = (texts.size() - 2) / kTextsOfBand;
  if (texts.size() != 2 + kTextsOfBand * bands ||
      numbers.size() != kNumbersOfRaster + kNumbersOfBand * bands)
    return std::nullopt;
  RasterFacts facts;
  facts.system = texts[1];
  facts.columns = static_cast<int>(numbers[0]);
  facts.rows = static_cast<int>(numbers[1]);
  for (std::size_t i = 0; i < facts.geo.size(); ++i) facts.geo[i] = numbers[2 + i];
  for (std::size_t b = 0; b < bands; ++b) {
    const std::string* text = &texts[2 + kTextsOfBand * b];
    const double* number = &numbers[kNumbersOfRaster + kNumbersOfBand * b];
    facts.bands.push_back({static_cast<int>(number[0]), text[0], text[1], text[2],
                           unless_nan(number[1]), unless_nan(number[2])});
  }
  return facts;
}

// Runs in the other process. The first request opens the file; each other one has a band
// and a window of it.
class RasterReader {
 public:
  ServiceMessage answer(const ServiceMessage& request) {
    if (!source_) {
      auto opened = RasterSource::open(request.texts.at(0), request.texts.at(1));
      if (!opened) return to_message(opened.error());
      source_.emplace(std::move(opened).value());
      return to_message(source_->facts());
    }
    const auto number = [&](std::size_t i) {
      return static_cast<int>(request.numbers.at(i));
    };
    PixelWindow window;
    window.first_column = number(1);
    window.first_row = number(2);
    window.columns = number(3);
    window.rows = number(4);
    auto pixels = source_->read(number(0), window);
    if (!pixels) return to_message(pixels.error());
    return {{""}, std::move(pixels.value().values)};
  }

 private:
  std::optional<RasterSource> source_;
};

}  // namespace

Result<RasterService> RasterService::start(const std::string& path,
                                           const std::string& variable) {
  auto process = geo::start_gdal_service(
      [reader = std::make_shared<RasterReader>()](const ServiceMessage& request) {
        return reader->answer(request);
      });
  if (!process) {
    Error error = process.error();
    error.place = path;
    return error;
  }
  RasterService service(path, std::move(process).value());
  const auto answer = service.ask({{path, variable}, {}});
  if (!answer) return answer.error();
  auto facts = facts_in(answer.value());
  if (!facts) return Error{ErrorCode::kBadInput, path, "cannot be read as a raster", ""};
  service.facts_ = *std::move(facts);
  return service;
}

Result<ServiceMessage> RasterService::ask(const ServiceMessage& request) {
  auto answer = process_.ask(request);
  if (!answer) {
    Error error = answer.error();
    error.place = path_;
    error.message = "cannot be read; the file is truncated or corrupt: " + error.message;
    error.hint = "copy or download it again";
    return error;
  }
  if (auto error = error_in(answer.value())) return *std::move(error);
  return answer;
}

Result<PixelWindow> RasterService::read(int band, const PixelWindow& window) {
  auto answer =
      ask({{},
           {static_cast<double>(band), static_cast<double>(window.first_column),
            static_cast<double>(window.first_row), static_cast<double>(window.columns),
            static_cast<double>(window.rows)}});
  if (!answer) return answer.error();
  PixelWindow pixels = window;
  pixels.values = std::move(answer.value().numbers);
  const auto requested =
      static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.rows);
  if (pixels.values.size() != requested)
    return Error{ErrorCode::kBadInput, path_, "cannot be read; the file is corrupt", ""};
  return pixels;
}

}  // namespace skein::environment
