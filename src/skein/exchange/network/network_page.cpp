// SPDX-License-Identifier: Apache-2.0
// The page of a network: pictures as SVG, made here; nothing in it moves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "skein/exchange/network/network_results.h"
#include "skein/exchange/table/text_shown.h"

namespace skein::exchange {
namespace {

constexpr double kPlotWidth = 560, kPlotHeight = 240;  // [px]
constexpr double kLeft = 58, kBottom = 34, kTop = 12, kRight = 12;
constexpr std::size_t kMaxMatrixNodes = 60, kMaxMapNodes = 500, kMaxBars = 100;

constexpr const char* kNetworkStyle = R"(
:root{color-scheme:light dark;--paper:#fff;--ink:#1b1f24;--faint:#69727d;--line:#d5dae0;
--mark:#0b62c4;--fill:#0b62c4}
@media (prefers-color-scheme:dark){:root{--paper:#14181d;--ink:#e7ebf0;--faint:#9aa4b0;
--line:#39424d;--mark:#6fb1ff;--fill:#6fb1ff}}
body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.45 system-ui,sans-serif}
main{max-width:1180px;margin:0 auto;padding:20px}
h1{font-size:24px;margin:0 0 12px}h2{font-size:17px;margin:20px 0 6px}
dl{display:grid;grid-template-columns:repeat(auto-fill,minmax(170px,1fr));gap:10px;margin:0}
dl div{border:1px solid var(--line);border-radius:6px;padding:6px 10px}
dt{color:var(--faint);font-size:13px}dd{margin:0;font-size:18px}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,480px),1fr));gap:8px 24px}
svg{width:100%;height:auto;display:block}svg text{fill:var(--faint);font-size:12px}
.axis,.grid{stroke:var(--line);fill:none}.curve{stroke:var(--mark);fill:none;stroke-width:1.8}
.bar{fill:var(--fill)}.link{stroke:var(--mark);stroke-opacity:.35}
.node{fill:var(--ink)}p{color:var(--faint);margin:4px 0}
table{border-collapse:collapse;font-size:12px}th,td{padding:2px 5px;text-align:right;
border:1px solid var(--line)}th{font-weight:600;color:var(--faint)}
.scroll{overflow:auto;max-height:560px}
)";

struct Point {
  double x, y;
};

std::string short_number(double value) {
  const double size = std::abs(value);
  if (size != 0 && (size >= 1e5 || size < 1e-3)) return fmt::format("{:.0e}", value);
  return fmt::format("{:.4g}", value);
}

// A step between lines of a grid.
double grid_step(double range) {
  return round_below(range / 3);
}

class Plot {
 public:
  Plot(double x_end, double y_end, std::string x_label, std::string y_label)
      : x_end_(x_end > 0 ? x_end : 1), y_end_(y_end > 0 ? y_end : 1) {
    const auto out = std::back_inserter(text_);
    fmt::format_to(out,
                   "<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{} over {}\">",
                   kPlotWidth, kPlotHeight, y_label, x_label);
    for (double x = 0; x <= x_end_ * 1.0001; x += grid_step(x_end_))
      fmt::format_to(out,
                     "<path class=\"grid\" d=\"M{0:.1f} {1}V{2}\"/><text x=\"{0:.1f}\" "
                     "y=\"{3}\" text-anchor=\"middle\">{4}</text>",
                     at({x, 0}).x, kTop, kPlotHeight - kBottom,
                     kPlotHeight - kBottom + 14, short_number(x));
    for (double y = 0; y <= y_end_ * 1.0001; y += grid_step(y_end_))
      fmt::format_to(out,
                     "<path class=\"grid\" d=\"M{1} {0:.1f}H{2}\"/><text x=\"{3}\" "
                     "y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>",
                     at({0, y}).y, kLeft, kPlotWidth - kRight, kLeft - 5,
                     at({0, y}).y + 4, short_number(y));
    fmt::format_to(out,
                   "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text><text "
                   "transform=\"translate(12 {}) rotate(-90)\" "
                   "text-anchor=\"middle\">{}</text>",
                   (kLeft + kPlotWidth - kRight) / 2, kPlotHeight - 4, x_label,
                   (kTop + kPlotHeight - kBottom) / 2, y_label);
  }

