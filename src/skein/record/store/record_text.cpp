// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/record_text.h"

#include <set>

#include "skein/data/describe/columns.h"
#include "skein/data/event/live.h"
#include "skein/record/store/event_text.h"
#include "skein/record/store/rows.h"
#include "skein/record/store/type_name.h"

namespace skein::record {
namespace {

using namespace type_traits;  // NOLINT: the traits are ours

// Names of TypeScript's own, and kinds that several structs have.
template <class T>
std::string type_of_kind() {
  if constexpr (std::is_same_v<T, GroundObject>)
    return "GroundObject";
  else if constexpr (std::is_same_v<T, ZoneChange>)
    return "ZoneChange";
  else if constexpr (std::is_same_v<T, ZoneRecord>)
    return "ZoneRecord";
  else if constexpr (std::is_same_v<T, MessageRecord>)
    return "MessageRecord";
  else if constexpr (std::is_same_v<T, TaskCommand>)
    return "TaskCommand";
  else if constexpr (std::is_same_v<T, CommandRecord>)
    return "CommandRecord";
  else
    return type_name(kind_of<T>());
}

// Writes each interface once, those that others need before them.
class TypeScript {
 public:
  template <Described T>
  void add() {
    const std::string name = type_of_kind<T>();
    if (!written_.insert(name).second) return;
    std::string fields;
    add_fields<T>("", fields);
    text_ += "\n/** " + std::string(kDescription<T>.help) + " */\nexport interface " +
             name + " {\n" + fields + "}\n";
  }
  const std::string& text() const { return text_; }

 private:
  template <Described T>
  void add_fields(std::string_view prefix, std::string& out) {
    for_each_field<T>([&]<class O, class M, class F>(const Field<O, M, F>& f) {
      add_field<M>(json::joined(prefix, f.name), f.form, f.help, out);
    });
  }

  static void line(const std::string& name, const std::string& type,
                   std::string_view help, std::string& out) {
    out += "  " + name + ": " + type + "; // " + std::string(help) + "\n";
  }

  template <class M, class Form>
  void add_field(const std::string& name, const Form& form, std::string_view help,
                 std::string& out) {
    if constexpr (std::is_same_v<M, Vec2> || std::is_same_v<M, Vec3>) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(M::RowsAtCompileTime); ++k)
        line(json::joined(name, form.names[k]).append(form.unit.suffix), "number | null",
             help, out);
    } else if constexpr (std::is_same_v<M, Quat>) {
      for (const char* angle : {"heading_deg", "roll_deg", "pitch_deg"})
        line(json::joined(name, angle), "number", help, out);
    } else if constexpr (std::is_same_v<M, Time>) {
      line(json::joined(name, "s"), "number", help, out);
    } else if constexpr (std::is_same_v<M, std::optional<Time>>) {
      line(json::joined(name, "s"), "number | null", help, out);
    } else if constexpr (kIsArray<M>) {
      for (std::size_t k = 1; k <= std::tuple_size_v<M>; ++k)
        add_field<typename M::value_type>(json::joined(name, std::to_string(k)), form,
                                          help, out);
    } else if constexpr (Described<M>) {
      add_fields<M>(name, out);
    } else if constexpr (kIsVariant<M>) {
      // The fields of a nameless choice stand beside its kind.
      const std::string choice = choice_of(static_cast<const M*>(nullptr));
      if (name.empty())
        line("kind", "string", std::string(help) + ": fields of " + choice, out);
      else
        line(name, choice, help, out);
    } else {
      line(name + std::string(json::detail::suffix_of(form)), type_of<M>(), help, out);
    }
  }

  template <class... Ts>
  std::string choice_of(const std::variant<Ts...>*) {
    std::string all;
    const auto add_one = [&]<class T>() {
      all += all.empty() ? "" : " | ";
      if constexpr (Described<T>) {
        add<T>();
        all += "({ kind: \"" + std::string(kind_of<T>()) + "\" } & " + type_of_kind<T>() +
               ")";
      } else {
        all += "{ kind: \"ring\"; points: " + type_of<T>() + " }";
      }
    };
    (add_one.template operator()<Ts>(), ...);
    return all;
  }

  template <class M>
  std::string type_of() {
    if constexpr (kIsVector<M>) {
      return type_of<typename M::value_type>() + "[]";
    } else if constexpr (kIsOptional<M> || std::is_same_v<M, double>) {
      return "number | null";
    } else if constexpr (std::is_same_v<M, bool>) {
      return "boolean";
    } else if constexpr (std::is_same_v<M, std::string> || WrittenAsName<M>) {
      return "string";
    } else if constexpr (std::is_same_v<M, Vec2>) {
      return "[number, number]";
    } else if constexpr (Described<M>) {
      add<M>();
      return type_of_kind<M>();
    } else if constexpr (NamedEnum<M>) {
      std::string words;
      for (const std::string_view word : names_of(static_cast<const M*>(nullptr)))
        words += (words.empty() ? "\"" : " | \"") + std::string(word) + "\"";
      return words;
    } else {
      return "number";
    }
  }

  std::string text_;
  std::set<std::string> written_;
};

template <Described T>
std::string markdown_row() {
  std::string row = "| `" + std::string(kDescription<T>.name.table) + "` | " +
                    std::string(kDescription<T>.help) + " | ";
  std::string_view help;
  std::string names;
  const auto close = [&] {
    if (!names.empty()) row += names + ": " + std::string(help) + "; ";
    names.clear();
  };
  // Columns that are explained together, as the parts of a vector are, stand together.
  for (const columns::Column& column : columns::columns_of<T>()) {
    if (column.help.data() != help.data()) close();
    help = column.help;
    names += (names.empty() ? "`" : ", `") + column.name + "`";
  }
  close();
  row.resize(row.size() - 2);
  return row + " |\n";
}

}  // namespace

std::string records_typescript() {
  TypeScript types;
  for_each_alternative(static_cast<const Record*>(nullptr),
                       [&]<class T>() { types.add<T>(); });
  for_each_alternative(static_cast<const LiveItem*>(nullptr), [&]<class T>() {
    if constexpr (!std::is_same_v<T, LiveRecord>) types.add<T>();
  });
  return "// SPDX-License-Identifier: Apache-2.0\n"
         "/** Made by `skein schema records` from the descriptions in "
         "src/skein/data: do not edit. */\n" +
         types.text() + events_typescript();
}

std::string records_markdown() {
  std::string rows = "| table | one row is | columns |\n|---|---|---|\n";
  for_each_alternative(static_cast<const Record*>(nullptr), [&]<class T>() {
    if constexpr (!kDescription<T>.name.table.empty()) rows += markdown_row<T>();
  });
  return rows + markdown_row<TaskRow>();
}

}  // namespace skein::record
