// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <map>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>

#include "skein/base/hash.h"
#include "skein/base/input_file.h"
#include "skein/base/log.h"
#include "skein/base/output_file.h"

namespace skein::campaign {
namespace {

using nlohmann::json;

std::string fingerprint(const BatchItem& item, const std::string& program) {
  Hasher hasher;
  hasher.add(program);
  hasher.add(item.text);
  hasher.add(item.data);
  return hasher.hex();
}

std::string to_line(const BatchItem& item, const std::string& print,
                    const record::RunSummary& summary) {
  json line;
  line["name"] = item.name;
  line["fingerprint"] = print;
  line["version"] = summary.version;
  line["scenario"] = summary.name;
  line["seed"] = summary.seed;
  line["content_hash"] = summary.content_hash;
  json numbers = json::object();  // JSON has no others than finite ones
  for (const auto& [name, value] : summary.numbers)
    if (std::isfinite(value)) numbers[name] = value;
  line["numbers"] = std::move(numbers);
  line["warnings"] = summary.warnings;
  return line.dump(-1, ' ', false, json::error_handler_t::replace);
}

constexpr std::size_t kLongestLine = 4 << 20;  // of a journal [bytes]

// The next line, or as much of it as a journal has; false at the end.
bool next_line(std::istream& in, std::string& line) {
  line.clear();
  for (char c = 0; in.get(c);) {
    if (c == '\n') return true;
    if (line.size() <= kLongestLine) line += c;
  }
  return !line.empty();
}

struct Journal {
  std::map<std::string, record::RunSummary> found;  // by fingerprint
  int damaged = 0;                                  // lines, without the last
  bool ends_with_line = true;
};

// Results of earlier runs. A line that was cut off by a kill is skipped.
Result<Journal> read_journal(const std::filesystem::path& file) {
  Journal journal;
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return journal;
  if (!std::filesystem::is_regular_file(file, none))
    return Error{ErrorCode::kBadInput, file.string(), "is no regular file.",
                 "Choose another folder."};
  auto& found = journal.found;
  auto opened = open_input(file);
  if (!opened) return opened.error();
  std::istream& in = opened.value();
  bool last_was_good = true;
  for (std::string text; next_line(in, text);) {
    journal.damaged += last_was_good ? 0 : 1;
    last_was_good = false;
    journal.ends_with_line = !in.eof();
    if (text.size() > kLongestLine) continue;
    const json line = json::parse(text, nullptr, false);
    if (line.is_discarded() || !line.is_object()) continue;
    try {
      record::RunSummary summary;
      summary.version = line.at("version");
      summary.name = line.at("scenario");
      summary.seed = line.at("seed");
      summary.content_hash = line.at("content_hash");
      summary.numbers = line.at("numbers").get<std::map<std::string, double>>();
      summary.warnings = line.at("warnings").get<std::vector<std::string>>();
      const bool finite = std::ranges::all_of(summary.numbers, [](const auto& figure) {
        return std::isfinite(figure.second);
      });
      if (!finite) continue;
      found[line.at("fingerprint")] = std::move(summary);
      last_was_good = true;
    } catch (const json::exception&) {
      continue;  // not a line of ours
    }
  }
  // Without an end the last was cut off by a kill.
  if (!last_was_good && journal.ends_with_line) ++journal.damaged;
  if (journal.damaged > 0)
    log_warning("{}: {} lines are not those of a run; what they said is computed again.",
                file.string(), journal.damaged);
  return journal;
}

BatchOutcome run_one(const BatchItem& item, const RunScenario& run) {
  BatchOutcome outcome;
  try {
    auto result = run(item);
    if (result.ok())
      outcome.summary = std::move(result).value();
    else if (result.error().code != ErrorCode::kInterrupted)
      outcome.error = result.error().text();
  } catch (const std::bad_alloc&) {
    outcome.error = "not enough memory.";
  } catch (const std::exception& error) {
    outcome.error = internal_error(error.what()).text();  // the batch goes on
  }
  return outcome;
}

void log_outcome(const std::string& name, const BatchOutcome& outcome) {
  if (outcome.summary)
    log_info("{}: done in {:.1f} s, content hash {}", name,
             outcome.summary->number("wall_s").value_or(0),
             outcome.summary->content_hash);
  else if (!outcome.error.empty())
    log_info("{}: failed: {}", name, outcome.error);
}

}  // namespace

Result<std::vector<BatchOutcome>> run_batch(std::span<const BatchItem> items,
                                            const RunScenario& run,
                                            const BatchOptions& options) {
  std::vector<BatchOutcome> outcomes(items.size());
  std::vector<std::size_t> open;
  std::vector<std::string> prints;
  const auto journal_read = read_journal(options.journal);
  if (!journal_read) return journal_read.error();
  const auto& earlier = journal_read.value().found;
  for (std::size_t i = 0; i < items.size(); ++i) {
    prints.push_back(fingerprint(items[i], options.program));
    if (const auto found = earlier.find(prints[i]); found != earlier.end())
      outcomes[i].summary = found->second;
    else
      open.push_back(i);
  }

  auto opened = OutputStream::append(options.journal);
  if (!opened) return opened.error();
  OutputStream& journal = opened.value();
  // What comes now is no part of a line that was cut off.
  if (!journal_read.value().ends_with_line) journal.write("\n");
  Result<void> written = journal.flush();
  std::atomic<bool> lost{!written};  // there is no use in runs whose results are lost
  std::mutex mutex;                  // guards the journal, the progress and `done`
  std::atomic<std::size_t> next{0};
  std::size_t done = items.size() - open.size();
  if (options.progress) options.progress(done, items.size());

  const auto work = [&] {
    for (;;) {
      const std::size_t k = next++;
      if (k >= open.size() || lost || (options.stop && *options.stop)) return;
      const std::size_t i = open[k];
      BatchOutcome outcome = run_one(items[i], run);
      log_outcome(items[i].name, outcome);
      const std::lock_guard lock(mutex);
      if (outcome.summary) {
        journal.write(to_line(items[i], prints[i], *outcome.summary) + "\n");
        if (auto put = journal.flush(); !put) {
          written = put;
          lost = true;
        }
      }
      outcomes[i] = std::move(outcome);
      ++done;
      if (options.progress) options.progress(done, items.size());
    }
  };
  std::vector<std::thread> workers;
  for (int t = 1; t < options.threads; ++t) workers.emplace_back(work);
  work();
  for (std::thread& worker : workers) worker.join();

  if (!written) return written.error();
  return outcomes;
}

MeanInterval mean_interval(std::span<const double> values) {
  // Student's t for 95 %, by degrees of freedom 1 to 30; beyond that 1.96 is within 4 %.
  static constexpr double kT[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                  2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                  2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                  2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
  MeanInterval result;
  result.count = static_cast<int>(values.size());
  if (values.empty()) return result;
  const double n = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / n;
  if (values.size() < 2) return result;
  double squares = 0;
  for (const double value : values)
    squares += (value - result.mean) * (value - result.mean);
  const std::size_t freedom = values.size() - 1;
  const double t = freedom <= std::size(kT) ? kT[freedom - 1] : 1.96;
  result.half_width = t * std::sqrt(squares / (n - 1) / n);
  return result;
}

}  // namespace skein::campaign
