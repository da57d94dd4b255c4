// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/event_text.h"

#include <fmt/format.h>

#include <string_view>

#include "skein/data/describe/describe.h"
#include "skein/data/event/event_kind.h"

namespace skein::record {
namespace {

constexpr std::string_view kIntroduction = R"(# Events

Made by `skein keys events` from the tables in `src/skein/data/event`: do not edit.

An event is something worth reporting that happened at one time: a kind, a text for people, and numbers for
programs (table `events` of the [run database](records.md)). Programs compare kinds and take numbers; nothing reads
texts. *Severity*: `information`: all goes as it is to; `notice`: something has changed that one may want to know;
`warning`: something fails or is refused; `alarm`: something is lost or in danger. *For*: whom it concerns first.
Kinds marked **at once** are shown to whoever commands as soon as they happen.

Plugins have events of their own, each with a name that begins with the plugin's
([extending.md](extending.md)); so do kinds that an earlier or later version of Skein had.
)";

template <NamedEnum E>
std::string alternatives() {
  std::string all;
  for (const std::string_view name : names_of(static_cast<const E*>(nullptr)))
    all += fmt::format("{}\"{}\"", all.empty() ? "" : " | ", name);
  return all;
}

}  // namespace

std::string events_markdown() {
  std::string text(kIntroduction);
  for (const EventGroup& group : event_groups()) {
    text += fmt::format(
        "\n## {}\n\n| kind | severity | for | meaning | numbers "
        "|\n|---|---|---|---|---|\n",
        group.title);
    for (const EventKindRow& row : group.rows)
      text += fmt::format("| `{}` | {}{} | {} | {} | {} |\n", row.name,
                          name_of(row.severity), row.announced ? ", **at once**" : "",
                          name_of(row.audience), row.meaning, row.numbers);
  }
  return text;
}

std::string events_typescript() {
  std::string text = fmt::format(
      "\n/** What is said of a kind of event. */\nexport interface EventKind {{\n"
      "  subject: {};\n  severity: {};\n  audience: {};\n"
      "  announced: boolean; // whoever commands is shown it at once\n"
      "  meaning: string;\n}}\n\n"
      "/** All kinds of event, by name: docs/events.md. Those of plugins are not among "
      "them. "
      "*/\nexport const eventKinds = {{\n",
      alternatives<EventSubject>(), alternatives<EventSeverity>(),
      alternatives<EventAudience>());
  for (const EventGroup& group : event_groups())
    for (const EventKindRow& row : group.rows)
      text += fmt::format(
          "  \"{}\": {{ subject: \"{}\", severity: \"{}\", audience: \"{}\", announced: "
          "{}, meaning: \"{}\" }},\n",
          row.name, name_of(group.subject), name_of(row.severity), name_of(row.audience),
          row.announced, row.meaning);
  return text + "} satisfies Record<string, EventKind>;\n";
}

}  // namespace skein::record
