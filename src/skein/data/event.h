#pragma once

#include <string>

#include "skein/base/id.h"
#include "skein/base/time.h"

namespace skein {

/// Something worth telling the user that happened at one moment of a run.
struct Event {
  Time time;
  EntityId entity;
  std::string
      kind;  ///< short and stable, for scripts: "joined", "crossing", "outlier"...
  std::string text;  ///< for people
};

}  // namespace skein
