// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "skein/exchange/plan/plan_picture.h"
#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/formats.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/exchange/table/writers.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

// KML writes colours as alpha, blue, green, red.
std::string kml_colour(const std::string& rgb, const char* alpha) {
  return alpha + rgb.substr(5, 2) + rgb.substr(3, 2) + rgb.substr(1, 2);
}

class KmlWriter {
 public:
  KmlWriter(const Document& document, const WritingOptions& options)
      : document_(document), frame_(*document.frame), options_(options) {}

  std::string write() {
    put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n<name>{}</name>\n",
        escaped(document_.title));
    put("<Style "
        "id=\"zone\"><LineStyle><color>ff1f34b5</color><width>2</width></LineStyle>"
        "<PolyStyle><color>402f45d6</color></PolyStyle></Style>\n"
        "<Style "
        "id=\"area\"><LineStyle><color>ff528f3f</color><width>2</width></LineStyle>"
        "<PolyStyle><color>20528f3f</color></PolyStyle></Style>\n");
    for (const Zone& zone : document_.zones) add_zone(zone);
    for (const Shape& shape : document_.shapes) add_shape(shape);
    for (std::size_t i = 0; i < document_.plans.size(); ++i) add_plan(i);
    for (const Mark& mark : document_.marks) add_mark(mark);
    text_ += "</Document>\n</kml>\n";
    return std::move(text_);
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  std::string at(const Vec2& p, double altitude) const {
    const geo::Geodetic place = frame_.from_plane(p);
    return fmt::format("{},{},{}", place.longitude_deg, place.latitude_deg, altitude);
  }
  std::string at(const Vec3& p) const { return at(p.head<2>(), 0.0 - p.z()); }
  const char* mode() const {
    return document_.has_altitude ? "<altitudeMode>absolute</altitudeMode>"
                                  : "<altitudeMode>clampToGround</altitudeMode>";
  }

  void add_plan(std::size_t index) {
    const NamedPlan& plan = document_.plans[index];
    if (plan.plan.empty()) return;
    put("<Placemark>\n<name>{}</name>\n<description>{}, {} over ground</description>\n"
        "<Style><LineStyle><color>{}</color><width>3</width></LineStyle></Style>\n"
        "<LineString>{}<coordinates>",
        escaped(plan.name), shown_time(model::duration(plan.plan)),
        shown_length(model::ground_length(plan.plan)), kml_colour(colour_of(index), "ff"),
        mode());
    for (const FlightSample& each : samples(plan.plan, options_.tolerance))
      put("\n{}", at(each.moment.p_N));
    text_ += "\n</coordinates></LineString>\n</Placemark>\n";
  }

  void add_polygon(const geo::Ring& ring) {
    text_ += "<Polygon><outerBoundaryIs><LinearRing><coordinates>";
    for (auto p = ring.rbegin(); p != ring.rend(); ++p) put("\n{}", at(*p, 0));
    if (!ring.empty()) put("\n{}", at(ring.back(), 0));
    text_ += "\n</coordinates></LinearRing></outerBoundaryIs></Polygon>\n";
  }

  void add_data(const char* key, double value) {
    if (std::isfinite(value))
      put("<Data name=\"{}\"><value>{}</value></Data>", key, value);
  }

  void add_zone(const Zone& zone) {
    put("<Placemark>\n<name>{}</name>\n<styleUrl>#zone</styleUrl>\n<ExtendedData>",
        escaped(zone.name));
    add_data("floor_m", zone.floor_msl);
    add_data("ceiling_m", zone.ceiling_msl);
    add_data("from_s", zone.from);
    add_data("until_s", zone.until);
    text_ += "</ExtendedData>\n";
    add_polygon(outline(zone));
    text_ += "</Placemark>\n";
  }

  void add_shape(const Shape& shape) {
    put("<Placemark>\n<name>{}</name>\n<styleUrl>#area</styleUrl>\n",
        escaped(shape.name));
    if (shape.closed) {
      geo::Ring ring = shape.points;
      if (geo::signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
      add_polygon(ring);
    } else {
      text_ += "<LineString><coordinates>";
      for (const Vec2& p : shape.points) put("\n{}", at(p, 0));
      text_ += "\n</coordinates></LineString>\n";
    }
    text_ += "</Placemark>\n";
  }

  void add_mark(const Mark& mark) {
    put("<Placemark>\n<name>{}</name>\n<Point>{}<coordinates>{}</coordinates></Point>\n"
        "</Placemark>\n",
        escaped(mark.name), mode(), at(mark.p_N));
  }

  const Document& document_;
  const geo::LocalFrame& frame_;
  const WritingOptions& options_;
  std::string text_;
};

}  // namespace

Result<std::string> to_kml(const Document& document, const WritingOptions& options) {
  if (auto good = check_known(Format::kKml, known_of(document)); !good)
    return good.error();
  return KmlWriter(document, options).write();
}

}  // namespace skein::exchange
