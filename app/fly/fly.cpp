// SPDX-License-Identifier: Apache-2.0
// skein fly: one fixed wing alone, open loop, from a table of inputs.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <span>
#include <vector>

#include "app/common/commands.h"
#include "app/common/common.h"
#include "app/common/output.h"
#include "skein/assemble/aircraft/aircraft_file.h"
#include "skein/assemble/aircraft/flight_table.h"
#include "skein/base/input_file.h"
#include "skein/base/output_file.h"
#include "skein/layer/asset/fixed_wing/open_loop.h"

namespace skein::app {
namespace {

using assemble::FlightInput;
using assemble::FlightStart;
using assemble::FlightTableReader;

constexpr std::size_t kRowsAtATime = 1024;
constexpr double kMaxSteps = 1e7;  // from one row to the next

asset::Motion motion_at(const FlightStart& start) {
  asset::Motion motion;
  motion.p_N = start.p_N;
  motion.q_NB = geo::from_euler(start.attitude);
  motion.v_N = motion.q_NB * start.v_B;
  motion.w_NB_B = start.w_NB_B;
  return motion;
}

asset::OpenLoopInput to_open_loop(const FlightInput& row) {
  asset::OpenLoopInput input;
  input.t = row.t;
  input.surfaces = {row.aileron, row.elevator, row.rudder};
  input.thrust = row.thrust;
  input.wind_N = row.wind_N;
  return input;
}

std::string header() {
  std::string text;
  for (const auto& columns : {std::span<const std::string_view>(assemble::kInputColumns),
                              std::span<const std::string_view>(assemble::kStateColumns)})
    for (const std::string_view column : columns) text += fmt::format("{},", column);
  return text + "alpha_rad,beta_rad,Va_mps,fx_over_m,fy_over_m,fz_over_m\n";
}

// The shortest numbers that read as the same bits.
void add_row(fmt::memory_buffer& text, const asset::OpenLoopInput& in,
             const asset::OpenLoopOutput& out) {
  const asset::Motion& m = out.motion;
  const Vec3 v_B = m.q_NB.conjugate() * m.v_N;
  const geo::Euler e = geo::to_euler(m.q_NB);
  const Vec3& f = out.specific_force_B;
  const double values[] = {in.t,
                           in.surfaces.elevator,
                           in.surfaces.aileron,
                           in.surfaces.rudder,
                           in.thrust,
                           in.wind_N.x(),
                           in.wind_N.y(),
                           in.wind_N.z(),
                           m.p_N.x(),
                           m.p_N.y(),
                           m.p_N.z(),
                           v_B.x(),
                           v_B.y(),
                           v_B.z(),
                           e.roll,
                           e.pitch,
                           e.yaw,
                           m.w_NB_B.x(),
                           m.w_NB_B.y(),
                           m.w_NB_B.z(),
                           out.alpha,
                           out.beta,
                           out.airspeed,
                           f.x(),
                           f.y(),
                           f.z()};
  for (const double value : values)
    fmt::format_to(std::back_inserter(text), "{},", value);
  text[text.size() - 1] = '\n';
}

bool is_finite(const asset::OpenLoopOutput& out) {
  const asset::Motion& m = out.motion;
  return m.p_N.allFinite() && m.v_N.allFinite() && m.q_NB.coeffs().allFinite() &&
         m.w_NB_B.allFinite() && std::isfinite(out.airspeed) &&
         out.specific_force_B.allFinite();
}

// Where rows go: a file, or standard output.
class RowSink {
 public:
  /// @param path  - = standard output.
  Result<void> open(const std::string& path) {
    if (path == "-") return {};
    auto opened = OutputStream::open(path);
    if (!opened) return opened.error();
    file_ = std::move(opened).value();
    return {};
  }

  Result<void> put(std::string_view text) {
    if (!file_.is_open()) {
      put_out(text);
      return {};
    }
    file_.write(text);
    return file_.flush();
  }
  Result<void> close() { return file_.flush(); }

 private:
  OutputStream file_;  // closed: standard output
};

// Flies a table from row to row. Rows are held in parts, so a table may be of any length.
class TableFlight {
 public:
  TableFlight(const asset::FixedWingModel& model, const asset::OpenLoopOptions& options,
              FlightTableReader& table, RowSink& sink)
      : model_(model), options_(options), table_(table), sink_(sink) {}

  // Whatever ends the flight early, the rows before it are written.
  Result<void> fly(const std::atomic<bool>& stop) {
    const Result<FlightInput> first = table_.first();
    if (!first) return first.error();
    inputs_ = {to_open_loop(first.value())};
    motion_ = motion_at(table_.start());
    if (auto put = sink_.put(header()); !put) return put;
    bool at_start = true, more = true;
    while (more && !stop) {
      const Result<bool> read = read_part();
      if (auto flown = fly_part(at_start); !flown) return flown;
      if (!read) return read.error();
      more = read.value();
      at_start = false;
    }
    if (stop) return Error{ErrorCode::kInterrupted, "", "stopped.", ""};
    return {};
  }