  void curve(const std::vector<Point>& points) {
    text_ += "<path class=\"curve\" d=\"";
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point p = at(points[i]);
      text_ += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", p.x, p.y);
    }
    text_ += "\"/>";
  }

  void bar(double from, double to, double height) {
    const Point a = at({from, height}), b = at({to, 0});
    text_ += fmt::format(
        "<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"/>",
        a.x, a.y, std::max(0.5, b.x - a.x - 1), b.y - a.y);
  }

  std::string finish() { return text_ + "</svg>"; }

 private:
  Point at(const Point& p) const {
    return {kLeft + p.x / x_end_ * (kPlotWidth - kLeft - kRight),
            kPlotHeight - kBottom - p.y / y_end_ * (kPlotHeight - kTop - kBottom)};
  }

  double x_end_, y_end_;
  std::string text_;
};

std::string part(const std::string& title, const std::string& content) {
  return fmt::format("<section><h2>{}</h2>{}</section>\n", title, content);
}

std::string delay_part(const NetworkSummary& summary) {
  if (summary.delays.empty()) return part("Delay", "<p>No unicast was delivered.</p>");
  const double longest = 1e3 * summary.delay_quantile(0.995);
  Plot plot(longest, 100, "delay [ms]", "delivered by then [%]");
  std::vector<Point> points;
  constexpr std::size_t kPoints = 300;
  for (std::size_t i = 0; i <= kPoints; ++i) {
    const double p = static_cast<double>(i) / kPoints;
    const double delay = 1e3 * summary.delay_quantile(p);
    if (delay <= longest) points.push_back({delay, 100 * p});
  }
  plot.curve(points);
  return part("Delay of unicasts", plot.finish());
}

std::string goodput_part(const NetworkCase& network, const NetworkResult& result) {
  const double duration = network.duration.seconds();
  constexpr std::size_t kMostIntervals = 100;
  const auto count = static_cast<std::size_t>(
      std::clamp(std::ceil(duration), 1.0, static_cast<double>(kMostIntervals)));
  const double length = duration / static_cast<double>(count);
  std::vector<double> bits(count);
  for (const NetworkMessage& message : result.messages)
    if (message.delivered)
      bits[std::min(count - 1, static_cast<std::size_t>(message.delivered->seconds() /
                                                        length))] += message.bytes * 8.0;
  for (double& each : bits) each /= length * 1e3;
  Plot plot(duration, *std::max_element(bits.begin(), bits.end()), "time [s]",
            "goodput [kbit/s]");
  for (std::size_t i = 0; i < count; ++i)
    plot.bar(static_cast<double>(i) * length, static_cast<double>(i + 1) * length,
             bits[i]);
  return part("Goodput of unicasts", plot.finish());
}

std::string airtime_part(const NetworkCase& network, const NetworkResult& result) {
  std::vector<std::size_t> order(result.nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result.nodes[a].airtime > result.nodes[b].airtime;
  });
  const std::size_t shown = std::min(order.size(), kMaxBars);
  const double duration = std::max(1e-9, network.duration.seconds());
  const double most =
      shown == 0 ? 1 : 100 * result.nodes[order[0]].airtime.seconds() / duration;
  Plot plot(static_cast<double>(shown), most, "nodes, the busiest first", "on air [%]");
  for (std::size_t i = 0; i < shown; ++i)
    plot.bar(static_cast<double>(i), static_cast<double>(i + 1),
             100 * result.nodes[order[i]].airtime.seconds() / duration);
  std::string busiest;
  for (std::size_t i = 0; i < std::min<std::size_t>(shown, 5); ++i)
    busiest +=
        fmt::format("{}node {}: {:.2f} %", i == 0 ? "" : ", ", network.names[order[i]],
                    100 * result.nodes[order[i]].airtime.seconds() / duration);
  if (shown < order.size())
    busiest += fmt::format("; shown are the busiest {} of {}", shown, order.size());
  return part("Time on the air", plot.finish() + "<p>" + busiest + "</p>");
}

