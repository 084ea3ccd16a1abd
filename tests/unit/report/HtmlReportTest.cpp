#include "weft/report/HtmlReport.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <glm/common.hpp>
#include <limits>
#include <regex>
#include <sstream>

#include "TestSupport.h"
#include "weft/core/Color.h"
#include "weft/io/ImageFile.h"

namespace weft {
namespace {

using test::requireDone;
using test::valueOf;
using testing::HasSubstr;
using testing::Not;

std::vector<std::uint8_t> bytesOfBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count >= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> (count -= 8) & 255u));
  }
  return bytes;
}

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

// Every element that is opened is closed, in the right order.
void expectBalanced(const std::string& html) {
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-z0-9]+)[^>]*?(/?)>");
  for (std::sregex_iterator match(html.begin(), html.end(), tag), end; match != end; ++match) {
    const std::string name = (*match)[2];
    if (name == "meta" || name == "img" || (*match)[3] == "/") continue;
    if ((*match)[1] == "") {
      open.push_back(name);
    } else {
      ASSERT_FALSE(open.empty()) << name;
      ASSERT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

Image someImage(int width, int height) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.bytes.size(); ++i) image.bytes[i] = static_cast<std::uint8_t>(i * 41);
  return image;
}

TEST(HtmlReport, PicturesComeBackFromThePage) {
  HtmlReport report("pictures");
  const Image small = someImage(3, 2);
  const Image large = someImage(400, 5);
  requireDone(report.pictures(std::vector<ReportPicture>{{small, "small"}, {large, "large"}}));
  const auto encoded = matches(report.html(), "data:image/png;base64,([A-Za-z0-9+/=]+)\"");
  ASSERT_EQ(encoded.size(), 2u);
  EXPECT_EQ(valueOf(decodeImage(bytesOfBase64(encoded[0]), "small")).bytes, small.bytes);
  EXPECT_EQ(valueOf(decodeImage(bytesOfBase64(encoded[1]), "large")).bytes, large.bytes);
  EXPECT_THAT(matches(report.html(), "<img width=\"([0-9]+)\""), testing::ElementsAre("279", "400"));
  expectBalanced(report.html());
}

TEST(HtmlReport, WhatComesFromOutsideIsText) {
  const std::string hostile = "<script>alert(\"&\")</script>";
  HtmlReport report(hostile);
  report.heading(hostile);
  report.paragraph(hostile);
  report.table({hostile, {hostile, hostile}, {{hostile, hostile}}});
  report.plot({hostile, hostile, hostile, {{hostile, {{0, 1}, {1, 2}}}}});
  requireDone(
      report.pictures(std::vector<ReportPicture>{{someImage(1, 1), hostile, ColorScale{0, 1, hostile}}}));
  EXPECT_THAT(report.html(), Not(HasSubstr("<script")));
  EXPECT_THAT(report.html(), HasSubstr("<h2>&lt;script&gt;alert(&quot;&amp;&quot;)&lt;/script&gt;</h2>"));
  // the title twice, alt and caption
  EXPECT_EQ(matches(report.html(), "(&lt;script)").size(), 16u);
  EXPECT_THAT(report.html(), Not(HasSubstr("http")));
  expectBalanced(report.html());
}

TEST(HtmlReport, PlotsPutPointsWhereTheAxesSay) {
  HtmlReport report("plot");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  report.plot({"caption", "x", "y", {{"line", {{0, 0}, {5, nan}, {5, 0.5}, {10, 1}}}}});
  // Axes from 0 to 10 and from 0 to 1, so the line is the diagonal of the plot's area.
  EXPECT_THAT(matches(report.html(), "points=\"([^\"]*)\""),
              testing::ElementsAre("70.0,330.0 405.0,172.5 740.0,15.0 "));
  EXPECT_THAT(matches(report.html(), "middle\">([0-9.]+)<"),
              testing::ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(matches(report.html(), "end\">([0-9.]+)<"),
              testing::ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1"));
}

TEST(HtmlReport, LogarithmicAxesHaveEqualRatios) {
  HtmlReport report("plot");
  ReportPlot plot{"caption",
                  "bytes",
                  "eps",
                  {{"a", {{1, 1}, {10, 1}, {100, 1}, {-3, 1}}, PlotSeries::Style::Dots}},
                  true};
  report.plot(plot);
  EXPECT_THAT(matches(report.html(), "circle cx=\"([0-9.]+)\""),
              testing::ElementsAre("70.0", "405.0", "740.0"));
}

TEST(HtmlReport, PlotsOfNothingAndOfOnePointAreDrawn) {
  for (const bool logarithmic : {false, true}) {
    HtmlReport report("plot");
    report.plot({"nothing", "x", "y", {}, logarithmic});
    report.plot({"point", "x", "y", {{"a", {{3e6, 0}}}}, logarithmic});
    EXPECT_THAT(report.html(), Not(HasSubstr("nan")));
    EXPECT_THAT(report.html(), Not(HasSubstr("inf")));
    expectBalanced(report.html());
  }
}

TEST(HtmlReport, IsWrittenWhole) {
  HtmlReport report("a report");
  report.paragraph("text");
  const auto file = test::testFolder() / "report.html";
  requireDone(report.write(file));
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  EXPECT_EQ(text.str(), report.html());
  EXPECT_FALSE(report.write(test::testFolder() / "no" / "folder.html"));
}

// CIE lightness of stored sRGB.
double lightness(glm::vec3 stored) {
  const double y = luminance(decode(Encoding::Srgb, stored));
  return 116.0 * std::cbrt(y) - 16.0;
}

TEST(ColorMap, EqualStepsLookEquallyLarge) {
  std::vector<double> steps;
  for (int i = 0; i < 16; ++i)
    steps.push_back(lightness(viridis(static_cast<float>(i + 1) / 16)) -
                    lightness(viridis(static_cast<float>(i) / 16)));
  const double mean = (lightness(viridis(1)) - lightness(viridis(0))) / 16;
  for (const double step : steps) {
    EXPECT_GT(step, 0.75 * mean);
    EXPECT_LT(step, 1.35 * mean);
  }
  EXPECT_EQ(viridis(-1), viridis(0));
  EXPECT_EQ(viridis(2), viridis(1));
  EXPECT_EQ(viridis(std::nanf("")), viridis(0));
}

TEST(ColorMap, ScalesTheFirstChannel) {
  FloatImage values(3, 1, {"eps", "other"});
  values.at(0, 0, 0) = 0.1f;
  values.at(1, 0, 0) = 0.2f;
  values.at(2, 0, 0) = 0.3f;
  const Image image = colorMapped(values, {0.1f, 0.3f, "eps"});
  for (int x = 0; x < 3; ++x)
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(image.pixel(x, 0)[channel], 255.0f * viridis(0.5f * static_cast<float>(x))[channel], 0.51f);
}

}  // namespace
}  // namespace weft
