// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/recorded/perimeter.h"

namespace skein::environment {

/// An attribute of a feature; those without a value are left out.
struct Attribute {
  std::string name;
  std::string
      text;  ///< numbers and dates too; dates in ISO 8601, with zone if it is known
};

/// A feature as its file has it.
struct VectorFeature {
  RawPerimeter outline;  ///< degrees; `time` is not set
  std::string layer;     ///< its name
  std::vector<Attribute> attributes;
};

/// Reads vector datasets one after the other. Shapefiles that share the text of their
/// .prj file share its interpretation, which takes far longer than all else (about 0.2
/// s).
class VectorReader {
 public:
  VectorReader();
  ~VectorReader();

  /// All features of all layers of a dataset.
  /// Fails: as read_perimeters().
  Result<std::vector<VectorFeature>> read(const std::string& name,
                                          std::vector<std::string>& warnings);

 private:
  struct Systems;
  std::unique_ptr<Systems> systems_;
};

}  // namespace skein::environment
