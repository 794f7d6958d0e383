// Hand-made manifests with parts whose hashes are valid.
#include "tests/pack/samples.h"

#include <functional>

using namespace frustumscreen;
using namespace frustumscreen::pack;
using Json = nlohmann::ordered_json;

namespace {

struct Hostile {
    const char* word; ///< must be in the message
    std::function<void(Json&)> change;
};

void expect_refused(const std::vector<Hostile>& cases) {
    const Bytes bytes = samples::bytes_of(samples::pack());
    for (const Hostile& hostile : cases) {
        samples::Entries entries = samples::take_apart(bytes);
        hostile.change(entries.manifest);
        const std::string message = samples::refusal_of(samples::put_together(entries));
        EXPECT_TRUE(samples::is_one_line(message)) << hostile.word << ": " << message;
        EXPECT_NE(message.find(hostile.word), std::string::npos) << hostile.word << ": " << message;
    }
}

std::string refusal_of_text(const std::string& manifest) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    return samples::refusal_of(samples::put_together(manifest, entries.parts));
}

} // namespace

TEST(HostileManifest, a_later_version_asks_for_a_newer_program) {
    expect_refused({{"needs a newer FrustumScreen", [](Json& m) { m["version"] = 3; }},
                    {"needs a newer FrustumScreen", [](Json& m) {
                         m = {{"format", "FrustumScreen pack"}, {"version", 7}, {"all", "other"}};
                     }}});
}

TEST(HostileManifest, invalid_format_or_version_is_refused) {
    expect_refused({{"format", [](Json& m) { m["format"] = "Another pack"; }},
                    {"format", [](Json& m) { m.erase("format"); }},
                    {"version", [](Json& m) { m["version"] = 0; }},
                    {"version", [](Json& m) { m["version"] = -1; }},
                    {"version", [](Json& m) { m["version"] = 1.5; }},
                    {"version", [](Json& m) { m["version"] = "1"; }},
                    {"manifest", [](Json& m) { m = Json::array(); }}});
}

TEST(HostileManifest, every_missing_field_is_named) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    for (const auto& [key, value] : entries.manifest.items()) {
        Json less = entries.manifest;
        less.erase(key);
        const std::string message = refusal_of_text(less.dump());
        EXPECT_NE(message.find(key + " is missing"), std::string::npos) << message;
    }
}

TEST(HostileManifest, a_level_without_error_figures_is_refused_by_name) {
    expect_refused(
        {{"levels[0].error is missing", [](Json& m) { m["levels"][0].erase("error"); }},
         {"levels[0].error", [](Json& m) { m["levels"][0]["error"] = nullptr; }},
         {"levels[1].error.p95_box is missing", [](Json& m) { m["levels"][1]["error"].erase("p95_box"); }},
         {"levels[1].error.p95_box", [](Json& m) { m["levels"][1]["error"]["p95_box"] = nullptr; }}});
}

TEST(HostileManifest, every_field_of_another_type_is_refused) {
    const samples::Entries entries = samples::take_apart(samples::bytes_of(samples::pack()));
    for (const Json& place : {entries.manifest.flatten()}) {
        for (const auto& [pointer, value] : place.items()) {
            Json other = entries.manifest;
            other[Json::json_pointer(pointer)] = Json::array({Json::array({Json::object()})});
            EXPECT_TRUE(samples::is_one_line(refusal_of_text(other.dump()))) << pointer;
        }
    }
}

TEST(HostileManifest, unknown_and_repeated_fields_are_refused) {
    expect_refused({{"colour", [](Json& m) { m["colour"] = 1; }},
                    {"levels[1].hidden", [](Json& m) { m["levels"][1]["hidden"] = 1; }},
                    {"provenance.x", [](Json& m) { m["provenance"]["x"] = nullptr; }},
                    {"[2J", [](Json& m) { m["\x1b[2J\n"] = 1; }}});
    std::string text = samples::take_apart(samples::bytes_of(samples::pack())).manifest.dump();
    text.insert(text.find("\"title\""), "\"title\": \"first\", ");
    EXPECT_NE(refusal_of_text(text).find("title occurs twice"), std::string::npos);
}

TEST(HostileManifest, malformed_json_is_refused) {
    for (const std::string& text :
         std::vector<std::string>{"", "{", "nul", "{\"format\": \"\xFF\"}", std::string(100000, '['),
                                  "{\"version\": 1e999}", std::string("{\0}", 3), "{} {}"}) {
        const std::string message = refusal_of_text(text);
        EXPECT_TRUE(samples::is_one_line(message)) << message;
        EXPECT_NE(message.find("manifest"), std::string::npos) << message;
    }
}

TEST(HostileManifest, invalid_texts_and_values_are_refused) {
    expect_refused(
        {{"title", [](Json& m) { m["title"] = std::string(1001, 'x'); }},
         {"title", [](Json& m) { m["title"] = "clear \x1b[2J"; }},
         {"title", [](Json& m) { m["title"] = "two\nlines"; }},
         {"title", [](Json& m) { m["title"] = "\xC2\x85"; }},
         {"language 0", [](Json& m) { m["languages"][0] = "english please"; }},
         {"languages", [](Json& m) { m["languages"] = std::vector<std::string>(65, "en"); }},
         {"caption 1", [](Json& m) { m["captions"][1]["text"] = std::string(100001, 'x'); }},
         {"caption 0", [](Json& m) { m["captions"][0]["language"] = "../en"; }},
         {"[pack.source_name]", [](Json& m) { m["provenance"]["source_name"] = "../../etc/passwd"; }},
         {"sha256", [](Json& m) { m["provenance"]["source_sha256"] = "12"; }},
         {"prop_kind", [](Json& m) { m["prop_kind"] = "sphere"; }},
         {"samples", [](Json& m) { m["samples"] = 3; }},
         {"relief_size", [](Json& m) { m["relief_size"] = 1000000; }}});
}

