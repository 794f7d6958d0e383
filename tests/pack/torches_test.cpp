// The section torches: written, read part by part, and refused.
#include "app/image/film_frame.h"
#include "app/pack/colours_part.h"
#include "app/pack/pack_file.h"
#include "app/pack/pack_relief.h"
#include "app/pack/pack_torches.h"
#include "app/pack/pack_world.h"
#include "tests/base/told.h"
#include "tests/pack/samples.h"
#include "tests/pack/world_samples.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

constexpr std::size_t corners = 3 * 81; // of the sample's reliefs

std::vector<glm::u8vec4> layer_colours(std::uint8_t first) {
    std::vector<glm::u8vec4> colours;
    for (std::size_t k = 0; k < corners; ++k) {
        const auto code = static_cast<std::uint8_t>(first + k);
        colours.emplace_back(code, 255 - code, 3 * code, 255 - (code & 7U));
    }
    return colours;
}

torch::Stage stage(torch::Source source, std::uint32_t item = 0) {
    torch::Stage made;
    made.source = source;
    made.item = item;
    return made;
}

/// Three contents: a layer under a pulsing ring, a film, a picture with a lens.
PackTorches contents() {
    PackTorches torches;
    PackTorchContent xray;
    xray.content = {.name = "x-ray", .blend = torch::Blend::Over, .stages = {stage(torch::Source::Layer)}};
    torch::Stage ring = stage(torch::Source::Ring);
    ring.mix = torch::Mix::Add;
    ring.colour = {0.1F, 1.0F, 2.5F};
    ring.opacity = 1.0 / 3.0;
    ring.size = 0.9;
    ring.width = 0.01;
    ring.scroll_per_s = {-0.5, 0.125};
    ring.turn_rad_per_s = -0.7;
    ring.pulse_hz = 2.0;
    ring.pulse_depth = 0.25;
    xray.content.stages.push_back(ring);
    xray.titles = {{"en", "X-ray"}, {"pt-BR", "Raio X"}};
    PackTorchContent growth;
    growth.content = {.name = "growth", .stages = {stage(torch::Source::Film)}};
    growth.content.shape = torch::Shape::Rectangle;
    growth.content.height_per_width = 0.75;
    PackTorchContent marks;
    marks.content = {.name = "marks", .stages = {stage(torch::Source::Picture), stage(torch::Source::Lens)}};
    torches.contents = {xray, growth, marks};
    torches.pictures = {{.width = 20, .height = 10}};
    torches.films = {{.width = 16, .height = 12, .rate_hz = 12.5}};
    torches.layers = {{.name = "xray.png"}};
    return torches;
}

TorchParts parts() {
    TorchParts parts;
    parts.pictures = {image::encode_webp(samples::texture(20, 10, 5, false))};
    parts.films.push_back({});
    for (unsigned k = 0; k < 3; ++k) {
        parts.films[0].push_back(image::encode_film_frame(samples::texture(16, 12, 10 + k, false), 80.0F));
    }
    parts.layers = {{{image::encode_webp(samples::texture(9, 5, 20, false)),
                      image::encode_webp(samples::texture(13, 7, 21, false))},
                     {encode_colours(layer_colours(7)), encode_colours(layer_colours(70))}}};
    return parts;
}

Pack pack_with_torches() {
    Pack pack = samples::pack_with_reliefs();
    const Result<void> put = put_torches(pack, contents(), parts());
    EXPECT_TRUE(put) << (put ? "" : put.error().message);
    return pack;
}

/// Messages on contents and parts that were altered.
std::string refusal(const std::function<void(PackTorches&, TorchParts&)>& alter) {
    Pack pack = samples::pack_with_reliefs();
    PackTorches torches = contents();
    TorchParts its = parts();
    alter(torches, its);
    Result<void> good = put_torches(pack, std::move(torches), std::move(its));
    good = good ? check_torches(pack) : good;
    return good ? std::string() : test::told(good.error());
}

std::string refusal_of_data(const std::string& from, const std::string& to) {
    Pack pack = pack_with_torches();
    std::string& data = pack.sections.back().data;
    const std::size_t at = data.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in " << data;
    data.replace(at, from.size(), to);
    const Result<PackTorches> read = torches_of(pack);
    return read ? std::string() : test::told(read.error());
}

void expect_told(const std::string& message, std::string_view words) {
    EXPECT_TRUE(samples::is_one_line(message)) << message;
    EXPECT_NE(message.find(words), std::string::npos) << words << ": " << message;
}

} // namespace

