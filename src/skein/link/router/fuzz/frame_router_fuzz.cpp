// SPDX-License-Identifier: Apache-2.0
// Where frames go, whoever sends what over which link: never back, never to a link that
// is gone, to a system only where that was heard, and keys nowhere.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include "skein/link/mavlink/fuzz/message_feed.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/router/frame_router.h"

namespace {

using namespace skein;
using mavlink::Frame;
using router::Channel;
using Feed =
    mavlink::MessageFeed<mavlink::Heartbeat, mavlink::SystemTime, mavlink::CommandLong,
                         mavlink::ParamSet, mavlink::SetupSigning>;

struct Subject {
  void open(Channel channel) {
    router.open(channel);
    channels.insert(channel);
  }
  void close(Channel channel) {
    router.close(channel);
    channels.erase(channel);
    SKEIN_CHECK(router.systems_of(channel).empty(), channel);
  }

  void receive(const Frame& frame, Channel channel, Time) {
    router.route(channel, frame, to);
    if (frame.system() != 0) SKEIN_CHECK(has_heard(channel, frame.system()), channel);
    SKEIN_CHECK(std::ranges::adjacent_find(to, std::greater_equal<>()) == to.end());
    for (const Channel out : to)
      SKEIN_CHECK(channels.contains(out) && out != channel, out);
    const std::uint8_t target = frame.target_system();
    if (router::carries_key(frame))
      SKEIN_CHECK(to.empty());
    else if (target == 0)
      SKEIN_CHECK(to.size() + 1 == channels.size(), to.size());
    else
      for (const Channel out : to) SKEIN_CHECK(has_heard(out, target), out);
  }

  void step(Time) {}

  bool has_heard(Channel channel, std::uint8_t system) const {
    const std::vector<std::uint8_t> systems = router.systems_of(channel);
    return std::ranges::find(systems, system) != systems.end();
  }

  router::FrameRouter router;
  std::set<Channel> channels;
  std::vector<Channel> to;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Feed feed({data, size}, 255, 190);
  Subject subject;
  feed.run(subject);
  return 0;
}
