#include "skein/data/message.h"

#include "skein/data/wire.h"

namespace skein {

std::string_view kind_of(const MessageContent& content) {
  return std::visit([]<class T>(const T&) { return kind_of<T>(); }, content);
}

std::size_t coded_size(const Message& message) {
  return wire::coded_size(message);
}

}  // namespace skein