TEST(Torches, a_pack_written_and_read_has_the_same_contents) {
    const Pack pack = pack_with_torches();
    const Bytes bytes = samples::bytes_of(pack);
    const Result<VerifiedPack> read = verify_pack(bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(check_torches(**read));
    const Result<PackTorches> torches = torches_of(**read);
    ASSERT_TRUE(torches) << torches.error().message;
    const PackTorches written = contents();
    EXPECT_EQ(torches->contents, written.contents);
    ASSERT_EQ(torches->films.size(), 1U);
    EXPECT_EQ(torches->films[0].frames, 3U);
    EXPECT_EQ(torches->films[0].parts[2], "torches/film_0/00002.webp");
    EXPECT_EQ(torches->films[0].rate_hz, 12.5);
    EXPECT_EQ(torches->layers[0].name, "xray.png");
    EXPECT_EQ(write_pack(**read).value(), bytes);
}

TEST(Torches, each_picture_frame_and_layer_is_read_alone) {
    const std::filesystem::path file = "torches.fspack";
    ASSERT_TRUE(write_file(file, samples::bytes_of(pack_with_torches())));
    const PackTorches torches = torches_of(**load_pack(file)).value();
    EXPECT_EQ(load_torch_picture(file, torches.pictures[0]).value().texels,
              samples::texture(20, 10, 5, false).texels);
    const image::Image8 frame = load_film_frame(file, torches.films[0], 1).value();
    EXPECT_EQ(frame.texels, image::decode_still(parts().films[0][1], {16, 12}).value().texels);
    const std::vector<Bytes> film = load_film(file, torches.films[0]).value();
    ASSERT_EQ(film.size(), 3U);
    EXPECT_EQ(film_frame_of(torches.films[0], film[1]).value().texels, frame.texels);
    EXPECT_EQ(load_layer_texture(file, torches.layers[0], 1).value().texels,
              samples::texture(13, 7, 21, false).texels);
    EXPECT_EQ(load_layer_colours(file, torches.layers[0], 1, corners).value(), layer_colours(70));
    EXPECT_FALSE(load_layer_colours(file, torches.layers[0], 1, 2 * corners)) << "of another relief";
}

TEST(Torches, empty_contents_do_not_change_the_bytes) {
    Pack pack = samples::pack_with_reliefs();
    const Bytes before = samples::bytes_of(pack);
    ASSERT_TRUE(put_torches(pack, {}, {}));
    EXPECT_EQ(samples::bytes_of(pack), before);
    EXPECT_TRUE(torches_of(pack).value().empty());
    EXPECT_TRUE(check_torches(pack));
}

TEST(Torches, cell_must_have_the_artifacts_layers_and_no_contents) {
    const auto with_layer = [](Pack pack, const char* name) {
        TorchParts its;
        TorchParts::Layer& layer = its.layers.emplace_back();
        for (const image::Image8& texture : pack.textures) {
            layer.textures.push_back(image::encode_webp(texture));
        }
        EXPECT_TRUE(put_torches(pack, {{}, {}, {}, {{.name = name}}}, std::move(its)));
        return pack;
    };
    const auto told = [&](const Pack& whole, Pack cell) {
        PackWorld world{{samples::cells().front()}, {samples::behaviours().back()}};
        Pack made = whole;
        const Result<void> put = put_world(made, world, std::vector{std::move(cell)});
        const Result<void> good = put ? check_world(made) : put;
        return good ? std::string() : test::told(good.error());
    };
    const Pack whole = with_layer(samples::pack(), "a");
    EXPECT_EQ(told(whole, with_layer(samples::small_cell_pack(), "a")), "");
    expect_told(told(whole, samples::small_cell_pack()), "[world.nested_layers]");
    expect_told(told(whole, with_layer(samples::small_cell_pack(), "b")), "[world.nested_layers]");
    Pack with_content = samples::small_cell_pack();
    PackTorches content;
    content.contents.push_back({{.name = "light", .stages = {torch::Stage{}}}, {}});
    ASSERT_TRUE(put_torches(with_content, content, {}));
    expect_told(told(samples::pack(), with_content), "[world.nested_torches]");
}

TEST(Torches, layer_colours_match_the_format_page) {
    const std::vector<glm::u8vec4> colours = layer_colours(7);
    const Bytes bytes = encode_colours(colours);
    ASSERT_EQ(bytes.size(), 12U + 4U * corners);
    EXPECT_EQ(as_text(bytes).substr(0, 4), "FSRL");
    EXPECT_EQ(std::to_integer<int>(bytes[4]), 1);
    EXPECT_EQ(std::to_integer<int>(bytes[8]), 3) << "blocks";
    EXPECT_EQ(std::to_integer<int>(bytes[12]), 7) << "the first red";
    EXPECT_EQ(std::to_integer<int>(bytes[13]), 1) << "one more than on the left";
    EXPECT_EQ(std::to_integer<int>(bytes[12 + 9]), 9) << "more than the one above";
    EXPECT_EQ(std::to_integer<int>(bytes[12 + 3 * corners]), 255 - 7) << "the first alpha";
}

TEST(Torches, reports_invalid_contents_in_one_line) {
    ASSERT_EQ(refusal([](PackTorches&, TorchParts&) {}), "");
    using Alter = std::function<void(PackTorches&, TorchParts&)>;
    struct Fault {
        Alter alter;
        const char* words;
    };
    const auto first = [](const std::function<void(torch::Stage&)>& alter) {
        return [alter](PackTorches& torches, TorchParts&) { alter(torches.contents[0].content.stages[1]); };
    };
    const double no_number = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Fault> faults{
        {[](PackTorches& torches, TorchParts&) { torches.contents[1].content.name = "x-ray"; },
         "two torch contents"},
        {[](PackTorches& torches, TorchParts&) { torches.contents[1].content.name = "white"; }, "'white'"},
        {[](PackTorches& torches, TorchParts&) { torches.contents[1].content.name = "a\nb"; }, "one line"},
        {[](PackTorches& torches, TorchParts&) { torches.contents[1].content.stages.clear(); }, "0 stages"},
        {[](PackTorches& torches, TorchParts&) {
             torches.contents[1].content.stages.assign(2, stage(torch::Source::Film));
         },
         "more than one picture or film"},
        {[](PackTorches& torches, TorchParts&) {
             torches.contents[1].content.stages.assign(2, stage(torch::Source::Lens));
         },
         "more than one lens"},
        {[](PackTorches& torches, TorchParts&) { torches.contents[1].content.stages[0].item = 1; },
         "number 1 of 1"},
        {[](PackTorches& torches, TorchParts&) { torches.contents[1].content.height_per_width = 1e9; },
         "height_per_width"},
        {[](PackTorches& torches, TorchParts&) {
             torches.contents[0].titles.push_back({"en", "again"});
         },
         "[hotspot.label_twice]"},
        {first([&](torch::Stage& ring) { ring.opacity = 1.5; }), "opacity 1.5"},
        {first([&](torch::Stage& ring) { ring.size = no_number; }), "size"},
        {first([&](torch::Stage& ring) { ring.width = 0.0; }), "width 0"},
        {first([&](torch::Stage& ring) { ring.colour.y = -1.0F; }), "colour -1"},
        {first([&](torch::Stage& ring) { ring.magnification = 0.5; }), "magnification 0.5"},
        {first([&](torch::Stage& ring) { ring.pulse_hz = 10.0; }), "pulse_hz 10; allowed are 0 to 2.5"},
        {first([&](torch::Stage& ring) { ring.turn_rad_per_s = 1e30; }), "turn_rad_per_s"},
        {[](PackTorches& torches, TorchParts&) { torches.pictures[0].width = 1; }, "1 x 10 pixels"},
        {[](PackTorches& torches, TorchParts&) {
             torches.pictures[0] = {16384, 16384};
         },
         "whole numbers from 0 to 2048"},
        {[](PackTorches& torches, TorchParts&) { torches.films[0].rate_hz = 0.0; }, "0 a second"},
        {[](PackTorches& torches, TorchParts& its) {
             torches.films[0].width = 1024;
             its.films[0].assign(601, Bytes(1));
         },
         "600"},
        {[](PackTorches& torches, TorchParts& its) {
             torches.layers.push_back(torches.layers[0]);
             its.layers.push_back(its.layers[0]);
         },
         "each name once"},
        {[](PackTorches&, TorchParts& its) { its.layers[0].reliefs.pop_back(); }, "colours for 1 reliefs"},
        {[](PackTorches&, TorchParts& its) { its.layers[0].textures.pop_back(); },
         "has 1 textures, the pack has 2"},
        {[](PackTorches&, TorchParts& its) {
             std::swap(its.layers[0].textures[0], its.layers[0].textures[1]);
         },
         "13 x 7 texels"},
        {[](PackTorches&, TorchParts& its) { its.layers[0].reliefs[0].pop_back(); }, "[colours.size]"},
        {[](PackTorches&, TorchParts& its) { its.layers[0].reliefs[0] = {}; }, "FSRL"},
        {[](PackTorches&, TorchParts& its) { its.films[0][1] = its.pictures[0]; },
         "20 x 10 pixels; expected are 16 x 12"},
        {[](PackTorches&, TorchParts& its) { its.films[0][1].resize(40); }, "damaged"},
        {[](PackTorches&, TorchParts& its) { its.pictures[0] = samples::some_bytes("no picture"); },
         "not a WebP"},
    };
    for (const Fault& fault : faults) {
        expect_told(refusal(fault.alter), fault.words);
    }
}

TEST(Torches, reports_invalid_section_data_in_one_line) {
    expect_told(refusal_of_data(R"("blend":"over")", R"("blend":"under")"), "'under'");
    expect_told(refusal_of_data(R"("blend":"over")", R"("shader":"x","blend":"over")"), "shader");
    expect_told(refusal_of_data(R"("frames":3)", R"("frames":1000000)"), "frames");
    expect_told(refusal_of_data(R"("frames":3)", R"("frames":4)"), "[torch_section.parts]");
    expect_told(refusal_of_data(R"("frames":3)", R"("frames":2)"), "[torch_section.parts]");
    expect_told(refusal_of_data(R"("textures":2)", R"("textures":3)"), "[torch_section.parts]");
    expect_told(refusal_of_data(R"("size":0.9)", R"("size":1e400)"), "too large");
    std::string many = "\"contents\":[";
    for (int k = 0; k < 17; ++k) {
        many += "{},";
    }
    expect_told(refusal_of_data("\"contents\":[", many), "contents");
}
