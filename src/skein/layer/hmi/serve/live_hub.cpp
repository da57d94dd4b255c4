// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/live_hub.h"

#include <fmt/format.h>

#include "skein/data/command/command_text.h"
#include "skein/data/describe/wire.h"

namespace skein::hmi {
namespace {

// Commands that wait for the next step of the run.
constexpr std::size_t kMaxCommands = 1000;

// What only instructors do: it is not part of flying.
bool is_of_instructors(const Command& command) {
  return std::holds_alternative<FaultCommand>(command) ||
         std::holds_alternative<WindCommand>(command);
}

// What is wrong with a command that a page sends; empty: nothing.
std::string fault_of(const Command& command) {
  const auto* task = std::get_if<TaskCommand>(&command);
  if (task && !task->file.empty())
    return "no files are read for a page: it sends the plan itself.";
  return {};
}

}  // namespace

SharedBytes coded(const std::vector<LiveItem>& items) {
  auto bytes = std::make_shared<std::vector<std::byte>>();
  wire::encode(items, *bytes);
  return bytes;
}

void LiveHub::publish(LiveBatch batch) {
  server_->post([this, batch = std::move(batch)] { deliver(batch); });
}

void LiveHub::all_behind() {
  server_->post([this] {
    for (auto& [number, watcher] : watchers_) watcher.behind = true;
    viewers_.fall_behind();
    if (!watchers_.empty()) state_wanted_ = true;
  });
}

void LiveHub::reply(ClientNumber client, const RequestReply& reply) {
  server_->post(
      [this, client, reply] { server_->send(client, coded({LiveItem(reply)})); });
}

void LiveHub::reply(ClientNumber client, const TaskPreview& preview) {
  const bool can = preview.problem.empty();
  const RequestReply fate{preview.number,
                          can ? RequestState::kAccepted : RequestState::kRefused,
                          preview.problem};
  server_->post([this, client, preview, fate] {
    server_->send(client, coded({LiveItem(preview), LiveItem(fate)}));
  });
}

std::vector<ClientCommand> LiveHub::take_commands() {
  const std::lock_guard guard(lock_);
  return std::exchange(commands_, {});
}

void LiveHub::deliver(const LiveBatch& batch) {
  for (auto& [number, watcher] : watchers_) {
    if (watcher.is_viewer) continue;
    const std::size_t waiting = server_->waiting(number);
    if (waiting > kMaxWaiting) watcher.behind = true;
    if (!watcher.behind) {
      if (const SharedBytes& news = watcher.sees_truth ? batch.whole : batch.open)
        server_->send(number, news);
      continue;
    }
    if (waiting > 0) continue;
    if (const SharedBytes& state =
            watcher.sees_truth ? batch.whole_state : batch.open_state) {
      server_->send(number, state);
      watcher.behind = false;
    } else {
      state_wanted_ = true;
    }
  }
  if (viewers_.deliver(false, batch.open, batch.open_state)) state_wanted_ = true;
  if (viewers_.deliver(true, batch.whole, batch.whole_state)) state_wanted_ = true;
}

HttpAnswer LiveHub::answer(const HttpRequest& request) {
  return answer_(request);
}

void LiveHub::joined(ClientNumber client, const Access& access,
                     std::string_view protocol) {
  Watcher& watcher = watchers_[client];
  watcher.access = access;
  watcher.name = access.name;
  watcher.may_see_truth = access.role == AccessRole::kInstructor;
  watcher.is_viewer = foxglove::is_protocol(protocol);
  if (watcher.is_viewer) {
    watcher.access.role = AccessRole::kViewer;
    watcher.sees_truth = truth_shown_ && watcher.may_see_truth;
    if (watcher.name.empty()) watcher.name = fmt::format("Foxglove {}", client);
    viewers_.join(client, watcher.sees_truth);
  } else if (holder_ == 0 && access.role != AccessRole::kViewer) {
    holder_ = client;
  }
  state_wanted_ = true;
  count_watchers();
  tell_clients();
}

void LiveHub::left(ClientNumber client) {
  watchers_.erase(client);
  viewers_.leave(client);
  if (holder_ == client) holder_ = 0;
  count_watchers();
  tell_clients();
}

// Who comes to see other things than before is told all of it anew.
void LiveHub::count_watchers() {
  std::size_t whole = 0;
  for (auto& [number, watcher] : watchers_) {
    const bool sees = truth_shown_ && watcher.may_see_truth;
    if (sees != watcher.sees_truth) {
      if (watcher.is_viewer) viewers_.set_sees_truth(number, sees);
      watcher.sees_truth = sees;
      watcher.behind = true;
      state_wanted_ = true;
    }
    whole += sees;
  }
  open_ = watchers_.size() - whole;
  whole_ = whole;
}

std::string LiveHub::name_of(ClientNumber client) const {
  const auto found = watchers_.find(client);
  return found == watchers_.end() || found->second.name.empty()
             ? fmt::format("client {}", client)
             : found->second.name;
}

std::string LiveHub::sender_of(ClientNumber client) const {
  return "page: " + name_of(client);
}

void LiveHub::tell_clients() {
  ClientList list;
  for (const auto& [number, watcher] : watchers_)
    list.clients.push_back({number, name_of(number), watcher.access.role});
  list.holder = holder_;
  list.truth_shown = truth_shown_;
  for (const auto& [number, watcher] : watchers_) {
    if (watcher.is_viewer) continue;
    list.you = number;
    server_->send(number, coded({LiveItem(list)}));
  }
}

void LiveHub::answer_to(ClientNumber client, std::uint32_t number, RequestState state,
                        const std::string& text) {
  server_->send(client, coded({LiveItem(RequestReply{number, state, text})}));
}

void LiveHub::said(ClientNumber client, std::string_view message, bool is_text) {
  if (watchers_[client].is_viewer) return viewers_.said(client, message, is_text);
  if (!is_text) return answer_to(client, 0, RequestState::kRefused, "requests are text.");
  const auto request = parse_client_request(message);
  if (!request)
    return answer_to(client, 0, RequestState::kRefused, request.error().text());
  obey(client, request.value());
}

void LiveHub::obey(ClientNumber client, const ClientRequest& request) {
  const std::uint32_t number = request.number;
  if (const auto* name = std::get_if<NameRequest>(&request.what)) {
    // A name that belongs to a token is not the client's to choose.
    Watcher& watcher = watchers_[client];
    if (!watcher.access.name.empty())
      return answer_to(client, number, RequestState::kRefused,
                       "the name goes with the token.");
    watcher.name = name->name;
    answer_to(client, number, RequestState::kAccepted);
    return tell_clients();
  }
  if (watchers_[client].access.role == AccessRole::kViewer)
    return answer_to(client, number, RequestState::kRefused, "viewers only see.");
  if (const auto* held = std::get_if<HoldRequest>(&request.what)) {
    hold(client, number, held->hold);
  } else if (const auto* to = std::get_if<HandOverRequest>(&request.what)) {
    hand_over(client, number, to->client);
  } else if (const auto* truth = std::get_if<TruthRequest>(&request.what)) {
    if (watchers_[client].access.role != AccessRole::kInstructor)
      return answer_to(client, number, RequestState::kRefused,
                       "instructors say who sees the truth.");
    truth_shown_ = truth->shown;
    answer_to(client, number, RequestState::kAccepted);
    count_watchers();
    tell_clients();
  } else if (const auto* seek = std::get_if<SeekRequest>(&request.what)) {
    hand_to_run(client, number, *seek);
  } else if (const auto* asked = std::get_if<PreviewRequest>(&request.what)) {
    preview(client, number, asked->line);
  } else {
    command(client, number, std::get<CommandRequest>(request.what).line);
  }
}

void LiveHub::command(ClientNumber client, std::uint32_t number,
                      const std::string& line) {
  auto parsed = parse_command(line, task_forms());
  if (!parsed)
    return answer_to(client, number, RequestState::kRefused, parsed.error().text());
  if (const std::string fault = fault_of(parsed.value()); !fault.empty())
    return answer_to(client, number, RequestState::kRefused, fault);
  if (is_of_instructors(parsed.value()) &&
      watchers_[client].access.role != AccessRole::kInstructor)
    return answer_to(client, number, RequestState::kRefused,
                     "faults and wind are the instructor's.");
  hand_to_run(client, number, std::move(parsed).value());
}

void LiveHub::hand_to_run(ClientNumber client, std::uint32_t number,
                          decltype(ClientCommand::what) what) {
  if (holder_ == 0) {
    holder_ = client;
    tell_clients();
  }
  if (holder_ != client)
    return answer_to(client, number, RequestState::kRefused,
                     fmt::format("{} holds control.", name_of(holder_)));
  put({client, number, sender_of(client), std::move(what)});
}

// Who only asks needs no control.
void LiveHub::preview(ClientNumber client, std::uint32_t number,
                      const std::string& line) {
  auto parsed = parse_command(line, task_forms());
  if (!parsed)
    return answer_to(client, number, RequestState::kRefused, parsed.error().text());
  auto* task = std::get_if<TaskCommand>(&parsed.value());
  if (!task || !task->file.empty())
    return answer_to(client, number, RequestState::kRefused,
                     "only tasks are flown ahead, and no files are read for a page.");
  put({client, number, {}, PreviewQuestion{std::move(*task)}});
}

void LiveHub::put(ClientCommand asked) {
  // Given before it can be obeyed: replies of the run come behind this one.
  answer_to(asked.client, asked.number, RequestState::kGiven);
  const std::lock_guard guard(lock_);
  if (commands_.size() < kMaxCommands)
    commands_.push_back(std::move(asked));
  else
    answer_to(asked.client, asked.number, RequestState::kRefused,
              "too many commands wait already.");
}

void LiveHub::hold(ClientNumber client, std::uint32_t number, bool wanted) {
  const bool may_take = holder_ == 0 || holder_ == client ||
                        (watchers_[client].access.role == AccessRole::kInstructor &&
                         watchers_[holder_].access.role != AccessRole::kInstructor);
  if (wanted && !may_take)
    return answer_to(
        client, number, RequestState::kRefused,
        fmt::format("{} holds control, and can hand it over.", name_of(holder_)));
  if (!wanted && holder_ != client)
    return answer_to(client, number, RequestState::kRefused, "you do not hold control.");
  holder_ = wanted ? client : 0;
  answer_to(client, number, RequestState::kAccepted);
  tell_clients();
}

void LiveHub::hand_over(ClientNumber client, std::uint32_t number, ClientNumber to) {
  const auto found = watchers_.find(to);
  if (holder_ != client)
    return answer_to(client, number, RequestState::kRefused, "you do not hold control.");
  if (found == watchers_.end() || found->second.access.role == AccessRole::kViewer)
    return answer_to(client, number, RequestState::kRefused,
                     "nobody who may give commands has this number.");
  holder_ = to;
  answer_to(client, number, RequestState::kAccepted);
  tell_clients();
}

}  // namespace skein::hmi
