// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/kind_registry.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "skein/assemble/kinds/interface_version.h"
#include "skein/assemble/kinds/load_plugin.h"
#include "skein/assemble/kinds/task_row.h"
#include "skein/assemble/radio/radio_file.h"
#include "skein/assemble/world/build.h"
#include "skein/layer/reasoning/task/stay/stay_task.h"
#include "skein/role/propagation.h"
#include "skein/role/radio.h"
#include "skein/role/routing.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::kind_registry_test {
namespace {

struct PatientOptions {
  double patience = 3;
};

class PatientRadio final : public Radio {
 public:
  void send(const Message&) override {}
  void deliver(Time, RadioNews&) override {}
};

// What a plugin with one radio adds. Its default of 3 must be at least `min`.
KindsByRole with_radio(const std::string& name, double min = 0) {
  KindsByRole kinds;
  kinds.radio.add(
      name, "Patient.",
      scenario::Fields<PatientOptions>().number("patience_s", &PatientOptions::patience,
                                                "How long.", {.at_least = min}),
      [](const PatientOptions& o, const RadioContext&) -> Result<std::unique_ptr<Radio>> {
        if (o.patience > 100) return Error{ErrorCode::kBadInput, "", "too patient.", ""};
        return std::unique_ptr<Radio>(std::make_unique<PatientRadio>());
      });
  return kinds;
}

KindRegistry registry_with(const KindsByRole& more) {
  KindRegistry kinds;
  const auto added = kinds.add(more, "test.so");
  EXPECT_TRUE(added.ok()) << added.error().text();
  return kinds;
}

scenario::ReadOutcome read(const KindRegistry& kinds, const std::string& text) {
  return scenario::read_scenario_text(text, "test", ".", kinds.table());
}

TEST(KindRegistry, PluginsKindsAreChosenAndCheckedLikeOurs) {
  const KindRegistry kinds = registry_with(with_radio("patient"));
  EXPECT_EQ(kinds.plugin_of("radio", "patient"), "test.so");
  EXPECT_EQ(kinds.plugin_of("radio", "ideal"), "");
  EXPECT_NE(scenario::json_schema(kinds.table()).find("patience_s"), std::string::npos);
  EXPECT_NE(scenario::markdown_keys(kinds.table()).find("patience_s"), std::string::npos);

  const auto good = read(kinds, "radio: {kind: patient, patience_s: 5}");
  ASSERT_TRUE(good.ok()) << good.report();
  EXPECT_TRUE(build(*good.scenario, kinds).ok());
  const auto late = read(kinds, "radio: {kind: patient, patience_s: 500}");
  EXPECT_FALSE(build(*late.scenario, kinds).ok());

  const std::string wrong =
      read(kinds, "radio: {kind: patient, patience_s: -5}").report();
  EXPECT_NE(wrong.find("radio.patience_s: -5 must be at least 0"), std::string::npos)
      << wrong;
  const std::string unknown = read(kinds, "radio: patent").report();
  EXPECT_NE(unknown.find("Did you mean \"patient\"?"), std::string::npos) << unknown;
}

// Tasks of one kind under several names, which say nothing but where they are.
template <int kName>
struct NamedWave {
  Vec2 place = Vec2::Zero();
};
constexpr std::string_view kWaveNames[] = {"wave", "orbit",     "route",
                                           "Wave", "two-waves", "two_waves"};
template <int kName>
constexpr auto describe(const NamedWave<kName>*) {
  using T = NamedWave<kName>;
  return described<T>({kWaveNames[kName]}, "Rock the wings.",
                      field("", &T::place, axes::kPlace, "where"));
}
template <int kName>
KindsByRole with_wave() {
  KindsByRole kinds;
  kinds.task.add<NamedWave<kName>>(
      [](const NamedWave<kName>& wave, const TaskContext&) -> TaskKinds::Made {
        if (wave.place.x() > 100)
          return Error{ErrorCode::kBadInput, "", "too far north.", ""};
        return std::unique_ptr<reasoning::TaskExecutor>(
            std::make_unique<reasoning::StayTask>(Loiter{wave.place}));
      });
  return kinds;
}

TEST(KindRegistry, PluginsTasksAreWrittenAndMadeLikeOurs) {
  const KindRegistry kinds = registry_with(with_wave<0>());
  EXPECT_EQ(kinds.plugin_of("task", "wave"), "test.so");
  ASSERT_NE(kinds.table().find("task", "orbit"), nullptr);
  const char* text = "commands: [{at_s: 1, do: \"task uav-1 wave 10,20\"}]";
  const auto good = read(kinds, text);
  ASSERT_TRUE(good.ok()) << good.report();
  EXPECT_TRUE(build(*good.scenario, kinds).ok());
  EXPECT_NE(read(KindRegistry(), text).report().find("\"wave\" is no task"),
            std::string::npos);

  const reasoning::FlightContext flight{EntityId{1}, {}, nullptr, nullptr, 100};
  const TaskOptions options;
  const TaskContext context{flight, options};
  EXPECT_TRUE(kinds.kinds().task.make(as_task(NamedWave<0>{{10, 20}}), context));
  EXPECT_FALSE(kinds.kinds().task.make(as_task(NamedWave<0>{{200, 0}}), context));
  EXPECT_FALSE(KindRegistry().kinds().task.make(as_task(NamedWave<0>{}), context));
  EXPECT_FALSE(kinds.kinds().task.make(FlyRoute{}, context)) << "it has no points";
  EXPECT_TRUE(kinds.kinds().task.make(Hold{}, context));
}

TEST(KindRegistry, WordsForTasksAreTakenOnce) {
  KindRegistry kinds = registry_with(with_wave<0>());
  EXPECT_FALSE(kinds.add(with_wave<0>(), "again.so"));
  EXPECT_FALSE(kinds.add(with_wave<1>(), "orbit.so"));
  EXPECT_FALSE(kinds.add(with_wave<2>(), "route.so")) << "short for fly_route";
  EXPECT_FALSE(kinds.add(with_wave<3>(), "capital.so"));
  EXPECT_FALSE(kinds.add(with_wave<4>(), "hyphen.so"));
  EXPECT_TRUE(kinds.add(with_wave<5>(), "two.so"));
  EXPECT_EQ(kinds.kinds().task.forms()->all().size(),
            message_task_forms().all().size() + 2);
}

// A protocol that adds so many bytes to each message.
struct HeavyOptions {
  int bytes = 10;
};
class HeavyRouting final : public Routing {
 public:
  explicit HeavyRouting(int bytes) : bytes_(static_cast<std::uint32_t>(bytes)) {}
  std::uint32_t head_bytes() const override { return bytes_; }
  void learn(EntityId, EntityId, const RoutedMessage&, Time) override {}
  std::optional<EntityId> next(EntityId, const RoutedMessage& message, const HeardLately&,
                               Time) override {
    return message.to;
  }
  bool failed(EntityId, EntityId) override { return false; }
  double delay(EntityId) override { return 0; }

