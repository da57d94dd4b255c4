// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"

namespace skein {

/// A value as it is recorded: with the moment from which it counts, and whose it is. Its
/// record is described by the words that stand beside the value's type:
///
///   constexpr StampedWords stamped_words(const TrafficAlert*) {
///     return {{"alert", "alerts"}, "An alert ...", "when", "entity_id", "whose",
///     "what"};
///   }
template <class T>
struct Stamped {
  Time time;
  EntityId id;
  T value;
};

/// What the record of a value is called, and what its fields mean.
struct StampedWords {
  KindName name;
  std::string_view help;
  std::string_view time;     ///< meaning of the time
  std::string_view id_name;  ///< of the field that says whose
  std::string_view id;       ///< its meaning
  std::string_view value;    ///< meaning of the value's fields
  bool coded = false;        ///< the value is a choice that is kept as Storage::kCoded
};

template <class T>
constexpr auto describe(const Stamped<T>*) {
  using S = Stamped<T>;
  constexpr StampedWords words = stamped_words(static_cast<const T*>(nullptr));
  const auto time = field("time", &S::time, words.time);
  const auto id = field(words.id_name, &S::id, words.id);
  if constexpr (words.coded)
    return described<S>(words.name, words.help, time, id,
                        field("", &S::value, Storage::kCoded, words.value));
  else
    return described<S>(words.name, words.help, time, id,
                        field("", &S::value, words.value));
}

}  // namespace skein
