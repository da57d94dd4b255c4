// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/network/network_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <unordered_set>

#include "skein/base/csv.h"

namespace skein::exchange {
namespace {

constexpr double kMaxNodePlace = 1e7;    // [m]
constexpr double kMaxNodePower = 100;    // [dBm]
constexpr double kMaxNetworkTime = 4e6;  // [s]
constexpr std::size_t kMaxNodes = 100'000;
constexpr std::uint64_t kMaxNodeNumber = 4'000'000'000;
constexpr std::uint64_t kMaxPacketBytes = 65'000;
constexpr std::uint64_t kMaxFlowDepth = 100'000;
constexpr std::uint64_t kMaxMessageNumber = 1'000'000'000'000'000;

// Nodes by their numbers, so that they can be put in order.
using NumberedNodes = std::map<std::uint32_t, NodeTrack>;

Result<void> take_nodes(NumberedNodes&& nodes, const std::string& place,
                        NetworkCase& network) {
  if (nodes.empty()) return Error{ErrorCode::kBadInput, place, "there is no node.", ""};
  network.names.clear();
  network.nodes.clear();
  for (auto& [name, track] : nodes) {
    network.names.push_back(name);
    network.nodes.push_back(std::move(track));
  }
  return {};
}

std::optional<std::uint32_t> place_of(const NetworkCase& network, std::uint64_t name) {
  const auto at = std::lower_bound(network.names.begin(), network.names.end(), name);
  if (at == network.names.end() || *at != name) return std::nullopt;
  return static_cast<std::uint32_t>(at - network.names.begin());
}

// The place of a node in the case that a cell names; none, reported, where there is none.
std::optional<std::uint32_t> node_in(CsvRow& row, std::string_view column,
                                     const NetworkCase& network) {
  const auto name = row.whole(column, kMaxNodeNumber);
  if (!name) return std::nullopt;
  const auto place = place_of(network, *name);
  if (!place) row.report(column, fmt::format("there is no node {}.", *name));
  return place;
}

// The words of an ns-2 line; brackets, quotation marks and dollar signs are no words.
std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBetween = " \t\r\"()$";
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(kBetween);
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBetween), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<double> within(std::string_view word, double least, double most) {
  const auto value = number_in(word);
  return value && *value >= least && *value <= most ? value : std::nullopt;
}

std::optional<std::uint32_t> node_number(std::string_view word) {
  std::uint32_t number = 0;
  const auto [rest, error] =
      std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || rest != word.data() + word.size()) return std::nullopt;
  return number;
}

class Ns2Reader {
 public:
  Result<void> take_line(std::string_view line, const std::string& here) {
    const auto words = words_of(line);
    if (words.empty() || words[0].starts_with('#')) return {};
    const auto wrong = [&](std::string_view message) {
      return Error{ErrorCode::kBadInput, here, std::string(message),
                   "Known are $node_(N) set X_ m, Y_ and Z_, the same and setdest X Y "
                   "SPEED as $ns_ at T \"$node_(N) ...\", and $god_, which is skipped."};
    };
    const bool timed = words[0] == "ns_";
    const std::size_t at = timed ? 3 : 0;
    // Distances in hops, which setdest computes and which follow from the places.
    if (words.size() > at && words[at] == "god_") return {};
    if (words.size() <= at + 2 || words[at] != "node_" || (timed && words[1] != "at"))
      return wrong("this line is not understood.");
    const auto node = node_number(words[at + 1]);
    if (!node) return wrong("the number of the node is none.");
    if (nodes_.size() >= kMaxNodes && !nodes_.contains(*node))
      return wrong("there are too many nodes.");
    if (timed && words[5] == "set") return jump(words, *node, wrong);
    if (timed) return set_destination(words, *node, wrong);
    return set_place(words, *node, wrong);
  }

  NumberedNodes&& finish() {
    for (auto& [number, node] : nodes_) settle(node, std::nullopt);
    for (auto& [number, node] : nodes_) tracks_[number] = std::move(node.track);
    return std::move(tracks_);
  }

 private:
  struct Moving {
    NodeTrack track;
    std::optional<NodeTrack::Point> arrival;  // where the last movement leads
  };

  template <class Wrong>
  Result<void> set_place(const std::vector<std::string_view>& words, std::uint32_t node,
                         const Wrong& wrong) {
    if (words.size() != 5 || words[2] != "set") return wrong("this is not understood.");
    const auto set = coordinate(words[3], words[4], wrong);
    if (!set) return set.error();
    moving(node).track.points.front().place[set.value().axis] = set.value().value;
    return {};
  }

