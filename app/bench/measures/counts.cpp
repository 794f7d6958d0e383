#include "app/bench/measures/counts.h"

#include "app/render/sample_grid.h"
#include "app/scene/frame_plan.h"
#include "firmware_host/base/json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace frustumscreen::bench {

namespace {

struct Quantity {
    const char* name;
    double FrameCounts::*of;
};
constexpr std::array quantities = {
    Quantity{"triangles", &FrameCounts::triangles}, Quantity{"vertices", &FrameCounts::vertices},
    Quantity{"draw_calls", &FrameCounts::draw_calls}, Quantity{"samples", &FrameCounts::samples},
    Quantity{"bytes", &FrameCounts::bytes}};

double distinct(const std::vector<std::uint32_t>& indices, std::vector<bool>& seen) {
    std::fill(seen.begin(), seen.end(), false);
    std::size_t count = 0;
    for (const std::uint32_t index : indices) {
        count += seen[index] ? 0 : 1;
        seen[index] = true;
    }
    return static_cast<double>(count);
}

FrameCounts counts_of(const scene::FramePlan& plan, std::vector<bool>& seen) {
    constexpr double bytes_per_sample = 2.0 * (4.0 + 4.0); // colour and depth: each cleared, then drawn or
                                                           // read
    constexpr double bytes_per_pixel = 4.0;
    const glm::ivec2 grid = render::SampleGrid::of(plan.samples);
    FrameCounts counts;
    counts.triangles = static_cast<double>(plan.indices.size()) / 3.0;
    counts.vertices = distinct(plan.indices, seen);
    counts.draw_calls = static_cast<double>(plan.faces.size());
    counts.samples = static_cast<double>(plan.lit.pixels()) * grid.x * grid.y;
    counts.bytes = static_cast<double>(plan.indices.size()) * sizeof(std::uint32_t) +
                   counts.vertices * sizeof(pack::PackVertex) + counts.samples * bytes_per_sample +
                   bytes_per_pixel * plan.projector.width * plan.projector.height;
    return counts;
}

double growth(double now, double reference) {
    return reference > 0.0 ? now / reference : 1.0;
}

const CountedPack* find_in(std::span<const CountedPack> reference, const CountedPack& now) {
    const auto found = std::find_if(reference.begin(), reference.end(), [&now](const CountedPack& one) {
        return one.artifact == now.artifact && one.set_up == now.set_up;
    });
    return found != reference.end() ? &*found : nullptr;
}

std::string cell(double now, double reference, bool compared) {
    std::string number = now < 100.0 ? fmt::format("{:.1f}", now)
                         : now < 1e6 ? fmt::format("{:.0f}", now)
                                     : fmt::format("{:.3f} M", 1e-6 * now);
    const double percent = 100.0 * (growth(now, reference) - 1.0);
    if (!compared) {
        return number;
    }
    constexpr double nothing_percent = 0.05;
    return number + (std::abs(percent) < nothing_percent ? " (same)" : fmt::format(" ({:+.1f} %)", percent));
}

} // namespace

FrameCounts count_frames(const settings::Settings& settings, const pack::Pack& pack,
                         std::span<const BenchPose> poses) {
    const geometry::PropShape prop = settings::make_prop(settings.prop);
    const scene::PlacedLevel level =
        scene::placed(pack, pack.default_level, pack::place(pack, prop).metres_per_box);
    scene::FramePlan plan = scene::make_plan(prop, level);
    std::vector<bool> seen(pack.levels[pack.default_level].vertices.size());
    FrameCounts sum;
    for (const BenchPose& pose : poses) {
        scene::plan_frame(prop, level,
                          {.projector = settings.projector.pinhole,
                           .table_from_projector = settings.projector.table_from_projector,
                           .table_from_prop = pose.table_from_prop,
                           .eyes_m = {&pose.eye_m, 1},
                           .light = std::nullopt},
                          plan);
        const FrameCounts one = counts_of(plan, seen);
        for (const Quantity& quantity : quantities) {
            sum.*quantity.of += one.*quantity.of / static_cast<double>(poses.size());
        }
    }
    return sum;
}

