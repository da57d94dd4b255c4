// SPDX-License-Identifier: Apache-2.0
#include "skein/record/report/report.h"
#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "app/serve/pack_run.h"

namespace skein::app {

int report_command(const std::vector<std::filesystem::path>& runs,
                   const std::filesystem::path& out) {
  for (const std::filesystem::path& run : runs)
    if (auto good = check_records(run); !good) return say_error(good.error());
  const std::filesystem::path page = out.empty() ? runs.front() / "report.html" : out;
  if (auto written = record::write_report(runs, page, serve::report_map); !written)
    return say_error(written.error());
  print("Written: {}\n", page.string());
  return kDone;
}

}  // namespace skein::app