  // The node is elsewhere from one nanosecond to the next. A movement that is under way
  // goes on at another height, and ends where X_ or Y_ are set.
  template <class Wrong>
  Result<void> jump(const std::vector<std::string_view>& words, std::uint32_t node,
                    const Wrong& wrong) {
    if (words.size() != 8) return wrong("this is not understood.");
    const auto time = within(words[2], 0, kMaxNetworkTime);
    if (!time) return wrong("the time is no number of seconds.");
    const auto set = coordinate(words[6], words[7], wrong);
    if (!set) return set.error();
    const auto [axis, value] = set.value();
    Moving& moved = moving(node);
    auto& points = moved.track.points;
    const Time now = Time::from_seconds(*time);
    if (now < points.back().time)
      return wrong("movements of a node are in order of time.");
    auto arrival = moved.arrival;
    settle(moved, now);
    if (const Time before = now - Time::from_ns(1);
        points.size() > 1 && points[points.size() - 2].time < before)
      points.insert(points.end() - 1, {before, points.back().place});
    points.back().place[axis] = value;
    if (axis == 2 && arrival && now < arrival->time) {
      arrival->place[axis] = value;
      moved.arrival = arrival;
    }
    return {};
  }

  struct Coordinate {
    int axis;
    double value;  // in N
  };

  template <class Wrong>
  static Result<Coordinate> coordinate(std::string_view name, std::string_view number,
                                       const Wrong& wrong) {
    constexpr std::array<std::string_view, 3> kNames = {"X_", "Y_", "Z_"};
    const auto at = std::ranges::find(kNames, name);
    if (at == kNames.end()) return wrong("a coordinate is X_, Y_ or Z_.");
    const auto value = within(number, -kMaxNodePlace, kMaxNodePlace);
    if (!value) return wrong("the coordinate is no number of metres.");
    const auto axis = static_cast<int>(at - kNames.begin());
    return Coordinate{axis, axis == 2 ? -*value : *value};
  }

  template <class Wrong>
  Result<void> set_destination(const std::vector<std::string_view>& words,
                               std::uint32_t node, const Wrong& wrong) {
    if (words.size() != 9 || words[5] != "setdest")
      return wrong("this movement is not understood.");
    const auto time = within(words[2], 0, kMaxNetworkTime);
    const auto x = within(words[6], -kMaxNodePlace, kMaxNodePlace);
    const auto y = within(words[7], -kMaxNodePlace, kMaxNodePlace);
    const auto speed = within(words[8], 0, 1e4);
    if (!time || !x || !y || !speed) return wrong("a number of this movement is none.");
    Moving& moved = moving(node);
    const Time begin = Time::from_seconds(*time);
    if (begin < moved.track.points.back().time)
      return wrong("movements of a node are in order of time.");
    settle(moved, begin);
    const Vec3 from = moved.track.points.back().place;
    const Vec3 to(*x, *y, from.z());
    if (*speed <= 0) return {};
    moved.arrival = {begin + Time::from_seconds((to - from).norm() / *speed), to};
    return {};
  }

  // Ends the movement that is under way: at `now`, or where it leads.
  static void settle(Moving& moved, std::optional<Time> now) {
    auto& points = moved.track.points;
    const auto add = [&](Time time, const Vec3& place) {
      if (points.back().time == time)
        points.back().place = place;
      else
        points.push_back({time, place});
    };
    if (moved.arrival) {
      const NodeTrack::Point arrival = *moved.arrival;
      moved.arrival.reset();
      if (now && *now < arrival.time) {
        const NodeTrack::Point begin = points.back();
        const double share =
            (*now - begin.time).seconds() / (arrival.time - begin.time).seconds();
        add(*now, begin.place + share * (arrival.place - begin.place));
        return;
      }
      add(arrival.time, arrival.place);
    }
    if (now) add(*now, points.back().place);
  }

  Moving& moving(std::uint32_t node) {
    Moving& found = nodes_[node];
    if (found.track.points.empty()) found.track.points.push_back({Time(), Vec3::Zero()});
    return found;
  }

  std::map<std::uint32_t, Moving> nodes_;
  NumberedNodes tracks_;
};

}  // namespace

Result<void> read_network_nodes(std::string_view text, const std::string& place,
                                NetworkCase& network) {
  constexpr std::array<std::string_view, 5> kRequired = {"node", "time_s", "x_m", "y_m",
                                                         "z_m"};
  constexpr std::array<std::string_view, 1> kOptional = {"power_dbm"};
  NumberedNodes nodes;
  const auto problems = read_csv(text, place, {kRequired, kOptional}, [&](CsvRow& row) {
    const auto name = row.whole("node", kMaxNodeNumber);
    const auto time = row.number("time_s", 0, kMaxNetworkTime);
    const auto x = row.number("x_m", -kMaxNodePlace, kMaxNodePlace);
    const auto y = row.number("y_m", -kMaxNodePlace, kMaxNodePlace);
    const auto z = row.number("z_m", -kMaxNodePlace, kMaxNodePlace);
    const bool has_power = !row.text("power_dbm").empty();
    std::optional<double> power;
    if (has_power) power = row.number("power_dbm", -200, kMaxNodePower);
    if (!name || !time || !x || !y || !z || has_power != power.has_value()) return;
    const bool is_new = !nodes.contains(static_cast<std::uint32_t>(*name));
    if (is_new && nodes.size() >= kMaxNodes)
      return row.report("node", fmt::format("there are more than {} nodes.", kMaxNodes));
    NodeTrack& track = nodes[static_cast<std::uint32_t>(*name)];
    if (!is_new && power != track.transmit_power_dbm)
      return row.report("power_dbm", "differs from that of the node's first row.");
    track.transmit_power_dbm = power;
    const Time moment = Time::from_seconds(*time);
    if (!is_new && moment <= track.points.back().time)
      return row.report("time_s", "the rows of a node are in order of time.");
    track.points.push_back({moment, Vec3(*x, *y, -*z)});
  });
  if (auto good = first_problem(problems); !good) return good;
  return take_nodes(std::move(nodes), place, network);
}

