// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/plan_reading.h"

#include <gtest/gtest.h>

#include "skein/exchange/table/formats.h"
#include "skein/model/connection/connection.h"
#include "skein/model/path/climb_profile.h"
#include "skein/model/path/flight_plan.h"

namespace skein::exchange::plan_reading_test {
namespace {

const geo::LocalFrame& frame() {
  static const geo::LocalFrame kFrame =
      geo::LocalFrame::at({36.989, -122.0514, 0}).value();
  return kFrame;
}

Document some_plan() {
  const model::AirMotion air{15, 60, {3, -4}};
  Document document;
  FlightPlan plan;
  model::Pose from{{120, -40}, 0.3};
  for (const model::Pose& to :
       {model::Pose{{800, 500}, 2}, model::Pose{{-300, 200}, 5}}) {
    const double start = plan.empty() ? 12.5 : model::end_time_of(plan);
    const FlightPlan next =
        model::to_flight_plan(model::connect(from, to, air), from, air, start, -150);
    plan.insert(plan.end(), next.begin(), next.end());
    from = to;
  }
  plan = model::climbing(plan, -150, model::quickest_climb(40, 2, 0.8));
  document.plans = {{"aircraft 1", "", plan}, {"aircraft 2", "", {plan.front()}}};
  document.frame = frame();
  document.has_altitude = true;
  return document;
}

TEST(PlanReading, GivesBackWhatWasWritten) {
  const Document document = some_plan();
  const FlightPlan& written = document.plans.front().plan;
  for (const Format format : {Format::kGeojson, Format::kCsv}) {
    const std::string text = to_text(document, format, {}).value();
    const auto read = format == Format::kCsv ? plan_from_csv(text, "a.csv", frame())
                                             : plan_from_geojson(text, "a.json", frame());
    ASSERT_TRUE(read.ok()) << read.error().text();
    ASSERT_EQ(read.value().size(), written.size());
    const double end = model::end_time_of(written);
    EXPECT_NEAR(model::end_time_of(read.value()), end, 1e-9);
    for (double t = model::start_of(written); t < end; t += 1) {
      const auto a = model::moment_at(written, t), b = model::moment_at(read.value(), t);
      // Latitudes are written with all digits; a plane's rounding is below a micrometre.
      EXPECT_LT((a.p_N - b.p_N).norm(), 1e-5) << t;
      EXPECT_LT((a.v_N - b.v_N).norm(), 1e-6) << t;
    }
  }
}

TEST(PlanReading, SaysWhatIsWrong) {
  const auto error = [](const char* text) {
    const auto read = plan_from_geojson(text, "a.geojson", frame());
    return read ? std::string("read") : read.error().text();
  };
  EXPECT_NE(error("{").find("no GeoJSON"), std::string::npos);
  EXPECT_NE(error(R"({"features": []})").find("no planned flight"), std::string::npos);
  EXPECT_NE(error(R"({"features": [{"properties": {"what": "element"}}]})")
                .find("not as `skein plan`"),
            std::string::npos);
  EXPECT_FALSE(plan_from_csv("element,time_s\n1,2\n", "a.csv", frame()).ok());
  EXPECT_EQ(read_plan("nowhere.geojson", frame()).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_plan("plan.kml", frame()).error().code, ErrorCode::kBadInput);

  Document without = some_plan();
  without.has_altitude = false;
  const std::string text = to_text(without, Format::kGeojson, {}).value();
  EXPECT_NE(error(text.c_str()).find("no altitudes"), std::string::npos);

  // Places: none in a row, words, latitude and longitude the other way round.
  const std::string csv = to_text(some_plan(), Format::kCsv, {}).value();
  const std::string header = csv.substr(0, csv.find('\n'));
  const auto error_of_csv = [&](const std::string& place_columns,
                                const std::string& place) {
    std::string rows =
        "element,time_s,altitude_m,heading_deg,course_deg,airspeed_mps,"
        "ground_speed_mps,climb_mps" +
        place_columns + "\n";
    for (const char* time : {"0", "10"})
      rows += std::string("0,") + time + ",150,0,0,15,15,0" + place + "\n";
    const auto read = plan_from_csv(rows, "a.csv", frame());
    return read ? std::string("read") : read.error().text();
  };
  EXPECT_NE(header.find("latitude_deg"), std::string::npos);
  EXPECT_EQ(error_of_csv(",north_m,east_m", ",5,6"), "read");
  EXPECT_EQ(error_of_csv(",latitude_deg,longitude_deg", ",36.99,-122.05"), "read");
  EXPECT_NE(error_of_csv("", "").find("no place"), std::string::npos);
  EXPECT_NE(error_of_csv(",north_m,east_m", ",5,").find("no place"), std::string::npos);
  EXPECT_NE(error_of_csv(",north_m,east_m", ",5,none").find("east_m"), std::string::npos);
  EXPECT_NE(
      error_of_csv(",latitude_deg,longitude_deg", ",-122.05,36.99").find("no place"),
      std::string::npos);
  EXPECT_NE(error_of_csv(",latitude_deg,longitude_deg", ",8.5,47.4").find("km from"),
            std::string::npos);
  Document far_away = some_plan();
  far_away.frame = geo::LocalFrame::at({8.5, 47.4, 0}).value();
  const std::string elsewhere = to_text(far_away, Format::kGeojson, {}).value();
  EXPECT_NE(error(elsewhere.c_str()).find("km from"), std::string::npos);

  Document torn = some_plan();
  torn.plans.front().plan[2].p_N.x() += 500;
  const std::string gap = to_text(torn, Format::kGeojson, {}).value();
  EXPECT_NE(error(gap.c_str()).find("begins"), std::string::npos);
}

}  // namespace
}  // namespace skein::exchange::plan_reading_test
