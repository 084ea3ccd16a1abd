#include "weft/report/HtmlReport.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "weft/core/AtomicFile.h"
#include "weft/core/Contract.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

constexpr std::string_view kStyle = R"(
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 80rem; margin: 2rem auto; padding: 0 1rem; }
h1, h2 { font-weight: 600; line-height: 1.2; }
h2 { margin-top: 2.5rem; border-bottom: 1px solid #ddd; padding-bottom: .3rem; }
p { max-width: 48rem; }
table { border-collapse: collapse; margin: 1rem 0; font-variant-numeric: tabular-nums; }
caption, figcaption { font-size: .875rem; color: #555; text-align: left; padding: .3rem 0; max-width: 48rem; }
th, td { padding: .2rem .8rem; text-align: right; border-bottom: 1px solid #eee; }
th { border-bottom: 1px solid #888; font-weight: 600; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
.pictures { display: flex; flex-wrap: wrap; gap: 1rem; margin: 1rem 0; }
figure { margin: 0; }
.pictures figure { width: min-content; }
img { display: block; image-rendering: pixelated; }
.ends { display: flex; justify-content: space-between; font-size: .8rem; color: #555; }
.plot { margin: 1rem 0; }
svg text { font: 12px system-ui, sans-serif; fill: #333; }
)";

/// Okabe and Ito's colours, which people who are colour-blind can tell apart.
constexpr std::array<std::string_view, 7> kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#000000", "#e69f00", "#56b4e9"};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(bytes.size() - i, 3);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

// --- Plots ---

constexpr double kWidth = 760.0, kHeight = 380.0;
constexpr double kLeft = 70.0, kRight = 20.0, kTop = 15.0, kBottom = 50.0;

/// One axis: which values it shows, where, and its ticks.
struct Axis {
  double lowest = 0.0, highest = 1.0;
  bool logarithmic = false;
  std::vector<double> ticks;

  double share(double value) const {
    if (logarithmic) return std::log(value / lowest) / std::log(highest / lowest);
    return (value - lowest) / (highest - lowest);
  }
};

/// A step of 1, 2 or 5 times a power of ten that divides a range into four to ten parts.
double tickStep(double range) {
  const double power = std::pow(10.0, std::floor(std::log10(range / 4.0)));
  for (const double factor : {5.0, 2.0})
    if (range / (factor * power) >= 4.0) return factor * power;
  return power;
}

Axis linearAxis(double lowest, double highest) {
  if (!(highest > lowest)) highest = lowest + std::max(1.0, std::abs(lowest));
  Axis axis;
  const double step = tickStep(highest - lowest);
  const double first = std::floor(lowest / step + 1e-9);
  const double last = std::ceil(highest / step - 1e-9);
  for (double i = first; i <= last; ++i) axis.ticks.push_back(i * step);
  axis.lowest = first * step;
  axis.highest = last * step;
  return axis;
}

Axis logarithmicAxis(double lowest, double highest) {
  Axis axis;
  axis.logarithmic = true;
  const double last = std::ceil(std::log10(highest) + 1e-9);
  for (double power = std::floor(std::log10(lowest) - 1e-9); power <= last; ++power)
    for (const double factor : {1.0, 2.0, 5.0}) axis.ticks.push_back(factor * std::pow(10.0, power));
  // As few as hold all values between the first and the last.
  while (axis.ticks.size() > 2 && axis.ticks[axis.ticks.size() - 2] >= highest) axis.ticks.pop_back();
  while (axis.ticks.size() > 2 && axis.ticks[1] <= lowest) axis.ticks.erase(axis.ticks.begin());
  axis.lowest = axis.ticks.front();
  axis.highest = axis.ticks.back();
  return axis;
}

struct PlotArea {
  Axis x, y;

  bool shows(glm::dvec2 p) const {
    return std::isfinite(p.x) && std::isfinite(p.y) && (!x.logarithmic || p.x > 0.0);
  }
  glm::dvec2 place(glm::dvec2 p) const {
    return {kLeft + x.share(p.x) * (kWidth - kLeft - kRight),
            kHeight - kBottom - y.share(p.y) * (kHeight - kTop - kBottom)};
  }
};

PlotArea plotArea(const ReportPlot& plot) {
  PlotArea area;
  area.x.logarithmic = plot.logarithmicX;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec2 lowest(kInfinity, 0.0), highest(-kInfinity, -kInfinity);
  for (const PlotSeries& series : plot.series)
    for (const glm::dvec2 point : series.points) {
      if (!area.shows(point)) continue;
      lowest = {std::min(lowest.x, point.x), std::min(lowest.y, point.y)};
      highest = {std::max(highest.x, point.x), std::max(highest.y, point.y)};
    }
  if (!(lowest.x <= highest.x))
    lowest = glm::dvec2(plot.logarithmicX ? 1.0 : 0.0, 0.0), highest = glm::dvec2(1.0);
  area.x = plot.logarithmicX ? logarithmicAxis(lowest.x, highest.x) : linearAxis(lowest.x, highest.x);
  area.y = linearAxis(lowest.y, highest.y);
  return area;
}

std::string svgText(double x, double y, std::string_view anchor, std::string_view text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

std::string svgLine(glm::dvec2 from, glm::dvec2 to, std::string_view color) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n",
                     from.x, from.y, to.x, to.y, color);
}

std::string svgAxes(const PlotArea& area, const ReportPlot& plot) {
  std::string svg;
  const double bottom = kHeight - kBottom;
  for (const double tick : area.x.ticks) {
    const double x = area.place({tick, area.y.lowest}).x;
    svg += svgLine({x, kTop}, {x, bottom}, "#e5e5e5");
    svg += svgText(x, bottom + 18.0, "middle", fmt::format("{:.4g}", tick));
  }
  for (const double tick : area.y.ticks) {
    const double y = area.place({area.x.lowest, tick}).y;
    svg += svgLine({kLeft, y}, {kWidth - kRight, y}, "#e5e5e5");
    svg += svgText(kLeft - 8.0, y + 4.0, "end", fmt::format("{:.4g}", tick));
  }
  svg += svgLine({kLeft, bottom}, {kWidth - kRight, bottom}, "#333");
  svg += svgLine({kLeft, kTop}, {kLeft, bottom}, "#333");
  svg += svgText(0.5 * (kLeft + kWidth - kRight), kHeight - 10.0, "middle", plot.xLabel);
  svg += fmt::format("<g transform=\"translate(16 {:.1f}) rotate(-90)\">{}</g>\n", 0.5 * (kTop + bottom),
                     svgText(0, 0, "middle", plot.yLabel));
  return svg;
}

std::string svgSeries(const PlotArea& area, const PlotSeries& series, std::string_view color) {
  std::string svg;
  const bool line = series.style == PlotSeries::Style::Line;
  if (line) svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" points=\"", color);
  for (const glm::dvec2 point : series.points) {
    if (!area.shows(point)) continue;
    const glm::dvec2 p = area.place(point);
    svg += line ? fmt::format("{:.1f},{:.1f} ", p.x, p.y)
                : fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", p.x, p.y, color);
  }
  if (line) svg += "\"/>\n";
  return svg;
}

/// Names and colours of the series, beside the plot.
std::string svgLegend(const ReportPlot& plot) {
  std::string svg;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const double y = kTop + 12.0 + 20.0 * static_cast<double>(i);
    svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"12\" fill=\"{}\"/>\n", kWidth,
                       y - 10.0, kColors[i % kColors.size()]);
    svg += svgText(kWidth + 18.0, y, "start", plot.series[i].name);
  }
  return svg;
}

/// The colour map as CSS.
std::string gradient() {
  constexpr int kSteps = 16;
  std::string colors;
  for (int i = 0; i <= kSteps; ++i) {
    const glm::vec3 color = 255.0f * viridis(static_cast<float>(i) / kSteps);
    colors += fmt::format(", rgb({:.0f},{:.0f},{:.0f})", color.r, color.g, color.b);
  }
  return fmt::format(".scale {{ height: 10px; background: linear-gradient(to right{}); }}\n", colors);
}

std::string scaleBar(const ColorScale& scale) {
  return fmt::format(
      "<div class=\"scale\"></div><div "
      "class=\"ends\"><span>{:.3g}</span><span>{}</span><span>{:.3g}</span></div>\n",
      scale.lowest, escaped(scale.label), scale.highest);
}

}  // namespace

