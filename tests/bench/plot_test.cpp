#include "app/bench/plot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

namespace frustumscreen {
namespace {

/// Just enough of XML to tell whether tags nest and close, attributes are quoted and text is escaped.
::testing::AssertionResult well_formed(const std::string& xml) {
    std::vector<std::string> open;
    std::size_t at = 0;
    while (at < xml.size()) {
        if (xml[at] == '>') {
            return ::testing::AssertionFailure() << "a bare > at byte " << at;
        }
        if (xml[at] == '&') {
            const std::size_t end = xml.find(';', at);
            if (end == std::string::npos || end - at > 5) {
                return ::testing::AssertionFailure() << "a bare & at byte " << at;
            }
        }
        if (xml[at] != '<') {
            ++at;
            continue;
        }
        const std::size_t end = xml.find('>', at);
        if (end == std::string::npos) {
            return ::testing::AssertionFailure() << "an open tag at byte " << at;
        }
        const std::string tag = xml.substr(at + 1, end - at - 1);
        if (std::count(tag.begin(), tag.end(), '"') % 2 != 0 || tag.find('<') != std::string::npos) {
            return ::testing::AssertionFailure() << "a broken tag: " << tag;
        }
        const std::string name = tag.substr(0, tag.find_first_of(" /?", 1));
        if (tag.front() == '/') {
            if (open.empty() || open.back() != tag.substr(1)) {
                return ::testing::AssertionFailure() << "closes what is not open: " << tag;
            }
            open.pop_back();
        } else if (tag.back() != '/' && tag.back() != '?') {
            open.push_back(name);
        }
        at = end + 1;
    }
    return open.empty() ? ::testing::AssertionSuccess()
                        : ::testing::AssertionFailure() << open.back() << " stays open";
}

std::size_t count_of(const std::string& text, std::string_view what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++count;
    }
    return count;
}

Plot example() {
    return {"Error & cost <\"quoted\">",
            "x floor",
            "mm",
            true,
            true,
            {{"levels", {{{2.0, 0.2}, "level 0"}, {{3.5, 0.1}, "level 1"}, {{3.6, 0.098}, "level 2"}}},
             {"two-pass", {{{40.0, 0.15}, "640"}, {{55.0, 0.08}, "1024"}}, false}},
            {{0.2, "limit 0.2 mm"}}};
}

TEST(Plot, IsWellFormedXmlWhateverTheWords) {
    const std::string svg = svg_of(std::array{example(), example()});
    EXPECT_TRUE(well_formed(svg));
    EXPECT_NE(svg.find("Error &amp; cost &lt;&quot;quoted&quot;&gt;"), std::string::npos);
}

TEST(Plot, EveryPointIsDrawnAndLabelled) {
    const std::string svg = svg_of(std::array{example()});
    EXPECT_EQ(count_of(svg, "<circle"), 5U + 2U); // points and legend
    for (const char* label : {"level 0", "level 1", "level 2", "640", "1024", "limit 0.2 mm"}) {
        EXPECT_EQ(count_of(svg, std::string(">") + label + "<"), 1U) << label;
    }
}

TEST(Plot, PointsThatTheAxisCannotShowAreLeftOut) {
    Plot plot = example();
    plot.series = {{"s",
                    {{{0.0, 1.0}},
                     {{1.0, -1.0}},
                     {{std::numeric_limits<double>::quiet_NaN(), 1.0}},
                     {{1.0, std::numeric_limits<double>::infinity()}},
                     {{1.0, 1.0}}}}};
    const std::string svg = svg_of(std::array{plot});
    EXPECT_TRUE(well_formed(svg));
    EXPECT_EQ(count_of(svg, "<circle"), 1U + 1U);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(Plot, WhatLiesBelowTheLeastOfTheAxisIsDrawnThere) {
    Plot plot = example();
    plot.limits.clear();
    plot.y_least = 0.001;
    plot.series = {{"s", {{{1.0, 1.0}}, {{2.0, 0.001}}, {{3.0, 1e-7}}, {{4.0, 0.0}}}}};
    const std::string svg = svg_of(std::array{plot});
    EXPECT_EQ(count_of(svg, "<circle"), 4U + 1U);
    EXPECT_EQ(count_of(svg, "cy=\"402.0\""), 3U); // the frame's lower edge
    EXPECT_EQ(count_of(svg, ">≤ 0.001<"), 1U);
    plot.series[0].points.resize(1);
    EXPECT_EQ(count_of(svg_of(std::array{plot}), "≤"), 0U); // nothing lies there
}

TEST(Plot, ASheetHasEveryPlotAndOneLegend) {
    const std::vector<std::string> notes = {"a note & more"};
    const std::string svg = svg_sheet("A <sheet>", std::array{example(), example(), example()}, 2, notes);
    EXPECT_TRUE(well_formed(svg));
    EXPECT_EQ(count_of(svg, "<circle"), 3U * 5U + 2U);
    EXPECT_EQ(count_of(svg, ">two-pass<"), 1U);
    EXPECT_EQ(count_of(svg, "A &lt;sheet&gt;"), 1U);
    EXPECT_EQ(count_of(svg, "a note &amp; more"), 1U);
    EXPECT_TRUE(well_formed(svg_sheet("none", {}, 3, {})));
}

TEST(Plot, MarksAndLinesAreAsTheirSeriesSays) {
    Plot plot = example();
    plot.series = {{"s", {{{1.0, 1.0}}, {{2.0, 2.0}}, {{3.0, 1.0}}}, true, {2, PlotMark::Square, 3.0, true}},
                   {"hidden", {{{1.5, 1.5}}}, true, {2, PlotMark::Cross}}};
    plot.series[1].look.in_legend = false;
    const std::string svg = svg_of(std::array{plot});
    EXPECT_TRUE(well_formed(svg));
    EXPECT_EQ(count_of(svg, "<circle"), 0U);
    EXPECT_EQ(count_of(svg, "stroke-dasharray=\"5 4\""), 2U); // the line and its legend
    EXPECT_EQ(count_of(svg, ">hidden<"), 0U);
}

TEST(Plot, AnEmptyPlotIsStillAPicture) {
    const std::string svg = svg_of(std::array{Plot{"nothing", "x", "y", false, true, {}, {}}});
    EXPECT_TRUE(well_formed(svg));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_TRUE(well_formed(svg_of({})));
}

TEST(Plot, LabelsOfCrowdedPointsDoNotOverlap) {
    Plot plot{"crowd", "x", "y", true, true, {{"s", {}}}, {}};
    for (int k = 0; k < 12; ++k) {
        plot.series[0].points.push_back({{1.0 + 0.01 * k, 1.0 + 0.005 * k}, "a label of some length"});
    }
    plot.series[0].points.push_back({{10.0, 10.0}, ""});
    const std::string svg = svg_of(std::array{plot});
    std::vector<std::pair<double, double>> places;
    for (std::size_t at = svg.find("<text "); at != std::string::npos; at = svg.find("<text ", at + 1)) {
        const std::string tag = svg.substr(at, svg.find("</text>", at) - at);
        if (tag.find("a label") != std::string::npos) {
            places.emplace_back(std::stod(tag.substr(tag.find("x=\"") + 3)),
                                std::stod(tag.substr(tag.find(" y=\"") + 4)));
        }
    }
    ASSERT_GE(places.size(), 6U);          // what finds no place is left out
    constexpr double letters = 22.0 * 5.0; // at least 5 px a letter
    for (std::size_t a = 0; a < places.size(); ++a) {
        for (std::size_t b = a + 1; b < places.size(); ++b) {
            EXPECT_TRUE(std::abs(places[a].first - places[b].first) > letters ||
                        std::abs(places[a].second - places[b].second) > 12.0);
        }
    }
}

} // namespace
} // namespace frustumscreen
