// The tables of a page from CSV files: small CSV files and pages written by hand, and bad input.

#include "app/bench/latency/hand_replay.h"
#include "app/bench/latency/latency_report.h"
#include "app/bench/measures/report.h"
#include "app/bench/measures/scaling_bakes.h"
#include "app/bench/page/fill_page.h"
#include "app/bench/page/report_tables.h"
#include "app/bench/setup/zones_by_throw.h"
#include "firmware_host/base/file.h"
#include "tests/base/temporary_folder.h"
#include "tests/folders.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

namespace frustumscreen::bench {
namespace {

namespace fs = std::filesystem;

std::string page_of(const std::string& name, const std::string& table) {
    return "Before.\n\n<!-- table: " + name + " -->\n" + table + "<!-- end -->\nAfter | it.\n";
}

class ReportPage : public WithTemporaryFolder {
protected:
    [[nodiscard]] Result<FilledPage> fill(const std::string& page) const {
        return fill_page(page, "page.md", folder);
    }
    /// Fills a page with one table, and expects these lines in its place and the prose as it was.
    void expect_table(const std::string& name, const std::string& table) const {
        const Result<FilledPage> filled = fill(page_of(name, "old\n"));
        ASSERT_TRUE(filled) << filled.error().message;
        EXPECT_EQ(filled->text, page_of(name, table));
        EXPECT_EQ(filled->tables.at(0).state, TableState::Changed);
        const Result<FilledPage> again = fill(filled->text);
        ASSERT_TRUE(again);
        EXPECT_EQ(again->tables.at(0).state, TableState::Same);
        EXPECT_EQ(again->text, filled->text);
    }
    /// The error that one table's CSV leads to.
    void expect_error(const std::string& name, std::string_view id, const std::string& words) const {
        const Result<FilledPage> filled = fill(page_of(name, "old\n"));
        ASSERT_FALSE(filled);
        EXPECT_EQ(filled.error().id, id);
        EXPECT_NE(filled.error().message.find(words), std::string::npos) << filled.error().message;
        EXPECT_EQ(filled.error().message.find('\n'), std::string::npos);
    }
};

constexpr const char* frame_columns =
    "set_up,technique,kind,samples,cpu_times_floor,mean_outline_shift_px,worst_outline_shift_px,"
    "mean_silhouette_percent,mean_geometric_mean_mm,worst_geometric_mean_mm\n";

TEST_F(ReportPage, AFrameOfEachModelHasItsCostAndErrors) {
    put("lit/skull/error_time.csv", std::string(frame_columns) +
                                        "kiosk,floor,floor,1,1.0,,,,,\n"
                                        "near,mesh 2 (default),pack level,2,9.9,1,1,1,1,1\n"
                                        "kiosk,mesh 1,pack level,2,1.26,1,1,1,1,1\n"
                                        "kiosk,mesh 2 (default),pack level,2,3.449,0.0721,"
                                        "0.14649,9,0.065,0.1\n"
                                        "kiosk,relief384,pack relief,2,1.75,0.01,0.02,9,0.0049,0.0091\n");
    put("lit/bust/error_time.csv",
        std::string(frame_columns) + "kiosk,mesh 0 (default),pack level,2,31.6,0.5,1.25,9,0,12\n");
    expect_table("cost_shipped",
                 "| model | drawn as | x floor | outline px, mean | worst | mm, mean | worst |\n"
                 "|---|---|---|---|---|---|---|\n"
                 "| bust | default mesh | 32 | 0.500 | 1.250 | 0.000 | 12.000 |\n"
                 "| skull | default mesh | 3.4 | 0.072 | 0.146 | 0.065 | 0.100 |\n"
                 "| | relief384 | 1.8 | 0.010 | 0.020 | 0.005 | 0.009 |\n");
}

TEST_F(ReportPage, ListsTheCheapestPeerThatIsAsGood) {
    put("peers/skull/error_time.csv",
        std::string(frame_columns) +
            "kiosk,mesh 2 (default),pack level,2,3.0,0,0,0.100,0.050,0\n"
            "kiosk,relief384,pack relief,2,2.5,0,0,0.2,0.2,0\n"
            "kiosk,LOD 10k,LOD,2,1.0,0,0,0.106,0.050,0\n" // one error is too large
            "kiosk,LOD 20k,LOD,2,2.0,0,0,0.104,0.052,0\n"
            "kiosk,LOD 20k,LOD,1,0.5,0,0,0.100,0.050,0\n" // another number of samples
            "kiosk,LOD 40k,LOD,2,2.2,0,0,0.010,0.010,0\n"
            "kiosk,ray cast (2 samples),ray cast,2,6.04,0,0,0,0,0\n");
    put("peers/sword/error_time.csv", std::string(frame_columns) +
                                          "kiosk,mesh 2 (default),pack level,4,3.0,0,0,0.100,0.050,0\n"
                                          "kiosk,LOD 20k,LOD,4,2.0,0,0,0.2,0.052,0\n");
    expect_table("peers",
                 "| model | samples | default mesh, x floor | relief384 | meshoptimizer | ray cast |\n"
                 "|---|---|---|---|---|---|\n"
                 "| skull | 2 | 3.0 | 2.5 | 2.0 | 6.0 |\n"
                 "| sword | 4 | 3.0 | | none as good | |\n");
}

TEST_F(ReportPage, CountsPosesAndTakesTheWorstShownPictureOfBothSetUps) {
    const std::string poses =
        "set_up,technique,geometric_mean_mm,outline_shift_px,silhouette_percent,shown_cover_px,"
        "shown_cover_of_samples_px,shown_shift_px,shown_rmse\n"
        "near,relief384,0.05,0.2,0.15,0.30,0.20,0.01,2.0\n"
        "near,relief384,0.04,0.2,0.16,0.50,0.45,0.02,1.0\n"
        "kiosk,relief384,0.051,0,0,0.2,0.2,0.03,7.25\n"
        "kiosk,mesh 1 (default),9,9,9,0.1,0.2,0,0\n";
    put("lit/skull/error_time_poses.csv", poses);
    expect_table("relief_poses", "| model | near | shipped |\n|---|---|---|\n| skull | 1 of 2 | 0 of 1 |\n");
    put("shown/skull/error_time_poses.csv", poses);
    put("shown/skull/error_time.csv", "set_up,technique,kind,samples\nkiosk,relief384,pack relief,4\n");
    expect_table("as_shown",
                 "| model | drawn as | samples | cover beyond samples, px | shift, px | RMSE, codes |\n"
                 "|---|---|---|---|---|---|\n| skull | relief384 | 4 | 0.100 | 0.030 | 7.2 |\n");
}

TEST_F(ReportPage, GroupsEstimatesByTheDrawnTechnique) {
    put("estimate/six/estimate.csv", "artifact,level,poses,covered\n"
                                     "\"a, b\",mesh 0 (default),6,5\n\"a, b\",mesh 1,6,3\n"
                                     "c,mesh 1,6,6\nc,mesh 2,6,1\nc,auto (mesh 1),6,4\nc,relief96,6,2\n");
    expect_table("estimate", "| scans | drawn | covered poses | of |\n|---|---|---|---|\n"
                             "| six | levels but the finest | 11 | 12 |\n"
                             "| | finest levels | 4 | 12 |\n"
                             "| | what `auto` draws | 4 | 6 |\n"
                             "| | reliefs | 2 | 6 |\n");
}

TEST_F(ReportPage, AveragesProjectionShimmerAndEdges) {
    put("projection/skull/projection.csv", "set_up,technique,right_16_rays_percent\n"
                                           "kiosk,ray-cast picture,99\nkiosk,ray-cast picture,98\n"
                                           "kiosk,mesh 1 (default),97\nkiosk,mesh 1 (default),96.5\n"
                                           "near,mesh 1 (default),1\n");
    expect_table("projection", "| model | default, mean | default, worst | ray-cast picture, mean | "
                               "ray-cast picture, worst |\n|---|---|---|---|---|\n"
                               "| skull | 96.75 | 96.50 | 98.50 | 98.00 |\n");
    put("shimmer/skull/shimmer.csv", "set_up,technique,rms,rms_1_ray,rms_16_rays\n"
                                     "kiosk,mesh 1 (default),10,4,3\nkiosk,mesh 1 (default),11,4,3\n"
                                     "kiosk,mesh 12,2,6,4\nkiosk,mesh 12,3,7,5\n");
    expect_table("shimmer", "| model | default | finest | ray cast, 1 ray | ray cast, 16 rays |\n"
                            "|---|---|---|---|---|\n| skull | 10.50 | 2.50 | 6.50 | 4.50 |\n");
    put("shimmer/skull/edge_sparkle.csv", "set_up,pixels,edges,changes,rms\n"
                                          "near,shared,sharp,3,4\nnear,shared,sharp,1,8\n"
                                          "near,shared,feathered,5,2\nnear,beside,sharp,5,1\n"
                                          "near,beside,feathered,5,9\n");
    expect_table("edges",
                 "| set-up | model | sharp edges | soft edges | beside the edges |\n"
                 "|---|---|---|---|---|\n| near | skull | 5.3 | 2.0 | 1.0 |\n"); // sqrt((3 x 16 + 64) / 4)
}

TEST_F(ReportPage, FillsTablesOfCommandsWithoutAPack) {
    put("detail/scaling_near.csv", "source_triangles,technique,cpu_times_floor\n"
                                   "1000000,mesh 3 (default),8.5\n1000000,mesh 6,30\n1000000,relief384,5.64\n"
                                   "1000000,two-pass 1024,79.4\n500,mesh 0 (default),1\n");
    expect_table(
        "scaling_detail",
        "| source triangles | finest relief, x floor | default mesh | two-pass, eye image of 1024 |\n"
        "|---|---|---|---|\n| 500 | | 1.0 | |\n| 1,000,000 | 5.6 | 8.5 | 79 |\n");
    put("ladder/ladder_policies.csv",
        "policy,whole,untracked,words,dark,longest_dark_s,reboots,false_alarms\n"
        "ladder,0.9856,0.009,0.0052,0.00019,120,27859,0\n"
        "systemd alone,0.95,0,0,0.05,43200,0,1\n");
    expect_table("ladder",
                 "| policy | whole exhibit | does not follow | words for staff | dark | longest dark | "
                 "reboots | false alarms |\n|---|---|---|---|---|---|---|---|\n"
                 "| ladder | 98.56 % | 0.90 % | 0.52 % | 0.019 % | 2 min | 27,859 | 0 |\n"
                 "| systemd alone | 95.00 % | 0.00 % | 0.00 % | 5.00 % | 12 h | 0 | 1 |\n");
    put("stability/stability.csv", "theme,case,quantity,bound,observed,verdict\n"
                                   "light,a,\"shipped: light sent back, change a mm of the head\",1,0,held\n"
                                   "light,a,shipped: change a mm of the prop,1,7e-6,held\n"
                                   "light,a,shipped: change a turn of 0.05 deg,1,0.0123,held\n"
                                   "light,b,no walks,,,left out\n");
    expect_table("light", "| table | a mm of the head | a mm of the prop | a turn of 0.05 degrees |\n"
                          "|---|---|---|---|\n| shipped | 0 | 0.00070 % | 1.23 % |\n");
}

TEST_F(ReportPage, ScalesZoneLightByTheAreaOfTheFirstPicture) {
    put("zones/zones.csv",
        "throw_ratio,picture_width_m,picture_depth_m,zone_width_m,zone_depth_m,pixels,"
        "pixels_a_metre\n"
        "1.8750,0.8,0.5,0.4449,0.1451,35749.9,2400\n1.5000,1.0,0.625,0.59,0.27,850,1920\n");
    expect_table("zones", "| throw ratio | picture, cm | zone, cm | pixels on the ellipsoid | light | "
                          "caption of 10 mm, pixels |\n|---|---|---|---|---|---|\n"
                          "| 1.875 | 80 x 50 | 44 x 15 | 35,700 | 1.00 | 24 |\n"
                          "| 1.5 | 100 x 62 | 59 x 27 | 900 | 0.64 | 19 |\n"); // 0.8 x 0.5 / (1 x 0.625)
}

TEST_F(ReportPage, ABakeHasTheNameOfItsFolder) {
    const std::string columns = "triangles,processor_seconds,memory_bytes,pack_bytes,levels\n";
    put("bakes/skull/bakes.csv", columns + "9,14.84,123400000,3134999,7\n");
    put("bakes/cat/bakes.csv", columns + "9,3.25,99500000,640000,4\n");
    expect_table("bakes", "| model | levels | processor s | memory MB | pack MB |\n|---|---|---|---|---|\n"
                          "| cat | 4 | 3.2 | 100 | 0.64 |\n| skull | 7 | 14.8 | 123 | 3.13 |\n");
}

TEST_F(ReportPage, FillsTablesOfTestMeasurements) {
    put("tests/texts.csv", "language,texels_per_em,spread_texels,atlas_bytes,rms_at_20_px,rms_at_60_px\n"
                           "zh,48,2,13300,4.14,11.1\nen,24,2,1,9,9\nen,48,4,1,9,9\nen,48,2,8349,3.3,8.45\n"
                           "de,48,2,1,9,9\n");
    expect_table("texts", "| script | kB | at 20 | at 60 |\n|---|---|---|---|\n"
                          "| Latin | 8.3 | 3.3 | 8.4 |\n| Chinese | 13.3 | 4.1 | 11.1 |\n");
    put("tests/camera_share.csv", "use,max_share,share,poses_hz,heads_hz\n"
                                  "none,1.00,0.085,0,0\ntags,1.00,0.261,30,0\n"
                                  "none,0.25,0.0684,0,0\ntags,0.25,0.251,27.7,0\n");
    expect_table(
        "camera",
        "| use | all 30 frames | as the exhibit runs it | poses a second | heads a second |\n"
        "|---|---|---|---|---|\n| none | 8.5 % | 6.8 % | | |\n| tags | 26.1 % | 25.1 % | 27.7 | |\n");
}

TEST_F(ReportPage, KeepsATableWithoutCsvAndNamesTheMissingFiles) {
    put("ladder/ladder_policies.csv",
        "policy,whole,untracked,words,dark,longest_dark_s,reboots,false_alarms\n");
    const std::string page = page_of("ladder", "| kept |\n") + page_of("shimmer", "");
    const Result<FilledPage> filled = fill(page);
    ASSERT_TRUE(filled) << filled.error().message;
    EXPECT_EQ(filled->text, page);
    ASSERT_EQ(filled->tables.size(), 2U);
    EXPECT_EQ(line_of(filled->tables[0], false), "ladder: unchanged, because " + folder.string() +
                                                     "/ladder/ladder_policies.csv has no row for it");
    EXPECT_EQ(line_of(filled->tables[1], true),
              "shimmer: unchanged, because " + folder.string() + "/shimmer/*/shimmer.csv is missing");
}

TEST_F(ReportPage, AFolderWithoutAnyCsvIsAnError) {
    expect_error("ladder", "report.no_csv", folder.string());
}

TEST_F(ReportPage, BadCsvFilesAreNamedWithLineAndColumn) {
    const std::string columns = "policy,whole,untracked,words,dark,longest_dark_s,reboots,false_alarms\n";
    const auto ladder = [this](const std::string& text) { put("ladder/ladder_policies.csv", text); };
    const std::string file = folder.string() + "/ladder/ladder_policies.csv, line ";
    ladder("policy,whole,untracked,words,dark,reboots,false_alarms\nladder,1,0,0,0,0,0\n");
    expect_error("ladder", "csv.column", file + "1: the column 'longest_dark_s' is missing");
    for (const std::string bad : {"", "x", "nan", "inf", "1e999", "1,5", "0x1", " 1", "1 "}) {
        ladder(columns + "ladder,1,0,0,0,0,0,0\n\"a\nb\",1,0,0,\"" + bad + "\",0,0,0\n");
        expect_error("ladder", "csv.number", file + "3, column 'dark': '" + bad + "' is not a number");
    }
    ladder(columns + "ladder,1,0,0,0,0,0,0\nsystemd,1\n");
    expect_error("ladder", "csv.fields", file + "3: there are 2 fields, the first line names 8 columns");
    ladder(columns + "\"ladder,1,0,0,0,0,0,0\n");
    expect_error("ladder", "csv.quote", file + "2");
    ladder("");
    const Result<FilledPage> none = fill(page_of("ladder", "kept\n"));
    ASSERT_TRUE(none); // an empty file has no rows
    EXPECT_EQ(none->tables.at(0).state, TableState::NoRows);
}

TEST_F(ReportPage, BadMarksAreNamedWithTheirLine) {
    put("ladder/ladder_policies.csv", "policy\n");
    const auto error_of = [this](const std::string& page) {
        const Result<FilledPage> filled = fill(page);
        return filled ? std::string()
                      : fmt::format("{} {}", filled.error().id.view(), filled.error().message);
    };
    const std::string begin = "<!-- table: ladder -->\n", end = "<!-- end -->\n";
    EXPECT_TRUE(error_of("a\n" + begin).starts_with("page.mark_open page.md, line 2: "));
    EXPECT_TRUE(error_of(begin + begin + end).starts_with("page.mark_open page.md, line 1: "));
    EXPECT_TRUE(error_of(begin + end + "\n" + begin + end).starts_with("page.mark_twice page.md, line 4: "));
    EXPECT_TRUE(error_of("a\nb\n" + end).starts_with("page.mark_end page.md, line 3: "));
    EXPECT_TRUE(error_of("<!-- table: rungs -->\n" + end).starts_with("report.table page.md, line 1: "));
    EXPECT_EQ(error_of("<!-- a remark -->\n" + begin + end), "");
}

TEST_F(ReportPage, TableCellsAreQuotedForMarkdown) {
    EXPECT_EQ(markdown_table({"a", "b"}, {{"x|y", ""}, {"x|y", "2"}}),
              "| a | b |\n|---|---|\n| x\\|y | |\n| | 2 |\n");
}

/// Reads with each table what the bench itself writes: every column that a table asks for is there.
TEST_F(ReportPage, ReadsTheBenchsOwnCsvFiles) {
    TechniqueResult mesh;
    mesh.name = "mesh 1 (default)";
    mesh.kind = TechniqueKind::PackLevel;
    mesh.cpu_times_floor = 2.5;
    mesh.errors.resize(1);
    mesh.errors[0].shown.emplace();
    mesh.error.worst.outline_shift_px = 0.125;
    SetUpResult result;
    result.name = "kiosk";
    result.techniques = {mesh};
    result.poses.resize(1);
    for (const std::string run : {"lit", "shown"}) {
        put(run + "/skull/error_time.csv", summary_csv({&result, 1}));
        put(run + "/skull/error_time_poses.csv", poses_csv({&result, 1}));
    }
    expect_table("cost_shipped",
                 "| model | drawn as | x floor | outline px, mean | worst | mm, mean | worst |\n"
                 "|---|---|---|---|---|---|---|\n"
                 "| skull | default mesh | 2.5 | 0.000 | 0.125 | 0.000 | 0.000 |\n");
    expect_table("as_shown",
                 "| model | drawn as | samples | cover beyond samples, px | shift, px | RMSE, codes |\n"
                 "|---|---|---|---|---|---|\n| skull | default mesh | 1 | 0.000 | 0.000 | 0.0 |\n");

    TrackerResult tracker{{"Polhemus VIPER", 240.0, 5.0, {}}, 22.0, {}};
    FilterResult shown{"exhibit, as shown", true, {}, {}, {}, {}, {}};
    shown.trembles = {{0.005, {1.0, 2.0, 0.25}}};
    tracker.filters = {shown};
    put("latency/latency.csv", latency_csv({&tracker, 1}, {}));
    expect_table("trembling", "| slid at, mm/s | 2 | 5 | 15 | 50 | 150 |\n|---|---|---|---|---|---|\n"
                              "| as shown, 60 Hz | | | | | |\n"
                              "| as shown, 240 Hz | | 0.25 | | | |\n"
                              "| no filter, 60 Hz | | | | | |\n"
                              "| constant velocity, predicted, 60 Hz | | | | | |\n");

    const ReplayResult replayed{.tracker = "Polhemus VIPER",
                                .recording = "vicon_handheld_1.csv",
                                .filter_name = "exhibit, as shown",
                                .times = 2.0,
                                .on_table = false,
                                .slip = {1.25, 2.0, 1.5},
                                .overshoot = {0.5, 1.0, 0.6}};
    put("latency/latency_hand.csv", replay_csv({&replayed, 1}));
    expect_table(
        "hand",
        "| tracker, recording | speed | slip: for the table | constant velocity | exhibit | best weights "
        "| overshoot: for the table | constant velocity | exhibit | slid, slip: for the table | "
        "exhibit |\n|---|---|---|---|---|---|---|---|---|---|---|\n"
        "| Polhemus VIPER, Vicon | 2 | | | 1.25 | | | | 0.50 | | |\n");

    const ThrowZone zone{.throw_ratio = 2.0,
                         .picture_m = {0.5, 0.25},
                         .zone_m = {0.25, 0.125},
                         .pixels = 1200.0,
                         .pixels_a_metre = 1000.0};
    put("zones/zones.csv", zones_csv({&zone, 1}));
    expect_table("zones", "| throw ratio | picture, cm | zone, cm | pixels on the ellipsoid | light | "
                          "caption of 10 mm, pixels |\n|---|---|---|---|---|---|\n"
                          "| 2 | 50 x 25 | 25 x 12 | 1,200 | 1.00 | 10 |\n");
    const ScalingBake bake{.triangles = 8,
                           .scan_bytes = 1,
                           .seconds = 1.0,
                           .processor_seconds = 1.5,
                           .memory_bytes = 2'000'000,
                           .pack_bytes = 250'000,
                           .shown_mean_mm = 0.0,
                           .min_mean_mm = 0.0,
                           .levels = 3};
    put("bakes/star/bakes.csv", bakes_csv({&bake, 1}));
    expect_table("bakes", "| model | levels | processor s | memory MB | pack MB |\n|---|---|---|---|---|\n"
                          "| star | 3 | 1.5 | 2 | 0.25 |\n");
}

/// No table of docs/measurements.md is written by hand, and none is missing there or in docs/bench.md.
TEST(ReportTables, PagesHaveEveryTableOnceAndNoHandWrittenOne) {
    const std::string page = text_of(source_dir() + "/docs/measurements.md");
    const auto marked = marked_tables(page, "measurements.md");
    ASSERT_TRUE(marked) << marked.error().message;
    std::set<std::string> on_page, known;
    for (const MarkedTable& table : *marked) {
        on_page.insert(table.name);
    }
    const auto in_bench = marked_tables(text_of(source_dir() + "/docs/bench.md"), "bench.md");
    ASSERT_TRUE(in_bench) << in_bench.error().message;
    for (const MarkedTable& table : *in_bench) {
        EXPECT_TRUE(on_page.insert(table.name).second) << table.name << " is on both pages";
    }
    for (const ReportTable& table : all_report_tables()) {
        known.insert(table.name);
    }
    EXPECT_EQ(on_page, known);
    for (std::size_t row = page.find("\n|"); row != std::string::npos; row = page.find("\n|", row + 1)) {
        EXPECT_TRUE(std::any_of(marked->begin(), marked->end(), [row](const MarkedTable& table) {
            return table.begin <= row + 1 && row + 1 < table.end;
        })) << page.substr(row + 1, 60);
    }
}

TEST(ReportTables, NamesAreUnique) {
    std::set<std::string> names;
    for (const ReportTable& table : all_report_tables()) {
        EXPECT_TRUE(names.insert(table.name).second) << table.name;
        EXPECT_FALSE(table.files.empty());
    }
    EXPECT_EQ(names.size(), 21U);
}

} // namespace
} // namespace frustumscreen::bench