HtmlReport::HtmlReport(std::string_view title) {
  html_ = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" "
      "content=\"width=device-width\">\n<title>{0}</title>\n<style>{1}{2}</style>\n</head>\n"
      "<body>\n<h1>{0}</h1>\n",
      escaped(title), kStyle, gradient());
}

void HtmlReport::heading(std::string_view text) {
  html_ += fmt::format("<h2>{}</h2>\n", escaped(text));
}

void HtmlReport::paragraph(std::string_view text) {
  html_ += fmt::format("<p>{}</p>\n", escaped(text));
}

void HtmlReport::table(const ReportTable& table) {
  html_ += fmt::format("<table>\n<caption>{}</caption>\n<tr>", escaped(table.caption));
  for (const std::string& cell : table.header) html_ += fmt::format("<th>{}</th>", escaped(cell));
  html_ += "</tr>\n";
  for (const std::vector<std::string>& row : table.rows) {
    WEFT_EXPECT(row.size() == table.header.size(), "a row of a table has a cell for every column");
    html_ += "<tr>";
    for (const std::string& cell : row) html_ += fmt::format("<td>{}</td>", escaped(cell));
    html_ += "</tr>\n";
  }
  html_ += "</table>\n";
}

Result<void> HtmlReport::pictures(std::span<const ReportPicture> pictures) {
  html_ += "<div class=\"pictures\">\n";
  for (const ReportPicture& picture : pictures) {
    WEFT_TRY(const std::vector<std::uint8_t> png, encodePng(picture.image));
    const int factor = std::max(picture.width / picture.image.width, 1);
    const int width = factor * picture.image.width;
    html_ += fmt::format(
        "<figure><img width=\"{}\" height=\"{}\" alt=\"{}\" "
        "src=\"data:image/png;base64,{}\">\n{}<figcaption>{}</figcaption></figure>\n",
        width, factor * picture.image.height, escaped(picture.caption), base64(png),
        picture.scale ? scaleBar(*picture.scale) : "", escaped(picture.caption));
  }
  html_ += "</div>\n";
  return {};
}

void HtmlReport::plot(const ReportPlot& plot) {
  const PlotArea area = plotArea(plot);
  html_ += fmt::format(
      "<figure class=\"plot\"><svg width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\">\n",
      kWidth + 200.0, kHeight);
  html_ += svgAxes(area, plot);
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    html_ += svgSeries(area, plot.series[i], kColors[i % kColors.size()]);
  html_ += svgLegend(plot);
  html_ += fmt::format("</svg>\n<figcaption>{}</figcaption></figure>\n", escaped(plot.caption));
}

std::string HtmlReport::html() const {
  return html_ + "</body>\n</html>\n";
}

Result<void> HtmlReport::write(const std::filesystem::path& path) const {
  return writeWholeFile(path, html());
}

}  // namespace weft
