// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/campaign/campaign_file.h"

#include <algorithm>
#include <set>
#include <utility>

#include "skein/scenario/fields.h"

namespace skein::campaign {
namespace {

using scenario::Fields;
using scenario::RuleViolation;

// Names are parts of file names, of keys and of lines of CSV.
bool is_plain(const std::string& name) {
  return !name.empty() && std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c < 0x20 || c == '/' || c == ',' || c == '"';
  });
}

std::string name_error(const std::string& name) {
  return is_plain(name) ? std::string()
                        : std::string("must be a name without / , \" and line feeds.");
}

// Variants are chosen by their names alone.
std::string axes_error(const std::vector<Axis>& axes) {
  std::set<std::string> names, variants;
  for (const Axis& axis : axes) {
    if (!names.insert(axis.name).second) return "two are called " + axis.name + ".";
    for (const Variant& each : axis.variants)
      if (!variants.insert(each.name).second)
        return "two variants are called " + each.name + ".";
  }
  return {};
}

Fields<Variant> variant_fields() {
  using T = Variant;
  return Fields<T>()
      .text("name", &T::name, "What it is called in tables.")
      .required()
      .text("help", &T::help, "What it is; shown in the report.")
      .text("set", &T::overrides, "Changes to the scenario, each KEY=VALUE.")
      .rule("name", [](const T& variant) { return name_error(variant.name); });
}

Fields<Axis> axis_fields() {
  using T = Axis;
  return Fields<T>()
      .text("name", &T::name, "What it is called: heading of its column.")
      .required()
      .object("variants", &T::variants, variant_fields(), "What it can be.")
      .items({.at_least = 1, .at_most = 1000})
      .required()
      .rule("name", [](const T& axis) { return name_error(axis.name); });
}

Fields<DrawnKey> drawn_key_fields() {
  using T = DrawnKey;
  return Fields<T>()
      .text("key", &T::key, "Key of the scenario, such as environment.wind.from_deg.")
      .required()
      .number("between", &T::between, "Two numbers: evenly between them.")
      .items({.at_most = 2})
      .text("among", &T::among, "Values, each as likely as the others.")
      .items({.at_most = 10000})
      .rules([](const T& draw) {
        std::vector<RuleViolation> found;
        if (draw.key == "seed")
          found.push_back({"key", "is what the draws follow from; see first_seed."});
        else if (draw.between.empty() == draw.among.empty())
          found.push_back({"key", "needs either between or among."});
        else if (draw.among.empty() &&
                 (draw.between.size() != 2 || draw.between[0] >= draw.between[1]))
          found.push_back({"between", "must be two numbers, the smaller one first."});
        return found;
      });
}

Fields<CampaignFigure> figure_fields() {
  using T = CampaignFigure;
  return Fields<T>()
      .text("figure", &T::figure, "Its name in the runs' summary.json.")
      .required()
      .text("heading", &T::heading, "Of its column, with unit; empty: the name.")
      .integer("digits", &T::digits, "Behind the point.", {.at_least = 0, .at_most = 9})
      .word("extreme", &T::extreme, "Which run is shown besides the mean.",
            {{"none", Extreme::kNone, "none"},
             {"least", Extreme::kLeast, "the one with the least"},
             {"most", Extreme::kMost, "the one with the most"}});
}

Fields<CampaignFile> campaign_fields() {
  using T = CampaignFile;
  return Fields<T>()
      .text("name", &T::name, "What it is called: of its folder and its report.")
      .required()
      .text("about", &T::about, "Paragraphs at the head of the report.")
      .file("scenario", &T::scenario, "The scenario that is flown.")
      .required()
      .text("set", &T::overrides, "Changes to it for all runs, each KEY=VALUE.")
      .integer("seeds", &T::seeds, "Runs of every combination.",
               {.at_least = 1, .at_most = 10000})
      .integer("first_seed", &T::first_seed, "The first run's; then one more each.",
               {.at_least = 0, .at_most = 1000000000})
      .object("axes", &T::axes, axis_fields(),
              "What is varied on purpose, in every combination.")
      .items({.at_most = 3})
      .object("draws", &T::draws, drawn_key_fields(), "What every run draws by its seed.")
      .object("figures", &T::figures, figure_fields(), "What the report is about.")
      .items({.at_least = 1, .at_most = 100})
      .required()
      .rule("name", [](const T& file) { return name_error(file.name); })
      .rule("axes", [](const T& file) { return axes_error(file.axes); });
}

Result<CampaignFile> outcome(const scenario::Reading& reading, CampaignFile file) {
  file.source = reading.source;
  if (reading.ok()) return file;
  std::string report = reading.report();
  report.pop_back();  // the last line feed
  return Error{ErrorCode::kBadInput, "", std::move(report), ""};
}

}  // namespace

const scenario::Document& campaign_document() {
  static const scenario::Document document = {
      campaign_fields().description(),
      "a campaign",
      "Give it a name, a scenario and figures.",
      "nothing was run",
      "Skein campaign",
      "# Keys of a campaign file\n\n"
      "Written by the program (`skein keys campaign`) from the description that also "
      "reads and checks the files.\n\n## Campaign\n\n"};
  return document;
}

Result<CampaignFile> read_campaign(const std::filesystem::path& path) {
  CampaignFile file;
  const auto reading = scenario::read_document(path, campaign_document(),
                                               scenario::KindTable{}, {}, &file);
  return outcome(reading, std::move(file));
}

Result<CampaignFile> read_campaign_text(std::string_view text, const std::string& name,
                                        const std::filesystem::path& folder) {
  CampaignFile file;
  const auto reading = scenario::read_document_text(
      text, name, folder, campaign_document(), scenario::KindTable{}, {}, &file);
  return outcome(reading, std::move(file));
}

}  // namespace skein::campaign
