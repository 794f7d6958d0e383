// What the plots of error over cost show, of results that were made up.

#include "app/bench/error_plot.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace frustumscreen {
namespace {

TechniqueResult technique(TechniqueKind kind, double cost, double error, std::uint64_t triangles = 0) {
    TechniqueResult result;
    result.name = "named " + std::to_string(triangles);
    result.kind = kind;
    result.triangles = triangles;
    result.times_floor = cost;
    PictureError one;
    one.silhouette_percent = error;
    one.geometric_mean_mm = error;
    one.sixteen_rays.rmse = 20.0 * error;
    result.errors = {one};
    result.error = summarise(result.errors);
    return result;
}

/// Three levels of a pack and three simplified meshes, the middle one dearer and worse than the first.
SetUpResult example() {
    SetUpResult result;
    result.name = "near";
    result.techniques = {technique(TechniqueKind::Floor, 1.0, 0.0),
                         technique(TechniqueKind::PackLevel, 2.0, 0.4, 1000),
                         technique(TechniqueKind::PackLevel, 3.0, 0.2, 2000),
                         technique(TechniqueKind::PackLevel, 5.0, 0.1, 3000),
                         technique(TechniqueKind::Lod, 2.5, 0.5, 5000),
                         technique(TechniqueKind::Lod, 2.9, 0.6, 7000),
                         technique(TechniqueKind::Lod, 4.0, 0.3, 9000)};
    return result;
}

std::size_t count_of(const std::string& text, std::string_view what) {
    std::size_t count = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
        ++count;
    }
    return count;
}

TEST(ErrorPlot, ShowsEveryTechniqueInThreePlotsAndTheFloorInNone) {
    const std::string svg = error_time_svg(example(), "Cat");
    // Discs of the levels and rings of their worst poses, each with its mark in the legend.
    EXPECT_EQ(count_of(svg, "<circle"), 3U * (3U + 3U + 1U + 1U));
    for (const char* label : {"5k", "7k", "9k", "named 1000", "named 2000", "named 3000"}) {
        EXPECT_EQ(count_of(svg, std::string(">") + label + "<"), 3U) << label;
    }
    EXPECT_EQ(count_of(svg, ">named 0<"), 0U); // the floor
    EXPECT_EQ(count_of(svg, ": Cat, near set-up"), 3U);
}

TEST(ErrorPlot, WhatIsNotOnItsFamilysFrontIsFaintAndNotOnTheLine) {
    const std::string svg = error_time_svg(example(), "Cat");
    EXPECT_EQ(count_of(svg, "fill-opacity"), 3U); // the middle mesh
    EXPECT_EQ(count_of(svg, ">one pass, LODs<"), 3U);
}

TEST(ErrorPlot, AFamilyWithoutMembersIsNotInTheLegend) {
    const std::string svg = error_time_svg(example(), "Cat");
    EXPECT_EQ(count_of(svg, "ray cast"), 0U);
    EXPECT_EQ(count_of(svg, "two-pass"), 0U);
}

TEST(ErrorPlot, TheSheetOfAllHasARowForEachSetUpAndNamesTheArtifacts) {
    ArtifactResults cat{"Cat", {example(), example()}};
    cat.set_ups[1].name = "kiosk";
    ArtifactResults skull{"Skull", {example()}};
    const std::string svg = overall_svg(std::vector{cat, skull});
    EXPECT_EQ(count_of(svg, "Error against cost, 2 artifacts"), 1U);
    EXPECT_EQ(count_of(svg, "Artifacts: Cat, Skull."), 1U);
    EXPECT_EQ(count_of(svg, ", near set-up<"), 3U);
    EXPECT_EQ(count_of(svg, ", kiosk set-up<"), 3U);
    EXPECT_EQ(count_of(overall_svg(std::vector{skull}), "Error against cost, 1 artifact<"), 1U);
    // Faint discs of every level, and the marks of the lines that half of the artifacts reach.
    EXPECT_EQ(count_of(svg, "fill=\"#00507f\" fill-opacity"), 3U * (2U * 3U + 3U));
}

} // namespace
} // namespace frustumscreen
