// The section `seen_errors`: written, read and refused.
#include "app/pack/seen_errors.h"
#include "tests/base/told.h"
#include "tests/pack/samples.h"

#include <gtest/gtest.h>

namespace frustumscreen::pack {
namespace {

using Json = nlohmann::json;

SeenErrors some() {
    SeenEye side{{0.0, 0.6, 0.8}, 1.75F, {}};
    side.patches[3] = {{0.25, -0.5, 0.125}, 0.75};
    side.patches[15] = {{0.5, 0.0, 1.0}, 0.25};
    SeenError error{0.1F, 0.2F, 0.3F, 1.5F, {}};
    error.patches_box[3] = 0.0625F;
    error.patches_box[15] = 0.333F;
    const SeenError none{};
    return {{side, SeenEye{}}, {{error, none}, {none, {1e-7F, 10.0F, 0.0F, 0.0F, {}}}}, {}};
}

void expect_same(const SeenErrors& a, const SeenErrors& b) {
    ASSERT_EQ(a.eyes.size(), b.eyes.size());
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t k = 0; k < a.eyes.size(); ++k) {
        EXPECT_LT(glm::distance(a.eyes[k].towards, b.eyes[k].towards), 1e-4); // four digits
        EXPECT_EQ(a.eyes[k].steepness, b.eyes[k].steepness);
        for (std::size_t patch = 0; patch < seen_patches; ++patch) {
            EXPECT_EQ(a.eyes[k].patches[patch].place, b.eyes[k].patches[patch].place);
            EXPECT_EQ(a.eyes[k].patches[patch].share, b.eyes[k].patches[patch].share);
        }
        for (std::size_t level = 0; level < a.levels.size(); ++level) {
            const SeenError& x = a.levels[level].at(k);
            const SeenError& y = b.levels[level].at(k);
            EXPECT_EQ(x.mean_box, y.mean_box);
            EXPECT_EQ(x.p95_box, y.p95_box);
            EXPECT_EQ(x.outline_shift_box, y.outline_shift_box);
            EXPECT_EQ(x.silhouette_share, y.silhouette_share);
            EXPECT_EQ(x.patches_box, y.patches_box);
        }
    }
}

TEST(SeenErrors, RoundTrip) {
    Pack pack = samples::pack();
    put_seen_errors(some(), pack);
    const Result<VerifiedPack> back = verify_pack(samples::bytes_of(pack));
    ASSERT_TRUE(back) << back.error().message;
    const Result<SeenErrors> seen = seen_errors_of(**back, 2);
    ASSERT_TRUE(seen) << seen.error().message;
    expect_same(*seen, some());
    const Json data = Json::parse((*back)->sections.at(0).data);
    EXPECT_EQ(data["eyes"][0]["places"][9], 0.25);            // x of patch 3
    EXPECT_EQ(data["levels"][0]["eyes"][0]["mean_box"], 0.1); // few digits
}

TEST(SeenErrors, StoresReliefErrorsInTheirOwnSection) {
    SeenErrors errors = some();
    errors.reliefs = {errors.levels[1]};
    Pack pack = samples::pack();
    put_seen_errors(errors, pack);
    const SeenErrors back = seen_errors_of(pack, 2).value();
    ASSERT_EQ(back.reliefs.size(), 1U);
    ASSERT_EQ(back.reliefs[0].size(), 2U);
    EXPECT_EQ(back.reliefs[0][1].mean_box, 1e-7F);
    EXPECT_EQ(back.reliefs[0][1].p95_box, 10.0F);
    ASSERT_EQ(pack.sections.back().name, "seen_reliefs");
    Json data = Json::parse(pack.sections.back().data);
    data["reliefs"][0]["eyes"].erase(0);
    pack.sections.back().data = data.dump();
    EXPECT_NE(seen_errors_of(pack, 2).error().message.find("1 errors from 2 eyes"), std::string::npos);
    pack.sections.back().data = R"({"reliefs":[],"more":1})";
    EXPECT_NE(seen_errors_of(pack, 2).error().message.find("sections.seen_reliefs.data.more"),
              std::string::npos);
}

TEST(SeenErrors, AreEmptyWithoutASection) {
    const Result<SeenErrors> seen = seen_errors_of(samples::pack(), 2);
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->eyes.empty());
    EXPECT_TRUE(seen->levels.empty());
}

TEST(SeenErrors, RejectsMalformedData) {
    const auto refusal = [](auto alter) {
        Pack pack = samples::pack();
        put_seen_errors(some(), pack);
        Json data = Json::parse(pack.sections.back().data);
        alter(data);
        pack.sections.back().data = data.dump();
        const Result<SeenErrors> seen = seen_errors_of(pack, 2);
        EXPECT_TRUE(seen || samples::is_one_line(seen.error().message));
        return seen ? std::string() : test::told(seen.error());
    };
    EXPECT_EQ(refusal([](Json&) {}), "");
    EXPECT_NE(refusal([](Json& d) { d["more"] = 1; }).find("sections.seen_errors.data.more"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& d) {
                  d["levels"][1]["eyes"][0].erase("p95_box");
              }).find("levels[1].eyes[0].p95_box is missing"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["levels"].erase(0); }).find("1 levels from 2 eyes"), std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["eyes"].erase(0); }).find("2 errors from 1 eyes"), std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["eyes"] = Json::array(); }).find("0 eyes"), std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["eyes"][0]["towards"][2] = 2.0; }).find("an eye whose"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["eyes"][0]["steepness"] = 0.5; }).find("an eye whose"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["eyes"][0]["shares"][0] = -0.5; }).find("an eye whose"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["eyes"][0]["places"][0] = 3.0; }).find("an eye whose"),
              std::string::npos);
    EXPECT_NE(refusal([](Json& d) { d["eyes"][0]["places"].erase(0); }), "");
    EXPECT_NE(refusal([](Json& d) { d["levels"][0]["eyes"][0]["patches_box"][7] = -1.0; }), "");
    EXPECT_NE(refusal([](Json& d) { d["levels"][0]["eyes"][0]["mean_box"] = -1e-3; }), "");
    EXPECT_NE(refusal([](Json& d) { d["levels"][0]["eyes"][0]["p95_box"] = 11.0; }), "");
    EXPECT_NE(refusal([](Json& d) { d["levels"][0]["eyes"][0]["silhouette_share"] = "1"; }), "");
}

} // namespace
} // namespace frustumscreen::pack
