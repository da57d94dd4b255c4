// SPDX-License-Identifier: Apache-2.0
// Study of the measurement updates of estimators, alone.

#include <fstream>
#include <iostream>
#include <sstream>

#include "app/common/common.h"
#include "app/common/output.h"
#include "app/common/version.h"
#include "app/study/particle_update.h"
#include "app/study/parts.h"
#include "skein/base/input_file.h"
#include "skein/base/output_file.h"
#include "skein/campaign/batch/study_summary.h"
#include "skein/campaign/estimators/estimators_csv.h"
#include "skein/campaign/estimators/estimators_report.h"
#include "skein/campaign/estimators/estimators_study.h"
#include "skein/record/report/study_report.h"

namespace skein::app {
namespace {

namespace fs = std::filesystem;

int evaluate_rows(const std::string& file,
                  std::vector<Error> (*evaluate)(std::string_view, const std::string&,
                                                 std::ostream&)) {
  const bool is_stdin = file == "-";
  const auto text = read_file(is_stdin ? "/dev/stdin" : file);
  if (!text) return say_error(text.error());
  const auto problems = evaluate(text.value(), is_stdin ? "stdin" : file, std::cout);
  for (const Error& problem : problems) complain("{}\n", problem.text());
  return problems.empty() ? kDone : kBadUsage;
}

}  // namespace

int estimators_study(const StudyArguments& arguments, assemble::KindRegistry&,
                     const fs::path& folder, const std::atomic<bool>&) {
  if (!arguments.cases_file.empty())
    return evaluate_rows(arguments.cases_file, campaign::evaluate_cases);
  if (!arguments.updates_file.empty())
    return evaluate_rows(arguments.updates_file, campaign::evaluate_updates);
  if (auto made = make_folder(folder); !made) return say_error(made.error());
  campaign::EstimatorsStudyOptions options;
  options.more = {{"particle", particle_update}};
  const auto tables = campaign::estimators_study(options);
  for (const campaign::CurveTable& table : tables) {
    std::ostringstream csv;
    campaign::write_csv(table, csv);
    if (auto written = write_file(folder / (table.name + ".csv"), csv.str()); !written)
      return say_error(written.error());
  }
  if (auto written = record::write_study_report(
          campaign::estimators_report(tables, options.sigma), folder / "report.html");
      !written)
    return say_error(written.error());
  if (auto written = campaign::write_study_summary(
          "estimators", kVersion, "complete", campaign::study_figures(tables), folder);
      !written)
    return say_error(written.error());
  print("Written: {}  summary.json  and one CSV per figure\n",
        (folder / "report.html").string());
  return kDone;
}

}  // namespace skein::app
