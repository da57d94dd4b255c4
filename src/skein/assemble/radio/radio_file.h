// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "skein/assemble/radio/radio_parts.h"
#include "skein/base/result.h"
#include "skein/layer/communication/medium/radio_profile.h"
#include "skein/scenario/document.h"

namespace skein::assemble {

/// A kind of radio as its file describes it; docs/network.md.
struct RadioFile {
  RadioParts parts;  ///< that it was read with
  std::string name;
  std::string description;            ///< one line
  communication::RadioProfile radio;  ///< with its error model
  scenario::Choice error_model{"dsss-2"};
  PropagationChoice propagation;
  AntennaChoice antenna;          ///< of aircraft, and of nodes
  AntennaChoice station_antenna;  ///< of ground stations
};

/// A radio file that is part of the program.
struct BuiltInRadio {
  std::string_view name;  ///< of the file, without its ending
  std::string_view text;
};

/// All of them, by name.
std::span<const BuiltInRadio> built_in_radios();

/// A radio by the name of a built-in one, or by the path of a file that ends in .yaml or
/// .yml.
///
/// @param folder  where a relative path starts.
/// @param parts   that it may name
/// Fails: no such radio or file; parts that cannot be made; everything that is wrong with
///        the file, in one message of several lines.
Result<RadioFile> load_radio(const std::string& name_or_path,
                             const std::filesystem::path& folder,
                             const RadioParts& parts);

/// A radio from the text of a file, which messages call `name`.
Result<RadioFile> read_radio(std::string_view text, const std::string& name,
                             const RadioParts& parts);

/// The radio as a file with every key written out; reading that gives the same.
std::string write_radio(const RadioFile& radio);

/// Signals on their way, its obstacles included.
/// @param seed, ground  PropagationContext
/// Fails: as its kind, which was made once when the file was read.
Result<std::unique_ptr<Propagation>> make_propagation(const RadioFile& radio,
                                                      std::uint64_t seed,
                                                      const Terrain* ground = nullptr);

/// What radio files look like, for their JSON Schema and documentation.
const scenario::Document& radio_document();

}  // namespace skein::assemble
