// SPDX-License-Identifier: Apache-2.0
#include "skein/record/report/page.h"

#include <nlohmann/json.hpp>

#include "skein/base/output_file.h"
#include "skein/record/report/page_assets.h"

namespace skein::record {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

// JSON inside a script element must not show "</" or "<!": every "<" is written as the
// escape that means the same in JSON.
std::string embedded(const nlohmann::ordered_json& data) {
  const auto handler = nlohmann::ordered_json::error_handler_t::replace;
  const std::string json = data.dump(-1, ' ', false, handler);
  std::string out;
  out.reserve(json.size() + json.size() / 64);
  for (const char c : json)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

// A block of data, which no browser runs.
void put_block(std::string& html, std::string_view type, std::string_view id,
               std::string_view content) {
  html += "<script type=\"";
  html += type;
  html += "\" id=\"";
  html += id;
  html += "\">";
  html += content;
  html += "</script>\n";
}

}  // namespace

std::string base64(std::span<const std::byte> bytes) {
  static constexpr char kDigits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      group = group << 8 | (k < bytes.size() ? std::to_integer<unsigned>(bytes[k]) : 0);
    const std::size_t digits = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t k = 0; k < 4; ++k)
      out += k < digits ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

Result<void> write_page(PageKind kind, const std::string& title,
                        const nlohmann::ordered_json& data,
                        const std::filesystem::path& file) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      // Nothing may be fetched: the page is the same with and without a network. The map
      // has a worker, which it reads from this page.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'; worker-src blob:; "
      "connect-src blob:; "
      "img-src data: blob:\">\n"
      "<title>" +
      escaped(title) + "</title>\n<style>";
  html += page_style();
  html +=
      "</style>\n</head>\n<body>\n<main id=\"page\">\n"
      "<noscript>This report needs a browser with JavaScript.</noscript>\n</main>\n";
  put_block(html, "application/json", "data", embedded(data));
  put_block(html, "text/plain", "script",
            kind == PageKind::kRuns ? runs_script() : study_script());
  if (kind == PageKind::kRuns) put_block(html, "text/plain", "worker", map_worker());
  html += "<script>";
  html += loader_script();
  html += "</script>\n</body>\n</html>\n";
  return write_file(file, html);
}

}  // namespace skein::record
