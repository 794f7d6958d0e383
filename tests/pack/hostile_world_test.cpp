// Worlds that are refused: when they are written, when the manifest was altered, when a part was.
#include "app/pack/curves_part.h"
#include "app/pack/pack_world.h"
#include "app/pack/sign_pack.h"
#include "tests/base/told.h"
#include "tests/pack/world_samples.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

using namespace frustumscreen;
using namespace frustumscreen::pack;

namespace {

using Json = nlohmann::json;
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr float no_float = std::numeric_limits<float>::quiet_NaN();
constexpr float endless = std::numeric_limits<float>::infinity();

std::string told(const Result<void>& result) {
    return result ? std::string() : test::told(result.error());
}

void expect_told(const std::string& message, const std::string& words) {
    EXPECT_TRUE(samples::is_one_line(message)) << words << ": " << message;
    EXPECT_NE(message.find(words), std::string::npos) << words << ": " << message;
}

/// The refusal of put_world after `change`.
std::string refusal_of(const std::function<void(PackWorld&)>& change) {
    PackWorld world = samples::world();
    change(world);
    Pack pack = samples::full_pack();
    std::vector<Pack> geometry = samples::cell_packs();
    geometry.resize(world.cells.size());
    return told(put_world(pack, world, geometry));
}

/// The refusal of put_world after `change` of a cell's own pack.
std::string refusal_of_cell(const std::function<void(Pack&)>& change) {
    std::vector<Pack> geometry = samples::cell_packs();
    change(geometry[2]);
    Pack pack = samples::full_pack();
    return told(put_world(pack, samples::world(), geometry));
}

std::string& data_of(Pack& pack, const std::string& name) {
    for (PackSection& section : pack.sections) {
        if (section.name == name) {
            return section.data;
        }
    }
    throw std::out_of_range(name);
}

/// The refusal of a pack whose section's data were changed.
std::string refusal_of_data(const std::string& name, const std::function<void(Json&)>& change) {
    Pack pack = samples::pack_with_world();
    Json data = Json::parse(data_of(pack, name));
    change(data);
    data_of(pack, name) = data.dump();
    return told(check_world(pack));
}

world::Behaviour& first(PackWorld& world) {
    return world.behaviours[0].behaviour;
}

template <typename Number> Bytes with(Bytes bytes, std::size_t at, Number number) {
    std::memcpy(bytes.data() + at, &number, sizeof number);
    return bytes;
}

} // namespace

TEST(HostileWorld, invalid_cells_are_refused) {
    for (const auto& [words, change] :
         std::initializer_list<std::pair<const char*, std::function<void(std::vector<PackCell>&)>>>{
             {"[cell.count]", [](auto& c) { c.resize(257, c[1]); }},
             {"[cell.name_twice]", [](auto& c) { c[2].cell.name = "body"; }},
             {"[cell.name_twice]", [](auto& c) { c[1].cell.name = ""; }},
             {"[cell.name]", [](auto& c) { c[1].cell.name = "two\nlines"; }},
             {"[cell.name]", [](auto& c) { c[1].cell.name = std::string(1001, 'n'); }},
             {"[cell.parent]", [](auto& c) { c[0].cell.parent = 0; }},
             {"[cell.parent]", [](auto& c) { c[0].cell.parent = 2; }},
             {"[cell.parent]", [](auto& c) { c[1].cell.parent = 99; }},
             {"[cell.pose]", [](auto& c) { c[1].cell.parent_from_base[3].x = no_number; }},
             {"[cell.pose]", [](auto& c) { c[1].cell.parent_from_base[1] = glm::dvec4(0.0); }},
             {"[cell.pose]", [](auto& c) { c[1].cell.parent_from_base[1] = c[1].cell.parent_from_base[0]; }},
             {"[cell.pose]", [](auto& c) { c[1].cell.parent_from_base[0].w = 1.0; }},
             {"[cell.pose]", [](auto& c) { c[2].cell.cell_from_geometry[0] = glm::dvec4(1e30, 0, 0, 0); }},
             {"[cell.pose]", [](auto& c) { c[2].cell.rest.scale.y = 0.0; }},
             {"[cell.pose]", [](auto& c) { c[2].cell.rest.scale.y = no_number; }},
             {"[cell.pose]", [](auto& c) { c[2].cell.rest.rotation = {0.0, 0.0, 0.0, 0.0}; }},
             {"[cell.no_size]", [](auto& c) { c[0].high = c[0].low; }},
             {"[cell.no_size]", [](auto& c) { c[0].high.x = -0.3; }},
             {"[cell.no_size]", [](auto& c) { c[0].low.x = no_number; }},
             {"[cell.outside_box]", [](auto& c) { c[0].high.z = 0.81; }},
             {"[cell.outside_box]", [](auto& c) { c[0].low.x = -0.51; }},
             {"[cell.no_geometry]", [](auto& c) { c[1].triangles = 1; }},
             {"[cell.no_geometry]", [](auto& c) { c[1].high.x = 0.1; }},
             {"[world.nested_box]", [](auto& c) { c[0].high.x = 0.3; }},
             {"[world.nested_box]", [](auto& c) { c[2].cell.rest.translation.z = -0.3; }}}) {
        expect_told(refusal_of([&change = change](PackWorld& world) { change(world.cells); }), words);
    }
}

