// Dominance between made-up results.

#include "app/bench/measures/dominance.h"
#include "app/bench/measures/report.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace frustumscreen::bench {
namespace {

/// Mean silhouette in percent, geometric error in mm, colour error in codes.
struct Errors {
    double silhouette, geometric, colour;
};

TechniqueResult technique(const std::string& name, TechniqueKind kind, double cost, const Errors& errors,
                          std::uint64_t triangles = 1000) {
    TechniqueResult result;
    result.name = name;
    result.kind = kind;
    result.level = kind == TechniqueKind::PackLevel ? 0 : -1;
    result.triangles = triangles;
    result.times_floor = cost;
    PictureError error;
    error.silhouette_percent = errors.silhouette;
    error.geometric_mean_mm = errors.geometric;
    error.sixteen_rays.rmse = errors.colour;
    result.errors = {error};
    result.error = summarise(result.errors);
    return result;
}

const Errors middling{0.2, 0.1, 8.0};

SetUpResult with(std::vector<TechniqueResult> peers) {
    SetUpResult result;
    result.name = "near";
    result.techniques = {technique("floor", TechniqueKind::Floor, 1.0, {0, 0, 0}),
                         technique("mesh 0", TechniqueKind::PackLevel, 4.0, middling)};
    result.techniques.insert(result.techniques.end(), peers.begin(), peers.end());
    return result;
}

/// Two verdicts: by shape, then by colour.
std::vector<LimitVerdict> verdicts_beside(const TechniqueResult& peer) {
    std::vector<LimitVerdict> verdicts = judge_dominance(with({peer}));
    EXPECT_EQ(verdicts.size(), 2U);
    return verdicts;
}

TEST(Dominance, SkipsColourForPeersWithoutThePacksLight) {
    SetUpResult result = with({technique("LOD 10k", TechniqueKind::Lod, 3.0, middling)});
    result.baked_light = true;
    const std::vector<LimitVerdict> verdicts = judge_dominance(result);
    ASSERT_EQ(verdicts.size(), 1U);
    EXPECT_NE(verdicts.front().what.find("shape"), std::string::npos);
}

TEST(Dominance, CheaperPeerThatIsNowhereWorseDominatesInShapeAndColour) {
    const TechniqueResult peer = technique("LOD 10k", TechniqueKind::Lod, 3.0, middling);
    for (const LimitVerdict& verdict : verdicts_beside(peer)) {
        EXPECT_FALSE(verdict.held);
        EXPECT_NE(verdict.what.find("mesh 0"), std::string::npos);
        EXPECT_NE(verdict.found.find("LOD 10k"), std::string::npos);
    }
    const SetUpResult result = with({peer});
    EXPECT_EQ(dominated_by(result, result.techniques[1], Dominance::Shape), "LOD 10k");
    EXPECT_EQ(dominated_by(result, result.techniques[1], Dominance::Colour), "LOD 10k");
}

TEST(Dominance, ShapeAndColourAreJudgedApart) {
    for (const Errors& errors : {Errors{0.21, 0.01, 1.0}, Errors{0.01, 0.11, 1.0}}) {
        const std::vector<LimitVerdict> verdicts =
            verdicts_beside(technique("LOD", TechniqueKind::Lod, 1.5, errors));
        EXPECT_TRUE(verdicts[0].held);
        EXPECT_FALSE(verdicts[1].held);
    }
    const std::vector<LimitVerdict> verdicts =
        verdicts_beside(technique("LOD", TechniqueKind::Lod, 1.5, {0.01, 0.01, 8.1}));
    EXPECT_FALSE(verdicts[0].held);
    EXPECT_TRUE(verdicts[1].held);
    for (const LimitVerdict& dear :
         verdicts_beside(technique("LOD", TechniqueKind::Lod, 5.0, {0.0, 0.0, 0.0}))) {
        EXPECT_TRUE(dear.held);
    }
}

TEST(Dominance, ShapeIsJudgedAmongPicturesOfAsManySamples) {
    TechniqueResult peer = technique("LOD", TechniqueKind::Lod, 1.5, {0.0, 0.0, 0.0});
    peer.samples = 4;
    const std::vector<LimitVerdict> verdicts = judge_dominance(with({peer}));
    ASSERT_EQ(verdicts.size(), 1U); // no peer has one sample per pixel, like the level
    EXPECT_NE(verdicts[0].what.find("colour"), std::string::npos);
    EXPECT_FALSE(verdicts[0].held);
    const SetUpResult result = with({peer});
    EXPECT_EQ(dominated_by(result, result.techniques[1], Dominance::Shape), "");
}

TEST(Dominance, JudgesThePacksReliefsButNotAgainstItsLevels) {
    const TechniqueResult relief = technique("relief96", TechniqueKind::PackRelief, 3.5, middling);
    EXPECT_TRUE(judge_dominance(with({relief})).empty()); // cheaper than the level, and no worse
    const TechniqueResult peer = technique("LOD", TechniqueKind::Lod, 3.0, {0.2, 0.1, 9.0});
    const SetUpResult result = with({relief, peer});
    const std::vector<LimitVerdict> verdicts = judge_dominance(result);
    ASSERT_EQ(verdicts.size(), 4U);
    EXPECT_NE(verdicts[2].what.find("relief96"), std::string::npos);
    EXPECT_FALSE(verdicts[2].held);
    EXPECT_TRUE(verdicts[3].held);
    EXPECT_EQ(dominated_by(result, result.techniques[2], Dominance::Shape), "LOD");
    EXPECT_NE(summary_csv({{result}}).find("relief96,pack relief"), std::string::npos);
}

TEST(Dominance, TreatsTimesWithinToleranceAsATieAndNamesThePeer) {
    for (const double cost : {3.85, 4.0, 4.15}) {
        for (const LimitVerdict& verdict :
             verdicts_beside(technique("LOD 10k", TechniqueKind::Lod, cost, middling))) {
            EXPECT_TRUE(verdict.held) << cost;
            EXPECT_NE(verdict.found.find("LOD 10k"), std::string::npos) << cost;
        }
    }
    EXPECT_FALSE(verdicts_beside(technique("LOD 10k", TechniqueKind::Lod, 3.8, middling))[0].held);
}

TEST(Dominance, TheRayCastIsJudgedAndTheFloorIsNot) {
    for (const LimitVerdict& verdict :
         verdicts_beside(technique("ray cast", TechniqueKind::RayCast, 2.0, {0, 0, 0}))) {
        EXPECT_FALSE(verdict.held);
        EXPECT_EQ(verdict.found.find("floor"), std::string::npos);
    }
    EXPECT_TRUE(judge_dominance(with({})).empty());
}

TEST(Dominance, BestEyeImageIsTheCheapestNotBeatenAtItsCost) {
    const auto best_of = [](double cost_640, double cost_1024, double cost_1600) {
        const SetUpResult result =
            with({technique("640", TechniqueKind::TwoPass, cost_640, {0.4, 0.2, 9.0}),
                  technique("1024", TechniqueKind::TwoPass, cost_1024, {0.3, 0.1, 8.0}),
                  technique("1600", TechniqueKind::TwoPass, cost_1600, {0.2, 0.05, 7.0}),
                  technique("640 of another mesh", TechniqueKind::TwoPass, 2.0, {0.9, 0.9, 9.0}, 500)});
        std::string names;
        for (const TechniqueResult* one : at_best_eye_images(result)) {
            names += one->kind == TechniqueKind::TwoPass ? one->name + ";" : "";
        }
        return names;
    };
    EXPECT_EQ(best_of(30.0, 40.0, 50.0), "640;640 of another mesh;");
    EXPECT_EQ(best_of(30.0, 31.0, 50.0), "1024;640 of another mesh;"); // equally good at no extra cost
    EXPECT_EQ(best_of(30.0, 31.0, 32.0), "1600;640 of another mesh;");
}

TEST(Verdicts, CsvHasFourFieldsInEachRow) {
    const SetUpResult result = with({technique("a \"quoted\", name", TechniqueKind::Lod, 3.0, middling)});
    const std::vector<LimitVerdict> figures = {{"level 0: said, and", "found", false}};
    const std::string csv = verdicts_csv({&result, 1}, figures);
    EXPECT_EQ(csv.find("set_up,what,found,verdict\n"), 0U);
    EXPECT_NE(csv.find("pack,\"level 0: said, and\",\"found\",missed\n"), std::string::npos);
    EXPECT_NE(csv.find("a \"\"quoted\"\", name"), std::string::npos);
    for (std::size_t at = 0; at < csv.size();) {
        const std::size_t end = csv.find('\n', at);
        std::size_t fields = 1;
        bool inside = false;
        for (; at < end; ++at) {
            inside = csv[at] == '"' ? !inside : inside;
            fields += !inside && csv[at] == ',' ? 1 : 0;
        }
        EXPECT_EQ(fields, 4U);
        EXPECT_FALSE(inside);
        at = end + 1;
    }
}

} // namespace
} // namespace frustumscreen::bench