Result<CountedPack> count_frames(const SetUp& set_up, const pack::Pack& pack, int poses, std::uint64_t seed) {
    TRY(const std::vector<BenchPose> drawn,
        at(set_up.name, draw_poses(set_up.settings, settings::make_prop(set_up.settings.prop), poses, seed)));
    return CountedPack{
        fmt::format("{}, {} triangles", pack.provenance.source_name, pack.provenance.source_triangles),
        set_up.name, count_frames(set_up.settings, pack, drawn)};
}

std::string counts_json(std::span<const CountedPack> counted) {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const CountedPack& one : counted) {
        nlohmann::ordered_json entry{{"artifact", one.artifact}, {"set_up", one.set_up}};
        // Two decimals keep the mean of whole counts over 50 poses exact.
        for (const Quantity& quantity : quantities) {
            entry[quantity.name] = std::round(100.0 * (one.counts.*quantity.of)) / 100.0;
        }
        all.push_back(std::move(entry));
    }
    nlohmann::ordered_json whole;
    whole["mean_of_a_frame"] = std::move(all);
    return whole.dump(1) + "\n";
}

Result<std::vector<CountedPack>> read_counts(std::string_view text) {
    std::vector<CountedPack> counted;
    try {
        const nlohmann::json whole = nlohmann::json::parse(text);
        for (const nlohmann::json& entry : whole.at("mean_of_a_frame")) {
            CountedPack one{
                entry.at("artifact").get<std::string>(), entry.at("set_up").get<std::string>(), {}};
            for (const Quantity& quantity : quantities) {
                one.counts.*quantity.of = entry.at(quantity.name).get<double>();
            }
            counted.push_back(std::move(one));
        }
    } catch (const nlohmann::json::exception& error) {
        return bad_input("bench.no_counts", "this is not a file that frustumscreen-bench counts wrote: {}",
                         error.what());
    }
    return counted;
}

std::vector<CountChange> changes(std::span<const CountedPack> counted,
                                 std::span<const CountedPack> reference) {
    std::vector<CountChange> found;
    for (const CountedPack& now : counted) {
        const CountedPack* const before = find_in(reference, now);
        if (before == nullptr) {
            continue;
        }
        const bool grown = std::any_of(quantities.begin(), quantities.end(), [&](const Quantity& quantity) {
            return growth(now.counts.*quantity.of, before->counts.*quantity.of) > max_count_growth;
        });
        found.push_back({now, before->counts, grown});
    }
    return found;
}

std::vector<std::string> without_reference(std::span<const CountedPack> counted,
                                           std::span<const CountedPack> reference) {
    std::vector<std::string> names;
    for (const CountedPack& now : counted) {
        if (find_in(reference, now) == nullptr) {
            names.push_back(fmt::format("{} in {}", now.artifact, now.set_up));
        }
    }
    return names;
}

std::string counts_table(std::span<const CountedPack> counted, std::span<const CountChange> against) {
    std::string text = fmt::format("{:<40} {:<8}", "mean of a frame, default level", "set-up");
    for (const Quantity& quantity : quantities) {
        text += fmt::format(" {:>20}", quantity.name);
    }
    text += "\n";
    for (const CountedPack& one : counted) {
        const auto change = std::find_if(against.begin(), against.end(), [&one](const CountChange& each) {
            return each.now.artifact == one.artifact && each.now.set_up == one.set_up;
        });
        const bool compared = change != against.end();
        text += fmt::format("{:<40} {:<8}", one.artifact, one.set_up);
        for (const Quantity& quantity : quantities) {
            text += fmt::format(" {:>20}", cell(one.counts.*quantity.of,
                                                compared ? change->reference.*quantity.of : 0.0, compared));
        }
        text += compared && change->grown ? "  GROWN\n" : "\n";
    }
    return text;
}

} // namespace frustumscreen::bench