TEST(HostileWorld, chain_of_scales_that_overflows_is_refused) {
    PackWorld chain;
    for (std::size_t k = 0; k < 40; ++k) {
        PackCell& link = chain.cells.emplace_back();
        link.cell.name = std::to_string(k);
        link.cell.parent = k == 0 ? std::nullopt : std::optional(k - 1);
        link.cell.rest.scale = glm::dvec3(1e9);
    }
    Pack pack = samples::pack();
    expect_told(told(put_world(pack, chain, std::vector<Pack>(chain.cells.size()))), "[cell.chain]");
}

TEST(HostileWorld, invalid_behaviours_are_refused) {
    for (const auto& [words, change] :
         std::initializer_list<std::pair<const char*, std::function<void(PackWorld&)>>>{
             {"[behaviour.count]", [](auto& w) { w.behaviours.resize(33, w.behaviours[1]); }},
             {"[behaviour.count]", [](auto& w) { first(w).channels.resize(1025, first(w).channels[0]); }},
             {"[behaviour.count]",
              [](auto& w) { first(w).channels[1].curve.times_s.resize((1U << 20U) + 1); }},
             {"[behaviour.spring_count]", [](auto& w) { first(w).springs.resize(257); }},
             {"[behaviour.name_twice]", [](auto& w) { w.behaviours[1].behaviour.name = "open"; }},
             {"[behaviour.name_twice]", [](auto& w) { first(w).name.clear(); }},
             {"[behaviour.name]", [](auto& w) { first(w).name = "\x1b"; }},
             {"[behaviour.seconds]", [](auto& w) { first(w).seconds = no_number; }},
             {"[behaviour.seconds]", [](auto& w) { first(w).seconds = -1.0; }},
             {"[behaviour.seconds]", [](auto& w) { first(w).narration_s = 3601.0; }},
             {"[behaviour.hotspot]", [](auto& w) { first(w).hotspot = 2; }},
             {"[behaviour.moves_nothing]", [](auto& w) { first(w).channels.clear(); }},
             {"[behaviour.no_cell]", [](auto& w) { first(w).channels[0].cell = 3; }},
             {"[behaviour.no_cell]", [](auto& w) { w.behaviours[1].behaviour.springs[0].cell = 3; }},
             {"[behaviour.no_cell]", [](auto& w) { w.behaviours[1].behaviour.pendulums[0].cell = 300; }},
             {"[behaviour.no_cell]", [](auto& w) { w.cells.clear(); }},
             {"[behaviour.channel_twice]",
              [](auto& w) { first(w).channels[1].path = world::Path::Rotation; }},
             {"[behaviour.keys]", [](auto& w) { first(w).channels[0].curve.values.pop_back(); }},
             {"[behaviour.keys]", [](auto& w) { first(w).channels[0].curve = {}; }},
             {"[behaviour.keys]",
              [](auto& w) { first(w).channels[0].curve.interpolation = world::Interpolation::CubicSpline; }},
             {"[behaviour.key_time]", [](auto& w) { first(w).channels[0].curve.times_s[1] = no_float; }},
             {"[behaviour.key_time]", [](auto& w) { first(w).channels[0].curve.times_s[1] = endless; }},
             {"[behaviour.key_time]", [](auto& w) { first(w).channels[0].curve.times_s[0] = -0.5F; }},
             {"[behaviour.times_back]", [](auto& w) { first(w).channels[2].curve.times_s[1] = 0.25F; }},
             {"[behaviour.times_back]", [](auto& w) { first(w).channels[2].curve.times_s[1] = 0.5F; }},
             {"[behaviour.key_value]", [](auto& w) { first(w).channels[1].curve.values[0].y = no_float; }},
             {"[behaviour.key_value]", [](auto& w) { first(w).channels[2].curve.values[0].x = endless; }},
             {"[behaviour.no_rotation]",
              [](auto& w) { first(w).channels[0].curve.values[1] = glm::vec4(0.0F); }},
             {"[behaviour.dark_light]", [](auto& w) { first(w).channels[3].curve.values[1].x = -0.1F; }},
             {"[behaviour.axis]", [](auto& w) { w.behaviours[1].behaviour.springs[0].axis = {0, 0, 2}; }},
             {"[behaviour.axis]", [](auto& w) { w.behaviours[1].behaviour.springs[0].axis.x = no_number; }},
             {"[behaviour.axis]", [](auto& w) { w.behaviours[1].behaviour.pendulums[0].axis = {0, 0, 0}; }},
             {"[behaviour.spring]", [](auto& w) { w.behaviours[1].behaviour.springs[0].reach = 2e6; }},
             {"[behaviour.spring]",
              [](auto& w) { w.behaviours[1].behaviour.springs[0].stiffness_per_s2 = 0.0; }},
             {"[behaviour.spring]",
              [](auto& w) { w.behaviours[1].behaviour.springs[0].stiffness_per_s2 = no_number; }},
             {"[behaviour.spring]",
              [](auto& w) { w.behaviours[1].behaviour.springs[0].damping_per_s = -1.0; }},
             {"[behaviour.pendulum]", [](auto& w) { w.behaviours[1].behaviour.pendulums[0].length_m = 0.0; }},
             {"[behaviour.pendulum]",
              [](auto& w) { w.behaviours[1].behaviour.pendulums[0].angle_rad = 4.0; }},
             {"[behaviour.pendulum]",
              [](auto& w) { w.behaviours[1].behaviour.pendulums[0].damping_per_s = no_number; }},
             {"[hotspot.label_twice]", [](auto& w) { w.behaviours[0].titles[1].language = "en"; }},
             {"[pack.language_tag]", [](auto& w) { w.behaviours[0].titles[1].language = "e"; }},
             {"[pack.text]", [](auto& w) { w.behaviours[0].titles[1].text = "two\nlines"; }}}) {
        expect_told(refusal_of(change), words);
    }
}

