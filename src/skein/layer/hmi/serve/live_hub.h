// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/command/command.h"
#include "skein/data/event/live.h"
#include "skein/data/team/task_form.h"
#include "skein/layer/hmi/serve/client_request.h"
#include "skein/layer/hmi/serve/foxglove/viewers.h"
#include "skein/layer/hmi/serve/web_server.h"

namespace skein::hmi {

/// What a run says to those who watch it, coded once for all of them. `whole` holds the
/// truth too, `open` does not; null: nobody needs it.
struct LiveBatch {
  SharedBytes open, whole;
  /// The full state, for those who have come or fallen behind.
  SharedBytes open_state, whole_state;
};

/// What a task would become of which a client thinks.
struct PreviewQuestion {
  TaskCommand task;
};

/// A command of a client, its request to go to another time of a recorded run, or what
/// it wants to know before it gives a task.
struct ClientCommand {
  ClientNumber client = 0;
  std::uint32_t number = 0;  ///< of the client's requests
  std::string sender;        ///< for the records
  std::variant<Command, SeekRequest, PreviewQuestion> what;
};

/// What is served besides the feed: pages, and data of a run by their names.
using Answerer = std::function<HttpAnswer(const HttpRequest&)>;

/// Stands between a run and those who watch it: each on a thread of its own.
///
/// Clients that read too slowly miss frames: what waits for them is bounded, and when
/// they have caught up they are told the full state. Commands are taken from who holds
/// control, as far as their role allows. Viewers of Foxglove's protocol only see.
class LiveHub final : public WebListener {
 public:
  /// As WebSocket protocol.
  static constexpr std::string_view kProtocol = "skein.live.v1";
  /// What may wait for a client.
  static constexpr std::size_t kMaxWaiting = 8 << 20;

  /// @param answer  by the server's thread.
  /// @param facts   for viewers that speak Foxglove's protocol.
  /// @param forms   of the kinds of tasks that may be given; null: those that messages
  ///                have types for.
  LiveHub(Answerer answer, const foxglove::Facts& facts,
          std::shared_ptr<const TaskForms> forms = {})
      : answer_(std::move(answer)), viewers_(facts), forms_(std::move(forms)) {}

  /// Once, before anything else, and before the server is started.
  void attach(WebServer& server) {
    server_ = &server;
    viewers_.attach(server);
  }

  // By the thread of the run.

  bool is_watched() const { return open_ > 0 || whole_ > 0; }
  bool wants_open() const { return open_ > 0; }
  bool wants_whole() const { return whole_ > 0; }
  /// Whether somebody waits for the full state; asked once before each batch.
  bool take_state_wanted() { return state_wanted_.exchange(false); }
  void publish(LiveBatch batch);
  /// Everybody has missed something.
  void all_behind();
  void reply(ClientNumber client, const RequestReply& reply);
  /// Answers a PreviewQuestion. By any thread.
  void reply(ClientNumber client, const TaskPreview& preview);
  std::vector<ClientCommand> take_commands();

  // By the server's thread.

  /// Commands and questions that wait for the run.
  std::size_t waiting_requests() {
    const std::lock_guard guard(lock_);
    return commands_.size();
  }

  /// How many watch.
  std::size_t clients() const { return watchers_.size(); }
  HttpAnswer answer(const HttpRequest& request) override;
  void joined(ClientNumber client, const Access& access,
              std::string_view protocol) override;
  void said(ClientNumber client, std::string_view message, bool is_text) override;
  void left(ClientNumber client) override;

 private:
  struct Watcher {
    Access access;
    std::string name;
    bool behind = true;  // is told the full state as soon as it has read what waits
    bool may_see_truth = false;
    bool sees_truth = false;
    bool is_viewer = false;  // is served by viewers_
  };

  void obey(ClientNumber client, const ClientRequest& request);
  void command(ClientNumber client, std::uint32_t number, const std::string& line);
  void hand_to_run(ClientNumber client, std::uint32_t number,
                   decltype(ClientCommand::what) what);
  void preview(ClientNumber client, std::uint32_t number, const std::string& line);
  void put(ClientCommand asked);
  void hold(ClientNumber client, std::uint32_t number, bool wanted);
  void hand_over(ClientNumber client, std::uint32_t number, ClientNumber to);
  void answer_to(ClientNumber client, std::uint32_t number, RequestState state,
                 const std::string& text = {});
  void deliver(const LiveBatch& batch);
  void tell_clients();
  void count_watchers();
  std::string name_of(ClientNumber client) const;
  std::string sender_of(ClientNumber client) const;
  const TaskForms& task_forms() const { return forms_ ? *forms_ : message_task_forms(); }

  Answerer answer_;
  foxglove::Viewers viewers_;
  std::shared_ptr<const TaskForms> forms_;
  WebServer* server_ = nullptr;
  std::atomic<std::size_t> open_ = 0, whole_ = 0;  // watchers without and with the truth
  std::atomic<bool> state_wanted_ = false;
  // The server's thread alone.
  std::map<ClientNumber, Watcher> watchers_;
  ClientNumber holder_ = 0;
  bool truth_shown_ = true;
  // Between the threads.
  std::mutex lock_;
  std::vector<ClientCommand> commands_;
};

/// A message of the feed: items after each other.
SharedBytes coded(const std::vector<LiveItem>& items);

}  // namespace skein::hmi
