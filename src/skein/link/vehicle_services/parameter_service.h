// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "skein/base/time.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::vehicle_services {

/// MAV_PARAM_TYPE of what Skein's vehicles have.
enum class ParameterType : std::uint8_t {
  kUint8 = 1,
  kInt8 = 2,
  kUint16 = 3,
  kInt16 = 4,
  kUint32 = 5,
  kInt32 = 6,
  kReal32 = 9,
};

/// A value that ground stations show and change.
struct Parameter {
  std::string name;  ///< at most 16 characters
  ParameterType type = ParameterType::kReal32;
  double value = 0;
  double lowest = -1e9, highest = 1e9;  ///< what is outside is moved to the bound
  bool read_only = false;
};

/// How the field of a float carries an integer.
enum class ParameterEncoding : std::uint8_t {
  kCast,   ///< as the number: ArduPilot
  kBytes,  ///< as its bytes: everybody else
};

/// The parameter protocol of a vehicle: the list, single ones, changes. A list goes out
/// at 250 a second for each who asked, so that no buffer on the way overflows; what is
/// lost is asked for again by index, or after a pause by the whole list.
class ParameterService {
 public:
  using Changed = std::function<void(const Parameter&)>;

  /// @param parameters  one or more; their order stays.
  /// @param changed     is called after each change of a value.
  ParameterService(std::vector<Parameter> parameters, ParameterEncoding encoding,
                   Changed changed);

  void handle(const mavlink::ParamRequestList& request, const Peer& from, Time now);
  void handle(const mavlink::ParamRequestRead& request, const Peer& from, Outbox& out);
  void handle(const mavlink::ParamSet& request, const Peer& from, Outbox& out);

  /// Sends what is due.
  void step(Time now, Outbox& out);

  /// The link is gone.
  void close(Channel channel);

  /// Gives the parameter of a name another value, as a ground station would.
  /// @returns  false without one, or when it is read-only.
  bool set(std::string_view name, double value);

  /// The parameter of a name; null without one.
  const Parameter* find(std::string_view name) const;
  std::size_t size() const { return parameters_.size(); }

 private:
  // Somebody who gets the list.
  struct Listing {
    Peer to;
    std::size_t next = 0;
    Time due;  // the next one
  };

  mavlink::ParamValue message_of(std::size_t index) const;
  std::optional<std::size_t> index_of(std::string_view name) const;
  void change(Parameter& parameter, double value);

  std::vector<Parameter> parameters_;
  ParameterEncoding encoding_;
  Changed changed_;
  std::vector<Listing> listings_;
};

/// The float that carries a value of a type.
float coded_parameter(double value, ParameterType type, ParameterEncoding encoding);
/// The value in such a float.
double decoded_parameter(float coded, ParameterType type, ParameterEncoding encoding);

}  // namespace skein::vehicle_services
