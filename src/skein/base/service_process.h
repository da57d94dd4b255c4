// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "skein/base/result.h"

namespace skein {

/// What goes to a service process and comes back: texts and numbers, in an order that
/// both sides agree on.
struct ServiceMessage {
  std::vector<std::string> texts;
  std::vector<double> numbers;
};

/// A copy of this process that answers requests, for libraries that may crash, hang or
/// eat the memory on damaged input: all of that is an Error here.
///
/// The copy has one thread, the one that made it. It may take no lock that another thread
/// can have held at that moment; memory may be allocated. It ends with its owner. It has
/// 120 s of processor time and 2 GiB of memory beyond what it begins with, and nothing of
/// what it writes to standard output or standard error is seen.
class ServiceProcess {
 public:
  /// Runs in the copy. What it throws ends the copy.
  using Answer = std::function<ServiceMessage(const ServiceMessage& request)>;

  /// Fails: kUnavailable when there can be no more processes.
  static Result<ServiceProcess> start(const Answer& answer);

  ServiceProcess(ServiceProcess&& other) noexcept;
  ServiceProcess& operator=(ServiceProcess&& other) noexcept;
  ~ServiceProcess();

  /// Fails: kBadInput when the copy ends instead of answering, or does not answer within
  /// 300 s; the message says how. Every later request fails then, too.
  Result<ServiceMessage> ask(const ServiceMessage& request);

 private:
  ServiceProcess(pid_t process, int socket) : process_(process), socket_(socket) {}
  void end();
  Error ended();

  pid_t process_ = -1;
  int socket_ = -1;
};

}  // namespace skein
