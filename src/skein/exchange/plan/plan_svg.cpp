// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "skein/exchange/plan/plan_picture.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/exchange/table/writers.h"

namespace skein::exchange {
namespace {

constexpr double kWidth = 1000, kMargin = 20, kTallest = 1000;  // [px]

// The facts side by side; rows of them.
std::pair<std::string, double> facts(const Document& document, double width) {
  constexpr double kRow = 20, kLetter = 7, kGap = 26;
  std::string text;
  double x = 0, y = 0;
  for (const auto& [name, value] : document.facts) {
    const double wide = kLetter * static_cast<double>(name.size() + value.size()) + kGap;
    if (x > 0 && x + wide > width) {
      x = 0;
      y += kRow;
    }
    text += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\"><tspan class=\"fact\">{} </tspan><tspan "
        "class=\"fact-value\">{}</tspan></text>\n",
        x, y, escaped(name), escaped(value));
    x += wide;
  }
  return {text, document.facts.empty() ? 0 : y + kRow};
}

}  // namespace

std::string to_svg(const Document& document) {
  const double inner = kWidth - 2 * kMargin;
  const MapView view = view_of(document, inner, kTallest);
  const auto [fact_text, fact_height] = facts(document, inner);
  const auto [legend_text, legend_height] = legend(document, inner);
  const double map_top = 46 + fact_height;
  const double foot = map_top + view.height + 14;
  const double height = foot + 50 + legend_height + 12;
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h:.0f}\" "
      "width=\"{w}\" "
      "height=\"{h:.0f}\">\n<title>{title}</title>\n<style>{style}</style>\n"
      "<defs><clipPath id=\"map-rim\"><rect width=\"{mw:.0f}\" "
      "height=\"{mh:.2f}\"/></clipPath></defs>\n"
      "<rect class=\"sheet\" width=\"{w}\" height=\"{h:.0f}\"/>\n"
      "<text class=\"title\" x=\"{m}\" y=\"32\">{title}</text>\n"
      "<g transform=\"translate({m} 54)\">{facts}</g>\n"
      "<g transform=\"translate({m} {top:.0f})\" clip-path=\"url(#map-rim)\">\n"
      "<rect class=\"paper\" width=\"{mw:.0f}\" height=\"{mh:.2f}\"/>\n{grid}{map}"
      "<rect class=\"rim\" x=\".5\" y=\".5\" width=\"{rw:.2f}\" height=\"{rh:.2f}\"/>"
      "</g>\n"
      "<g transform=\"translate({m} {bar:.0f})\">{scale}</g>\n"
      "<g transform=\"translate({wind_x:.0f} {foot:.0f})\">{wind}</g>\n"
      "<g transform=\"translate({m} {legend_y:.0f})\">{legend}</g>\n"
      "</svg>\n",
      fmt::arg("w", kWidth), fmt::arg("h", height), fmt::arg("m", kMargin),
      fmt::arg("title", escaped(document.title)), fmt::arg("style", picture_style()),
      fmt::arg("mw", view.width), fmt::arg("mh", view.height),
      fmt::arg("rw", view.width - 1), fmt::arg("rh", view.height - 1),
      fmt::arg("facts", fact_text), fmt::arg("top", map_top),
      fmt::arg("grid", grid_layer(view)), fmt::arg("map", map_layer(document, view)),
      fmt::arg("bar", foot + 18), fmt::arg("scale", scale_bar(view)),
      fmt::arg("wind_x", kWidth - kMargin - 130), fmt::arg("foot", foot),
      fmt::arg("wind", wind_arrow(document)), fmt::arg("legend_y", foot + 50),
      fmt::arg("legend", legend_text));
}

}  // namespace skein::exchange
