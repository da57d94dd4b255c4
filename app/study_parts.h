#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commands.h"
#include "base/result.h"
#include "campaign/batch.h"
#include "record/study_report.h"

namespace skein::app {

// What studies have in common.

/// A shipped scenario: beside the working folder, or beside the program's checkout.
std::filesystem::path shipped_scenario(const std::string& name);

/// Made when there is something to put into it: what is refused leaves nothing behind.
Result<void> make_folder(const std::filesystem::path& folder);

/// On standard output, in columns.
void print_table(const record::StudyTable& table);

/// Says what failed and stores a scenario to replay it; false when nothing did.
bool tell_failures(const std::vector<campaign::BatchItem>& items,
                   const std::vector<campaign::BatchOutcome>& outcomes,
                   const std::filesystem::path& folder);

/// `skein study tuning`; returns the exit status.
int tuning_study(const StudyArguments& arguments, const std::filesystem::path& folder,
                 const std::atomic<bool>& stop);

}  // namespace skein::app