TEST(HostileManifest, invalid_placement_is_refused) {
    expect_refused(
        {{"scale", [](Json& m) { m["placement"]["scale"] = 0.0; }},
         {"scale", [](Json& m) { m["placement"]["scale"] = -1.0; }},
         {"scale", [](Json& m) { m["placement"]["scale"] = 1e9; }},
         {"scale", [](Json& m) { m["placement"]["scale"] = "large"; }},
         {"scale", [](Json& m) { m["placement"]["scale"] = nullptr; }},
         {"box_size", [](Json& m) { m["placement"]["box_size"][0] = 0.9; }},
         {"box_size", [](Json& m) { m["placement"]["box_size"][1] = 0.0; }},
         {"box_size", [](Json& m) { m["placement"]["box_size"][1] = -0.5; }},
         {"box_size",
          [](Json& m) {
              m["placement"]["box_size"] = {1, 1};
          }},
         {"box_from_file", [](Json& m) { m["placement"]["box_from_file"][0] = 2.0; }},
         {"box_from_file", [](Json& m) { m["placement"]["box_from_file"][3] = 0.5; }},
         {"box_from_file", [](Json& m) { m["placement"]["box_from_file"] = std::vector<double>(16, 0.0); }},
         {"box_from_file",
          [](Json& m) {
              for (std::size_t k = 0; k < 3; ++k) { // mirrored
                  m["placement"]["box_from_file"][k] = -m["placement"]["box_from_file"][k].get<double>();
              }
          }},
         {"extremes", [](Json& m) { m["placement"]["extremes"] = Json::array(); }},
         {"extremes", [](Json& m) { m["placement"]["extremes"][0][2] = -0.1; }},
         {"extremes", [](Json& m) { m["placement"]["extremes"][1][0] = 3.0; }},
         {"extremes",
          [](Json& m) {
              m["placement"]["extremes"][1] = {0.0, 0.0};
          }},
         {"extremes", [](Json& m) {
              m["placement"]["extremes"] = Json::array({{0.0, 0.0, 0.1}}); // a giant in the prop
          }}});
}

TEST(HostileManifest, inconsistent_levels_are_refused) {
    expect_refused({{"default_level", [](Json& m) { m["default_level"] = 2; }},
                    {"levels", [](Json& m) { m["levels"] = Json::array(); }},
                    {"technique", [](Json& m) { m["levels"][0]["technique"] = "march"; }},
                    {"other triangles", [](Json& m) { m["levels"][0]["technique"] = "relief"; }},
                    {"other triangles", [](Json& m) { m["levels"][0]["triangles"] = 4; }},
                    {"other triangles", [](Json& m) { m["levels"][0]["vertices"] = 5; }},
                    {"texture", [](Json& m) { m["levels"][0]["texture"] = "textures/9.png"; }},
                    {"texture is 9 x 5", [](Json& m) { m["levels"][1]["texture"] = "textures/0.png"; }},
                    {"twice", [](Json& m) { m["levels"][1]["mesh"] = "levels/0.bin"; }},
                    {"[pack.part_not_in_manifest]", [](Json& m) { m["levels"][1]["mesh"] = "levels/7.bin"; }},
                    {"FSLV",
                     [](Json& m) {
                         m["levels"][1]["mesh"] = m["relief"]["charts"];
                         m["relief"] = nullptr;
                     }},
                    {"error", [](Json& m) { m["levels"][0]["error"]["mean_box"] = -1.0; }},
                    {"error", [](Json& m) { m["levels"][0]["error"]["max_box"] = 1e300; }},
                    {"error", [](Json& m) { m["levels"][0]["error"]["colour_rmse"] = 256; }}});
}

TEST(HostileManifest, parts_that_contradict_the_entries_are_refused) {
    expect_refused({{"missing", [](Json& m) { m["parts"][0]["name"] = "textures/8.png"; }},
                    {"manifest says", [](Json& m) { m["parts"][0]["bytes"] = 5; }},
                    {"bytes", [](Json& m) { m["parts"][0]["bytes"] = 1ULL << 40; }},
                    {"hash", [](Json& m) { m["parts"][0]["sha256"] = std::string(64, '0'); }},
                    {"twice", [](Json& m) { m["parts"].push_back(m["parts"][0]); }},
                    {"not listed", [](Json& m) { m["parts"].erase(0); }},
                    {"name", [](Json& m) { m["parts"][0]["name"] = "/etc/passwd"; }},
                    {"name", [](Json& m) { m["parts"][0]["name"] = "a/../b"; }},
                    {"name", [](Json& m) { m["parts"][0]["name"] = "signature"; }},
                    {"parts", [](Json& m) { m["parts"] = std::vector<Json>(1000, m["parts"][0]); }},
                    {"nothing uses the part textures/0.png", [](Json& m) {
                         m["textures"].erase(0);
                         m["levels"][0]["texture"] = "textures/1.png";
                     }}});
}

TEST(HostileManifest, invalid_relief_is_refused) {
    expect_refused({{"texel_box", [](Json& m) { m["relief"]["texel_box"] = 0.0; }},
                    {"texel_box", [](Json& m) { m["relief"]["texel_box"] = 1e-60; }},
                    {"texel_box", [](Json& m) { m["relief"]["texel_box"] = 2.0; }},
                    {"[image.png_not_grey16]",
                     [](Json& m) {
                         m["relief"]["atlas"] = "textures/0.png";
                         m["textures"].erase(0);
                         m["levels"][0]["texture"] = "textures/1.png";
                     }},
                    {"relief", [](Json& m) { m["relief"] = nullptr; }}});
}
