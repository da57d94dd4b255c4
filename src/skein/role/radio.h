#pragma once

#include <vector>

#include "skein/data/message.h"

namespace skein {

/// The radio medium between all entities.
class Radio {
 public:
  virtual ~Radio() = default;

  /// A message leaves its sender. Calls come in entity order.
  virtual void send(const Message& message) = 0;

  /// Appends the messages that have arrived by `now`, in order of arrival, ties in the
  /// order of sending; lost ones go to `lost`.
  virtual void deliver(Time now, std::vector<Message>& arrived,
                       std::vector<Message>& lost) = 0;
};

}  // namespace skein