TEST(HostileWorld, negative_and_zero_tangents_are_accepted) {
    EXPECT_EQ(refusal_of([](PackWorld& world) {
                  world::Curve& light = first(world).channels[3].curve;
                  light.interpolation = world::Interpolation::CubicSpline;
                  light.values.assign(6, glm::vec4(-1.0F, -1.0F, -1.0F, 0.0F));
                  light.values[1] = light.values[4] = glm::vec4(1.0F);
                  world::Curve& turn = first(world).channels[0].curve;
                  turn.interpolation = world::Interpolation::CubicSpline;
                  turn.values.assign(6, glm::vec4(0.0F));
                  turn.values[1] = turn.values[4] = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
              }),
              "");
}

TEST(HostileWorld, cell_pack_with_captions_hotspots_or_sections_is_refused) {
    expect_told(refusal_of_cell([](Pack& cell) { cell.captions = samples::pack().captions; }),
                "[world.nested]");
    expect_told(refusal_of_cell([](Pack& cell) { cell.hotspots = samples::full_pack().hotspots; }),
                "[world.nested]");
    expect_told(refusal_of_cell([](Pack& cell) {
                    cell.sections.push_back({"texts", "{}", {}});
                }),
                "[world.nested]");
    expect_told(refusal_of_cell([](Pack& cell) {
                    cell.sections.push_back({"cells", "{}", {}});
                }),
                "[world.nested]");
    expect_told(refusal_of_cell([](Pack& cell) { cell.levels.clear(); }), "cell 'lid'");
}

