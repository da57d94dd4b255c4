// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/radio/radio_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "skein/assemble/radio/antenna_fields.h"
#include "skein/assemble/radio/radio_fields.h"
#include "skein/scenario/text.h"

namespace skein::assemble {
namespace {

// The file as it is written.
struct RadioSections {
  std::string name, description;
  PhySection phy;
  PropagationSection propagation;
  MacSection mac;
  AntennaChoice antenna, station_antenna;
};

scenario::Fields<RadioSections> radio_section_fields() {
  using T = RadioSections;
  return scenario::Fields<T>()
      .text("name", &T::name, "What it is called; empty: as the file.")
      .text("description", &T::description, "One line about it.")
      .object("phy", &T::phy, phy_fields(), "The transceiver.")
      .object("propagation", &T::propagation, propagation_fields(),
              "Signals on their way.")
      .object("mac", &T::mac, mac_fields(), "Access to the medium.")
      .object("antenna", &T::antenna, antenna_fields(),
              "Of aircraft, in the frame of the body; of all nodes of `skein net`, which "
              "are level and point north.")
      .object("station_antenna", &T::station_antenna, antenna_fields(),
              "Of ground stations, which are level and point north.")
      .rule("mac.ack_timeout_us",
            [](const T& t) -> std::string {
              if (t.mac.mac.access != communication::AccessMethod::kDcf) return "";
              const double least = t.mac.sifs_us + t.phy.preamble_header_us;
              return t.mac.ack_timeout_us >= least
                         ? ""
                         : fmt::format(
                               "no answer is there by then: sifs_us and "
                               "phy.preamble_header_us are {} us together.",
                               least);
            })
      .rule("phy.rate_bps",
            [](const T& t) -> std::string {
              // A line has no bit errors.
              if (t.mac.mac.access == communication::AccessMethod::kDirect) return "";
              return rate_violation(t.phy.error_model, error_model_context(t.phy.phy));
            })
      .rule("mac.part_bytes", [](const T& t) -> std::string {
        if (t.mac.mac.access != communication::AccessMethod::kTdma) return "";
        const double bytes =
            (t.mac.slot_us - t.phy.preamble_header_us) * 1e-6 * t.phy.phy.rate / 8 -
            t.mac.mac.data_overhead_bytes;
        return t.mac.mac.part_bytes <= bytes
                   ? ""
                   : fmt::format("a slot of mac.slot_us holds {:.0f} bytes only.",
                                 std::max(0.0, std::floor(bytes)));
      });
}

Result<RadioFile> outcome(const scenario::Reading& reading, const RadioSections& file,
                          const std::string& name, const RadioParts& parts) {
  if (!reading.ok()) {
    std::string report = reading.report();
    report.pop_back();  // the last line feed
    return Error{ErrorCode::kBadInput, "", std::move(report), ""};
  }
  RadioFile radio{.parts = parts,
                  .name = file.name.empty() ? name : file.name,
                  .description = file.description,
                  .radio = {phy_of(file.phy), mac_of(file.mac)},
                  .error_model = file.phy.error_model,
                  .propagation = propagation_of(file.propagation),
                  .antenna = file.antenna,
                  .station_antenna = file.station_antenna};
  const auto refusal = [&name](const char* key, const Error& error) {
    return Error{ErrorCode::kBadInput, fmt::format("{}: {}", name, key), error.message,
                 error.hint};
  };
  auto errors =
      parts.error_model.make(radio.error_model, error_model_context(radio.radio.phy));
  if (!errors) return refusal("phy.error_model", errors.error());
  radio.radio.phy.error_model = std::move(errors).value();
  if (const auto made = make_propagation(radio, 0); !made)
    return refusal("propagation.model", made.error());
  if (const auto made = make_antenna(parts, radio.antenna); !made)
    return refusal("antenna.model", made.error());
  if (const auto made = make_antenna(parts, radio.station_antenna); !made)
    return refusal("station_antenna.model", made.error());
  return radio;
}

}  // namespace

const scenario::Document& radio_document() {
  static const scenario::Document document = {
      radio_section_fields().description(),
      "a radio",
      "Give it sections phy, propagation and mac.",
      "the radio cannot be used",
      "Skein radio",
      "# Keys of a radio file\n\n"
      "Written by the program (`skein keys radio`) from the description that also reads "
      "and checks the files. The unit of a number ends its key.\n\n## Radio\n\n"};
  return document;
}

Result<RadioFile> read_radio(std::string_view text, const std::string& name,
                             const RadioParts& parts) {
  RadioSections file;
  const auto reading = scenario::read_document_text(text, name, {}, radio_document(),
                                                    radio_table(parts), {}, &file);
  return outcome(reading, file, name, parts);
}

Result<RadioFile> load_radio(const std::string& name_or_path,
                             const std::filesystem::path& folder,
                             const RadioParts& parts) {
  if (name_or_path.ends_with(".yaml") || name_or_path.ends_with(".yml")) {
    RadioSections file;
    const auto path = folder / name_or_path;
    const auto reading =
        scenario::read_document(path, radio_document(), radio_table(parts), {}, &file);
    return outcome(reading, file, path.stem().string(), parts);
  }
  std::vector<std::string> names;
  for (const BuiltInRadio& each : built_in_radios()) {
    if (each.name == name_or_path) return read_radio(each.text, name_or_path, parts);
    names.emplace_back(each.name);
  }
  const std::string near = scenario::nearest_name(name_or_path, names);
  return Error{ErrorCode::kNotFound, "",
               fmt::format("there is no radio {}.", scenario::quote(name_or_path)),
               fmt::format("{}Built in: {}. A file's name ends in .yaml.",
                           near.empty() ? "" : fmt::format("Did you mean \"{}\"? ", near),
                           scenario::any_of(names))};
}

std::string write_radio(const RadioFile& radio) {
  RadioSections file;
  file.name = radio.name;
  file.description = radio.description;
  file.phy = section_of(radio.radio.phy, radio.error_model);
  file.propagation = section_of(radio.propagation);
  file.antenna = radio.antenna;
  file.station_antenna = radio.station_antenna;
  file.mac = section_of(radio.radio.mac);
  return scenario::write_document(radio_document(), &file, radio_table(radio.parts));
}

Result<std::unique_ptr<Propagation>> make_propagation(const RadioFile& radio,
                                                      std::uint64_t seed,
                                                      const Terrain* ground) {
  return make_propagation(radio.parts, radio.propagation, radio.radio.phy.frequency, seed,
                          ground);
}

}  // namespace skein::assemble
