// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/small_services.h"

#include <algorithm>

#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/payload.h"

namespace skein::vehicle_services {
namespace {

// Where things lie in the payload of a file transfer.
namespace file_field {
constexpr std::size_t kSequence = 0, kSession = 2, kOperation = 3, kSize = 4,
                      kRequested = 5, kData = 12;
}  // namespace file_field
constexpr std::uint8_t kUnknownOperation = 7;  // MAV_FTP_ERR

}  // namespace

void answer(const mavlink::Timesync& question, const Peer& from, const Clocks& now,
            Outbox& out) {
  if (question.tc1 != 0) return;
  mavlink::Timesync answer;
  answer.tc1 = std::max<std::int64_t>(now.simulated.ns(), 1);  // 0 would be a question
  answer.ts1 = question.ts1;
  answer.target_system = from.system;
  answer.target_component = from.component;
  out.send(from.channel, answer);
}

void answer(const mavlink::Ping& question, const Peer& from, Outbox& out) {
  if (question.target_system != 0 || question.target_component != 0) return;
  mavlink::Ping answer = question;
  answer.target_system = from.system;
  answer.target_component = from.component;
  out.send(from.channel, answer);
}

void answer(const mavlink::FileTransferProtocol& request, const Peer& from, Outbox& out) {
  using namespace file_field;
  using mavlink::FileOperation;
  mavlink::FileTransferProtocol answer;
  answer.target_system = from.system;
  answer.target_component = from.component;
  const auto& asked = request.payload;
  const auto sequence =
      static_cast<std::uint16_t>((asked[kSequence] | asked[kSequence + 1] << 8) + 1);
  answer.payload[kSequence] = static_cast<std::uint8_t>(sequence & 0xff);
  answer.payload[kSequence + 1] = static_cast<std::uint8_t>(sequence >> 8);
  answer.payload[kSession] = asked[kSession];
  answer.payload[kRequested] = asked[kOperation];
  const auto operation = static_cast<FileOperation>(asked[kOperation]);
  if (operation == FileOperation::kAck || operation == FileOperation::kNak) return;
  if (operation == FileOperation::kTerminateSession ||
      operation == FileOperation::kResetSessions) {
    answer.payload[kOperation] = static_cast<std::uint8_t>(FileOperation::kAck);
  } else {
    answer.payload[kOperation] = static_cast<std::uint8_t>(FileOperation::kNak);
    answer.payload[kSize] = 1;
    answer.payload[kData] = kUnknownOperation;
  }
  out.send(from.channel, answer);
}

void answer(const mavlink::LogRequestList&, const Peer& from, Outbox& out) {
  out.send(from.channel, mavlink::LogEntry());
}

void answer(const mavlink::LogRequestData& request, const Peer& from, Outbox& out) {
  mavlink::LogData end;
  end.id = request.id;
  end.ofs = request.ofs;
  out.send(from.channel, end);
}

void send_text(const VehicleText& text, std::uint16_t number, Channel channel,
               Outbox& out) {
  mavlink::Statustext part;
  constexpr std::size_t kLength = sizeof part.text;
  part.severity = text.severity;
  const std::string_view all = text.text;
  if (all.size() > kLength) part.id = number;
  // A part that is full says that there is another, which may be empty.
  for (std::size_t from = 0; from <= all.size(); from += kLength) {
    mavlink::set_text(part.text, all.substr(from));
    out.send(channel, part);
    if (part.id == 0) return;
    ++part.chunk_seq;
  }
}

}  // namespace skein::vehicle_services