 private:
  std::uint32_t bytes_;
};

TEST(KindRegistry, APluginsRoutingMustFitIntoTheRadiosParts) {
  KindsByRole more;
  more.routing.add("heavy", "Heavy.",
                   scenario::Fields<HeavyOptions>().integer(
                       "bytes", &HeavyOptions::bytes, "Of its head.", {.at_least = 0}),
                   [](const HeavyOptions& o, const RoutingContext&) {
                     return std::make_unique<HeavyRouting>(o.bytes);
                   });
  const KindRegistry kinds = registry_with(more);
  const auto built = [&](int bytes) {
    const auto outcome =
        read(kinds, fmt::format("radio: {{kind: medium, profile: xbee-digimesh, routing: "
                                "{{kind: heavy, bytes: {}}}}}",
                                bytes));
    EXPECT_TRUE(outcome.ok()) << outcome.report();
    const auto made = build(*outcome.scenario, kinds);
    return made.ok() ? std::string() : made.error().text();
  };
  EXPECT_EQ(built(100), "");
  EXPECT_NE(built(246).find("250"), std::string::npos) << built(246);
}

struct WallOptions {
  double east = 0;
};

// Nothing passes a line from north to south.
class WallPropagation final : public Propagation {
 public:
  explicit WallPropagation(double east) : east_(east) {}
  double received(double radiated, const Vec3& from, const Vec3& to) const override {
    return (from.y() < east_) == (to.y() < east_) ? radiated : 0;
  }

