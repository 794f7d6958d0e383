// frustumscreen-pack from outside: its output and its exit status.
#include "tests/base/text_of.h"
#include "tests/folders.h"
#include "tests/pack/world_samples.h"

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

struct Outcome {
    int status = -1;
    std::string out;
    std::string error;
};

Outcome pack_program(const std::string& arguments) {
    const std::string command =
        bin_dir() + "/frustumscreen-pack " + arguments + " > program_out.txt 2> program_error.txt";
    const int ended = std::system(command.c_str());
    return {WIFEXITED(ended) ? WEXITSTATUS(ended) : -1, text_of("program_out.txt"),
            text_of("program_error.txt")};
}

class Program : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(write_file("good.fspack", samples::bytes_of(samples::pack())));
        ASSERT_TRUE(write_file("bad.fspack", as_bytes("PK\x03\x04 and no more")));
    }
    void TearDown() override {
        for (const char* file :
             {"good.fspack", "bad.fspack", "program_out.txt", "program_error.txt", "cube.toml"}) {
            std::filesystem::remove(file);
        }
    }
};

} // namespace

TEST_F(Program, verify_distinguishes_intact_from_damaged_packs) {
    const Outcome good = pack_program("verify good.fspack");
    EXPECT_EQ(good.status, 0);
    EXPECT_EQ(good.out.find("good.fspack: intact, unsigned"), 0U) << good.out;
    EXPECT_EQ(good.error, "");
    const Outcome both = pack_program("verify bad.fspack good.fspack");
    EXPECT_EQ(both.status, 1);
    EXPECT_NE(both.out.find("good.fspack: intact"), std::string::npos);
    EXPECT_EQ(both.error.find("frustumscreen-pack: bad.fspack: "), 0U) << both.error;
    EXPECT_EQ(std::count(both.error.begin(), both.error.end(), '\n'), 1);
}

TEST_F(Program, wrong_use_ends_with_status_2) {
    EXPECT_EQ(pack_program("").status, 2);
    EXPECT_EQ(pack_program("verify").status, 2);
    EXPECT_EQ(pack_program("shake good.fspack").status, 2);
    EXPECT_EQ(pack_program("--help").status, 0);
    EXPECT_EQ(pack_program("--version").status, 0);
}

TEST_F(Program, list_and_explain_refuse_damaged_packs) {
    EXPECT_EQ(pack_program("list bad.fspack").status, 1);
    EXPECT_EQ(pack_program("explain bad.fspack --json").status, 1);
    EXPECT_EQ(pack_program("explain nowhere.fspack").status, 1);
    EXPECT_EQ(pack_program("explain good.fspack --config nowhere.toml").status, 1);
}

TEST_F(Program, list_gives_errors_in_millimetres_on_the_default_prop) {
    const Outcome outcome = pack_program("list good.fspack --json");
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["languages"], nlohmann::json({"en", "pt-BR"}));
    EXPECT_EQ(json["levels"][0]["triangles"], 3);
    EXPECT_EQ(json["parts"].size(), 7U);
    const double mm_per_box =
        place(samples::pack(), geometry::make_frustum(geometry::shipped_frustum)).metres_per_box * 1000.0;
    EXPECT_NEAR(json["levels"][1]["error"]["p95_mm"].get<double>(), 0.002 * mm_per_box, 1e-6);
}

TEST_F(Program, explain_places_the_artifact_in_the_configured_prop) {
    const Pack pack = samples::pack();
    const auto expect_matrix = [&](const std::string& options, const geometry::PropShape& prop) {
        const Outcome outcome = pack_program("explain good.fspack --json " + options);
        ASSERT_EQ(outcome.status, 0) << outcome.error;
        const auto json = nlohmann::json::parse(outcome.out);
        const auto matrix = json["prop_from_artifact"].get<std::vector<double>>();
        ASSERT_EQ(matrix.size(), 16U);
        const glm::dmat4 expected = place(pack, prop).prop_from_artifact;
        for (int k = 0; k < 16; ++k) {
            EXPECT_EQ(matrix[static_cast<std::size_t>(k)], expected[k / 4][k % 4]) << k;
        }
    };
    expect_matrix("", geometry::make_frustum(geometry::shipped_frustum));
    ASSERT_TRUE(write_file("cube.toml", as_bytes("[prop]\nkind = \"cube\"\nbase_m = 0.1\nheight_m = 0.1\n")));
    expect_matrix("--config cube.toml", geometry::make_cube(0.1));
}

