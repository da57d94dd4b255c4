#include "app/study_parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "app/common.h"
#include "app/output.h"

namespace skein::app {

namespace fs = std::filesystem;

fs::path shipped_scenario(const std::string& name) {
  const fs::path here = fs::path("scenarios") / name;
  std::error_code fault;
  if (fs::exists(here, fault)) return here;
  const fs::path program = fs::read_symlink("/proc/self/exe", fault);
  return program.parent_path().parent_path().parent_path() / "scenarios" / name;
}

Result<void> make_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (!fault) return {};
  return Error{ErrorCode::kUnavailable, folder.string(),
               "cannot be made: " + fault.message() + ".", ""};
}

namespace {

std::string cell_text(const record::StudyCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell.value)) return *text;
  const double number = std::get<double>(cell.value);
  return std::isnan(number) ? "-" : fmt::format("{:.3g}", number);
}

}  // namespace

void print_table(const record::StudyTable& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& row : table.rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] = std::max(widths[c], cell_text(row[c]).size());
  print("\n{}\n", table.title);
  for (std::size_t c = 0; c < widths.size(); ++c)
    print("{:<{}}  ", table.columns[c], widths[c]);
  print("\n");
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c)
      print("{:<{}}  ", cell_text(row[c]), widths[c]);
    print("\n");
  }
}

bool tell_failures(const std::vector<campaign::BatchItem>& items,
                   const std::vector<campaign::BatchOutcome>& outcomes,
                   const fs::path& folder) {
  bool failed = false;
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (!outcomes[i].error.empty()) {
      failed = true;
      const fs::path replay = folder / ("failed-" + folder_name(items[i].name) + ".yaml");
      complain("{}: {}\n", items[i].name, outcomes[i].error);
      if (write_text(replay, items[i].text))
        complain("Replay: skein run {}\n", replay.string());
    }
  return failed;
}

}  // namespace skein::app