Result<void> read_ns2_movement(std::string_view text, const std::string& place,
                               NetworkCase& network) {
  Ns2Reader reader;
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t feed = text.find('\n');
    if (auto good =
            reader.take_line(text.substr(0, feed), fmt::format("{}:{}", place, line));
        !good)
      return good;
    text.remove_prefix(feed == std::string_view::npos ? text.size() : feed + 1);
  }
  return take_nodes(reader.finish(), place, network);
}

Result<void> read_network_traffic(std::string_view text, const std::string& place,
                                  NetworkCase& network) {
  constexpr std::array<std::string_view, 5> kRequired = {"message", "time_s", "from",
                                                         "to", "bytes"};
  network.traffic.clear();
  std::unordered_set<std::uint64_t> numbers;
  return first_problem(read_csv(text, place, {kRequired}, [&](CsvRow& row) {
    const auto number = row.whole("message", kMaxMessageNumber);
    const auto time = row.number("time_s", 0, kMaxNetworkTime);
    const auto from = node_in(row, "from", network);
    const bool to_all = row.text("to") == "*";
    const auto to = to_all ? std::optional(kAllNodesOfCase) : node_in(row, "to", network);
    const auto bytes = row.whole("bytes", kMaxPacketBytes);
    if (!number || !time || !from || !to || !bytes) return;
    if (!numbers.insert(*number).second)
      return row.report("message", fmt::format("message {} is there twice.", *number));
    if (*to == *from)
      return row.report("to",
                        fmt::format("node {} sends to itself.", network.names[*from]));
    const TrafficItem item{*number, Time::from_seconds(*time), *from, *to,
                           static_cast<std::uint32_t>(*bytes)};
    if (!network.traffic.empty() && item.time < network.traffic.back().time)
      return row.report("time_s", "the rows are in order of time.");
    network.traffic.push_back(item);
  }));
}

Result<SaturatedFlow> parse_saturated_flow(std::string_view text,
                                           const NetworkCase& network) {
  const auto wrong = [&](const std::string& message) {
    return Error{ErrorCode::kBadInput, fmt::format("--saturate {}", text), message,
                 "It is FROM,TO,BYTES,DEPTH or FROM,TO,BYTES,DEPTH,START_S."};
  };
  std::vector<double> values;
  CsvCells cells(text);
  while (const auto cell = cells.next()) {
    const auto value = number_in(*cell);
    if (!value || !(*value >= 0 && *value <= static_cast<double>(kMaxNodeNumber)))
      return wrong(fmt::format("{} is no number from 0 on.", *cell));
    if (values.size() < 4 &&
        *value != static_cast<double>(static_cast<std::uint64_t>(*value)))
      return wrong(fmt::format("{} is no whole number.", *cell));
    values.push_back(*value);
  }
  if (values.size() != 4 && values.size() != 5)
    return wrong(fmt::format("{} numbers.", values.size()));
  std::array<std::uint32_t, 2> ends{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto place = place_of(network, static_cast<std::uint64_t>(values[i]));
    if (!place) return wrong(fmt::format("there is no node {}.", values[i]));
    ends[i] = *place;
  }
  if (ends[0] == ends[1]) return wrong("the node sends to itself.");
  if (values[2] > static_cast<double>(kMaxPacketBytes))
    return wrong(fmt::format("more than {} bytes.", kMaxPacketBytes));
  if (values[3] < 1 || values[3] > static_cast<double>(kMaxFlowDepth))
    return wrong(fmt::format("DEPTH is from 1 to {}.", kMaxFlowDepth));
  const double start = values.size() == 5 ? values[4] : 0;
  if (start > kMaxNetworkTime)
    return wrong(fmt::format("START_S is at most {}.", kMaxNetworkTime));
  return SaturatedFlow{ends[0], ends[1], static_cast<std::uint32_t>(values[2]),
                       static_cast<std::uint32_t>(values[3]), Time::from_seconds(start)};
}

}  // namespace skein::exchange
