// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skein/scenario/kind_table.h"
#include "skein/scenario/override.h"
#include "skein/scenario/places.h"
#include "skein/scenario/problem.h"
#include "skein/scenario/source.h"
#include "skein/scenario/type.h"

namespace skein::scenario {

struct Folders;
struct Node;

/// A kind of YAML file: its keys, and how messages and documentation speak of it.
struct Document {
  ObjectPtr keys;           ///< of the struct that such a file is read into
  std::string name;         ///< with its article: "a scenario"
  std::string empty_hint;   ///< what mends an empty file
  std::string consequence;  ///< of problems, ends their report: "nothing was run"
  std::string title;        ///< of the JSON Schema
  std::string preface;      ///< of the documentation of its keys, Markdown
  /// What must be done with the file, changed by overrides, before its keys are read;
  /// false: they are not. May be empty.
  std::function<bool(const Node&, const Folders&, Problems&)> prepare = {};
  /// Places of such a file besides local metres. May be empty: there are none.
  std::function<Places(const Node& root, const KindTable& kinds)> places = {};
  /// The file is only to be described: kinds and files that are not here stay names.
  bool says_only = false;
};

/// Everything that is wrong with a file.
struct Reading {
  std::vector<Problem> problems;  ///< in the order of their places; 1000 at most
  std::size_t problem_count = 0;  ///< all of them
  std::string consequence;        ///< see Document
  Source source;                  ///< what was read
  std::vector<Rename> renames;    ///< names that have changed since it was written

  bool ok() const { return problem_count == 0; }
  /// One line per problem and "2 problems; nothing was run."; empty when there is none.
  std::string report() const;
};

/// Reads a file into a struct. Every key that is not given keeps the value that stands
/// there; every option of every choice is filled in; every file path is absolute.
///
/// @param overrides  changes from outside, applied in their order; paths in them are
///                   relative to their folder.
/// @param target     a struct as `document.keys` describes, with its defaults. Where
///                   there are problems it holds something harmless.
/// Never throws for what a file holds. A 10 MB file takes a few seconds.
Reading read_document(const std::filesystem::path& path, const Document& document,
                      const KindTable& kinds, std::span<const Override> overrides,
                      void* target);

/// A file that has been read, and the map files that it names, for those who read it
/// again and again with other overrides.
struct OpenedDocument {
  std::string name;                  ///< what messages call it
  Source source;                     ///< without a text when it could not be read
  std::string failure;               ///< why; empty: it was read
  std::shared_ptr<const Node> root;  ///< null: not well formed
  std::shared_ptr<FeatureMemory> features;
};
OpenedDocument open_document(const std::filesystem::path& path, const Document& document);
/// Parses it, so that reading it does not, and lets it keep map files.
void keep_parsed(OpenedDocument& file, const Document& document);

/// As read_document() of the file at the time at which it was opened. By one thread at a
/// time.
Reading read_document(const OpenedDocument& file, const Document& document,
                      const KindTable& kinds, std::span<const Override> overrides,
                      void* target);

/// The same of a text, for callers that have one.
///
/// @param name    what messages call it.
/// @param folder  where relative paths in it start.
Reading read_document_text(std::string_view text, const std::string& name,
                           const std::filesystem::path& folder, const Document& document,
                           const KindTable& kinds, std::span<const Override> overrides,
                           void* target);

/// The struct as a YAML file with every key written out. Reading that gives an equal
/// struct, bit by bit, when this one came from reading.
std::string write_document(const Document& document, const void* value,
                           const KindTable& kinds);

}  // namespace skein::scenario
