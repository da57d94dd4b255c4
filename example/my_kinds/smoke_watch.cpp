// SPDX-License-Identifier: Apache-2.0
#include "smoke_watch.h"

#include <utility>
#include <variant>

#include "skein/data/describe/plugin_value.h"

namespace my_kinds {
namespace {

constexpr const char* kSmokeNote = "my_kinds/smoke_note";

}  // namespace

SmokeWatch::SmokeWatch(const SmokeWatchOptions& options, skein::EntityId self,
                       skein::EntityId other, double altitude_msl)
    : options_(options), self_(self), other_(other), altitude_msl_(altitude_msl) {}

void SmokeWatch::step(const skein::AgentInput& in, skein::AgentOutput& out) {
  if (!circles_) {
    skein::AutopilotCommand circle;
    circle.guidance = skein::Circle{skein::Vec2::Zero(), options_.radius, true};
    circle.altitude_msl = altitude_msl_;
    out.command = circle;
    circles_ = true;
  }
  for (const skein::SensorSample& sample : in.samples)
    if (const auto* fire = std::get_if<skein::FireSample>(&sample))
      if (inside_ != fire->inside) {
        inside_ = fire->inside;
        note({fire->time, skein::geo::horizontal(in.nav->p_N), fire->inside}, out);
      }
  for (const skein::Message& message : in.inbox) {
    const auto* payload = std::get_if<skein::PluginPayload>(&message.content);
    if (!payload || payload->kind != kSmokeNote) continue;
    // Bytes that came over a radio may be anything.
    if (const auto received = skein::from_coded<SmokeNote>(payload->coded))
      out.events.push_back({in.now, self_, skein::EventLabel::named("smoke-note"),
                            received.value().inside ? "the other one sees fire"
                                                    : "the other one sees none"});
  }
}

void SmokeWatch::note(const SmokeNote& note, skein::AgentOutput& out) const {
  out.records.push_back(skein::to_record(note.time, kSmokeNote, note));
  skein::Message message;
  message.to = other_;
  message.content = skein::to_payload(kSmokeNote, note);
  out.outbox.push_back(std::move(message));
}

}  // namespace my_kinds