 private:
  double east_;
};

TEST(KindRegistry, RadioFilesNameAPluginsParts) {
  KindsByRole more;
  more.propagation.add(
      "wall", "Wall.",
      scenario::Fields<WallOptions>().number("east_m", &WallOptions::east, "Where.", {}),
      [](const WallOptions& o, const PropagationContext&) {
        return std::make_unique<WallPropagation>(o.east);
      });
  const KindRegistry kinds = registry_with(more);
  const char* text = "propagation: {model: {kind: wall, east_m: 70}}";
  const auto radio = read_radio(text, "x.yaml", kinds.kinds());
  ASSERT_TRUE(radio.ok()) << radio.error().text();
  const auto field = make_propagation(radio.value(), 1);
  ASSERT_TRUE(field.ok());
  EXPECT_EQ(field.value()->received(1, {0, 0, 0}, {0, 60, 0}), 1);
  EXPECT_EQ(field.value()->received(1, {0, 0, 0}, {0, 80, 0}), 0);
  const std::string written = write_radio(radio.value());
  const auto again = read_radio(written, "written", kinds.kinds());
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(write_radio(again.value()), written);
  EXPECT_FALSE(read_radio(text, "x.yaml", own_radio_parts()).ok());
}

TEST(KindRegistry, KnowsARadioProfileInPlaceOfItsKind) {
  const auto outcome = read(KindRegistry(), "radio: n920");
  ASSERT_FALSE(outcome.ok());
  EXPECT_NE(outcome.report().find("{kind: medium, profile: n920}"), std::string::npos)
      << outcome.report();
  EXPECT_EQ(read(KindRegistry(), "radio: n921").report().find("profile"),
            std::string::npos);
}

TEST(KindRegistry, RefusesNamesThatAreTakenOrNoNames) {
  for (const char* name : {"ideal", "", "two words", "Upper", "a_b", "a.b"}) {
    KindRegistry kinds;
    const auto added = kinds.add(with_radio(name), "test.so");
    ASSERT_FALSE(added.ok()) << name;
    EXPECT_EQ(added.error().place, "test.so");
    EXPECT_EQ(kinds.table().names("radio"), KindRegistry().table().names("radio"));
    EXPECT_FALSE(kinds.has_plugin("test.so"));
  }
  KindRegistry kinds = registry_with(with_radio("patient"));
  const auto again = kinds.add(with_radio("patient"), "other.so");
  ASSERT_FALSE(again.ok());
  EXPECT_NE(again.error().text().find("of test.so"), std::string::npos);
}

TEST(KindRegistry, RefusesDefaultsThatTheirOwnKeyForbids) {
  KindRegistry kinds;
  const auto added = kinds.add(with_radio("patient", 10), "test.so");
  ASSERT_FALSE(added.ok());
  EXPECT_NE(added.error().text().find("patience_s"), std::string::npos);
  EXPECT_EQ(kinds.table().find("radio", "patient"), nullptr);
}

// What loading `file` says.
std::string refusal(const std::filesystem::path& file) {
  KindRegistry kinds;
  const auto loaded = load_plugin(file, kinds);
  return loaded.ok() ? "" : loaded.error().text();
}

TEST(LoadPlugin, SaysWhatIsWrongWithTheFile) {
  EXPECT_NE(refusal("/nowhere/x.so").find("No such file"), std::string::npos);
  const auto text = std::filesystem::temp_directory_path() / "skein_no_library.so";
  std::ofstream(text) << "text";
  EXPECT_NE(refusal(text).find("cannot be loaded"), std::string::npos) << refusal(text);
  std::filesystem::remove(text);
}

TEST(LoadPlugin, RefusesPluginsOfOtherHeaders) {
  const std::string said = refusal(SKEIN_FOREIGN_PLUGIN);
  EXPECT_NE(said.find("000000000000"), std::string::npos) << said;
  EXPECT_NE(said.find(kInterfaceHeaders), std::string::npos) << said;
  EXPECT_NE(said.find("Build the plugin anew"), std::string::npos) << said;
}

TEST(LoadPlugin, RefusesOtherSharedLibraries) {
  const std::string said = refusal(SKEIN_OTHER_LIBRARY);
  EXPECT_NE(said.find("no symbol skein_plugin"), std::string::npos) << said;
}

// The scenario's key, with plugins of which some cannot be loaded.
TEST(PluginsOfAScenario, AreLoadedBeforeItsKindsAreRead) {
  KindRegistry kinds;
  std::vector<std::string> asked;
  const auto load = [&](const std::string& file,
                        const scenario::Source&) -> Result<void> {
    asked.push_back(file);
    return kinds.add(with_radio("patient"), file);
  };
  const std::string file = SKEIN_OTHER_LIBRARY;
  const auto good = scenario::read_scenario_text(
      "radio: patient\nplugins: [" + file + "]", "test", ".", kinds.table(), {}, load);
  ASSERT_TRUE(good.ok()) << good.report();
  EXPECT_EQ(asked, std::vector<std::string>{file});
  EXPECT_EQ(good.scenario->plugins, asked);

  const auto refused = scenario::read_scenario_text(
      "name: x\nplugins: ['" + file + "']\nradio: no-such-kind", "test", ".",
      kinds.table(), {},
      [](const std::string& plugin, const scenario::Source&) -> Result<void> {
        return Error{ErrorCode::kBadInput, plugin, "is not good.", ""};
      });
  ASSERT_EQ(refused.problem_count, 1u) << refused.report();
  EXPECT_EQ(refused.problems[0].text(),
            "test:2:11 plugins[0]: " + file + ": is not good.");

  const auto missing = scenario::read_scenario_text("plugins: [nowhere.so]", "test", ".",
                                                    kinds.table(), {}, load);
  ASSERT_EQ(missing.problem_count, 1u) << missing.report();
  EXPECT_NE(missing.report().find("test:1:11 plugins[0]"), std::string::npos);
}

// A library that a scenario names is code: without consent it is not even opened.
TEST(PluginsOfAScenario, NeedConsent) {
  class Asked final : public CodeConsent {
   public:
    Result<void> library(const std::string& file, const scenario::Source& in) override {
      file_ = file;
      text_ = *in.text;
      return Error{ErrorCode::kUnavailable, file, "may not.", ""};
    }
    Result<void> programs(const std::vector<std::vector<std::string>>&,
                          const scenario::Source&) override {
      return {};
    }
    std::string file_, text_;
  };
  KindRegistry kinds;
  const scenario::Source source{
      {}, {}, std::make_shared<const std::string>("the scenario")};
  const auto nobody = load_named_plugin(SKEIN_OTHER_LIBRARY, source, kinds);
  ASSERT_FALSE(nobody);
  EXPECT_NE(nobody.error().message.find("nobody consents"), std::string::npos);
  const auto asked = std::make_shared<Asked>();
  kinds.ask(asked);
  EXPECT_EQ(load_named_plugin(SKEIN_OTHER_LIBRARY, source, kinds).error().message,
            "may not.");
  EXPECT_EQ(asked->file_, std::filesystem::canonical(SKEIN_OTHER_LIBRARY).string());
  EXPECT_EQ(asked->text_, "the scenario");
}

}  // namespace
}  // namespace skein::assemble::kind_registry_test
