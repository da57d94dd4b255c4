// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/parameter_service.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "skein/base/check.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/payload.h"

namespace skein::vehicle_services {
namespace {

constexpr std::size_t kMaxListings = 16;
const Time kBetween = Time::from_seconds(0.004);  // parameters of a list
// No more than 25 at once, however late it is.
const Time kMaxBehind = Time::from_seconds(0.1);
// An answer to a read by name or a change is no part of a list.
constexpr std::uint16_t kNoIndex = 65'535;

bool is_integer(ParameterType type) {
  return type != ParameterType::kReal32;
}

struct Range {
  double low, high;
};
template <class Number>
constexpr Range range_of() {
  return {static_cast<double>(std::numeric_limits<Number>::min()),
          static_cast<double>(std::numeric_limits<Number>::max())};
}
Range range(ParameterType type) {
  switch (type) {
    case ParameterType::kUint8:
      return range_of<std::uint8_t>();
    case ParameterType::kInt8:
      return range_of<std::int8_t>();
    case ParameterType::kUint16:
      return range_of<std::uint16_t>();
    case ParameterType::kInt16:
      return range_of<std::int16_t>();
    case ParameterType::kUint32:
      return range_of<std::uint32_t>();
    case ParameterType::kInt32:
      return range_of<std::int32_t>();
    case ParameterType::kReal32:
      break;
  }
  return {-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
}

// What the parameter becomes when it shall have this value.
double allowed(const Parameter& parameter, double value) {
  const Range of_type = range(parameter.type);
  if (is_integer(parameter.type)) value = std::round(value);
  return std::clamp(value, std::max(parameter.lowest, of_type.low),
                    std::min(parameter.highest, of_type.high));
}

}  // namespace

float coded_parameter(double value, ParameterType type, ParameterEncoding encoding) {
  if (!is_integer(type) || encoding == ParameterEncoding::kCast)
    return static_cast<float>(value);
  // Two's complement: narrow ones fill the low bytes, the rest is 0.
  const auto whole = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  const Range of_type = range(type);
  const bool byte = of_type.high - of_type.low < 256;
  const bool word = of_type.high - of_type.low < 65'536;
  return std::bit_cast<float>(byte ? whole & 0xffU : word ? whole & 0xffffU : whole);
}

double decoded_parameter(float coded, ParameterType type, ParameterEncoding encoding) {
  if (!is_integer(type) || encoding == ParameterEncoding::kCast)
    return static_cast<double>(coded);
  const auto bytes = std::bit_cast<std::uint32_t>(coded);
  switch (type) {
    case ParameterType::kUint8:
      return static_cast<std::uint8_t>(bytes);
    case ParameterType::kInt8:
      return static_cast<std::int8_t>(bytes);
    case ParameterType::kUint16:
      return static_cast<std::uint16_t>(bytes);
    case ParameterType::kInt16:
      return static_cast<std::int16_t>(bytes);
    case ParameterType::kInt32:
      return static_cast<std::int32_t>(bytes);
    default:
      return bytes;
  }
}

ParameterService::ParameterService(std::vector<Parameter> parameters,
                                   ParameterEncoding encoding, Changed changed)
    : parameters_(std::move(parameters)),
      encoding_(encoding),
      changed_(std::move(changed)) {
  SKEIN_CHECK(!parameters_.empty() && parameters_.size() < kNoIndex);
  for (const Parameter& parameter : parameters_)
    SKEIN_CHECK(!parameter.name.empty() && parameter.name.size() <= 16, parameter.name);
}

mavlink::ParamValue ParameterService::message_of(std::size_t index) const {
  const Parameter& parameter = parameters_[index];
  mavlink::ParamValue message;
  mavlink::set_text(message.param_id, parameter.name);
  message.param_value = coded_parameter(parameter.value, parameter.type, encoding_);
  message.param_type = static_cast<std::uint8_t>(parameter.type);
  message.param_count = static_cast<std::uint16_t>(parameters_.size());
  message.param_index = static_cast<std::uint16_t>(index);
  return message;
}

std::optional<std::size_t> ParameterService::index_of(std::string_view name) const {
  const auto found = std::ranges::find(parameters_, name, &Parameter::name);
  if (found == parameters_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - parameters_.begin());
}

const Parameter* ParameterService::find(std::string_view name) const {
  const auto index = index_of(name);
  return index ? &parameters_[*index] : nullptr;
}

void ParameterService::handle(const mavlink::ParamRequestList&, const Peer& from,
                              Time now) {
  const auto known = std::ranges::find(listings_, from, &Listing::to);
  if (known != listings_.end()) return;  // it is under way
  if (listings_.size() < kMaxListings) listings_.push_back({from, 0, now});
}

void ParameterService::handle(const mavlink::ParamRequestRead& request, const Peer& from,
                              Outbox& out) {
  if (request.param_index >= 0) {
    const auto index = static_cast<std::size_t>(request.param_index);
    if (index < parameters_.size()) out.send(from.channel, message_of(index));
    return;
  }
  if (const auto index = index_of(mavlink::text_of(request.param_id))) {
    out.send(from.channel, message_of(*index));
    return;
  }
  mavlink::ParamError error;
  error.target_system = from.system;
  error.target_component = from.component;
  error.param_id = request.param_id;
  error.param_index = request.param_index;
  error.error = static_cast<std::uint8_t>(mavlink::ParamErrorCode::kDoesNotExist);
  out.send(from.channel, error);
}

void ParameterService::change(Parameter& parameter, double value) {
  value = allowed(parameter, value);
  if (value == parameter.value) return;
  parameter.value = value;
  changed_(parameter);
}

bool ParameterService::set(std::string_view name, double value) {
  const auto index = index_of(name);
  if (!index || parameters_[*index].read_only) return false;
  change(parameters_[*index], value);
  return true;
}

void ParameterService::handle(const mavlink::ParamSet& request, const Peer& from,
                              Outbox& out) {
  const auto index = index_of(mavlink::text_of(request.param_id));
  const auto refuse = [&](mavlink::ParamErrorCode why) {
    mavlink::ParamError error;
    error.target_system = from.system;
    error.target_component = from.component;
    error.param_id = request.param_id;
    error.param_index = index ? static_cast<std::int16_t>(*index) : std::int16_t{-1};
    error.error = static_cast<std::uint8_t>(why);
    out.send(from.channel, error);
  };
  if (!index) return refuse(mavlink::ParamErrorCode::kDoesNotExist);
  Parameter& parameter = parameters_[*index];
  const double value = decoded_parameter(request.param_value, parameter.type, encoding_);
  if (parameter.read_only) {
    refuse(mavlink::ParamErrorCode::kReadOnly);
  } else if (!std::isfinite(value)) {
    refuse(mavlink::ParamErrorCode::kOutOfRange);
  } else {
    change(parameter, value);
  }
  // What it is now, whether it was changed or not.
  mavlink::ParamValue answer = message_of(*index);
  answer.param_index = kNoIndex;
  out.send(from.channel, answer);
}

void ParameterService::step(Time now, Outbox& out) {
  for (Listing& listing : listings_) {
    listing.due = std::max(listing.due, now - kMaxBehind);
    while (listing.next < parameters_.size() && listing.due <= now) {
      out.send(listing.to.channel, message_of(listing.next++));
      listing.due = listing.due + kBetween;
    }
  }
  std::erase_if(listings_,
                [&](const Listing& l) { return l.next >= parameters_.size(); });
}

void ParameterService::close(Channel channel) {
  std::erase_if(listings_, [&](const Listing& l) { return l.to.channel == channel; });
}

}  // namespace skein::vehicle_services