 private:
  // Adds rows behind the last one flown; false at the end of the table.
  Result<bool> read_part() {
    double steps = 0;
    while (inputs_.size() < kRowsAtATime && steps < kMaxSteps / 10) {
      const auto row = table_.next();
      if (!row) return row.error();
      if (!row.value()) return false;
      const double more = (row.value()->t - inputs_.back().t) / options_.longest_step;
      if (more > kMaxSteps)
        return Error{ErrorCode::kBadInput,
                     fmt::format("{}:{}:t", table_.name(), table_.line()),
                     fmt::format("found {}; {:.3g} integration steps behind {}, that of "
                                 "the row before; at most {:.0e}.",
                                 row.value()->t, more, inputs_.back().t, kMaxSteps),
                     "Give rows between, or a longer --step."};
      steps += more;
      inputs_.push_back(to_open_loop(*row.value()));
    }
    return true;
  }

  Result<void> fly_part(bool at_start) {
    const auto outputs = asset::fly_open_loop(model_, motion_, inputs_, options_);
    text_.clear();
    for (std::size_t i = at_start ? 0 : 1; i < outputs.size(); ++i) {
      if (!is_finite(outputs[i])) {
        if (auto put = sink_.put({text_.data(), text_.size()}); !put) return put;
        return lost(i, outputs);
      }
      add_row(text_, inputs_[i], outputs[i]);
    }
    motion_ = outputs.back().motion;
    inputs_.erase(inputs_.begin(), inputs_.end() - 1);
    return sink_.put({text_.data(), text_.size()});
  }

  // The motion left the numbers before row i.
  Error lost(std::size_t i, const std::vector<asset::OpenLoopOutput>& outputs) const {
    if (i == 0)
      return Error{ErrorCode::kBadInput, table_.name(),
                   "the initial state has no finite acceleration.", ""};
    const asset::OpenLoopOutput& last = outputs[i - 1];
    const asset::Motion& m = last.motion;
    return Error{
        ErrorCode::kBadInput, table_.name(),
        fmt::format(
            "the motion is not finite any more at t = {} s. At {} s the aircraft "
            "was at north {:.6g}, east {:.6g}, down {:.6g} m with airspeed {:.6g} "
            "m/s, alpha {:.4g}, beta {:.4g} rad, rates {:.4g}, {:.4g}, {:.4g} "
            "rad/s.",
            inputs_[i].t, inputs_[i - 1].t, m.p_N.x(), m.p_N.y(), m.p_N.z(),
            last.airspeed, last.alpha, last.beta, m.w_NB_B.x(), m.w_NB_B.y(),
            m.w_NB_B.z()),
        "Is the step too long, a deflection too large?"};
  }

  const asset::FixedWingModel& model_;
  const asset::OpenLoopOptions& options_;
  FlightTableReader& table_;
  RowSink& sink_;
  std::vector<asset::OpenLoopInput> inputs_;  // the first is where motion_ stands
  asset::Motion motion_;
  fmt::memory_buffer text_;
};

bool same_file(const std::string& a, const std::string& b) {
  std::error_code none;
  return a != "-" && b != "-" && std::filesystem::equivalent(a, b, none);
}

}  // namespace

int fly_command(const FlyArguments& arguments, const std::atomic<bool>& stop) {
  if (arguments.input.empty()) {
    complain("--input is required, or --trim.\nRun with --help for more information.\n");
    return kBadUsage;
  }
  const auto aircraft = load_fixed_wing(arguments.aircraft);
  if (!aircraft) return say_error(aircraft.error());
  const asset::FixedWingModel model(aircraft.value());
  if (same_file(arguments.input, arguments.output)) {
    complain("error: {}: is the input as well as the output.\n", arguments.input);
    return kBadUsage;
  }
  std::ifstream file;
  const bool standard_input = arguments.input == "-";
  if (!standard_input) {
    auto opened = open_input(arguments.input);
    if (!opened) return say_error(opened.error());
    file = std::move(opened).value();
  }
  FlightTableReader table(standard_input ? std::cin : file,
                          standard_input ? "standard input" : arguments.input);
  RowSink sink;
  if (auto opened = sink.open(arguments.output); !opened)
    return say_error(opened.error());
  asset::OpenLoopOptions options;
  options.longest_step = arguments.step;
  if (arguments.planet_radius > 0) options.planet_radius = arguments.planet_radius;
  const Result<void> flown = TableFlight(model, options, table, sink).fly(stop);
  const Result<void> closed = sink.close();
  if (!flown && flown.error().code == ErrorCode::kInterrupted) return kInterrupted;
  if (!flown) return say_error(flown.error());
  return closed ? kDone : say_error(closed.error());
}

}  // namespace skein::app