std::string map_part(const NetworkCase& network, const NetworkResult& result) {
  if (network.nodes.size() > kMaxMapNodes)
    return part("Who hears whom",
                fmt::format("<p>Shown for at most {} nodes.</p>", kMaxMapNodes));
  std::vector<Point> places;
  Point low{1e300, 1e300}, high{-1e300, -1e300};
  for (const NodeTrack& node : network.nodes) {
    const Vec3 place = node.place(Time());
    places.push_back({place.x(), place.y()});
    low = {std::min(low.x, place.x()), std::min(low.y, place.y())};
    high = {std::max(high.x, place.x()), std::max(high.y, place.y())};
  }
  constexpr double kSide = 480, kRim = 24;
  const double scale =
      (kSide - 2 * kRim) / std::max({1e-9, high.x - low.x, high.y - low.y});
  for (Point& p : places)
    p = {kRim + (p.x - low.x) * scale, kSide - kRim - (p.y - low.y) * scale};
  std::string text = fmt::format(
      "<svg viewBox=\"0 0 {0} {0}\" role=\"img\" aria-label=\"who hears whom\">", kSide);
  for (std::size_t from = 0; from < places.size(); ++from)
    for (const std::uint32_t to : result.hearers[from])
      text += fmt::format("<path class=\"link\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>",
                          places[from].x, places[from].y, places[to].x, places[to].y);
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += fmt::format("<circle class=\"node\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\"/>",
                        places[i].x, places[i].y);
    if (places.size() <= kMaxMatrixNodes)
      text += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", places[i].x + 6,
                          places[i].y - 5, network.names[i]);
  }
  return part("Who hears whom at the beginning", text + "</svg>");
}

std::string matrix_part(const NetworkCase& network, const NetworkResult& result) {
  const std::size_t count = network.nodes.size();
  constexpr const char* kTitle = "Received of what was sent from one to the other [%]";
  if (count > kMaxMatrixNodes)
    return part(kTitle,
                fmt::format("<p>Shown for at most {} nodes.</p>", kMaxMatrixNodes));
  std::vector<std::uint64_t> received(count * count), wanted(count * count);
  for (const NetworkMessage& message : result.messages) {
    if (message.to != kAllNodesOfCase) {
      ++wanted[message.from * count + message.to];
      if (message.delivered) ++received[message.from * count + message.to];
      continue;
    }
    for (const BroadcastReception& each : message.in_range) {
      ++wanted[message.from * count + each.node];
      if (each.delivered) ++received[message.from * count + each.node];
    }
  }
  std::string text = "<div class=\"scroll\"><table><thead><tr><th>from \\ to</th>";
  for (const std::uint32_t name : network.names) text += fmt::format("<th>{}</th>", name);
  text += "</tr></thead><tbody>";
  for (std::size_t from = 0; from < count; ++from) {
    text += fmt::format("<tr><th>{}</th>", network.names[from]);
    for (std::size_t to = 0; to < count; ++to) {
      const std::uint64_t n = wanted[from * count + to];
      text += n == 0
                  ? "<td></td>"
                  : fmt::format("<td title=\"{} of {}\">{:.1f}</td>",
                                received[from * count + to], n,
                                100.0 * static_cast<double>(received[from * count + to]) /
                                    static_cast<double>(n));
    }
    text += "</tr>";
  }
  return part(kTitle, "<p>Broadcasts count at those in range.</p>" + text +
                          "</tbody></table></div>");
}

}  // namespace

std::string network_page(const std::string& title, const NetworkCase& network,
                         const NetworkResult& result) {
  const NetworkSummary summary = summarize(network, result);
  std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'\">\n<title>{0}</title>\n<style>{1}</style>\n</head>\n"
      "<body>\n<main>\n<h1>{0}</h1>\n<dl>",
      escaped(title), kNetworkStyle);
  const auto fact = [&](std::string_view name, const std::string& value) {
    text += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, value);
  };
  fact("nodes", std::to_string(network.nodes.size()));
  fact("simulated", fmt::format("{:.6g} s", network.duration.seconds()));
  fact("unicasts", fmt::format("{} of {}", summary.delivered, summary.sent));
  fact("lost", fmt::format("{:.3f} %", 100 * summary.loss_ratio));
  const auto delay = [&](double seconds) {
    return summary.delays.empty() ? "-" : fmt::format("{:.3f} ms", 1e3 * seconds);
  };
  fact("mean delay", delay(summary.mean_delay));
  fact("95 % within", delay(summary.delay_quantile(0.95)));
  fact("goodput", fmt::format("{:.1f} kbit/s", summary.goodput_bps / 1e3));
  fact("broadcasts received",
       fmt::format("{} of {} in range", summary.broadcast_receptions,
                   summary.broadcast_receptions + summary.broadcast_losses));
  text += "</dl>\n<div class=\"plots\">\n";
  text += delay_part(summary);
  text += goodput_part(network, result);
  text += airtime_part(network, result);
  text += map_part(network, result);
  text += "</div>\n" + matrix_part(network, result);
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace skein::exchange
