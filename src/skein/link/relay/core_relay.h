// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/relay/relay_core.h"

namespace skein::relay {

/// A relay whose sessions its core keeps; it makes them.
class CoreRelay : public Relay {
 public:
  CoreRelay(RelayOptions options, RelayNews news)
      : options_(std::move(options)), core_(options_, std::move(news)) {}

  void run_for(std::chrono::milliseconds duration) override { core_.run_for(duration); }
  Time now() const override {
    return Time::from_ns(std::chrono::duration_cast<std::chrono::nanoseconds>(
                             std::chrono::steady_clock::now() - core_.begin())
                             .count());
  }
  void change(impairment::Directions directions,
              const impairment::ImpairmentChange& change) override {
    core_.change(directions, change);
  }
  void cut(impairment::Directions directions, Time length) override {
    core_.cut(directions, length);
  }
  void reset() override { core_.reset(); }
  RelayReport report() const override { return core_.report(); }
  std::vector<SessionReport> sessions() const override { return core_.sessions(); }
  std::vector<SessionReport> take_ended() override { return core_.take_ended(); }

 private:
  RelayOptions options_;

 protected:
  RelayCore core_;
};

}  // namespace skein::relay