TEST(HostileWorld, altered_sections_are_refused) {
    const auto cell = [](std::size_t number, const char* name, Json value) {
        return [=](Json& data) { data["cells"][number][name] = value; };
    };
    expect_told(refusal_of_data("cells", cell(0, "more", 1)), "sections.cells.data.cells[0].more");
    expect_told(refusal_of_data("cells", [](Json& data) { data["cells"][0].erase("low"); }),
                "low is missing");
    expect_told(refusal_of_data("cells", cell(0, "parent", 0)), "[cell.parent]");
    expect_told(refusal_of_data("cells", cell(0, "parent", 256)), "0 to 255");
    expect_told(refusal_of_data("cells", cell(1, "parent", "body")), "parent");
    expect_told(refusal_of_data("cells", cell(1, "rotation", {0, 0, 1})), "4 numbers");
    expect_told(refusal_of_data("cells", cell(1, "scale", {1, nullptr, 1})), "3 numbers");
    expect_told(refusal_of_data("cells", cell(2, "part", "cells/0.fspack")), "[world.parts]");
    expect_told(refusal_of_data("cells", cell(2, "part", "")), "[world.parts]");
    expect_told(refusal_of_data("cells", cell(0, "cell_from_geometry", {1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0})),
                "[world.nested_box]");
    expect_told(refusal_of_data("cells", [](Json& data) { data["cells"] = Json::array(); }), "[world.parts]");
    expect_told(refusal_of_data("cells",
                                [](Json& data) {
                                    const Json one = data["cells"][1];
                                    data["cells"].insert(data["cells"].end(), 254, one);
                                }),
                "a list of 257");
    const auto behaviour = [](const char* name, Json value) {
        return [=](Json& data) { data["behaviours"][0][name] = value; };
    };
    expect_told(refusal_of_data("behaviours", behaviour("trigger", "wish")),
                "button and dwell and hotspot and narration and arrival");
    expect_told(refusal_of_data("behaviours", behaviour("seconds", "2")), "seconds");
    expect_told(refusal_of_data("behaviours", behaviour("hotspot", 2)), "[behaviour.hotspot]");
    expect_told(refusal_of_data("behaviours", behaviour("channels", Json::array())), "[world.parts]");
    expect_told(
        refusal_of_data("behaviours", [](Json& data) { data["behaviours"][2]["pendulums"] = Json::array(); }),
        "[behaviour.moves_nothing]");
    expect_told(refusal_of_data("behaviours",
                                [](Json& data) { data["behaviours"][0]["channels"][0]["path"] = "colour"; }),
                "translation and rotation and scale and light");
    expect_told(refusal_of_data("behaviours", [](Json& data) { data["behaviours"][0]["channels"].erase(3); }),
                "[world.curve_count]");
    expect_told(refusal_of_data("behaviours",
                                [](Json& data) {
                                    std::swap(data["behaviours"][0]["channels"][0]["path"],
                                              data["behaviours"][0]["channels"][1]["path"]);
                                }),
                "[world.curve_values]");
    expect_told(refusal_of_data("behaviours", [](Json& data) { data["behaviours"].erase(0); }),
                "[world.parts]");
}

TEST(HostileWorld, altered_parts_are_refused) {
    const Pack good = samples::pack_with_world();
    ASSERT_EQ(told(check_world(good)), "");
    const auto refusal_with = [&](const std::string& part, const Bytes& bytes) {
        Pack pack = good;
        pack.section_parts.at(part) = bytes;
        return told(check_world(pack));
    };
    const std::string lid = "cells/2.fspack";
    const Bytes& bytes = good.section_parts.at(lid);
    expect_told(refusal_with(lid, {}), "cells/2.fspack: ");
    expect_told(refusal_with(lid, Bytes(bytes.begin(), bytes.end() - 1)), "cells/2.fspack: ");
    expect_told(refusal_with(lid, with_signature(bytes, "a signature").value()), "[world.nested_signature]");
    expect_told(refusal_with(lid, samples::bytes_of(good)), "[world.nested]");
    expect_told(refusal_with(lid, samples::bytes_of(samples::full_pack())), "[world.nested]");
    samples::Entries entries = samples::take_apart(bytes);
    entries.part("levels/0.bin")[30] ^= std::byte{1};
    expect_told(refusal_with(lid, samples::put_together(entries)), "does not match its hash");
    samples::Entries reliefs = samples::take_apart(bytes);
    reliefs.part("relief_blocks/64.bin")[4] ^= std::byte{2};
    samples::right_hashes(reliefs);
    expect_told(refusal_with(lid, samples::put_together(reliefs)), "cells/2.fspack: relief_blocks/64.bin: ");
    expect_told(refusal_with("behaviours/curves.bin", {}), "FSCV");
}

