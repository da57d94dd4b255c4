// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>  // before Asio, which lacks it in C++20

#include <array>
#include <boost/asio/write.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "skein/link/transport/hub.h"

namespace skein::transport {

/// A connection or line over which bytes come and go in order.
/// @tparam Stream  a socket or serial port of Asio, open.
template <class Stream>
class StreamChannel final : public Endpoint,
                            public std::enable_shared_from_this<StreamChannel<Stream>> {
 public:
  /// @param room   bytes that may wait to go out.
  /// @param ended  is called once, after the channel was closed.
  StreamChannel(Hub& hub, Stream stream, std::size_t room, std::function<void()> ended)
      : hub_(hub), stream_(std::move(stream)), room_(room), ended_(std::move(ended)) {}

  void begin(const std::string& name) {
    channel_ = hub_.open(*this, name);
    read();
  }

  bool send(ChannelId, std::span<const std::byte> bytes) override {
    if (waiting_.size() + going_.size() + bytes.size() > room_) return false;
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    if (going_.empty()) write();
    return true;
  }

 private:
  void read() {
    stream_.async_read_some(boost::asio::buffer(in_), [self = this->shared_from_this()](
                                                          boost::system::error_code error,
                                                          std::size_t count) {
      if (error) return self->end(error.message());
      self->hub_.listener.received(self->channel_, std::span(self->in_).first(count));
      if (self->open_) self->read();
    });
  }

  void write() {
    going_.swap(waiting_);
    boost::asio::async_write(
        stream_, boost::asio::buffer(going_),
        [self = this->shared_from_this()](boost::system::error_code error, std::size_t) {
          self->going_.clear();
          if (error) return self->end(error.message());
          if (!self->waiting_.empty() && self->open_) self->write();
        });
  }

  void end(const std::string& why) {
    if (!open_) return;
    open_ = false;
    boost::system::error_code ignored;
    stream_.close(ignored);
    hub_.close(channel_, why);
    ended_();
  }

  Hub& hub_;
  Stream stream_;
  std::size_t room_;
  std::function<void()> ended_;
  ChannelId channel_ = 0;
  bool open_ = true;
  std::array<std::byte, 4096> in_;
  std::vector<std::byte> waiting_, going_;
};

}  // namespace skein::transport
