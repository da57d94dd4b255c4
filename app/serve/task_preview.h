// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/data/event/live.h"
#include "skein/layer/hmi/serve/live_feed.h"
#include "skein/scenario/scenario.h"

namespace skein::serve {

/// Flies a task ahead: the aircraft alone, simulated, from where it believes to be, in
/// the scenario's terrain and wind without turbulence, with the zones that are in force,
/// until the task is done and for half an hour at most.
///
/// Tasks that follow what others do or what is sensed (leaders, relays, edges) cannot be
/// foreseen: the answer says so.
/// @param stop  asks for an early end; then the answer is of no use.
TaskPreview preview_task(const scenario::Scenario& scenario,
                         const assemble::KindRegistry& kinds,
                         const hmi::PreviewOrder& order, const std::atomic<bool>& stop);

/// Does that on a thread of its own, one after the other. Of those who ask again before
/// they are answered only the newest question is answered.
class TaskPreviewer {
 public:
  /// By the previewer's thread.
  using Answer = std::function<void(hmi::ClientNumber, const TaskPreview&)>;

  /// @param kinds  that the scenario was read with; outlive this.
  TaskPreviewer(scenario::Scenario scenario, const assemble::KindRegistry& kinds,
                Answer answer);
  ~TaskPreviewer();
  TaskPreviewer(const TaskPreviewer&) = delete;
  TaskPreviewer& operator=(const TaskPreviewer&) = delete;

  void ask(hmi::ClientNumber client, std::uint32_t number, hmi::PreviewOrder order);

 private:
  struct Question {
    hmi::ClientNumber client = 0;
    std::uint32_t number = 0;
    hmi::PreviewOrder order;
  };
  void work();

  scenario::Scenario scenario_;
  const assemble::KindRegistry& kinds_;
  Answer answer_;
  std::mutex lock_;
  std::condition_variable asked_;
  std::deque<Question> questions_;         // under the lock
  hmi::ClientNumber answered_client_ = 0;  // whose question is at work; under the lock
  bool ended_ = false;                     // under the lock
  std::atomic<bool> stop_ = false;         // what is at work
  std::thread thread_;
};

}  // namespace skein::serve