TEST(HostileWorld, invalid_curves_are_refused) {
    const Bytes good = samples::pack_with_world().section_parts.at("behaviours/curves.bin");
    ASSERT_TRUE(decode_curves(good));
    constexpr std::uint32_t all = std::numeric_limits<std::uint32_t>::max();
    const std::vector<std::pair<Bytes, const char*>> faults{
        {{}, "[curves.no_magic]"},
        {with(good, 0, 'X'), "[curves.no_magic]"},
        {with(good, 4, std::uint32_t{2}), "[curves.version]"},
        {with(good, 8, std::uint32_t{0}), "[curves.counts]"},
        {with(good, 8, std::uint32_t{1025}), "[curves.counts]"},
        {with(good, 12, all), "[curves.counts]"},
        {with(good, 8, std::uint32_t{3}), "[curves.length]"},
        {with(good, 8, std::uint32_t{5}), "[curves.cut]"},
        {with(good, 12, std::uint32_t{8}), "[curves.length]"},
        {with(good, 12, std::uint32_t{1}), "[curves.keys]"},
        {with(good, 16, std::uint16_t{3}), "[curves.kind]"},
        {with(good, 18, std::uint16_t{5}), "[curves.kind]"},
        {with(good, 20, std::uint32_t{0}), "[curves.keys]"},
        {with(good, 20, all), "[curves.keys]"},
        {Bytes(good.begin(), good.end() - 1), "[curves.keys]"},
        {Bytes(good.begin(), good.begin() + 40), "[curves.keys]"},
    };
    for (const auto& [bytes, words] : faults) {
        const Result<std::vector<StoredCurve>> curves = decode_curves(bytes);
        expect_told(curves ? std::string() : test::told(curves.error()), words);
    }
    Bytes longer = good;
    longer.push_back(std::byte{0});
    EXPECT_EQ(decode_curves(longer).error().id, "curves.length");
}

TEST(HostileWorld, flipped_bytes_of_a_cell_are_refused_by_part_name) {
    const Bytes bytes = samples::bytes_of(samples::pack_with_world());
    const Bytes part = samples::take_apart(bytes).part("cells/2.fspack");
    const auto there = std::search(bytes.begin(), bytes.end(), part.begin(), part.end());
    ASSERT_NE(there, bytes.end());
    constexpr std::size_t stride = 61; // co-prime to the sizes of records
    std::size_t flips = 0;
    for (std::size_t k = 0; k < part.size(); k += stride, ++flips) {
        Bytes altered = bytes;
        altered[static_cast<std::size_t>(there - bytes.begin()) + k] ^= std::byte{0x20};
        ASSERT_NE(samples::refusal_of(altered).find("cells/2.fspack"), std::string::npos) << k;
    }
    EXPECT_GT(flips, 50U);
}

TEST(HostileWorld, flipped_bytes_with_valid_hash_are_refused_or_harmless) {
    const Pack good = samples::pack_with_world();
    const auto refused = [&](const std::string& part, std::size_t step, const auto& check) {
        std::size_t count = 0;
        for (std::size_t k = 0; k < good.section_parts.at(part).size(); k += step) {
            Pack pack = good;
            pack.section_parts[part][k] ^= std::byte{0x41};
            if (const std::string message = told(check(pack)); !message.empty()) {
                ++count;
                EXPECT_TRUE(samples::is_one_line(message)) << k << ": " << message;
            }
        }
        return count;
    };
    constexpr std::size_t headers = 16 + 4 * 8; // of the part and of its curves: no byte of them may change
    EXPECT_GE(
        refused("behaviours/curves.bin", 1, [](const Pack& pack) { return without_value(world_of(pack)); }),
        headers);
    // Dates and attributes of the container are not read.
    constexpr std::size_t stride = 211;
    EXPECT_GT(refused("cells/2.fspack", stride, check_world),
              good.section_parts.at("cells/2.fspack").size() / stride * 3 / 4);
}
