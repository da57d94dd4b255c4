#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/layer/environment/recorded/perimeter.h"

namespace skein::environment {

/// A feature's outline and time as its file has them.
struct VectorFeature {
  RawPerimeter outline;          ///< degrees; `time` is not set
  std::optional<double> number;  ///< time attribute: a number
  std::optional<double> utc;     ///< time attribute: a date and time, [s] since 1970 UTC
};

/// Reads vector datasets one after the other. Shapefiles that share the text of their
/// .prj file share its interpretation, which takes far longer than all else (about 0.2
/// s).
class VectorReader {
 public:
  VectorReader();
  ~VectorReader();

  /// All features of all layers of a dataset.
  /// @param time_field  attribute with the time; empty: the first known one; see
  ///                    read_perimeters().
  /// @param need_time   whether a feature without a time is an error.
  /// Fails: as read_perimeters().
  Result<std::vector<VectorFeature>> read(const std::string& name,
                                          const std::string& time_field, bool need_time,
                                          std::vector<std::string>& warnings);

 private:
  struct Systems;
  std::unique_ptr<Systems> systems_;
};

/// The names a time is looked for under, in this order.
const std::vector<std::string>& time_names();

}  // namespace skein::environment