TEST_F(Program, explain_prints_everything_in_a_pack) {
    ASSERT_TRUE(write_file("good.fspack", samples::bytes_of(samples::full_pack())));
    const Outcome outcome = pack_program("explain good.fspack --json");
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["id"], "museum-1234.a");
    EXPECT_EQ(json["captions"][0]["maker"], "the Amasis painter (?)");
    EXPECT_EQ(json["captions"][1], nlohmann::json({{"language", "pt-BR"},
                                                   {"title", "\xC3\x82nfora"},
                                                   {"text", ""},
                                                   {"place", "Atenas"},
                                                   {"spoken", {"description"}}}));
    EXPECT_EQ(json["hotspots"][1]["labels"][0]["text"], "The foot");
    EXPECT_EQ(json["hotspots"][0]["point_box"], nlohmann::json({0.25, -0.125, 0.5}));
    EXPECT_EQ(json["table_picture"], nlohmann::json({{"width", 31}, {"height", 17}}));
    EXPECT_EQ(json["sections"][1]["name"], "sounds");
    EXPECT_EQ(json["sections"][0]["data"]["size"], 12.5);
    EXPECT_EQ(json["parts"].size(), 12U);
    const Outcome text = pack_program("explain good.fspack");
    ASSERT_EQ(text.status, 0) << text.error;
    for (const char* words : {"id museum-1234.a", "section glyphs: unknown to this version",
                              "sounds/pt-br/0.opus", "spoken: description", "maker: the Amasis painter",
                              "en: The handle", "picture for the table: 31 x 17"}) {
        EXPECT_NE(text.out.find(words), std::string::npos) << words << "\n" << text.out;
    }
    EXPECT_NE(pack_program("list good.fspack").out.find("section glyphs: unknown to this version"),
              std::string::npos);
}

TEST_F(Program, explain_has_the_cells_and_behaviours) {
    ASSERT_TRUE(write_file("good.fspack", samples::bytes_of(samples::pack_with_world())));
    const Outcome outcome = pack_program("explain good.fspack --json");
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    const auto json = nlohmann::json::parse(outcome.out);
    ASSERT_EQ(json["cells"].size(), 3U);
    const nlohmann::json& body = json["cells"][0];
    EXPECT_EQ(body["name"], "body");
    EXPECT_EQ(body["parent"], nullptr);
    EXPECT_EQ(body["triangles"], 123456);
    // The prop's frame, in metres: the box frame times one number.
    const double metres = json["metres_per_box"];
    EXPECT_NEAR(body["box"][0][1].get<double>(), -0.125 * metres, 1e-12);
    EXPECT_NEAR(body["box"][1][2].get<double>(), 0.4 * metres, 1e-12);
    EXPECT_NEAR(json["artifact_size_m"][2].get<double>(), 0.8 * metres, 1e-12);
    EXPECT_EQ(json["cells"][2]["parent"], json["cells"][1]["name"]);
    EXPECT_EQ(json["cells"][1]["box"], json["cells"][2]["box"]) << "all that hangs from the hinge";
    EXPECT_EQ(json["behaviours"],
              nlohmann::json({{{"name", "open"}, {"seconds", 2.0}, {"trigger", "hotspot"}},
                              {{"name", "wobble"}, {"seconds", 1.0 / 3.0}, {"trigger", "button"}},
                              {{"name", "told"}, {"seconds", 0.0}, {"trigger", "narration"}}}));
    const std::string text = pack_program("explain good.fspack").out;
    for (const char* words :
         {"  cell body: 123456 triangles, ", "  cell lid, on hinge \xC3\xA0 gauche: 78 triangles, ",
          "  behaviour open: 2 s, trigger hotspot; en: Turn the lid; pt-BR: Vire a tampa\n"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
    }
    EXPECT_EQ(text.find("section cells: unknown to this version"), std::string::npos);
    EXPECT_NE(pack_program("list good.fspack").out.find("cells/2.fspack"), std::string::npos);
    // A pack without them has empty lists.
    ASSERT_TRUE(write_file("good.fspack", samples::bytes_of(samples::pack())));
    const auto plain = nlohmann::json::parse(pack_program("explain good.fspack --json").out);
    EXPECT_EQ(plain["cells"], nlohmann::json::array());
    EXPECT_EQ(plain["behaviours"], nlohmann::json::array());
}

TEST_F(Program, verify_checks_the_packs_of_cells) {
    ASSERT_TRUE(write_file("good.fspack", samples::bytes_of(samples::pack_with_world())));
    EXPECT_EQ(pack_program("verify good.fspack").status, 0);
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack_with_world()));
    samples::Entries lid = samples::take_apart(entries.part("cells/2.fspack"));
    lid.part("relief_blocks/32.bin")[4] ^= std::byte{2};
    samples::right_hashes(lid);
    entries.part("cells/2.fspack") = samples::put_together(lid);
    samples::right_hashes(entries);
    ASSERT_TRUE(write_file("good.fspack", samples::put_together(entries)));
    const Outcome outcome = pack_program("verify good.fspack");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.error.find("good.fspack: cells/2.fspack: relief_blocks/32.bin: "), std::string::npos)
        << outcome.error;
}

TEST_F(Program, verify_checks_hashes_of_section_parts) {
    samples::Entries entries = samples::take_apart(samples::bytes_of(samples::full_pack()));
    entries.part("sounds/en/0.opus")[0] ^= std::byte{1};
    ASSERT_TRUE(write_file("good.fspack", samples::put_together(entries)));
    const Outcome outcome = pack_program("verify good.fspack");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.error.find("sounds/en/0.opus does not match its hash"), std::string::npos)
        << outcome.error;
}
